"""Printed sheet as values in millimetres from its upper left corner; painted outside core."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from carpus.core.model.phrase import phrase

Paper = Literal["a4", "letter"]
PAPER_MM: dict[Paper, tuple[float, float]] = {"a4": (210.0, 297.0), "letter": (215.9, 279.4)}
"""Width and height, upright."""
RULER_MM = 100.0
"""Length of the ruler on every sheet, which shows a print at another size than 100 %."""


@dataclass(frozen=True, slots=True)
class SheetBox:
    """Filled rectangle without an outline; ``color`` as #RRGGBB."""

    left_mm: float
    top_mm: float
    width_mm: float
    height_mm: float
    color: str = "#000000"


@dataclass(frozen=True, slots=True)
class SheetDisc:
    """Filled circle."""

    x_mm: float
    y_mm: float
    radius_mm: float
    color: str


@dataclass(frozen=True, slots=True)
class SheetLine:
    """Fine line; dashed where paper is folded, not cut."""

    from_mm: tuple[float, float]
    to_mm: tuple[float, float]
    dashed: bool = False


@dataclass(frozen=True, slots=True)
class SheetText:
    """One line of text, from its left end on the base line."""

    text: str
    x_mm: float
    y_mm: float
    size_pt: float = 9.0
    bold: bool = False


SheetItem = SheetBox | SheetDisc | SheetLine | SheetText


@dataclass(frozen=True, slots=True)
class PrintedSheet:
    """One page."""

    width_mm: float
    height_mm: float
    items: tuple[SheetItem, ...]


def ruler_items(left_mm: float, top_mm: float) -> tuple[SheetItem, ...]:
    """Return a ruler of 100 mm with centimetre marks and its instruction."""
    marks: list[SheetItem] = [SheetLine((left_mm, top_mm), (left_mm + RULER_MM, top_mm))]
    for k in range(11):
        x = left_mm + 10.0 * k
        marks.append(SheetLine((x, top_mm), (x, top_mm + (4.0 if k % 5 == 0 else 2.5))))
    words = (phrase("This line must be 100 mm long. If it is not,"), phrase("print again at 100 % (“actual size”)."))
    texts = [SheetText(line, left_mm + RULER_MM + 4.0, top_mm + 1.4 + 3.6 * k, 8.0) for k, line in enumerate(words)]
    return (*marks, *texts)

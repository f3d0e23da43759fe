"""A layout with what is in it, as one expression."""

from __future__ import annotations

from typing import TypeAlias, TypeVar

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QLayout, QVBoxLayout, QWidget

Margins: TypeAlias = tuple[int, int, int, int]
"""Left, top, right, bottom."""
LayoutT = TypeVar("LayoutT", bound=QBoxLayout)


class Stretch:
    """Takes what room is left."""


STRETCH = Stretch()
Item: TypeAlias = QWidget | QLayout
Part: TypeAlias = Item | Stretch | int | tuple[Item, int] | tuple[QWidget, int, Qt.AlignmentFlag]
"""A widget or layout, with its share of the room and its alignment; or so many design pixels of nothing."""


def fill(layout: QBoxLayout, *parts: Part) -> None:
    """Add them one after the other."""
    for part in parts:
        item, share, *aligned = part if isinstance(part, tuple) else (part, 0)
        if isinstance(item, Stretch):
            layout.addStretch(1)
        elif isinstance(item, int):
            layout.addSpacing(item)
        elif isinstance(item, QLayout):
            layout.addLayout(item, share)
        elif aligned:
            layout.addWidget(item, share, aligned[0])
        else:
            layout.addWidget(item, share)


def empty(layout: QLayout) -> None:
    """Take out what is in it, and let it go."""
    while (item := layout.takeAt(0)) is not None:
        if (widget := item.widget()) is not None:
            widget.hide()
            widget.deleteLater()


def in_line(
    *parts: Part,
    gap: int | None = None,
    margins: Margins | None = None,
    within: QWidget | None = None,
) -> QHBoxLayout:
    """Side by side, ``gap`` pixels between them, as the layout of ``within``."""
    return _laid(QHBoxLayout() if within is None else QHBoxLayout(within), parts, gap, margins)


def in_column(
    *parts: Part,
    gap: int | None = None,
    margins: Margins | None = None,
    within: QWidget | None = None,
) -> QVBoxLayout:
    """One below the other; else as :func:`in_line`."""
    return _laid(QVBoxLayout() if within is None else QVBoxLayout(within), parts, gap, margins)


def _laid(layout: LayoutT, parts: tuple[Part, ...], gap: int | None, margins: Margins | None) -> LayoutT:
    if gap is not None:
        layout.setSpacing(gap)
    if margins is not None:
        layout.setContentsMargins(*margins)
    fill(layout, *parts)
    return layout

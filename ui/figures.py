"""The joint angles of the whole hand as the clinic speaks of them: by finger, with a name, a range and a colour.

Five fingers (thumb to little) by four rows: knuckle, middle joint, end joint, spread. The thumb has no middle joint;
its row shows the lift away from the palm. Spreading is counted away from the middle finger, the thumb's away from the
palm's edge, and that of the middle finger towards the thumb. TAM is the sum of a finger's bending.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from carpus.core.phrase import Phrase, phrase
from carpus.core.rounding import written
from carpus.ui import numbers
from carpus.ui.marker_words import finger_name, long_finger_name
from carpus.ui.translate import inside, say, tr

Row = Literal["knuckle", "middle", "end", "spread", "tam"]
ROWS: tuple[Row, ...] = ("knuckle", "middle", "end", "spread")
FINGERS = (1, 2, 3, 4, 5)
TOKENS: dict[Row, str] = {
    "knuckle": "curve_a", "middle": "curve_b", "end": "curve_c", "spread": "curve_a", "tam": "accent",
}  # fmt: skip
_JOINTS: dict[Row, str] = {"knuckle": "MCP{}_flexion", "middle": "PIP{}_flexion", "end": "DIP{}_flexion"}
_THUMB: dict[Row, str] = {
    "knuckle": "MCP1_flexion", "middle": "CMC1_abduction", "end": "IP1_flexion", "spread": "CMC1_extension",
}  # fmt: skip


_ROW_NAMES: Mapping[str, Phrase] = {
    "lift": phrase("Lift"), "knuckle": phrase("Knuckle"), "middle": phrase("Middle joint"), "end": phrase("End joint"),
    "spread": phrase("Spread"), "tam": phrase("TAM"),
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Figure:
    """One angle of one finger. ``joint`` is its name in every file, ``TAM3`` for the sum of a finger's bending."""

    finger: int
    row: Row

    @property
    def joint(self) -> str:
        if self.row == "tam":
            return f"TAM{self.finger}"
        if self.finger == 1:
            return _THUMB[self.row]
        return f"MCP{self.finger}_abduction" if self.row == "spread" else _JOINTS[self.row].format(self.finger)

    @property
    def is_lift(self) -> bool:
        """Whether it is the thumb's lift away from the palm, which stands in the row of the middle joints."""
        return self.finger == 1 and self.row == "middle"

    @property
    def token(self) -> str:
        return TOKENS[self.row]

    @property
    def sign(self) -> float:
        """From the angle in every file to the one that is spoken of: spreading is away from the middle finger."""
        return -1.0 if self.row == "spread" and self.finger in (4, 5) else 1.0

    @property
    def range_deg(self) -> tuple[float, float]:
        if self.row == "spread":
            return -30.0, 30.0
        if self.is_lift:
            return 0.0, 60.0
        return 0.0, {"tam": 140.0 if self.finger == 1 else 270.0}.get(self.row, 120.0)

    @property
    def row_name(self) -> str:
        """``Knuckle``; the thumb's second row is its lift."""
        return row_name("lift" if self.is_lift else self.row)

    @property
    def long_name(self) -> str:
        """``Ring finger, middle joint``."""
        return _long_name(self)

    @property
    def short_name(self) -> str:
        """``Ring``, where the row is said elsewhere."""
        return finger_name(str(self.finger))

    @property
    def end_names(self) -> tuple[str, str]:
        return _end_names(self)


FIGURES: tuple[Figure, ...] = tuple(Figure(finger, row) for finger in FINGERS for row in (*ROWS, "tam"))
"""All that can be the large number, finger by finger."""


def row_name(row: Row | Literal["lift"]) -> str:
    """``Middle joint``."""
    return say(_ROW_NAMES[row])


def _long_name(figure: Figure) -> str:
    name = figure.row_name
    return tr("{finger}, {joint}").format(
        finger=long_finger_name(str(figure.finger)),
        joint=name if figure.row == "tam" else inside(name),
    )


def _end_names(figure: Figure) -> tuple[str, str]:
    low, high = (f"{written(abs(value))}°" for value in figure.range_deg)
    if figure.is_lift:
        return tr("In the palm’s plane"), tr("Lifted {angle}").format(angle=high)
    if figure.row != "spread":
        return tr("Straight"), tr("Bent {angle}").format(angle=high)
    if figure.finger == 3:
        return tr("Ulnar {angle}").format(angle=low), tr("Radial {angle}").format(angle=high)
    return tr("Inwards {angle}").format(angle=low), tr("Away {angle}").format(angle=high)


def side_word(value_deg: float, finger: int = 0) -> str:
    """``in`` or ``out`` beside an angle of spreading, of the middle finger ``radial`` or ``ulnar``; empty about the
    middle and where there is no value."""
    if not abs(value_deg) >= 0.5:
        return ""
    if finger == 3:
        return tr("ulnar") if value_deg < 0 else tr("radial")
    return tr("in") if value_deg < 0 else tr("out")


def with_side(value_deg: float, finger: int = 0) -> str:
    """``12° out``: an angle of spreading with its side."""
    return f"{numbers.degrees(value_deg)} {side_word(value_deg, finger)}".strip()


def spread_labels(tick_deg: float, finger: int = 0) -> tuple[tuple[float, str], ...]:
    """``Out 20°``, ``0°``, ``In 20°``: ticks of an axis of spreading; of the middle finger ``Radial``, ``Ulnar``."""
    angle = numbers.degrees(tick_deg)
    out, inward = tr("Out {angle}"), tr("In {angle}")
    if finger == 3:
        out, inward = tr("Radial {angle}"), tr("Ulnar {angle}")
    out, inward = out.format(angle=angle), inward.format(angle=angle)
    return (tick_deg, out), (0.0, "0°"), (-tick_deg, inward)


def followed_name(joint: str) -> str:
    """What is followed of every finger: ``Total active motion (TAM)``, ``Middle joint, range``."""
    figure = figure_of(joint)
    return tr("Total active motion (TAM)") if figure.row == "tam" else tr("{row}, range").format(row=figure.row_name)


def figure_of(joint: str) -> Figure:
    """The figure of a joint angle's name, the middle finger's middle joint for one that is not shown."""
    return next((figure for figure in FIGURES if figure.joint == joint), Figure(3, "middle"))

"""What can be measured by hand: one line each. A further one is a line here.

Licensed questionnaires are entered as their totals only. ``real_change`` is what a change must exceed to be called one;
it is of that way of measuring, and says nothing of ours. NaN where no figure was found: then nothing is judged.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from carpus.core.phrase import phrase

Kind = Literal["angle", "force", "size", "score"]
Better = Literal["more", "less", ""]
Unit = Literal["deg", "kg", "cm", "ml", "points"]
Way = Literal["active", "passive", ""]

GONIOMETER_DEG = 10.0
"""A change commonly asked for per joint; two days apart 12 to 30 degrees were found (clinical reference 6.3, C30)."""
ANGLE_SOURCE = "commonly quoted for one rater"
SCORE_SOURCE = "Sorensen 2013"


@dataclass(frozen=True, slots=True)
class HandMeasure:
    """One thing that can be measured by hand.

    ``least`` and ``most`` can be entered at all; outside ``usual`` the person is asked to look again. ``tries`` are
    averaged. ``of_hand``: it is of one hand, else of the person. ``name`` is empty of angles: it follows from the id.
    ``figure`` is what Carpus measures of the same: joint (empty for the wrist), movement, column of the wrist's
    angle. ``usual_form``: on the form without being asked for.
    """

    id: str
    kind: Kind
    unit: Unit
    least: float
    most: float
    usual: tuple[float, float]
    better: Better
    real_change: float
    source: str
    ways: tuple[Way, ...] = ("",)
    tries: int = 1
    of_hand: bool = True
    figure: tuple[str, str, int] | None = None
    usual_form: bool = False
    decimals: int = 0
    name: str = ""


def _angle(name: str, most: float, figure: tuple[str, str, int] | None, *, usual_form: bool = False) -> HandMeasure:
    return HandMeasure(
        name, "angle", "deg", -90.0, 180.0, (-20.0, most), "more", GONIOMETER_DEG, ANGLE_SOURCE,
        ways=("active", "passive"), figure=figure, usual_form=usual_form,
    )  # fmt: skip


def _force(
    id: str, name: str, most: float, real_change: float, source: str, *, usual_form: bool = False
) -> HandMeasure:
    return HandMeasure(
        id, "force", "kg", 0.0, 150.0, (0.0, most), "more", real_change, source, tries=3, usual_form=usual_form,
        decimals=1, name=name,
    )  # fmt: skip


def _size(
    id: str, name: str, least: float, most: float, usual: tuple[float, float], *, usual_form: bool = False
) -> HandMeasure:
    return HandMeasure(
        id, "size", "cm", least, most, usual, "", math.nan, "", usual_form=usual_form, decimals=1, name=name
    )  # fmt: skip


def _score(
    id: str, name: str, most: float, better: Better, real_change: float, source: str, *, usual_form: bool = False
) -> HandMeasure:
    return HandMeasure(
        id, "score", "points", 0.0, most, (0.0, most), better, real_change, source, of_hand=False,
        usual_form=usual_form, decimals=1, name=name,
    )  # fmt: skip


_WRIST = (
    _angle("FLEXION", 100.0, ("", "flexion", 1), usual_form=True),
    _angle("EXTENSION", 95.0, ("", "extension", 1), usual_form=True),
    _angle("RADIAL", 40.0, ("", "radial", 0), usual_form=True),
    _angle("ULNAR", 55.0, ("", "ulnar", 0), usual_form=True),
    _angle("PRONATION", 100.0, ("", "pronation", 2)),
    _angle("SUPINATION", 105.0, ("", "supination", 2)),
)
_THUMB_MOST = {"MCP": 80.0, "IP": 100.0}
_FINGER_MOST = {"MCP": 100.0, "PIP": 125.0, "DIP": 100.0}
_JOINTS = tuple(
    measure
    for finger in (1, 2, 3, 4, 5)
    for joint, most in (_THUMB_MOST if finger == 1 else _FINGER_MOST).items()
    for measure in (
        _angle(f"{joint}{finger}_FLEXION", most, (f"{joint}{finger}_flexion", "flexion", -1)),
        # Carpus's least bent angle is no extension of the joint by itself: the two do not stand beside each other.
        _angle(f"{joint}{finger}_EXTENSION", 45.0, None),
    )
)

MEASURES: tuple[HandMeasure, ...] = (
    *_WRIST,
    _force("GRIP", phrase("Grip"), 80.0, 6.5, "Kim 2014, Bohannon 2019", usual_form=True),
    _force("KEY_PINCH", phrase("Key pinch"), 15.0, math.nan, "", usual_form=True),
    _force("THREE_POINT_PINCH", phrase("Three-point pinch"), 15.0, math.nan, ""),
    _force("TIP_PINCH", phrase("Tip pinch"), 12.0, math.nan, ""),
    _size("WRIST_ROUND", phrase("Round the wrist"), 5.0, 40.0, (11.0, 25.0), usual_form=True),
    _size("PALM_ROUND", phrase("Round the palm"), 5.0, 50.0, (14.0, 30.0)),
    _size("FIGURE_OF_EIGHT", phrase("Figure of eight"), 10.0, 80.0, (30.0, 60.0)),
    HandMeasure(
        "VOLUME", "size", "ml", 50.0, 1500.0, (200.0, 800.0), "", math.nan, "", name=phrase("Volume of the hand")
    ),
    _score("PRWE", "PRWE", 100.0, "less", 14.0, SCORE_SOURCE, usual_form=True),
    _score("QUICK_DASH", "QuickDASH", 100.0, "less", 14.0, SCORE_SOURCE),
    _score("DASH", "DASH", 100.0, "less", 10.0, SCORE_SOURCE),
    _score("MHQ", "MHQ", 100.0, "more", math.nan, ""),
    _score("PAIN_AT_REST", phrase("Pain at rest"), 10.0, "less", 2.0, "Farrar 2001", usual_form=True),
    _score("PAIN_MOVING", phrase("Pain when moving"), 10.0, "less", 2.0, "Farrar 2001"),
    *_JOINTS,
)


def measure_named(name: str) -> HandMeasure:
    """A measure by its id. Raises KeyError for one that this Carpus does not know."""
    for measure in MEASURES:
        if measure.id == name:
            return measure
    raise KeyError(name)

"""Check card: three discs on the flat sheet, three on a wedge of 30 degrees on it.

Steeper faces are avoided, because a structured-light camera reads them badly.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from carpus.core.calibration.camera.printed_sheet import (
    PAPER_MM,
    Paper,
    PrintedSheet,
    SheetDisc,
    SheetItem,
    SheetLine,
    SheetText,
    ruler_items,
)
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray

BLUE = "#2648A5"
DISC_RADIUS_MM = 6.0
HEIGHT_MM = 30.0
SLOPE_DEG = 30.0
SLOPE_MM, FOOT_MM = 2.0 * HEIGHT_MM, 2.0 * math.sqrt(3.0) * HEIGHT_MM
"""Sides of the wedge: two faces at 30 degrees, and its foot."""
WIDTH_MM = 50.0
DISCS = ("A", "B", "C", "D", "E", "F")
_BEND_DEG = 50.0
_ON_SLOPE_MM = (12.0, 50.0)
"""Positions of D and E up the first face."""
FOOT_CORNER_MM = (40.0, 8.0)
"""Corner of the wedge's foot, at its low edge, from disc A."""
_TAB_MM = 12.0


@dataclass(frozen=True, slots=True)
class CardDimension:
    """Known dimension of the card in degrees or millimetres."""

    name: str
    kind: Literal["angle", "length"]
    true_value: float


DIMENSIONS = (
    CardDimension("Wedge 30°", "angle", 30.0),
    CardDimension("Over the ridge 50°", "angle", _BEND_DEG),
    CardDimension("Flat 90°", "angle", 90.0),
    CardDimension("80 mm across", "length", 80.0),
    CardDimension("120 mm along", "length", 120.0),
    CardDimension("25 mm high", "length", 25.0),
)


def disc_positions_m() -> FloatArray:
    """Return the six discs (6, 3): x across and y down the sheet from A, z out of it."""
    middle = FOOT_CORNER_MM[0] + 0.5 * WIDTH_MM
    slope = math.radians(SLOPE_DEG)
    d, e = ((middle, FOOT_CORNER_MM[1] + s * math.cos(slope), s * math.sin(slope)) for s in _ON_SLOPE_MM)
    ridge, down = FOOT_CORNER_MM[1] + SLOPE_MM * math.cos(slope), _ridge_to_f_mm()
    f = (middle, ridge + down * math.cos(slope), HEIGHT_MM - down * math.sin(slope))
    return np.array([(0.0, 0.0, 0.0), (80.0, 0.0, 0.0), (0.0, 120.0, 0.0), d, e, f]) / 1e3


def _ridge_to_f_mm() -> float:
    """Return the distance of F down from the ridge: the angle D, E, F bends by the known angle."""
    slope, fall = math.radians(SLOPE_DEG), math.tan(math.radians(_BEND_DEG - SLOPE_DEG))
    before = SLOPE_MM - _ON_SLOPE_MM[1]
    return before * (math.sin(slope) + fall * math.cos(slope)) / (math.sin(slope) - fall * math.cos(slope))


def measure_dimensions(positions_m: FloatArray) -> FloatArray:
    """Return the dimensions (6,) in degrees and mm from disc positions (6, 3) in any axes."""
    a, b, c, d, e, f = positions_m
    up = np.cross(b - a, c - a)
    up = up / np.linalg.norm(up)
    if (e - a) @ up < 0.0:
        up = -up
    slope = math.degrees(math.asin(float(np.clip((e - d) @ up / np.linalg.norm(e - d), -1.0, 1.0))))
    lengths = (np.linalg.norm(b - a), np.linalg.norm(c - a), (e - a) @ up)
    angles = (slope, _angle_between_deg(e - d, f - e), _angle_between_deg(b - a, c - a))
    return np.array([*angles, *(1e3 * float(length) for length in lengths)])


def _angle_between_deg(one: FloatArray, other: FloatArray) -> float:
    share = float(one @ other / (np.linalg.norm(one) * np.linalg.norm(other)))
    return math.degrees(math.acos(float(np.clip(share, -1.0, 1.0))))


def card_sheets(paper: Paper) -> tuple[PrintedSheet, PrintedSheet]:
    """Return the card and the wedge to cut out and fold."""
    return card_sheet(paper), wedge_sheet(paper)


CARD_CORNER_MM = (62.0, 60.0)
"""Disc A on the sheet."""


def card_sheet(paper: Paper) -> PrintedSheet:
    """Return the flat sheet."""
    width_mm, height_mm = PAPER_MM[paper]
    x0, y0 = CARD_CORNER_MM
    flat = disc_positions_m()[:3, :2] * 1e3
    discs = [SheetDisc(x0 + float(x), y0 + float(y), DISC_RADIUS_MM, BLUE) for x, y in flat]
    left, top = x0 + FOOT_CORNER_MM[0], y0 + FOOT_CORNER_MM[1]
    right, bottom = left + WIDTH_MM, top + FOOT_MM
    corners = [(left, top), (right, top), (right, bottom), (left, bottom)]
    foot = [SheetLine(one, other, dashed=True) for one, other in zip(corners, corners[1:] + corners[:1], strict=True)]
    steps = (
        phrase("1. Print both pages at 100 % on plain white paper. Check the rulers: 100 mm."),
        phrase("2. Glue this page flat on stiff card. Fold the wedge and glue it onto the dashed field."),
        phrase("3. Lay it flat under the camera, about 60 cm away, and run the check for 30 seconds."),
    )
    texts = [
        SheetText(phrase("Carpus check card"), 20.0, 20.0, 14.0, bold=True),
        *(SheetText(step, 20.0, 28.0 + 5.0 * k) for k, step in enumerate(steps)),
        SheetText(phrase("side of the wedge with two markers"), left + 1.0, top + 5.0, 7.0),
        SheetText(phrase("side of the wedge with one marker"), left + 4.0, bottom - 2.5, 7.0),
    ]
    return PrintedSheet(width_mm, height_mm, (*discs, *foot, *texts, *ruler_items(20.0, height_mm - 14.0)))


WEDGE_CORNER_MM = (80.0, 22.0)
"""Upper left corner of the slope on the sheet."""


def wedge_sheet(paper: Paper) -> PrintedSheet:
    """Return the unfolded wedge: faces, foot, tab and flaps."""
    width_mm, height_mm = PAPER_MM[paper]
    left, top = WEDGE_CORNER_MM
    right, middle = left + WIDTH_MM, left + 0.5 * WIDTH_MM
    folds = [top + SLOPE_MM, top + 2.0 * SLOPE_MM, top + 2.0 * SLOPE_MM + FOOT_MM]
    end = folds[-1] + _TAB_MM
    items: list[SheetItem] = [SheetDisc(middle, top + s, DISC_RADIUS_MM, BLUE) for s in _ON_SLOPE_MM]
    items.append(SheetDisc(middle, folds[0] + _ridge_to_f_mm(), DISC_RADIUS_MM, BLUE))
    items += [SheetLine((left, y), (right, y), dashed=True) for y in folds]
    items += [SheetLine((left, top), (right, top)), SheetLine((left + 4.0, end), (right - 4.0, end))]
    for edge, outwards in ((left, -1.0), (right, 1.0)):
        apex = (edge + outwards * HEIGHT_MM, folds[1] + 0.5 * FOOT_MM)
        items += [
            SheetLine((edge, top), (edge, folds[1])),
            SheetLine((edge, folds[1]), (edge, folds[2]), dashed=True),
            SheetLine((edge, folds[1]), apex),
            SheetLine(apex, (edge, folds[2])),
            SheetLine((edge, folds[2]), (edge - outwards * 4.0, end)),
        ]
    texts = [
        SheetText(phrase("Wedge: cut along the lines, fold back along the dashes"), 20.0, 16.0, 11.0, bold=True),
        SheetText("30°", left + 3.0, folds[0] - 3.0, 8.0),
        SheetText("30°", left + 3.0, folds[0] + 5.0, 8.0),
        SheetText(phrase("foot: glue onto the card"), left + 3.0, folds[1] + 0.5 * FOOT_MM, 8.0),
        SheetText(phrase("glue under the low edge"), left + 6.0, end - 3.0, 8.0),
    ]
    return PrintedSheet(width_mm, height_mm, (*items, *texts, *ruler_items(20.0, height_mm - 14.0)))


CHECK_S = 30.0
"""Duration of a check."""
MAX_ANGLE_ERROR_DEG, MAX_LENGTH_ERROR_MM, MAX_SCALE_ERROR = 2.0, 2.5, 0.012
"""Limits of the largest error of an angle, a length, and the scale; less exact sensors have wider ones."""


@dataclass(frozen=True, slots=True)
class CardReading:
    """Result of one check: dimensions (6,) in degrees and millimetres.

    ``sd`` (6,) is that of one frame, ``scale`` that of all distances, measured over true.
    """

    measured: FloatArray
    sd: FloatArray
    scale: float
    distance_m: float
    frames_used: int
    max_angle_error_deg: float = MAX_ANGLE_ERROR_DEG
    max_length_error_mm: float = MAX_LENGTH_ERROR_MM

    @property
    def errors(self) -> FloatArray:
        """Measured less true (6,)."""
        return np.asarray(self.measured - np.array([figure.true_value for figure in DIMENSIONS]))

    @property
    def angle_error_deg(self) -> float:
        return float(np.abs(self.errors[:3]).max())

    @property
    def length_error_mm(self) -> float:
        return float(np.abs(self.errors[3:]).max())

    @property
    def has_valid_angles(self) -> bool:
        return self.angle_error_deg <= self.max_angle_error_deg

    @property
    def has_valid_lengths(self) -> bool:
        """True if lengths are within their limits, each and as a scale."""
        return self.length_error_mm <= self.max_length_error_mm and abs(self.scale - 1.0) <= MAX_SCALE_ERROR

    @property
    def is_within_tolerance(self) -> bool:
        return self.has_valid_angles and self.has_valid_lengths


def verdict_sentence(reading: CardReading) -> Phrase:
    """Return the result of a check for people."""
    angle, length = format_rounded(reading.angle_error_deg, 1), format_rounded(reading.length_error_mm, 1)
    limits = {
        "most_angle": format_rounded(reading.max_angle_error_deg, 1),
        "most_length": format_rounded(reading.max_length_error_mm, 1),
    }
    if reading.is_within_tolerance:
        return phrase(
            "Camera within tolerance: errors up to {angle}° and {length} mm (limits: {most_angle}° and {most_length} "
            "mm).",
            angle=angle,
            length=length,
            **limits,
        )
    angles = phrase("angles are wrong by {angle}°", angle=angle)
    share = 100.0 * (reading.scale - 1.0)
    off = {"share": format_rounded(abs(share), 1), "length": length}
    lengths = phrase("all lengths are {share} % too short, by up to {length} mm", **off)
    if share > 0:
        lengths = phrase("all lengths are {share} % too long, by up to {length} mm", **off)
    what = angles if reading.has_valid_lengths else lengths
    if not reading.has_valid_lengths and not reading.has_valid_angles:
        what = phrase("{one}; {other}", one=lengths, other=angles)
    return phrase(
        "Camera out of tolerance: {what} (limits: {most_angle}°, {most_length} mm, all lengths {most_share} %).",
        what=what,
        most_share=format_rounded(100.0 * MAX_SCALE_ERROR, 1),
        **limits,
    )

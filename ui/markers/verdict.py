"""The verdict of the calibration as five rows: state, thing, value, limit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.calibration.result import CalibrationFinding, Verdict
from carpus.core.rounding import written
from carpus.ui import numbers
from carpus.ui.controls.card import Card, Line
from carpus.ui.controls.layouts import in_grid, in_line
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, ElidedText, StateText, Text
from carpus.ui.icons import State
from carpus.ui.numbers import NARROW_GAP, UNKNOWN
from carpus.ui.ports import VerdictLimits
from carpus.ui.theme import Theme
from carpus.ui.translate import tr

MARKER_FINDINGS = (
    "click_on_no_marker",
    "two_clicks_on_one",
    "swapped",
    "misnamed",
    "shifted",
    "wrong_side",
    "no_depth",
    "residual",
    "depth_off",
    "other_spot",
    "spare_spot",
    "near_spot",
    "no_palm",
)
NAMES_WRONG = ("shifted", "swapped", "misnamed", "wrong_side")
DISC_DOUBTED = ("other_spot", "no_palm", "spare_spot", "near_spot")
STILL_FINDINGS = ("moved", "few_frames")


@dataclass(frozen=True, slots=True)
class Row:
    """One line of the panel."""

    state: State
    thing: str
    value: str
    limit: str


def rows_before(done: int, asked: int, limits: VerdictLimits, *, proposed: bool = False) -> list[Row]:
    """What can be said while markers are still being clicked, or their names are ``proposed`` only."""
    pattern = tr("{done} of {asked} found") if proposed else tr("{done} of {asked}")
    count = pattern.format(done=done, asked=asked)
    return [
        Row("good" if done and not proposed else "open", tr("Markers"), count, _within(limits)),
        Row("open", tr("Distance"), "", _distance(limits)),
        Row("open", tr("Camera tilt"), "", _tilt(limits)),
        Row("open", tr("Hand"), "", tr("flat and still")),
        Row("open", tr("Hand length"), "", _length(limits)),
    ]


def rows_of(verdict: Verdict, limits: VerdictLimits) -> list[Row]:
    """The judged calibration."""
    kinds = {finding.kind: finding for finding in verdict.findings}
    marker_faults = [kinds[kind] for kind in MARKER_FINDINGS if kind in kinds]
    count = len(verdict.residual_mm)
    worst = float(np.nanmax(verdict.residual_mm)) if np.isfinite(verdict.residual_mm).any() else math.nan
    markers = tr("{count} of {count}").format(count=count)
    if kinds.keys() & set(NAMES_WRONG):
        markers = tr("names wrong")
    elif kinds.keys() & set(DISC_DOUBTED):
        markers = tr("one doubted")
    elif any(fault.blocks for fault in marker_faults):
        markers = tr("{count} not found").format(count=len({name for fault in marker_faults for name in fault.markers}))
    elif math.isfinite(worst):
        markers = tr("within {size} mm").format(size=numbers.fixed(worst, 1))
    still = [kinds[kind] for kind in STILL_FINDINGS if kind in kinds]
    hand = tr("moved") if "moved" in kinds else tr("still, flat") if verdict.frames_used else UNKNOWN
    pictures = tr("for {count} pictures").format(count=verdict.frames_used) if verdict.frames_used else ""
    distance = _state(kinds.get("distance"), verdict.distance_m)
    tilt = _state(kinds.get("tilt"), verdict.tilt_deg)
    length = _state(
        kinds.get("other_length") or kinds.get("hand_length") or kinds.get("other_spot") or kinds.get("no_palm"),
        verdict.hand_length_mm,
    )
    return [
        Row(_worst(marker_faults), tr("Markers"), markers, _within(limits)),
        Row(distance, tr("Distance"), _cm(verdict.distance_m), _distance(limits)),
        Row(tilt, tr("Camera tilt"), _degrees(verdict.tilt_deg), _tilt(limits)),
        Row(_worst(still) if verdict.frames_used else "open", tr("Hand"), hand, pictures),
        Row(length, tr("Hand length"), _mm(verdict.hand_length_mm), _length(limits)),
    ]


class VerdictPanel(Card):
    """Card with a headline and the rows."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 16)
        self._theme = theme
        self.headline = Text(theme, "", 16, SEMIBOLD)
        self.sign = StateText(theme)
        self.body.addLayout(in_line((self.headline, 1), self.sign))
        self.body.setSpacing(0)
        self._grid = in_grid(10, 0, shares=(0, 0, 1), margins=(0, 8, 0, 0))
        self.body.addLayout(self._grid)
        self._lines: list[tuple[StateText, Text, Text, Text]] = []
        self._close = False

    def show_rows(self, headline: str, state: State, rows: Sequence[Row]) -> None:
        self.headline.setText(headline)
        self.sign.show_state(state, "")
        while len(self._lines) < len(rows):
            self._add_line()
        for (icon, thing, value, limit), row in zip(self._lines, rows, strict=True):
            icon.show_state(row.state, "")
            words = {"good": self.tr("good"), "warn": self.tr("doubtful"), "bad": self.tr("wrong")}
            icon.setAccessibleName(words.get(row.state, self.tr("open")))
            thing.setText(row.thing)
            value.setText(row.value)
            limit.setText(row.limit)

    def _add_line(self) -> None:
        place = 2 * len(self._lines)
        line = Line(self._theme)
        self._grid.addWidget(line, place, 0, 1, 4)
        icon = StateText(self._theme, icon_px=16)
        cells = (
            icon, Text(self._theme, "", 14, REGULAR, "text2"), Text(self._theme, "", 14, SEMIBOLD),
            ElidedText(self._theme, "", 12, MEDIUM, "text2"),
        )  # fmt: skip
        for column, cell in enumerate(cells):
            self._grid.addWidget(cell, place + 1, column)
        self._lines.append(cells)
        self.show_close(self._close)

    def show_close(self, close: bool) -> None:
        """Rows as near to each other as their texts allow, where large text leaves little room."""
        self._close = close
        for number in range(len(self._lines)):
            self._grid.setRowMinimumHeight(2 * number + 1, 0 if close else self._theme.px(29))
        self._grid.setContentsMargins(0, 2 if close else 8, 0, 0)
        self.body.invalidate()  # how high it is now is asked at once
        self.updateGeometry()

    def states(self) -> list[State]:
        return [line[0].state for line in self._lines]


def headline(verdict: Verdict) -> tuple[str, State]:
    """``Ready``, ``Doubtful`` or ``Cannot start yet``."""
    if verdict.is_good:
        return tr("Ready"), "good"
    return (tr("Doubtful"), "warn") if verdict.can_start else (tr("Cannot start yet"), "bad")


def _worst(findings: Sequence[CalibrationFinding]) -> State:
    if not findings:
        return "good"
    serious = any(finding.blocks or finding.kind in NAMES_WRONG for finding in findings)
    return "bad" if serious else "warn"


def _state(finding: CalibrationFinding | None, value: float) -> State:
    if not math.isfinite(value):
        return "open"
    return "good" if finding is None else "bad" if finding.blocks else "warn"


def _within(limits: VerdictLimits) -> str:
    return tr("each within {size} mm").format(size=numbers.figures(limits.most_residual_mm, 6))


def _distance(limits: VerdictLimits) -> str:
    return tr("{distance} or more").format(distance=_cm(limits.least_distance_m))


def _tilt(limits: VerdictLimits) -> str:
    return tr("up to {angle}").format(angle=_degrees(limits.most_tilt_deg))


def _length(limits: VerdictLimits) -> str:
    low, high = limits.hand_length_mm
    return tr("usual {low}–{high} mm").format(low=written(low), high=written(high))


def _cm(value_m: float) -> str:
    return f"{written(100 * value_m)}{NARROW_GAP}cm" if math.isfinite(value_m) else UNKNOWN


def _mm(value_mm: float) -> str:
    return f"{written(value_mm)}{NARROW_GAP}mm" if math.isfinite(value_mm) else UNKNOWN


def _degrees(value_deg: float) -> str:
    return f"{written(value_deg)}°" if math.isfinite(value_deg) else UNKNOWN

"""The verdict of the calibration as five rows: state, item, value, limit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.calibration.result import CalibrationFinding, Verdict
from carpus.core.model.rounding import format_rounded
from carpus.ui.kit import numbers
from carpus.ui.kit.card import Card, Separator
from carpus.ui.kit.icons import State
from carpus.ui.kit.layouts import grid_layout, row_layout
from carpus.ui.kit.numbers import NARROW_GAP, UNKNOWN
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, ElidedText, StateText, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.shell.view_models import CalibrationLimits

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
LABEL_FINDINGS = ("shifted", "swapped", "misnamed", "wrong_side")
DOUBT_FINDINGS = ("other_spot", "no_palm", "spare_spot", "near_spot")
STILL_FINDINGS = ("moved", "few_frames")


@dataclass(frozen=True, slots=True)
class VerdictRow:
    """One row of the panel."""

    state: State
    thing: str
    value: str
    limit: str


def pending_rows(done: int, asked: int, limits: CalibrationLimits, *, proposed: bool = False) -> list[VerdictRow]:
    """Return the rows while markers are being labelled, or their labels are only ``proposed``."""
    pattern = tr("{done} of {asked} found") if proposed else tr("{done} of {asked}")
    count = pattern.format(done=done, asked=asked)
    return [
        VerdictRow("good" if done and not proposed else "open", tr("Markers"), count, _residual_limit(limits)),
        VerdictRow("open", tr("Distance"), "", _distance_limit(limits)),
        VerdictRow("open", tr("Camera tilt"), "", _tilt_limit(limits)),
        VerdictRow("open", tr("Hand"), "", tr("flat and still")),
        VerdictRow("open", tr("Hand length"), "", _length_limit(limits)),
    ]


def verdict_rows(verdict: Verdict, limits: CalibrationLimits) -> list[VerdictRow]:
    """Return the rows of an assessed calibration."""
    kinds = {finding.kind: finding for finding in verdict.findings}
    marker_faults = [kinds[kind] for kind in MARKER_FINDINGS if kind in kinds]
    count = len(verdict.residual_mm)
    worst = float(np.nanmax(verdict.residual_mm)) if np.isfinite(verdict.residual_mm).any() else math.nan
    markers = tr("{count} of {count}").format(count=count)
    if kinds.keys() & set(LABEL_FINDINGS):
        markers = tr("labels wrong")
    elif kinds.keys() & set(DOUBT_FINDINGS):
        markers = tr("1 uncertain")
    elif any(fault.blocks for fault in marker_faults):
        markers = tr("{count} not found").format(count=len({name for fault in marker_faults for name in fault.markers}))
    elif math.isfinite(worst):
        markers = tr("within {size} mm").format(size=numbers.format_fixed(worst, 1))
    still = [kinds[kind] for kind in STILL_FINDINGS if kind in kinds]
    hand = tr("moved") if "moved" in kinds else tr("still, flat") if verdict.frames_used else UNKNOWN
    pictures = tr("for {count} frames").format(count=verdict.frames_used) if verdict.frames_used else ""
    distance = _finding_state(kinds.get("distance"), verdict.distance_m)
    tilt = _finding_state(kinds.get("tilt"), verdict.tilt_deg)
    length = _finding_state(
        kinds.get("other_length") or kinds.get("hand_length") or kinds.get("other_spot") or kinds.get("no_palm"),
        verdict.hand_length_mm,
    )
    return [
        VerdictRow(_summary_state(marker_faults), tr("Markers"), markers, _residual_limit(limits)),
        VerdictRow(distance, tr("Distance"), _cm(verdict.distance_m), _distance_limit(limits)),
        VerdictRow(tilt, tr("Camera tilt"), _degrees(verdict.tilt_deg), _tilt_limit(limits)),
        VerdictRow(_summary_state(still) if verdict.frames_used else "open", tr("Hand"), hand, pictures),
        VerdictRow(length, tr("Hand length"), _mm(verdict.hand_length_mm), _length_limit(limits)),
    ]


class VerdictPanel(Card):
    """Card with a headline and the rows."""

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 16)
        self._theme = theme
        self.headline = Text(theme, "", 16, SEMIBOLD)
        self.sign = StateText(theme)
        self.body.addLayout(row_layout((self.headline, 1), self.sign))
        self.body.setSpacing(0)
        self._grid = grid_layout(10, 0, stretches=(0, 0, 1), margins=(0, 8, 0, 0))
        self.body.addLayout(self._grid)
        self._lines: list[tuple[StateText, Text, Text, Text]] = []
        self._is_dense = False

    def show_rows(self, headline: str, state: State, rows: Sequence[VerdictRow]) -> None:
        self.headline.setText(headline)
        self.sign.show_state(state, "")
        while len(self._lines) < len(rows):
            self._add_line()
        for (icon, thing, value, limit), row in zip(self._lines, rows, strict=True):
            icon.show_state(row.state, "")
            words = {"good": self.tr("good"), "warn": self.tr("uncertain"), "bad": self.tr("wrong")}
            icon.setAccessibleName(words.get(row.state, self.tr("open")))
            thing.setText(row.thing)
            value.setText(row.value)
            limit.setText(row.limit)

    def _add_line(self) -> None:
        place = 2 * len(self._lines)
        line = Separator(self._theme)
        self._grid.addWidget(line, place, 0, 1, 4)
        icon = StateText(self._theme, icon_px=16)
        cells = (
            icon, Text(self._theme, "", 14, REGULAR, "text2"), Text(self._theme, "", 14, SEMIBOLD),
            ElidedText(self._theme, "", 12, MEDIUM, "text2"),
        )  # fmt: skip
        for column, cell in enumerate(cells):
            self._grid.addWidget(cell, place + 1, column)
        self._lines.append(cells)
        self.set_dense(self._is_dense)

    def set_dense(self, dense: bool) -> None:
        """Move rows closer together, for large text."""
        self._is_dense = dense
        for number in range(len(self._lines)):
            self._grid.setRowMinimumHeight(2 * number + 1, 0 if dense else self._theme.px(29))
        self._grid.setContentsMargins(0, 2 if dense else 8, 0, 0)
        self.body.invalidate()  # how high it is now is asked at once
        self.updateGeometry()

    def states(self) -> list[State]:
        return [line[0].state for line in self._lines]


def headline(verdict: Verdict) -> tuple[str, State]:
    """Return ``Ready``, ``Uncertain`` or ``Cannot start yet`` with its state."""
    if verdict.is_good:
        return tr("Ready"), "good"
    return (tr("Uncertain"), "warn") if verdict.can_start else (tr("Cannot start yet"), "bad")


def _summary_state(findings: Sequence[CalibrationFinding]) -> State:
    if not findings:
        return "good"
    serious = any(finding.blocks or finding.kind in LABEL_FINDINGS for finding in findings)
    return "bad" if serious else "warn"


def _finding_state(finding: CalibrationFinding | None, value: float) -> State:
    if not math.isfinite(value):
        return "open"
    return "good" if finding is None else "bad" if finding.blocks else "warn"


def _residual_limit(limits: CalibrationLimits) -> str:
    return tr("each within {size} mm").format(size=numbers.format_significant(limits.max_residual_mm, 6))


def _distance_limit(limits: CalibrationLimits) -> str:
    return tr("{distance} or more").format(distance=_cm(limits.min_distance_m))


def _tilt_limit(limits: CalibrationLimits) -> str:
    return tr("up to {angle}").format(angle=_degrees(limits.max_tilt_deg))


def _length_limit(limits: CalibrationLimits) -> str:
    low, high = limits.hand_length_mm
    return tr("typical {low}–{high} mm").format(low=format_rounded(low), high=format_rounded(high))


def _cm(value_m: float) -> str:
    return f"{format_rounded(100 * value_m)}{NARROW_GAP}cm" if math.isfinite(value_m) else UNKNOWN


def _mm(value_mm: float) -> str:
    return f"{format_rounded(value_mm)}{NARROW_GAP}mm" if math.isfinite(value_mm) else UNKNOWN


def _degrees(value_deg: float) -> str:
    return f"{format_rounded(value_deg)}°" if math.isfinite(value_deg) else UNKNOWN

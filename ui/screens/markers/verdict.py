"""The verdict of the calibration as five rows: state, item, value."""

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
from carpus.ui.kit.text import REGULAR, SEMIBOLD, StateText, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr

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


def verdict_rows(verdict: Verdict) -> list[VerdictRow]:
    """Return the rows of an assessed calibration."""
    kinds = {finding.kind: finding for finding in verdict.findings}
    marker_faults = [kinds[kind] for kind in MARKER_FINDINGS if kind in kinds]
    count = len(verdict.residual_mm)
    worst = float(np.nanmax(verdict.residual_mm)) if np.isfinite(verdict.residual_mm).any() else math.nan
    markers = tr("all {count} found").format(count=count)
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
    distance = _finding_state(kinds.get("distance"), verdict.distance_m)
    tilt = _finding_state(kinds.get("tilt"), verdict.tilt_deg)
    length = _finding_state(
        kinds.get("other_length") or kinds.get("hand_length") or kinds.get("other_spot") or kinds.get("no_palm"),
        verdict.hand_length_mm,
    )
    return [
        VerdictRow(_summary_state(marker_faults), tr("Markers"), markers),
        VerdictRow(distance, tr("Distance"), _cm(verdict.distance_m)),
        VerdictRow(tilt, tr("Camera tilt"), _degrees(verdict.tilt_deg)),
        VerdictRow(_summary_state(still) if verdict.frames_used else "open", tr("Hand"), hand),
        VerdictRow(length, tr("Hand length"), _mm(verdict.hand_length_mm)),
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
        self._lines: list[tuple[StateText, Text, Text]] = []
        self._rules: list[Separator] = []

    def show_rows(self, headline: str, state: State, rows: Sequence[VerdictRow]) -> None:
        self.headline.setText(headline)
        self.sign.show_state(state, "")
        while len(self._lines) < len(rows):
            self._add_line()
        for (icon, thing, value), row in zip(self._lines, rows, strict=True):
            icon.show_state(row.state, "")
            words = {"good": self.tr("good"), "warn": self.tr("uncertain"), "bad": self.tr("wrong")}
            icon.setAccessibleName(words.get(row.state, self.tr("open")))
            thing.setText(row.thing)
            value.setText(row.value)

    def _add_line(self) -> None:
        place = 2 * len(self._lines)
        line = Separator(self._theme)
        self._rules.append(line)
        self._grid.addWidget(line, place, 0, 1, 3)
        icon = StateText(self._theme, icon_px=16)
        cells = (
            icon, Text(self._theme, "", 14, REGULAR, "text2"), Text(self._theme, "", 14, SEMIBOLD),
        )  # fmt: skip
        for column, cell in enumerate(cells):
            self._grid.addWidget(cell, place + 1, column)
        self._lines.append(cells)
        self._grid.setRowMinimumHeight(place + 1, self._theme.px(29))

    def show_all(self, shown: bool) -> None:
        """Show all rows, or only those that are not good."""
        for number, (rule, cells) in enumerate(zip(self._rules, self._lines, strict=True)):
            visible = shown or cells[0].state != "good"
            for part in (rule, *cells):
                part.setVisible(visible)
            self._grid.setRowMinimumHeight(2 * number + 1, self._theme.px(29) if visible else 0)

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


def _cm(value_m: float) -> str:
    return f"{format_rounded(100 * value_m)}{NARROW_GAP}cm" if math.isfinite(value_m) else UNKNOWN


def _mm(value_mm: float) -> str:
    return f"{format_rounded(value_mm)}{NARROW_GAP}mm" if math.isfinite(value_mm) else UNKNOWN


def _degrees(value_deg: float) -> str:
    return f"{format_rounded(value_deg)}°" if math.isfinite(value_deg) else UNKNOWN

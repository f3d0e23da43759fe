"""The column beside the frame: the present step, the checks of the calibration, and how to continue."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QSpinBox, QVBoxLayout, QWidget

from carpus.core.calibration.calibrate import MeasuredHand
from carpus.core.calibration.hand_calibrator import HandCalibrator
from carpus.core.calibration.result import ALL_STRAIGHT, CalibrationFinding, Verdict
from carpus.core.model.fault_text import marker_name
from carpus.core.model.hand.exercises import DIRECTIONS, PRONOSUPINATION, get_exercise
from carpus.core.model.hand.forearm_rotation import pronosupination_from_palm_down, to_clinical_wrist_angles
from carpus.core.model.rounding import format_rounded, round_half_away
from carpus.core.model.types import FloatArray
from carpus.ui.kit import numbers
from carpus.ui.kit.button import ENTER_KEY, Button
from carpus.ui.kit.card import Card, Separator
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.field import ChoiceRow, number_field
from carpus.ui.kit.icons import State
from carpus.ui.kit.layouts import STRETCH, column_layout, fill, grid_layout, row_layout
from carpus.ui.kit.numbers import NARROW_GAP, UNKNOWN
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, StateText, Text, heading
from carpus.ui.kit.theme import MARGIN_PX, Theme
from carpus.ui.kit.translate import tr, translate_phrase
from carpus.ui.picture.hand_drawing import HandDrawing, MarkerState
from carpus.ui.screens.markers.labelling import LabelState, Remedy, find_faulty_markers
from carpus.ui.screens.tour.bubble import MIN_SCREEN_PX, BubbleView
from carpus.ui.words import terms
from carpus.ui.words.fault_words import finding_words
from carpus.ui.words.terms import click_instruction, finger_name, marker_placement, marker_title

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
COLUMN_PX = 376


class GuidancePanel(QWidget):
    """Instructions and checks; of constant width, so that the frame never moves under the cursor."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.step_label = StateText(theme, 14, MEDIUM)
        self.title_label = heading(theme, wrap=True)
        self.instruction_label = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.hand_drawing = HandDrawing(theme)
        self.straight_fingers = StraightFingers(theme)
        self.straight_fingers.hide()
        self.verdict_panel = VerdictPanel(theme)
        self.bubble = BubbleView(theme)
        self.primary_button = Button(theme, "", "primary")
        self.second_button = Button(theme, "", "plain", height_px=52)
        self._column = column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        fill(column, 8, self.step_label, self.title_label, self.instruction_label, (self.hand_drawing, 1))
        column.addStretch(0)  # where the drawing has given way its room stays in one piece
        fill(column, self.straight_fingers, self.verdict_panel, 8, self.bubble)
        column.addLayout(row_layout((self.primary_button, 1), self.second_button, gap=12))

    def fit(self, height_px: int, *, clicks: bool) -> None:
        """Hide what has no room: the drawing, unless it says where to click (``clicks``), the bubble, good checks."""
        self.setFixedWidth(self._theme.px(COLUMN_PX))
        self.bubble.set_room(height_px >= MIN_SCREEN_PX * self._theme.text_scale)
        self.hand_drawing.show()
        self.verdict_panel.show_all(True)
        if 0 < height_px < self._min_height_px():
            self.hand_drawing.setVisible(clicks)
            self.bubble.set_room(self._min_height_px() <= height_px)
            self.verdict_panel.show_all(self._min_height_px() <= height_px)

    def _min_height_px(self) -> int:
        self._column.invalidate()
        return self._column.minimumHeightForWidth(self._theme.px(COLUMN_PX)) + 2 * (MARGIN_PX - 4)

    def _show_step(self, state: State, step: str, title: str, instruction: str) -> None:
        self.step_label.show_state(state, step, token=state if state in ("warn", "bad") else "text2")
        self.title_label.setText(title)
        self.instruction_label.setText(instruction)

    def show_preview(self, calibrator: HandCalibrator) -> None:
        self._show_step(
            "none",
            self.tr("Image"),
            self.tr("Lay the hand flat and still"),
            self.tr("Palm down, fingers as straight as possible, forearm in line. Then take the image."),
        )
        self.hand_drawing.show_markers(calibrator.side, dict.fromkeys(calibrator.protocol.markers, "later"))
        self.verdict_panel.hide()
        self.primary_button.setEnabled(True)
        self.primary_button.set_label(self.tr("Take the image"), icon="", hint=ENTER_KEY)
        self.second_button.hide()

    def show_labelling(self, labels: LabelState, *, sees_none: bool, is_proposing: bool) -> None:
        """Show the next marker, or that the markers are being checked.

        ``sees_none``: there are no candidates; ``is_proposing``: labels are being proposed.
        """
        markers, to_go = labels.protocol.markers, len(labels.missing)
        step = self.tr("Marker {number} of {asked}")
        step = step.format(number=markers.index(labels.current) + 1, asked=len(markers))
        title, instruction = click_instruction(labels.current), marker_placement(labels.current)
        state: State = "none"
        if labels.is_complete:  # nothing is left to click while they are checked
            state, step, title = "good", self.tr("All markers found"), self.tr("Checking the markers…")
            instruction = self.tr("Hold the hand in this position until measuring begins.")
        elif sees_none:  # said at once, before anybody looks for what is not there
            state, step = "warn", self.tr("No blue marker in the image")
            title = self.tr("No blue marker is visible")
            instruction = self.tr(
                "No markers found. Check that they are on the hand, the hand is in view and the light is good."
            )
        left = self.tr("1 marker left to click") if to_go == 1 else self.tr("{count} markers left to click")
        words = self.tr("Start measuring · {left}").format(left=left.format(count=to_go))
        primary = words if to_go else self.tr("Checking the markers…")
        can_accept = not is_proposing and bool(labels.proposals)
        if is_proposing:
            state, step = "none", self.tr("Looking for the markers…")
        elif can_accept:
            state, step, title, instruction, primary = proposal_words(labels)
        self._show_step(state, step, title, instruction)
        self.hand_drawing.show_markers(labels.side, _hand_states(labels, ()))
        self.verdict_panel.hide()
        self.primary_button.setEnabled(can_accept)
        self.primary_button.set_label(primary, icon="", hint=ENTER_KEY if can_accept else "")
        self.second_button.set_label(self.tr("Click the markers"), hint="C")
        self.second_button.setVisible(can_accept)

    def show_verdict(self, labels: LabelState, outcome: MeasuredHand, remedy: Remedy) -> None:
        """Show the checks and the most likely remedy."""
        verdict = outcome.verdict
        words, state = headline(verdict)
        self.hand_drawing.show_markers(labels.side, _hand_states(labels, find_faulty_markers(verdict)))
        said = words if verdict.is_good else self.tr("Checks")
        self.verdict_panel.show_rows(said, state, verdict_rows(verdict))
        self.verdict_panel.show()
        self.primary_button.setEnabled(True)
        if verdict.is_good:
            hold = self.tr("Hold the hand in this position until measuring begins.")
            self._show_step("good", self.tr("All markers found"), self.tr("Ready to measure"), hold)
            self.primary_button.set_label(self.tr("Start measuring"), icon="play", hint=ENTER_KEY)
            self.second_button.hide()
        else:
            first = max(
                verdict.findings,
                key=lambda finding: (finding.blocks, finding.kind in LABEL_FINDINGS, finding.kind in DOUBT_FINDINGS),
            )
            told = finding_words(first)
            instruction = " ".join(part for part in (told.data_safety, told.remedy) if part)
            self._show_step(state, words, told.summary.rstrip("."), instruction)
            words, key = {
                "swap": (self.tr("Swap the two"), ENTER_KEY), "click_these": (self.tr("Click the marker again"), "C"),
                "correct": (self.tr("Correct labels"), ""), "take_spot": (self.tr("Use that spot"), ""),
                "new_picture": (self.tr("New image"), "N"),
            }[remedy]  # fmt: skip
            self.primary_button.set_label(words, icon="", hint=key)
            swap = remedy == "swap"
            self.second_button.set_label(
                self.tr("Correct labels") if swap else self.tr("Start anyway (&uncertain)"), hint=""
            )
            self.second_button.setVisible(swap or verdict.can_start)
        self.primary_button.setFocus(Qt.FocusReason.OtherFocusReason)


def _hand_states(labels: LabelState, wrong: Sequence[str]) -> dict[str, MarkerState]:
    states: dict[str, MarkerState] = {}
    for name in labels.protocol.markers:
        states[name] = "wrong" if name in wrong else "done" if name in labels.confirmed_px else "later"
    for name, one in labels.proposals.items():
        states[name] = "proposed" if one.is_sure else "doubtful"
    if (labels.missing and not labels.proposals) or labels.current in labels.open_markers:
        states[labels.current] = "next"
    return states


MAX_NAMED = 4
"""Up to this many markers are listed by name."""


def proposal_words(labels: LabelState) -> tuple[State, str, str, str, str]:
    """Return state, step, title, instruction and button: which labels need a look, and what Enter does."""
    asked, open_names, doubtful = len(labels.protocol.markers), labels.open_markers, labels.doubtful
    named = len(labels.proposals)
    primary = tr("Labels are correct") if not open_names else tr("Accept {count} labels").format(count=named)
    if not open_names and not doubtful:
        whole = tr("All {count} markers found").format(count=asked)
        todo = tr("Drag a label to another marker to change it.")
        if labels.protocol.has_fingers:
            todo = tr(
                "The line of each finger should run from the wrist to the fingertip. To change a label, drag it to "
                "another marker."
            )
        return "good", whole, tr("Are these labels correct?"), todo, primary
    if doubtful:
        step = (
            tr("1 label is uncertain")
            if len(doubtful) == 1
            else tr("{count} labels are uncertain").format(count=len(doubtful))
        )
        todo = tr("Check: {markers}. Press Enter to accept, or drag a label to another marker.")
        title = tr("Is this the {marker}?").format(marker=marker_name(doubtful[0], translate_phrase))
        return "warn", step, title, todo.format(markers=_join_markers(doubtful)), tr("Yes, it is")
    step = tr("{named} of {asked} markers found").format(named=asked - len(open_names), asked=asked)
    todo = tr("Not found: {markers}. Press Enter to accept the others, then click these.")
    return "warn", step, click_instruction(labels.current), todo.format(markers=_join_markers(open_names)), primary


def _join_markers(names: tuple[str, ...]) -> str:
    words = [marker_title(names[0]), *(marker_name(name, translate_phrase) for name in names[1:])]
    if len(words) > MAX_NAMED:
        return tr("{markers} and {count} more").format(
            markers=", ".join(words[:MAX_NAMED]), count=len(words) - MAX_NAMED
        )
    return ", ".join(words)


def verdict_rows(verdict: Verdict) -> list[tuple[State, str, str]]:
    """Return state, item and value of each row of an assessed calibration."""
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
        (_summary_state(marker_faults), tr("Markers"), markers),
        (distance, tr("Distance"), _format_value(100 * verdict.distance_m, f"{NARROW_GAP}cm")),
        (tilt, tr("Camera tilt"), _format_value(verdict.tilt_deg, "°")),
        (_summary_state(still) if verdict.frames_used else "open", tr("Hand"), hand),
        (length, tr("Hand length"), _format_value(verdict.hand_length_mm, f"{NARROW_GAP}mm")),
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
        self.lines: list[tuple[StateText, Text, Text]] = []
        self._rules: list[Separator] = []

    def show_rows(self, headline: str, state: State, rows: Sequence[tuple[State, str, str]]) -> None:
        self.headline.setText(headline)
        self.sign.show_state(state, "")
        words = {"good": self.tr("good"), "warn": self.tr("uncertain"), "bad": self.tr("wrong")}
        while len(self.lines) < len(rows):
            self._add_line()
        for (icon, *texts), (row_state, *shown) in zip(self.lines, rows, strict=True):
            icon.show_state(row_state, "")
            icon.setAccessibleName(words.get(row_state, self.tr("open")))
            for text, word in zip(texts, shown, strict=True):
                text.setText(word)

    def _add_line(self) -> None:
        place = 2 * len(self.lines)
        line = Separator(self._theme)
        self._rules.append(line)
        self._grid.addWidget(line, place, 0, 1, 3)
        icon = StateText(self._theme, icon_px=16)
        cells = (
            icon, Text(self._theme, "", 14, REGULAR, "text2"), Text(self._theme, "", 14, SEMIBOLD),
        )  # fmt: skip
        for column, cell in enumerate(cells):
            self._grid.addWidget(cell, place + 1, column)
        self.lines.append(cells)
        self._grid.setRowMinimumHeight(place + 1, self._theme.px(29))

    def show_all(self, shown: bool) -> None:
        """Show all rows, or only those that are not good."""
        for number, (rule, cells) in enumerate(zip(self._rules, self.lines, strict=True)):
            visible = shown or cells[0].state != "good"
            for part in (rule, *cells):
                part.setVisible(visible)
            self._grid.setRowMinimumHeight(2 * number + 1, self._theme.px(29) if visible else 0)


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


def _format_value(value: float, unit: str) -> str:
    return f"{format_rounded(value)}{unit}" if math.isfinite(value) else UNKNOWN


class StraightFingers(QWidget):
    """Asks which fingers are straight; ``changed`` carries the answer, thumb to little finger."""

    changed = Signal(object)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._question = Text(theme, self.tr("Are the fingers straight?"), 14, SEMIBOLD)
        self._hint = Text(theme, "", 12, REGULAR, "text2", wrap=True)
        self.buttons: list[Button] = []
        grid = grid_layout(4, 4)
        for number in range(1, 6):
            button = Button(theme, finger_name(str(number)), "well", height_px=32)
            button.setCheckable(True)
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the keys 1 to 5 do it; Enter goes on
            button.clicked.connect(self._on_clicked)
            grid.addWidget(button, (number - 1) // 3, (number - 1) % 3)
            self.buttons.append(button)
        column_layout(self._question, grid, self._hint, gap=4, margins=(0, 0, 0, 0), parent=self)
        self.show_answer(ALL_STRAIGHT)

    @property
    def answer(self) -> tuple[bool, ...]:
        """True for each straight finger, thumb to little finger."""
        return tuple(not button.isChecked() for button in self.buttons)

    def show_answer(self, straight: tuple[bool, ...]) -> None:
        for button, lies_straight in zip(self.buttons, straight, strict=True):
            button.setChecked(not lies_straight)
        self._refresh()

    def _on_clicked(self) -> None:
        self._refresh()
        self.changed.emit(self.answer)

    def _refresh(self) -> None:
        for number, button in enumerate(self.buttons, start=1):
            finger = finger_name(str(number))
            button.set_label(self.tr("{finger} bent").format(finger=finger) if button.isChecked() else finger)
        self._hint.setText(
            self.tr("Click a finger that cannot fully extend (keys 1 to 5).")
            if all(self.answer)
            else self.tr("A bent finger is measured from its own resting position, which is less accurate.")
        )


MAX_DEG, MAX_TURN_DEG = 80, 110
FIELD_ORDER = (1, 0, 2)
"""Flexion first: contractures limit it most."""


class StartAngleDialog(Dialog):
    """Asks for three start angles with their directions; emits ``angles_entered`` with (3,) radians."""

    angles_entered = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 620)
        body = self.card.body
        words = self.tr(
            "Enter the wrist and forearm angles now, measured with a goniometer. Palm flat on the table is "
            "90° pronation. Carpus adds them to all wrist angles and notes it in the report. "
            "Bent fingers need no entry."
        )
        self.add_heading(self.tr("The wrist cannot reach neutral"), words, gap=16)
        self.fields: dict[int, tuple[ChoiceRow, QSpinBox]] = {}
        for column in FIELD_ORDER:
            direction = ChoiceRow(
                theme, [(name, terms.movement_name(name)) for name in DIRECTIONS[column]], DIRECTIONS[column][0]
            )
            value = number_field(theme, MAX_TURN_DEG if column == PRONOSUPINATION else MAX_DEG, "°")
            value.setAlignment(Qt.AlignmentFlag.AlignRight)
            value.setAccessibleName(terms.movement_name(DIRECTIONS[column][0]))
            body.addLayout(row_layout((direction, 1), value))
            self.fields[column] = (direction, value)
        straight = Button(theme, self.tr("Wrist is in neutral"), "plain", height_px=52)
        straight.clicked.connect(lambda: self._enter(np.zeros(3)))
        keep = Button(theme, self.tr("Use these angles"), "primary")
        keep.clicked.connect(lambda: self._enter(self.angles_rad()))
        self.set_default(keep)
        body.addLayout(row_layout(STRETCH, straight, keep))

    def open_angles(self, angles_rad: FloatArray) -> None:
        from_thumb_up_rad = to_clinical_wrist_angles(angles_rad, get_exercise("FOREARM_PS"), np.zeros(3))
        for column, (direction, value) in self.fields.items():
            shown_deg = math.degrees(from_thumb_up_rad[column])
            direction.choose(DIRECTIONS[column][0 if shown_deg >= 0 else 1])
            value.setValue(round_half_away(abs(shown_deg)))
        self.open(self.fields[FIELD_ORDER[0]][1])
        self.fields[FIELD_ORDER[0]][1].selectAll()

    def angles_rad(self) -> FloatArray:
        """Return deviation, flexion, pronosupination (3,) as in the files, entered from thumb up."""
        out = np.zeros(3)
        for column, (direction, value) in self.fields.items():
            sign = 1.0 if direction.value() == DIRECTIONS[column][0] else -1.0
            out[column] = sign * math.radians(value.value())
        out[PRONOSUPINATION] = pronosupination_from_palm_down(out[PRONOSUPINATION])
        return out

    def _enter(self, angles_rad: FloatArray) -> None:
        self.close_dialog()
        self.angles_entered.emit(angles_rad)

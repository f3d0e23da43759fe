"""The column beside the picture of the markers: what is to be done now, what the checks say, and how it goes on."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QSpinBox, QVBoxLayout, QWidget

from carpus.core.calibration.result import ALL_STRAIGHT
from carpus.core.hand.exercises import PRONOSUPINATION, SIDES, exercise_named
from carpus.core.hand.forearm_rotation import pronosupination_from_palm_down, read_wrist_angles
from carpus.core.rounding import rounded
from carpus.core.types import FloatArray
from carpus.core.words import marker_in_words
from carpus.ui import terms
from carpus.ui.controls.button import ENTER, Button
from carpus.ui.controls.field import Choices, number_field
from carpus.ui.controls.layouts import STRETCH, fill, in_column, in_grid, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, StateText, Text, heading
from carpus.ui.fault_words import finding_words
from carpus.ui.hand_drawing import HandDrawing, MarkerState
from carpus.ui.icons import State
from carpus.ui.marker_words import click_instruction, finger_name, marker_name, marker_place
from carpus.ui.markers.clicking import Clicking
from carpus.ui.markers.naming import Remedy, at_fault, face
from carpus.ui.markers.verdict import DISC_DOUBTED, NAMES_WRONG, VerdictPanel, headline, rows_before, rows_of
from carpus.ui.ports import Calibrator, Judged
from carpus.ui.theme import MARGIN_PX, Theme
from carpus.ui.tour.bubble import LEAST_SCREEN_PX, BubbleView
from carpus.ui.translate import say, tr

COLUMN_PX = 376
ALL_FITS_PX = 700
CROWDED_BELOW_PX = 460
GUIDED_MORE_PX = 60


class Guidance(QWidget):
    """Keeps its width whatever the words, so that the picture never moves under the cursor."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.step = StateText(theme, 14, MEDIUM)
        self.title = heading(theme, wrap=True)
        self.place = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.hand = HandDrawing(theme)
        self.straight = StraightFingers(theme)
        self.straight.hide()
        self.panel = VerdictPanel(theme)
        self.bubble = BubbleView(theme)
        self.primary = Button(theme, "", "primary")
        self.second = Button(theme, "", "plain", height_px=52)
        self._column = column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        fill(column, 8, self.step, self.title, self.place, (self.hand, 1))
        column.addStretch(0)  # where the drawing has given way its room stays in one piece
        fill(column, self.straight, self.panel, 8, self.bubble)
        column.addLayout(in_line((self.primary, 1), self.second, gap=12))

    def fit(self, height_px: int, *, clicks: bool, judged: bool) -> None:
        """What is read now has the room: ``clicks`` while markers are clicked, ``judged`` once there is a verdict."""
        self.setFixedWidth(self._theme.px(COLUMN_PX))
        scale = self._theme.text_scale
        # The question of the straight fingers and the checks are read; the drawing has done its work by then.
        asks = not self.straight.isHidden()
        self.bubble.give_room(height_px >= LEAST_SCREEN_PX * scale)
        # The bubble takes its height, and the air of a gap more than what gives way for it.
        guided_px = 0 if self.bubble.isHidden() else self.bubble.sizeHint().height() + self._theme.px(GUIDED_MORE_PX)
        room_px = height_px - guided_px
        self.hand.setVisible(not (asks and room_px < ALL_FITS_PX * scale))
        # With less room still, first the drawing that says where to click, then the question, else the checks.
        crowded = height_px > 0 and room_px < CROWDED_BELOW_PX * scale
        self.panel.setVisible(not (crowded and (clicks or asks)))
        self.panel.show_close(False)
        if crowded:
            self.hand.setVisible(clicks)
            self.panel.show_close(self._needed_px() + guided_px > height_px)
            if judged and self._needed_px() > height_px:  # not even then: the checks go before the guide
                self.bubble.give_room(False)
        elif clicks and height_px > 0:
            # A long name of a marker may take a line more than there is: the checks, not known yet, wait.
            self.panel.setVisible(self._needed_px() + guided_px <= height_px)
        elif judged and not asks and self.bubble.isHidden() and height_px > 0:
            # The checks are what is read now: where both have no room, the drawing waits.
            self.hand.setVisible(self._needed_px() <= height_px)

    def _needed_px(self) -> int:
        self._column.invalidate()
        return self._column.minimumHeightForWidth(self._theme.px(COLUMN_PX)) + 2 * (MARGIN_PX - 4)

    def show_preview(self, calibrator: Calibrator) -> None:
        self.step.show_state("none", self.tr("Picture"))
        self.title.setText(self.tr("Lay the hand flat and still"))
        self.place.setText(
            self.tr("Palm down, fingers as straight as they go, forearm in line. Then take the picture.")
        )
        order = calibrator.protocol.markers
        self.hand.show_markers(calibrator.side, dict.fromkeys(order, "later"))
        self.panel.show_rows(self.tr("Checks"), "none", rows_before(0, len(order), calibrator.limits))
        self.primary.setEnabled(True)
        self.primary.set_face(self.tr("Take the picture"), icon="", hint=ENTER)
        self.second.hide()

    def show_clicking(self, clicking: Clicking, calibrator: Calibrator, *, sees_none: bool, waits: bool) -> None:
        """While markers are clicked, and while they are checked; ``sees_none``: nothing looks like a disc;
        ``waits``: the program looks for names."""
        done, asked, to_go = len(clicking.pixel), len(clicking.order), len(clicking.missing)
        number = clicking.order.index(clicking.current) + 1
        self.step.show_state("none", self.tr("Marker {number} of {asked}").format(number=number, asked=asked))
        self.title.setText(click_instruction(clicking.current))
        self.place.setText(marker_place(clicking.current))
        if clicking.complete:  # nothing is left to click while they are checked
            self.step.show_state("good", self.tr("All markers found"))
            self.title.setText(self.tr("Checking the markers…"))
            self.place.setText(self.tr("Hold the hand in this position until the measuring begins."))
        self.hand.show_markers(clicking.side, _hand_states(clicking, ()))
        words = self.tr("Checking…") if clicking.complete else self.tr("Good so far") if done else self.tr("Checks")
        state = "good" if done and not clicking.complete else "none"
        self.panel.show_rows(words, state, rows_before(done, asked, calibrator.limits))  # type: ignore[arg-type]
        left = self.tr("1 marker to go") if to_go == 1 else self.tr("{count} markers to go").format(count=to_go)
        words = self.tr("Start measuring · {left}").format(left=left) if to_go else self.tr("Checking the markers…")
        self.primary.setEnabled(False)
        self.primary.set_face(words, icon="", hint="")
        self.second.hide()
        if sees_none:  # said at once, before anybody looks for what is not there
            self.step.show_state("warn", self.tr("No blue disc in the picture"), token="warn")
            self.title.setText(self.tr("No blue disc is to be seen"))
            self.place.setText(
                self.tr(
                    "Are the discs on, and the hand under the camera? More light helps; dark blue cloth is no disc."
                )
            )
        if waits:
            self.step.show_state("none", self.tr("Looking for the markers…"))
        elif clicking.proposed:
            self._show_proposals(clicking, calibrator)

    def _show_proposals(self, clicking: Clicking, calibrator: Calibrator) -> None:
        words = proposal_words(clicking)
        self.step.show_state(words.state, words.step, token="warn" if words.state == "warn" else "text2")
        self.title.setText(words.title)
        self.place.setText(words.place)
        self.primary.setEnabled(True)
        self.primary.set_face(words.primary, icon="", hint=ENTER)
        self.second.set_face(self.tr("Click by hand"), hint="C")
        self.second.show()
        asked, proposed = len(clicking.order), len(clicking.proposed) + len(clicking.pixel)
        checks = self.tr("Names to confirm")
        self.panel.show_rows(checks, "none", rows_before(proposed, asked, calibrator.limits, proposed=True))

    def show_verdict(self, clicking: Clicking, calibrator: Calibrator, outcome: Judged, remedy: Remedy) -> None:
        """What the checks say, and the likeliest way out of what is not good."""
        verdict = outcome.verdict
        words, state = headline(verdict)
        self.hand.show_markers(clicking.side, _hand_states(clicking, at_fault(verdict)))
        said = words if verdict.is_good else self.tr("Checks")
        self.panel.show_rows(said, state, rows_of(verdict, calibrator.limits))
        self.primary.setEnabled(True)
        if verdict.is_good:
            self.step.show_state("good", self.tr("All markers found"))
            self.title.setText(self.tr("Ready to measure"))
            self.place.setText(self.tr("Hold the hand in this position until the measuring begins."))
            self.primary.set_face(self.tr("Start measuring"), icon="play", hint=ENTER)
            self.second.hide()
        else:
            first = max(
                verdict.findings,
                key=lambda finding: (finding.blocks, finding.kind in NAMES_WRONG, finding.kind in DISC_DOUBTED),
            )
            self.step.show_state(state, words, token="bad" if state == "bad" else "warn")
            told = finding_words(first)
            self.title.setText(told.happened.rstrip("."))
            self.place.setText(" ".join(part for part in (told.safe, told.do) if part))
            words, key = face(remedy)
            self.primary.set_face(words, icon="", hint=key)
            swap = remedy == "swap"
            self.second.set_face(self.tr("Correct names") if swap else self.tr("Start although &doubtful"), hint="")
            self.second.setVisible(swap or verdict.can_start)
        self.primary.setFocus(Qt.FocusReason.OtherFocusReason)


def _hand_states(clicking: Clicking, wrong: Sequence[str]) -> dict[str, MarkerState]:
    states: dict[str, MarkerState] = {}
    for name in clicking.order:
        states[name] = "wrong" if name in wrong else "done" if name in clicking.pixel else "later"
    for name, one in clicking.proposed.items():
        states[name] = "proposed" if one.is_sure else "doubtful"
    if (clicking.missing and not clicking.proposed) or clicking.current in clicking.unnamed:
        states[clicking.current] = "next"
    return states


MOST_NAMED = 4
"""So many doubtful or missing markers are named one by one."""


@dataclass(frozen=True, slots=True)
class ProposalWords:
    """State and line above the title, title, what to do, face of the primary button."""

    state: State
    step: str
    title: str
    place: str
    primary: str


def proposal_words(clicking: Clicking) -> ProposalWords:
    """Which names need a look, and what Enter does."""
    asked, open_names, doubtful = len(clicking.order), clicking.unnamed, clicking.doubtful
    named = len(clicking.proposed)
    primary = tr("Names are right") if not open_names else tr("Take {count} names").format(count=named)
    if not open_names and not doubtful:
        whole = tr("All {count} markers found").format(count=asked)
        todo = tr("Drag a name to another disc to change it.")
        if clicking.protocol.has_fingers:
            todo = tr("Each finger’s line runs from the wrist to its tip. Drag a name to another disc to change it.")
        return ProposalWords("good", whole, tr("Are these names right?"), todo, primary)
    if doubtful:
        step = (
            tr("1 name is doubtful")
            if len(doubtful) == 1
            else tr("{count} names are doubtful").format(count=len(doubtful))
        )
        todo = tr("Look at: {markers}. Enter says yes; drag a name to another disc to change it.")
        title = tr("Is this the {marker}?").format(marker=marker_in_words(doubtful[0], say))
        return ProposalWords("warn", step, title, todo.format(markers=_list(doubtful)), tr("Yes, it is"))
    step = tr("{named} of {asked} markers found").format(named=asked - len(open_names), asked=asked)
    todo = tr("Not found: {markers}. Take the other names with Enter, then click these.")
    return ProposalWords(
        "warn", step, click_instruction(clicking.current), todo.format(markers=_list(open_names)), primary
    )


def _list(names: tuple[str, ...]) -> str:
    words = [marker_name(names[0]), *(marker_in_words(name, say) for name in names[1:])]
    if len(words) > MOST_NAMED:
        return tr("{markers} and {count} more").format(
            markers=", ".join(words[:MOST_NAMED]), count=len(words) - MOST_NAMED
        )
    return ", ".join(words)


class StraightFingers(QWidget):
    """``changed`` carries the answer, thumb to little: True where the finger lies straight. All do until clicked."""

    changed = Signal(object)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._question = Text(theme, self.tr("Do the fingers lie straight?"), 14, SEMIBOLD)
        self._said = Text(theme, "", 12, REGULAR, "text2", wrap=True)
        self.buttons: list[Button] = []
        grid = in_grid(4, 4)
        for number in range(1, 6):
            button = Button(theme, finger_name(str(number)), "well", height_px=32)
            button.setCheckable(True)
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the keys 1 to 5 do it; Enter goes on
            button.clicked.connect(self._clicked)
            grid.addWidget(button, (number - 1) // 3, (number - 1) % 3)
            self.buttons.append(button)
        in_column(self._question, grid, self._said, gap=4, margins=(0, 0, 0, 0), within=self)
        self.show_answer(ALL_STRAIGHT)

    @property
    def answer(self) -> tuple[bool, ...]:
        """Thumb to little, True where the finger lies straight."""
        return tuple(not button.isChecked() for button in self.buttons)

    def show_answer(self, straight: tuple[bool, ...]) -> None:
        for number, (button, lies_straight) in enumerate(zip(self.buttons, straight, strict=True), start=1):
            button.setChecked(not lies_straight)
            self._name(button, number)
        self._say()

    def toggle(self, number: int) -> None:
        """The finger, 1 thumb to 5 little, cannot lie straight, or can after all."""
        self.buttons[number - 1].click()

    def _clicked(self) -> None:
        for number, button in enumerate(self.buttons, start=1):
            self._name(button, number)
        self._say()
        self.changed.emit(self.answer)

    def _name(self, button: Button, number: int) -> None:
        finger = finger_name(str(number))
        face = self.tr("{finger} bent").format(finger=finger) if button.isChecked() else finger
        button.set_face(face)

    def _say(self) -> None:
        bent = self.answer.count(False)
        self._said.setText(
            self.tr("Click a finger that cannot lie straight (keys 1 to 5).")
            if not bent
            else self.tr("A bent finger is measured from its own rest, and less surely.")
        )


LARGEST_DEG, LARGEST_TURN_DEG = 80, 110
ORDER = (1, 0, 2)
"""Flexion first, as it is the one that contractures limit most."""


def _from_thumb_up(angles_rad: FloatArray) -> FloatArray:
    return read_wrist_angles(angles_rad, exercise_named("FOREARM_PS"), np.zeros(3))


class StartAngleSheet(Sheet):
    """Three angles with the word for their direction; emits ``kept`` with (3,) radians."""

    kept = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 620)
        body = self.card.body
        words = self.tr(
            "Measure with a goniometer how far the wrist is from straight as it lies now, and the forearm from thumb "
            "up: palm flat on the table is 90° pronation. Carpus adds these angles to all it measures of the wrist and "
            "says so in the report. Bent fingers are fine as they are: zero "
            "of a finger joint is the straight finger, whatever the picture."
        )
        self.head(self.tr("The wrist cannot lie straight"), words, gap=16)
        self.fields: dict[int, tuple[Choices, QSpinBox]] = {}
        for column in ORDER:
            direction = Choices(theme, [(name, terms.movement_name(name)) for name in SIDES[column]], SIDES[column][0])
            value = number_field(theme, LARGEST_TURN_DEG if column == PRONOSUPINATION else LARGEST_DEG, "°")
            value.setAlignment(Qt.AlignmentFlag.AlignRight)
            value.setAccessibleName(terms.movement_name(SIDES[column][0]))
            body.addLayout(in_line((direction, 1), value))
            self.fields[column] = (direction, value)
        straight = Button(theme, self.tr("It lies straight"), "plain", height_px=52)
        straight.clicked.connect(lambda: self._keep(np.zeros(3)))
        keep = Button(theme, self.tr("Use these angles"), "primary")
        keep.clicked.connect(lambda: self._keep(self.angles_rad()))
        self.set_default(keep)
        body.addLayout(in_line(STRETCH, straight, keep))

    def begin(self, angles_rad: FloatArray) -> None:
        for column, (direction, value) in self.fields.items():
            shown_deg = math.degrees(_from_thumb_up(angles_rad)[column])
            direction.choose(SIDES[column][0 if shown_deg >= 0 else 1])
            value.setValue(rounded(abs(shown_deg)))
        self.open(self.fields[ORDER[0]][1])
        self.fields[ORDER[0]][1].selectAll()

    def angles_rad(self) -> FloatArray:
        """Deviation, flexion, pronosupination (3,) as in the files, of what was entered from thumb up."""
        out = np.zeros(3)
        for column, (direction, value) in self.fields.items():
            sign = 1.0 if direction.value() == SIDES[column][0] else -1.0
            out[column] = sign * math.radians(value.value())
        out[PRONOSUPINATION] = pronosupination_from_palm_down(out[PRONOSUPINATION])
        return out

    def _keep(self, angles_rad: FloatArray) -> None:
        self.close_sheet()
        self.kept.emit(angles_rad)

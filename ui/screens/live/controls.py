"""The bar below the live screen: status light, notes, pause, and the recording button; dialogs for note and pain."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from carpus.core.records.session_setup import next_part
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Surface
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.layouts import STRETCH, fill, row_layout
from carpus.ui.kit.text import SEMIBOLD, Text
from carpus.ui.kit.theme import MARGIN_PX, Theme
from carpus.ui.screens.live.recording import RecordingController
from carpus.ui.screens.live.status_light import StatusLightView


class RecordingControls(Surface):
    """Shows the state of the recording.

    Buttons take no focus: the space bar, or a pedal that sends it, must always reach the screen.
    """

    def __init__(self, theme: Theme, recording: RecordingController) -> None:
        super().__init__(theme)
        self._recording, self._is_tight = recording, False
        self.light_view = StatusLightView(theme)
        self.note_button = Button(theme, self.tr("Note"), "quiet", icon="notebook-pen", hint="F5")
        self.pain_button = Button(theme, self.tr("Pain"), "quiet", hint="F6")
        self.pause_button = Button(theme, self.tr("Pause"), icon="pause", hint="F7", height_px=52)
        self.main_button = Button(theme, "", "primary", height_px=56)
        row = row_layout(
            (self.light_view, 1),
            8,
            self.note_button,
            self.pain_button,
            8,
            self.pause_button,
            gap=4,
            margins=(0, 0, MARGIN_PX, 0),
            parent=self,
        )
        fill(row, 12, self.main_button)
        for button in (self.note_button, self.pain_button, self.pause_button, self.main_button):
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        recording.changed.connect(self.refresh)

    def fit(self, *, tight: bool) -> None:
        """Hide hints with large text on a small screen."""
        self._is_tight = tight
        for button, hint in ((self.note_button, "F5"), (self.pain_button, "F6"), (self.pause_button, "F7")):
            button.set_label(button.text(), hint="" if tight else hint)
        self.refresh()

    def reset(self) -> None:
        self.pain_button.set_label(self.tr("Pain"), icon="")

    def show_pain(self, score: int) -> None:
        self.pain_button.set_label(self.tr("Pain {score}").format(score=score), icon="check")

    def show_storing(self, words: str = "") -> None:
        """Show that the recording is being stored, or how long catching up takes."""
        self.main_button.set_label(words or self.tr("Saving…"), icon="", hint="")

    def refresh(self) -> None:
        recording = self._recording
        state = recording.state
        runs = state != "off" and not recording.is_storing  # what is stopped takes no more notes
        self.note_button.set_label(self.tr("Passive") if recording.is_passive else self.tr("Note"))
        self.note_button.setEnabled(runs)
        self.pain_button.setEnabled(runs)
        self.pause_button.setEnabled(runs and not recording.camera_lost)  # nothing can go on without pictures
        paused = state == "paused" and not recording.camera_lost
        self.pause_button.set_label(
            self.tr("Continue") if paused else self.tr("Pause"), icon="play" if paused else "pause"
        )
        self.main_button.setEnabled(not recording.is_storing)
        if recording.is_busy:
            return
        words = self.tr("Play and record") if recording.is_playback else self.tr("Record")
        if runs:
            follows = recording.set_up is not None and next_part(recording.set_up) is not None
            words = self.tr("Stop and next exercise") if follows else self.tr("Stop and review")
        elif recording.countdown_s:
            words = self.tr("Starting in {seconds} (cancel)").format(seconds=recording.countdown_s)
        hint = "" if self._is_tight else self.tr("Space · pedal")
        self.main_button.set_label(words, icon="square" if runs else "", hint=hint)


MAX_PAIN = 10
SECOND_DIGIT_MS = 700
"""After a 1, a 0 may follow."""


class NoteDialog(Dialog):
    """One line of text, stored with the time of the frame.

    ``passive_changed`` carries True if somebody else moves the hand from now on.
    """

    note_entered = Signal(str)
    passive_changed = Signal(bool)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 720, is_low=True)
        self.line = QLineEdit(placeholderText=self.tr("What happened? Enter no names."))
        self.line.setAccessibleName(self.tr("Note"))
        keep = Button(theme, self.tr("Save note"), "primary", height_px=44)
        close = Button(theme, self.tr("Close"), "plain", hint=self.tr("Esc"))
        self.card.body.addWidget(Text(theme, self.tr("Note at this moment"), 16, SEMIBOLD))
        self.card.body.addLayout(row_layout((self.line, 1), close, keep))
        quick = QHBoxLayout()
        for words in (
            self.tr("Stopped for pain"),
            self.tr("Strap loosened"),
            self.tr("Rest"),
        ):
            button = Button(theme, words, "plain", height_px=36)
            button.clicked.connect(lambda _=False, words=words: self._enter(words))
            quick.addWidget(button)
        self._is_passive = False
        self.passive_button = Button(theme, "", "plain", height_px=36)
        self.passive_button.clicked.connect(self._toggle_passive)
        fill(quick, self.passive_button, STRETCH)
        self.card.body.addLayout(quick)
        keep.clicked.connect(lambda: self._enter(self.line.text()))
        close.clicked.connect(self.close_dialog)
        self.set_default(keep)

    def open_note(self, *, passive: bool = False) -> None:
        """Open empty; ``passive`` tells whether somebody else moves the hand now."""
        self._is_passive = passive
        self.passive_button.set_label(self.tr("Active from here on") if passive else self.tr("Passive from here on"))
        self.line.clear()
        self.open(self.line)

    def _enter(self, words: str) -> None:
        self.close_dialog()
        if words.strip():
            self.note_entered.emit(words.strip())

    def _toggle_passive(self) -> None:
        self.close_dialog()
        self.passive_changed.emit(not self._is_passive)


class PainDialog(Dialog):
    """Pain from 0 to 10 by click, digit, or arrows and Enter."""

    pain_entered = Signal(int)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 720, is_low=True)
        self.card.body.addWidget(Text(theme, self.tr("Pain now, 0 (none) to 10 (worst)"), 16, SEMIBOLD))
        row = row_layout(gap=6)
        self.buttons: list[Button] = []
        for score in range(MAX_PAIN + 1):
            button = Button(theme, str(score), "plain", height_px=48)
            button.clicked.connect(lambda _=False, score=score: self._enter(score))
            row.addWidget(button)
            self.buttons.append(button)
        self.card.body.addLayout(row)
        below = QHBoxLayout()
        advice = self.tr(
            "If pain is 5 or more, or has risen by 2, stop the exercise. Keys: 0 to 9. For 10, press 1, then 0."
        )
        below.addWidget(Text(theme, advice, 14, token="text2", wrap=True), 1)
        close = Button(theme, self.tr("Close"), "quiet", height_px=36)
        close.clicked.connect(self.close_dialog)
        self.set_default(close)
        below.addWidget(close)
        self.card.body.addLayout(below)
        self._digit_timer = QTimer(self, singleShot=True, interval=SECOND_DIGIT_MS)
        self._digit_timer.timeout.connect(lambda: self._enter(1))
        self.closed.connect(self._digit_timer.stop)

    def _enter(self, score: int) -> None:
        self.close_dialog()
        self.pain_entered.emit(score)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}.get(Qt.Key(event.key()), 0)
        digit = event.text() if event.text() in "0123456789" else ""
        if digit and self._digit_timer.isActive():
            self._enter(MAX_PAIN if digit == "0" else int(digit))
        elif digit == "1":
            self.buttons[1].setFocus(Qt.FocusReason.TabFocusReason)
            self._digit_timer.start()
        elif digit:
            self._enter(int(digit))
        elif step:
            now = self.window().focusWidget()
            place = self.buttons.index(now) if now in self.buttons else -1 if step > 0 else 0
            self.buttons[(place + step) % len(self.buttons)].setFocus(Qt.FocusReason.TabFocusReason)
        else:
            super().keyPressEvent(event)

"""Lock of the window: when it locks, the lock screen, and the PIN."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import datetime
from typing import Any

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence, QResizeEvent, QShortcut, QWindow
from PySide6.QtWidgets import QApplication, QHBoxLayout, QLineEdit, QWidget

from carpus.core.model.errors import CarpusFault, PinUncheckable
from carpus.core.model.rounding import round_half_away
from carpus.core.platform.disks import check_disk_encryption, detect_encryption
from carpus.core.records.pin import Pin
from carpus.core.records.values import Therapist
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Separator, Surface
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.field import Combo, LabelledField
from carpus.ui.kit.forms import Field, Form
from carpus.ui.kit.keys import KEYS
from carpus.ui.kit.layouts import fill, row_layout
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, Icon, StateText, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.records.cards import LockCard
from carpus.ui.screens.settings.therapists import TherapistController
from carpus.ui.shell.flow import ScreenContext
from carpus.ui.words.fault_words import fault_words

RETRY_INTERVAL_MS = 60_000
"""Delay of an automatic lock while a recording is running."""


class LockController(QObject):
    """Locks by shortcut, after idle time and at the start; never during a recording. Names stay hidden afterwards.

    Signals: ``privacy_changed`` with whether other windows must hide their content.
    """

    privacy_changed = Signal(bool)

    def __init__(
        self,
        context: ScreenContext,
        therapists: TherapistController,
        *,
        minutes: int,
        save_minutes: Callable[[int], None],
    ) -> None:
        super().__init__(context.window)
        shell, theme, library = context.window, context.theme, context.library
        self._context, self._shell, self._library = context, shell, library
        self._minutes, self._save_minutes, self._therapists = minutes, save_minutes, therapists
        self.pin = Pin(library.folder)
        self.lock_screen = LockScreen(shell, theme)
        self.lock_screen.pin_entered.connect(self._check_pin)
        self.pin_dialog = PinDialog(shell.screen_stack, theme)
        self.pin_dialog.pin_chosen.connect(self._change_pin)
        self.card = LockCard(theme, minutes)
        self.card.pin_button.clicked.connect(lambda: self.pin_dialog.request_pin(is_set=self.pin.is_set))
        self.card.minutes.chosen.connect(self._set_minutes)
        self.card.show_pin(is_set=self.pin.is_set)
        self._background = Background()  # the system may take a second or two to answer
        folder = library.folder
        self._background.run(
            lambda: check_disk_encryption(detect_encryption(folder)),
            self.card.show_disk,
            context.messages.show_fault,
            self,
        )
        self._hidden_widgets = (shell.top_bar, shell.banner, shell.screen_stack)
        shortcut = QShortcut(QKeySequence(KEYS["lock"]), shell)
        shortcut.activated.connect(self.lock_or_set_pin)
        self.idle_timer = IdleTimer(shell)
        self.idle_timer.timeout.connect(self._lock_when_idle)

    @property
    def is_locked(self) -> bool:
        return self.lock_screen.isVisibleTo(self._shell)

    def shut_down(self) -> None:
        self.idle_timer.restart(0)
        self._background.join(RETRY_INTERVAL_MS)

    def lock_at_start(self) -> None:
        """Lock at the start if a PIN is set."""
        self.refresh()
        if self.pin.is_set:
            self._lock(0)

    def lock_or_set_pin(self) -> None:
        """Lock now, or open the settings if no PIN is set."""
        if self._context.navigator.is_recording():
            return  # a recording goes on, and its keys must reach it
        if self.pin.is_set:
            self._lock(0)
        else:
            self._context.navigator.open_screen("settings", "safety")

    def _lock_when_idle(self) -> None:
        if not self.pin.is_set or self.is_locked or self._minutes == 0:
            return
        if self._context.navigator.is_recording():
            self.idle_timer.restart(RETRY_INTERVAL_MS)
            return
        self._lock(self._minutes)

    def _lock(self, minutes: int) -> None:
        if self.is_locked:
            return
        for widget in QApplication.topLevelWidgets():
            if widget.property("stays_when_locked"):
                continue  # the patient's view, which shows nothing but a word then
            if widget is not self._shell and widget.isVisible():
                widget.close()  # menus and dialogs name patients too
        self.privacy_changed.emit(True)
        stored = self._context.current.session_id != ""
        self.lock_screen.lock(self.lock_screen.lock_reason(datetime.now(), minutes), is_session_saved=stored)
        for widget in self._hidden_widgets:
            widget.setProperty("shown_before_lock", not widget.isHidden())
            widget.hide()
        self._context.names.set_hidden(True)
        self.lock_screen.show_therapists(self._therapists.list_therapists(), self._therapists.initials())
        self._library.audit_log.log_program("locked", idle=int(minutes > 0))

    def _check_pin(self, entered: str) -> None:
        try:
            tried = self.pin.check(entered)
        except CarpusFault as fault:
            words = fault_words(fault)
            self.lock_screen.show_message(f"{words.summary} {words.remedy}")
            if not isinstance(fault, PinUncheckable):
                self.lock_screen.pause(RETRY_INTERVAL_MS // 1000)  # what cannot be counted is not tried without end
            return
        if not tried.is_correct:
            self._library.audit_log.log_program("pin_refused", left=tried.tries_left)
            self.lock_screen.show_wrong_pin(tried.tries_left, round_half_away(tried.pause_s))
            return
        if (chosen := self.lock_screen.therapist.currentData()) is not None:
            self._therapists.choose(chosen)
        self._library.audit_log.log_program("unlocked")
        self.privacy_changed.emit(False)
        for widget in self._hidden_widgets:
            widget.setVisible(bool(widget.property("shown_before_lock")))
        self.lock_screen.close_dialog()
        self._restart_idle_timer()

    def _change_pin(self, old: str, new: str) -> None:
        try:
            if self.pin.is_set:
                tried = self.pin.check(old)
                if not tried.is_correct:
                    self._library.audit_log.log_program("pin_refused", left=tried.tries_left)
                    words = self.tr("The current PIN is wrong.")
                    wait = self.tr("Too many attempts. Try again in {seconds} s.").format(
                        seconds=round_half_away(tried.pause_s)
                    )
                    self.pin_dialog.form.show_error("current", wait if tried.pause_s else words)
                    return
            if new:
                self.pin.set(new)
            else:
                self.pin.remove()
        except CarpusFault as fault:
            self.pin_dialog.close_dialog()
            self._context.messages.show_fault(fault)
            return
        self._library.audit_log.log_program("pin_changed", set=int(bool(new)))
        self.pin_dialog.close_dialog()
        self.refresh()

    def refresh(self) -> None:
        self.card.show_pin(is_set=self.pin.is_set)
        self._restart_idle_timer()

    def _set_minutes(self, minutes: int) -> None:
        self._minutes = minutes
        self._save_minutes(minutes)
        self._restart_idle_timer()

    def _restart_idle_timer(self) -> None:
        self.idle_timer.restart(self._minutes * 60_000 if self.pin.is_set else 0)


ACTIVITY_EVENTS = (
    QEvent.Type.KeyPress, QEvent.Type.MouseMove, QEvent.Type.MouseButtonPress, QEvent.Type.Wheel,
    QEvent.Type.TouchBegin,
)  # fmt: skip


class IdleTimer(QTimer):
    """Timer without input in the window."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window, singleShot=True)
        self._window = window
        self._watched: QObject | None = None

    def restart(self, milliseconds: int) -> None:
        """Restart the timer; 0 stops it."""
        self.stop()
        handle: QWindow | None = self._window.windowHandle()  # none before the window was made
        # What the system sends the window, and nothing else: the many events within it pass nobody's hand.
        if milliseconds and handle is not None and handle is not self._watched:
            handle.installEventFilter(self)
            self._watched = handle
        if milliseconds:
            self.start(milliseconds)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() in ACTIVITY_EVENTS and self.isActive():
            self.start()
        return False


MIN_PIN_LENGTH = 4


class PinDialog(Dialog):
    """Setting, changing and removing the PIN.

    Signals: ``pin_chosen`` with the old PIN (empty if none) and the new one, empty to remove it.
    """

    pin_chosen = Signal(str, str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        words = self.tr(
            "At least four characters, digits or letters. A PIN only hides the screen. It does not encrypt files."
        )
        self.add_heading(words=words)
        labels = {
            "current": self.tr("&Current PIN"), "new": self.tr("&New PIN"), "repeated": self.tr("Repeat new &PIN"),
        }  # fmt: skip
        hidden: dict[str, Any] = {"echoMode": QLineEdit.EchoMode.Password, "maxLength": MAX_PIN_LENGTH}
        self.form = Form(theme, [Field(name, label, QLineEdit(**hidden)) for name, label in labels.items()])
        self.save_button = Button(theme, self.tr("Set PIN"), "primary")
        self.remove_button = Button(theme, self.tr("&Remove PIN"), "plain", height_px=52)
        self.save_button.clicked.connect(self._accept)
        self.remove_button.clicked.connect(lambda: self.pin_chosen.emit(self.form["current"].text(), ""))
        fill(self.card.body, *self.form.layout_rows())
        self.add_buttons(self.save_button, self.remove_button, gap=None)

    def request_pin(self, *, is_set: bool) -> None:
        """Open; the old PIN is asked for if one is set."""
        self.title.setText(self.tr("Change the PIN") if is_set else self.tr("Set a PIN"))
        self.form.labelled_widgets["current"].setVisible(is_set)
        self.remove_button.setVisible(is_set)
        for name in self.form.labelled_widgets:
            self.form[name].clear()
        self.form.show_error()
        self.open(self.form["current" if is_set else "new"])

    def _accept(self) -> None:
        current, new, repeated = (self.form[name].text() for name in self.form.labelled_widgets)
        if len(new) < MIN_PIN_LENGTH:
            self.form.show_error("new", self.tr("A PIN needs at least four characters."))
        elif new != repeated:
            self.form.show_error("repeated", self.tr("The two PINs differ."))
        else:
            self.pin_chosen.emit(current, new)


MAX_PIN_LENGTH = 64


class LockScreen(Dialog):
    """Covers the whole window until the PIN is right.

    Signals: ``pin_entered``, answered by :meth:`show_wrong_pin` or by closing.
    """

    pin_entered = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 480, is_dismissible=False)
        self._pause_s = 0
        self._keeps_message = False
        self.badge = Surface(theme, "soft")
        self.badge.setObjectName("badge")
        QHBoxLayout(self.badge).addWidget(Icon(theme, "lock", 32, (50, 50), alignment=0.5))
        self._bar = Surface(theme, bottom_edge="line")
        self._bar.setParent(self)
        row_layout(
            Icon(theme, "carpus", 22, (26, 32)),
            (Text(theme, "Carpus", 16, SEMIBOLD), 1),
            gap=6,
            margins=(20, 0, 0, 0),
            parent=self._bar,
        )
        self.title = Text(theme, self.tr("Locked"), 28, SEMIBOLD)
        self.reason_text = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.pin_field = QLineEdit(echoMode=QLineEdit.EchoMode.Password, maxLength=MAX_PIN_LENGTH)
        self.pin_field.setAccessibleName(self.tr("PIN"))
        self.error_text = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.therapist = Combo()
        self._therapist_row = LabelledField(theme, self.tr("Who is the therapist?"), self.therapist)
        self.unlock_button = Button(theme, self.tr("Unlock"), "primary")
        self.unlock_button.clicked.connect(self._submit)
        self.set_default(self.unlock_button)
        self.data_state = StateText(theme, 14, MEDIUM)
        self.privacy_state = StateText(theme, 14, REGULAR)
        self.forgotten_text = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        body = self.card.body
        body.setContentsMargins(36, 20, 36, 16)
        body.setSpacing(8)
        middle = Qt.AlignmentFlag.AlignHCenter
        fill(body, (self.badge, 0, middle), (self.title, 0, middle))
        self.reason_text.setAlignment(middle)
        fill(
            body,
            self.reason_text,
            8,
            Text(theme, self.tr("PIN"), 14, REGULAR, "text2"),
            self.pin_field,
            self.error_text,
            self._therapist_row,
            self.unlock_button,
            4,
            Separator(theme),
            self.data_state,
            self.privacy_state,
            self.forgotten_text,
        )
        self._clock = QTimer(self, interval=1000)
        self._clock.timeout.connect(self._count_seconds)

    def show_therapists(self, therapists: Sequence[Therapist], current: str) -> None:
        """Ask who works now, where there is a choice."""
        self._therapist_row.setVisible(len(therapists) > 1)
        choices = [(one.initials, " · ".join(part for part in (one.initials, one.name) if part)) for one in therapists]
        self.therapist.set_choices(choices, current)

    def lock(self, reason: str, *, is_session_saved: bool) -> None:
        """Cover the window; ``is_session_saved`` if a session was open."""
        self.reason_text.setText(reason)
        words = (
            self.tr("All data are saved, including the open session.")
            if is_session_saved
            else self.tr("All data are saved.")
        )
        self.data_state.show_state("good", words, token="text")
        self.privacy_state.show_state("none", self.tr("Names, images and values are hidden."), icon="eye-off")
        self._show_forgotten(help_shown=False)
        self.error_text.hide()
        self.pin_field.clear()
        self._set_input_enabled(True)
        self.open(self.pin_field)

    def lock_reason(self, when: datetime, minutes: int) -> str:
        if minutes:
            words = self.tr("Locked automatically at {time} after {minutes} minutes without input.")
            return words.format(time=f"{when:%H:%M}", minutes=minutes)
        return self.tr("Locked at {time}.").format(time=f"{when:%H:%M}")

    def show_wrong_pin(self, attempts_left: int, pause_s: int) -> None:
        """Show how many attempts are left, or how long to wait."""
        if pause_s:
            self.pin_field.clear()
            self._start_pause(pause_s)
            self._show_pause()
            return
        words = self.tr("Wrong PIN. 1 attempt left before a 1-minute wait.")
        if attempts_left != 1:
            words = self.tr("Wrong PIN. {left} attempts left before a 1-minute wait.").format(left=attempts_left)
        self.show_message(words)

    def show_message(self, words: str) -> None:
        self.pin_field.clear()
        self.error_text.show_text(words)
        self.pin_field.setFocus(Qt.FocusReason.OtherFocusReason)

    def pause(self, pause_s: int) -> None:
        """Disable input for a time; the message stays."""
        self._keeps_message = True
        self._start_pause(pause_s)

    def _start_pause(self, pause_s: int) -> None:
        self._pause_s = pause_s
        self._set_input_enabled(False)
        self._clock.start()

    def _set_input_enabled(self, is_enabled: bool) -> None:
        self.pin_field.setEnabled(is_enabled)
        self.unlock_button.setEnabled(is_enabled)

    def _show_pause(self) -> None:
        if self._keeps_message:
            return
        self.error_text.show_text(self.tr("Too many attempts. Try again in {seconds} s.").format(seconds=self._pause_s))

    def _count_seconds(self) -> None:
        self._pause_s = max(0, self._pause_s - 1)
        if self._pause_s:
            self._show_pause()
            return
        self._clock.stop()
        self._keeps_message = False
        self.error_text.hide()
        self._set_input_enabled(True)
        self.pin_field.setFocus(Qt.FocusReason.OtherFocusReason)

    def _submit(self) -> None:
        if self.pin_field.text():
            self.pin_entered.emit(self.pin_field.text())

    def close_dialog(self) -> None:
        self._clock.stop()
        self.pin_field.clear()
        super().close_dialog()

    def _show_forgotten(self, *, help_shown: bool) -> None:
        words = self.tr("Forgot the PIN? Press F1.")
        if help_shown:
            words = self.tr("Ask your IT support to remove the PIN. No data are lost.")
        self.forgotten_text.setText(words)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_F1:
            self._show_forgotten(help_shown=True)
        super().keyPressEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        bar_px = self._theme.px(56) + 1
        self._bar.setGeometry(0, 0, self.width(), bar_px)
        self.setContentsMargins(0, bar_px, 0, 0)  # the card stands in what is left
        super().resizeEvent(event)

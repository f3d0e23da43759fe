"""When the window locks, what is seen meanwhile, what opens it, and how the PIN is changed."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence, QResizeEvent, QShortcut, QWindow
from PySide6.QtWidgets import QApplication, QHBoxLayout, QLineEdit, QWidget

from carpus.core.disks import disk_encryption_finding, disk_state
from carpus.core.errors import CarpusFault, PinUncheckable
from carpus.core.installing import Finding
from carpus.core.records.pin import Pin
from carpus.core.rounding import rounded
from carpus.ui.background import Background
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Line, Surface
from carpus.ui.controls.field import Labelled
from carpus.ui.controls.layouts import fill, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, Sign, StateText, Text
from carpus.ui.fault_words import fault_words
from carpus.ui.flow import ScreenContext
from carpus.ui.keys import KEYS
from carpus.ui.records.cards import LockCard
from carpus.ui.theme import Theme
from carpus.ui.translate import say

WAIT_MS = 60_000
"""How long a lock waits again that came while a recording ran."""


class Locking(QObject):
    """Locks by key, after idle minutes and at the start; never while a recording runs. ``hides`` carries whether what
    lies in other windows is to be hidden."""

    hides = Signal(bool)

    def __init__(
        self,
        context: ScreenContext,
        *,
        minutes: int,
        keep_minutes: Callable[[int], None],
    ) -> None:
        super().__init__(context.shell)
        shell, theme, library = context.shell, context.theme, context.library
        self._context, self._shell, self._library = context, shell, library
        self._minutes, self._keep_minutes = minutes, keep_minutes
        self.pin = Pin(library.folder)
        self.sheet = LockSheet(shell, theme)
        self.sheet.tried.connect(self._try)
        self.pin_sheet = PinSheet(shell.stage, theme)
        self.pin_sheet.chosen.connect(self._change_pin)
        self.card = LockCard(theme, minutes)
        self.card.pin_button.clicked.connect(lambda: self.pin_sheet.begin(is_set=self.pin.is_set))
        self.card.minutes.chosen.connect(self._take_minutes)
        self.card.show_pin(is_set=self.pin.is_set)
        self._background = Background()  # the system may take a second or two to answer
        folder = library.folder
        self._background.run(
            lambda: disk_encryption_finding(disk_state(folder)), self._show_disk, context.messages.fault, self
        )
        self._hidden = (shell.bar, shell.sign, shell.stage)
        shortcut = QShortcut(QKeySequence(KEYS["lock"]), shell)
        shortcut.activated.connect(self.lock_by_key)
        self.idle = Idle(shell)
        self.idle.passed.connect(self._lock_by_itself)

    @property
    def locked(self) -> bool:
        return self.sheet.isVisibleTo(self._shell)

    def end(self) -> None:
        self.idle.wait(0)
        self._background.wait(WAIT_MS)

    def _show_disk(self, finding: Finding) -> None:
        self.card.show_disk("good" if finding.state == "good" else "warn", say(finding.found), say(finding.remedy))

    def lock_at_start(self) -> None:
        """Where there is a PIN nothing is shown without it; called when the window is there."""
        self.look_again()
        if self.pin.is_set:
            self._lock(0)

    def lock_by_key(self) -> None:
        """The key that locks; without a PIN it leads to where one is set."""
        if self._context.way.is_recording():
            return  # a recording goes on, and its keys must reach it
        if self.pin.is_set:
            self._lock(0)
        else:
            self._context.way.show("settings", "safety")

    def _lock_by_itself(self) -> None:
        if not self.pin.is_set or self.locked or self._minutes == 0:
            return
        if self._context.way.is_recording():
            self.idle.wait(WAIT_MS)
            return
        self._lock(self._minutes)

    def _lock(self, minutes: int) -> None:
        if self.locked:
            return
        for widget in QApplication.topLevelWidgets():
            if widget.property("stays_when_locked"):
                continue  # the patient's view, which shows nothing but a word then
            if widget is not self._shell and widget.isVisible():
                widget.close()  # menus and dialogs name patients too
        self.hides.emit(True)
        stored = self._context.now.session_id != ""
        self.sheet.begin(self.sheet.reason(datetime.now(), minutes), stored=stored)
        for widget in self._hidden:
            widget.setProperty("shown_before_lock", not widget.isHidden())
            widget.hide()
        self._library.notes.program("locked", idle=int(minutes > 0))

    def _try(self, typed: str) -> None:
        try:
            tried = self.pin.try_it(typed)
        except CarpusFault as fault:
            words = fault_words(fault)
            self.sheet.say(f"{words.happened} {words.do}")
            if not isinstance(fault, PinUncheckable):
                self.sheet.pause(WAIT_MS // 1000)  # what cannot be counted is not tried without end
            return
        if not tried.opened:
            self._library.notes.program("pin_refused", left=tried.left)
            self.sheet.refuse(tried.left, rounded(tried.pause_s))
            return
        self._library.notes.program("unlocked")
        self.hides.emit(False)
        for widget in self._hidden:
            widget.setVisible(bool(widget.property("shown_before_lock")))
        self.sheet.close_sheet()
        self._restart()

    def _change_pin(self, old: str, new: str) -> None:
        try:
            if self.pin.is_set:
                tried = self.pin.try_it(old)
                if not tried.opened:
                    self._library.notes.program("pin_refused", left=tried.left)
                    words = self.tr("The current PIN is not right.")
                    wait = self.tr("Too many tries. The next one in {seconds} s.").format(
                        seconds=rounded(tried.pause_s)
                    )
                    self.pin_sheet.said.say(wait if tried.pause_s else words)
                    return
            if new:
                self.pin.set(new)
            else:
                self.pin.take_away()
        except CarpusFault as fault:
            self.pin_sheet.close_sheet()
            self._context.messages.fault(fault)
            return
        self._library.notes.program("pin_changed", set=int(bool(new)))
        self.pin_sheet.close_sheet()
        self.card.show_pin(is_set=self.pin.is_set)
        self._restart()

    def look_again(self) -> None:
        self.card.show_pin(is_set=self.pin.is_set)
        self._restart()

    def _take_minutes(self, minutes: int) -> None:
        self._minutes = minutes
        self._keep_minutes(minutes)
        self._restart()

    def _restart(self) -> None:
        self.idle.wait(self._minutes * 60_000 if self.pin.is_set else 0)


SIGNS_OF_LIFE = (
    QEvent.Type.KeyPress, QEvent.Type.MouseMove, QEvent.Type.MouseButtonPress, QEvent.Type.Wheel,
    QEvent.Type.TouchBegin,
)  # fmt: skip


class Idle(QObject):
    """``passed`` once after so many milliseconds without a sign of life in the window."""

    passed = Signal()

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._watched: QObject | None = None
        self._timer = QTimer(self, singleShot=True)
        self._timer.timeout.connect(self.passed)

    @property
    def left_ms(self) -> int:
        """Until it passes; -1 when nobody waits."""
        return self._timer.remainingTime()

    def wait(self, milliseconds: int) -> None:
        """From now on; 0 for never."""
        self._timer.stop()
        handle: QWindow | None = self._window.windowHandle()  # none before the window was made
        # What the system sends the window, and nothing else: the many events within it pass nobody's hand.
        if milliseconds and handle is not None and handle is not self._watched:
            handle.installEventFilter(self)
            self._watched = handle
        if milliseconds:
            self._timer.start(milliseconds)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() in SIGNS_OF_LIFE and self._timer.isActive():
            self._timer.start()
        return False


LEAST_SIGNS = 4


class PinSheet(Sheet):
    """``chosen`` carries the old PIN (empty for none) and the new one, empty to take it away."""

    chosen = Signal(str, str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        words = self.tr(
            "Four signs or more, digits or letters. It hides names and pictures from those who pass by; files are "
            "readable for whoever has this computer’s account or disk."
        )
        self.head(words=words)
        self.old, self.new, self.again = QLineEdit(), QLineEdit(), QLineEdit()
        for line in (self.old, self.new, self.again):
            line.setEchoMode(QLineEdit.EchoMode.Password)
            line.setMaxLength(MOST_SIGNS)
        self._old_row = Labelled(theme, self.tr("&Current PIN"), self.old)
        self.said = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.keep = Button(theme, self.tr("Set PIN"), "primary")
        self.remove = Button(theme, self.tr("&Remove PIN"), "plain", height_px=52)
        self.keep.clicked.connect(self._keep)
        self.remove.clicked.connect(lambda: self.chosen.emit(self.old.text(), ""))
        new, again = (self.tr("&New PIN"), self.new), (self.tr("Repeat new &PIN"), self.again)
        fill(self.card.body, self._old_row, Labelled(theme, *new), Labelled(theme, *again), self.said)
        self.answer_row(self.keep, self.remove, gap=None)

    def begin(self, *, is_set: bool) -> None:
        """Ask; the old one first where there is one."""
        self.title.setText(self.tr("Change the PIN") if is_set else self.tr("Set a PIN"))
        self._old_row.setVisible(is_set)
        self.remove.setVisible(is_set)
        for line in (self.old, self.new, self.again):
            line.clear()
        self.said.hide()
        self.open(self.old if is_set else self.new)

    def _keep(self) -> None:
        if len(self.new.text()) < LEAST_SIGNS:
            self.said.say(self.tr("A PIN has four signs or more."))
        elif self.new.text() != self.again.text():
            self.said.say(self.tr("The two are not the same."))
        else:
            self.chosen.emit(self.old.text(), self.new.text())


MOST_SIGNS = 64


class LockSheet(Sheet):
    """Covers the whole window. ``tried`` carries what was typed; the answer comes by :meth:`refuse` or by closing."""

    tried = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 480, may_close=False)
        self._pause_s = 0
        self._says_why = False
        self.badge = Surface(theme, "soft")
        self.badge.setObjectName("badge")
        QHBoxLayout(self.badge).addWidget(Sign(theme, "lock", 32, (50, 50), lean=0.5))
        self._bar = Surface(theme, under="line")
        self._bar.setParent(self)
        in_line(
            Sign(theme, "carpus", 22, (26, 32)),
            (Text(theme, "Carpus", 16, SEMIBOLD), 1),
            gap=6,
            margins=(20, 0, 0, 0),
            within=self._bar,
        )
        self.title = Text(theme, self.tr("Locked"), 28, SEMIBOLD)
        self.why = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.line = QLineEdit(echoMode=QLineEdit.EchoMode.Password, maxLength=MOST_SIGNS)
        self.line.setAccessibleName(self.tr("PIN"))
        self.said = Text(theme, "", 14, SEMIBOLD, "bad", wrap=True)
        self.unlock = Button(theme, self.tr("Unlock"), "primary")
        self.unlock.clicked.connect(self._try)
        self.set_default(self.unlock)
        self.safe = StateText(theme, 14, MEDIUM)
        self.hidden = StateText(theme, 14, REGULAR)
        self.forgotten = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        body = self.card.body
        body.setContentsMargins(36, 20, 36, 16)
        body.setSpacing(8)
        middle = Qt.AlignmentFlag.AlignHCenter
        fill(body, (self.badge, 0, middle), (self.title, 0, middle))
        self.why.setAlignment(middle)
        fill(
            body,
            self.why,
            8,
            Text(theme, self.tr("PIN"), 14, REGULAR, "text2"),
            self.line,
            self.said,
            self.unlock,
            4,
            Line(theme),
            self.safe,
            self.hidden,
            self.forgotten,
        )
        self._clock = QTimer(self, interval=1000)
        self._clock.timeout.connect(self._count)

    def begin(self, why: str, *, stored: bool) -> None:
        """Cover the window; ``stored`` whether a session was open, which is."""
        self.why.setText(why)
        words = self.tr("Nothing is lost. The open session is stored.") if stored else self.tr("Nothing is lost.")
        self.safe.show_state("good", words, token="text")
        self.hidden.show_state("none", self.tr("Names, pictures and figures are hidden."), icon="eye-off")
        self._say_forgotten(help_shown=False)
        self.said.hide()
        self.line.clear()
        self._let_try(True)
        self.open(self.line)

    def reason(self, when: datetime, minutes: int) -> str:
        if minutes:
            words = self.tr("Locked by itself at {time}, after {minutes} minutes without a key.")
            return words.format(time=f"{when:%H:%M}", minutes=minutes)
        return self.tr("Locked at {time}.").format(time=f"{when:%H:%M}")

    def refuse(self, left: int, pause_s: int) -> None:
        """The PIN was not the one: how many tries are left, or how long to wait."""
        if pause_s:
            self.line.clear()
            self._wait(pause_s)
            self._show_pause()
            return
        words = self.tr("Not this PIN. 1 more try, then a pause of 1 minute.")
        if left != 1:
            words = self.tr("Not this PIN. {left} more tries, then a pause of 1 minute.").format(left=left)
        self.say(words)

    def say(self, words: str) -> None:
        self.line.clear()
        self.said.say(words)
        self.line.setFocus(Qt.FocusReason.OtherFocusReason)

    def pause(self, pause_s: int) -> None:
        """Nothing is tried for so long; what was said stays."""
        self._says_why = True
        self._wait(pause_s)

    def _wait(self, pause_s: int) -> None:
        self._pause_s = pause_s
        self._let_try(False)
        self._clock.start()

    def _let_try(self, may: bool) -> None:
        self.line.setEnabled(may)
        self.unlock.setEnabled(may)

    def _show_pause(self) -> None:
        if self._says_why:
            return
        self.said.say(self.tr("Too many tries. The next one in {seconds} s.").format(seconds=self._pause_s))

    def _count(self) -> None:
        self._pause_s = max(0, self._pause_s - 1)
        if self._pause_s:
            self._show_pause()
            return
        self._clock.stop()
        self._says_why = False
        self.said.hide()
        self._let_try(True)
        self.line.setFocus(Qt.FocusReason.OtherFocusReason)

    def _try(self) -> None:
        if self.line.text():
            self.tried.emit(self.line.text())

    def close_sheet(self) -> None:
        self._clock.stop()
        self.line.clear()
        super().close_sheet()

    def _say_forgotten(self, *, help_shown: bool) -> None:
        words = self.tr("PIN forgotten? F1 says what can be done.")
        if help_shown:
            words = self.tr(
                "Whoever looks after this computer takes the file pin.json out of the data folder and starts Carpus "
                "again: nothing is lost. A PIN hides; it does not protect the files."
            )
        self.forgotten.setText(words)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_F1:
            self._say_forgotten(help_shown=True)
        super().keyPressEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        bar_px = self._theme.px(56) + 1
        self._bar.setGeometry(0, 0, self.width(), bar_px)
        self.setContentsMargins(0, bar_px, 0, 0)  # the card stands in what is left
        super().resizeEvent(event)

"""Messages over the window: dialogs one at a time, notices that stay, and saved files."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QObject, Qt, QTimer, QUrl, Signal
from PySide6.QtGui import QDesktopServices, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QApplication, QVBoxLayout, QWidget

from carpus.core.model.errors import CameraLost
from carpus.core.model.fault_text import MessageText
from carpus.core.model.rounding import round_half_away
from carpus.core.records.new_sessions import RecoveredSession
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card, Separator
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.layouts import STRETCH, clear_layout, column_layout, fill, row_layout
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Icon, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.shell.current_selection import practice_patient_name
from carpus.ui.words.fault_words import fault_words

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class _Message:
    words: MessageText
    answers: Sequence[Answer]
    icon: str
    detail: str
    safe_detail: str
    is_alarm: bool = True


class Messages(QObject):
    """Queue of message dialogs, oldest first, without duplicates.

    Signals: ``fault_shown`` with each fault.
    """

    fault_shown = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host)
        self._theme, self._host = theme, host
        self.dialog = self._create_dialog(host)
        self._queue: list[_Message] = []
        self._current: _Message | None = None
        self._lost_since_s = 0.0
        self._clock = QTimer(self, interval=1000)
        self._clock.timeout.connect(self._update_wait_time)

    def _create_dialog(self, host: QWidget) -> MessageDialog:
        card = MessageDialog(host, self._theme)
        card.closed.connect(self._show_next)
        return card

    @property
    def is_busy(self) -> bool:
        return self._current is not None

    def set_host(self, host: QWidget) -> None:
        """Show dialogs over another part of the window from now on, also the current one."""
        if host is self._host:
            return
        self._host, old = host, self.dialog
        old.closed.disconnect(self._show_next)
        old.close_dialog()
        old.deleteLater()
        self.dialog = self._create_dialog(host)
        if self._current is not None:
            self._show(self._current)

    def show_fault(
        self, fault: Exception, answers: Sequence[Answer] = (), *, detail: str = "", safe_detail: str = ""
    ) -> None:
        """Show a fault; without answers the dialog can only be closed."""
        words = fault_words(fault)
        log.warning("%s %s", words.code, type(fault).__name__, exc_info=fault)
        self.fault_shown.emit(fault)
        icon = "unplug" if isinstance(fault, CameraLost) else ""
        answers = answers or (Answer(self.tr("Continue"), lambda: None),)
        self._enqueue(_Message(words, tuple(answers), icon, detail, safe_detail))

    def show_question(
        self, question: MessageText, answers: Sequence[Answer], *, icon: str = "", detail: str = ""
    ) -> None:
        """Ask the user a question, unless it is already open or queued."""
        self._enqueue(_Message(question, tuple(answers), icon, detail, "", is_alarm=False))

    def _enqueue(self, message: _Message) -> None:
        if not any(other is not None and other.words == message.words for other in (self._current, *self._queue)):
            self._queue.append(message)
            if self._current is None:
                self._show_next()

    def withdraw_question(self, question: MessageText) -> None:
        """Close or dequeue a question that no longer applies."""
        self._withdraw(lambda message: message.words == question)

    def _withdraw(self, is_settled: Callable[[_Message], bool]) -> None:
        self._queue = [message for message in self._queue if not is_settled(message)]
        if self._current is not None and is_settled(self._current):
            self.dialog.close_dialog()

    def show_camera_lost(self, fault: Exception, answers: Sequence[Answer], detail: str, safe_detail: str) -> None:
        """Show the dialog that waits for the camera; it closes when frames return."""
        self._lost_since_s = time.monotonic()
        self.show_fault(fault, answers, detail=detail, safe_detail=safe_detail)
        self._update_wait_time()
        self._clock.start()

    def close_camera_lost(self) -> None:
        self._clock.stop()
        self._withdraw(lambda message: message.icon == "unplug")

    def show_notice(
        self,
        layout: QVBoxLayout,
        words: MessageText,
        button: str,
        action: Callable[[], None],
        *,
        icon: str = "history",
        later_text: str = "",
    ) -> NoticeStrip:
        """Show a notice that stays until it is answered.

        ``later_text`` is the label of the second button.
        """
        strip = NoticeStrip(self._theme, words, button, icon, later_text)
        layout.addWidget(strip)

        def remove() -> None:
            layout.removeWidget(strip)
            strip.hide()
            strip.deleteLater()

        strip.postponed.connect(remove)
        strip.action_requested.connect(remove)
        strip.action_requested.connect(action)
        return strip

    def recovery_words(self, found: RecoveredSession) -> MessageText:
        what = self.tr("A session of {name} was interrupted on {day} at {time}. It has been recovered.")
        safe = self.tr(
            "All data up to {kept} are safe. At most the last second is missing, or more where results were delayed."
        )
        name = practice_patient_name() if found.patient_id == PRACTICE_PATIENT else found.pseudonym
        day, at = numbers.format_short_date(found.when), f"{found.when:%H:%M}"
        return MessageText(
            what.format(name=name, day=day, time=at),
            safe.format(kept=numbers.format_clock(found.duration_s)),
            self.tr("Review it now or later. It stays in the patient’s session list."),
        )

    def _show_next(self) -> None:
        self._current = None
        if self._queue:
            self._current = self._queue.pop(0)
            self._show(self._current)

    def _show(self, message: _Message) -> None:
        self.dialog.show_words(
            message.words, message.answers, icon=message.icon, detail=message.detail, safe_detail=message.safe_detail,
            is_alarm=message.is_alarm,
        )  # fmt: skip

    def _update_wait_time(self) -> None:
        seconds = round_half_away(time.monotonic() - self._lost_since_s)
        if self._current is not None and self._current.icon == "unplug":
            self.dialog.wait_text.setText(self.tr("Waiting for the camera … {seconds} s").format(seconds=seconds))


class NoticeStrip(Card):
    """Notice with an action and a way to postpone it.

    Signals: ``action_requested`` by the button, ``postponed`` by the second one or Esc.
    """

    action_requested = Signal()
    postponed = Signal()

    def __init__(self, theme: Theme, words: MessageText, button: str, icon: str = "history", later: str = "") -> None:
        super().__init__(theme, 0, "soft", "accent")
        self.words = words
        texts = column_layout(Text(theme, words.summary, 20, SEMIBOLD, wrap=True), gap=4)
        for line in (words.data_safety, words.remedy):
            if line:
                texts.addWidget(Text(theme, line, 14, REGULAR, wrap=True))
        self.details = FaultDetails(theme)
        texts.addWidget(self.details)
        self.details.show_words(words)
        self.button = Button(theme, button, "plain", height_px=40)
        self.button.setVisible(bool(button))
        self.later_button = Button(theme, later or self.tr("Later"), "quiet", hint=self.tr("Esc"), height_px=36)
        buttons = column_layout(self.button, (self.later_button, 0, Qt.AlignmentFlag.AlignHCenter), gap=4)
        row = row_layout(
            (Icon(theme, icon, 24, (26, 32)), 0, Qt.AlignmentFlag.AlignTop),
            (texts, 1),
            buttons,
            gap=20,
            margins=(24, 14, 18, 12),
        )
        row.setAlignment(buttons, Qt.AlignmentFlag.AlignTop)  # a stretch here would pull it open on an empty list
        self.body.addLayout(row)
        self.setAccessibleName(" ".join((words.summary, words.data_safety, words.remedy)))
        self.button.clicked.connect(self.action_requested)
        self.later_button.clicked.connect(self.postponed)


def postpone_last_notice(screen: QWidget) -> bool:
    """Postpone the last visible notice of a screen, as Esc does; return whether there was one."""
    strips = [strip for strip in screen.findChildren(NoticeStrip) if strip.isVisible()]
    if strips:
        strips[-1].postponed.emit()
    return bool(strips)


MAX_NAMES_SHOWN = 3
"""A data set has dozens of files, and each name may need two lines."""


def format_file_names(names: Sequence[str]) -> str:
    """Format file names for a dialog.

    >>> format_file_names(["a", "b"]), format_file_names(list("abcdefgh"))
    ('a, b', 'a, b, c, …')
    """
    listed = [
        name.replace("_", f"_{LINE_BREAK_HINT}").replace(".", f"{LINE_BREAK_HINT}.") for name in names[:MAX_NAMES_SHOWN]
    ]
    return ", ".join([*listed, *(["…"] if len(names) > MAX_NAMES_SHOWN else [])])


def show_files_written(messages: Messages, folder: str, names: Sequence[str]) -> None:
    """Show which files were saved, and offer to open the folder."""
    count = len(names)
    what = tr("1 file was saved.") if count == 1 else tr("{count} files were saved.")
    messages.show_question(
        MessageText(
            what.format(count=count),
            tr("Folder: {folder}").format(folder=folder),
            tr("Files: {names}").format(names=format_file_names(names)),
        ),
        (
            Answer(tr("Open folder"), lambda: QDesktopServices.openUrl(QUrl.fromLocalFile(folder)), "O"),
            Answer(tr("Continue"), lambda: None),
        ),
        icon="download",
    )


DIALOG_WIDTH_PX = 720


@dataclass(frozen=True, slots=True)
class Answer:
    """A button of a message dialog; ``key`` is its shortcut letter.

    ``is_risky`` marks an answer that loses something or saves something wrong: it is never the default.
    """

    text: str
    action: Callable[[], object]
    key: str = ""
    is_risky: bool = False


class MessageDialog(Dialog):
    """Dialog with up to two answers.

    The last answer is the default, has the focus and loses nothing. Esc gives it too if the other one is risky or
    nothing went wrong.
    """

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, DIALOG_WIDTH_PX, is_dismissible=False)
        self.happened = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.detail = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.safe = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.safe_detail = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.action = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.wait_text = Text(theme, "", 14, REGULAR, "text2")
        self._icon, self._icon_safe, onward = (
            Icon(theme, name, 26, (44, 40), alignment=0.5) for name in ("unplug", "good", "chevron-right")
        )
        self._buttons = row_layout(gap=12)
        self.answers: list[tuple[Button, Answer]] = []
        self._is_alarm = True
        body = self.card.body
        body.setContentsMargins(32, 24, 32, 24)
        body.setSpacing(14)
        rows = (
            (self._icon, self.happened, self.detail),
            (self._icon_safe, self.safe, self.safe_detail),
            (onward, self.action),
        )
        for icon, *words in rows:
            row = row_layout((icon, 0, Qt.AlignmentFlag.AlignVCenter), gap=24)
            row.addLayout(column_layout(*words, gap=2), 1)
            fill(body, row, Separator(theme))
        self.details = FaultDetails(theme)
        fill(body, self.details, row_layout((self.wait_text, 1), self._buttons))

    def show_words(
        self, words: MessageText, answers: Sequence[Answer], *, icon: str = "", detail: str = "", safe_detail: str = "",
        is_alarm: bool = True,
    ) -> None:  # fmt: skip
        """Open with summary, data safety and action.

        ``detail`` and ``safe_detail`` are facts of the moment. Without ``is_alarm`` it is a question or good news,
        and not red.
        """
        for head, text in (
            (self.happened, words.summary.rstrip(".")),
            (self.safe, words.data_safety),
            (self.action, words.remedy),
        ):
            head.setText(text)
        self.details.show_words(words)
        self.detail.show_text(detail)
        self.safe_detail.show_text(safe_detail)
        self._icon.show_icon(icon or ("bad" if is_alarm else "circle-help"), "bad" if is_alarm else "accent", 36)
        self._icon_safe.show_icon("good", size_px=26)
        self.wait_text.setText("")
        self.card.set_colors("surface", *(("bad", 2.0) if is_alarm else ("line", 1.0)))
        self.setAccessibleName(" ".join((words.summary, detail, words.data_safety, safe_detail, words.remedy)))
        if answers and answers[-1].is_risky:
            raise ValueError(f"what Enter answers loses nothing: {answers[-1].text}")
        clear_layout(self._buttons)
        self.answers, self._is_alarm = [], is_alarm
        for number, answer in enumerate(answers):
            primary = number == len(answers) - 1
            button = Button(self._theme, answer.text, "primary" if primary else "plain", hint=answer.key, height_px=48)
            button.clicked.connect(lambda _=False, answer=answer: self._choose_answer(answer))
            self._buttons.addWidget(button)
            self.answers.append((button, answer))
        if self.answers:
            self.set_default(self.answers[-1][0])
        self.open()

    def _choose_answer(self, answer: Answer) -> None:
        self.close_dialog()
        answer.action()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        loses_nothing = not self._is_alarm or any(answer.is_risky for _, answer in self.answers)
        if event.key() == Qt.Key.Key_Escape and self.answers and loses_nothing:
            self.answers[-1][0].click()
            return
        pressed = QKeySequence(event.key())
        for button, answer in self.answers:
            if answer.key and pressed.matches(QKeySequence(answer.key)) == QKeySequence.SequenceMatch.ExactMatch:
                button.click()
                return
        super().keyPressEvent(event)


LINE_BREAK_HINT = "\u200b"
"""Zero-width space that lets a long name break."""


class FaultDetails(QWidget):
    """Row with subject and code of a fault; “Details” shows what only support needs."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._words = MessageText("", "", "")
        self.code = Text(theme, "", 14, REGULAR, "text2")
        self.toggle_button = Button(theme, self.tr("Details"), "quiet", height_px=36)
        self.copy_button = Button(theme, self.tr("Copy"), "quiet", height_px=36)
        self.text = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        head = row_layout(self.code, STRETCH, self.copy_button, self.toggle_button, gap=8)
        self.setLayout(column_layout(head, self.text, gap=4))
        self.toggle_button.setCheckable(True)
        self.toggle_button.toggled.connect(self._show_text)
        self.copy_button.clicked.connect(lambda: QApplication.clipboard().setText(self.full_text()))

    def show_words(self, words: MessageText) -> None:
        """Show the facts of a fault; hide the row for a message without a code."""
        self._words = words
        self.setVisible(bool(words.code))
        self.code.setText(f"{words.title} · {words.code}")
        self.text.setText(
            "\n".join(
                part.replace("/", f"/{LINE_BREAK_HINT}").replace("_", f"_{LINE_BREAK_HINT}") for part in words.details
            )
        )
        self.toggle_button.setVisible(bool(words.details))
        self.toggle_button.setChecked(False)
        self._show_text(False)

    def full_text(self) -> str:
        """Return everything that IT support needs, as plain text."""
        return "\n".join((f"{self._words.code} {self._words.summary}", *self._words.details))

    def _show_text(self, is_open: bool) -> None:
        self.text.setVisible(is_open)
        self.copy_button.setVisible(is_open)

"""Where faults become messages over the window: cards that stop, one at a time; strips that stay; files written."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QObject, Qt, QTimer, QUrl, Signal
from PySide6.QtGui import QDesktopServices, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QVBoxLayout, QWidget

from carpus.core.errors import CameraLost
from carpus.core.records.new_sessions import Recovered
from carpus.core.records.set_up import PRACTICE_PATIENT
from carpus.core.rounding import rounded
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card, Line
from carpus.ui.controls.layouts import empty, fill, in_column, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Sign, Text
from carpus.ui.fault_words import fault_words
from carpus.ui.messages.details import BREAK, FaultDetails
from carpus.ui.now_open import practice_name
from carpus.ui.theme import Theme
from carpus.ui.translate import tr

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class _Message:
    words: Words
    answers: Sequence[Answer]
    icon: str
    detail: str
    safe_detail: str
    alarm: bool = True


class Messages(QObject):
    """Shows one card at a time, oldest first; the same words are not queued twice. ``told`` carries each fault."""

    told = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host)
        self._theme, self._host = theme, host
        self.card = self._card_on(host)
        self._waiting: list[_Message] = []
        self._shown: _Message | None = None
        self._lost_since_s = 0.0
        self._clock = QTimer(self, interval=1000)
        self._clock.timeout.connect(self._count_wait)

    def _card_on(self, host: QWidget) -> StopCard:
        card = StopCard(host, self._theme)
        card.closed.connect(self._next)
        return card

    @property
    def busy(self) -> bool:
        return self._shown is not None

    def cover(self, host: QWidget) -> None:
        """Lay cards over this part of the window from now on, also the one that is shown; what is beside it stays to be
        seen."""
        if host is self._host:
            return
        self._host, old = host, self.card
        old.closed.disconnect(self._next)
        old.close_sheet()
        old.deleteLater()
        self.card = self._card_on(host)
        if self._shown is not None:
            self._show(self._shown)

    def fault(
        self, fault: Exception, answers: Sequence[Answer] = (), *, detail: str = "", safe_detail: str = ""
    ) -> None:
        """A card for a fault; without answers one that only goes on."""
        words = fault_words(fault)
        log.warning("%s %s", words.code, type(fault).__name__, exc_info=fault)
        self.told.emit(fault)
        icon = "unplug" if isinstance(fault, CameraLost) else ""
        answers = answers or (Answer(self.tr("Go on"), lambda: None),)
        message = _Message(words, tuple(answers), icon, detail, safe_detail)
        known = [self._shown, *self._waiting]
        if any(other is not None and other.words == message.words for other in known):
            return
        self._waiting.append(message)
        if self._shown is None:
            self._next()

    def ask(self, question: Words, answers: Sequence[Answer], *, icon: str = "", detail: str = "") -> None:
        """A card for something that only the person knows; the same question is not asked twice at once."""
        if any(other is not None and other.words == question for other in (self._shown, *self._waiting)):
            return
        self._waiting.append(_Message(question, tuple(answers), icon, detail, "", alarm=False))
        if self._shown is None:
            self._next()

    def withdraw(self, question: Words) -> None:
        """Take a question back that has answered itself."""
        self._waiting = [message for message in self._waiting if message.words != question]
        if self._shown is not None and self._shown.words == question:
            self.card.close_sheet()

    def camera_lost(self, fault: Exception, answers: Sequence[Answer], detail: str, safe_detail: str) -> None:
        """The card that waits for the camera and goes by itself when it is back."""
        self._lost_since_s = time.monotonic()
        self.fault(fault, answers, detail=detail, safe_detail=safe_detail)
        self._count_wait()
        self._clock.start()

    def camera_back(self) -> None:
        self._clock.stop()
        self._waiting = [message for message in self._waiting if message.icon != "unplug"]
        if self._shown is not None and self._shown.icon == "unplug":
            self.card.close_sheet()

    def strip(
        self,
        place: QVBoxLayout,
        words: Words,
        button: str,
        action: Callable[[], None],
        *,
        icon: str = "history",
        later: str = "",
    ) -> NoticeStrip:
        """A strip that stays until it is answered; ``later`` is what the other button says."""
        strip = NoticeStrip(self._theme, words, button, icon, later)
        place.addWidget(strip)

        def gone() -> None:
            place.removeWidget(strip)
            strip.hide()
            strip.deleteLater()

        strip.later.connect(gone)
        strip.answered.connect(gone)
        strip.answered.connect(action)
        return strip

    def recovered_words(self, found: Recovered) -> Words:
        what = self.tr("A session of {name} was cut short on {day} at {time}. It has been recovered.")
        safe = self.tr(
            "All data up to {kept} are safe; at most the last second is missing; more only where the figures came late."
        )
        name = practice_name() if found.patient_id == PRACTICE_PATIENT else found.pseudonym
        day, at = numbers.short_date(found.when), f"{found.when:%H:%M}"
        return Words(
            what.format(name=name, day=day, time=at),
            safe.format(kept=numbers.clock(found.kept_s)),
            self.tr("Review it now, or leave it for later: it stays in the patient's list."),
        )

    def _next(self) -> None:
        self._shown = None
        if self._waiting:
            self._shown = self._waiting.pop(0)
            self._show(self._shown)

    def _show(self, message: _Message) -> None:
        self.card.show_words(
            message.words, message.answers, icon=message.icon, detail=message.detail, safe_detail=message.safe_detail,
            alarm=message.alarm,
        )  # fmt: skip

    def _count_wait(self) -> None:
        seconds = rounded(time.monotonic() - self._lost_since_s)
        if self._shown is not None and self._shown.icon == "unplug":
            self.card.set_waiting(self.tr("Waiting for the camera … {seconds} s").format(seconds=seconds))


class NoticeStrip(Card):
    """``answered`` by the button, ``later`` by the other one or Esc; without words on the button it only tells."""

    answered = Signal()
    later = Signal()

    def __init__(self, theme: Theme, words: Words, button: str, icon: str = "history", later: str = "") -> None:
        super().__init__(theme, 0, "soft", "accent")
        self.words = words
        texts = in_column(Text(theme, words.happened, 20, SEMIBOLD, wrap=True), gap=4)
        for line in (words.safe, words.do):
            if line:
                texts.addWidget(Text(theme, line, 14, REGULAR, wrap=True))
        self.details = FaultDetails(theme)
        texts.addWidget(self.details)
        self.details.show_words(words)
        self.button = Button(theme, button, "plain", height_px=40)
        self.button.setVisible(bool(button))
        self.later_button = Button(theme, later or self.tr("Later"), "quiet", hint=self.tr("Esc"), height_px=36)
        buttons = in_column(self.button, (self.later_button, 0, Qt.AlignmentFlag.AlignHCenter), gap=4)
        row = in_line(
            (Sign(theme, icon, 24, (26, 32)), 0, Qt.AlignmentFlag.AlignTop),
            (texts, 1),
            buttons,
            gap=20,
            margins=(24, 14, 18, 12),
        )
        row.setAlignment(buttons, Qt.AlignmentFlag.AlignTop)  # a stretch here would pull it open on an empty list
        self.body.addLayout(row)
        self.setAccessibleName(" ".join((words.happened, words.safe, words.do)))
        self.button.clicked.connect(self.answered)
        self.later_button.clicked.connect(self.later)


def put_off_last(screen: QWidget) -> bool:
    """Answer the last strip that is shown on a screen by Later, as Esc does; whether there was one."""
    strips = [strip for strip in screen.findChildren(NoticeStrip) if strip.isVisible()]
    if strips:
        strips[-1].later.emit()
    return bool(strips)


MOST_NAMES = 3
"""On the card; a data set has dozens, and each name may need two lines."""


def shown(names: Sequence[str]) -> str:
    """Names for a card.

    >>> shown(["a", "b"]), shown(list("abcdefgh"))
    ('a, b', 'a, b, c, …')
    """
    listed = [name.replace("_", f"_{BREAK}").replace(".", f"{BREAK}.") for name in names[:MOST_NAMES]]
    return ", ".join([*listed, *(["…"] if len(names) > MOST_NAMES else [])])


def tell_written(tell: Messages, folder: str, names: Sequence[str]) -> None:
    """Say what went where, and offer to open the folder."""
    count = len(names)
    what = tr("1 file was written.") if count == 1 else tr("{count} files were written.")
    tell.ask(
        Words(
            what.format(count=count),
            tr("Folder: {folder}").format(folder=folder),
            tr("Files: {names}").format(names=shown(names)),
        ),
        (
            Answer(tr("Open the folder"), lambda: open_folder(folder), "O"),
            Answer(tr("Go on"), lambda: None),
        ),
        icon="download",
    )


def open_folder(folder: str) -> None:
    """Show a folder in the system's own way."""
    QDesktopServices.openUrl(QUrl.fromLocalFile(folder))


WIDTH_PX = 720


@dataclass(frozen=True, slots=True)
class Answer:
    """A button that says what it does; ``key`` a letter that presses it. ``risky`` where something would be lost, or be
    kept that may be wrong: never the default."""

    text: str
    action: Callable[[], object]
    key: str = ""
    risky: bool = False


class StopCard(Sheet):
    """Shows :class:`Words` with up to two answers; the last one is the primary, has the keyboard, and
    loses nothing: where the other one is risky, or nothing went wrong, Esc gives it too."""

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, WIDTH_PX, may_close=False)
        self.what = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.detail = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self.safe = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.safe_detail = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.todo = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.waiting = Text(theme, "", 14, REGULAR, "text2")
        self._icon, self._icon_safe, onward = (
            Sign(theme, name, 26, (44, 40), lean=0.5) for name in ("unplug", "good", "chevron-right")
        )
        self._buttons = in_line(gap=12)
        self._answers: list[tuple[Button, Answer]] = []
        self._alarm = True
        body = self.card.body
        body.setContentsMargins(32, 24, 32, 24)
        body.setSpacing(14)
        rows = (
            (self._icon, self.what, self.detail),
            (self._icon_safe, self.safe, self.safe_detail),
            (onward, self.todo),
        )
        for icon, *words in rows:
            row = in_line((icon, 0, Qt.AlignmentFlag.AlignVCenter), gap=24)
            row.addLayout(in_column(*words, gap=2), 1)
            fill(body, row, Line(theme))
        self.details = FaultDetails(theme)
        fill(body, self.details, in_line((self.waiting, 1), self._buttons))

    def show_words(
        self, words: Words, answers: Sequence[Answer], *, icon: str = "", detail: str = "", safe_detail: str = "",
        alarm: bool = True,
    ) -> None:  # fmt: skip
        """Open with the three answers; details are what only the moment knows (times, counts). Without ``alarm``
        nothing went wrong: a question, or good news, and no red."""
        for head, text in ((self.what, words.happened.rstrip(".")), (self.safe, words.safe), (self.todo, words.do)):
            head.setText(text)
        self.details.show_words(words)
        self.detail.say(detail)
        self.safe_detail.say(safe_detail)
        self._icon.show_sign(icon or ("bad" if alarm else "circle-help"), "bad" if alarm else "accent", 36)
        self._icon_safe.show_sign("good", size_px=26)
        self.waiting.setText("")
        self.card.set_colors("surface", *(("bad", 2.0) if alarm else ("line", 1.0)))
        self.setAccessibleName(" ".join((words.happened, detail, words.safe, safe_detail, words.do)))
        if answers and answers[-1].risky:
            raise ValueError(f"what Enter answers loses nothing: {answers[-1].text}")
        empty(self._buttons)
        self._answers, self._alarm = [], alarm
        for number, answer in enumerate(answers):
            primary = number == len(answers) - 1
            button = Button(self._theme, answer.text, "primary" if primary else "plain", hint=answer.key, height_px=48)
            button.clicked.connect(lambda _=False, answer=answer: self._take(answer))
            self._buttons.addWidget(button)
            self._answers.append((button, answer))
        if self._answers:
            self.set_default(self._answers[-1][0])
        self.open()

    def set_waiting(self, words: str) -> None:
        self.waiting.setText(words)

    @property
    def answers(self) -> list[Button]:
        return [button for button, _ in self._answers]

    def _take(self, answer: Answer) -> None:
        self.close_sheet()
        answer.action()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        loses_nothing = not self._alarm or any(answer.risky for _, answer in self._answers)
        if event.key() == Qt.Key.Key_Escape and self._answers and loses_nothing:
            self._answers[-1][0].click()
            return
        pressed = QKeySequence(event.key())
        for button, answer in self._answers:
            if answer.key and pressed.matches(QKeySequence(answer.key)) == QKeySequence.SequenceMatch.ExactMatch:
                button.click()
                return
        super().keyPressEvent(event)

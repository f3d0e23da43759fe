"""What test-retest sessions give as error limits: shown, and taken if the person wants them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from datetime import date

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from carpus.core.agreement.retest import StudyFigures
from carpus.core.measures.change import FEWEST_PEOPLE, RetestStudy
from carpus.ui.controls.button import Button
from carpus.ui.controls.layouts import empty, host_of, in_column, scrolled
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, Text
from carpus.ui.settings.limits import study_view
from carpus.ui.theme import Theme
from carpus.ui.translate import tr
from carpus.ui.verdicts import reason_words

HEIGHT_PX = 400
BESIDE_PX = 320
"""Title, words and buttons, with the room around the sheet."""


class RetestSheet(Sheet):
    """Emits ``accepted`` with the studies that are to be the clinic's own error limits."""

    accepted = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 760)
        words = self.tr(
            "From people who were measured more than once, all discs taken off and put on again in between: standard "
            "error of measurement (SEM) and smallest real change (MDC95), with 95 % intervals."
        )
        self.head(self.tr("Limits from test-retest sessions"), words)
        self._column = in_column(gap=16)
        self._area = scrolled(self._column)
        self.card.body.addWidget(self._area)
        self.take = Button(theme, self.tr("&Use these limits"), "primary", height_px=44)
        self.close_button = self.answer_row(self.take, words=self.tr("Leave it as it is"))
        self.set_default(self.close_button)
        self.take.clicked.connect(self._take)
        self._usable: list[RetestStudy] = []

    def begin(self, found: Sequence[StudyFigures], unreadable: int, today: date) -> None:
        """Show the study of each exercise, and how many sessions could not be read."""
        empty(self._column)
        self._usable = [one.study(today.isoformat()) for one in found if one.is_usable]
        for one in found:
            self._column.addWidget(study_view(self._theme, one.study(today.isoformat()), found_words(one)))
        if unreadable:
            words = self.tr("Sessions that cannot be read: {count}").format(count=unreadable)
            self._column.addWidget(Text(self._theme, words, 14, REGULAR, "warn", wrap=True))
        self._column.addStretch(1)
        self.take.setEnabled(bool(self._usable))
        self.open()

    def _take_room(self) -> None:
        super()._take_room()
        if hasattr(self, "_area"):  # not while the sheet is being made
            room = host_of(self).height() - self._theme.px(BESIDE_PX)
            self._area.setFixedHeight(max(min(self._theme.px(HEIGHT_PX), room), self._theme.px(80)))

    def _take(self) -> None:
        self.close_sheet()
        self.accepted.emit(self._usable)


def found_words(found: StudyFigures) -> str:
    """Who was measured, whether it may be used, and what was left out."""
    said = [tr("People: {people}, sessions: {sessions}.").format(people=found.people, sessions=found.sessions)]
    if found.simulated:
        said.append(tr("Limits of a simulated hand are never used."))
    elif not found.is_usable:
        said.append(tr("Not usable yet: {count} people are the least, 20 are better.").format(count=FEWEST_PEOPLE))
    reasons = Counter(_left_out_words(left.reason) for left in found.left_out)
    if reasons:
        words = ", ".join(f"{count} ({reason})" for reason, count in reasons.items())
        said.append(tr("Left out: {sessions}.").format(sessions=words))
    return " ".join(said)


def _left_out_words(reason: str) -> str:
    words = {"once": tr("measured once"), "too_late": tr("more than 14 days later")}
    return words.get(reason) or reason_words([reason])

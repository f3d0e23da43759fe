"""Dialog with the MDC95 of test-retest sessions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from datetime import date

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from carpus.core.measures.change_limits import MIN_PEOPLE, RetestStudy
from carpus.core.research.agreement.retest import RetestAnalysis
from carpus.ui.kit.button import Button
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.layouts import clear_layout, column_layout, require_parent, scroll_column
from carpus.ui.kit.text import REGULAR, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.screens.settings.limits_card import study_view
from carpus.ui.words.progress import reason_words

HEIGHT_PX = 400
MARGINS_PX = 320
"""Height of title, texts, buttons and margins."""


class RetestDialog(Dialog):
    """Studies found in a folder.

    Signals: ``accepted`` with those to use.
    """

    accepted = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 760)
        words = self.tr(
            "Based on people measured more than once, with all markers removed and replaced in between. Shows the "
            "standard error of measurement (SEM) and MDC95 with 95 % confidence intervals."
        )
        self.add_heading(self.tr("MDC95 from test–retest sessions"), words)
        self._column = column_layout(gap=16)
        self._area = scroll_column(self._column)
        self.card.body.addWidget(self._area)
        self.accept_button = Button(theme, self.tr("&Use these values"), "primary", height_px=44)
        self.close_button = self.add_buttons(self.accept_button, cancel_text=self.tr("Cancel"))
        self.set_default(self.close_button)
        self.accept_button.clicked.connect(self._accept)
        self._usable: list[RetestStudy] = []

    def show_studies(self, found: Sequence[RetestAnalysis], unreadable: int, today: date) -> None:
        """Show the study of each exercise and the number of unreadable sessions."""
        clear_layout(self._column)
        self._usable = [one.to_study(today.isoformat()) for one in found if one.is_usable]
        for one in found:
            self._column.addWidget(study_view(self._theme, one.to_study(today.isoformat()), study_summary(one)))
        if unreadable:
            words = self.tr("Unreadable sessions: {count}").format(count=unreadable)
            self._column.addWidget(Text(self._theme, words, 14, REGULAR, "warn", wrap=True))
        self._column.addStretch(1)
        self.accept_button.setEnabled(bool(self._usable))
        self.open()

    def _fit_card(self) -> None:
        super()._fit_card()
        room = require_parent(self).height() - self._theme.px(MARGINS_PX)
        self._area.setFixedHeight(max(min(self._theme.px(HEIGHT_PX), room), self._theme.px(80)))

    def _accept(self) -> None:
        self.close_dialog()
        self.accepted.emit(self._usable)


def study_summary(found: RetestAnalysis) -> str:
    """Return who was measured, whether the study is usable, and what was excluded."""
    sentences = [tr("People: {people}, sessions: {sessions}.").format(people=found.people, sessions=found.sessions)]
    if found.simulated:
        sentences.append(tr("Values of a simulated hand are never used."))
    elif not found.is_usable:
        sentences.append(
            tr("Not usable yet: at least {count} people are needed, 20 are better.").format(count=MIN_PEOPLE)
        )
    exclusions = {"once": tr("measured once"), "too_late": tr("more than 14 days later")}
    reasons = Counter(exclusions.get(left.reason) or reason_words([left.reason]) for left in found.excluded)
    if reasons:
        words = ", ".join(f"{count} ({reason})" for reason, count in reasons.items())
        sentences.append(tr("Excluded: {sessions}.").format(sessions=words))
    return " ".join(sentences)

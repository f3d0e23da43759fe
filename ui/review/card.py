"""The card of results: what was done, what can be made of it, and its tables."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QBoxLayout, QWidget

from carpus.core.results.side_by_side import partner_of
from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.layouts import STRETCH, in_line
from carpus.ui.controls.text import REGULAR, SEMIBOLD, ElidedText, Text, plain_tooltip
from carpus.ui.report.main_figure import main_figure
from carpus.ui.report.tables import repetition_words
from carpus.ui.report.words import corrected_words
from carpus.ui.review.result_tables import ResultTables
from carpus.ui.review.reviewed import Reviewed
from carpus.ui.theme import Theme, is_tight
from carpus.ui.translate import inside

LEAST_TABLE_PX = 84
"""The head of the table and two rows."""


class ReviewCard(Card):
    """``beside_wanted`` carries the session that this one is best held against."""

    beside_wanted = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, 20)
        self._theme = theme
        self._partner_id = ""
        self.title = Text(theme, self.tr("Range of motion"), 16, SEMIBOLD)
        self.title.setMinimumWidth(1)
        self.count = ElidedText(theme, "", 14, REGULAR, "text2")  # one line: what it says comes when all has its place
        self.again_button = Button(theme, self.tr("Another set"), "quiet", icon="plus")
        self.count_button = Button(theme, self.tr("Do not count"), "quiet")
        self.count_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # Space stays with the player after a click
        self.count_button.setToolTip(self.tr("The session stays, and is compared with none. Can be taken back."))
        self.beside_button = Button(theme, self.tr("Side by side…"), "quiet")
        self.beside_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.export_button = Button(theme, self.tr("Export…"), hint="Ctrl+E")
        self.report_button = Button(
            theme, self.tr("Make report"), "primary", icon="file-text", hint="Ctrl+P", height_px=44
        )
        self.beside_button.clicked.connect(lambda: self.beside_wanted.emit(self._partner_id))
        self.tables = ResultTables(theme)
        said = self._said = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        said.setSpacing(12)
        said.addWidget(self.title)
        said.addWidget(self.count, 1)
        buttons = (self.count_button, self.beside_button, self.again_button, self.export_button, self.report_button)
        self.body.setContentsMargins(24, 4, 16, 4)
        self.body.setSpacing(4)
        self.body.addLayout(said)
        self.body.addLayout(in_line(STRETCH, *buttons, gap=12))
        self.body.addWidget(self.tables)

    def show_places(self, *, whole_hand: bool) -> None:
        """The places of a session that is still being read, with nothing of the one before."""
        self.tables.show_places(whole_hand=whole_hand)
        self.count.setText("\N{NO-BREAK SPACE}")
        self.tables.show_nothing()

    def show_session(self, reviewed: Reviewed) -> None:
        """What was done, with which hand and when, the figure that the list of sessions names, and the tables."""
        figures = reviewed.figures
        self.tables.show_session(reviewed)
        hand = inside(terms.hand_name(figures.side))
        when = f"{numbers.short_date(figures.when)} {figures.when:%H:%M}"
        what = f"{terms.exercise_name(figures.exercise.id)}, {hand} · {when}"
        self.title.setText(" · ".join(filter(None, (what, main_figure(figures)))))
        said = " · ".join(filter(None, (repetition_words(figures), corrected_words(figures).rstrip("."))))
        self.count.setText(said)
        self.count.setToolTip(plain_tooltip(said))
        self._show_partner(reviewed)
        counts = self.tr("Let it count again") if figures.not_counted else self.tr("Do not count")
        self.count_button.set_face(counts)

    def _show_partner(self, reviewed: Reviewed) -> None:
        """What the session is best held against; without one the button says so."""
        partner = partner_of(reviewed.history, reviewed.figures)
        self._partner_id = "" if partner is None else partner.session_id
        self.beside_button.setEnabled(partner is not None)
        words = self.tr("No other session of this exercise yet.")
        if partner is not None:
            words = self.tr("Beside the {hand} of {day} (B)").format(
                hand=terms.hand_name(partner.side).lower(),
                day=numbers.day_beside(partner.when, reviewed.figures.when),
            )
        self.beside_button.setToolTip(words)

    def fit(self, screen: QWidget, *, whole_hand: bool) -> None:
        """The tables take the rows they have; with large text they scroll and the curves keep a panel."""
        tight = is_tight(screen, self._theme)
        self.report_button.set_face(self.report_button.text(), hint="" if tight else "Ctrl+P")
        self.export_button.set_face(self.export_button.text(), hint="" if tight else "Ctrl+E")
        self.again_button.set_face(self.again_button.text(), icon="" if tight else "plus")
        most = screen.height() * (0.36 if tight else 0.42 if whole_hand else 0.48)
        fewest, beside = LEAST_TABLE_PX * self._theme.text_scale, QBoxLayout.Direction.LeftToRight
        # With large text what was left out, and why, has a line of its own where the table can spare one.
        self._said.setDirection(QBoxLayout.Direction.TopToBottom if tight else beside)
        room = self._room_px(screen)
        if room < fewest:
            self._said.setDirection(beside)
            room = self._room_px(screen)
        # Of the whole hand always more than there is room for: its place is known before it is read.
        needed = most if whole_hand else self.tables.needed_px() + 2
        self.tables.setFixedHeight(round(max(min(needed, most, room), fewest)))

    def _room_px(self, screen: QWidget) -> int:
        """What is left for the tables when all else keeps its least height; the card must not be pushed together."""
        whole, width = screen.layout(), screen.width()
        assert whole is not None
        self.body.activate()  # its line may just have become two, and its widget keeps the height it had before
        whole.invalidate()  # the text may just have become larger
        least = whole.minimumHeightForWidth(width) if whole.hasHeightForWidth() else whole.minimumSize().height()
        return screen.height() - (least - self.tables.minimumHeight())

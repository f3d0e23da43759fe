"""What goes, what stays, what cannot be undone; the archive is what is offered."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date, datetime

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card, Line
from carpus.ui.controls.column import ScrolledColumn, scroll_area
from carpus.ui.controls.layouts import STRETCH, in_column, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Sign, Text
from carpus.ui.theme import Theme
from carpus.ui.translate import inside

ICON_PX, COLUMN_PX = 26, 72
MOST_PATHS = 3


@dataclass(frozen=True, slots=True)
class ErasureFacts:
    """What is said before a session, or with ``when`` None a patient, is erased.

    ``made``: reports and exports that Carpus saved elsewhere; they stay. ``others`` counts the patient's sessions that
    stay. ``kept_until`` None where no years are set, ``last_backup`` None before the first. ``by_hand``: values that a
    person measured, which go with a patient.
    """

    pseudonym: str
    when: datetime | None
    exercise: str
    side: str
    sessions: int
    files: int
    size_mb: float
    made: tuple[str, ...]
    others: int
    last_backup: datetime | None
    kept_until: date | None
    retention_years: int
    today: date
    by_hand: int = 0


class EraseSheet(Sheet):
    """``erase`` only after the pseudonym was typed, and never by Enter; ``archive`` is the primary, which Enter takes,
    also from the line to type in: what is typed presses nothing."""

    erase = Signal()
    archive = Signal()

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 760)
        self.card.set_colors("surface", "bad", 2.0)
        self._pseudonym = ""
        self.title = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.about = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.goes, self.stays, self.ends = (Text(theme, "", 14, REGULAR, "text2", wrap=True) for _ in range(3))
        self.label = Text(theme, "", 14, wrap=True)
        self.line = QLineEdit()
        self.line.setMinimumWidth(theme.px(200))
        self.line.textChanged.connect(self._check)
        self.for_good = Button(theme, self.tr("Erase for good"), "plain", height_px=52)
        self.for_good.on_enter = "nothing"  # what cannot be undone takes the mouse or the space bar
        self.cancel = Button(theme, self.tr("Cancel"), "plain", hint=self.tr("Esc"), height_px=52)
        self.instead = Button(theme, self.tr("Archive instead"), "primary")
        self.for_good.clicked.connect(self._erase)
        self.cancel.clicked.connect(self.close_sheet)
        self.instead.clicked.connect(self._archive)
        self.set_default(self.instead)
        self._lay_out(theme)

    def _lay_out(self, theme: Theme) -> None:
        body = self.card.body
        body.setSpacing(10)
        self._parts = ScrolledColumn()
        column = in_column(
            _section(theme, _sign(theme, "trash-2", "bad"), self.title, self.about),
            gap=10,
            margins=(0, 0, 0, 0),
            within=self._parts,
        )
        for sign, title, words in (
            (_sign(theme, "bad"), self.tr("This goes"), self.goes),
            (_sign(theme, "good"), self.tr("This stays"), self.stays),
            (_sign(theme, "warn"), self.tr("This cannot be undone"), self.ends),
        ):
            column.addWidget(Line(theme))
            column.addLayout(_section(theme, sign, Text(theme, title, 20, SEMIBOLD), words))
        column.addWidget(Line(theme))
        milder = Card(theme, 0, "soft", "soft")
        offered = Text(
            theme, self.tr("Leaves all lists and counts nowhere; everything can be brought back."), wrap=True
        )
        milder.body.setContentsMargins(0, 12, 12, 12)
        milder.body.addLayout(
            _section(
                theme,
                _sign(theme, "archive"),
                Text(theme, self.tr("Archive instead"), 16, SEMIBOLD),
                offered,
            )
        )
        column.addWidget(milder)
        self._scroll = scroll_area(self._parts)  # large text on a small screen: the answer stays to be seen
        body.addWidget(self._scroll)
        body.addLayout(in_line((self.label, 1), (self.line, 1), gap=16))
        body.addSpacing(8)
        body.addLayout(in_line(self.for_good, STRETCH, self.cancel, self.instead))

    def begin(self, facts: ErasureFacts) -> None:
        """Say what goes and what stays, and wait."""
        self._pseudonym = facts.pseudonym
        single = facts.when is not None
        self.title.setText(
            self.tr("Erase this session for good?") if single else self.tr("Erase this patient for good?")
        )
        self.about.setText(self._about(facts))
        self.goes.setText(self._goes(facts))
        self.stays.setText(self._stays(facts))
        self.ends.setText(self._ends(facts))
        self.label.setText(self.tr("To erase, type “{name}” here").format(name=facts.pseudonym))
        self.line.clear()
        self.line.setAccessibleName(self.label.text())
        self._check()
        self.open(self.line)
        self._fit()

    def _fit(self) -> None:
        """As high as the texts need, as far as there is room."""
        column = self._parts.layout()
        assert column is not None
        column.activate()
        wanted = column.totalHeightForWidth(self.card.width() - 48 - 12)
        room = self.height() - self._theme.px(52 + 40 + 18) - 120
        self._scroll.setFixedHeight(max(min(wanted, room), self._theme.px(160)))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self.isVisible():
            self._fit()

    def _about(self, facts: ErasureFacts) -> str:
        if facts.when is None:
            return facts.pseudonym
        what = f"{terms.exercise_name(facts.exercise)}, {inside(terms.hand_name(facts.side))}"
        return " · ".join((facts.pseudonym, numbers.report_date(facts.when), what))

    def _goes(self, facts: ErasureFacts) -> str:
        files = self.tr("1 file") if facts.files == 1 else self.tr("{count} files").format(count=facts.files)
        size = f"{facts.size_mb:.0f}" if facts.size_mb >= 10 else numbers.fixed(facts.size_mb, 1)
        if facts.when is None:
            what = self.tr(
                "The patient’s entry, real name and notes, and {count} sessions with all angles, pictures and notes "
                "({files}, {size} MB)."
            )
            if facts.sessions == 1:
                what = self.tr(
                    "The patient’s entry, real name and notes, and 1 session with all angles, pictures and notes "
                    "({files}, {size} MB)."
                )
            words = what.format(count=facts.sessions, files=files, size=size)
            if facts.by_hand == 1:
                words = f"{words} {self.tr('1 value measured by hand.')}"
            elif facts.by_hand:
                words = f"{words} {self.tr('{count} values measured by hand.').format(count=facts.by_hand)}"
        else:
            what = self.tr("Angles, pictures, notes and pain scores of this session ({files}, {size} MB).")
            words = what.format(files=files, size=size)
        return words

    def _stays(self, facts: ErasureFacts) -> str:
        parts = []
        if facts.others:
            other = self.tr("The other session.") if facts.others == 1 else self.tr("The other {count} sessions.")
            parts.append(other.format(count=facts.others))
        if facts.last_backup is not None:
            day = numbers.day_of_year(facts.last_backup)
            parts.append(
                self.tr("Back-ups up to {day} and files copied elsewhere: Carpus cannot reach them.").format(day=day)
            )
        else:
            parts.append(self.tr("Files copied elsewhere: Carpus cannot reach them."))
        if facts.made:
            words = self.tr("Reports and exports saved elsewhere, delete them yourself ({n}): {path}.")
            paths = ", ".join(facts.made[:MOST_PATHS]) + (", …" if len(facts.made) > MOST_PATHS else "")
            parts.append(words.format(n=len(facts.made), path=paths))
        parts.append(self.tr("The log keeps that it was erased, no name."))
        return " ".join(parts)

    def _ends(self, facts: ErasureFacts) -> str:
        words = self.tr("Nobody can bring it back.")
        if facts.kept_until is not None:
            until = facts.kept_until
            day = numbers.day_of_year(until)
            years = self.tr("({years} years, as set in Settings)").format(years=facts.retention_years)
            if facts.today <= until:
                early = self.tr("Your records must be kept until {day} {years}: erasing comes before that day.")
                return f"{words} {early.format(day=day, years=years)}"
            return f"{words} {self.tr('They had to be kept until {day} {years}.').format(day=day, years=years)}"
        return words

    def _check(self) -> None:
        typed = " ".join(self.line.text().split())
        self.for_good.setEnabled(bool(typed) and typed.casefold() == self._pseudonym.casefold())

    def _erase(self) -> None:
        self.close_sheet()
        self.erase.emit()

    def _archive(self) -> None:
        self.close_sheet()
        self.archive.emit()


def _sign(theme: Theme, name: str, token: str = "accent") -> Sign:
    """A state, or a line icon, in a column of its own."""
    return Sign(theme, name, ICON_PX, (COLUMN_PX, ICON_PX + 4), token, lean=0.33)


def _section(theme: Theme, sign: QWidget, title: QWidget, words: QWidget) -> QHBoxLayout:
    texts = in_column(title, words, gap=4)
    return in_line((sign, 0, Qt.AlignmentFlag.AlignTop), (texts, 1), gap=0)

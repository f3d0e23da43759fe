"""All sessions of a patient, newest first, and what can be done with the chosen one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QModelIndex, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from carpus.core.hand.exercises import exercise_named, exercises_of
from carpus.core.records.set_up import PRACTICE_PATIENT
from carpus.ui import numbers, terms
from carpus.ui.background import Background
from carpus.ui.controls.button import ENTER, Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.layouts import ScrollArea, in_column, in_line
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text, heading
from carpus.ui.keys import KEYS, bind
from carpus.ui.sessions.listing import SessionLine, SessionList, cells, remark
from carpus.ui.sessions.sheets import ChooseSheet, SetAsideSheet
from carpus.ui.theme import MARGIN_PX, Theme

if TYPE_CHECKING:  # it reads and writes files
    from carpus.ui.sessions.stored import StoredSessions


class SessionsScreen(QWidget):
    """``opened`` carries a session to be reviewed, ``progress`` one to be compared with, ``pair_wanted`` two to be
    shown side by side, ``erase_wanted`` one to be archived or erased, ``archive_wanted`` the patient whose archived
    ones are asked for; ``told`` a fault; ``changed`` that
    something of the patient's sessions is different now."""

    opened = Signal(str)
    progress = Signal(str)
    erase_wanted = Signal(str)
    pair_wanted = Signal(str, str)
    archive_wanted = Signal(str)
    told = Signal(object)
    moved = Signal(str)
    """To whom, by name."""
    changed = Signal()

    def __init__(self, theme: Theme, background: Background, stored: StoredSessions) -> None:
        super().__init__()
        self._theme, self._background, self._stored = theme, background, stored
        self._patient_id = self._pseudonym = ""
        self._round = 0
        self.title = heading(theme)
        self.none = Text(theme, self.tr("No session yet."), 16, REGULAR, "text2")
        self.notice_place = QVBoxLayout()
        self.list = SessionList(theme)
        self.archive_button = Button(theme, "", "quiet", icon="archive", height_px=36)
        self.what = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.figure = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.facts = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.remark = Text(theme, "", 14, SEMIBOLD, "warn", wrap=True)
        self.open_button = Button(theme, self.tr("Open in review"), "primary", hint=ENTER)
        self.pair_button = Button(theme, "", height_px=40)
        self.compare_button = Button(theme, self.tr("Compare in &progress"), height_px=40)
        self.aside_button = Button(theme, "", height_px=40)
        self.move_button = Button(theme, self.tr("&Move to another patient…"), height_px=40)
        self.rename_button = Button(theme, self.tr("Change the &exercise…"), height_px=40)
        self.erase_button = Button(theme, self.tr("Archive or &delete…"), "quiet", icon="trash-2", height_px=40)
        self.aside_sheet = SetAsideSheet(self, theme)
        self.move_sheet = ChooseSheet(self, theme)
        self.rename_sheet = ChooseSheet(self, theme)
        self._pair_key = KEYS["compare_ticked"]
        self._lay_out()
        self._connect()

    def _lay_out(self) -> None:
        left = in_column(
            self.title,
            self.notice_place,
            self.none,
            (self.list, 1),
            (self.archive_button, 0, Qt.AlignmentFlag.AlignLeft),
            gap=12,
        )
        left.addStretch(0)
        self._card = Card(self._theme, 20)
        body = self._card.body
        body.setSpacing(10)
        for widget in (self.what, self.figure, self.facts, self.remark):
            body.addWidget(widget)
        body.addStretch(1)
        for button in (
            self.open_button, self.pair_button, self.compare_button, self.aside_button,
            self.move_button, self.rename_button, self.erase_button,
        ):  # fmt: skip
            body.addWidget(button)
        self._right = ScrollArea(self._card)
        in_line(
            (left, 1),
            self._right,
            gap=MARGIN_PX,
            margins=(MARGIN_PX, MARGIN_PX - 4, MARGIN_PX, MARGIN_PX - 4),
            within=self,
        )
        self._theme.changed.connect(self._fit)
        self._fit()

    def _fit(self) -> None:
        self._right.setFixedWidth(self._theme.px(384))

    def _connect(self) -> None:
        bind(self, "compare_ticked", self.pair_button.click)
        bind(self.list, "tick", self.list.tick_current)
        self.list.ticks_changed.connect(self._show_ticks)
        self.pair_button.clicked.connect(self.compare_ticked)
        self.list.selectionModel().currentChanged.connect(lambda *_: self._show_chosen())
        self.list.doubleClicked.connect(lambda _: self.open_chosen())
        self.open_button.clicked.connect(self.open_chosen)
        self.compare_button.clicked.connect(lambda: self._emit_chosen(self.progress))
        self.aside_button.clicked.connect(self._set_aside_or_back)
        self.move_button.clicked.connect(self._ask_move)
        self.rename_button.clicked.connect(self._ask_rename)
        self.erase_button.clicked.connect(self._ask_erase)
        self.archive_button.clicked.connect(lambda: self.archive_wanted.emit(self._patient_id))
        self.aside_sheet.kept.connect(self._set_aside)
        self.move_sheet.chosen.connect(
            lambda patient_id: self._do(lambda line: self._move(line.entry.session_id, patient_id), self.moved.emit)
        )
        self.rename_sheet.chosen.connect(
            lambda exercise: self._do(lambda line: self._stored.rename_exercise(line.entry.session_id, exercise))
        )

    # --- showing ------------------------------------------------------------------------------------------
    def begin(self, patient_id: str, pseudonym: str, choose: str = "") -> None:
        self._patient_id, self._pseudonym = patient_id, pseudonym
        self._round += 1
        number = self._round
        lines = self._stored.lines(patient_id)
        self.title.setText(self.tr("Sessions of {name}").format(name=pseudonym))
        self.list.rows.show_lines(lines)
        self._show_ticks()
        archived = self._stored.archived(patient_id)
        self.archive_button.setVisible(archived > 0)
        self.archive_button.set_face(self.tr("In the archi&ve: {n}").format(n=archived))
        self.none.setVisible(not lines)
        self.list.setVisible(bool(lines))
        row = max(0, self.list.rows.find(choose))
        if lines:
            self.list.setCurrentIndex(self.list.rows.index(row))
        self._show_chosen()
        for line in lines:
            self._background.run(
                lambda line=line: self._stored.with_figures(line),  # type: ignore[misc]
                lambda known: self._take_figures(number, known),
                lambda _: None,
                self,
            )

    def _take_figures(self, number: int, line: SessionLine) -> None:
        if number == self._round:
            self.list.rows.show_line(line)
            self._show_chosen()
            self._show_ticks()

    def chosen(self) -> SessionLine | None:
        index: QModelIndex = self.list.currentIndex()
        return self.list.rows.lines[index.row()] if index.isValid() else None

    def first(self) -> QWidget:
        return self.list if self.list.rows.lines else self

    def _show_chosen(self) -> None:
        line = self.chosen()
        self._right.setVisible(line is not None)
        if line is None:
            return
        self.what.setText(terms.exercise_name(line.entry.exercise))
        self.figure.setText(line.figure or ("–" if line.damaged else self.tr("Reading…")))
        facts = (
            cells(line, self.list.rows.lines)[0], terms.hand_name(line.entry.hand),
            numbers.clock(line.entry.duration_s + 0.5), line.counted_words, line.corrected.rstrip("."),
        )  # fmt: skip
        self.facts.setText(" · ".join(fact for fact in facts if fact))
        self.remark.say(" · ".join(part for part in (remark(line), line.warning) if part))
        back = self.tr("&Take back: let it count")
        self.aside_button.set_face(back if line.set_aside else self.tr("&Set aside…"))
        practice = self._patient_id == PRACTICE_PATIENT
        self.move_button.setVisible(not practice)
        for button in (
            self.open_button, self.compare_button, self.aside_button, self.rename_button,
        ):  # fmt: skip
            button.setEnabled(not line.damaged)

    # --- what is done -------------------------------------------------------------------------------------
    def open_chosen(self) -> None:
        if self.open_button.isEnabled():
            self._emit_chosen(self.opened)

    def compare_ticked(self) -> None:
        ticked = self.list.rows.ticked
        if len(ticked) == 2:
            self.pair_wanted.emit(*ticked)

    def _show_ticks(self) -> None:
        lines = [line for line in self.list.rows.lines if line.entry.session_id in self.list.rows.ticked]
        words = {
            0: self.tr("Tick two to compare them"), 1: self.tr("Tick one more to compare"),
            2: self.tr("Compare the 2 ticked"),
        }[len(lines)]  # fmt: skip
        self.pair_button.setEnabled(len(lines) == 2 and not any(line.damaged for line in lines))
        self.pair_button.set_face(words, hint=self._pair_key if len(lines) == 2 else "")

    def _emit_chosen(self, signal) -> None:  # type: ignore[no-untyped-def]
        line = self.chosen()
        if line is not None:
            signal.emit(line.entry.session_id)

    def _set_aside_or_back(self) -> None:
        line = self.chosen()
        if line is not None and line.set_aside:
            self._set_aside("")
        elif line is not None:
            self.aside_sheet.begin()

    def _set_aside(self, reason: str) -> None:
        self._do(lambda line: self._stored.set_aside(line.entry.session_id, reason))

    def _ask_move(self) -> None:
        words = self.tr("It then counts in the other patient’s progress, and no more in that of {name}.")
        self.move_sheet.begin(
            self.tr("To whom does this session belong?"),
            words.format(name=self._pseudonym),
            self.tr("Move it there"),
            [one for one in self._stored.other_patients(self._patient_id) if one[0] != self._patient_id],
        )

    def _ask_rename(self) -> None:
        line = self.chosen()
        if line is None:
            return
        alike = exercises_of(exercise_named(line.entry.exercise).protocol)
        others = [one.id for one in alike if one.id != line.entry.exercise]
        self.rename_sheet.begin(
            self.tr("Which exercise was it?"),
            self.tr("Repetitions and figures are worked out anew. The recording itself is not changed."),
            self.tr("It was this one"),
            [(one, terms.exercise_name(one)) for one in others],
        )

    def _ask_erase(self) -> None:
        line = self.chosen()
        if line is not None:
            self.erase_wanted.emit(line.entry.session_id)

    def _move(self, session_id: str, patient_id: str) -> str:
        self._stored.move(session_id, patient_id)
        return dict(self._stored.other_patients(self._patient_id))[patient_id]

    def _do(self, action, told=lambda _: None) -> None:  # type: ignore[no-untyped-def]
        line = self.chosen()
        if line is None:
            return

        def done(result: object) -> None:
            self.changed.emit()
            self.begin(self._patient_id, self._pseudonym, line.entry.session_id)
            self.first().setFocus(Qt.FocusReason.OtherFocusReason)
            told(result)

        self._background.run(lambda: action(line), done, self.told.emit, self)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.open_chosen()
        elif event.key() == Qt.Key.Key_Delete:
            self._ask_erase()
        else:
            super().keyPressEvent(event)

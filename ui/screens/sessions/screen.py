"""Session list of a patient, newest first, with actions for the selected session."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from carpus.core.model.hand.exercises import exercises_for_protocol, get_exercise
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.ui.kit import numbers
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import ENTER_KEY, Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.keys import KEYS, bind_key
from carpus.ui.kit.layouts import ScrollArea, column_layout, row_layout
from carpus.ui.kit.table import ListHeader
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Text, heading
from carpus.ui.kit.theme import MARGIN_PX, Theme
from carpus.ui.screens.sessions.dialogs import ChoiceDialog, ExcludeDialog
from carpus.ui.screens.sessions.session_list import (
    SessionLine,
    SessionList,
    SessionStore,
    header_columns,
    place_headings,
    remark,
    row_cells,
)
from carpus.ui.words import terms


class SessionsScreen(QWidget):
    """Session list.

    Signals carry session ids: ``open_requested`` for the review, ``progress_requested``, ``pair_requested`` for two
    to compare, ``delete_requested``; ``archive_requested`` carries the patient, ``fault_raised`` a fault.
    ``sessions_changed`` follows each change.
    """

    open_requested = Signal(str)
    progress_requested = Signal(str)
    delete_requested = Signal(str)
    pair_requested = Signal(str, str)
    archive_requested = Signal(str)
    fault_raised = Signal(object)
    session_moved = Signal(str)
    """Carries the name of the patient it was moved to."""
    sessions_changed = Signal()

    def __init__(self, theme: Theme, background: Background, store: SessionStore) -> None:
        super().__init__()
        self._theme, self._background, self._store = theme, background, store
        self._patient_id = self._pseudonym = ""
        self._request_number = 0
        self.title = heading(theme)
        self.empty_text = Text(theme, self.tr("No session yet."), 16, REGULAR, "text2")
        self.notice_layout = QVBoxLayout()
        self.list = SessionList(theme)
        self.header = ListHeader(theme, self.list, header_columns(), place_headings)
        self.archive_button = Button(theme, "", "quiet", icon="archive", height_px=36)
        self.exercise_text = Text(theme, "", 20, SEMIBOLD, wrap=True)
        self.limit_text = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.value_text = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.facts_text = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.remark_text = Text(theme, "", 14, SEMIBOLD, "warn", wrap=True)
        self.open_button = Button(theme, self.tr("Open in review"), "primary", hint=ENTER_KEY)
        self.pair_button = Button(theme, "", height_px=40)
        self.compare_button = Button(theme, self.tr("Show &progress"), height_px=40)
        self.exclude_button = Button(theme, "", height_px=40)
        self.move_button = Button(theme, self.tr("&Move to another patient…"), height_px=40)
        self.rename_button = Button(theme, self.tr("Change the &exercise…"), height_px=40)
        self.delete_button = Button(theme, self.tr("Archive or &delete…"), "quiet", icon="trash-2", height_px=40)
        self.exclude_dialog = ExcludeDialog(self, theme)
        self.move_dialog = ChoiceDialog(self, theme)
        self.exercise_dialog = ChoiceDialog(self, theme)
        self._pair_key = KEYS["compare_ticked"]
        self._build_layout()
        self._connect()

    def _build_layout(self) -> None:
        left = column_layout(
            self.title,
            self.notice_layout,
            self.empty_text,
            (column_layout(self.header, (self.list, 1), gap=0), 1),
            (self.archive_button, 0, Qt.AlignmentFlag.AlignLeft),
            gap=12,
        )
        left.addStretch(0)
        self._card = Card(self._theme, 20)
        body = self._card.body
        body.setSpacing(10)
        for widget in (self.exercise_text, self.limit_text, self.value_text, self.facts_text, self.remark_text):
            body.addWidget(widget)
        body.addStretch(1)
        for button in (
            self.open_button, self.pair_button, self.compare_button, self.exclude_button,
            self.move_button, self.rename_button, self.delete_button,
        ):  # fmt: skip
            body.addWidget(button)
        self._right = ScrollArea(self._card)
        row_layout(
            (left, 1),
            self._right,
            gap=MARGIN_PX,
            margins=(MARGIN_PX, MARGIN_PX - 4, MARGIN_PX, MARGIN_PX - 4),
            parent=self,
        )
        self._theme.changed.connect(self._fit)
        self._fit()

    def _fit(self) -> None:
        self._right.setFixedWidth(self._theme.px(384))

    def _connect(self) -> None:
        bind_key(self, "compare_ticked", self.pair_button.click)
        bind_key(self.list, "tick", self.list.tick_current)
        self.list.ticks_changed.connect(self._show_ticks)
        self.pair_button.clicked.connect(self.compare_ticked)
        self.list.selectionModel().currentChanged.connect(lambda *_: self._show_current())
        self.list.doubleClicked.connect(lambda _: self.open_current())
        self.open_button.clicked.connect(self.open_current)
        self.compare_button.clicked.connect(lambda: self._emit_current(self.progress_requested))
        self.exclude_button.clicked.connect(self._toggle_excluded)
        self.move_button.clicked.connect(self._choose_patient)
        self.rename_button.clicked.connect(self._choose_exercise)
        self.delete_button.clicked.connect(self._request_delete)
        self.archive_button.clicked.connect(lambda: self.archive_requested.emit(self._patient_id))
        self.exclude_dialog.reason_given.connect(self._exclude)
        self.move_dialog.chosen.connect(
            lambda patient_id: self._run_action(
                lambda line: self._move(line.entry.session_id, patient_id), self.session_moved.emit
            )
        )
        self.exercise_dialog.chosen.connect(
            lambda exercise: self._run_action(lambda line: self._store.rename_exercise(line.entry.session_id, exercise))
        )

    # --- showing ------------------------------------------------------------------------------------------
    def show_patient(self, patient_id: str, pseudonym: str, selected_id: str = "") -> None:
        self._patient_id, self._pseudonym = patient_id, pseudonym
        self._request_number += 1
        number = self._request_number
        lines = self._store.list_sessions(patient_id)
        self.title.setText(self.tr("Sessions of {name}").format(name=pseudonym))
        self.list.session_model.show_lines(lines)
        self._show_ticks()
        archived = self._store.count_archived(patient_id)
        self.archive_button.setVisible(archived > 0)
        self.archive_button.set_label(self.tr("In the archi&ve: {n}").format(n=archived))
        self.empty_text.setVisible(not lines)
        self.header.setVisible(bool(lines))
        self.list.setVisible(bool(lines))
        row = max(0, self.list.session_model.find_row(selected_id))
        if lines:
            self.list.setCurrentIndex(self.list.session_model.index(row))
        self._show_current()
        for line in lines:
            self._background.run(
                lambda line=line: self._store.with_figures(line),  # type: ignore[misc]
                lambda known: self._on_figures(number, known),
                lambda _: None,
                self,
            )

    def _on_figures(self, number: int, line: SessionLine) -> None:
        if number == self._request_number:
            self.list.session_model.show_line(line)
            self._show_current()
            self._show_ticks()

    def current_line(self) -> SessionLine | None:
        index: QModelIndex = self.list.currentIndex()
        return self.list.session_model.lines[index.row()] if index.isValid() else None

    def initial_focus(self) -> QWidget:
        return self.list if self.list.session_model.lines else self

    def _show_current(self) -> None:
        line = self.current_line()
        self._right.setVisible(line is not None)
        if line is None:
            return
        self.exercise_text.setText(terms.exercise_name(line.entry.exercise))
        self.limit_text.setText(terms.exercise_limit(line.entry.exercise))
        self.value_text.setText(line.main_value or ("–" if line.is_damaged else self.tr("Reading…")))
        facts = (
            row_cells(line, self.list.session_model.lines)[0], terms.hand_name(line.entry.hand),
            numbers.format_clock(line.entry.duration_s + 0.5), line.counted_words, line.correction.rstrip("."),
        )  # fmt: skip
        self.facts_text.setText(" · ".join(fact for fact in facts if fact))
        self.remark_text.show_text(" · ".join(part for part in (remark(line), line.warning) if part))
        back = self.tr("&Include again")
        self.exclude_button.set_label(back if line.exclusion_reason else self.tr("E&xclude…"))
        practice = self._patient_id == PRACTICE_PATIENT
        self.move_button.setVisible(not practice)
        for button in (
            self.open_button, self.compare_button, self.exclude_button, self.rename_button,
        ):  # fmt: skip
            button.setEnabled(not line.is_damaged)

    # --- what is done -------------------------------------------------------------------------------------
    def open_current(self) -> None:
        if self.open_button.isEnabled():
            self._emit_current(self.open_requested)

    def compare_ticked(self) -> None:
        ticked = self.list.session_model.ticked
        if len(ticked) == 2:
            self.pair_requested.emit(*ticked)

    def _show_ticks(self) -> None:
        lines = [
            line for line in self.list.session_model.lines if line.entry.session_id in self.list.session_model.ticked
        ]
        words = {
            0: self.tr("Tick two sessions to compare"), 1: self.tr("Tick one more session to compare"),
            2: self.tr("Compare the 2 ticked sessions"),
        }[len(lines)]  # fmt: skip
        self.pair_button.setEnabled(len(lines) == 2 and not any(line.is_damaged for line in lines))
        self.pair_button.set_label(words, hint=self._pair_key if len(lines) == 2 else "")

    def _emit_current(self, signal) -> None:  # type: ignore[no-untyped-def]
        line = self.current_line()
        if line is not None:
            signal.emit(line.entry.session_id)

    def _toggle_excluded(self) -> None:
        line = self.current_line()
        if line is not None and line.exclusion_reason:
            self._exclude("")
        elif line is not None:
            self.exclude_dialog.request_reason()

    def _exclude(self, reason: str) -> None:
        self._run_action(lambda line: self._store.exclude(line.entry.session_id, reason))

    def _choose_patient(self) -> None:
        words = self.tr("The session will move from {name}’s progress to the other patient’s.")
        self.move_dialog.request_choice(
            self.tr("Which patient does this session belong to?"),
            words.format(name=self._pseudonym),
            self.tr("Move"),
            [one for one in self._store.target_patients(self._patient_id) if one[0] != self._patient_id],
        )

    def _choose_exercise(self) -> None:
        line = self.current_line()
        if line is None:
            return
        alike = exercises_for_protocol(get_exercise(line.entry.exercise).protocol)
        others = [one.id for one in alike if one.id != line.entry.exercise]
        self.exercise_dialog.request_choice(
            self.tr("Which exercise was it?"),
            self.tr("Repetitions and values are calculated again. The recording itself is not changed."),
            self.tr("Change exercise"),
            [(one, terms.exercise_name(one)) for one in others],
        )

    def _request_delete(self) -> None:
        line = self.current_line()
        if line is not None:
            self.delete_requested.emit(line.entry.session_id)

    def _move(self, session_id: str, patient_id: str) -> str:
        self._store.move(session_id, patient_id)
        return dict(self._store.target_patients(self._patient_id))[patient_id]

    def _run_action(self, action, on_done=lambda _: None) -> None:  # type: ignore[no-untyped-def]
        line = self.current_line()
        if line is None:
            return

        def finish(result: object) -> None:
            self.sessions_changed.emit()
            self.show_patient(self._patient_id, self._pseudonym, line.entry.session_id)
            self.initial_focus().setFocus(Qt.FocusReason.OtherFocusReason)
            on_done(result)

        self._background.run(lambda: action(line), finish, self.fault_raised.emit, self)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.open_current()
        elif event.key() == Qt.Key.Key_Delete:
            self._request_delete()
        else:
            super().keyPressEvent(event)

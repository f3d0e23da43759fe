"""Patient list screen: search, list, summary of the selected patient."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from datetime import date

from PySide6.QtCore import QEvent, QModelIndex, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from carpus.core.model.errors import ServerUnavailable
from carpus.core.model.names import fold_name, normalize_name
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.values import Patient
from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import KeyCaps, Separator
from carpus.ui.kit.field import SearchField
from carpus.ui.kit.layouts import STRETCH, column_layout, fill, row_layout, scroll_page
from carpus.ui.kit.table import ListHeader
from carpus.ui.kit.text import MEDIUM, REGULAR, Text, heading
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme
from carpus.ui.screens.patients.card import PatientCardView
from carpus.ui.screens.patients.patient_form import PatientForm
from carpus.ui.screens.patients.patient_list import PatientList, header_columns, place_headings
from carpus.ui.screens.patients.patient_store import MAX_LISTED_PATIENTS, PatientStore
from carpus.ui.screens.welcome.panel import WelcomePanel
from carpus.ui.shell.current_selection import NameDisplay
from carpus.ui.words import terms
from carpus.ui.words.terms import birth_words, record_number_words

DATE_CHECK_INTERVAL_MS = 30_000
MAX_ARCHIVED_SHOWN = 3
LIST_KEYS = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)


class PatientsScreen(QWidget):
    """Patient list.

    Signals carry the patient's id: ``start_requested`` keeps the last set-up, ``setup_requested`` asks for another,
    ``delete_requested`` asks to archive or delete.
    """

    start_requested = Signal(str)
    setup_requested = Signal(str)
    review_requested = Signal(str)
    progress_requested = Signal(str)
    sessions_requested = Signal(str)
    delete_requested = Signal(str)
    unlisted_start_requested = Signal(object)
    """A :class:`Patient` to measure while the list is unavailable, without id for a typed name."""

    def __init__(self, theme: Theme, store: PatientStore, today: Callable[[], date], names: NameDisplay) -> None:
        """``today`` is called each time: the program may stay open for days."""
        super().__init__()
        self._theme, self._store, self._today, self._names = theme, store, today, names
        self._rows: tuple[Patient, ...] = ()
        self._camera_ready = False
        self._search_words = self.tr("Name, number, birth date")
        self.search = SearchField(theme, self._search_words, self.tr("Ctrl+F"))
        self.new_button = Button(theme, self.tr("New patient"), icon="plus", hint=self.tr("Ctrl+N"))
        self.list = PatientList(theme, today, names)
        self.header = ListHeader(theme, self.list, header_columns(), place_headings)
        self.card = PatientCardView(theme, today, names)
        self.date_text = Text(theme, "", 14, REGULAR, "text2")
        self._date_timer = QTimer(self, interval=DATE_CHECK_INTERVAL_MS)
        self._date_timer.timeout.connect(self.refresh_date)
        self._date_timer.start()
        self.notice_layout = QVBoxLayout()
        self.welcome: WelcomePanel | None = None
        self._empty_view = _EmptyView(theme)
        self._offline_view = _OfflineView(theme)
        self._last_selected: Patient | None = None
        self.archive_button = Button(theme, "", "quiet", icon="archive", height_px=36)
        self.archive_button.hide()
        self._archived_names: tuple[str, ...] = ()
        self.form = PatientForm(self, theme, store.register, today)
        self._build_layout()
        self._connect()
        self.refresh_date()

    def _build_layout(self) -> None:
        theme, foot_line = self._theme, Qt.AlignmentFlag.AlignBottom
        self._above_welcome = QWidget()
        self._above_welcome.setFixedHeight(GAP_PX)
        self._above_welcome.hide()
        self._left = column_layout(
            row_layout(heading(theme, self.tr("Patients")), STRETCH, (self.date_text, 0, foot_line)),
            8,
            row_layout((self.search, 1), self.new_button, gap=GAP_PX),
            14,
            self.header,
            (self.list, 1),
            self._empty_view,
            self._offline_view,
            (self.archive_button, 0, Qt.AlignmentFlag.AlignLeft),
            self._above_welcome,
            gap=0,
        )
        self._left.addStretch(0)
        policy = self.card.sizePolicy()
        policy.setRetainSizeWhenHidden(True)  # the search field keeps its width while nobody is found
        self.card.setSizePolicy(policy)
        columns = row_layout((self._left, 824), (self.card, 384), gap=MARGIN_PX)
        whole = column_layout(self.notice_layout, (columns, 1), gap=GAP_PX, margins=(MARGIN_PX, GAP_PX, MARGIN_PX, 12))
        keys = [("↑ ↓", self.tr("choose")), (self.tr("Enter"), self.tr("start")), ("F1", self.tr("help"))]
        legal = Text(theme, terms.legal_notice(), 12, REGULAR, "text2", wrap=True)
        foot = row_layout((legal, 1), KeyCaps(theme, keys), gap=32, margins=(MARGIN_PX, 6, MARGIN_PX, 6))
        column_layout((scroll_page(whole), 1), Separator(theme), foot, gap=0, margins=(0, 0, 0, 0), parent=self)

    def _fit_card(self) -> None:
        """Let the card shorten its buttons where a small window has no room for both columns."""
        room = self.width() - self._left.minimumSize().width() - 3 * MARGIN_PX
        self.card.setMinimumWidth(max(1, min(self.card.minimumSizeHint().width(), room)))

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit_card()

    def _connect(self) -> None:
        self.search.installEventFilter(self)
        self.list.installEventFilter(self)
        self.search.textChanged.connect(lambda: self._apply_filter(self.selected_patient_id))
        self.new_button.clicked.connect(self.new_patient)
        self._empty_view.button.clicked.connect(lambda: self.new_patient(self.search.text()))
        self._offline_view.button.clicked.connect(self._measure_unlisted)
        self.list.selectionModel().currentChanged.connect(self._show_selected)
        self.list.doubleClicked.connect(lambda: self._start())
        self.card.start_button.clicked.connect(self._start)
        self.card.change_button.clicked.connect(lambda: self.setup_requested.emit(self.selected_patient_id))
        self.card.review_button.clicked.connect(lambda: self.review_requested.emit(self.selected_patient_id))
        self.card.progress_button.clicked.connect(lambda: self.progress_requested.emit(self.selected_patient_id))
        self.card.sessions_button.clicked.connect(lambda: self.sessions_requested.emit(self.selected_patient_id))
        self.card.edit_button.clicked.connect(lambda: self.change_patient(self.selected_patient_id))
        self._names.changed.connect(lambda: self._apply_filter(self.selected_patient_id))
        self.form.saved.connect(self._show_saved)
        self.form.remove_button.clicked.connect(lambda: self.delete_requested.emit(self.form.patient.patient_id))

    def refresh_date(self) -> None:
        """Update the date after midnight."""
        words = numbers.format_long_date(self._today())
        if words != self.date_text.text():
            self.date_text.setText(words)
            self.list.viewport().update()

    def refresh(self, selected_id: str = "") -> None:
        self.refresh_date()
        was_away = not self._offline_view.isHidden()
        try:
            practice = replace(self._store.register.get(PRACTICE_PATIENT), pseudonym=self.tr("Practice patient"))
            rows, archived = (*self._store.list_patients(), practice), tuple(self._store.list_archived_names())
        except ServerUnavailable:
            self._show_offline(selected_id or self.selected_patient_id)
            return
        if was_away:
            self._offline_view.hide()
            self.search.clear()
            self.search.setPlaceholderText(self._search_words)
            self.new_button.setEnabled(True)
        self._rows, self._archived_names = rows, archived
        self._apply_filter(selected_id or self.selected_patient_id)

    def show_patient(self, patient: Patient) -> None:
        """Select a patient; one whom the list does not show, of very many or archived, is searched for."""
        self.search.clear()
        self.refresh(patient.patient_id)
        if self.selected_patient_id != patient.patient_id:
            self.search.setText(patient.pseudonym)
            self._apply_filter(patient.patient_id)

    def _show_offline(self, selected_id: str) -> None:
        """Hide the list, which may be outdated; the last or a typed patient can be measured."""
        rows = [row for row in self._rows if row.patient_id == selected_id]
        self._rows, self._archived_names = (), ()
        if self._offline_view.isHidden():
            self._last_selected = next(iter(rows), None)
            name = self._last_selected.pseudonym if self._last_selected is not None else ""
            self._offline_view.show()
            self.new_button.setEnabled(False)
            self.search.setPlaceholderText(self.tr("Pseudonym"))
            self.search.setText(name)
        self._apply_filter("")

    def _measure_unlisted(self) -> None:
        if (name := normalize_name(self.search.text())) == "":
            return
        last = self._last_selected
        is_last = last is not None and fold_name(last.pseudonym) == fold_name(name)
        self.unlisted_start_requested.emit(last if is_last else Patient(name, "both"))

    def set_camera_ready(self, ready: bool) -> None:
        """Set whether a camera is connected; without one sessions start from files only."""
        if ready != self._camera_ready:
            self._camera_ready = ready
            self._show_selected()

    def show_welcome(self, panel: WelcomePanel | None) -> None:
        """Show the panel of the first start below the list; None removes it."""
        old, self.welcome = self.welcome, panel
        if old is not None:
            self._left.removeWidget(old)
            old.hide()
            old.deleteLater()
        if panel is not None:
            self._left.insertWidget(self._left.count() - 1, panel, 1)
        self._above_welcome.setVisible(panel is not None)
        self.refresh()

    def new_patient(self, name: str | bool = "") -> None:
        """Open the form; the flag that a button's click carries is no name."""
        taken = frozenset(name.casefold() for name in (*(row.pseudonym for row in self._rows), *self._archived_names))
        self.form.edit_patient(None, taken, name if isinstance(name, str) else "")

    def change_patient(self, patient_id: str) -> None:
        row = self._store.register.get(patient_id)  # a search may have found it beyond the rows of the list
        others = (other.pseudonym for other in self._rows if other.patient_id != patient_id)
        taken = frozenset(name.casefold() for name in (*others, *self._archived_names))
        self.form.edit_patient(row, taken)

    def _show_saved(self, chosen: str) -> None:
        self.show_patient(self._store.register.get(chosen))
        self.search.setFocus(Qt.FocusReason.OtherFocusReason)

    def _apply_filter(self, selected_id: str) -> None:
        wanted = self._wanted_words()
        rows = self._rows
        if not self._offline_view.isHidden():
            self._offline_view.show_search(self.search.text())
            for one in (self.list, self.header, self._empty_view, self.archive_button):
                one.hide()
            self.card.show_card(None, self._camera_ready)
            return
        if wanted and len(rows) > MAX_LISTED_PATIENTS:  # with the practice patient: there may be more than are shown
            rows = (*self._store.list_patients(" ".join(wanted)), rows[-1])
        found = {row.patient_id: self._describe_match(row, wanted) for row in rows}
        shown = [row for row in rows if found[row.patient_id] is not None]
        self.list.patient_model.show_rows(shown, {patient_id: words for patient_id, words in found.items() if words})
        self.list.setVisible(bool(shown))
        self.header.setVisible(bool(shown))
        only_practice = len(self._rows) == 1 and self.welcome is None
        self._empty_view.show_search(
            "" if shown and not only_practice else self.search.text(), only_practice, bool(shown)
        )
        self._show_archived(wanted)
        row = max(0, self.list.patient_model.find_row(selected_id))
        if shown:
            self.list.setCurrentIndex(self.list.patient_model.index(row))
        self._show_selected()

    def _wanted_words(self) -> list[str]:
        """Return the searched words; a date, also in several words, as ISO 8601."""
        text = self.search.text()
        words = [text] if numbers.parse_date(text, self._today()) else text.split()
        days = [numbers.parse_date(word, self._today()) for word in words]
        return [day.isoformat() if day else fold_name(word) for word, day in zip(words, days, strict=True)]

    def _describe_match(self, row: Patient, wanted: list[str]) -> str | None:
        """Return in words what the row does not show and the search found it by; None if it did not find it."""
        exercise = terms.exercise_name(row.last_exercise) if row.last_exercise else ""
        shown = fold_name(f"{row.pseudonym} {row.diagnosis} {exercise} {self._names.real_name(row)}")
        born = row.birth_day.isoformat() if row.birth_day else ""
        is_hidden, found = self._names.is_hidden, []
        for word in wanted:
            if word in shown:
                continue
            if word in fold_name(row.name):
                found.append(self.tr("found by name"))
            elif word == born:
                found.append(self.tr("found by birth date") if is_hidden else birth_words(row))
            elif word in fold_name(row.record_number):
                found.append(self.tr("found by record number") if is_hidden else record_number_words(row))
            else:
                return None
        return ", ".join(dict.fromkeys(found))

    def _show_archived(self, wanted: list[str]) -> None:
        """Offer archived patients that match the search."""
        found = [name for name in self._archived_names if all(word in name.casefold() for word in wanted)]
        names = ", ".join(found[:MAX_ARCHIVED_SHOWN]) + (" …" if len(found) > MAX_ARCHIVED_SHOWN else "")
        self.archive_button.setVisible(bool(found))
        self.archive_button.set_label(self.tr("In the archi&ve: {names}").format(names=names.replace("&", "&&")))

    @property
    def selected_patient_id(self) -> str:
        """Id of the selected patient; empty for none."""
        index: QModelIndex = self.list.currentIndex()
        return self.list.patient_model.row(index.row()).patient_id if index.isValid() else ""

    def _show_selected(self, *_: object) -> None:
        self._show_card(self.selected_patient_id)
        self._fit_card()

    def _show_card(self, chosen: str) -> None:
        if not chosen:
            self.card.show_card(None, self._camera_ready)
        elif chosen == PRACTICE_PATIENT:
            card = self._store.card(chosen)  # its results count nowhere, and can be looked at all the same
            name = self._rows[-1].pseudonym
            self.card.show_card(replace(card, patient=replace(card.patient, pseudonym=name)), self._camera_ready)
        else:
            self.card.show_card(
                self._store.card(chosen), self._camera_ready, self.list.patient_model.found_by.get(chosen, "")
            )

    def _start(self) -> None:
        if chosen := self.selected_patient_id:
            self.start_requested.emit(chosen)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Let arrows and Enter act on the list while the search field has the focus."""
        if event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent):
            if watched is self.search and event.key() in LIST_KEYS and self.list.isVisible():
                self.list.keyPressEvent(event)
                return True
            if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                if not self._offline_view.isHidden():
                    self._measure_unlisted()
                elif self.selected_patient_id:
                    self._start()
                elif self._empty_view.isVisible():
                    self.new_patient(self.search.text())
                return True
        return False


class _EmptyView(QWidget):
    """Shown in place of an empty list."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        row = row_layout(margins=(20, 24, 20, 24), parent=self)
        self._words = Text(theme, "", 16, MEDIUM, wrap=True)
        self.button = Button(theme, "", icon="plus")
        fill(row, (self._words, 1), self.button)

    def show_search(self, search: str, register_empty: bool, rows_shown: bool) -> None:
        self.setVisible(register_empty or not rows_shown)
        self.button.setVisible(not rows_shown)  # beside an empty list there is “New patient” above
        if not rows_shown:
            self._words.setText(self.tr("No patient “{name}”.").format(name=search.strip()))
            self.button.set_label(self.tr("Create “{name}”").format(name=search.strip()))
        else:
            self._words.setText(
                self.tr("No patients yet. Add the first one, or try everything with the practice patient.")
            )


class _OfflineView(QWidget):
    """Shown in place of the list while the clinic's server does not answer."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        words = self.tr(
            "The patient list returns when the server responds. To measure now, enter the patient’s pseudonym above. "
            "The session is saved and appears in the list later."
        )
        self.button = Button(theme, "", "primary")
        row = column_layout(
            Text(theme, words, 16, MEDIUM, wrap=True),
            (self.button, 0, Qt.AlignmentFlag.AlignLeft),
            gap=GAP_PX,
            margins=(20, 24, 20, 24),
            parent=self,
        )
        row.addStretch(1)
        self.hide()

    def show_search(self, name: str) -> None:
        self.button.setEnabled(bool(name.strip()))
        words = self.tr("Measure “{name}”").format(name=name.strip().replace("&", "&&"))
        self.button.set_label(words if name.strip() else self.tr("Measure without the patient list"))

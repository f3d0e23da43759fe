"""Summary of the selected patient, and the start of a session."""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import date

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QWidget

from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.values import Patient
from carpus.ui.kit import numbers
from carpus.ui.kit.button import ENTER_KEY, Button
from carpus.ui.kit.card import Card, Separator
from carpus.ui.kit.layouts import STRETCH, ScrollArea, clear_layout, column_layout, fill, row_layout
from carpus.ui.kit.table import VERDICT_TOKENS
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, ElidedText, Text, caption, plain_tooltip
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.photo import Photo
from carpus.ui.screens.patients.patient_store import MeasureWithChange, PatientCard
from carpus.ui.screens.tour.bubble import BubbleView
from carpus.ui.shell.current_selection import NameDisplay
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import find_finger_angle, progress_measure_name
from carpus.ui.words.progress import change_since_first, duplicate_result_words

PHOTO_MIN_HEIGHT_PX, DIAGNOSIS_PX = 680, 100
MIN_SUMMARY_PX = 92
SUMMARY_BESIDE_TOUR_PX = 440


class PatientCardView(Card):
    """Right column of the patient list."""

    def __init__(self, theme: Theme, today: Callable[[], date], names: NameDisplay) -> None:
        super().__init__(theme, 24)
        self._theme, self._today, self._names = theme, today, names
        self._name = ElidedText(theme, "", 28, SEMIBOLD)
        self._real_name = Text(theme, "", 16, SEMIBOLD, wrap=True)
        self._identity = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self._found_by = Text(theme, "", 14, SEMIBOLD, "accent", wrap=True)
        self._hand = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self._diagnosis = Text(theme, "", 16, SEMIBOLD, wrap=True)
        self._onset = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self._weeks = Text(theme, "", 16, SEMIBOLD)
        self._photo = Photo(theme)
        self._exercise = Text(theme, "", 16, SEMIBOLD, wrap=True)
        self._limit = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self._last_session = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self._task_summary = Text(theme, "", 14, MEDIUM, wrap=True)
        self._warning = Text(theme, "", 14, MEDIUM, "warn", wrap=True)
        self._results = column_layout(gap=0)
        self._note_date = caption(theme)
        self._note = Text(theme, "", 14, wrap=True)
        self.start_button = Button(
            theme, self.tr("Start session with same set-up"), "primary", icon="play", hint=ENTER_KEY
        )
        self.bubble = BubbleView(theme)
        self.edit_button = Button(theme, self.tr("&Edit…"), "quiet", height_px=32)
        self.change_button = Button(theme, self.tr("&Other exercise…"))
        self.review_button = Button(theme, self.tr("&Review"))
        self.progress_button = Button(theme, self.tr("&Progress"))
        self.sessions_button = Button(theme, self.tr("All &sessions"))
        self._build_layout()
        self.bubble.changed.connect(self._fit_summary)

    def _build_layout(self) -> None:
        why = Card(self._theme, 12, "sunken", "sunken")
        why.body.setSpacing(2)
        fill(why.body, self._diagnosis, row_layout((self._onset, 1), self._weeks))
        self._diagnosis_card = QWidget()
        column_layout(why, margins=(0, 0, 0, 12), parent=self._diagnosis_card)
        recall = QWidget()
        column_layout(
            self._real_name,
            self._identity,
            self._found_by,
            self._hand,
            12,
            self._diagnosis_card,
            0,
            self._photo,
            14,
            self._exercise,
            self._limit,
            2,
            self._last_session,
            12,
            self._task_summary,
            4,
            self._warning,
            4,
            self._results,
            14,
            self._note_date,
            self._note,
            STRETCH,
            gap=0,
            margins=(0, 0, 0, 0),
            parent=recall,
        )
        self._summary = ScrollArea(recall)  # large text: what must be recalled scrolls, the buttons stay
        self.body.setSpacing(0)
        fill(
            self.body, row_layout((self._name, 1), self.edit_button), 2, (self._summary, 1), 16, self.bubble,
            self.start_button, 12, row_layout((self.change_button, 1), (self.progress_button, 1), gap=12), 8,
            row_layout((self.review_button, 1), (self.sessions_button, 1), gap=12),
        )  # fmt: skip

    def _fit_summary(self) -> None:
        """Hide the summary behind the tour's text where large text leaves no room for both."""
        self._summary.setMinimumHeight(self._theme.px(MIN_SUMMARY_PX))
        self._summary.setVisible(self.bubble.isHidden() or self.height() >= self._theme.px(SUMMARY_BESIDE_TOUR_PX))

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit_photo()
        self._fit_summary()

    def _fit_photo(self) -> None:
        needed_px = PHOTO_MIN_HEIGHT_PX + (0 if self._diagnosis_card.isHidden() else DIAGNOSIS_PX)
        self._photo.set_has_room(self.height() >= self._theme.px(needed_px))

    def show_card(self, card: PatientCard | None, is_camera_ready: bool, found_by: str = "") -> None:
        self.setVisible(card is not None)
        if card is None:
            return
        row = card.patient
        practice = row.patient_id == PRACTICE_PATIENT
        self._name.setText(row.pseudonym)
        self._name.setToolTip(plain_tooltip(self._names.title(row)))
        self.edit_button.setVisible(not practice)
        self._real_name.show_text(self._names.real_name(row))
        self._identity.show_text(self._names.identity(row))
        self._found_by.show_text(found_by)
        self._hand.setText(
            self.tr("Simulated: excluded from analysis")
            if practice
            else terms.hand_status_words(row.side, row.dominance)
        )
        self._show_diagnosis(row)
        day = numbers.format_day_month(row.last_session) if row.last_session else ""
        self._photo.show_picture(
            card.marker_photo_rgb, self.tr("Place markers as on {day}").format(day=day) if day else ""
        )
        none = self.tr("No analysed session yet") if card.has_sessions else self.tr("No session yet")
        self._exercise.setText(terms.exercise_name(row.last_exercise) if row.last_exercise else none)
        self._limit.show_text(terms.exercise_limit(row.last_exercise) if row.last_exercise else "")
        self._last_session.setText(self._last_words(card, practice))
        self._task_summary.show_text(card.task_summary)
        self._warning.setText(" ".join(card.warnings))
        self._warning.setVisible(bool(card.warnings))
        self._show_results(card)
        self._note_date.setText(
            self.tr("Note of {day}").format(day=numbers.format_day_month(card.note_date)) if card.note_date else ""
        )
        self._note.setText(card.note)
        self._note_date.setVisible(bool(card.note and card.note_date))
        self._note.setVisible(bool(card.note))
        same = row.session_count > 0 and not practice
        self.start_button.set_label(self._start_words(practice, same, is_camera_ready))
        self.review_button.setEnabled(row.session_count > 0)
        self.progress_button.setEnabled(row.session_count > 0 or not practice)  # values by hand come first
        self.sessions_button.setEnabled(row.session_count > 0 or card.has_sessions)

    def _show_diagnosis(self, row: Patient) -> None:
        shown, day = row.diagnosis, row.onset_day
        for text, words in (
            (self._diagnosis, shown),
            (self._onset, terms.onset_words(row.onset, day)),
            (self._weeks, numbers.format_weeks_since(day, self._today()) if day is not None else ""),
        ):
            text.show_text(words)
        self._diagnosis_card.setVisible(bool(shown or day))
        self._fit_photo()

    def _start_words(self, practice: bool, same: bool, camera_ready: bool) -> str:
        if practice:
            return self.tr("Start practice")
        if not camera_ready:
            return self.tr("Start from a file · no camera")
        return self.tr("Start session with same set-up") if same else self.tr("Start first session")

    def _last_words(self, card: PatientCard, practice: bool) -> str:
        row = card.patient
        if row.last_session is None:
            if practice:
                return self.tr(
                    "A simulated patient moves in front of a simulated camera. Try every step without a patient."
                )
            if card.has_sessions:
                return self.tr("Only simulated sessions so far (excluded).")
            return self.tr("Attach the markers, then start.")
        number = self.tr("{ordinal} session").format(ordinal=numbers.format_ordinal(row.session_count))
        parts = (number + ", " + numbers.format_short_date(row.last_session), card.repetitions)
        words = " · ".join(part for part in parts if part)
        once = duplicate_result_words(max(row.result_count - row.session_count, 0))
        return f"{words}\n{once}" if once else words

    def _show_results(self, card: PatientCard) -> None:
        clear_layout(self._results)
        if card.results and card.results[0][0].wrist_angle < 0:
            self._results.addWidget(caption(self._theme, progress_measure_name(card.results[0][0].subject)))
        for result in card.results:
            fill(self._results, Separator(self._theme), _ResultRow(self._theme, result))
        if card.results:
            self._results.addWidget(Separator(self._theme))


class _ResultRow(QWidget):
    def __init__(self, theme: Theme, result: MeasureWithChange) -> None:
        super().__init__()
        row = QHBoxLayout(self)
        measure, change = result
        of_joint = measure.wrist_angle < 0
        gap = 5 if of_joint else 10  # five fingers
        row.setContentsMargins(0, gap, 0, gap)
        words = find_finger_angle(measure.subject).short_name if of_joint else terms.movement_name(measure.quantity)
        name = Text(theme, words, 14, REGULAR, "text2")
        self._name = name
        theme.changed.connect(self._fit)
        self._theme = theme
        self._fit()
        row.addWidget(name)
        value = terms.end_words(measure.mean, measure.quantity, measure.sd)
        if of_joint:
            value = numbers.format_with_sd(measure.mean, math.nan if measure.is_lower_bound else measure.sd)
            value = f"≥{numbers.NARROW_GAP}{value}" if measure.is_lower_bound else value
        row.addWidget(Text(theme, value, 16, SEMIBOLD))
        words = "" if change is None else change_since_first(change.verdict, change.difference_deg)
        token = "text2" if change is None else VERDICT_TOKENS.get(change.verdict, "text2")
        since = Text(theme, words, 12, MEDIUM, token, wrap=True)
        since.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        row.addWidget(since, 1)

    def _fit(self) -> None:
        needed = self._name.fontMetrics().horizontalAdvance(self._name.text()) + 4
        self._name.setFixedWidth(max(self._theme.px(72), needed))

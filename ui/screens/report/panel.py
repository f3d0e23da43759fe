"""Panel beside a report: its parts, and the therapist's comment with stored sentences."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QFocusEvent
from PySide6.QtWidgets import QCheckBox, QComboBox, QCompleter, QHBoxLayout, QPlainTextEdit, QWidget

from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.results.report_form import MAX_SENTENCES, ReportForm
from carpus.core.results.session_results import SessionResults
from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button
from carpus.ui.kit.field import Combo
from carpus.ui.kit.layouts import column_layout, fill
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import to_mid_sentence, tr, translate_phrase
from carpus.ui.report.session_page import SECTIONS, SessionReport
from carpus.ui.words import terms
from carpus.ui.words.fingers import range_words
from carpus.ui.words.ranges import has_sd, is_deficit, mean_words
from carpus.ui.words.session import change_sentence

COMMENT_PX = 130
PREVIEW_AFTER_MS = 400


class ReportPanel(QWidget):
    """Emits ``changed`` (report), ``form_saved`` (form) and ``comment_saved`` (session id, comment)."""

    changed = Signal(object)
    form_saved = Signal(ReportForm)
    comment_saved = Signal(str, str)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._report: SessionReport | None = None
        self._saved_comment = ""
        self._default_omissions: frozenset[str] = frozenset()
        column = column_layout(Text(theme, self.tr("Comment"), 16, SEMIBOLD), gap=6, margins=(0, 0, 0, 0), parent=self)
        words = self.tr("Printed on the report and saved with the session. No names here, please.")
        column.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        self.comment = _CommentField()
        self.comment.setTabChangesFocus(True)
        self.comment.setAccessibleName(self.tr("Comment on the report"))
        theme.on_change(self.comment, lambda: self.comment.setFixedHeight(theme.px(COMMENT_PX)))
        column.addWidget(self.comment)
        self.sentence_box = self._make_sentence_box()
        column.addWidget(self.sentence_box)
        row = QHBoxLayout()
        self.insert_button = Button(theme, self.tr("Insert"), height_px=38)
        self.add_button = Button(theme, self.tr("Save"), "quiet", height_px=38)
        self.remove_button = Button(theme, self.tr("Delete"), "quiet", height_px=38)
        for button in (self.insert_button, self.add_button, self.remove_button):
            row.addWidget(button)
        row.addStretch(1)
        fill(column, row, 8, Text(theme, self.tr("Parts of the report"), 16, SEMIBOLD))
        self.section_checks: dict[str, QCheckBox] = {}
        for section in SECTIONS:
            if not section.label:
                continue
            self.section_checks[section.name] = tick = QCheckBox(translate_phrase(section.label))
            tick.toggled.connect(self._update_sections)
            column.addWidget(tick)
        words = self.tr("Warnings, method and the legal notice are always printed.")
        column.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        self.use_button = Button(theme, self.tr("Use these parts for all reports"), height_px=40)
        column.addWidget(self.use_button)
        self._preview_timer = QTimer(self, singleShot=True, interval=PREVIEW_AFTER_MS)
        self._preview_timer.timeout.connect(self._update_comment)
        self.comment.textChanged.connect(self._preview_timer.start)
        self.comment.focus_lost.connect(self.save_comment)
        self.insert_button.clicked.connect(self._insert)
        self.add_button.clicked.connect(self._add_sentence)
        self.remove_button.clicked.connect(self._remove_sentence)
        self.use_button.clicked.connect(self._save_form)

    def _make_sentence_box(self) -> QComboBox:
        box = Combo()
        box.setEditable(True)
        box.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        box.setAccessibleName(self.tr("Sentence to insert"))
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        completer = QCompleter(box.model(), box)
        completer.setFilterMode(Qt.MatchFlag.MatchContains)
        completer.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
        box.setCompleter(completer)
        if (line := box.lineEdit()) is not None:
            line.setPlaceholderText(self.tr("Search the saved sentences"))
        box.setToolTip(
            self.tr("Placeholders for the session’s values: {places}").replace(
                "{places}", ", ".join(f"{{{name}}}" for name in PLACEHOLDERS)
            )
        )
        return box

    def show_report(self, report: SessionReport) -> None:
        self.save_comment()
        self._preview_timer.stop()
        self._report, self._saved_comment, self._default_omissions = None, report.comment, report.form.excluded_sections
        self.comment.setPlainText(report.comment)
        for name, tick in self.section_checks.items():
            tick.setChecked(report.form.includes(name))
        for section in SECTIONS:
            if section.label:
                self.section_checks[section.name].setVisible(section.has_content(report))
        self._report = report
        self._preview_timer.stop()
        self._show_sentences()

    def save_comment(self) -> None:
        self._update_comment()
        if self._report is not None and self._report.comment.strip() != self._saved_comment.strip():
            self._saved_comment = self._report.comment
            self.comment_saved.emit(self._report.results.session_id, self._saved_comment)

    def hideEvent(self, event) -> None:  # type: ignore[no-untyped-def]
        self.save_comment()
        super().hideEvent(event)

    def _update_comment(self) -> None:
        self._preview_timer.stop()
        if self._report is not None and self._report.comment != self.comment.toPlainText():
            self._report = replace(self._report, comment=self.comment.toPlainText())
            self.changed.emit(self._report)

    def _update_sections(self) -> None:
        if self._report is not None:
            left_out = frozenset(name for name, tick in self.section_checks.items() if not tick.isChecked())
            self._report = replace(self._report, form=replace(self._report.form, excluded_sections=left_out))
            self.changed.emit(self._report)

    def _sentences(self) -> tuple[str, ...]:
        return self._report.form.sentences or default_sentences() if self._report is not None else ()

    def _show_sentences(self, current: str = "") -> None:
        self.sentence_box.clear()
        self.sentence_box.addItems(self._sentences())
        self.sentence_box.setCurrentIndex(-1)
        self.sentence_box.setEditText(current)

    def _insert(self) -> None:
        words = self.sentence_box.currentText().strip()
        if words and self._report is not None:
            cursor = self.comment.textCursor()
            before = self.comment.toPlainText()[: cursor.position()]
            cursor.insertText(("" if not before or before[-1].isspace() else " ") + fill_sentence(words, self._report))
            self.sentence_box.setEditText("")
            self.comment.setFocus(Qt.FocusReason.OtherFocusReason)

    def _add_sentence(self) -> None:
        words = self.sentence_box.currentText().strip()
        if words and words not in self._sentences() and len(self._sentences()) < MAX_SENTENCES:
            self._save_sentences((*self._sentences(), words), words)

    def _remove_sentence(self) -> None:
        words = self.sentence_box.currentText().strip()
        if words in self._sentences():
            self._save_sentences(tuple(one for one in self._sentences() if one != words), "")

    def _save_sentences(self, sentences: tuple[str, ...], current: str) -> None:
        if self._report is not None:
            self._report = replace(self._report, form=replace(self._report.form, sentences=sentences))
            self.changed.emit(self._report)
            self.form_saved.emit(replace(self._report.form, excluded_sections=self._default_omissions))
            self._show_sentences(current)

    def _save_form(self) -> None:
        if self._report is not None:
            self._default_omissions = self._report.form.excluded_sections
            self.form_saved.emit(self._report.form)


class _CommentField(QPlainTextEdit):
    """Emits ``focus_lost`` when another field gets the keyboard."""

    focus_lost = Signal()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.focus_lost.emit()


PLACEHOLDER_COLUMNS = {"flexion": 1, "extension": 1, "radial": 0, "ulnar": 0, "supination": 2, "pronation": 2}
PLACEHOLDERS = (*PLACEHOLDER_COLUMNS, "arc", "change", "repetitions", "date")
_PLACEHOLDER = re.compile(r"\{(\w+)\}")


def default_sentences() -> tuple[str, ...]:
    """Return the sentences offered until the therapist has stored some."""
    return (
        tr("Flexion {flexion}, extension {extension}."),
        tr("The total arc is {arc}. {change}"),
        tr("Splint as before; exercises at home three times a day."),
        tr("Reassess in two weeks."),
    )


def fill_sentence(sentence: str, report: SessionReport) -> str:
    """Replace the placeholders of a sentence; unknown values are said to be so."""
    return _PLACEHOLDER.sub(
        lambda found: _placeholder_text(found[1], report) if found[1] in PLACEHOLDERS else found[0], sentence
    )


def _placeholder_text(place: str, report: SessionReport) -> str:
    results = report.results
    text: dict[str, Callable[[], str]] = {
        "arc": lambda: "" if results.exercise.angle is None else _measure_text(results, "arc", results.exercise.angle),
        "change": lambda: _change_text(report),
        "repetitions": lambda: str(results.repetition_count) if results.repetition_count else "",
        "date": lambda: numbers.format_date_time(results.when),
    }
    words = text[place]() if place in text else _measure_text(results, place, PLACEHOLDER_COLUMNS[place])
    return words or tr("not measured")


def _measure_text(results: SessionResults, movement: str, angle: int) -> str:
    row = results.find(WRIST_ANGLES[angle], movement)
    if row is None or not row.count:
        return ""
    if row.is_lower_bound:
        return range_words(row)
    if is_deficit(row):
        sd_deg = row.sd if has_sd(row) else row.measurement_sd
        return f"{to_mid_sentence(terms.deficit_name(movement))} {numbers.format_with_sd(-row.mean, sd_deg)}"
    return mean_words(row)


def _change_text(report: SessionReport) -> str:
    if report.previous is None:
        return _to_sentence(tr("not measured"))
    day = numbers.format_distinct_day(report.previous.when, report.results.when)
    text = change_sentence(report.results, report.previous, day)
    return text or _to_sentence(tr("not measured"))


def _to_sentence(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}."

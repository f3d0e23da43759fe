"""Beside a report: which parts it has, and the therapist's comment with sentences to write it from."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QFocusEvent
from PySide6.QtWidgets import QComboBox, QCompleter, QHBoxLayout, QPlainTextEdit, QWidget

from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.results.figures import SessionFigures
from carpus.core.results.report_form import MOST_SENTENCES, SECTIONS, ReportForm
from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button, Tick
from carpus.ui.controls.field import Combo
from carpus.ui.controls.layouts import fill, in_column
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.report.session_page import SessionReport
from carpus.ui.theme import Theme
from carpus.ui.translate import inside, tr
from carpus.ui.words.fingers import range_words
from carpus.ui.words.ranges import is_deficit, mean_words, prints_spread
from carpus.ui.words.session import since_words

COMMENT_PX = 130
PREVIEW_AFTER_MS = 400


class ReportPanel(QWidget):
    """``changed`` carries the report as it is to be shown; ``form_kept`` a form for all reports; ``comment_kept`` the
    session and its comment when that was written to its end."""

    changed = Signal(object)
    form_kept = Signal(ReportForm)
    comment_kept = Signal(str, str)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._report: SessionReport | None = None
        self._kept = ""
        self._usual: frozenset[str] = frozenset()
        column = in_column(Text(theme, self.tr("Comment"), 16, SEMIBOLD), gap=6, margins=(0, 0, 0, 0), within=self)
        words = self.tr("Printed on the report and kept with the session. No names here, please.")
        column.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        self.comment = _Comment()
        self.comment.setTabChangesFocus(True)
        self.comment.setAccessibleName(self.tr("Comment on the report"))
        theme.follow(self.comment, lambda: self.comment.setFixedHeight(theme.px(COMMENT_PX)))
        column.addWidget(self.comment)
        self.sentence = self._sentence_box()
        column.addWidget(self.sentence)
        row = QHBoxLayout()
        self.insert = Button(theme, self.tr("Insert"), height_px=38)
        self.remember = Button(theme, self.tr("Remember"), "quiet", height_px=38)
        self.forget = Button(theme, self.tr("Forget"), "quiet", height_px=38)
        for button in (self.insert, self.remember, self.forget):
            row.addWidget(button)
        row.addStretch(1)
        fill(column, row, 8, Text(theme, self.tr("Parts of the report"), 16, SEMIBOLD))
        names = {
            "diagnosis": self.tr("Diagnosis or operation"),
            "table": self.tr("Table"), "curves": self.tr("Curves and repetitions"), "bars": self.tr("Range as bars"),
            "quality": self.tr("How sure the figures are"), "speed": self.tr("Speed, pain, note"),
            "by_hand": self.tr("Entered by hand"), "motion": self.tr("Page of movement"),
        }  # fmt: skip
        self.ticks: dict[str, Tick] = {}
        for name in SECTIONS:
            self.ticks[name] = tick = Tick(theme, names[name])
            tick.toggled.connect(self._take_ticks)
            column.addWidget(tick)
        words = self.tr("Warnings, method and the legal sentence always stay.")
        column.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        self.keep = Button(theme, self.tr("Use these parts for all reports"), height_px=40)
        column.addWidget(self.keep)
        self._soon = QTimer(self, singleShot=True, interval=PREVIEW_AFTER_MS)
        self._soon.timeout.connect(self._take_comment)
        self.comment.textChanged.connect(self._soon.start)
        self.comment.left.connect(self.keep_comment)
        self.insert.clicked.connect(self._insert)
        self.remember.clicked.connect(self._remember)
        self.forget.clicked.connect(self._forget)
        self.keep.clicked.connect(self._keep_form)

    def _sentence_box(self) -> QComboBox:
        """The sentences to choose from, found by any part of them."""
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
            line.setPlaceholderText(self.tr("Type part of a sentence"))
        box.setToolTip(
            self.tr("These places take the session’s figures: {places}").replace(
                "{places}", ", ".join(f"{{{name}}}" for name in PLACES)
            )
        )
        return box

    def begin(self, report: SessionReport) -> None:
        self.keep_comment()
        self._soon.stop()
        self._report, self._kept, self._usual = None, report.comment, report.form.left_out
        self.comment.setPlainText(report.comment)
        for name, tick in self.ticks.items():
            tick.setChecked(report.form.has(name))
        self.ticks["diagnosis"].setVisible(bool(report.diagnosis or report.onset_day))
        self.ticks["bars"].setVisible(report.joints is None)
        self.ticks["by_hand"].setVisible(bool(report.by_hand))
        self.ticks["motion"].setVisible(report.motion is not None)
        self._report = report
        self._soon.stop()
        self._show_sentences()

    def keep_comment(self) -> None:
        self._take_comment()
        if self._report is not None and self._report.comment.strip() != self._kept.strip():
            self._kept = self._report.comment
            self.comment_kept.emit(self._report.figures.session_id, self._kept)

    def hideEvent(self, event) -> None:  # type: ignore[no-untyped-def]
        self.keep_comment()
        super().hideEvent(event)

    def _take_comment(self) -> None:
        self._soon.stop()
        if self._report is not None and self._report.comment != self.comment.toPlainText():
            self._report = replace(self._report, comment=self.comment.toPlainText())
            self.changed.emit(self._report)

    def _take_ticks(self) -> None:
        if self._report is not None:
            left_out = frozenset(name for name, tick in self.ticks.items() if not tick.isChecked())
            self._report = replace(self._report, form=replace(self._report.form, left_out=left_out))
            self.changed.emit(self._report)

    def _sentences(self) -> tuple[str, ...]:
        return self._report.form.sentences or proposals() if self._report is not None else ()

    def _show_sentences(self, current: str = "") -> None:
        self.sentence.clear()
        self.sentence.addItems(self._sentences())
        self.sentence.setCurrentIndex(-1)
        self.sentence.setEditText(current)

    def _insert(self) -> None:
        words = self.sentence.currentText().strip()
        if words and self._report is not None:
            cursor = self.comment.textCursor()
            before = self.comment.toPlainText()[: cursor.position()]
            cursor.insertText(("" if not before or before[-1].isspace() else " ") + filled(words, self._report))
            self.sentence.setEditText("")
            self.comment.setFocus(Qt.FocusReason.OtherFocusReason)

    def _remember(self) -> None:
        words = self.sentence.currentText().strip()
        if words and words not in self._sentences() and len(self._sentences()) < MOST_SENTENCES:
            self._keep_sentences((*self._sentences(), words), words)

    def _forget(self) -> None:
        words = self.sentence.currentText().strip()
        if words in self._sentences():
            self._keep_sentences(tuple(one for one in self._sentences() if one != words), "")

    def _keep_sentences(self, sentences: tuple[str, ...], current: str) -> None:
        if self._report is not None:
            self._report = replace(self._report, form=replace(self._report.form, sentences=sentences))
            self.changed.emit(self._report)
            self.form_kept.emit(replace(self._report.form, left_out=self._usual))
            self._show_sentences(current)

    def _keep_form(self) -> None:
        if self._report is not None:
            self._usual = self._report.form.left_out
            self.form_kept.emit(self._report.form)


class _Comment(QPlainTextEdit):
    """``left`` when another field is gone to."""

    left = Signal()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.left.emit()


ANGLES = {"flexion": 1, "extension": 1, "radial": 0, "ulnar": 0, "supination": 2, "pronation": 2}
PLACES = (*ANGLES, "arc", "change", "repetitions", "date")
_PLACE = re.compile(r"\{(\w+)\}")


def proposals() -> tuple[str, ...]:
    """Offered until the therapist has sentences of their own."""
    return (
        tr("Flexion {flexion}, extension {extension}."),
        tr("The whole arc is {arc}. {change}"),
        tr("Splint as before; exercises at home three times a day."),
        tr("Check again in two weeks."),
    )


def filled(sentence: str, report: SessionReport) -> str:
    """The sentence with its places filled; a figure that is not known is said to be so, another place stays."""
    return _PLACE.sub(lambda found: _value(found[1], report) if found[1] in PLACES else found[0], sentence)


def _value(place: str, report: SessionReport) -> str:
    figures = report.figures
    said: dict[str, Callable[[], str]] = {
        "arc": lambda: _arc(figures),
        "change": lambda: _change(report),
        "repetitions": lambda: str(figures.counted) if figures.counted else "",
        "date": lambda: numbers.report_date(figures.when),
    }
    words = said[place]() if place in said else _row(figures, place, ANGLES[place])
    return words or tr("not measured")


def _row(figures: SessionFigures, movement: str, angle: int) -> str:
    row = figures.find(WRIST_ANGLES[angle], movement)
    if row is None or not row.count:
        return ""
    if row.at_least:
        return range_words(row)
    if is_deficit(row):
        sd_deg = row.sd if prints_spread(row) else row.measurement_sd
        return f"{inside(terms.deficit_name(movement))} {numbers.with_spread(-row.mean, sd_deg)}"
    return mean_words(row)


def _arc(figures: SessionFigures) -> str:
    angle = figures.exercise.angle
    return "" if angle is None else _row(figures, "arc", angle)


def _change(report: SessionReport) -> str:
    if report.previous is None:
        return _sentence(tr("not measured"))
    day = numbers.day_beside(report.previous.when, report.figures.when)
    said = since_words(report.figures, report.previous, day)
    return said or _sentence(tr("not measured"))


def _sentence(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}."

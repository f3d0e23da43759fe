"""Rows of the session list, read from the data folder, and changes to sessions."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from PySide6.QtCore import QAbstractListModel, QModelIndex, QPersistentModelIndex, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QBrush, QFontMetricsF, QMouseEvent, QPainter, QPen, QPolygonF
from PySide6.QtWidgets import QFrame, QListView, QStyle, QStyledItemDelegate, QStyleOptionViewItem

from carpus.core.model.errors import SessionUnreadable
from carpus.core.records.changes import fingerprint
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.retention import RecordRetention
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.values import Patient, SessionEntry
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import MEDIUM, font
from carpus.ui.kit.theme import CARD_RADIUS_PX, Theme
from carpus.ui.kit.translate import to_mid_sentence, tr
from carpus.ui.words import terms
from carpus.ui.words.fingers import main_result_words
from carpus.ui.words.progress import correction_words
from carpus.ui.words.ranges import repetition_words
from carpus.ui.words.session import warning_lines

ROW_PX = 58
TICK_PX, TICK_LEFT_PX = 20, 18
MAX_TICKED = 2
COLUMNS = (0.062, 0.242, 0.490, 0.672, 0.768, 0.985)
"""Left edges as shares of the width: date, exercise and hand, main value, repetitions, remark; the last is the end."""
TWO_LINE_MAX_WIDTH_PX, TWO_LINE_EDGES = 830, (0.42, 0.84, 1.0)
"""In a narrower list (text at 100 %) date, value and repetitions stand above exercise and remark: right edges as
shares of what is right of the tick."""


@dataclass(frozen=True, slots=True)
class SessionLine:
    """Row of the session list; what must be read from the file is empty until then.

    ``counted_repetitions`` is such as ``8 / 10``; ``counted_words`` and ``warning`` are for the card.
    """

    entry: SessionEntry
    is_practice: bool = False
    exclusion_reason: str = ""
    """Why it is excluded; empty if it is not."""
    is_damaged: bool = False
    is_missing: bool = False
    """Whether its file is missing."""
    main_value: str = ""
    counted_repetitions: str = ""
    counted_words: str = ""
    warning: str = ""
    correction: str = ""
    """When markers were corrected, in words; empty as measured."""


def remark(line: SessionLine) -> str:
    """Return why a session is excluded or not readable; empty otherwise."""
    if line.entry.simulated and not line.is_practice:
        return tr("excluded: simulated")
    if line.exclusion_reason:
        return tr("excluded: {reason}").format(reason=line.exclusion_reason)
    if line.is_damaged:
        return tr("file missing") if line.is_missing else tr("cannot be read")
    return ""


def row_cells(line: SessionLine, lines: Sequence[SessionLine] = ()) -> tuple[str, str, str, str, str]:
    """Return the texts of a row; times are added where ``lines`` share a day."""
    entry, others = line.entry, (other.entry.recorded for other in lines)
    day = f"{numbers.format_short_date(entry.recorded)} {numbers.format_distinct_time(entry.recorded, *others)}"
    what = f"{terms.exercise_name(entry.exercise)}, {to_mid_sentence(terms.side_name(entry.hand))}"
    return day, what, line.main_value, line.counted_repetitions, remark(line) or line.correction.rstrip(".")


def elide_value(value: str, metrics: QFontMetricsF, width_px: float) -> str:
    """Shorten only the name of a value, such as ``Supin… −50° ± 1°``: a cut number would be wrong."""
    number = re.search(r"\N{MINUS SIGN}?\d.*", value)
    if number is None or metrics.horizontalAdvance(value) <= width_px:
        return metrics.elidedText(value, Qt.TextElideMode.ElideRight, width_px)
    rest = width_px - metrics.horizontalAdvance(f" {number[0]}")
    name = metrics.elidedText(value[: number.start()].rstrip(), Qt.TextElideMode.ElideRight, rest)
    return f"{name} {number[0]}"


class SessionListModel(QAbstractListModel):
    """Sessions of one patient, newest first."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: tuple[SessionLine, ...] = ()
        self.ticked: tuple[str, ...] = ()
        """At most two, in the order of ticking."""

    def show_lines(self, lines: Sequence[SessionLine]) -> None:
        self.beginResetModel()
        self.lines = tuple(lines)
        session_ids = [line.entry.session_id for line in lines]
        self.ticked = tuple(one for one in self.ticked if one in session_ids)
        self.endResetModel()

    def toggle(self, row: int) -> None:
        """Tick or untick a session; a third tick replaces the first."""
        session_id = self.lines[row].entry.session_id
        before = self.ticked
        rest = tuple(one for one in before if one != session_id)
        self.ticked = rest if session_id in before else (*rest, session_id)[-MAX_TICKED:]
        for number, line in enumerate(self.lines):
            if (line.entry.session_id in before) != (line.entry.session_id in self.ticked):
                self.dataChanged.emit(self.index(number), self.index(number))

    def show_line(self, line: SessionLine) -> None:
        for number, old in enumerate(self.lines):
            if old.entry.session_id == line.entry.session_id:
                self.lines = (*self.lines[:number], line, *self.lines[number + 1 :])
                self.dataChanged.emit(self.index(number), self.index(number))

    def find_row(self, session_id: str) -> int:
        """Return the row of a session, -1 if not shown."""
        return next((number for number, line in enumerate(self.lines) if line.entry.session_id == session_id), -1)

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(self.lines)

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        if not index.isValid():
            return None
        line = self.lines[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            ticked = self.tr("ticked") if line.entry.session_id in self.ticked else ""
            return ", ".join(part for part in (*row_cells(line, self.lines), ticked) if part)
        return line if role == Qt.ItemDataRole.UserRole else None


class SessionRowPainter(QStyledItemDelegate):
    """Delegate that paints a row; an excluded session is grey and hatched."""

    def __init__(self, theme: Theme, model: SessionListModel) -> None:
        super().__init__()
        self._theme, self._model = theme, model

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        return QSize(200, self._theme.px(ROW_PX))

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        theme, line = self._theme, self._model.lines[index.row()]
        box = QRectF(option.rect)
        state = option.state
        counts = not (line.exclusion_reason or line.is_damaged or (line.entry.simulated and not line.is_practice))
        painter.save()
        if state & QStyle.StateFlag.State_Selected:
            painter.fillRect(box, theme.color("soft"))
            painter.fillRect(QRectF(0, box.top() + 12, 4, box.height() - 24), theme.color("accent"))
        elif state & QStyle.StateFlag.State_MouseOver:
            painter.fillRect(box, theme.color("canvas"))
        if not counts:
            painter.fillRect(box, QBrush(theme.color("line"), Qt.BrushStyle.BDiagPattern))
        painter.setPen(QPen(theme.color("line"), 1))
        painter.drawLine(int(box.left()) + 20, int(box.bottom()), int(box.right()) - 20, int(box.bottom()))
        self._paint_tick(painter, box, ticked=line.entry.session_id in self._model.ticked)
        texts = row_cells(line, self._model.lines)
        rooms = _cell_boxes(box, theme, has_remark=bool(texts[4]))
        for number, text in enumerate(texts):
            face = font((16 if number == 2 else 14) * theme.text_scale, MEDIUM)
            painter.setFont(face)
            painter.setPen(theme.color("text" if counts and number < 3 else "text2"))
            room = rooms[number]
            # Of exercise and hand the end matters as much as the beginning.
            where = Qt.TextElideMode.ElideMiddle if number == 1 else Qt.TextElideMode.ElideRight
            metrics = QFontMetricsF(face)
            if number == 2:
                shown = elide_value(text, metrics, room.width())
            else:
                shown = metrics.elidedText(text, where, room.width())
            painter.drawText(room, int(Qt.AlignmentFlag.AlignVCenter), shown)
        painter.restore()

    def _paint_tick(self, painter: QPainter, box: QRectF, *, ticked: bool) -> None:
        theme, size = self._theme, self._theme.px(TICK_PX)
        square = QRectF(box.left() + TICK_LEFT_PX, box.center().y() - size / 2, size, size)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(theme.color("accent" if ticked else "border"), 1.5))
        painter.setBrush(theme.color("accent" if ticked else "surface"))
        painter.drawRoundedRect(square, 4, 4)
        if ticked:
            painter.setPen(QPen(theme.color("on_accent"), 2.0))
            places = ((0.24, 0.52), (0.43, 0.72), (0.78, 0.30))
            painter.drawPolyline(QPolygonF([square.topLeft() + QPointF(x * size, y * size) for x, y in places]))


def _cell_boxes(box: QRectF, theme: Theme, *, has_remark: bool) -> list[QRectF]:
    """Return the boxes of a row's texts, on one line or two."""
    if box.width() >= TWO_LINE_MAX_WIDTH_PX * theme.text_scale:
        edges = [box.left() + share * box.width() for share in COLUMNS]
        return [QRectF(left, box.top(), right - left - 8, box.height()) for left, right in pairwise(edges)]
    left = box.left() + TICK_LEFT_PX + theme.px(TICK_PX) + 12
    whole = box.left() + COLUMNS[-1] * box.width() - left
    upper, lower, high = box.top() + 0.08 * box.height(), box.top() + 0.5 * box.height(), 0.42 * box.height()
    day, figure, counted = (
        QRectF(left + begin * whole, upper, (end - begin) * whole - 8, high)
        for begin, end in pairwise((0.0, *TWO_LINE_EDGES))
    )
    what = QRectF(left, lower, (0.66 if has_remark else 1.0) * whole - 8, high)
    return [day, what, figure, counted, QRectF(what.right() + 8, lower, whole - what.width() - 16, high)]


def header_columns() -> list[str]:
    """Return the headings of the columns."""
    return [tr("Date"), tr("Exercise"), tr("Value"), tr("Analysed"), tr("Status")]


def place_headings(width: float, theme: Theme, _last_px: float) -> list[tuple[float, float]]:
    """Return left and right end of each heading; none for what stands in a second line."""
    boxes = _cell_boxes(QRectF(0, 0, width, 2), theme, has_remark=False)
    return [(box.left(), box.right() if box.top() < 1 else box.left()) for box in boxes]


class SessionList(QListView):
    """List on a rounded card.

    Signals: ``ticks_changed``.
    """

    ticks_changed = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.session_model = SessionListModel()
        self.setModel(self.session_model)
        self._delegate = SessionRowPainter(theme, self.session_model)
        self.setItemDelegate(self._delegate)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setMouseTracking(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName(self.tr("Sessions"))
        self.setUniformItemSizes(True)
        self._theme = theme
        theme.changed.connect(self._apply_theme)
        self._apply_theme()

    def tick_current(self) -> None:
        if self.currentIndex().isValid():
            self.session_model.toggle(self.currentIndex().row())
            self.ticks_changed.emit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        super().mousePressEvent(event)
        room = TICK_LEFT_PX + self._theme.px(TICK_PX) + 6
        on_tick = event.button() == Qt.MouseButton.LeftButton and event.position().x() < room
        if on_tick and self.indexAt(event.position().toPoint()).isValid():
            self.tick_current()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Treat a double click on a tick as two clicks."""
        if event.position().x() < TICK_LEFT_PX + self._theme.px(TICK_PX) + 6:
            self.mousePressEvent(event)
        else:
            super().mouseDoubleClickEvent(event)

    def _apply_theme(self) -> None:
        tokens = self._theme.tokens
        self.setStyleSheet(
            f"QListView {{ background: {tokens.surface}; border: 1px solid {tokens.line}; "
            f"border-radius: {CARD_RADIUS_PX}px; }}"
        )
        self.scheduleDelayedItemsLayout()
        self.viewport().update()


class SessionStore:
    """Sessions of a patient.

    All methods but ``list_sessions`` and ``target_patients`` access the disk and run in the background.
    """

    def __init__(
        self, library: DataFolder, name_patient: Callable[[Patient], str] = lambda patient: patient.pseudonym
    ) -> None:
        self._library, self._name_patient = library, name_patient

    def list_sessions(self, patient_id: str) -> Sequence[SessionLine]:
        """Return sessions, newest first, without what only their files contain."""
        return [
            SessionLine(one, patient_id == PRACTICE_PATIENT, self._exclusion_reason(one.session_id))
            for one in self._library.sessions(patient_id)
        ]

    def _exclusion_reason(self, session_id: str) -> str:
        try:
            choices = self._library.choices(session_id)
        except SessionUnreadable:
            return ""
        return (choices.session_exclusion_reason or "by hand") if choices.is_session_excluded else ""

    def with_figures(self, line: SessionLine) -> SessionLine:
        try:
            figures = self._library.results(line.entry)
        except SessionUnreadable:
            return replace(line, is_damaged=True, is_missing=not line.entry.path.exists())
        counted = f"{figures.repetition_count} / {len(figures.repetitions)}" if figures.repetitions else ""
        warnings = [] if line.is_practice else warning_lines(figures)
        return replace(
            line,
            main_value=main_result_words(figures),
            counted_repetitions=counted,
            counted_words=repetition_words(figures),
            warning=" ".join(warnings),
            correction=correction_words(figures),
        )

    def target_patients(self, patient_id: str) -> Sequence[tuple[str, str]]:
        rows = self._library.patients.search()
        return [(row.patient_id, self._name_patient(row)) for row in rows if row.patient_id != patient_id]

    def count_archived(self, patient_id: str) -> int:
        found = RecordRetention(self._library).list_archived()
        return sum(one.patient_id == patient_id and one.recorded is not None for one in found)

    def exclude(self, session_id: str, reason: str) -> None:
        choices = self._library.choices(session_id)
        self._library.save_choices(
            session_id, replace(choices, is_session_excluded=bool(reason), session_exclusion_reason=reason)
        )

    def move(self, session_id: str, patient_id: str) -> None:
        self._library.frame_cache.clear()
        self._library.session_list.move_to_patient(session_id, patient_id)
        self._library.audit_log.log_session("moved", session_id, to=fingerprint(patient_id))
        self._library.drop_cached_results(session_id)

    def rename_exercise(self, session_id: str, exercise: str) -> None:
        self._library.session_list.set_exercise(session_id, exercise)
        self._library.audit_log.log_session("renamed", session_id, exercise=exercise.lower())
        self._library.drop_cached_results(session_id)

"""Patient list: rows with the newest session first, the practice patient last."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from datetime import date
from types import MappingProxyType

from PySide6.QtCore import QAbstractListModel, QModelIndex, QPersistentModelIndex, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPainterPath, QPen, QResizeEvent
from PySide6.QtWidgets import QFrame, QListView, QStyle, QStyledItemDelegate, QStyleOptionViewItem

from carpus.core.model.names import fold_name
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.values import Patient
from carpus.ui.kit import numbers
from carpus.ui.kit.fonts import MEDIUM, font
from carpus.ui.kit.theme import CARD_RADIUS_PX, Theme
from carpus.ui.kit.translate import tr
from carpus.ui.shell.current_selection import NameDisplay
from carpus.ui.words import terms

ROW_PX = 56
COLUMNS = (0.024, 0.250, 0.343, 0.552, 0.685)
LARGE_COLUMNS = (0.024, 0.246, 0.420, 0.65, 0.65)
"""Left edges of name, hand, diagnosis, time since onset and last session as shares of the width; the count ends at
the right. With large text only the card shows the time since onset."""
LARGE_TEXT_SCALE = 1.25
RIGHT_PAD_PX = 28


class PatientListModel(QAbstractListModel):
    """Patients for Qt's views and screen readers."""

    def __init__(self, today: Callable[[], date], names: NameDisplay) -> None:
        super().__init__()
        self._rows: tuple[Patient, ...] = ()
        self.found_by: Mapping[str, str] = {}
        """What a search found patients by, in words, where the row does not show it; by id."""
        self.today, self._names = today, names
        self._namesakes: Collection[str] = ()

    def show_rows(self, rows: Sequence[Patient], found_by: Mapping[str, str] = MappingProxyType({})) -> None:
        self.beginResetModel()
        self.found_by = found_by
        self._rows = tuple(rows)
        count = Counter(fold_name(row.name) for row in rows if row.name)
        self._namesakes = {name for name, times in count.items() if times > 1}
        self.endResetModel()

    def row(self, number: int) -> Patient:
        return self._rows[number]

    def find_row(self, patient_id: str) -> int:
        """Return the row of a patient, -1 if not shown."""
        return next((number for number, row in enumerate(self._rows) if row.patient_id == patient_id), -1)

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(self._rows)

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        if not index.isValid():
            return None
        row = self._rows[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            name, *others = self.row_cells(row)
            return ", ".join(part for part in (name, *self.name_parts(row), *others) if part)
        return row if role == Qt.ItemDataRole.UserRole else None

    def row_cells(self, row: Patient) -> tuple[str, str, str, str, str, str, str]:
        """Return the cells of a patient today."""
        return row_cells(row, self.today(), self.found_by.get(row.patient_id, ""))

    def name_parts(self, row: Patient) -> tuple[str, str]:
        """Return the real name, and of two of one name what tells them apart."""
        name = self._names.real_name(row)
        if fold_name(name) not in self._namesakes:
            return name, ""
        return name, numbers.format_date(row.birth_day) if row.birth_day else row.record_number


def row_cells(row: Patient, today: date, found_by: str = "") -> tuple[str, str, str, str, str, str, str]:
    """Return the texts of a patient's row.

    They are pseudonym, hand, diagnosis (after what it was found by), time since onset, last session, its age and the
    number of sessions.
    """
    side = terms.side_name(row.side)
    is_practice = row.patient_id == PRACTICE_PATIENT
    diagnosis = tr("Try everything without a patient") if is_practice else row.diagnosis
    about = " · ".join(part for part in (found_by, diagnosis) if part)
    since = numbers.format_weeks_since(row.onset_day, today) if row.onset_day is not None else ""
    if row.last_session is None:
        return row.pseudonym, side, about, since, "" if is_practice else tr("No analysed session yet"), "", ""
    when = row.last_session
    return (
        row.pseudonym, side, about, since, numbers.format_short_date(when), numbers.format_days_ago(when, today),
        str(row.session_count),
    )  # fmt: skip


def column_edges(text_scale: float) -> tuple[float, ...]:
    """Return the left edges for a text scale."""
    return LARGE_COLUMNS if text_scale > LARGE_TEXT_SCALE else COLUMNS


class PatientRowPainter(QStyledItemDelegate):
    """Delegate that paints a row and its part of the rounded card."""

    def __init__(self, theme: Theme, model: PatientListModel) -> None:
        super().__init__()
        self._theme, self._model = theme, model

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        return QSize(200, self._theme.px(ROW_PX))

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        theme = self._theme
        box = QRectF(option.rect)
        state = option.state
        row = self._model.row(index.row())
        painter.save()
        corners = QPainterPath()
        frame = QRectF(option.widget.viewport().rect()).adjusted(0.5, 0.5, -0.5, -0.5)  # type: ignore[attr-defined]
        corners.addRoundedRect(frame, CARD_RADIUS_PX, CARD_RADIUS_PX)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setClipRect(box)
        painter.fillPath(corners, theme.color("surface"))
        painter.setClipPath(corners, Qt.ClipOperation.IntersectClip)
        if state & QStyle.StateFlag.State_Selected:
            painter.fillRect(box, theme.color("soft"))
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(theme.color("accent"))
            painter.drawRoundedRect(QRectF(0, box.top() + 12, 4, box.height() - 24), 2, 2)
        else:
            if state & QStyle.StateFlag.State_MouseOver:
                painter.fillRect(box, theme.color("canvas"))
            if index.row() + 1 < self._model.rowCount():
                painter.setPen(QPen(theme.color("line"), 1))
                painter.drawLine(int(box.left()) + 20, int(box.bottom()), int(box.right()) - 20, int(box.bottom()))
        self._paint_cells(painter, box, row)
        painter.setClipRect(box)
        painter.strokePath(corners, QPen(theme.color("line"), 1))
        painter.restore()

    def _paint_cells(self, painter: QPainter, box: QRectF, row: Patient) -> None:
        scale = self._theme.text_scale
        *texts, when, ago, count = self._model.row_cells(row)
        end = box.right() - RIGHT_PAD_PX
        edges = [*(box.left() + share * box.width() for share in column_edges(scale)), end]
        for number, text in enumerate(texts):
            face = font(14 * scale) if number else font(16 * scale, MEDIUM)
            last = next((later for later, one in enumerate([*texts, when]) if later > number and one), len(edges) - 1)
            room = QRectF(edges[number], box.top(), edges[last] - edges[number] - 8, box.height())
            name, apart = self._model.name_parts(row)
            if number == 0 and name:
                below, small = room.adjusted(0, 0.48 * room.height(), 0, -0.1 * room.height()), font(12 * scale)
                if apart:  # never cut: it tells two patients apart
                    width = QFontMetricsF(small).horizontalAdvance
                    behind = below.adjusted(
                        max(0.0, min(width(f"{name} "), below.width() - width(f"{apart} "))), 0, 0, 0
                    )
                    self._paint_text(painter, small, apart, behind, "text2")
                    below.setRight(behind.left())
                self._paint_text(painter, small, name, below, "text2")
                room.adjust(0, 0.08 * room.height(), 0, -0.48 * room.height())
            if edges[number + 1] > edges[number]:
                self._paint_text(painter, face, text, room, "text")
        face = font(14 * scale)
        plain = not ago
        room = QRectF(edges[4], box.top(), end - edges[4] - (0 if plain else 36), box.height())
        self._paint_text(painter, face, when, room, "text2" if plain else "text")
        date_width = max(self._theme.px(92), QFontMetricsF(face).horizontalAdvance(when) + 10)
        beside = room.adjusted(date_width, 0, 0, 0)
        if QFontMetricsF(face).horizontalAdvance(ago) <= beside.width():
            self._paint_text(painter, face, ago, beside, "text2")
        painter.setPen(self._theme.color("text"))
        painter.setFont(face)
        painter.drawText(
            QRectF(end - 80, box.top(), 80, box.height()),
            int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight), count,
        )  # fmt: skip

    def _paint_text(self, painter: QPainter, face: QFont, text: str, box: QRectF, token: str) -> None:
        painter.setFont(face)
        painter.setPen(self._theme.color(token))
        shown = QFontMetricsF(face).elidedText(text, Qt.TextElideMode.ElideRight, box.width())
        painter.drawText(box, int(Qt.AlignmentFlag.AlignVCenter), shown)


def header_columns() -> list[str]:
    """Return the headings of the columns."""
    return [
        tr("Patient"), tr("Hand"), tr("Diagnosis or operation"), tr("Time since"), tr("Last session"), tr("Sessions"),
    ]  # fmt: skip


def place_headings(width: float, theme: Theme, last_px: float) -> list[tuple[float, float]]:
    """Return left and right end of each heading; the last one, ``last_px`` wide, ends above the counts."""
    end = width - RIGHT_PAD_PX
    lefts = [*(share * width for share in column_edges(theme.text_scale)), end - last_px]
    return list(zip(lefts, [*(left - 8 for left in lefts[1:]), end], strict=True))


class PatientList(QListView):
    """List on a rounded card that is as high as its rows, or scrolls."""

    def __init__(self, theme: Theme, today: Callable[[], date], names: NameDisplay) -> None:
        super().__init__()
        self._theme = theme
        self.patient_model = PatientListModel(today, names)
        self.setModel(self.patient_model)
        self._delegate = PatientRowPainter(theme, self.patient_model)
        self.setItemDelegate(self._delegate)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setMouseTracking(True)
        self.setVerticalScrollMode(QListView.ScrollMode.ScrollPerItem)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setProperty("shows_own_focus", True)
        self.setAccessibleName(self.tr("Patients"))
        self.setUniformItemSizes(True)
        self.viewport().setAutoFillBackground(False)
        self.setStyleSheet("QListView { background: transparent; border: 0; }")
        theme.changed.connect(self._apply_theme)
        self.patient_model.modelReset.connect(self._apply_theme)

    def _apply_theme(self) -> None:
        self.setMaximumHeight(max(1, self.patient_model.rowCount()) * self._theme.px(ROW_PX))
        self.scheduleDelayedItemsLayout()
        self.updateGeometry()
        self.viewport().update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        row = self._theme.px(ROW_PX)
        rest = self.height() % row if self.height() < self.patient_model.rowCount() * row else 0
        self.setViewportMargins(0, 0, 0, rest)
        super().resizeEvent(event)

    def sizeHint(self) -> QSize:
        return QSize(600, max(1, self.patient_model.rowCount()) * self._theme.px(ROW_PX))

    def minimumSizeHint(self) -> QSize:
        return QSize(300, 2 * self._theme.px(ROW_PX))

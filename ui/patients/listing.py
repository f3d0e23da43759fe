"""The list of patients: rows of 56 px, newest first, the practice patient always last."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import date

from PySide6.QtCore import QAbstractListModel, QModelIndex, QPersistentModelIndex, QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPainterPath, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QFrame, QListView, QStyle, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from carpus.core.library.set_up import PRACTICE_PATIENT
from carpus.ui import numbers, terms
from carpus.ui.fonts import MEDIUM, font
from carpus.ui.ports import PatientRow
from carpus.ui.theme import CARD_RADIUS_PX, Theme
from carpus.ui.translate import tr

ROW_PX = 56
COLUMNS = (0.024, 0.238, 0.349, 0.633)
"""Left edge of name, hand, exercise and last session as a share of the width; the count ends at the right."""
RIGHT_PAD_PX = 28


class PatientModel(QAbstractListModel):
    """The rows as Qt's views and screen readers see them."""

    def __init__(self, today: Callable[[], date]) -> None:
        super().__init__()
        self._rows: tuple[PatientRow, ...] = ()
        self.today = today

    def show_rows(self, rows: Sequence[PatientRow]) -> None:
        """Replace all rows."""
        self.beginResetModel()
        self._rows = tuple(rows)
        self.endResetModel()

    def row(self, number: int) -> PatientRow:
        """The patient of a row."""
        return self._rows[number]

    def find(self, patient_id: str) -> int:
        """Row of a patient, -1 when not shown."""
        return next((number for number, row in enumerate(self._rows) if row.patient_id == patient_id), -1)

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(self._rows)

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        if not index.isValid():
            return None
        row = self._rows[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            return ", ".join(part for part in cells(row, self.today()) if part)
        return row if role == Qt.ItemDataRole.UserRole else None


def cells(row: PatientRow, today: date) -> tuple[str, str, str, str, str, str]:
    """Name, hand, exercise, date, how long ago, number of sessions."""
    if row.patient_id == PRACTICE_PATIENT:
        hint = tr("Try everything without a patient")
        return row.pseudonym, terms.side_name(row.side), tr("No camera needed"), hint, "", ""
    if row.last_session is None:
        return row.pseudonym, terms.side_name(row.side), "", tr("No session yet"), "", ""
    when = row.last_session
    return (
        row.pseudonym, terms.side_name(row.side), terms.exercise_name(row.exercise), numbers.short_date(when),
        numbers.days_ago(when, today), str(row.session_count),
    )  # fmt: skip


class RowPainter(QStyledItemDelegate):
    """Paints one row from the tokens."""

    def __init__(self, theme: Theme, model: PatientModel) -> None:
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
        corners.addRoundedRect(QRectF(option.widget.viewport().rect()), CARD_RADIUS_PX, CARD_RADIUS_PX)  # type: ignore[attr-defined]
        painter.setClipPath(corners)
        if state & QStyle.StateFlag.State_Selected:
            painter.fillRect(box, theme.color("soft"))
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
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
        painter.restore()

    def _paint_cells(self, painter: QPainter, box: QRectF, row: PatientRow) -> None:
        scale = self._theme.text_scale
        name, hand, exercise, when, ago, count = cells(row, self._model.today())
        edges = [box.left() + share * box.width() for share in COLUMNS]
        faces = (font(16 * scale, MEDIUM), font(14 * scale), font(14 * scale))
        for text, face, left, right in zip((name, hand, exercise), faces, edges[:3], edges[1:], strict=True):
            self._text(painter, face, text, QRectF(left, box.top(), right - left - 8, box.height()), "text")
        end = box.right() - RIGHT_PAD_PX
        face = font(14 * scale)
        plain = not ago
        room = QRectF(edges[3], box.top(), end - edges[3] - (0 if plain else 36), box.height())
        self._text(painter, face, when, room, "text2" if plain else "text")
        date_width = max(self._theme.px(92), QFontMetricsF(face).horizontalAdvance(when) + 10)
        beside = room.adjusted(date_width, 0, 0, 0)
        if QFontMetricsF(face).horizontalAdvance(ago) <= beside.width():
            self._text(painter, face, ago, beside, "text2")
        painter.setPen(self._theme.color("text"))
        painter.setFont(face)
        painter.drawText(
            QRectF(end - 80, box.top(), 80, box.height()),
            int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight), count,
        )  # fmt: skip

    def _text(self, painter: QPainter, face: QFont, text: str, box: QRectF, token: str) -> None:
        painter.setFont(face)
        painter.setPen(self._theme.color(token))
        shown = QFontMetricsF(face).elidedText(text, Qt.TextElideMode.ElideRight, box.width())
        painter.drawText(box, int(Qt.AlignmentFlag.AlignVCenter), shown)


class ListHeader(QWidget):
    """Column names over the columns of the rows, also when a scroll bar takes a part of the list's width."""

    def __init__(self, theme: Theme, rows: QListView) -> None:
        super().__init__()
        self._theme, self._rows = theme, rows
        rows.verticalScrollBar().rangeChanged.connect(lambda *_: self.update())
        theme.follow(self, lambda: self.setFixedHeight(theme.px(28)))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setFont(font(12 * self._theme.text_scale, MEDIUM))
        painter.setPen(self._theme.color("text2"))
        flags = int(Qt.AlignmentFlag.AlignVCenter)
        width = self._rows.viewport().width()
        names = (self.tr("Patient"), self.tr("Hand"), self.tr("Last exercise"), self.tr("Last session"))
        for name, share in zip(names, COLUMNS, strict=True):
            painter.drawText(QRectF(share * width, 0, 200, self.height()), flags, name)
        right = QRectF(0, 0, width - RIGHT_PAD_PX, self.height())
        painter.drawText(right, int(Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight), self.tr("Sessions"))


class PatientList(QListView):
    """The rows on a rounded surface; the height follows the rows until the room ends, then it scrolls."""

    def __init__(self, theme: Theme, today: Callable[[], date]) -> None:
        super().__init__()
        self._theme = theme
        self.rows = PatientModel(today)
        self.setModel(self.rows)
        self._painter_of_rows = RowPainter(theme, self.rows)
        self.setItemDelegate(self._painter_of_rows)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setMouseTracking(True)
        self.setVerticalScrollMode(QListView.ScrollMode.ScrollPerItem)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setProperty("shows_own_focus", True)
        self.setAccessibleName(self.tr("Patients"))
        self.setUniformItemSizes(True)
        self.viewport().setAutoFillBackground(False)
        self.setStyleSheet("QListView { background: transparent; border: 0; }")
        theme.changed.connect(self._take_theme)
        self.rows.modelReset.connect(self._take_theme)

    def _take_theme(self) -> None:
        self.setMaximumHeight(max(1, self.rows.rowCount()) * self._theme.px(ROW_PX))
        self.scheduleDelayedItemsLayout()
        self.updateGeometry()
        self.viewport().update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Only whole rows are shown."""
        row = self._theme.px(ROW_PX)
        rest = self.height() % row if self.height() < self.rows.rowCount() * row else 0
        self.setViewportMargins(0, 0, 0, rest)
        super().resizeEvent(event)

    def sizeHint(self) -> QSize:
        return QSize(600, max(1, self.rows.rowCount()) * self._theme.px(ROW_PX))

    def minimumSizeHint(self) -> QSize:
        return QSize(300, 2 * self._theme.px(ROW_PX))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self.viewport())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        frame = QRectF(self.viewport().rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        rounded = QPainterPath()
        rounded.addRoundedRect(frame, CARD_RADIUS_PX, CARD_RADIUS_PX)
        painter.fillPath(rounded, self._theme.color("surface"))
        painter.end()
        super().paintEvent(event)
        painter.begin(self.viewport())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self._theme.color("line"), 1))
        painter.drawPath(rounded)
        painter.end()

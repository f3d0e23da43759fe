"""The rows of the list of sessions: date, exercise and hand, main figure, how much counted, remark."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from PySide6.QtCore import QAbstractListModel, QModelIndex, QPersistentModelIndex, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QBrush, QFontMetricsF, QMouseEvent, QPainter, QPen, QPolygonF
from PySide6.QtWidgets import QFrame, QListView, QStyle, QStyledItemDelegate, QStyleOptionViewItem

from carpus.core.records.values import SessionEntry
from carpus.ui import numbers, terms
from carpus.ui.fonts import MEDIUM, font
from carpus.ui.theme import CARD_RADIUS_PX, Theme
from carpus.ui.translate import inside, tr

ROW_PX = 58
TICK_PX, TICK_LEFT_PX = 20, 18
MOST_TICKED = 2
COLUMNS = (0.062, 0.242, 0.490, 0.680, 0.760, 0.985)
"""Left edges as shares of the width: date, exercise and hand, main figure, counted, remark; the last is the end."""
TWO_LINES_BELOW_PX, TWO_LINES = 720, (0.42, 0.84, 1.0)
"""In a narrower list, text at 100 %, date, figure and what counted stand over exercise and remark: right edges as
shares of what is right of the tick."""


@dataclass(frozen=True, slots=True)
class SessionLine:
    """One row of the list of sessions. What must be read from the file is empty until it has been: ``figure`` the main
    one in words, ``counted`` ``8 of 9``, ``counted_words`` and ``warning`` for the card."""

    entry: SessionEntry
    of_practice: bool = False
    set_aside: str = ""
    """Why it does not count; empty when it does."""
    damaged: bool = False
    away: bool = False
    """Its file is not where it was."""
    figure: str = ""
    counted: str = ""
    counted_words: str = ""
    warning: str = ""
    corrected: str = ""
    """That and since when markers were put right, in words; empty as measured."""


def remark(line: SessionLine) -> str:
    """What must be known of a session before its figures."""
    if line.entry.simulated and not line.of_practice:
        return tr("does not count: simulated")
    if line.set_aside:
        return tr("set aside: {reason}").format(reason=line.set_aside)
    if line.damaged:
        return tr("its file is not there") if line.away else tr("cannot be read")
    return ""


def cells(line: SessionLine, lines: Sequence[SessionLine] = ()) -> tuple[str, str, str, str, str]:
    """The texts of a row, which is told from the other ``lines``; what is not known yet is empty."""
    entry, others = line.entry, (other.entry.recorded for other in lines)
    day = f"{numbers.short_date(entry.recorded)} {numbers.time_beside(entry.recorded, *others)}"
    what = f"{terms.exercise_name(entry.exercise)}, {inside(terms.side_name(entry.hand))}"
    return day, what, line.figure, line.counted, remark(line) or line.corrected.rstrip(".")


def cut_figure(figure: str, metrics: QFontMetricsF, width_px: float) -> str:
    """``Supin… −50° ± 1°``: only the name is cut, for a number that lost its sign is another one."""
    number = re.search(r"\N{MINUS SIGN}?\d.*", figure)
    if number is None or metrics.horizontalAdvance(figure) <= width_px:
        return metrics.elidedText(figure, Qt.TextElideMode.ElideRight, width_px)
    rest = width_px - metrics.horizontalAdvance(f" {number[0]}")
    name = metrics.elidedText(figure[: number.start()].rstrip(), Qt.TextElideMode.ElideRight, rest)
    return f"{name} {number[0]}"


class SessionModel(QAbstractListModel):
    """The sessions of one patient, newest first."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: tuple[SessionLine, ...] = ()
        self.ticked: tuple[str, ...] = ()
        """At most two, the one that was ticked first before the other."""

    def show_lines(self, lines: Sequence[SessionLine]) -> None:
        self.beginResetModel()
        self.lines = tuple(lines)
        there = [line.entry.session_id for line in lines]
        self.ticked = tuple(one for one in self.ticked if one in there)
        self.endResetModel()

    def toggle(self, row: int) -> None:
        """Tick a session, or take its tick away; with a third one the first gives way."""
        session_id = self.lines[row].entry.session_id
        before = self.ticked
        rest = tuple(one for one in before if one != session_id)
        self.ticked = rest if session_id in before else (*rest, session_id)[-MOST_TICKED:]
        for number, line in enumerate(self.lines):
            if (line.entry.session_id in before) != (line.entry.session_id in self.ticked):
                self.dataChanged.emit(self.index(number), self.index(number))

    def show_line(self, line: SessionLine) -> None:
        for number, old in enumerate(self.lines):
            if old.entry.session_id == line.entry.session_id:
                self.lines = (*self.lines[:number], line, *self.lines[number + 1 :])
                self.dataChanged.emit(self.index(number), self.index(number))

    def find(self, session_id: str) -> int:
        """Row of a session, -1 when not shown."""
        return next((number for number, line in enumerate(self.lines) if line.entry.session_id == session_id), -1)

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(self.lines)

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        if not index.isValid():
            return None
        line = self.lines[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            ticked = self.tr("ticked") if line.entry.session_id in self.ticked else ""
            return ", ".join(part for part in (*cells(line, self.lines), ticked) if part)
        return line if role == Qt.ItemDataRole.UserRole else None


class SessionRowPainter(QStyledItemDelegate):
    """Paints one row from the tokens; a session that does not count is grey and hatched, and says why."""

    def __init__(self, theme: Theme, model: SessionModel) -> None:
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
        counts = not (line.set_aside or line.damaged or (line.entry.simulated and not line.of_practice))
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
        texts = cells(line, self._model.lines)
        rooms = _rooms(box, theme, remarked=bool(texts[4]))
        for number, text in enumerate(texts):
            face = font((16 if number == 2 else 14) * theme.text_scale, MEDIUM)
            painter.setFont(face)
            painter.setPen(theme.color("text" if counts and number < 3 else "text2"))
            room = rooms[number]
            # Of exercise and hand the end matters as much as the beginning.
            where = Qt.TextElideMode.ElideMiddle if number == 1 else Qt.TextElideMode.ElideRight
            metrics = QFontMetricsF(face)
            if number == 2:
                shown = cut_figure(text, metrics, room.width())
            else:
                shown = metrics.elidedText(text, where, room.width())
            painter.drawText(room, int(Qt.AlignmentFlag.AlignVCenter), shown)
        painter.restore()

    def _paint_tick(self, painter: QPainter, box: QRectF, *, ticked: bool) -> None:
        """A box that is filled and has a check where the session is ticked."""
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


def _rooms(box: QRectF, theme: Theme, *, remarked: bool) -> list[QRectF]:
    """Where the texts of a row stand: beside each other, or on two lines."""
    if box.width() >= TWO_LINES_BELOW_PX * theme.text_scale:
        edges = [box.left() + share * box.width() for share in COLUMNS]
        return [QRectF(left, box.top(), right - left - 8, box.height()) for left, right in pairwise(edges)]
    left = box.left() + TICK_LEFT_PX + theme.px(TICK_PX) + 12
    whole = box.left() + COLUMNS[-1] * box.width() - left
    upper, lower, high = box.top() + 0.08 * box.height(), box.top() + 0.5 * box.height(), 0.42 * box.height()
    day, figure, counted = (
        QRectF(left + begin * whole, upper, (end - begin) * whole - 8, high)
        for begin, end in pairwise((0.0, *TWO_LINES))
    )
    what = QRectF(left, lower, (0.66 if remarked else 1.0) * whole - 8, high)
    return [day, what, figure, counted, QRectF(what.right() + 8, lower, whole - what.width() - 16, high)]


class SessionList(QListView):
    """The rows on a rounded surface; ``ticks_changed`` when another session is ticked."""

    ticks_changed = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.rows = SessionModel()
        self.setModel(self.rows)
        self._painter_of_rows = SessionRowPainter(theme, self.rows)
        self.setItemDelegate(self._painter_of_rows)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setMouseTracking(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName(self.tr("Sessions"))
        self.setUniformItemSizes(True)
        self._theme = theme
        theme.changed.connect(self._take_theme)
        self._take_theme()

    def tick_current(self) -> None:
        if self.currentIndex().isValid():
            self.rows.toggle(self.currentIndex().row())
            self.ticks_changed.emit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        super().mousePressEvent(event)
        room = TICK_LEFT_PX + self._theme.px(TICK_PX) + 6
        on_tick = event.button() == Qt.MouseButton.LeftButton and event.position().x() < room
        if on_tick and self.indexAt(event.position().toPoint()).isValid():
            self.tick_current()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Two quick clicks on a tick are two clicks, and open nothing."""
        if event.position().x() < TICK_LEFT_PX + self._theme.px(TICK_PX) + 6:
            self.mousePressEvent(event)
        else:
            super().mouseDoubleClickEvent(event)

    def _take_theme(self) -> None:
        tokens = self._theme.tokens
        self.setStyleSheet(
            f"QListView {{ background: {tokens.surface}; border: 1px solid {tokens.line}; "
            f"border-radius: {CARD_RADIUS_PX}px; }}"
        )
        self.scheduleDelayedItemsLayout()
        self.viewport().update()

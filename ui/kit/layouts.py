"""Layouts with their parts in one expression, and scrolling pages."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias, TypeVar

from PySide6.QtCore import QEvent, QPoint, QRect, QSize, Qt, QTimer
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QBoxLayout,
    QGridLayout,
    QHBoxLayout,
    QLayout,
    QLayoutItem,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

# Left, top, right, bottom.
Margins: TypeAlias = tuple[int, int, int, int]
LayoutT = TypeVar("LayoutT", bound=QBoxLayout)


class Stretch:
    """Part that takes the remaining room."""


STRETCH = Stretch()
Item: TypeAlias = QWidget | QLayout
# A widget or layout with its stretch and alignment, or a gap in design pixels.
Part: TypeAlias = Item | Stretch | int | tuple[Item, int] | tuple[QWidget, int, Qt.AlignmentFlag]


def fill(layout: QBoxLayout, *parts: Part) -> None:
    """Add parts to a layout, one after the other."""
    for part in parts:
        item, share, *aligned = part if isinstance(part, tuple) else (part, 0)
        if isinstance(item, Stretch):
            layout.addStretch(1)
        elif isinstance(item, int):
            layout.addSpacing(item)
        elif isinstance(item, QLayout):
            layout.addLayout(item, share)
        elif aligned:
            layout.addWidget(item, share, aligned[0])
        else:
            layout.addWidget(item, share)


def clear_layout(layout: QLayout) -> None:
    """Remove and delete all widgets of a layout."""
    while (item := layout.takeAt(0)) is not None:
        if (widget := item.widget()) is not None:
            widget.hide()
            widget.deleteLater()


def row_layout(
    *parts: Part,
    gap: int | None = None,
    margins: Margins | None = None,
    parent: QWidget | None = None,
) -> QHBoxLayout:
    """Return a layout of parts side by side, installed on ``parent``."""
    return _fill_layout(QHBoxLayout() if parent is None else QHBoxLayout(parent), parts, gap, margins)


def column_layout(
    *parts: Part,
    gap: int | None = None,
    margins: Margins | None = None,
    parent: QWidget | None = None,
) -> QVBoxLayout:
    """Return a layout of parts one below the other, installed on ``parent``."""
    return _fill_layout(QVBoxLayout() if parent is None else QVBoxLayout(parent), parts, gap, margins)


def grid_layout(
    horizontal_gap: int,
    vertical_gap: int,
    *,
    stretches: Sequence[int] = (),
    margins: Margins | None = None,
    parent: QWidget | None = None,
) -> QGridLayout:
    """Return a grid with these gaps and column stretches, installed on ``parent``."""
    grid = QGridLayout() if parent is None else QGridLayout(parent)
    grid.setHorizontalSpacing(horizontal_gap)
    grid.setVerticalSpacing(vertical_gap)
    if margins is not None:
        grid.setContentsMargins(*margins)
    for column, share in enumerate(stretches):
        grid.setColumnStretch(column, share)
    return grid


def _fill_layout(layout: LayoutT, parts: tuple[Part, ...], gap: int | None, margins: Margins | None) -> LayoutT:
    if gap is not None:
        layout.setSpacing(gap)
    if margins is not None:
        layout.setContentsMargins(*margins)
    fill(layout, *parts)
    return layout


def require_parent(widget: QWidget) -> QWidget:
    """Return the parent of a widget that always has one."""
    parent = widget.parentWidget()
    assert parent is not None
    return parent


class FlowLayout(QLayout):
    """Layout in one line, or several if there is little room; never narrower than its widest item."""

    def __init__(self, spacing_px: int) -> None:
        super().__init__()
        self._items: list[QLayoutItem] = []
        self.setContentsMargins(0, 0, 0, 0)
        self.setSpacing(spacing_px)

    def addItem(self, item: QLayoutItem) -> None:
        self._items.append(item)

    def count(self) -> int:
        return len(self._items)

    def itemAt(self, index: int) -> QLayoutItem | None:
        return self._items[index] if 0 <= index < len(self._items) else None

    def takeAt(self, index: int) -> QLayoutItem | None:
        return self._items.pop(index) if 0 <= index < len(self._items) else None

    def expandingDirections(self) -> Qt.Orientation:
        return Qt.Orientation(0)

    def hasHeightForWidth(self) -> bool:
        return True

    def heightForWidth(self, width: int) -> int:
        return self._place_items(QRect(0, 0, width, 0), moves=False)

    def setGeometry(self, room: QRect) -> None:
        super().setGeometry(room)
        self._place_items(room, moves=True)

    def sizeHint(self) -> QSize:
        sizes = [item.sizeHint() for item in self._items]
        across = sum(size.width() for size in sizes) + self.spacing() * max(len(sizes) - 1, 0)
        return QSize(across, max((size.height() for size in sizes), default=0))

    def minimumSize(self) -> QSize:
        sizes = [item.minimumSize() for item in self._items]
        return QSize(max((one.width() for one in sizes), default=0), max((one.height() for one in sizes), default=0))

    def _place_items(self, room: QRect, *, moves: bool) -> int:
        x = y = line_px = 0
        for item in self._items:
            size = item.sizeHint()
            size.setWidth(min(size.width(), room.width()))
            if x and x + size.width() > room.width():
                x, y, line_px = 0, y + line_px + self.spacing(), 0
            if moves:
                item.setGeometry(QRect(room.topLeft() + QPoint(x, y), size))
            x, line_px = x + size.width() + self.spacing(), max(line_px, size.height())
        return y + line_px


RING_PX = 5
# Qt's own largest width and height.
NO_LIMIT_PX = 16_777_215


class FittedWidget(QWidget):
    """Widget that adapts its content whenever its size changes."""

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit()

    def _fit_soon(self) -> None:
        """Adapt once more after all parts have taken their new size."""
        QTimer.singleShot(0, self, self._fit)

    def _fit(self) -> None:
        raise NotImplementedError


class ScrolledColumn(QWidget):
    """Column as high as its texts need at their width; Qt assumes narrower texts and scrolls too soon."""

    def minimumSizeHint(self) -> QSize:
        whole, layout = super().minimumSizeHint(), self.layout()
        # Where nothing wraps just now Qt asks for no height at a width, and would press everything together instead.
        wraps = layout is None or layout.hasHeightForWidth()
        return QSize(whole.width(), 0) if wraps else whole


class _ScrolledPage(ScrolledColumn):
    """Page that is never lower than its content's minimum."""

    def heightForWidth(self, width: int) -> int:
        layout = self.layout()
        return -1 if layout is None else layout.minimumHeightForWidth(width)


class ScrollArea(QScrollArea):
    """Vertical scroll area; Tab skips it unless ``focus`` says otherwise."""

    def __init__(self, host: QWidget, focus: Qt.FocusPolicy = Qt.FocusPolicy.NoFocus) -> None:
        super().__init__()
        self.setWidget(host)
        self.setWidgetResizable(True)
        self.setFocusPolicy(focus)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)

    def expand(self, *, on: bool) -> None:
        """Show all content at its full height, on a page that scrolls instead."""
        policy = self.sizePolicy()
        policy.setHeightForWidth(on)
        self.setSizePolicy(policy)
        bar = Qt.ScrollBarPolicy
        self.setVerticalScrollBarPolicy(bar.ScrollBarAlwaysOff if on else bar.ScrollBarAsNeeded)

    def heightForWidth(self, width: int) -> int:
        held = self.widget()
        if held is None:
            return -1
        return held.heightForWidth(width) if held.hasHeightForWidth() else held.sizeHint().height()

    def event(self, event: QEvent) -> bool:
        if event.type() == QEvent.Type.LayoutRequest and self.sizePolicy().hasHeightForWidth():
            self.updateGeometry()  # what it holds has become higher or lower
        return super().event(event)


def scroll_page(layout: QVBoxLayout) -> ScrollArea:
    """Return a whole screen that scrolls if the window is lower than its minimum."""
    host = _ScrolledPage()
    host.setLayout(layout)
    return ScrollArea(host)


def scroll_column(layout: QVBoxLayout) -> ScrollArea:
    """Return a column that scrolls, with room for the focus ring at its edges."""
    layout.setContentsMargins(RING_PX, RING_PX, RING_PX, RING_PX)
    host = ScrolledColumn()
    host.setLayout(layout)
    return ScrollArea(host)

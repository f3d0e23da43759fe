"""The curves of small panels as pictures that go on at the right: what is new is painted, the rest only moves."""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QRect, QRectF, Qt
from PySide6.QtGui import QPainter, QPixmap

from carpus.core.types import FloatArray
from carpus.ui.plot.axes import Panel
from carpus.ui.plot.history import Block
from carpus.ui.plot.series import Pens, paint_stretch

MARGIN_PX = 4
"""About each panel, for lines at its edge; so far before the newest sample a line may still change with the next."""
LEAD_PX = 8
"""Samples that far before the painted part shape the line in it."""


@dataclass(frozen=True, slots=True)
class PanelCurves:
    """A panel and the curves in it: column of the block and pens."""

    panel: Panel
    curves: Sequence[tuple[int, Pens]]


class CurveStrips:
    """One picture per panel; lengths within are device pixels. The curves must have no gap and stay in the panel."""

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Paint all anew next time."""
        self._key: Hashable = None
        self._pictures: list[QPixmap] = []
        self._origin_s = self._painted_to_s = math.nan
        self._right_px = 0
        self._arc_px: list[FloatArray] = []

    def paint(self, painter: QPainter, panels: Sequence[PanelCurves], block: Block, now_s: float) -> None:
        """Paint the curves of all panels, which are equally wide, with ``now_s`` at their right end."""
        if not panels or not len(block.time_s):
            return
        ratio = painter.device().devicePixelRatioF()
        key = (ratio, tuple((own.panel.box.getRect(), tuple(k for k, _ in own.curves)) for own in panels))
        last = int(np.searchsorted(block.time_s, self._painted_to_s))
        if key != self._key or last >= len(block.time_s) or block.time_s[last] != self._painted_to_s:
            self._begin(key, panels, block, ratio)
        elif last + 1 < len(block.time_s):
            self._go_on(panels, block, last, ratio)
        right_px = round(float(self._x_px(now_s, panels[0].panel, ratio)))
        for own, picture in zip(panels, self._pictures, strict=True):
            box = own.panel.box
            # What of the picture is left of now and not older than the panel reaches.
            end = picture.width() - (self._right_px - right_px)
            begin = max(end - round(box.width() * ratio), 0)
            source = QRectF(begin, 0, min(end, picture.width()) - begin, picture.height())
            left = round(box.right() * ratio) - (end - begin)
            top = _top_px(own.panel, ratio)
            target = QRectF(left / ratio, top / ratio, source.width() / ratio, source.height() / ratio)
            painter.drawPixmap(target, picture, source)

    def _begin(self, key: Hashable, panels: Sequence[PanelCurves], block: Block, ratio: float) -> None:
        self._key, self._origin_s = key, float(block.time_s[0])
        self._arc_px = [np.zeros(block.value_deg.shape[1]) for _ in panels]
        self._pictures = []
        for own in panels:
            box = own.panel.box
            size = (math.ceil(box.width() * ratio) + 2 * MARGIN_PX, math.ceil(box.height() * ratio) + 2 * MARGIN_PX)
            picture = QPixmap(*size)
            picture.fill(Qt.GlobalColor.transparent)
            self._pictures.append(picture)
        newest_px = float(self._x_px(block.time_s[-1], panels[0].panel, ratio))
        self._right_px = math.floor(newest_px) + MARGIN_PX
        for own, picture, arc in zip(panels, self._pictures, self._arc_px, strict=True):
            self._add(own, picture, arc, block, slice(0, None), 0, 0, ratio)
        self._painted_to_s = float(block.time_s[-1])

    def _go_on(self, panels: Sequence[PanelCurves], block: Block, last: int, ratio: float) -> None:
        x = self._x_px(block.time_s, panels[0].panel, ratio)
        right_px = math.floor(float(x[-1])) + MARGIN_PX
        moved_px, self._right_px = right_px - self._right_px, right_px
        anew_px = math.floor(float(x[last])) - MARGIN_PX
        first = max(int(np.searchsorted(x, anew_px - LEAD_PX)) - 1, 0)
        for own, picture, arc in zip(panels, self._pictures, self._arc_px, strict=True):
            picture.scroll(-moved_px, 0, picture.rect())
            from_px = max(anew_px - (right_px - picture.width()), 0)
            self._add(own, picture, arc, block, slice(first, None), last - first, from_px, ratio)
        self._painted_to_s = float(block.time_s[-1])

    def _add(
        self,
        own: PanelCurves,
        picture: QPixmap,
        arc_px: FloatArray,
        block: Block,
        part: slice,
        last: int,
        from_px: int,
        ratio: float,
    ) -> None:
        """Paint a part of the block from ``from_px`` of the picture on.

        ``last`` in the part was the newest sample painted; ``arc_px`` along each curve there is taken on to the end.
        """
        panel = own.panel
        painter = QPainter(picture)
        room = QRect(from_px, 0, picture.width() - from_px, picture.height())
        painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_Source)
        painter.fillRect(room, Qt.GlobalColor.transparent)
        painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_SourceOver)
        painter.setClipRect(room)
        x = self._x_px(block.time_s[part], panel, ratio) - (self._right_px - picture.width())
        top = _top_px(panel, ratio)
        for k, pens in own.curves:
            value, sd = block.value_deg[part, k], block.sd_deg[part, k]
            y, upper, lower = (panel.y(some) * ratio - top for some in (value, value + sd, value - sd))
            arc = np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))))
            arc += arc_px[k] - arc[last]
            arc_px[k] = arc[-1]
            paint_stretch(painter, pens, x, y, (upper, lower), block.predicted[part, k], arc, ratio)
        painter.end()

    def _x_px(self, time_s: FloatArray | float, panel: Panel, ratio: float) -> FloatArray:
        rate = panel.box.width() * ratio / (panel.end_s - panel.start_s)
        return np.asarray((np.asarray(time_s) - self._origin_s) * rate)


def _top_px(panel: Panel, ratio: float) -> int:
    """Where a panel's picture begins."""
    return round(panel.box.top() * ratio) - MARGIN_PX

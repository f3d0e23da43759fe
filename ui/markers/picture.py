"""The fixed picture with clicks on it: mouse or keyboard cursor, loupe, rings and names."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, QSizeF, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QKeyEvent, QMouseEvent, QPainter, QPen, QWheelEvent

from carpus.core.rounding import written
from carpus.core.types import FloatArray
from carpus.ui.fonts import SEMIBOLD, font
from carpus.ui.marker_words import finger_name, marker_name
from carpus.ui.markers.clicking import Clicking
from carpus.ui.picture.name_places import place_for
from carpus.ui.picture.overlay import haloed
from carpus.ui.picture.photo import label_size, paint_label, paint_wrong_label
from carpus.ui.picture.view import PictureView
from carpus.ui.ports import FoundMarker
from carpus.ui.theme import (
    CARD_RADIUS_PX,
    DARK,
    ON_PICTURE_LABEL,
    ON_PICTURE_LINE,
    ON_PICTURE_PROPOSED,
    ON_PICTURE_WRONG,
    Theme,
)  # fmt: skip

LOUPE_PX, LOUPE_TIMES = 204, 8.0
GRAB_PX = 12.0
LABEL_ROOM_PX = 150.0
"""Beside a disc, for its name: the loupe covers neither."""
RING_LEAST_PX = 12.0
ARROWS = {
    Qt.Key.Key_Left: (-1.0, 0.0), Qt.Key.Key_Right: (1.0, 0.0),
    Qt.Key.Key_Up: (0.0, -1.0), Qt.Key.Key_Down: (0.0, 1.0),
}  # fmt: skip
BIG_STEP_PX = 10.0
ON_PICTURE_DOUBTFUL = DARK.warn
LEAST_ZOOM, MOST_ZOOM, ZOOM_STEP = 1.0, 6.0, 1.25


FEW = 6
"""So many discs each carry their name."""


@dataclass(frozen=True, slots=True)
class NamePlate:
    """Where a name stands, and the line from it to its ring where it stands further off."""

    name: str
    words: str
    plate: QRectF
    line: QLineF | None


def rays(markers: Sequence[str]) -> list[list[str]]:
    """Marker names finger by finger from the wrist, of those the protocol has."""
    fingers = [["WRIST", "CMC1", "MCP1", "IP1", "TIP1"]]
    fingers += [["WRIST", *(f"{joint}{k}" for joint in ("MCP", "PIP", "DIP", "TIP"))] for k in (2, 3, 4, 5)]
    return [[name for name in finger if name in markers] for finger in fingers]


class MarkerPicture(PictureView):
    """Emits ``moved`` with the cursor's pixel, ``clicked`` with the pixel, ``grabbed`` with a marker's name."""

    moved = Signal(object)
    clicked = Signal(object)
    grabbed = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, (832, 624))
        self.clicking: Clicking | None = None
        self.cursor_px: FloatArray | None = None
        self.found: FoundMarker | None = None
        self.wrong: frozenset[str] = frozenset()
        self.spots: list[tuple[tuple[float, ...], str]] = []
        self.discs_px: FloatArray = np.empty((0, 2))
        self.no_marker_words = ""
        self._dragging = False
        self._zoom = LEAST_ZOOM
        self._keyed = False
        self.overlay = lambda painter, _: self._paint_marks(painter)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setProperty("shows_own_focus", True)
        self.setAccessibleName(self.tr("Picture to click the markers on"))

    def show_wrong(self, names: Collection[str]) -> None:
        self.wrong = frozenset(names)
        self.update()

    def show_spots(self, spots: Sequence[tuple[Sequence[float], str]]) -> None:
        """Mark spots (u, v) without a name, each with the marker that it may be, or nothing."""
        self.spots = [(tuple(pixel), name) for pixel, name in spots]
        self.update()

    def show_discs(self, pixel: FloatArray) -> None:
        """Everything (D, 2) that may be clicked: no name covers it."""
        self.discs_px = pixel
        self.update()

    def forget_cursor(self) -> None:
        """Another picture: where the cursor was on the last one means nothing here."""
        self.cursor_px = self.found = None
        self.no_marker_words = ""

    def set_cursor(self, pixel: FloatArray) -> None:
        """Put the cursor on a pixel, kept inside the picture."""
        if self.image is not None:
            limit = np.array([self.image.width() - 1.0, self.image.height() - 1.0])
            self.cursor_px = np.clip(np.asarray(pixel, dtype=np.float64), 0.0, limit)
            self.moved.emit(self.cursor_px)
            self.update()

    def zoom(self, by: int, around: QPointF | None = None) -> None:
        """Larger (+1) or smaller (-1), about a place of the widget or the cursor."""
        if self.image is None:
            return
        self._zoom = float(np.clip(self._zoom * ZOOM_STEP**by, LEAST_ZOOM, MOST_ZOOM))
        if self._zoom <= LEAST_ZOOM + 1e-6:
            self.set_area(None)
            return
        center = self.to_pixel(around) if around is not None else self.cursor_px
        if center is None:
            center = np.array([self.image.width() / 2, self.image.height() / 2])
        width, height = self.image.width() / self._zoom, self.image.height() / self._zoom
        share = np.array([0.5, 0.5])
        if around is not None:
            share = np.array([around.x() / max(self.width(), 1), around.y() / max(self.height(), 1)])
        self.set_area(QRectF(center[0] - share[0] * width, center[1] - share[1] * height, width, height))

    # --- input --------------------------------------------------------------------------------------------
    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self._keyed = False
        self.set_cursor(self.to_pixel(event.position()))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton or self.clicking is None or self.image is None:
            return
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        pixel = self.to_pixel(event.position())
        name = self.clicking.near(pixel, GRAB_PX / self.scale)
        self.set_cursor(pixel)
        if name:
            self._dragging = True
            self.grabbed.emit(name)
        else:
            self.clicked.emit(self.cursor_px)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if self._dragging:
            self._dragging = False
            self.clicked.emit(self.to_pixel(event.position()))

    def wheelEvent(self, event: QWheelEvent) -> None:
        self.zoom(1 if event.angleDelta().y() > 0 else -1, event.position())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = ARROWS.get(Qt.Key(event.key()))
        if step is None or self.image is None:
            super().keyPressEvent(event)
            return
        size = BIG_STEP_PX if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1.0
        start = self.cursor_px
        if start is None:
            start = np.array([self.image.width() / 2, self.image.height() / 2])
        self._keyed = True
        self.set_cursor(start + size * np.array(step))

    # --- painting -----------------------------------------------------------------------------------------
    def _ring_px(self, width_px: float) -> float:
        return max(RING_LEAST_PX, 0.75 * width_px * self.scale)

    def _paint_marks(self, painter: QPainter) -> None:
        clicking = self.clicking
        if clicking is None:
            return
        rings: list[tuple[str, QPointF, float]] = []
        for name, pixel in clicking.pixel.items():
            at = self.to_screen(*map(float, pixel))
            radius = self._ring_px(clicking.widths_px[name])
            wrong = name in self.wrong
            color = ON_PICTURE_WRONG if wrong else ON_PICTURE_LINE
            chosen = name == clicking.current and not clicking.missing
            width = 3.0 if wrong or chosen else 2.0
            haloed(painter, color, width, partial(painter.drawEllipse, at, radius, radius))
            haloed(painter, color, 1.5, partial(self._cross, painter, at, 5.0))
            rings.append((name, at, radius))
        self._paint_proposals(painter, clicking, rings)
        self._paint_spots(painter)
        if self.cursor_px is None:
            self._paint_names(painter, rings, "")
            return
        proposed = ""
        if self.found is not None and clicking.missing and not self._is_named(clicking):
            at = self.to_screen(*map(float, self.found.pixel))
            radius = self._ring_px(self.found.width_px) + 4
            haloed(painter, ON_PICTURE_PROPOSED, 2.5, lambda: painter.drawEllipse(at, radius, radius), dash=True)
            proposed = clicking.current
            rings.append((proposed, at, radius))
        self._paint_names(painter, rings, proposed)
        if self._keyed:
            at_cursor = self.to_screen(*map(float, self.cursor_px))
            haloed(painter, ON_PICTURE_PROPOSED, 1.5, lambda: self._cross(painter, at_cursor, 11.0))
        self._paint_loupe(painter)

    def _is_named(self, clicking: Clicking) -> bool:
        """Whether the disc under the cursor already has a name, of a person or proposed."""
        return self.found is not None and bool(clicking.near(self.found.pixel, 3.0))

    def _paint_proposals(self, painter: QPainter, clicking: Clicking, rings: list[tuple[str, QPointF, float]]) -> None:
        """Proposed names as dashed rings, each finger's discs joined: a wrong name shows as a crossing line."""
        at = {name: self.to_screen(*map(float, pixel)) for name, pixel in clicking.places.items()}
        painter.setPen(QPen(QColor(255, 255, 255, 170), 1.5))
        for ray in rays(clicking.protocol.markers) if clicking.protocol.has_fingers else ():
            known = [at[name] for name in ray if name in at]
            for a, b in pairwise(known):
                painter.drawLine(a, b)
        for name, one in clicking.proposed.items():
            radius = self._ring_px(one.width_px)
            color = ON_PICTURE_PROPOSED if one.is_sure else ON_PICTURE_DOUBTFUL
            width = 2.0 if one.is_sure else 3.0
            haloed(painter, color, width, lambda n=name, r=radius: painter.drawEllipse(at[n], r, r), dash=True)  # type: ignore[misc]
            rings.append((name, at[name], radius))

    def _paint_spots(self, painter: QPainter) -> None:
        """Spots in question: a dashed ring in amber and a question mark, never colour alone."""
        for pixel, name in self.spots:
            at, radius = self.to_screen(*map(float, pixel)), RING_LEAST_PX + 3.0
            haloed(painter, ON_PICTURE_DOUBTFUL, 3.0, lambda at=at, r=radius: painter.drawEllipse(at, r, r), dash=True)  # type: ignore[misc]
            words, plate = self._spot_words(name), self._spot_plate(pixel, name)
            painter.setFont(font(12 * self._theme.text_scale, SEMIBOLD))
            paint_label(painter, self._theme, words, plate.left(), plate.top())

    def _spot_words(self, name: str) -> str:
        return self.tr("{marker}?").format(marker=marker_name(name)) if name else self.tr("What is this?")

    def _spot_plate(self, pixel: Sequence[float], name: str) -> QRectF:
        at, away = self.to_screen(*map(float, pixel)), RING_LEAST_PX + 8.0
        metrics = QFontMetricsF(font(12 * self._theme.text_scale, SEMIBOLD))
        width = metrics.horizontalAdvance(self._spot_words(name)) + 12
        left = at.x() + away if at.x() + away + width < self.width() else at.x() - away - width
        return QRectF(left, at.y() - 10, width, metrics.height() + 5)

    def _words_for(self, name: str, clicking: Clicking) -> str:
        """The name on the picture; of many discs only the tips speak for their fingers, and what needs a look."""
        one = clicking.proposed.get(name)
        under_cursor = self.found is not None and clicking.near(self.found.pixel, 3.0) == name
        full = len(clicking.order) <= FEW or under_cursor or name in self.wrong or (one is not None and not one.is_sure)
        if full or name in ("WRIST", "CMC1") or (name == clicking.current and name not in clicking.proposed):
            words = marker_name(name)
            asked = one is not None and (len(clicking.order) <= FEW or not one.is_sure)
            return self.tr("{marker}?").format(marker=words) if asked else words
        return finger_name(name[-1]) if name.startswith("TIP") else ""

    def _cross(self, painter: QPainter, at: QPointF, arm: float) -> None:
        painter.drawLine(QPointF(at.x() - arm, at.y()), QPointF(at.x() + arm, at.y()))
        painter.drawLine(QPointF(at.x(), at.y() - arm), QPointF(at.x(), at.y() + arm))

    def name_plates(self, rings: Sequence[tuple[str, QPointF, float]], proposed: str) -> list[NamePlate]:
        """Each name beside its ring, clear of every disc, named or not, of the loupe, other names and their lines."""
        metrics = QFontMetricsF(font(12 * self._theme.text_scale, SEMIBOLD))
        named = [QRectF(at.x() - r, at.y() - r, 2 * r, 2 * r) for _, at, r in rings]
        bare = [self.to_screen(*map(float, pixel)) for pixel in self.discs_px]
        bare = [at for at in bare if not any(box.contains(at) for box in named)]
        ring = QPointF(RING_LEAST_PX, RING_LEAST_PX)
        free = [QRectF(at - ring, at + ring) for at in bare]
        taken = [*named, *free, QRectF(0, self.height() - 160, 176, 160)]
        taken += [self.loupe_box()] if self.cursor_px is not None else []
        taken += [self._spot_plate(pixel, name) for pixel, name in self.spots]
        assert self.clicking is not None
        out: list[NamePlate] = []
        for name, at, radius in rings:
            words = marker_name(name) if name == proposed else self._words_for(name, self.clicking)
            if not words:
                continue
            if name == proposed:
                words = self.tr("{marker}?").format(marker=words)
            wrong = name in self.wrong
            others = [other for one, other, _ in rings if one != name] + bare
            lines = [one.line for one in out if one.line is not None]
            inside = QRectF(self.rect()).adjusted(4, 4, -4, -4)
            for said in (words, self._short(name, words)):
                size = QSizeF(metrics.horizontalAdvance(said) + (30 if wrong else 12), metrics.height() + 5)
                found = place_for(size, at, radius, taken, others, inside, lines)
                if found is not None:  # a name over another, or at another's disc, says something wrong
                    taken.append(found[0])
                    out.append(NamePlate(name, said, *found))
                    break
        return out

    def _short(self, name: str, words: str) -> str:
        """The finger alone for a knuckle, where no more has room: of few discs each finger has one."""
        assert self.clicking is not None
        if len(self.clicking.order) > FEW or not name.startswith("MCP"):
            return words
        return words.replace(marker_name(name), finger_name(name[-1]))

    def _paint_names(self, painter: QPainter, rings: list[tuple[str, QPointF, float]], proposed: str) -> None:
        painter.setFont(font(12 * self._theme.text_scale, SEMIBOLD))
        for one in self.name_plates(rings, proposed):
            if one.line is not None:
                haloed(painter, ON_PICTURE_LINE, 1.5, partial(painter.drawLine, one.line))
            if one.name in self.wrong:
                paint_wrong_label(painter, self._theme, one.words, one.plate)
            else:
                paint_label(painter, self._theme, one.words, one.plate.left(), one.plate.top())

    def loupe_box(self) -> QRectF:
        """Where the loupe is: in the upper corner that covers fewer discs, never over the place one looks at."""
        size = min(LOUPE_PX * self._theme.text_scale, 0.3 * self.width())
        right, left = QRectF(self.width() - size - 14, 14, size, size), QRectF(14, 14, size, size)
        if self.clicking is not None and self._discs_in(left) < self._discs_in(right):
            right, left = left, right
        looked_at = self.cursor_px is not None and right.adjusted(-LABEL_ROOM_PX, -40, LABEL_ROOM_PX, 40).contains(
            self.to_screen(*map(float, self.cursor_px))
        )
        return left if looked_at else right

    def _discs_in(self, box: QRectF) -> int:
        assert self.clicking is not None
        return sum(box.contains(self.to_screen(*map(float, pixel))) for pixel in self.clicking.places.values())

    def _paint_loupe(self, painter: QPainter) -> None:
        assert self.cursor_px is not None
        assert self.image is not None
        box = self.loupe_box()
        center = self.found.pixel if self.found is not None else self.cursor_px
        span = box.width() / LOUPE_TIMES
        source = QRectF(center[0] + 0.5 - span / 2, center[1] + 0.5 - span / 2, span, span)
        painter.save()
        painter.setPen(QPen(QColor(ON_PICTURE_LABEL), 3))
        painter.setBrush(QColor(ON_PICTURE_LABEL))
        painter.drawRoundedRect(box, CARD_RADIUS_PX, CARD_RADIUS_PX)
        inner = box.adjusted(2, 2, -2, -2)
        painter.setClipRect(inner.toAlignedRect(), Qt.ClipOperation.IntersectClip)
        painter.drawImage(inner, self.image, source)
        middle = inner.center()
        if self.found is not None:
            radius = 0.5 * self.found.width_px * LOUPE_TIMES
            haloed(painter, ON_PICTURE_PROPOSED, 2.0, lambda: painter.drawEllipse(middle, radius, radius), dash=True)
        haloed(painter, ON_PICTURE_LINE, 1.5, lambda: self._cross(painter, middle, 12.0))
        painter.setClipping(False)
        paint_label(painter, self._theme, f"×{written(LOUPE_TIMES)}", inner.left() + 8, inner.top() + 8)
        words = self.no_marker_words
        if self.found is not None and not words:
            pattern = self.tr("Marker found · {width} px wide") if box.width() >= 200 else self.tr("Found · {width} px")
            words = pattern.format(width=written(self.found.width_px))
        if words:
            self._paint_loupe_words(painter, words, inner)
        painter.restore()

    def _paint_loupe_words(self, painter: QPainter, words: str, inner: QRectF) -> None:
        """At the foot of the loupe, within it, in as many lines as that takes."""
        room = inner.width() - 8.0
        lines: list[str] = []
        for word in words.split(" "):
            longer = f"{lines[-1]} {word}" if lines else word
            if lines and label_size(self._theme, longer).width() <= room:
                lines[-1] = longer
            else:
                lines.append(word)
        height = label_size(self._theme, words).height()
        top = inner.bottom() - 4 - height * len(lines)
        for line in lines:
            paint_label(painter, self._theme, line, inner.left() + 4, top)
            top += height

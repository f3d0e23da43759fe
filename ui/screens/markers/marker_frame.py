"""The frozen frame with labels: mouse or keyboard cursor, magnifier, rings and names."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF, QSizeF, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPen

from carpus.core.calibration.hand_calibrator import FoundMarker
from carpus.core.model.hand.protocols import CHAIN_NAMES
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import FloatArray
from carpus.ui.kit.theme import (
    CARD_RADIUS_PX,
    DARK,
    ON_PICTURE_LABEL,
    ON_PICTURE_LINE,
    ON_PICTURE_PROPOSED,
    ON_PICTURE_WRONG,
    Theme,
)  # fmt: skip
from carpus.ui.picture.label_placement import place_label
from carpus.ui.picture.overlay import draw_with_halo
from carpus.ui.picture.photo import label_size, paint_label, paint_wrong_label
from carpus.ui.picture.view import FrameView
from carpus.ui.screens.markers.labelling import LabelState
from carpus.ui.words.terms import finger_name, marker_title

LOUPE_PX, LOUPE_ZOOM = 204, 8.0
GRAB_PX = 12.0
LABEL_ROOM_PX = 150.0
"""Space for a label beside its marker, kept free by the magnifier."""
MIN_RING_PX = 12.0
ARROWS = {
    Qt.Key.Key_Left: (-1.0, 0.0), Qt.Key.Key_Right: (1.0, 0.0),
    Qt.Key.Key_Up: (0.0, -1.0), Qt.Key.Key_Down: (0.0, 1.0),
}  # fmt: skip
BIG_STEP_PX = 10.0
ON_PICTURE_DOUBTFUL = DARK.warn
MAX_FULL_LABELS = 6
"""Up to this many markers each show their name."""


class MarkerFrameView(FrameView):
    """Frame to label; emits ``cursor_moved`` and ``clicked`` with a pixel, ``label_grabbed`` with a marker."""

    cursor_moved = Signal(object)
    clicked = Signal(object)
    label_grabbed = Signal(str)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, (832, 624))
        self.labels: LabelState | None = None
        self.cursor_px: FloatArray | None = None
        self.found_marker: FoundMarker | None = None
        self.wrong_labels: Sequence[str] = ()
        self.questioned_blobs: list[tuple[tuple[float, ...], str]] = []
        """Spots (u, v) in question, each with its possible marker or an empty text."""
        self.blobs_px: FloatArray = np.empty((0, 2))
        """All candidates (D, 2), which labels must not cover."""
        self.no_marker_words = ""
        self._dragged = ""
        self._label_boxes: dict[str, QRectF] = {}
        self._is_keyboard_cursor = False
        self.overlay = lambda painter, _: self._paint_marks(painter)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setProperty("shows_own_focus", True)
        self.setAccessibleName(self.tr("Image to click the markers on"))

    def clear_cursor(self) -> None:
        """Remove the cursor, which belongs to another frame."""
        self.cursor_px = self.found_marker = None
        self.no_marker_words = ""

    def set_cursor(self, pixel: FloatArray) -> None:
        """Move the cursor to a pixel inside the frame."""
        if self.image is not None:
            limit = np.array([self.image.width() - 1.0, self.image.height() - 1.0])
            self.cursor_px = np.clip(np.asarray(pixel, dtype=np.float64), 0.0, limit)
            self.cursor_moved.emit(self.cursor_px)
            self.update()

    # --- input --------------------------------------------------------------------------------------------
    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self._is_keyboard_cursor = False
        self.set_cursor(self.to_pixel(event.position()))
        if not self._dragged:
            self._update_mouse_shape(event.position())

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton or self.labels is None or self.image is None:
            return
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        pixel = self.to_pixel(event.position())
        self._dragged = self._find_label(event.position())
        self.set_cursor(pixel)
        if self._dragged:
            self.setCursor(Qt.CursorShape.ClosedHandCursor)
            self.label_grabbed.emit(self._dragged)
        else:
            self.clicked.emit(self.cursor_px)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        name, self._dragged = self._dragged, ""
        box = self._label_boxes.get(name)
        if name and not (box is not None and box.contains(event.position())):  # a click on a label only selects it
            self.clicked.emit(self.to_pixel(event.position()))
        self._update_mouse_shape(event.position())
        self.update()

    def _find_label(self, point: QPointF) -> str:
        """Return the marker whose ring or label is at a widget position, empty for none."""
        if self.labels is None:
            return ""
        near = self.labels.find_near(self.to_pixel(point), GRAB_PX / self.scale)
        return near or next((name for name, box in self._label_boxes.items() if box.contains(point)), "")

    def _update_mouse_shape(self, point: QPointF) -> None:
        shape = Qt.CursorShape.OpenHandCursor if self._find_label(point) else Qt.CursorShape.ArrowCursor
        self.setCursor(shape)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        step = ARROWS.get(Qt.Key(event.key()))
        if step is None or self.image is None:
            super().keyPressEvent(event)
            return
        size = BIG_STEP_PX if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1.0
        start = self.cursor_px
        if start is None:
            start = np.array([self.image.width() / 2, self.image.height() / 2])
        self._is_keyboard_cursor = True
        self.set_cursor(start + size * np.array(step))

    # --- painting -----------------------------------------------------------------------------------------
    def _ring_px(self, width_px: float) -> float:
        return max(MIN_RING_PX, 0.75 * width_px * self.scale)

    def _paint_marks(self, painter: QPainter) -> None:
        clicking = self.labels
        if clicking is None:
            return
        rings: list[tuple[str, QPointF, float]] = []
        for name, pixel in clicking.confirmed_px.items():
            at = self.to_screen(*map(float, pixel))
            radius = self._ring_px(clicking.widths_px[name])
            wrong = name in self.wrong_labels
            color = ON_PICTURE_WRONG if wrong else ON_PICTURE_LINE
            chosen = name == clicking.current and not clicking.missing
            width = 3.0 if wrong or chosen else 2.0
            draw_with_halo(painter, color, width, partial(painter.drawEllipse, at, radius, radius))
            draw_with_halo(painter, color, 1.5, partial(self._paint_cross, painter, at, 5.0))
            rings.append((name, at, radius))
        self._paint_proposals(painter, clicking, rings)
        self._paint_questioned_blobs(painter)
        if self.cursor_px is None:
            self._paint_labels(painter, rings, "")
            return
        proposed = self._dragged
        if not proposed and self.found_marker is not None and clicking.missing and not self._is_labelled(clicking):
            proposed = clicking.current
        if proposed:
            found = self.found_marker
            at = self.to_screen(*map(float, self.cursor_px if found is None else found.pixel))
            radius = MIN_RING_PX if found is None else self._ring_px(found.width_px) + 4
            rings = [ring for ring in rings if ring[0] != proposed]
            if self._dragged and proposed in clicking.label_px:
                start = self.to_screen(*map(float, clicking.label_px[proposed]))
                draw_with_halo(painter, ON_PICTURE_PROPOSED, 2.0, lambda: painter.drawLine(start, at), dash=True)
            draw_with_halo(
                painter, ON_PICTURE_PROPOSED, 2.5, lambda: painter.drawEllipse(at, radius, radius), dash=True
            )
            rings.append((proposed, at, radius))
        self._paint_labels(painter, rings, proposed)
        if self._is_keyboard_cursor:
            at_cursor = self.to_screen(*map(float, self.cursor_px))
            draw_with_halo(painter, ON_PICTURE_PROPOSED, 1.5, lambda: self._paint_cross(painter, at_cursor, 11.0))
        self._paint_loupe(painter)

    def _is_labelled(self, labels: LabelState) -> bool:
        """Tell whether the marker under the cursor has a label."""
        return self.found_marker is not None and bool(labels.find_near(self.found_marker.pixel, 3.0))

    def _paint_proposals(self, painter: QPainter, labels: LabelState, rings: list[tuple[str, QPointF, float]]) -> None:
        """Paint proposals as dashed rings, joined by finger: a wrong label shows as a crossing line."""
        at = {name: self.to_screen(*map(float, pixel)) for name, pixel in labels.label_px.items()}
        painter.setPen(QPen(QColor(255, 255, 255, 170), 1.5))
        for chain in CHAIN_NAMES if labels.protocol.has_fingers else ():
            known = [at[name] for name in chain if name in at]
            for a, b in pairwise(known):
                painter.drawLine(a, b)
        for name, one in labels.proposals.items():
            radius = self._ring_px(one.width_px)
            color = ON_PICTURE_PROPOSED if one.is_sure else ON_PICTURE_DOUBTFUL
            width = 2.0 if one.is_sure else 3.0
            draw_with_halo(painter, color, width, lambda n=name, r=radius: painter.drawEllipse(at[n], r, r), dash=True)  # type: ignore[misc]
            rings.append((name, at[name], radius))

    def _paint_questioned_blobs(self, painter: QPainter) -> None:
        """Paint spots in question with a dashed ring and a question mark, never by colour alone."""
        for pixel, name in self.questioned_blobs:
            at, radius = self.to_screen(*map(float, pixel)), MIN_RING_PX + 3.0
            draw_with_halo(
                painter,
                ON_PICTURE_DOUBTFUL,
                3.0,
                lambda at=at, r=radius: painter.drawEllipse(at, r, r),  # type: ignore[misc]
                dash=True,
            )
            plate = self._question_plate(pixel, name)
            paint_label(painter, self._theme, self._question_words(name), plate.left(), plate.top())

    def _question_words(self, name: str) -> str:
        return self.tr("{marker}?").format(marker=marker_title(name)) if name else self.tr("What is this?")

    def _question_plate(self, pixel: Sequence[float], name: str) -> QRectF:
        at, away = self.to_screen(*map(float, pixel)), MIN_RING_PX + 8.0
        size = label_size(self._theme, self._question_words(name))
        left = at.x() + away if at.x() + away + size.width() < self.width() else at.x() - away - size.width()
        return QRectF(QPointF(left, at.y() - 10), size)

    def _label_words(self, name: str, labels: LabelState) -> str:
        """Return the text of a label; with many markers only of fingertips and doubtful ones."""
        one = labels.proposals.get(name)
        under_cursor = self.found_marker is not None and labels.find_near(self.found_marker.pixel, 3.0) == name
        full = (
            len(labels.protocol.markers) <= MAX_FULL_LABELS
            or under_cursor
            or name in self.wrong_labels
            or (one is not None and not one.is_sure)
        )
        if full or name in ("WRIST", "CMC1") or (name == labels.current and name not in labels.proposals):
            words = marker_title(name)
            asked = one is not None and (len(labels.protocol.markers) <= MAX_FULL_LABELS or not one.is_sure)
            return self.tr("{marker}?").format(marker=words) if asked else words
        return finger_name(name[-1]) if name.startswith("TIP") else ""

    def _paint_cross(self, painter: QPainter, at: QPointF, arm: float) -> None:
        painter.drawLine(QPointF(at.x() - arm, at.y()), QPointF(at.x() + arm, at.y()))
        painter.drawLine(QPointF(at.x(), at.y() - arm), QPointF(at.x(), at.y() + arm))

    def _paint_labels(self, painter: QPainter, rings: list[tuple[str, QPointF, float]], proposed: str) -> None:
        """Paint each label beside its ring, clear of all markers, the magnifier and other labels."""
        assert self.labels is not None
        named = [QRectF(at.x() - r, at.y() - r, 2 * r, 2 * r) for _, at, r in rings]
        bare = [self.to_screen(*map(float, pixel)) for pixel in self.blobs_px]
        bare = [at for at in bare if not any(box.contains(at) for box in named)]
        ring = QPointF(MIN_RING_PX, MIN_RING_PX)
        free = [QRectF(at - ring, at + ring) for at in bare]
        taken = [*named, *free, QRectF(0, self.height() - 160, 176, 160)]
        taken += [self.loupe_box()] if self.cursor_px is not None else []
        taken += [self._question_plate(pixel, name) for pixel, name in self.questioned_blobs]
        inside, lines = QRectF(self.rect()).adjusted(4, 4, -4, -4), list[QLineF]()
        boxes: dict[str, QRectF] = {}
        for name, at, radius in rings:
            words = marker_title(name) if name == proposed else self._label_words(name, self.labels)
            if not words:
                continue
            if name == proposed:
                words = self.tr("{marker}?").format(marker=words)
            wrong = name in self.wrong_labels
            others = [other for one, other, _ in rings if one != name] + bare
            for said in (words, self._shorten(name, words)):
                size = label_size(self._theme, said) + QSizeF(18.0 if wrong else 0.0, 0.0)
                found = place_label(size, at, radius, taken, others, inside, lines)
                if found is None:  # a name over another, or at another's disc, says something wrong
                    continue
                boxes[name], line = found
                taken.append(boxes[name])
                if line is not None:
                    lines.append(line)
                    draw_with_halo(painter, ON_PICTURE_LINE, 1.5, partial(painter.drawLine, line))
                if wrong:
                    paint_wrong_label(painter, self._theme, said, boxes[name])
                else:
                    paint_label(painter, self._theme, said, boxes[name].left(), boxes[name].top())
                break
        if not self._dragged:
            self._label_boxes = {name: box for name, box in boxes.items() if name in self.labels.label_px}

    def _shorten(self, name: str, words: str) -> str:
        """Return the finger alone for a knuckle, where there is no space for more."""
        assert self.labels is not None
        if len(self.labels.protocol.markers) > MAX_FULL_LABELS or not name.startswith("MCP"):
            return words
        return words.replace(marker_title(name), finger_name(name[-1]))

    def loupe_box(self) -> QRectF:
        """Return the place of the magnifier: the upper corner that covers fewer markers."""
        size = min(LOUPE_PX * self._theme.text_scale, 0.3 * self.width())
        right, left = QRectF(self.width() - size - 14, 14, size, size), QRectF(14, 14, size, size)
        if self.labels is not None and self._count_labels(left) < self._count_labels(right):
            right, left = left, right
        looked_at = self.cursor_px is not None and right.adjusted(-LABEL_ROOM_PX, -40, LABEL_ROOM_PX, 40).contains(
            self.to_screen(*map(float, self.cursor_px))
        )
        return left if looked_at else right

    def _count_labels(self, box: QRectF) -> int:
        assert self.labels is not None
        return sum(box.contains(self.to_screen(*map(float, pixel))) for pixel in self.labels.label_px.values())

    def _paint_loupe(self, painter: QPainter) -> None:
        assert self.cursor_px is not None
        assert self.image is not None
        box = self.loupe_box()
        center = self.found_marker.pixel if self.found_marker is not None else self.cursor_px
        span = box.width() / LOUPE_ZOOM
        source = QRectF(center[0] + 0.5 - span / 2, center[1] + 0.5 - span / 2, span, span)
        painter.save()
        painter.setPen(QPen(QColor(ON_PICTURE_LABEL), 3))
        painter.setBrush(QColor(ON_PICTURE_LABEL))
        painter.drawRoundedRect(box, CARD_RADIUS_PX, CARD_RADIUS_PX)
        inner = box.adjusted(2, 2, -2, -2)
        painter.setClipRect(inner.toAlignedRect(), Qt.ClipOperation.IntersectClip)
        painter.drawImage(inner, self.image, source)
        middle = inner.center()
        if self.found_marker is not None:
            radius = 0.5 * self.found_marker.width_px * LOUPE_ZOOM
            draw_with_halo(
                painter, ON_PICTURE_PROPOSED, 2.0, lambda: painter.drawEllipse(middle, radius, radius), dash=True
            )
        draw_with_halo(painter, ON_PICTURE_LINE, 1.5, lambda: self._paint_cross(painter, middle, 12.0))
        painter.setClipping(False)
        paint_label(painter, self._theme, f"×{format_rounded(LOUPE_ZOOM)}", inner.left() + 8, inner.top() + 8)
        words = self.no_marker_words
        if self.found_marker is not None and not words:
            pattern = self.tr("Marker found · {width} px wide") if box.width() >= 200 else self.tr("Found · {width} px")
            words = pattern.format(width=format_rounded(self.found_marker.width_px))
        if words:
            self._paint_loupe_words(painter, words, inner)
        painter.restore()

    def _paint_loupe_words(self, painter: QPainter, words: str, inner: QRectF) -> None:
        """Paint the text at the foot of the magnifier, in as many lines as needed."""
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

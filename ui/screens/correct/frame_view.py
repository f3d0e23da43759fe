"""Marker positions as tracked and as corrected, and the stored frame on which labels are dragged to markers."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QMouseEvent, QPainter, QPainterPath, QWheelEvent

from carpus.core.model.types import FloatArray
from carpus.core.session.label_checks import Correction, predict_marker_px
from carpus.core.session.values import Session
from carpus.ui.kit.fonts import SEMIBOLD, font
from carpus.ui.kit.theme import ON_PICTURE_LINE, ON_PICTURE_PROPOSED, ON_PICTURE_WRONG, Theme
from carpus.ui.picture.label_placement import place_label
from carpus.ui.picture.overlay import draw_with_halo
from carpus.ui.picture.photo import paint_label, paint_wrong_label
from carpus.ui.picture.session_frames import project_markers
from carpus.ui.picture.view import FrameView
from carpus.ui.words.terms import marker_title

SNAP_RADIUS_PX = 8.0
"""A position this near to a blob becomes its centre."""
MarkerPosition = tuple[float, float] | None


class MarkerEdits:
    """Corrections of one session, by row."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.markers = session.header.protocol.markers
        self._edits: dict[int, dict[str, MarkerPosition]] = {}
        self._undo_stack: list[tuple[int, dict[str, MarkerPosition]]] = []

    # --- positions --------------------------------------------------------------------------------------
    def original_px(self, row: int) -> FloatArray:
        """Return the tracked marker pixels (M, 2), NaN where not measured."""
        return np.asarray(self.session.markers.measured_px[row])

    def current_px(self, row: int) -> FloatArray:
        places = self.original_px(row).copy()
        for name, place in self._edits.get(row, {}).items():
            places[self.markers.index(name)] = np.nan if place is None else place
        return places

    def row_edits(self, row: int) -> Mapping[str, MarkerPosition]:
        return self._edits.get(row, {})

    def model_px(self, row: int) -> FloatArray:
        """Return the marker pixels (M, 2) of the hand model."""
        return project_markers(self.session.camera, self.session.markers.position_cam_m[row])

    def residual_mm(self, row: int, name: str, *, is_original: bool = False) -> float:
        """Return the distance of a marker from where the others expect it, in mm; NaN if unknown."""
        number = self.markers.index(name)
        places = self.current_px(row)
        expected = predict_marker_px(self.session, row, places, number)
        at = self.original_px(row)[number] if is_original else places[number]
        depth_m = self.session.markers.position_cam_m[row, :, 2]
        known = depth_m[np.isfinite(depth_m)]
        if not len(known) or not np.isfinite(at).all() or not np.isfinite(expected).all():
            return math.nan
        return 1000.0 * float(np.linalg.norm(at - expected)) * float(np.median(known)) / self.session.camera.fx_px

    def find_marker(self, row: int, pixel: FloatArray, reach_px: float) -> str:
        """Return the marker near a pixel, also an occluded one of the model; empty if none."""
        places = self.current_px(row)
        places = np.where(np.isfinite(places), places, self.model_px(row))
        distance = np.linalg.norm(places - pixel, axis=1)
        if not np.isfinite(distance).any() or np.nanmin(distance) > reach_px:
            return ""
        return self.markers[int(np.nanargmin(distance))]

    # --- changes -------------------------------------------------------------------------------------------
    def place_marker(self, row: int, name: str, pixel: FloatArray, blob_px: FloatArray) -> None:
        """Move a marker to a pixel, snapped to a blob of ``blob_px`` (S, 2).

        A marker that is already there changes places with it.
        """
        at = np.asarray(pixel, dtype=float)
        if len(blob_px):
            distance = np.linalg.norm(blob_px - at, axis=1)
            if distance.min() <= SNAP_RADIUS_PX:
                at = blob_px[int(distance.argmin())]
        places, number = self.current_px(row), self.markers.index(name)
        taken = np.linalg.norm(places - at, axis=1)
        taken[number] = np.inf
        other = int(np.nanargmin(taken)) if np.isfinite(taken).any() else -1
        self._push_undo(row)
        row_edits = self._edits.setdefault(row, {})
        if other >= 0 and taken[other] <= SNAP_RADIUS_PX:
            old = places[number]
            row_edits[self.markers[other]] = (float(old[0]), float(old[1])) if np.isfinite(old).all() else None
        row_edits[name] = (float(at[0]), float(at[1]))

    def hide_marker(self, row: int, name: str) -> None:
        self._push_undo(row)
        self._edits.setdefault(row, {})[name] = None

    def undo(self) -> int:
        """Undo the last step; return its row, -1 if there is none."""
        if not self._undo_stack:
            return -1
        row, before = self._undo_stack.pop()
        if before:
            self._edits[row] = before
        else:
            self._edits.pop(row, None)
        return row

    def _push_undo(self, row: int) -> None:
        self._undo_stack.append((row, dict(self._edits.get(row, {}))))

    def corrections(self) -> tuple[Correction, ...]:
        return tuple(Correction(row, dict(places)) for row, places in sorted(self._edits.items()) if places)


GRAB_RADIUS_PX, RING_RADIUS_PX = 18.0, 13.0
LOUPE_PX, LOUPE_FACTOR = 190, 8.0
MAX_ALWAYS_LABELLED = 6
"""Up to this many markers are all labelled; of more only selected and changed ones."""


class CorrectionFrameView(FrameView):
    """Frame with draggable labels.

    Signals: ``marker_moved`` with a marker and its pixel, ``marker_selected`` with a marker, ``empty_clicked`` with a
    pixel away from all labels.
    """

    marker_moved = Signal(str, object)
    marker_selected = Signal(str)
    empty_clicked = Signal(object)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, (832, 452))
        self.edits: MarkerEdits | None = None
        self.blob_px: FloatArray = np.empty((0, 2))
        self.row = -1
        self.current_marker = ""
        self.has_frame = False
        self.headings: list[str] = []
        self._dragged = ""
        self._cursor_px: FloatArray | None = None
        self._pressed_px: FloatArray = np.full(2, np.nan)
        self.label_boxes: dict[str, QRectF] = {}
        self.overlay = lambda painter, _: self._paint_marks(painter)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(self.tr("Frame with labels to correct"))

    def show_edits(self, edits: MarkerEdits, row: int, blob_px: FloatArray, *, has_frame: bool) -> None:
        """Show the labels of a row; its frame was shown before."""
        self.edits, self.row, self.blob_px, self.has_frame = edits, row, blob_px, has_frame
        self.update()

    def cancel_drag(self) -> bool:
        """Cancel a drag; return whether there was one."""
        was, self._dragged = self._dragged, ""
        self.update()
        return bool(was)

    # --- input --------------------------------------------------------------------------------------------
    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton or self.edits is None or self.image is None:
            return
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        pixel = self.to_pixel(event.position())
        name = self._find_label(event.position())
        self._cursor_px = self._pressed_px = pixel
        if name:
            self._dragged = name
            self.marker_selected.emit(name)
        else:
            self.empty_clicked.emit(pixel)
        self.update()

    def _find_label(self, point: QPointF) -> str:
        """Return the marker whose ring or label is at a widget position, empty for none."""
        if self.edits is None or self.row < 0:
            return ""
        near = self.edits.find_marker(self.row, self.to_pixel(point), GRAB_RADIUS_PX / self.scale)
        return near or next((name for name, plate in self.label_boxes.items() if plate.contains(point)), "")

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self._cursor_px = self.to_pixel(event.position())
        is_over = not self._dragged and self._find_label(event.position())
        shapes = Qt.CursorShape
        self.setCursor(
            shapes.ClosedHandCursor if self._dragged else shapes.OpenHandCursor if is_over else shapes.ArrowCursor
        )
        self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        name, self._dragged = self._dragged, ""
        if name and self.edits is not None:
            pixel = self.to_pixel(event.position())
            start = self.edits.current_px(self.row)[self.edits.markers.index(name)]
            least = GRAB_RADIUS_PX / 2 / self.scale
            is_placed, is_moved = bool(np.isfinite(start).all()), np.linalg.norm(pixel - self._pressed_px) > least
            if is_placed:
                is_put = bool(is_moved and np.linalg.norm(pixel - start) > least)
            else:  # shown where the model has it: a click on a spot there puts it on that
                is_put = bool(is_moved or self._find_blob(pixel) is not None)
            if is_put:
                self.marker_moved.emit(name, pixel)
        self.update()

    def leaveEvent(self, event) -> None:  # type: ignore[no-untyped-def]
        if not self._dragged:
            self._cursor_px = None
            self.update()

    def wheelEvent(self, event: QWheelEvent) -> None:
        self.set_whole(event.angleDelta().y() < 0)

    # --- painting -----------------------------------------------------------------------------------------
    def _paint_marks(self, painter: QPainter) -> None:
        places = self.edits
        if places is None or self.row < 0:
            return
        before, now, changed = places.original_px(self.row), places.current_px(self.row), places.row_edits(self.row)
        self._paint_blobs(painter, now)
        taken: list[QRectF] = [QRectF(0, 0, 330, 30 + 26 * len(self.headings))]
        modelled = places.model_px(self.row)
        rings = []
        self.label_boxes = {}
        for number, name in enumerate(places.markers):
            seen = np.isfinite(now[number]).all()
            at = now[number] if seen else modelled[number]
            if not np.isfinite(at).all() or name == self._dragged:
                continue
            point = self.to_screen(*map(float, at))
            color = ON_PICTURE_PROPOSED if name in changed else ON_PICTURE_LINE
            width = 3.0 if name == self.current_marker else 2.0
            ring = lambda point=point: painter.drawEllipse(point, RING_RADIUS_PX, RING_RADIUS_PX)  # noqa: E731
            draw_with_halo(painter, color, width, ring, dash=not seen or name in changed)
            taken.append(
                QRectF(point.x() - RING_RADIUS_PX, point.y() - RING_RADIUS_PX, 2 * RING_RADIUS_PX, 2 * RING_RADIUS_PX)
            )
            rings.append((name, point))
        for name in changed:
            old = before[places.markers.index(name)]
            if np.isfinite(old).all() and not self._is_occupied(now, old):
                point = self.to_screen(*map(float, old))
                draw_with_halo(
                    painter,
                    ON_PICTURE_WRONG,
                    2.5,
                    lambda p=point: painter.drawEllipse(p, RING_RADIUS_PX, RING_RADIUS_PX),  # type: ignore[misc]
                )
                words = self.tr("{marker}, before").format(marker=marker_title(name))
                self._paint_label(painter, words, point, taken, wrong=True)
        for name, point in rings:
            if len(places.markers) <= MAX_ALWAYS_LABELLED or name in changed or name == self.current_marker:
                words = marker_title(name)
                hidden = not np.isfinite(now[places.markers.index(name)]).all()
                words = self.tr("{marker}, occluded").format(marker=words) if hidden else words
                others = [other for one, other in rings if one != name]
                plate = self._paint_label(painter, words, point, taken, others)
                if plate is not None:
                    self.label_boxes[name] = plate
        top = 12.0
        for words in self.headings:
            top = paint_label(painter, self._theme, words, 12, top).bottom() + 4
        if self._dragged and self._cursor_px is not None:
            self._paint_drag(painter, now)

    def _find_blob(self, pixel: FloatArray) -> FloatArray | None:
        """Return the blob within reach of the pointer."""
        if not len(self.blob_px):
            return None
        distance = np.linalg.norm(self.blob_px - pixel, axis=1)
        return self.blob_px[int(distance.argmin())] if distance.min() <= GRAB_RADIUS_PX / self.scale else None

    def _is_occupied(self, now: FloatArray, place: FloatArray) -> bool:
        distance = np.linalg.norm(now - place, axis=1)
        return bool(np.isfinite(distance).any()) and float(np.nanmin(distance)) < 3.0

    def _paint_blobs(self, painter: QPainter, now: FloatArray) -> None:
        """Draw blobs without a label; without a frame all of them, filled."""
        for spot in self.blob_px:
            point = self.to_screen(*map(float, spot))
            if not self.has_frame:
                painter.setPen(Qt.PenStyle.NoPen)
                painter.setBrush(QColor("#3A5FC8"))
                painter.drawEllipse(point, 7, 7)
                painter.setBrush(Qt.BrushStyle.NoBrush)
            if not self._is_occupied(now, spot):
                draw_with_halo(painter, ON_PICTURE_LINE, 1.5, lambda p=point: painter.drawEllipse(p, 9, 9), dash=True)  # type: ignore[misc]

    def _paint_drag(self, painter: QPainter, now: FloatArray) -> None:
        assert self._cursor_px is not None
        assert self.edits is not None
        spot = self._find_blob(self._cursor_px)
        at = self._cursor_px if spot is None else spot
        point = self.to_screen(*map(float, at))
        start = now[self.edits.markers.index(self._dragged)]
        if np.isfinite(start).all():
            begin = self.to_screen(*map(float, start))
            draw_with_halo(painter, ON_PICTURE_PROPOSED, 2.0, lambda: painter.drawLine(begin, point), dash=True)
        draw_with_halo(
            painter,
            ON_PICTURE_PROPOSED,
            3.0,
            lambda: painter.drawEllipse(point, RING_RADIUS_PX, RING_RADIUS_PX),
            dash=True,
        )
        self._paint_loupe(painter, at)
        self._paint_label(painter, self.tr("{marker}?").format(marker=marker_title(self._dragged)), point, [])

    def _paint_loupe(self, painter: QPainter, at: FloatArray) -> None:
        image = self.image
        if image is None or not self.has_frame:
            return
        size = LOUPE_PX * self._theme.text_scale
        left = self.width() - size - 14
        point = self.to_screen(*map(float, at))
        if point.x() > left - 60 and point.y() < size + 80:
            left = 14.0
        box = QRectF(left, 14, size, size)
        half = size / LOUPE_FACTOR / 2
        painter.save()
        frame = QPainterPath()
        frame.addRoundedRect(box, 8, 8)
        painter.setClipPath(frame)
        painter.drawImage(box, image, QRectF(at[0] + 0.5 - half, at[1] + 0.5 - half, 2 * half, 2 * half))
        middle = box.center()
        for a, b in ((QPointF(12, 0), QPointF(-12, 0)), (QPointF(0, 12), QPointF(0, -12))):
            draw_with_halo(painter, ON_PICTURE_PROPOSED, 2.0, lambda a=a, b=b: painter.drawLine(middle + a, middle + b))  # type: ignore[misc]
        painter.restore()
        draw_with_halo(painter, ON_PICTURE_LINE, 2.5, lambda: painter.drawRoundedRect(box, 8, 8))
        paint_label(painter, self._theme, "×8", box.left() + 8, box.bottom() - 28 * self._theme.text_scale)

    def _paint_label(
        self,
        painter: QPainter,
        words: str,
        at: QPointF,
        taken: list[QRectF],
        others: Sequence[QPointF] = (),
        *,
        wrong: bool = False,
    ) -> QRectF | None:
        """Draw a label next to its ring, or farther away with a line; return its box, None without room."""
        painter.setFont(font(12 * self._theme.text_scale, SEMIBOLD))
        metrics = QFontMetricsF(painter.font())
        size = QSizeF(metrics.horizontalAdvance(words) + (30 if wrong else 12), metrics.height() + 5)
        inside = QRectF(self.rect()).adjusted(4, 4, -4, -4)
        found = place_label(size, at, RING_RADIUS_PX, taken, others, inside)
        if found is None:
            return None  # the list beside says it; two names over each other say nothing
        plate, line = found
        taken.append(plate)
        if line is not None:
            draw_with_halo(painter, ON_PICTURE_LINE, 1.5, lambda: painter.drawLine(line))
        if wrong:
            paint_wrong_label(painter, self._theme, words, plate)
        else:
            paint_label(painter, self._theme, words, plate.left(), plate.top())
        return plate

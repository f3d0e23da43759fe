"""The stored pictures of a session under its discs: seen solid, unseen dashed, and the way of the fingertips."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Generic, TypeVar

import numpy as np
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QColor, QPainter

from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import BoolArray, ByteImage, FloatArray
from carpus.core.session.values import Session
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import ON_PICTURE_LINE, Theme
from carpus.ui.picture.overlay import draw_with_halo
from carpus.ui.picture.view import FrameView

BLANK_GREY = 34
"""Grey under the marks where no pictures were kept."""
Found = TypeVar("Found")


class RowReader(Generic[Found]):
    """Reads rows of a session in the background, one at a time: the newest wish follows when one has come. After a
    fault no more is read of that session: it would fail again with each row."""

    def __init__(
        self,
        background: Background,
        owner: QObject,
        read: Callable[[str, int], Found],
        on_read: Callable[[int, Found], None],
        on_failed: Callable[[Exception], None],
    ) -> None:
        self._background, self._owner = background, owner
        self._read_row, self._on_read, self._on_failed = read, on_read, on_failed
        self._session_id, self._requested_row, self._session_number = "", -1, 0
        self.is_busy = False

    def set_session(self, session_id: str) -> None:
        """Another session; what still comes of the one before is for nobody."""
        self._session_id, self._requested_row, self.is_busy = session_id, -1, False
        self._session_number += 1

    def request(self, row: int) -> None:
        self._requested_row = row
        if not self.is_busy:
            self._read()

    def _read(self) -> None:
        self.is_busy = True
        session_id, row, number = self._session_id, self._requested_row, self._session_number

        def handle_row(found: Found) -> None:
            if number == self._session_number:
                self.is_busy = False
                self._on_read(row, found)
                if self._requested_row != row and not self.is_busy:
                    self._read()

        def handle_fault(fault: Exception) -> None:
            if number == self._session_number:
                self._on_failed(fault)

        self._background.run(lambda: self._read_row(session_id, row), handle_row, handle_fault, self._owner)


def blank_frame(camera: Camera) -> ByteImage:
    """In place of a picture that was not kept."""
    return np.full((camera.height_px, camera.width_px, 3), BLANK_GREY, np.uint8)


class SessionFrameView(FrameView):
    """Shows a row of a session; ``failed`` carries a fault of reading it."""

    read_failed = Signal(object)

    def __init__(
        self,
        theme: Theme,
        hint_px: tuple[int, int],
        background: Background,
        read: Callable[[str, int], ByteImage | None],
    ) -> None:
        super().__init__(theme, hint_px)
        self.session: Session | None = None
        self.row = -1
        self.reader = RowReader(
            background, self, read, lambda _, picture: self.show_stored_frame(picture), self.read_failed.emit
        )

    def set_session(self, session: Session | None, words: str = "") -> None:
        """Another session; None while it is read, with what is said meanwhile."""
        self.session, self.row = session, -1
        self.reader.set_session("" if session is None else session.header.session_id)
        self.clear(words)

    def show_row(self, row: int) -> None:
        """The marks of a row, at once; its picture follows."""
        if row != self.row:
            self.row = row
            self.update()
            if row >= 0:
                self.reader.request(row)

    def show_stored_frame(self, picture: ByteImage | None) -> None:
        """A picture that was read; None where none was kept."""
        if picture is not None:
            self.show_frame(picture)
        elif self.image is None and self.session is not None:
            self.show_frame(blank_frame(self.session.camera))

    def marker_pixels(self, session: Session) -> tuple[FloatArray, BoolArray]:
        """Where the discs of the row (M, 2) are, as measured or as the model has them; which (M,) were seen."""
        measured = session.markers.measured_px[self.row]
        seen = np.isfinite(measured[:, 0])
        modelled = project_markers(session.camera, session.markers.position_cam_m[self.row])
        return np.where(seen[:, None], measured, modelled), seen

    def paint_markers(
        self, painter: QPainter, session: Session, spots: FloatArray, seen: BoolArray, finger: int = 0
    ) -> None:
        """Bones and discs of the whole hand, ``finger`` 0 for all, or the discs about the wrist."""
        if session.header.joint_names:
            paint_skeleton(painter, self, session.header.protocol, spots, seen, finger)
        else:
            paint_palm(painter, self, spots, seen)


def project_markers(camera: Camera, position_cam_m: FloatArray) -> FloatArray:
    """Where the model has the markers (..., 2) in the picture; NaN while lost."""
    known = np.isfinite(position_cam_m).all(axis=-1)
    out = np.full((*position_cam_m.shape[:-1], 2), np.nan)
    if known.any():
        out[known] = camera.distort(camera.project(position_cam_m[known]))
    return out


def paint_palm(painter: QPainter, picture: FrameView, spots: FloatArray, seen: np.ndarray) -> None:
    """Lines from the wrist to the palm, and a ring about each disc; ``spots`` (M, 2) pixels, ``seen`` bool (M,)."""
    if np.isfinite(spots).all():
        wrist = picture.to_screen(*map(float, spots[0]))
        for u, v in spots[1:6]:
            end = picture.to_screen(float(u), float(v))
            draw_with_halo(painter, ON_PICTURE_LINE, 2.0, lambda end=end: painter.drawLine(wrist, end))  # type: ignore[misc]
    for spot, is_seen in zip(spots, seen, strict=True):
        if np.isfinite(spot).all():
            at = picture.to_screen(*map(float, spot))
            draw_with_halo(
                painter,
                ON_PICTURE_LINE,
                2.0,
                lambda at=at: painter.drawEllipse(at, 10, 10),  # type: ignore[misc]
                dash=not is_seen,
            )
            if is_seen:
                painter.setBrush(QColor(ON_PICTURE_LINE))
                painter.drawEllipse(at, 2.5, 2.5)


def paint_skeleton(
    painter: QPainter,
    picture: FrameView,
    protocol: MarkerProtocol,
    spots: FloatArray,
    seen: np.ndarray,
    finger: int = 0,
) -> None:
    """Bones and discs; ``spots`` (M, 2) pixels, ``seen`` bool (M,), ``finger`` 0 for all."""
    for number, chain in protocol.chains.items():
        for a, b in pairwise(chain):
            if np.isfinite(spots[[a, b]]).all():
                start, end = (picture.to_screen(float(u), float(v)) for u, v in spots[[a, b]])
                width = 2.5 if number == finger else 1.5
                line = lambda start=start, end=end: painter.drawLine(start, end)  # noqa: E731
                draw_with_halo(painter, ON_PICTURE_LINE, width, line, dash=not (seen[a] and seen[b]))
    for spot, is_seen in zip(spots, seen, strict=True):
        if np.isfinite(spot).all():
            at = picture.to_screen(float(spot[0]), float(spot[1]))
            ring = lambda at=at: painter.drawEllipse(at, 5.5, 5.5)  # noqa: E731
            draw_with_halo(painter, ON_PICTURE_LINE, 1.5, ring, dash=not is_seen)
            if is_seen:
                painter.setBrush(QColor(ON_PICTURE_LINE))
                painter.drawEllipse(at, 1.8, 1.8)


def paint_trails(
    painter: QPainter,
    picture: FrameView,
    protocol: MarkerProtocol,
    modelled: FloatArray,
    seen: np.ndarray,
    finger: int = 0,
) -> None:
    """Ways of the fingertips, no bones: dotted, and the fainter the longer ago; ``modelled`` (n, M, 2) pixels of the
    frames shown, ``seen`` bool (n, M)."""
    tips = [chain[-1] for number, chain in protocol.chains.items() if finger in (0, number)]
    shown = np.argwhere(seen[:, tips] & np.isfinite(modelled[:, tips]).all(axis=-1))

    def dots() -> None:
        for number, tip in shown:
            painter.setOpacity((number + 1) / len(modelled))
            painter.drawPoint(picture.to_screen(*map(float, modelled[number, tips[tip]])))

    draw_with_halo(painter, ON_PICTURE_LINE, 2.2, dots)  # all halos first: none lies on a dot
    painter.setOpacity(1.0)

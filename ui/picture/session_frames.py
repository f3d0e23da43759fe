"""Stored frames of a session with its markers: visible solid, occluded dashed; fingertip paths."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
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
"""Background where no video was saved."""
Found = TypeVar("Found")


class RowReader(Generic[Found]):
    """Reads rows of a session in the background, one at a time; the latest request follows.

    After a fault nothing more is read of the session: it would fail again with each row.
    """

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
        """Set another session; results of the one before are dropped."""
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
    """Return a grey image in place of a frame that was not saved."""
    return np.full((camera.height_px, camera.width_px, 3), BLANK_GREY, np.uint8)


class SessionFrameView(FrameView):
    """Shows a row of a session."""

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
        """Set the session; None while it is read, with a text."""
        self.session, self.row = session, -1
        self.reader.set_session("" if session is None else session.header.session_id)
        self.clear(words)

    def show_row(self, row: int) -> None:
        """Show the markers of a row at once; its frame follows."""
        if row != self.row:
            self.row = row
            self.update()
            if row >= 0:
                self.reader.request(row)

    def show_stored_frame(self, picture: ByteImage | None) -> None:
        """Show a frame that was read, None if none was saved."""
        if picture is not None:
            self.show_frame(picture)
        elif self.image is None and self.session is not None:
            self.show_frame(blank_frame(self.session.camera))

    def marker_pixels(self, session: Session) -> tuple[FloatArray, BoolArray]:
        """Return the markers (M, 2) of the row, measured or modelled, and which (M,) were visible."""
        measured = session.markers.measured_px[self.row]
        seen = np.isfinite(measured[:, 0])
        modelled = project_markers(session.camera, session.markers.position_cam_m[self.row])
        return np.where(seen[:, None], measured, modelled), seen

    def paint_markers(
        self, painter: QPainter, session: Session, spots: FloatArray, seen: BoolArray, finger: int = 0
    ) -> None:
        """Paint markers and bones of the hand, of one finger (0 for all), or lines from the wrist over the palm.

        ``spots`` (M, 2) are pixels, ``seen`` (M,) tells which were visible.
        """
        is_hand = bool(session.header.joint_names)
        bones = [(0, palm, 2.0) for palm in range(1, 6)] if np.isfinite(spots).all() else []
        radius, width, dot = 10.0, 2.0, 2.5
        if is_hand:
            chains, (radius, width, dot) = session.header.protocol.chains, (5.5, 1.5, 1.8)
            bones = [(*ends, 2.5 if number == finger else 1.5) for number, chain in chains.items()
                     for ends in pairwise(chain) if np.isfinite(spots[[*ends]]).all()]  # fmt: skip
        at = [self.to_screen(float(u), float(v)) for u, v in spots]
        for a, b, wide in bones:
            is_dashed = is_hand and not (seen[a] and seen[b])
            draw_with_halo(painter, ON_PICTURE_LINE, wide, partial(painter.drawLine, at[a], at[b]), is_dashed)
        for place, spot, is_seen in zip(at, spots, seen, strict=True):
            if np.isfinite(spot).all():
                ring = partial(painter.drawEllipse, place, radius, radius)
                draw_with_halo(painter, ON_PICTURE_LINE, width, ring, dash=not is_seen)
                if is_seen:
                    painter.setBrush(QColor(ON_PICTURE_LINE))
                    painter.drawEllipse(place, dot, dot)


def project_markers(camera: Camera, position_cam_m: FloatArray) -> FloatArray:
    """Return the pixels of modelled markers (..., 2); NaN while lost."""
    known = np.isfinite(position_cam_m).all(axis=-1)
    out = np.full((*position_cam_m.shape[:-1], 2), np.nan)
    if known.any():
        out[known] = camera.distort(camera.project(position_cam_m[known]))
    return out


def paint_trails(
    painter: QPainter,
    picture: FrameView,
    protocol: MarkerProtocol,
    modelled: FloatArray,
    seen: np.ndarray,
    finger: int = 0,
) -> None:
    """Paint the fingertip paths, fading with time.

    ``modelled`` (n, M, 2) are pixels of the last frames, ``seen`` (n, M) tells which were visible.
    """
    tips = [chain[-1] for number, chain in protocol.chains.items() if finger in (0, number)]
    shown = np.argwhere(seen[:, tips] & np.isfinite(modelled[:, tips]).all(axis=-1))

    def dots() -> None:
        for number, tip in shown:
            painter.setOpacity((number + 1) / len(modelled))
            painter.drawPoint(picture.to_screen(*map(float, modelled[number, tips[tip]])))

    draw_with_halo(painter, ON_PICTURE_LINE, 2.2, dots)  # all halos first: none lies on a dot
    painter.setOpacity(1.0)

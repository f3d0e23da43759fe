"""The stored pictures of a session under the marks of its discs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar

import numpy as np
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QPainter

from carpus.core.camera import Camera
from carpus.core.session.values import Session
from carpus.core.types import BoolArray, ByteImage, FloatArray
from carpus.ui.background import Background
from carpus.ui.picture.view import PictureView
from carpus.ui.playback.skeleton import modelled_px, paint_palm, paint_skeleton
from carpus.ui.theme import Theme

GROUND = 34
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
        shown: Callable[[int, Found], None],
        failed: Callable[[Exception], None],
    ) -> None:
        self._background, self._owner = background, owner
        self._read_row, self._shown, self._failed = read, shown, failed
        self._session_id, self._wanted, self._round = "", -1, 0
        self.busy = False

    def begin(self, session_id: str) -> None:
        """Another session; what still comes of the one before is for nobody."""
        self._session_id, self._wanted, self.busy = session_id, -1, False
        self._round += 1

    def ask(self, row: int) -> None:
        self._wanted = row
        if not self.busy:
            self._read()

    def _read(self) -> None:
        self.busy = True
        session_id, row, number = self._session_id, self._wanted, self._round

        def came(found: Found) -> None:
            if number == self._round:
                self.busy = False
                self._shown(row, found)
                if self._wanted != row and not self.busy:
                    self._read()

        def failed(fault: Exception) -> None:
            if number == self._round:
                self._failed(fault)

        self._background.run(lambda: self._read_row(session_id, row), came, failed, self._owner)


def plain_ground(camera: Camera) -> ByteImage:
    """In place of a picture that was not kept."""
    return np.full((camera.height_px, camera.width_px, 3), GROUND, np.uint8)


class SessionPicture(PictureView):
    """Shows a row of a session; ``failed`` carries a fault of reading it."""

    failed = Signal(object)

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
        self.reader = RowReader(background, self, read, lambda _, picture: self.show_stored(picture), self.failed.emit)

    def open(self, session: Session | None, words: str = "") -> None:
        """Another session; None while it is read, with what is said meanwhile."""
        self.session, self.row = session, -1
        self.reader.begin("" if session is None else session.header.session_id)
        self.clear(words)

    def show_row(self, row: int) -> None:
        """The marks of a row, at once; its picture follows."""
        if row != self.row:
            self.row = row
            self.update()
            if row >= 0:
                self.reader.ask(row)

    def show_stored(self, picture: ByteImage | None) -> None:
        """A picture that was read; None where none was kept."""
        if picture is not None:
            self.show_frame(picture)
        elif self.image is None and self.session is not None:
            self.show_frame(plain_ground(self.session.camera))

    def spots_px(self, session: Session) -> tuple[FloatArray, BoolArray]:
        """Where the discs of the row (M, 2) are, as measured or as the model has them; which (M,) were seen."""
        measured = session.markers.measured_px[self.row]
        seen = np.isfinite(measured[:, 0])
        modelled = modelled_px(session.camera, session.markers.position_cam_m[self.row])
        return np.where(seen[:, None], measured, modelled), seen

    def paint_discs(
        self, painter: QPainter, session: Session, spots: FloatArray, seen: BoolArray, finger: int = 0
    ) -> None:
        """Bones and discs of the whole hand, ``finger`` 0 for all, or the discs about the wrist."""
        if session.header.joint_names:
            paint_skeleton(painter, self, session.header.protocol, spots, seen, finger)
        else:
            paint_palm(painter, self, spots, seen)

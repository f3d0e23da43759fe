"""A camera open for calibrating or checking: its pictures, and who looks at them beside the window's thread."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer, Signal

from carpus.core.capture.source import FrameSource, Notice, SourceInfo
from carpus.core.errors import CameraLost, CarpusFault
from carpus.core.pipeline.live import LiveSession
from carpus.core.types import Frame
from carpus.ui.background import Background

log = logging.getLogger(__name__)

PULL_EVERY_MS = 66
_LOOK_AGAIN_S = 0.02
Look = Callable[[Frame], None]


class CameraAtHand(QObject):
    """Opens a source, looks at its pictures in a thread of its own, and lets it go; one at a time.

    ``opened`` carries the :class:`SourceInfo`, ``failed`` a fault after which the camera is let go, ``pulled`` the
    newest frame for the screen, ``lost`` a fault while the camera is away.
    """

    opened = Signal(object)
    failed = Signal(object)
    pulled = Signal(object)
    lost = Signal(object)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._background = Background()
        self._session: LiveSession | None = None
        self._made: list[LiveSession] = []
        self._looking: threading.Thread | None = None
        self._ending = threading.Event()
        self._fault: Exception | None = None
        self._number, self._shown = 0, -1
        self._timer = QTimer(self)
        self._timer.setInterval(PULL_EVERY_MS)
        self._timer.timeout.connect(self._pull)

    @property
    def is_open(self) -> bool:
        """Whether a camera is open, or being opened."""
        return self._session is not None or self._number > 0

    def open(self, source: Callable[[Notice], FrameSource], looker: Callable[[SourceInfo], Look]) -> None:
        """Open what ``source`` gives, which tells by its notice when the camera is away, and have every newest picture
        looked at by what ``looker`` gives."""
        self.close()
        self._number = abs(self._number) + 1
        number = self._number

        def make() -> None:
            told: list[CarpusFault] = []
            heard: list[Notice] = [told.append]  # until there is a session to be told
            session = LiveSession(source(lambda fault: heard[-1](fault)))
            heard.append(session.notice)
            self._made.append(session)
            session.start()

        def opened(_: object) -> None:
            session = self._made.pop(0)
            if number != self._number:
                self._background.run(session.stop, lambda _: None, lambda _: None)
                return
            self._session, self._fault, self._shown = session, None, -1
            self._ending = threading.Event()
            self._looking = threading.Thread(
                target=self._look, args=(session, looker(session.info), self._ending), name="looking at the camera"
            )
            self._looking.start()
            self._timer.start()
            self.opened.emit(session.info)

        def failed(fault: Exception) -> None:
            if number == self._number:
                self._number = -number
                self.failed.emit(fault)

        self._background.run(make, opened, failed)

    def close(self) -> None:
        """Let the camera go, or do not wait for it any more; may be called at any time."""
        self._number = -abs(self._number)
        session, thread = self._session, self._looking
        self._session = self._looking = None
        self._timer.stop()
        self._ending.set()
        if session is not None:
            self._background.run(lambda: _ended(session, thread), lambda _: None, lambda _: None)

    def wait(self) -> None:
        """The window closes: wait until it is let go. What was still being opened is closed as well."""
        self.close()
        self._background.wait()
        while self._made:
            self._made.pop().stop()

    def _look(self, session: LiveSession, look: Look, ending: threading.Event) -> None:
        newest = -1
        try:
            while not ending.is_set():
                frame = session.newest_frame()
                if frame is None or frame.index == newest:
                    ending.wait(_LOOK_AGAIN_S)
                    continue
                newest = frame.index
                look(frame)
        except Exception as fault:  # the one catch at the top of this thread
            log.exception("looking at the camera")
            if not ending.is_set():
                self._fault = fault

    def _pull(self) -> None:
        """What happened since the last time, in the window's thread."""
        session = self._session
        if session is None:
            return
        fault = self._fault
        for event in session.drain_events():
            if event.kind == "camera_lost":
                self.lost.emit(event.cause)
            elif event.kind in ("source_failed", "source_ended"):
                fault = event.cause or CameraLost()
        if fault is not None:
            self.close()
            self.failed.emit(fault)
            return
        frame = session.newest_frame()
        if frame is not None and frame.index != self._shown:
            self._shown = frame.index
            self.pulled.emit(frame)


def _ended(session: LiveSession, thread: threading.Thread | None) -> None:
    if thread is not None:
        thread.join()
    session.stop()

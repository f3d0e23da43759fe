"""A camera open for calibrating or checking: its pictures, who looks at them beside the window's thread, and which
camera it is."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QWidget

from carpus.core.durable import replace_file
from carpus.core.errors import CameraLost, CarpusFault
from carpus.core.pipeline.live import LiveSession
from carpus.core.types import Frame
from carpus.ui.background import Background
from carpus.ui.camera_name_sheet import CameraNameSheet
from carpus.ui.fault_words import fault_words
from carpus.ui.flow import Flow, ScreenContext

log = logging.getLogger(__name__)

PULL_EVERY_MS = 66
_LOOK_AGAIN_S = 0.02
Look = Callable[[Frame], None]


class CameraAtHand(QObject):
    """Opens a source, looks at its pictures in a thread of its own, and lets it go; one at a time.

    ``opened`` carries the :class:`LiveSession`, ``failed`` a fault after which the camera is let go, ``pulled`` the
    newest frame for the screen, ``lost`` what is said while the camera is away.
    """

    opened = Signal(object)
    failed = Signal(object)
    pulled = Signal(object)
    lost = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._background = Background()
        self._session: LiveSession | None = None
        self._made: list[LiveSession] = []
        self._looking: threading.Thread | None = None
        self._ending = threading.Event()
        self._fault: Exception | None = None
        self._number, self._shown = 0, -1
        self._timer = QTimer(self, interval=PULL_EVERY_MS)
        self._timer.timeout.connect(self._pull)

    @property
    def is_open(self) -> bool:
        return self._session is not None or self._number > 0

    def open(self, source: Callable[[], LiveSession], looker: Callable[[LiveSession], Look]) -> None:
        """Open what ``source`` gives, and have every newest picture looked at by what ``looker`` gives."""
        self.close()
        self._number = abs(self._number) + 1
        number = self._number

        def make() -> None:
            session = source()
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
                target=self._look, args=(session, looker(session), self._ending), name="looking at the camera"
            )
            self._looking.start()
            self._timer.start()
            self.opened.emit(session)

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
                words = fault_words(event.cause if isinstance(event.cause, CarpusFault) else CameraLost())
                self.lost.emit(f"{words.happened} {words.do}")
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


class AtCameraFlow(Flow):
    """A screen that opens a camera for itself. Where that does not tell its number it is asked over the screen which
    one it is, and nobody looks at its pictures before ``_known`` is set."""

    guide, while_aside = "cameracheck", True

    def __init__(self, context: ScreenContext, screen: QWidget, name_sheet: CameraNameSheet) -> None:
        super().__init__(context, screen)
        self._name_sheet = name_sheet
        self._kind, self._now, self._said = "", "", ""
        self._known = threading.Event()
        self.hand = CameraAtHand(self)
        self.hand.failed.connect(self._failed)
        name_sheet.named.connect(self._take_name)
        name_sheet.refused.connect(self.back)

    @property
    def is_at_work(self) -> bool:
        return self.hand.is_open

    def begin(self) -> None:
        raise NotImplementedError

    def back(self) -> None:
        raise NotImplementedError

    def to_settings(self) -> None:
        """Back to the camera's card, from which one came; behind it are the patients."""
        self.to_patient()
        self.context.way.show("settings", "camera")

    def leave(self) -> None:
        """Let the camera go; what was taken and not kept is forgotten."""
        self._name_sheet.dismiss()
        self._known = threading.Event()  # a name that is still being kept opens it no more
        self.hand.close()

    def close(self) -> None:
        self.hand.wait()

    def _failed(self, fault: Exception) -> None:
        self.back()
        self.context.messages.fault(fault)

    def _meet(self, session: LiveSession) -> None:
        info = session.info
        self._kind, self._now = info.name, info.serial
        if not info.is_nameless or (self._now and self._now == self._said):
            self._said = ""
            self._known.set()
        else:
            self._name_sheet.begin(self._now)

    def _take_name(self, name: str) -> None:
        kind, known, cameras = self._kind, self._known, self.context.cameras
        if name == self._now:
            known.set()
            return

        def kept(as_kept: str) -> None:
            if known is self._known:  # nobody has left meanwhile
                self._said = as_kept if as_kept == name else ""  # another than was typed is shown before it is used
                self.begin()

        self.run(lambda: cameras.keep_name(kind, name), kept, self._failed)

    def save_page(self, name: str, title: str, write: Callable[[Path], Path]) -> None:
        path = self.ask_where_to_save("reports", name, title, "PDF (*.pdf)")
        if path is not None:
            self.run(lambda: replace_file(path, write))


def _ended(session: LiveSession, thread: threading.Thread | None) -> None:
    if thread is not None:
        thread.join()
    session.stop()

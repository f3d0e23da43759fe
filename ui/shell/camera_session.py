"""An open camera for calibration and check: its frames, their processing in a thread, and its identity."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QLineEdit, QWidget

from carpus.core.model.errors import CameraLost, CarpusFault
from carpus.core.model.types import Frame
from carpus.core.pipeline.live import LiveSession
from carpus.core.platform.durable import replace_file
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import Button
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.theme import Theme
from carpus.ui.shell.flow import Flow, ScreenContext
from carpus.ui.words.fault_words import fault_words

MAX_NAME_LENGTH = 40


class CameraNameDialog(Dialog):
    """Name of a camera that reports no serial number.

    Signals: ``name_entered`` with the name; ``closed`` if none was given.
    """

    name_entered = Signal(str)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 600)
        self.add_heading()
        self.name_field = QLineEdit(maxLength=MAX_NAME_LENGTH, placeholderText=self.tr("Camera name"))
        self.name_field.setAccessibleName(self.tr("Camera name"))
        self.name_field.setMinimumHeight(theme.px(44))
        self.accept_button = Button(theme, self.tr("Continue"), "primary", height_px=44)
        self.card.body.addWidget(self.name_field)
        self.cancel_button = self.add_buttons(self.accept_button, cancel_text=self.tr("Cancel"), gap=None)
        self.name_field.textChanged.connect(lambda text: self.accept_button.setEnabled(bool(text.strip())))
        self.accept_button.clicked.connect(self._accept)

    def request_name(self, previous_name: str) -> None:
        """Open with the name of the last such camera, empty if there was none."""
        self.title.setText(
            self.tr("Is this still the camera “{name}”?").format(name=previous_name)
            if previous_name
            else self.tr("What is this camera called?")
        )
        words = self.tr(
            "This camera has no readable serial number. Name it and label it: calibrations and checks are "
            "saved under that name. Carpus treats every camera of this type without a number as this one."
        )
        if previous_name:
            words = self.tr(
                "This camera has no readable serial number. If it is a different one, enter its name: calibrations "
                "and checks are saved under that name."
            )
        self.words.setText(words)
        self.name_field.setText(previous_name)
        self.name_field.selectAll()
        self.accept_button.setEnabled(bool(previous_name))
        self.open(self.name_field)

    def close_silently(self) -> None:
        """Close without ``closed``, when the name is no longer needed."""
        self.blockSignals(True)
        self.close_dialog()
        self.blockSignals(False)

    def _accept(self) -> None:
        name = " ".join(self.name_field.text().split())
        if name:
            self.close_silently()
            self.name_entered.emit(name)


log = logging.getLogger(__name__)

POLL_INTERVAL_MS = 66
_IDLE_S = 0.02
FrameProcessor = Callable[[Frame], None]


class CameraSession(QObject):
    """Opens a camera and processes its frames in a thread; one camera at a time.

    Signals: ``opened`` with the :class:`LiveSession`, ``failed`` with a fault after which the camera is closed,
    ``frame_ready`` with the newest frame, ``camera_lost`` with a message while frames are missing.
    """

    opened = Signal(object)
    failed = Signal(object)
    frame_ready = Signal(object)
    camera_lost = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._background = Background()
        self._session: LiveSession | None = None
        self._starting_sessions: list[LiveSession] = []
        self._thread: threading.Thread | None = None
        self._stop_event = threading.Event()
        self._fault: Exception | None = None
        self._request_number, self._shown_index = 0, -1
        self._timer = QTimer(self, interval=POLL_INTERVAL_MS)
        self._timer.timeout.connect(self._poll)

    @property
    def is_open(self) -> bool:
        return self._session is not None or self._request_number > 0

    def open(
        self, open_session: Callable[[], LiveSession], make_processor: Callable[[LiveSession], FrameProcessor]
    ) -> None:
        """Open a session and pass each newest frame to what ``make_processor`` returns."""
        self.close()
        self._request_number = abs(self._request_number) + 1
        number = self._request_number

        def start_session() -> None:
            session = open_session()
            self._starting_sessions.append(session)
            session.start()

        def on_opened(_: object) -> None:
            session = self._starting_sessions.pop(0)
            if number != self._request_number:
                self._background.run(session.stop, lambda _: None, lambda _: None)
                return
            self._session, self._fault, self._shown_index = session, None, -1
            self._stop_event = threading.Event()
            self._thread = threading.Thread(
                target=self._process_frames,
                args=(session, make_processor(session), self._stop_event),
                name="looking at the camera",
            )
            self._thread.start()
            self._timer.start()
            self.opened.emit(session)

        def on_failed(fault: Exception) -> None:
            if number == self._request_number:
                self._request_number = -number
                self.failed.emit(fault)

        self._background.run(start_session, on_opened, on_failed)

    def close(self) -> None:
        """Close the camera, or cancel opening it; may be called at any time."""
        self._request_number = -abs(self._request_number)
        session, thread = self._session, self._thread
        self._session = self._thread = None
        self._timer.stop()
        self._stop_event.set()
        if session is not None:
            self._background.run(lambda: _end_session(session, thread), lambda _: None, lambda _: None)

    def shut_down(self) -> None:
        """Wait until the camera is closed, also one that is still being opened."""
        self.close()
        self._background.join()
        while self._starting_sessions:
            self._starting_sessions.pop().stop()

    def _process_frames(self, session: LiveSession, process: FrameProcessor, stop_event: threading.Event) -> None:
        newest = -1
        try:
            while not stop_event.is_set():
                frame = session.current_frame()
                if frame is None or frame.index == newest:
                    stop_event.wait(_IDLE_S)
                    continue
                newest = frame.index
                process(frame)
        except Exception as fault:  # the one catch at the top of this thread
            log.exception("looking at the camera")
            if not stop_event.is_set():
                self._fault = fault

    def _poll(self) -> None:
        """Handle events and the newest frame in the window's thread."""
        session = self._session
        if session is None:
            return
        fault = self._fault
        for event in session.drain_events():
            if event.kind == "camera_lost":
                words = fault_words(event.cause if isinstance(event.cause, CarpusFault) else CameraLost())
                self.camera_lost.emit(f"{words.summary} {words.remedy}")
            elif event.kind in ("source_failed", "source_ended"):
                fault = event.cause or CameraLost()
        if fault is not None:
            self.close()
            self.failed.emit(fault)
            return
        frame = session.current_frame()
        if frame is not None and frame.index != self._shown_index:
            self._shown_index = frame.index
            self.frame_ready.emit(frame)


class CameraFlowBase(Flow):
    """Flow of a screen that opens a camera.

    A camera without a serial number is asked for its name first. Its frames are not processed before ``_identified``
    is set.
    """

    guide_page, runs_behind_overlay = "cameracheck", True

    def __init__(self, context: ScreenContext, screen: QWidget, name_dialog: CameraNameDialog) -> None:
        super().__init__(context, screen)
        self._name_dialog = name_dialog
        self._camera_model, self._serial, self._entered_name = "", "", ""
        self._identified = threading.Event()
        self.camera_session = CameraSession(self)
        self.camera_session.failed.connect(self._on_failed)
        name_dialog.name_entered.connect(self._on_name_entered)
        name_dialog.closed.connect(self.return_to_start)

    @property
    def is_busy(self) -> bool:
        return self.camera_session.is_open

    def start(self) -> None:
        raise NotImplementedError

    def return_to_start(self) -> None:
        raise NotImplementedError

    def return_to_settings(self) -> None:
        """Go back to the camera card of the settings."""
        self.return_to_patients()
        self.context.navigator.open_screen("settings", "camera")

    def on_leave(self) -> None:
        """Close the camera and drop what was not saved."""
        self._name_dialog.close_silently()
        self._identified = threading.Event()  # a name that is still being kept opens it no more
        self.camera_session.close()

    def close(self) -> None:
        self.camera_session.shut_down()

    def _on_failed(self, fault: Exception) -> None:
        self.return_to_start()
        self.context.messages.show_fault(fault)

    def _identify_camera(self, session: LiveSession) -> None:
        info = session.info
        self._camera_model, self._serial = info.name, info.serial
        if not info.is_nameless or (self._serial and self._serial == self._entered_name):
            self._entered_name = ""
            self._identified.set()
        else:
            self._name_dialog.request_name(self._serial)

    def _on_name_entered(self, name: str) -> None:
        kind, known, cameras = self._camera_model, self._identified, self.context.cameras
        if name == self._serial:
            known.set()
            return

        def on_saved(saved_name: str) -> None:
            if known is self._identified:  # nobody has left meanwhile
                self._entered_name = (
                    saved_name if saved_name == name else ""
                )  # another than was typed is shown before it is used
                self.start()

        self.run(lambda: cameras.save_name(kind, name), on_saved, self._on_failed)

    def save_printout(self, name: str, title: str, write: Callable[[Path], Path]) -> None:
        path = self.choose_save_path("reports", name, title, "PDF (*.pdf)")
        if path is not None:
            self.run(lambda: replace_file(path, write))


def _end_session(session: LiveSession, thread: threading.Thread | None) -> None:
    if thread is not None:
        thread.join()
    session.stop()

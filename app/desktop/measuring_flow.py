"""The flow while measuring: what the running source tells, how a recording ends, what is asked before it does."""

from __future__ import annotations

import logging

from PySide6.QtCore import QObject, Signal

from carpus.core.errors import CameraLost
from carpus.core.pipeline.live_values import LiveEvent
from carpus.core.records.set_up import SetUp
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.flow import Navigator
from carpus.ui.live.screen import LiveScreen
from carpus.ui.messages.messages import Messages
from carpus.ui.messages.stop_card import Answer
from carpus.ui.now_open import NowOpen

log = logging.getLogger(__name__)


class MeasuringFlow(QObject):
    """``stored`` carries the session's identity; ``patients_wanted`` and ``close_wanted`` are answers of a person."""

    begun = Signal(SetUp)
    """The live screen is shown for this set-up."""
    stored = Signal(str)
    patients_wanted = Signal()
    close_wanted = Signal()

    def __init__(self, parent: QObject, live: LiveScreen, way: Navigator, tell: Messages, now: NowOpen) -> None:
        super().__init__(parent)
        self._live, self._way, self._tell, self._now = live, way, tell, now
        live.told.connect(self.take)
        live.stopped.connect(self._stopped)
        live.stop_failed.connect(self._stop_failed)
        live.hasty.connect(self._ask_hasty)

    @property
    def is_recording(self) -> bool:
        """Whether a recording runs or is paused."""
        return self._live.recording_state != "off"

    def begin(self) -> None:
        """Show the live screen on the source that is open."""
        now = self._now
        assert now.source is not None
        assert now.set_up is not None
        self._live.begin(now.source.measuring, now.set_up)
        self.begun.emit(now.set_up)
        self._way.go("live")

    # --- what the source tells ----------------------------------------------------------------------------
    def take(self, told: object) -> None:
        """An event of the source, or a fault of a command."""
        if isinstance(told, Exception):
            self._tell.fault(told)
        elif isinstance(told, LiveEvent):
            if told.kind == "camera_lost":
                self._camera_lost(told)
            elif told.kind == "camera_back":
                self._live.set_camera_lost(False)
                self._tell.camera_back()
            elif told.kind in ("source_ended", "recording_failed"):
                self._live.stop()  # its fault, if there is one, comes by stop_failed
            elif told.kind == "source_failed":
                self._live.stop()
                if told.cause is not None:
                    self._tell.fault(told.cause)
            elif told.cause is not None:
                self._tell.fault(told.cause)

    def _camera_lost(self, told: LiveEvent) -> None:
        live, recording = self._live, self.is_recording
        live.set_camera_lost(True)
        detail = safe = ""
        if recording:
            at = numbers.clock(live.recorded_s)
            detail = self.tr("Recording paused by itself at {time}.").format(time=at)
            safe = self.tr("{time} and {count} full repetitions are stored.").format(time=at, count=live.repetitions)
        answer = (
            Answer(self.tr("Stop and review"), live.stop)
            if recording
            else Answer(self.tr("Choose another source"), self._way.back)
        )
        self._tell.camera_lost(told.cause or CameraLost(), (answer,), detail, safe)

    # --- how it ends --------------------------------------------------------------------------------------
    def _stopped(self, session_id: str) -> None:
        self._tell.withdraw(self._closing_question())
        self._tell.withdraw(self._hasty_question())
        self._live.end()  # the source goes on, for another set
        self.stored.emit(session_id)

    def _stop_failed(self, fault: Exception) -> None:
        """The recording ended by a fault; what reached the disk has been finished."""
        self._tell.fault(
            fault,
            (
                Answer(self.tr("To the patients"), self.patients_wanted.emit, "P", risky=True),
                Answer(self.tr("Go on measuring"), lambda: None),
            ),
        )

    def _ask_hasty(self) -> None:
        """A recording that has only just begun is ended: is it meant?"""
        self._tell.ask(
            self._hasty_question(),
            (
                Answer(self.tr("Stop and review"), self._live.stop, "S", risky=True),
                Answer(self.tr("Go on measuring"), lambda: None),
            ),
        )

    def _hasty_question(self) -> Words:
        return Words(
            self.tr("The recording has only just begun."),
            self.tr("It goes on while you choose, and everything is kept."),
            self.tr("Go on measuring, or stop it already?"),
        )

    # --- the window closes --------------------------------------------------------------------------------
    def asks_before_closing(self) -> bool:
        """A running recording would end with the window: the person says whether it shall."""
        if not self.is_recording:
            return False
        if not self._tell.busy:
            self._tell.ask(
                self._closing_question(),
                (
                    Answer(self.tr("Stop, save and close"), self.close_wanted.emit, "S", risky=True),
                    Answer(self.tr("Go on measuring"), lambda: None),
                ),
            )
        return True

    def _closing_question(self) -> Words:
        return Words(
            self.tr("A recording is running."),
            self.tr("Everything measured up to now is kept, whatever you choose."),
            self.tr("Go on measuring, or stop: the session is saved and Carpus closes."),
        )

    def let_go(self) -> bool:
        """The window closes: no screen opens any more. Whether a recording is still to be stopped by :meth:`finish`."""
        for signal in (self._live.stopped, self._live.stop_failed):
            signal.disconnect()  # what is being stored is finished
        recording = self.is_recording and not self._live.storing
        self._live.end()
        return recording

    def finish(self, *, recording: bool) -> None:
        """End the source in order, and wait for it."""
        source, self._now.source = self._now.source, None
        if source is None:
            return
        if recording:
            try:
                source.measuring.stop_recording()
            except Exception as fault:
                log.warning("the recording that ran at the end", exc_info=fault)
        source.measuring.close()

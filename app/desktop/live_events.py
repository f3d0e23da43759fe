"""What the running source tells, turned into messages and the next step."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from core.errors import CameraLost
from core.pipeline.live_values import LiveEvent
from ui import numbers
from ui.messages.stop_card import Answer
from ui.ports import Measuring

if TYPE_CHECKING:
    from app.desktop.journey import Journey

log = logging.getLogger(__name__)


class LiveEvents(QObject):
    """Hears the events and faults of the live screen."""

    def __init__(self, journey: Journey) -> None:
        super().__init__(journey)
        self._journey = journey

    def take(self, told: object) -> None:
        """An event of the source, or a fault of a command."""
        journey = self._journey
        if isinstance(told, Exception):
            journey.teller.fault(told)
        elif isinstance(told, LiveEvent):
            if told.kind == "camera_lost":
                self._camera_lost(told)
            elif told.kind == "camera_back":
                journey.live.set_camera_lost(False)
                journey.teller.camera_back()
            elif told.kind in ("source_ended", "recording_failed"):
                journey.live.stop()  # its fault, if there is one, comes by stop_failed
            elif told.kind == "source_failed":
                self._source_failed(told)
            elif told.cause is not None:
                journey.teller.fault(told.cause)

    def stop_failed(self, fault: Exception) -> None:
        """The recording ended by a fault; what reached the disk has been finished."""
        journey = self._journey
        journey.teller.fault(
            fault,
            (
                Answer(self.tr("To the patients"), self._to_patients, "P"),
                Answer(self.tr("Go on measuring"), lambda: None, self.tr("Space")),
            ),
        )

    def finish(self, measuring: Measuring) -> None:
        """Store a recording that runs while the window closes."""
        try:
            measuring.stop_recording()
        except Exception as fault:
            log.warning("the recording that ran at the end", exc_info=fault)

    def _camera_lost(self, told: LiveEvent) -> None:
        live = self._journey.live
        recording = live.recording_state != "off"
        live.set_camera_lost(True)
        detail = safe = ""
        if recording:
            at = numbers.clock(live.recorded_s)
            detail = self.tr("Recording paused by itself at {time}.").format(time=at)
            safe = self.tr("{time} and {count} full repetitions are stored.").format(time=at, count=live.repetitions)
        answer = (
            Answer(self.tr("Stop and review"), live.stop, self.tr("Space"))
            if recording
            else Answer(self.tr("Choose another source"), self._journey.back)
        )
        self._journey.teller.camera_lost(told.cause or CameraLost(), (answer,), detail, safe)

    def _source_failed(self, told: LiveEvent) -> None:
        journey = self._journey
        if journey.live.recording_state != "off":
            journey.live.stop()
        if told.cause is not None:
            journey.teller.fault(told.cause)

    def _to_patients(self) -> None:
        self._journey.show_patients(self._journey.patient.patient_id if self._journey.patient else "")

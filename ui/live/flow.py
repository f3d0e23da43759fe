"""The flow while measuring: what the running source tells, how a recording ends, what is asked before it does."""

from __future__ import annotations

import logging

from carpus.core.errors import CameraLost
from carpus.core.pipeline.live_values import LiveEvent
from carpus.core.words import Words
from carpus.ui import numbers
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.live.course import CourseRun
from carpus.ui.live.screen import LiveScreen
from carpus.ui.messages.messages import Answer
from carpus.ui.patient.viewing import PatientViewing

log = logging.getLogger(__name__)


class LiveFlow(Flow):
    """Last step, with the patient's own view and the set of exercises that runs."""

    place, guide = "live", "measuring"
    screen: LiveScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, LiveScreen(context.theme, context.background))
        live, recording, self._to_stop = self.screen, self.screen.recording, False
        self.patient_view = PatientViewing(context, live.set_patient_view)
        live.patient_wanted.connect(self.patient_view.toggle)
        live.glanced.connect(self.patient_view.follow)
        self.course = CourseRun(self, live, self.patient_view, context.now)
        self.course.wanted.connect(self.show)
        live.told.connect(self.take)
        recording.stopping.connect(lambda: context.way.flow("review"))  # made while the recording is stored
        recording.stopped.connect(self._stopped)
        recording.stop_failed.connect(self._stop_failed)
        recording.hasty.connect(self._ask_hasty)
        context.way.leaving.connect(self._leaving)
        context.opener.closing.connect(self._source_closes)

    @property
    def is_recording(self) -> bool:
        return self.screen.recording.state != "off"

    def show(self) -> None:
        """On the source that is open; without one the patient is set up as last time."""
        now = self.context.now
        if now.source is not None:
            assert now.set_up is not None
            self.screen.begin(now.source.measuring, now.set_up)
            self.patient_view.begin(now.set_up)
            self.course.begun(now.set_up)
            self.context.way.go("live")
        elif now.patient is not None:
            self.context.way.show("camera", now.patient.patient_id)

    def up(self) -> None:
        """Back to the camera; of a running recording it is asked first whether it shall stop."""
        if not self.is_recording:
            self.context.way.show("camera")
        elif not self.screen.recording.storing:
            self._ask_to_stop(self._stop_question())

    def show_research(self, *, on: bool) -> None:
        self.screen.show_research(on=on)

    def _leaving(self, place: str) -> None:
        """A lost camera leaves the tracking light to be seen from afar; elsewhere the top bar stays."""
        self.context.messages.cover(self.screen.stage if place == "live" else self.context.shell.stage)
        if place != "live":
            self.patient_view.leave()

    def _source_closes(self) -> None:
        self.screen.end()
        self.course.end()

    # --- what the source tells ----------------------------------------------------------------------------
    def take(self, told: object) -> None:
        messages = self.context.messages
        if isinstance(told, Exception):
            messages.fault(told)
        elif isinstance(told, LiveEvent):
            if told.kind == "camera_lost":
                self._camera_lost(told)
            elif told.kind == "camera_back":
                self.screen.set_camera_lost(False)
                messages.camera_back()
            elif told.kind in ("source_ended", "recording_failed"):
                self.screen.recording.stop()  # its fault, if there is one, comes by stop_failed
            else:
                if told.kind == "source_failed":
                    self.screen.recording.stop()
                if told.cause is not None:
                    messages.fault(told.cause)

    def _camera_lost(self, told: LiveEvent) -> None:
        live, recording = self.screen, self.is_recording
        live.set_camera_lost(True)
        detail = safe = ""
        if recording:
            at = numbers.clock(live.recording.recorded_s)
            detail = self.tr("Recording paused by itself at {time}.").format(time=at)
            done = live.recording.repetitions
            safe = self.tr("{time} and {count} full repetitions are stored.").format(time=at, count=done)
        answer = (
            Answer(self.tr("Stop and review"), live.recording.stop)
            if recording
            else Answer(self.tr("Choose another source"), self.context.way.back)
        )
        self.context.messages.camera_lost(told.cause or CameraLost(), (answer,), detail, safe)

    # --- how it ends --------------------------------------------------------------------------------------
    def _stopped(self, session_id: str) -> None:
        now, way = self.context.now, self.context.way
        self.context.messages.withdraw(self._closing_question())
        self.context.messages.withdraw(self._hasty_question())
        self.context.messages.withdraw(self._stop_question())
        self.screen.end()  # the source goes on, for another set
        in_course = now.set_up is not None and now.set_up.course is not None
        if self.course.goes_on():
            way.changed.emit()
            return
        self.patient_view.stored()
        if in_course and now.patient is not None and not self.context.library.store.is_away:
            way.show("sessions", now.patient.patient_id)
        else:
            way.show("review", session_id)

    def _stop_failed(self, fault: Exception) -> None:
        """The recording ended by a fault; what reached the disk has been finished."""
        self.context.messages.fault(
            fault,
            (
                Answer(self.tr("To the patients"), self.to_patient, "P", risky=True),
                Answer(self.tr("Go on measuring"), lambda: None),
            ),
        )

    def _ask_hasty(self) -> None:
        """A recording that has only just begun is to be ended."""
        self._ask_to_stop(self._hasty_question())

    def _ask_to_stop(self, question: Words) -> None:
        self.context.messages.ask(
            question,
            (
                Answer(self.tr("Stop and review"), self.screen.recording.stop, "S", risky=True),
                Answer(self.tr("Go on measuring"), lambda: None),
            ),
        )

    def _hasty_question(self) -> Words:
        return Words(
            self.tr("The recording has only just begun."),
            self.tr("It goes on while you choose, and everything is kept."),
            self.tr("Go on measuring, or stop it already?"),
        )

    def _stop_question(self) -> Words:
        return Words(
            self.tr("Stop recording?"),
            self.tr("It goes on while you choose, and everything is kept."),
            self.tr("Go on measuring, or stop: the session is saved and opens in the review."),
        )

    # --- the window closes --------------------------------------------------------------------------------
    def asks_before_closing(self) -> bool:
        """A running recording would end with the window: the person says whether it shall."""
        if not self.is_recording:
            return False
        if not self.context.messages.busy:
            self.context.messages.ask(
                self._closing_question(),
                (
                    Answer(self.tr("Stop, save and close"), self.context.shell.close_surely, "S", risky=True),
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

    def close(self) -> None:
        """No screen opens any more; :meth:`finish` stops a recording that runs."""
        self.patient_view.close()
        for signal in (self.screen.recording.stopped, self.screen.recording.stop_failed):
            signal.disconnect()  # what is being stored is finished
        self._to_stop = self.is_recording and not self.screen.recording.storing
        self.screen.end()

    def finish(self) -> None:
        """All else has ended: end the source in order, and wait for it."""
        source, self.context.now.source = self.context.now.source, None
        if source is None:
            return
        if self._to_stop:
            try:
                source.measuring.stop_recording()
            except Exception as fault:
                log.warning("the recording that ran at the end", exc_info=fault)
        source.measuring.close()

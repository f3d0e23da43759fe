"""The flow while measuring: events of the source, the end of a recording, questions before it."""

from __future__ import annotations

import logging

from carpus.core.model.errors import CameraLost
from carpus.core.model.fault_text import MessageText
from carpus.core.pipeline.live_values import LiveEvent
from carpus.ui.kit import numbers
from carpus.ui.screens.live.course import CourseRunner
from carpus.ui.screens.live.screen import LiveScreen
from carpus.ui.screens.patient.view_controller import PatientViewController
from carpus.ui.shell.flow import Flow, ScreenContext
from carpus.ui.shell.messages import Answer

log = logging.getLogger(__name__)


class LiveFlow(Flow):
    """Last step, with the patient's view and the running set of exercises."""

    screen_name, guide_page = "live", "measuring"
    screen: LiveScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, LiveScreen(context.theme, context.background))
        live, recording, self._must_stop = self.screen, self.screen.recording, False
        self.patient_view = PatientViewController(context, live.set_patient_view)
        live.patient_view_requested.connect(self.patient_view.toggle)
        live.snapshot_taken.connect(self.patient_view.update)
        self.course = CourseRunner(self, live, self.patient_view, context.current)
        self.course.screen_requested.connect(self.open)
        live.event_received.connect(self.handle_event)
        recording.stopping.connect(lambda: context.navigator.flow("review"))  # made while the recording is stored
        recording.stopped.connect(self._on_stopped)
        recording.stop_failed.connect(self._on_stop_failed)
        recording.early_stop_requested.connect(self._confirm_early_stop)
        context.navigator.screen_changing.connect(self._on_leaving)
        context.opener.closing.connect(self._on_source_closing)

    @property
    def is_recording(self) -> bool:
        return self.screen.recording.state != "off"

    def open(self) -> None:
        """Open on the running source; without one, on the camera screen with the last set-up."""
        now = self.context.current
        if now.source is not None:
            assert now.set_up is not None
            self.screen.open_source(now.source.measuring, now.set_up, now.source.is_hand_resting)
            self.patient_view.start_exercise(now.set_up)
            self.course.start_part(now.set_up)
            self.context.navigator.switch_screen("live")
        elif now.patient is not None:
            self.context.navigator.open_screen("camera", now.patient.patient_id)

    def navigate_back(self) -> None:
        """Go back to the camera; ask first if a recording is running."""
        if not self.is_recording:
            self.context.navigator.open_screen("camera")
        elif not self.screen.recording.is_storing:
            self._confirm_stop(self._stop_question())

    def _on_leaving(self, place: str) -> None:
        """Let messages cover only the stage here, so that the tracking light stays visible."""
        self.context.messages.set_host(self.screen.stage if place == "live" else self.context.window.screen_stack)
        if place != "live":
            self.patient_view.clear()

    def _on_source_closing(self) -> None:
        self.screen.close_source()
        self.course.end()

    # --- what the source tells ----------------------------------------------------------------------------
    def handle_event(self, event: object) -> None:
        messages = self.context.messages
        if isinstance(event, Exception):
            messages.show_fault(event)
        elif isinstance(event, LiveEvent):
            if event.kind == "camera_lost":
                self._camera_lost(event)
            elif event.kind == "camera_back":
                self.screen.set_camera_lost(False)
                messages.close_camera_lost()
            elif event.kind in ("source_ended", "recording_failed"):
                self.screen.recording.stop()  # its fault, if there is one, comes by stop_failed
            else:
                if event.kind == "source_failed":
                    self.screen.recording.stop()
                if event.cause is not None:
                    messages.show_fault(event.cause)

    def _camera_lost(self, event: LiveEvent) -> None:
        live, recording = self.screen, self.is_recording
        live.set_camera_lost(True)
        detail = safe = ""
        if recording:
            at = numbers.format_clock(live.recording.duration_s)
            detail = self.tr("Recording paused automatically at {time}.").format(time=at)
            done = live.recording.repetitions
            safe = self.tr("{time} and {count} full repetitions are saved.").format(time=at, count=done)
        answer = (
            Answer(self.tr("Stop and review"), live.recording.stop)
            if recording
            else Answer(self.tr("Choose another source"), self.context.navigator.navigate_back)
        )
        self.context.messages.show_camera_lost(event.cause or CameraLost(), (answer,), detail, safe)

    # --- how it ends --------------------------------------------------------------------------------------
    def _on_stopped(self, session_id: str) -> None:
        now, way = self.context.current, self.context.navigator
        self.context.messages.withdraw_question(self._closing_question())
        self.context.messages.withdraw_question(self._early_stop_question())
        self.context.messages.withdraw_question(self._stop_question())
        self.screen.close_source()  # the source goes on, for another set
        in_course = now.set_up is not None and now.set_up.set_run is not None
        if self.course.advance():
            way.banner_changed.emit()
            return
        self.patient_view.show_done()
        if in_course and now.patient is not None and not self.context.library.store.is_server_away:
            way.open_screen("sessions", now.patient.patient_id)
        else:
            way.open_screen("review", session_id)

    def _on_stop_failed(self, fault: Exception) -> None:
        """Show the fault that ended the recording; what reached the disk has been completed."""
        self.context.messages.show_fault(
            fault,
            (
                Answer(self.tr("To the patients"), self.return_to_patients, "P", is_risky=True),
                Answer(self.tr("Continue measuring"), lambda: None),
            ),
        )

    def _confirm_early_stop(self) -> None:
        self._confirm_stop(self._early_stop_question())

    def _confirm_stop(self, question: MessageText) -> None:
        self.context.messages.show_question(
            question,
            (
                Answer(self.tr("Stop and review"), self.screen.recording.stop, "S", is_risky=True),
                Answer(self.tr("Continue measuring"), lambda: None),
            ),
        )

    def _early_stop_question(self) -> MessageText:
        return MessageText(
            self.tr("The recording has only just begun."),
            self.tr("Recording continues while you choose. Everything is saved."),
            self.tr("Continue measuring or stop now?"),
        )

    def _stop_question(self) -> MessageText:
        return MessageText(
            self.tr("Stop recording?"),
            self.tr("Recording continues while you choose. Everything is saved."),
            self.tr("Continue measuring, or stop: the session is saved and opens in the review."),
        )

    # --- the window closes --------------------------------------------------------------------------------
    def prompt_before_close(self) -> bool:
        """Ask whether closing the window shall end a running recording."""
        if not self.is_recording:
            return False
        if not self.context.messages.is_busy:
            self.context.messages.show_question(
                self._closing_question(),
                (
                    Answer(
                        self.tr("Stop, save and close"), self.context.window.close_without_prompt, "S", is_risky=True
                    ),
                    Answer(self.tr("Continue measuring"), lambda: None),
                ),
            )
        return True

    def _closing_question(self) -> MessageText:
        return MessageText(
            self.tr("A recording is running."),
            self.tr("Everything measured so far is saved, whatever you choose."),
            self.tr("Continue measuring, or stop: the session is saved and Carpus closes."),
        )

    def close(self) -> None:
        """Let no screen open any more; :meth:`finish` stops a running recording."""
        self.patient_view.close()
        for signal in (self.screen.recording.stopped, self.screen.recording.stop_failed):
            signal.disconnect()  # what is being stored is finished
        self._must_stop = self.is_recording and not self.screen.recording.is_storing
        self.screen.close_source()

    def finish(self) -> None:
        """Stop the recording, close the source and wait for it."""
        source, self.context.current.source = self.context.current.source, None
        if source is None:
            return
        if self._must_stop:
            try:
                source.measuring.stop_recording()
            except Exception as fault:
                log.warning("the recording that ran at the end", exc_info=fault)
        source.measuring.close()

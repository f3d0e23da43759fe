"""The flow while measuring: events of the source, the end of a recording, questions before it, a running set."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer

from carpus.core.model.errors import CameraLost
from carpus.core.model.fault_text import MessageText
from carpus.core.pipeline.live_values import LiveEvent
from carpus.core.records.session_setup import SessionSetup, next_part
from carpus.ui.kit import numbers
from carpus.ui.kit.translate import translate_phrase
from carpus.ui.picture.movement_guide import ExerciseSnapshot
from carpus.ui.screens.live.screen import LiveScreen
from carpus.ui.screens.patient.view_controller import PatientViewController
from carpus.ui.screens.setup.set_dialog import part_words
from carpus.ui.shell.current_selection import CurrentSelection
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
        going_on = self.tr("Recording continues while you choose. Everything is saved.")
        self._early_stop_question = MessageText(
            self.tr("The recording has only just begun."), going_on, self.tr("Continue measuring or stop now?")
        )
        self._stop_question = MessageText(
            self.tr("Stop recording?"),
            going_on,
            self.tr("Continue measuring, or stop: the session is saved and opens in the review."),
        )
        self._closing_question = MessageText(
            self.tr("A recording is running."),
            self.tr("Everything measured so far is saved, whatever you choose."),
            self.tr("Continue measuring, or stop: the session is saved and Carpus closes."),
        )
        self.patient_view = PatientViewController(context, live.set_patient_view)
        live.patient_view_button.clicked.connect(self.patient_view.toggle)
        live.snapshot_taken.connect(self.patient_view.update)
        self.course = CourseRunner(self, live, self.patient_view, context.current, self.open)
        live.event_received.connect(self.handle_event)
        recording.stopping.connect(lambda: context.navigator.flow("review"))  # made while the recording is stored
        recording.stopped.connect(self._on_stopped)
        recording.stop_failed.connect(self._on_stop_failed)
        recording.early_stop_requested.connect(lambda: self._confirm_stop(self._early_stop_question))
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
            self._confirm_stop(self._stop_question)

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
        for question in (self._closing_question, self._early_stop_question, self._stop_question):
            self.context.messages.withdraw_question(question)
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

    def _confirm_stop(self, question: MessageText) -> None:
        self.context.messages.show_question(
            question,
            (
                Answer(self.tr("Stop and review"), self.screen.recording.stop, "S", is_risky=True),
                Answer(self.tr("Continue measuring"), lambda: None),
            ),
        )

    # --- the window closes --------------------------------------------------------------------------------
    def prompt_before_close(self) -> bool:
        """Ask whether closing the window shall end a running recording."""
        if not self.is_recording:
            return False
        if not self.context.messages.is_busy:
            self.context.messages.show_question(
                self._closing_question,
                (
                    Answer(
                        self.tr("Stop, save and close"), self.context.window.close_without_prompt, "S", is_risky=True
                    ),
                    Answer(self.tr("Continue measuring"), lambda: None),
                ),
            )
        return True

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


STOP_DELAY_S = 2.0
"""Recording continues after the last repetition, to include its return movement."""


class CourseRunner(QObject):
    """Ends each part, times the rest and shows what comes next; ``open_screen`` opens the live screen."""

    def __init__(
        self,
        parent: QObject,
        live: LiveScreen,
        patient: PatientViewController,
        now: CurrentSelection,
        open_screen: Callable[[], None],
    ) -> None:
        super().__init__(parent)
        self._live, self._patient, self._current, self._open_screen = live, patient, now, open_screen
        self._done_since_s = math.inf
        self._remaining_rest_s = self._rest_s = 0
        self._timer = QTimer(self, interval=1000)
        self._timer.timeout.connect(self._on_second)
        live.snapshot_taken.connect(self._update)

    @property
    def is_resting(self) -> bool:
        return self._remaining_rest_s > 0

    def start_part(self, set_up: SessionSetup) -> None:
        self._done_since_s = math.inf
        self._show_part(set_up)

    def advance(self) -> bool:
        """Show the next part after a recording; return False if there is none."""
        now = self._current
        following = next_part(now.set_up) if now.set_up is not None else None
        # A stored recording shows one exercise.
        if now.set_up is None or following is None or now.source is None or now.source.measuring.is_playback:
            self.end()
            return False
        assert now.set_up.set_run is not None
        self._rest_s = self._remaining_rest_s = now.set_up.set_run.part.rest_s
        now.source.measuring.set_exercise(following)
        now.set_up = following
        self._open_screen()
        if self._rest_s:
            self._timer.start()
            self._show_rest()
        return True

    def end(self) -> None:
        self._timer.stop()
        self._remaining_rest_s = 0
        self._live.recording.set_resting(resting=False)
        self._patient.show_rest(None)

    def _on_second(self) -> None:
        self._remaining_rest_s -= 1
        if self._remaining_rest_s <= 0:
            self.end()
        self._show_rest()

    def _show_rest(self) -> None:
        if self._current.set_up is not None:
            self._show_part(self._current.set_up)
            course = self._current.set_up.set_run
            self._live.recording.set_resting(resting=self.is_resting)
            if self.is_resting and course is not None:
                self._patient.show_rest((self._remaining_rest_s, self._rest_s, course.part_index, len(course.parts)))

    def _show_part(self, set_up: SessionSetup) -> None:
        course = set_up.set_run
        if course is None:
            self._live.course_label.show_text("")
            return
        words = self.tr("Exercise set “{name}”, {number} of {count}: {part}").format(
            name=translate_phrase(course.name),
            number=course.part_index + 1,
            count=len(course.parts),
            part=part_words(course.part),
        )
        if self.is_resting:
            rest = self.tr("Rest {time}. Press Space to start now.").format(
                time=numbers.format_clock(self._remaining_rest_s)
            )
            words = f"{rest} {words}. {translate_phrase(set_up.exercise.position)}"
        self._live.course_label.show_text(words)

    def _update(self, snapshot: ExerciseSnapshot) -> None:
        set_up = self._current.set_up
        course = set_up.set_run if set_up is not None else None
        if set_up is None or course is None or snapshot.state != "recording":
            return
        if self.is_resting:
            self.end()
            self._show_part(set_up)
        part = course.part
        if part.seconds and self._live.recording.duration_s >= part.seconds:
            self._live.recording.stop()
        elif part.repetitions:
            self._done_since_s = (
                min(self._done_since_s, snapshot.time_s) if snapshot.found_count >= part.repetitions else math.inf
            )
            if snapshot.time_s - self._done_since_s >= STOP_DELAY_S:
                self._live.recording.stop()

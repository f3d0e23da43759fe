"""An open source with a patient before it: tracking begun from a calibration, recorded, smoothed and stored."""

from __future__ import annotations

import logging
import shutil
import threading
import uuid
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import cv2
import numpy as np

from carpus.core.calibration.calibrate import CalibrationOutcome
from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.capture.files.raw import SUFFIX as RAW_SUFFIX
from carpus.core.capture.files.raw import RawWriter
from carpus.core.capture.source import SourceInfo, is_simulated, recorded_at, recording_id
from carpus.core.dates import iso
from carpus.core.errors import CarpusFault, DiskFull, ExtraMissing, NotLookedBack, OutputNotWritable, RecordingEmpty
from carpus.core.hand.forearm_rotation import stored_targets_deg
from carpus.core.phrase import phrase
from carpus.core.pipeline.around_hand import AroundHand, HandArea
from carpus.core.pipeline.channels import ChannelFull, NeverDrop
from carpus.core.pipeline.live import Listener, LiveSession
from carpus.core.pipeline.looking_back import LookingBack, TrackedHand
from carpus.core.pipeline.track import (
    NOT_LOOKED_BACK,
    FramePipeline,
    Learnt,
    TrackSettings,
    build_pipeline,
    learnt_from,
    parameters_json,
    source_facts,
)
from carpus.core.records.new_sessions import NewSessions
from carpus.core.records.recordings import SessionDraft
from carpus.core.records.set_up import MARKERS_SUFFIX, SetUp
from carpus.core.rounding import written
from carpus.core.session.journal import SUFFIX as JOURNAL_SUFFIX
from carpus.core.session.journal import RecordingJournal
from carpus.core.session.new_file import ROWS_AT_ONCE
from carpus.core.session.reader import READING
from carpus.core.session.values import Motion, new_header
from carpus.core.tracking.smoother_record import KeptSteps
from carpus.core.tracking.tracker import Tracker
from carpus.core.types import SPOT_SAID, ByteImage, FloatArray, Frame, SpotAnswer, TrackedFrame
from carpus.core.words import one_sentence

log = logging.getLogger(__name__)

_AROUND_HAND = 0.6
"""The picture of the markers reaches this share of their box beyond it."""
LEAST_FREE_BYTES = 100_000_000
"""A recording does not begin with less: five minutes of a whole hand's rows, or ten seconds of pictures."""
_ANSWERS_WAITING = 16


class LivePipeline:
    """That of the live session, begun at the neutral pose. Hands on what looking back needs, if wanted."""

    def __init__(self, pipeline: FramePipeline[Tracker], neutral_ends_s: float) -> None:
        self._pipeline = pipeline
        self._neutral_ends_s = neutral_ends_s
        self._begun = False
        self.keep: Callable[[KeptSteps], None] | None = None
        """Called in the tracking thread with the step of every frame; must not wait."""
        self.seen: Callable[[TrackedFrame], None] | None = None
        """Called in the tracking thread with every frame; must not wait."""
        self.taken_up: Callable[[SpotAnswer, float], object] | None = None
        """Called in the tracking thread with every answer that a frame has taken up, and that frame's time."""
        self._answers: NeverDrop[SpotAnswer] = NeverDrop(_ANSWERS_WAITING)
        self._shown: set[str] = set()
        self._to_restate: set[str] = set()
        self._restating = False

    def restate(self) -> None:
        """A recording begins: which spots were shown to be markers before it is told once more, of its own pictures."""
        self._restating = True

    def answer(self, answer: SpotAnswer) -> None:
        """What a person says of blue spots; from any thread, taken up with the next frame. Dropped where a dozen wait
        already, as when no pictures come."""
        with suppress(ChannelFull):
            self._answers.put(answer)

    def __call__(self, frame: Frame) -> TrackedFrame:
        tracker = self._pipeline.tracker
        if not self._begun and frame.timestamp_s > self._neutral_ends_s:
            # The still frames made the calibration; counted twice they would make it too sure of itself.
            tracker.begin_at_neutral()
            self._begun = True
        for answer in self._answers.taken():
            tracker.hear(answer)
        tracked = self._pipeline(frame)
        self._tell_answers(tracker.taken_up(), tracked)
        if self.seen is not None:
            self.seen(tracked)
        kept, keep = tracker.hand_over(), self.keep
        if keep is not None:
            keep(kept)
        return tracked

    def _tell_answers(self, heard: list[SpotAnswer], tracked: TrackedFrame) -> None:
        if self._restating:
            self._restating, self._to_restate = False, set(self._shown)
        markers = self._pipeline.tracker.markers
        for name in sorted(self._to_restate):
            u, v = tracked.marker_measured_px[markers.index(name)]
            if np.isfinite(u):
                self._to_restate.remove(name)
                heard.append(SpotAnswer(tracked.index, name, (float(u), float(v))))
        for answer in heard:
            if answer.place_px is not None:
                self._shown.add(answer.marker)
            if self.taken_up is not None:
                self.taken_up(answer, tracked.timestamp_s)


class RecordedSession:
    """A session while it is recorded: its journal, looked back at while that grows, and at the end its file."""

    def __init__(self, journal: RecordingJournal, looking_back: LookingBack | None) -> None:
        self._journal, self._looking_back = journal, looking_back
        self._draft: SessionDraft | None = None
        self._in_draft = 0.0
        self._times_s: list[float] = []
        self._early: list[tuple[str, str]] = []
        self.path = journal.path.with_suffix(".h5")

    def append(self, tracked: TrackedFrame) -> None:
        self._times_s.append(tracked.timestamp_s)
        self._journal.append(tracked)
        if self._looking_back is not None and self._looking_back.has_more:
            self._add_smoothed(self._looking_back.ready(self._not_smoothed()))
        for kind, text in self._early:
            self._journal.add_event(tracked.timestamp_s, kind, text)
        self._early.clear()
        if len(self._times_s) - self._in_draft >= ROWS_AT_ONCE:
            self._in_draft = len(self._times_s)
            try:
                self._follow()
            except CarpusFault:  # told at the end, if it still holds then: the rows are in the journal
                self._in_draft = np.inf  # all over again it would hold up the journal

    def add_event(self, time_s: float, kind: str, text: str) -> None:
        """One event; before the first picture there is no time to put it at, so it waits for the first row."""
        if np.isfinite(time_s):
            self._journal.add_event(time_s, kind, text)
        else:
            self._early.append((kind, text))

    def prepare(self) -> None:
        """No more rows come: all of them go into the session file while the rest is looked back at."""
        self._journal.flush()
        with suppress(CarpusFault):
            self._follow(whole=True)

    def _follow(self, *, whole: bool = False) -> None:
        """What is in the journal goes into the session file, so that the end is quick."""
        draft, self._draft = self._draft or SessionDraft(self._journal.path), None
        try:
            draft.read()
            if whole:
                draft.flush()
            self._draft = draft
        finally:
            if self._draft is None:
                draft.discard()

    def close(self) -> None:
        """Finish the session file; the journal goes. A session without a single frame is none."""
        if not self._times_s:
            self.discard()
            raise RecordingEmpty(self.path.name)
        if self._looking_back is not None:
            try:
                self._add_smoothed(self._looking_back.finish(self._not_smoothed()))
            except NotLookedBack as fault:
                log.warning("%s", one_sentence(NotLookedBack(self.path, fault.detail)))
                self._journal.add_event(self._times_s[-1], NOT_LOOKED_BACK, fault.detail)
        self._journal.flush()
        draft = self._draft or SessionDraft(self._journal.path)
        try:
            draft.read()
            if draft.rows != len(self._times_s):  # else the journal would go with what is only in it
                raise OutputNotWritable(self.path.parent, phrase("what was written is not what is read"))
            self.path = draft.finish() or self.path
        finally:
            draft.discard()
        self._journal.discard()

    def _add_smoothed(self, motion: Motion | None) -> None:
        if motion is not None:
            self._journal.add_smoothed(motion)

    def _not_smoothed(self) -> list[float]:
        """Times of the frames that are not smoothed yet."""
        return self._times_s[self._journal.smoothed_rows :]

    def abandon(self) -> None:
        self._let_go()
        self._journal.abandon()

    def discard(self) -> None:
        self._let_go()
        self._journal.discard()

    def _let_go(self) -> None:
        if self._looking_back is not None:
            self._looking_back.cancel()
        if self._draft is not None:
            self._draft.discard()


class SourceMeasuring:
    """A running source: from the chosen calibration to stored sessions, as many as wanted.

    ``recording`` is the stored one that is played, None of a camera: it plays from its first picture when recording
    starts, so that none is missed; a camera has been running since it was opened. ``on_begin`` is called when
    tracking begins,
    ``on_recording`` when a recording has begun, ``on_chosen`` when the same hand is to do another exercise.
    ``listener`` is asked who else hears what is tracked.
    """

    def __init__(
        self,
        session: LiveSession,
        info: SourceInfo,
        set_up: SetUp,
        settings: TrackSettings,
        places: NewSessions,
        *,
        recording: Path | None = None,
        on_begin: Callable[[], None] = lambda: None,
        on_recording: Callable[[], None] = lambda: None,
        on_chosen: Callable[[SetUp], None] = lambda _: None,
        listener: Callable[[Calibration], Listener | None] = lambda _: None,
    ) -> None:
        self._listener = listener
        self._session, self._info, self._set_up, self._settings = session, info, set_up, settings
        self._places, self._recording, self._starts_with_recording = places, recording, recording is not None
        self._on_begin, self._on_recording, self._on_chosen = on_begin, on_recording, on_chosen
        self._played = False
        self._identity: tuple[str, str] | None = None
        self._pipeline: LivePipeline | None = None
        self._learnt: Learnt | None = None
        self._calibration: Calibration | None = None
        self._markers_rgb: ByteImage | None = None

    @property
    def feed(self) -> LiveSession:
        return self._session

    @property
    def camera(self) -> Camera:
        return self._info.camera

    @property
    def calibration(self) -> Calibration | None:
        return self._calibration

    @property
    def starts_with_recording(self) -> bool:
        """Whether the source is a stored recording, which is recorded from its first picture to its last."""
        return self._starts_with_recording

    @property
    def is_simulated(self) -> bool:
        """Whether the pictures are of a simulated hand."""
        return is_simulated(self._info)

    def begin(self, outcome: CalibrationOutcome, held: Sequence[Frame]) -> None:
        """Track from a calibration; ``held`` are the pictures it was made from, the clicked one first."""
        if self._recording is not None:
            recorded = recorded_at(self._info, held[0].timestamp_s, self._recording)
            self._identity = recorded.when if recorded else "", recording_id(self._info, held[0])
        used = held[: max(outcome.capture_frames, 1)]
        neutral_ends_s = max(frame.timestamp_s for frame in used)
        self._learnt = learnt_from(outcome.noise, neutral_ends_s, self._settings.tracker)
        pipeline = build_pipeline(
            outcome, self.camera, self._settings, self._learnt, keep_history=self._settings.smooth
        )
        self._pipeline = LivePipeline(pipeline, neutral_ends_s)
        self._pipeline.taken_up = lambda answer, time_s: self._session.add_event(SPOT_SAID, answer.text(), time_s)
        self._calibration = outcome.calibration
        self._markers_rgb = _around_hand(held[0].color_rgb, outcome.pixel)
        try:
            self._session.listen(self._listener(self._calibration) if self._calibration is not None else None)
        except ExtraMissing as fault:
            self._session.notice(fault)
        self._session.begin_tracking(self._pipeline)
        self._on_begin()

    def choose(self, set_up: SetUp) -> None:
        """What is recorded next: another exercise of the same hand with the same discs. Not while a recording runs."""
        assert not self._session.recording
        assert set_up.protocol == self._set_up.protocol
        self._set_up = set_up
        self._on_chosen(set_up)

    def answer_spot(self, answer: SpotAnswer) -> None:
        """What a person says of blue spots of a picture shown: the tracker takes it up in its own thread, with the next
        frame, and the recording notes it."""
        if self._pipeline is not None:
            self._pipeline.answer(answer)

    def start_recording(self) -> None:
        """Open the session file, and a raw recording beside it if wanted; waits for the disk."""
        calibration, pipeline, learnt = self._calibration, self._pipeline, self._learnt
        assert calibration is not None
        assert pipeline is not None
        assert learnt is not None
        path = self._places.new_path(self._set_up)
        _check_room(path.parent)
        now = datetime.now().astimezone()
        recorded, identity = self._identity or (iso(now), str(uuid.uuid4()))
        header = new_header(
            hand=calibration.clicks.side,
            protocol=calibration.clicks.protocol,
            subject_id=self._set_up.subject_id,
            exercise=self._set_up.exercise.id,
            parameters=self._parameters(learnt),
            dip_free=self._settings.tracker.dip == "free",
            now=now,
            recorded=recorded,
            recording_id=identity,
        )
        said = replace(self._info, recorded=recorded, recording_id=identity)
        looking_back, at_end = None, lambda: None
        if self._settings.smooth:
            looking_back = LookingBack(TrackedHand(calibration, self.camera, learnt.applied(self._settings.tracker)))
            pipeline.keep, looked_back = looking_back.take, looking_back.wait

            def at_end() -> None:
                pipeline.keep = None  # the hand is followed meanwhile: what comes now is not of the recording
                looked_back()

        journal_path, patient_id = path.with_suffix(JOURNAL_SUFFIX), self._set_up.patient_id
        try:
            self._session.start_recording(
                lambda: RecordedSession(
                    RecordingJournal(journal_path, header, self.camera, calibration, patient_id), looking_back
                ),
                self._open_pictures(path.with_suffix(RAW_SUFFIX), said) if self._set_up.keep_pictures else None,
                at_end,
            )
        except BaseException:
            pipeline.keep = None
            if looking_back is not None:
                looking_back.cancel()
            raise
        # Asked for the outline when the recording ends, for which a person waits.
        threading.Thread(target=READING.start, name="reading", daemon=True).start()
        pipeline.restate()
        if self._starts_with_recording and not self._played:
            self._played = True
            self._session.start()
        self._on_recording()

    def _open_pictures(self, path: Path, said: SourceInfo) -> Callable[[], AroundHand]:
        """A raw recording of the hand and its surroundings, beside the session."""
        assert self._pipeline is not None
        hand = HandArea(self.camera, self._set_up.protocol)
        self._pipeline.seen = hand.take
        return lambda: AroundHand(RawWriter(path, said), hand.area)

    def _parameters(self, learnt: Learnt) -> str:
        """All settings as JSON, with what the exercise aimed at."""
        read = self._set_up.target_positive_deg, self._set_up.target_negative_deg
        aims = stored_targets_deg(read, self._set_up.exercise)
        set_up = {
            "repetitions": self._set_up.repetitions,
            "targets_deg": [aim if np.isfinite(aim) else None for aim in aims],
        }
        course = self._set_up.course
        if course is not None:
            set_up["set"] = {
                "run": course.run_id,
                "part": course.number + 1,
                "of": len(course.parts),
                "seconds": course.part.seconds,
            }
        return parameters_json(self._settings, source_facts(self._info), learnt, set_up)

    def stop_recording(self) -> str:
        """Store everything; the session's identity. A fault is raised once what reached the disk is finished."""
        try:
            path = self._session.stop_recording()
        except RecordingEmpty:
            raise
        except Exception:
            self._places.cut_short()
            raise
        finally:
            if self._pipeline is not None:
                self._pipeline.keep = self._pipeline.seen = None
        if self._markers_rgb is not None:
            _keep_picture(path.with_suffix(MARKERS_SUFFIX), self._markers_rgb)
        return self._places.entered(self._set_up, path)

    def close(self) -> None:
        """End the source; a running recording is finished."""
        self._session.stop()
        self._session.listen(None)


def _around_hand(color_rgb: ByteImage, pixel: FloatArray) -> ByteImage | None:
    """The picture about the markers, for the patient's card: the hand and nothing of the room."""
    known = pixel[np.isfinite(pixel).all(axis=1)]
    if not len(known):
        return None
    low, high = known.min(axis=0), known.max(axis=0)
    margin = _AROUND_HAND * float((high - low).max())
    left, top = (int(max(0.0, value - margin)) for value in low)
    right, bottom = (int(value + margin) + 1 for value in high)
    return np.ascontiguousarray(color_rgb[top:bottom, left:right])


def _keep_picture(path: Path, color_rgb: ByteImage) -> None:
    """A small picture beside the session; without it nothing is lost, so nothing is told."""
    done, data = cv2.imencode(".jpg", cv2.cvtColor(color_rgb, cv2.COLOR_RGB2BGR))
    if done:
        with suppress(OSError):
            path.touch(mode=0o600)
            path.write_bytes(data.tobytes())


def _check_room(folder: Path) -> None:
    """Raise :class:`DiskFull` where no recording should begin."""
    free = shutil.disk_usage(folder).free
    if free < LEAST_FREE_BYTES:
        free_mb, least_mb = written(free / 1e6), written(LEAST_FREE_BYTES / 1e6)
        why = phrase("{free} MB free, {least_free_bytes} MB are needed", free=free_mb, least_free_bytes=least_mb)
        raise DiskFull(folder, why)

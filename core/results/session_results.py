"""Results of a session: one table of measures, quality, and what makes it comparable or doubtful.

Each topic is computed in its own module on a :class:`core.results.valid_data.MeasurableSession`, with the mathematics
of :mod:`core.measures`: ``ranges``, ``repetition_rows``, ``task_measures``, ``norms``. Changes between sessions are in
``progress`` and ``side_by_side``. Degrees, degrees per second, millimetres and seconds; NaN is unknown.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime

import numpy as np

from carpus.core.calibration.result import CalibrationFinding
from carpus.core.measures.change_limits import DEFAULT_LIMITS, ErrorLimits, RetestStudy
from carpus.core.measures.repetitions import NoRepetitionReason, Repetition, explain_no_repetitions
from carpus.core.measures.signals import low_pass, resample_evenly
from carpus.core.measures.speed import StrokeMeasures
from carpus.core.measures.wrist_centre import estimate_wrist_centre, rotation_in_w0
from carpus.core.model.dates import is_moment
from carpus.core.model.hand.exercises import STILL_RADIUS_MM, Exercise
from carpus.core.model.hand.forearm_rotation import to_clinical_targets_deg
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.types import FloatArray, Side, TrackStatus
from carpus.core.platform.provenance import parameter_section
from carpus.core.results.measure import Group, Measure, MeasureKey, UnknownReason, summarise_values
from carpus.core.results.norms import compute_total_shares
from carpus.core.results.ranges import measure_joint_ranges, measure_still_angles, measure_wrist_ranges
from carpus.core.results.repetition_rows import (
    ACTIVE,
    RepetitionChoices,
    RepetitionResult,
    find_trained_angle,
    mask_passive,
    measure_repetitions,
)
from carpus.core.results.task_measures import GuardedComputation, MeasureInput, compute_task_measures
from carpus.core.results.valid_data import MeasurableSession, motion_estimate
from carpus.core.session.label_checks import CorrectionSummary, summarize_corrections
from carpus.core.session.values import AngleOrder, Session

Best = Callable[[Sequence[float]], float] | None
SPEED_MEASURES: tuple[tuple[str, str, str, Best], ...] = (
    ("peak speed", "deg/s", "peak_speed_rad_s", max), ("smoothness", "SPARC", "sparc", max),
    ("mean speed", "deg/s", "mean_speed_rad_s", max), ("movement time", "s", "movement_time_s", min),
    ("time to peak", "share", "time_to_peak_share", None), ("movement units", "1", "peaks", min),
    ("pauses", "1", "pauses", min), ("pause time", "s", "pause_s", min),
)  # fmt: skip
"""Name, unit, attribute, and choice of the best value of what is measured of every stroke."""


def full_strokes(repetitions: Sequence[RepetitionResult]) -> list[StrokeMeasures]:
    """Return the strokes of included repetitions that go from one turning point to the other."""
    return [stroke for one in repetitions if one.is_counted for stroke in one.strokes if not stroke.stroke.is_half]


def summarise_strokes(of: str, strokes: Sequence[StrokeMeasures]) -> tuple[Measure, ...]:
    """Summarise the included strokes; unknown if the tracker's noise hides their speed or smoothness."""
    slow: dict[str, UnknownReason] = {
        "peak speed": "too_slow" if any(one.too_slow for one in strokes) else "",
        "smoothness": "too_slow" if any(one.too_slow_to_be_smooth for one in strokes) else "",
    }
    out = []
    for what, unit, name, best in SPEED_MEASURES:
        read = math.degrees if unit == "deg/s" else float
        sds = [read(one.peak_speed_sd_rad_s) for one in strokes] if what == "peak speed" else ()
        values = [read(getattr(one, name)) for one in strokes]
        out.append(
            summarise_values("speed", of, what, unit, values, sds=sds, best=best, unknown_reason=slow.get(what, ""))
        )
    return tuple(out) if strokes else ()


STILLNESS_CUTOFF_HZ = 3.0
"""A forearm does not move faster than this; noise does."""


@dataclass(frozen=True, slots=True)
class RecordingQuality:
    """Quality of a recording; ``hidden_share`` is of all markers in all frames."""

    frames: int
    measured_share: float
    hidden_share: float
    dropped_frames: int
    forearm_movement_mm: float
    angle_sd_deg: float
    tilt_deg: float
    distance_m: float
    residual_mm: float
    centre_mm: tuple[float, float, float] = (math.nan,) * 3
    centre_residual_mm: float = math.nan
    """Centre of the wrist's rotation from the WRIST marker in the hand's axes, and its fit."""

    @property
    def has_forearm_moved(self) -> bool:
        """True if the wrist's centre left its tolerance."""
        return self.forearm_movement_mm > STILL_RADIUS_MM


def assess_quality(seen: MeasurableSession, repetitions: Sequence[RepetitionResult]) -> RecordingQuality:
    """Assess the recording of a session with these repetitions."""
    session, motion, verdict = seen.session, motion_estimate(seen.session), seen.session.calibration.verdict
    time_s = session.timestamp_s - session.timestamp_s[:1]
    is_tracked = np.asarray(session.status) == TrackStatus.TRACKED
    inside = np.ones(len(time_s), dtype=bool)
    if seen.tracks and (included := [one for one in repetitions if one.is_counted]):  # a rest hides no marker
        inside = np.any([(time_s >= rep.start_s) & (time_s <= rep.end_s) for rep in included], axis=0)
    is_visible = np.isfinite(session.markers.measured_px[inside, :, 0])
    centre = estimate_wrist_centre(
        motion.position_m, rotation_in_w0(motion.rotation_w2_w0, motion.w0_turn_rad), seen.is_in_view
    )
    is_known, moved_m = np.isfinite(centre.displacement_m), np.empty(0)
    if int(is_known.sum()) >= 2:
        moved_m = low_pass(resample_evenly(time_s, centre.displacement_m, is_known), STILLNESS_CUTOFF_HZ).value
    angle_sd_deg = math.nan
    if joint_sds := [one.visible_sd.value[one.visible_sd.is_finite] for one in seen.tracks.values() if one.is_known]:
        angle_sd_deg = math.degrees(float(np.median(np.concatenate(joint_sds))))
    elif not seen.tracks:
        columns = [0, 1, 2] if seen.exercise.angle is None else [seen.exercise.angle]
        sds_deg = np.degrees(motion.angles_sd_rad[is_tracked][:, columns])
        if np.isfinite(sds_deg).any():
            angle_sd_deg = float(np.median(sds_deg[np.isfinite(sds_deg)]))
    return RecordingQuality(
        frames=len(session),
        measured_share=float(np.mean(is_tracked)) if len(session) else math.nan,
        hidden_share=float(np.mean(~is_visible)) if is_visible.size else math.nan,
        dropped_frames=int(np.maximum(session.quality.dropped_before, 0).sum()),
        forearm_movement_mm=1e3 * float(np.nanmax(moved_m)) if np.isfinite(moved_m).any() else math.nan,
        centre_mm=tuple((1e3 * centre.centre_w2_m).tolist()),
        centre_residual_mm=1e3 * centre.residual_m,
        angle_sd_deg=angle_sd_deg,
        tilt_deg=verdict.tilt_deg,
        distance_m=verdict.distance_m,
        residual_mm=float(np.nanmax(verdict.residual_mm)) if np.isfinite(verdict.residual_mm).any() else math.nan,
    )


@dataclass(frozen=True, slots=True)
class RecordedCamera:
    """Camera of a session.

    ``serial`` is empty if unknown. ``calibrated_at`` (ISO 8601) is when it was calibrated with a board, empty if it was
    not; ``age_days`` is the age of that calibration at the recording, else NaN.
    """

    serial: str = ""
    calibrated_at: str = ""
    age_days: float = math.nan


UNKNOWN_CAMERA = RecordedCamera()


def parse_camera(parameters: str) -> RecordedCamera:
    """Parse the camera from the parameters of a session.

    >>> parameters = '{"source": {"serial": "77", "calibrated": "2026-11-20T09:00+00:00", "calibration_age_days": "5"}}'
    >>> parse_camera(parameters) == RecordedCamera("77", "2026-11-20T09:00+00:00", 5.0)
    True
    """
    source = parameter_section(parameters, "source")
    calibrated = str(source.get("calibrated") or "")
    try:
        age_days = float(str(source.get("calibration_age_days")))
    except ValueError:
        age_days = math.nan
    serial = str(source.get("serial") or "")
    return RecordedCamera(serial, calibrated, age_days) if is_moment(calibrated) else RecordedCamera(serial)


@dataclass(frozen=True, slots=True)
class SessionResults:
    """Results of a session."""

    session_id: str
    subject_id: str
    when: datetime
    side: Side
    protocol: str
    exercise: Exercise
    duration_s: float
    is_recovered: bool
    is_smoothed: bool
    software_version: str
    start_angles_deg: FloatArray
    repetitions: tuple[RepetitionResult, ...]
    measures: tuple[Measure, ...]
    quality: RecordingQuality
    pain_scores: tuple[int, ...]
    notes: tuple[tuple[float, str], ...]
    findings: tuple[CalibrationFinding, ...] = ()
    """Doubts of the calibration."""
    is_simulated: bool = False
    is_excluded: bool = False
    """A person excluded the session."""
    is_superseded: bool = False
    """There is a newer result of the same recording."""
    targets_deg: tuple[float, float] = (math.nan, math.nan)
    """Targets of the trained angle in its positive and negative direction, signed; NaN for none."""
    pain_times_s: tuple[float, ...] = ()
    """Time of each of ``pain_scores`` after the first frame."""
    no_repetitions_reason: NoRepetitionReason | None = None
    """Why there is no repetition; None if there are some or none are counted."""
    occluded_s: float = 0.0
    """Time in which nothing was seen for longer than repetitions can be counted across."""
    recording_id: str = ""
    created: datetime | None = None
    """When this result of the recording was computed."""
    angle_order: AngleOrder = "zyx"
    earlier_results: int = 0
    """Number of earlier results of the same recording, which do not count."""
    error_limits: ErrorLimits = DEFAULT_LIMITS
    """Limits of changes."""
    camera: RecordedCamera = UNKNOWN_CAMERA
    correction: CorrectionSummary | None = None
    """From when on markers were corrected by a person; None as measured."""
    excludes_passive: bool = False
    """Ranges over the whole recording leave out passive stretches."""
    _by_key: Mapping[MeasureKey, Measure] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_by_key", {one.key: one for one in self.measures if not one.is_passive})

    @property
    def study(self) -> RetestStudy | None:
        """The clinic's own test-retest study of such sessions, None for the default limits."""
        return self.error_limits.study(self.protocol, self.exercise.id, self.angle_order)

    @property
    def repetition_count(self) -> int:
        return sum(repetition.is_counted for repetition in self.repetitions)

    @property
    def main_angle(self) -> str:
        """Trained joint or wrist angle, empty if there is none."""
        exercise = self.exercise
        return exercise.joint or ("" if exercise.angle is None else WRIST_ANGLES[exercise.angle])

    @property
    def has_passive(self) -> bool:
        """True if somebody else moved the hand in some repetitions."""
        return any(repetition.is_passive for repetition in self.repetitions)

    def find(self, of: str, what: str) -> Measure | None:
        """Return the measure of an angle, joint or path, without passive ones."""
        return self._by_key.get((of, what))

    def measures_in_group(self, group: Group) -> tuple[Measure, ...]:
        """Return all measures of a group, without passive ones."""
        return tuple(one for one in self.measures if one.group == group and not one.is_passive)

    @property
    def wrist_ranges(self) -> tuple[Measure, ...]:
        return tuple(one for one in self.measures_in_group("range") if one.wrist_angle >= 0)

    @property
    def joint_ranges(self) -> tuple[Measure, ...]:
        """Arc, largest and smallest angle of every joint, and every finger's TAM."""
        return tuple(one for one in self.measures_in_group("range") if one.wrist_angle < 0)

    def speed_measure(self, what: str) -> Measure | None:
        """Return one of :data:`SPEED_MEASURES`, None if no stroke was measured."""
        return next((one for one in self.measures_in_group("speed") if one.quantity == what), None)

    def passive_results(self) -> SessionResults | None:
        """Return the results of the passive repetitions alone, None without any."""
        if not self.has_passive:
            return None
        repetitions = (
            replace(one, exclusion_reason="" if one.is_passive else one.exclusion_reason or ACTIVE)
            for one in self.repetitions
        )
        measures = (replace(one, is_passive=False) for one in self.measures if one.is_passive)
        return replace(self, repetitions=tuple(repetitions), measures=tuple(measures))


def compute_session_results(
    session: Session, choices: RepetitionChoices | None = None, error_limits: ErrorLimits = DEFAULT_LIMITS
) -> SessionResults:
    """Compute all results of a session with a person's choices."""
    choices, header, attempts = choices or RepetitionChoices(), session.header, GuardedComputation()
    seen = MeasurableSession.from_session(session)
    trained = attempts.compute("repetitions", lambda: find_trained_angle(seen), None)
    repetitions: tuple[RepetitionResult, ...] = ()
    if trained is not None:
        repetitions = attempts.compute("repetitions", lambda: measure_repetitions(trained, choices), ())
    counted = tuple(one.window for one in repetitions if one.is_counted)
    helped = tuple(one.window for one in repetitions if one.is_passive)
    active = mask_passive(session, repetitions)
    own = seen if active is session else MeasurableSession.from_session(active)
    over = seen if counted else own

    def measure_ranges(of: MeasurableSession, windows: Sequence[Repetition]) -> tuple[Measure, ...]:
        wrist = attempts.compute("ranges", lambda: measure_wrist_ranges(of, windows), ())
        joints = attempts.compute("ranges of joints", lambda: measure_joint_ranges(of.tracks, windows, of.exercise), ())
        return wrist + joints

    rows = measure_ranges(over, counted)
    if not counted and any(one.is_whole for one in repetitions):
        rows = ()  # all were left out: nothing is measured, least of all the whole recording
    passive = measure_ranges(seen, helped) if helped else ()
    still = attempts.compute("other movements", lambda: measure_still_angles(own), ())
    speeds: tuple[Measure, ...] = ()
    if trained is not None:
        speeds = attempts.compute("speed", lambda: summarise_strokes(trained.name, full_strokes(repetitions)), ())
    unknown = RecordingQuality(len(session), math.nan, math.nan, 0, *(math.nan,) * 5)
    quality = attempts.compute("quality", lambda: assess_quality(seen, repetitions), unknown)
    shares = attempts.compute("grades", lambda: compute_total_shares(rows, seen.exercise), ())
    uncounted: NoRepetitionReason | None = None
    if trained is not None:
        uncounted = attempts.compute(
            "repetitions", lambda: explain_no_repetitions(trained.measured, trained.detected), None
        )
    elif seen.exercise.angle is not None or seen.exercise.joint in seen.tracks:
        uncounted = "nothing_seen"
    task = (*compute_task_measures(MeasureInput(own, trained, repetitions, choices)), *attempts.to_measures())
    pains = [(time_s, int(text)) for time_s, text in _events_of_kind(session, "pain") if text.isdigit()]
    return SessionResults(
        session_id=header.session_id,
        subject_id=header.subject_id,
        when=header.recording_time,
        side=header.hand,
        protocol=header.protocol.name,
        exercise=seen.exercise,
        duration_s=float(session.timestamp_s[-1] - session.timestamp_s[0]) if len(session) else 0.0,
        is_recovered=bool(session.recovered),
        is_smoothed=session.smoothed is not None,
        software_version=header.software_version,
        start_angles_deg=np.degrees(session.calibration.start_angles_rad),
        repetitions=repetitions,
        measures=(*rows, *(replace(one, is_passive=True) for one in passive), *task, *shares, *speeds, *still),
        quality=quality,
        no_repetitions_reason=uncounted,
        occluded_s=sum(end - start for start, end in trained.detected.occluded_s) if trained is not None else 0.0,
        pain_scores=tuple(score for _, score in pains),
        pain_times_s=tuple(time_s for time_s, _ in pains),
        notes=tuple(note for note in _events_of_kind(session, "note") if note[1] and len(session)),
        findings=session.calibration.verdict.findings,
        is_simulated=header.is_simulated,
        is_excluded=choices.is_session_excluded,
        targets_deg=to_clinical_targets_deg(header.targets_deg, seen.exercise),
        recording_id=header.recording_id,
        created=datetime.fromisoformat(header.created),
        angle_order=session.angle_order,
        error_limits=error_limits,
        camera=parse_camera(header.parameters),
        correction=summarize_corrections(session),
        excludes_passive=not counted and own is not seen,
    )


def compute_data_digest(session: Session) -> str:
    """Compute SHA-256 over times, status and angles: reports with the same digest show the same data."""
    digest = hashlib.sha256()
    motion = motion_estimate(session)
    for array in (
        session.timestamp_s,
        np.asarray(session.status, dtype=np.int64),
        motion.angles_rad,
        motion.angles_sd_rad,
    ):
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


def _events_of_kind(session: Session, kind: str) -> list[tuple[float, str]]:
    """Return times after the first frame and texts of events of a kind."""
    start_s = float(session.timestamp_s[0]) if len(session) else math.nan
    return [(event.time_s - start_s, event.text) for event in session.events if event.kind == kind]

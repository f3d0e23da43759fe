"""Stand-ins for camera, register and files: a simulated patient whose true motion plays the tracker's part."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, replace
from datetime import date, datetime, timedelta, timezone
from functools import lru_cache
from pathlib import Path

import numpy as np

from carpus.core.calibration.calibrate import MeasuredHand, MeasurementNoise
from carpus.core.calibration.hand_calibrator import FoundMarker
from carpus.core.calibration.result import Calibration, CalibrationFinding, Clicks, Verdict
from carpus.core.measures.change_limits import DEFAULT_LIMITS, ErrorLimits
from carpus.core.measures.manual_measurements import ManualValue
from carpus.core.model.camera import Camera
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.types import (
    ByteImage,
    Detections,
    FloatArray,
    Frame,
    KinematicState,
    Side,
    TrackedFrame,
    TrackStatus,
)
from carpus.core.pipeline.live_values import LiveCounters, LiveEvent, TrackedView
from carpus.core.records.corrections import Corrections
from carpus.core.records.patients import Patients
from carpus.core.records.session_setup import PRACTICE_PATIENT, SessionSetup
from carpus.core.records.values import Onset, Patient, SessionEntry
from carpus.core.research.agreement.retest import ExcludedSession, RetestAnalysis, RetestResult
from carpus.core.results.measure import Measure
from carpus.core.results.progress import Comparison
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.session_results import SessionResults, compute_session_results
from carpus.core.session.values import Event, MarkerSeries, Motion, QualitySeries, Session, SessionHeader, stack_states
from carpus.core.simulation.recording import SimulatedRecording
from carpus.core.simulation.spec import RecordingSpec
from carpus.ui.kit.language import current_language
from carpus.ui.report.home_page import HomeProgress, HomeReport, HomeTask
from carpus.ui.report.session_page import build_session_report
from carpus.ui.screens.patients.patient_store import MAX_LISTED_PATIENTS, MeasureWithChange, PatientCard

FPS = 30.0
NOW = datetime(2026, 11, 20, 11, 36, tzinfo=timezone(timedelta(hours=1)))
SESSION_ID = "3f9c1e7a-0000-4000-8000-000000000007"
SD_DEG = np.array([0.5, 1.6, 2.6])


@lru_cache(maxsize=32)
def simulated(
    motion: str = "flexion",
    seconds: float = 20.0,
    speed_hz: float = 0.16,
    side: str = "right",
    protocol: str = "wrist6",
) -> SimulatedRecording:
    """A bright, near, large hand: pictures by their number and the true motion."""
    spec = RecordingSpec(
        seed=5, hand=side, motion=motion, seconds=seconds, speed_hz=speed_hz, protocol=protocol, light="bright",  # type: ignore[arg-type]
        skin_tone=1, distance_m=0.62, hand_length_mm=196.0, yaw_deg=3.0, tilt_deg=4.0, sleeve="none",
    )  # fmt: skip
    return SimulatedRecording(spec)


@lru_cache(maxsize=32)
def picture(pictures: SimulatedRecording | None = None, number: int = 0) -> ByteImage:
    """One colour picture, of flexion unless told otherwise."""
    pictures = pictures or simulated()
    return pictures.apply_sensor(number, pictures.render_clean(number))[0]


@lru_cache(maxsize=32)
def tracked_frames(
    pictures: SimulatedRecording,
    hidden: tuple[tuple[float, float, str], ...] = (),
    lost: tuple[tuple[float, float], ...] = (),
) -> list[TrackedFrame]:
    """The true motion with noise as the tracker would tell it.

    ``hidden`` (start_s, end_s, marker), ``lost`` (start_s, end_s).
    """
    truth = pictures.truth
    rng = np.random.default_rng(1)
    markers = pictures.spec.marker_protocol.markers
    noise = np.cumsum(rng.normal(0.0, 0.12, (len(truth.time_s), 3)), axis=0)
    noise -= np.linspace(0, 1, len(noise))[:, None] * noise[-1]
    angles = truth.angles_rad + np.radians(np.clip(noise, -2.0, 2.0) * SD_DEG / 2.6)
    covered_since = np.zeros(len(markers))
    out = []
    for k, time_s in enumerate(truth.time_s):
        covered = np.array([any(a <= time_s < b and name == marker for a, b, marker in hidden) for name in markers])
        covered_since = np.where(covered, covered_since + 1 / FPS, 0.0)
        is_lost = any(a <= time_s < b for a, b in lost)
        measured = truth.marker_px[k] + rng.normal(0.0, 0.2, (len(markers), 2))
        measured[covered | is_lost] = math.nan
        predicted_only = int(np.isfinite(measured[:, 0]).sum()) < 3
        status = TrackStatus.LOST if is_lost else TrackStatus.PREDICTED if predicted_only else TrackStatus.TRACKED
        growth = 1.0 + 0.7 * float(covered_since.max()) + 0.35 * abs(math.sin(time_s))
        unknown = math.nan if is_lost else 1.0
        out.append(
            TrackedFrame(
                index=k,
                timestamp_s=float(truth.timestamp_s[k]),
                status=status,
                kinematics=KinematicState(
                    position_m=truth.position_m[k] * unknown,
                    velocity_m_s=truth.velocity_m_s[k] * unknown,
                    w0_turn_rad=np.zeros(3) * unknown,
                    rotation_w2_w0=truth.rotation_w2_w0[k] * unknown,
                    angular_velocity_rad_s=truth.angular_velocity_rad_s[k] * unknown,
                    angles_rad=angles[k] * unknown,
                    angles_sd_rad=np.radians(SD_DEG) * growth * unknown,
                    angles_zyz_rad=np.full(3, math.nan),
                    joint_angles_rad=truth.joint_angles_rad[k] * unknown,
                    joint_angles_sd_rad=joint_sds_rad(pictures, covered_since) * unknown,
                    joint_velocity_rad_s=truth.joint_velocity_rad_s[k] * unknown,
                    joint_position_m=truth.joint_position_w0_m[k][: len(markers) if len(truth.joint_names) else 0]
                    * unknown,
                ),
                marker_position_cam_m=truth.marker_position_cam_m[k] * unknown,
                marker_predicted_px=truth.marker_px[k] * unknown,
                marker_measured_px=measured,
                marker_measured_depth_m=np.where(
                    np.isfinite(measured[:, 0]), truth.marker_position_cam_m[k][:, 2], math.nan
                ),
                detections=Detections.none(),
                dropped_before=0,
                measured_share=np.ones(3),
                nis=6.0,
                nis_dof=12,
            )
        )
    return out


def joint_sds_rad(pictures: SimulatedRecording, covered_since_s: np.ndarray) -> np.ndarray:
    """Two degrees, growing by ten degrees a second while the finger's farther discs are covered."""
    markers, names = pictures.spec.marker_protocol.markers, pictures.truth.joint_names
    hidden_s = []
    for name in names:
        finger = name.split("_")[0][-1]
        farther = [k for k, one in enumerate(markers) if one[-1] == finger and one[:3] not in ("MCP", "CMC")]
        hidden_s.append(covered_since_s[farther].max())
    return np.radians(2.0 + np.minimum(10.0 * np.array(hidden_s), 14.0)) if len(names) else np.empty(0)


def calibration(pictures: SimulatedRecording) -> Calibration:
    """A perfect calibration on the first picture."""
    truth, spec = pictures.truth, pictures.spec
    count = len(spec.marker_protocol.markers)
    verdict = Verdict(np.full(count, 0.4), 184.0, 4.0, 0.66, 15, ())
    return Calibration(
        clicks=Clicks(spec.hand, spec.marker_protocol, truth.marker_px[0]),
        marker_position_w0_m=truth.marker_position_w0_m,
        rotation_w0_cam=truth.rotation_w0_cam,
        translation_w0_cam_m=truth.translation_w0_cam_m,
        marker_covariance_w0_m2=np.tile(np.eye(3) * 1e-6, (count, 1, 1)),
        start_angles_rad=np.zeros(3),
        verdict=verdict,
    )


def set_up(exercise: str = "WRIST_FE", target_deg: float = 60.0) -> SessionSetup:
    return SessionSetup("linden", "Linden 42", "right", get_exercise(exercise), 10, target_deg, math.nan)


class FakeFeed:
    """A live session without threads: :meth:`step` lets time pass."""

    def __init__(
        self,
        motion: str = "flexion",
        seconds: float = 20.0,
        hidden: Sequence[tuple[float, float, str]] = (),
        lost: Sequence[tuple[float, float]] = (),
        protocol: str = "wrist6",
        speed_hz: float = 0.16,
    ) -> None:
        self.pictures = simulated(motion, seconds, speed_hz, protocol=protocol)
        self.frames = list(tracked_frames(self.pictures, tuple(hidden), tuple(lost)))
        self.place = -1
        self.is_recording = False
        self.is_paused = False
        self.first_recorded = 0
        self.events: list[LiveEvent] = []
        self.noted: list[tuple[str, str]] = []
        self.told: list[tuple[str, float]] = []
        self.picture_number: int | None = None

    @property
    def first_recorded_index(self) -> int | None:
        return self.first_recorded if self.is_recording else None

    def step(self, frames: int = 1) -> None:
        self.place = min(self.place + frames, len(self.frames) - 1)

    def _frame(self, place: int) -> Frame:
        number = place if self.picture_number is None else self.picture_number
        return Frame(place, self.frames[place].timestamp_s, picture(self.pictures, number), None, 0.001)

    def current_frame(self) -> Frame | None:
        return self._frame(max(self.place, 0))

    def current_view(self) -> TrackedView | None:
        return None if self.place < 0 else TrackedView(self._frame(self.place), self.frames[self.place], 0.0)

    def frames_since(self, index: int) -> list[TrackedFrame]:
        return [frame for frame in self.frames[: self.place + 1] if frame.index > index]

    def drain_events(self) -> list[LiveEvent]:
        events, self.events = self.events, []
        return events

    def counters(self) -> LiveCounters:
        return LiveCounters(
            captured=self.place,
            tracked=self.place,
            dropped=0,
            missing=0,
            fps=30.0,
            frames_waiting=0,
            tracking_lag_s=0.0,
            is_recording=self.is_recording,
            disk_minutes_left=212.0,
        )

    def add_event(self, kind: str, text: str = "") -> bool:
        self.noted.append((kind, text))
        return self.is_recording

    def notify_listener(self, kind: str, at_s: float) -> None:
        self.told.append((kind, at_s))

    def pause_recording(self) -> None:
        self.is_paused = True

    def resume_recording(self) -> None:
        self.is_paused = False


class LateFeed(FakeFeed):
    """The camera is ahead of the tracker."""

    ahead_s = 0.0
    dropped = 0
    waiting = 0

    def current_frame(self) -> Frame | None:
        frame = super().current_frame()
        return None if frame is None else replace(frame, timestamp_s=frame.timestamp_s + self.ahead_s)

    def counters(self) -> LiveCounters:
        left_s = self.waiting / 100.0
        return replace(super().counters(), dropped=self.dropped, frames_waiting=self.waiting, tracking_lag_s=left_s)


def with_other_spot(feed: FakeFeed, marker: int, from_s: float, *, taken: bool, off_px: tuple[float, float]) -> None:
    """From a time on a marker is hidden while another blue spot lies by it, or with ``taken`` it is doubted."""
    for number, frame in enumerate(feed.frames):
        if number < from_s * FPS:
            continue
        measured = frame.marker_measured_px.copy()
        spot = frame.marker_predicted_px[marker] + off_px
        if not taken:
            measured[marker] = math.nan
        pixel = np.vstack((measured[np.isfinite(measured[:, 0])], spot))
        spots = Detections(pixel, *np.ones((4, len(pixel))))
        rows = np.arange(len(measured)) == marker
        feed.frames[number] = replace(
            frame,
            marker_measured_px=measured,
            detections=spots,
            doubted=rows if taken else frame.doubted,
            is_rejected=np.zeros(len(pixel), dtype=bool),
            status=TrackStatus.DOUBTFUL if taken else frame.status,
        )


class FakeMeasuring:
    """An open simulated source with a perfect calibration."""

    def __init__(self, feed: FakeFeed) -> None:
        self.feed = feed
        self.camera: Camera = feed.pictures.truth.camera
        self.calibration: Calibration | None = calibration(feed.pictures)
        self.fault: Exception | None = None
        self.closed = False

    is_playback = False

    def set_exercise(self, set_up: SessionSetup) -> None:
        self.chosen = set_up

    def start_recording(self) -> None:
        if self.fault is not None:
            raise self.fault
        self.feed.is_recording = True

    def stop_recording(self) -> str:
        self.feed.is_recording = self.feed.is_paused = False
        if self.fault is not None:
            raise self.fault
        return "session-7"

    def close(self) -> None:
        self.closed = True


def cache_sessions(make: Callable[..., Session]) -> Callable[..., Session]:
    """Makes each session once; whoever would change an array that other tests see too is stopped."""

    @lru_cache(maxsize=64)
    def one(*values: object, **named: object) -> Session:
        made = make(*values, **named)
        for part in (made, made.motion, made.markers, made.quality):
            for array in (getattr(part, field.name) for field in fields(part)):
                if isinstance(array, np.ndarray):
                    array.flags.writeable = False
        return made

    def hashable(value: object) -> object:
        return tuple(value) if isinstance(value, list) else value

    return lambda *values, **named: one(*map(hashable, values), **{key: hashable(v) for key, v in named.items()})


def build_session(
    pictures: SimulatedRecording, when: datetime, exercise: str, session_id: str, events: tuple[Event, ...], *,
    status: np.ndarray, motion: Motion, markers: MarkerSeries, quality: QualitySeries,
) -> Session:  # fmt: skip
    """A complete session of Linden 42 with what was measured in it."""
    header = SessionHeader(
        session_id=session_id, subject_id="Linden 42", created=when.isoformat(timespec="seconds"),
        hand=pictures.spec.hand, protocol=pictures.spec.marker_protocol, exercise=exercise, software_version="1.0.0",
        parameters="{}", joint_names=pictures.truth.joint_names, recording_id=f"{session_id} {when}",
    )  # fmt: skip
    return Session(
        path=Path("none.h5"), header=header, camera=pictures.truth.camera, calibration=calibration(pictures),
        timestamp_s=pictures.truth.timestamp_s, status=status, motion=motion, markers=markers, quality=quality,
        events=events, smoothed=None, recovered="",
    )  # fmt: skip


@cache_sessions
def session(
    when: datetime = NOW,
    scale: float = 1.0,
    seconds: float = 62.0,
    exercise: str = "WRIST_FE",
    session_id: str = SESSION_ID,
    side: str = "right",
    motion: str = "flexion",
    speed_hz: float = 0.165,
    hidden: Sequence[tuple[float, float, str]] = (),
    lost: Sequence[tuple[float, float]] = (),
    events: Sequence[Event] = (),
) -> Session:
    """A stored session of the simulated patient, its angles scaled to a share of the full range."""
    pictures = simulated(motion, seconds, speed_hz, side)
    status, moved, markers, quality = _stack_frames(pictures, tuple(hidden), tuple(lost))
    scaled = replace(moved, angles_rad=scale * moved.angles_rad)
    return build_session(
        pictures, when, exercise, session_id, tuple(events), status=status, motion=scaled, markers=markers,
        quality=quality,
    )  # fmt: skip


@lru_cache(maxsize=32)
def _stack_frames(
    pictures: SimulatedRecording, hidden: tuple[tuple[float, float, str], ...], lost: tuple[tuple[float, float], ...]
) -> tuple[np.ndarray, Motion, MarkerSeries, QualitySeries]:
    frames, count = tracked_frames(pictures, hidden, lost), len(pictures.truth.time_s)
    names = ("marker_position_cam_m", "marker_measured_px", "marker_measured_depth_m", "doubted")
    return (
        np.array([int(frame.status) for frame in frames]),
        stack_states(frames),
        MarkerSeries(*(np.array([getattr(frame, name) for frame in frames]) for name in names)),
        QualitySeries(np.zeros(count, int), np.ones((count, 3)), np.full(count, 6.0), np.full(count, 12)),
    )


_FIGURES: dict[tuple[int, str, str], tuple[Session, SessionResults]] = {}
_MOST_FIGURES = 128


def figures_once(
    made: Session, choices: RepetitionChoices | None = None, limits: ErrorLimits = DEFAULT_LIMITS
) -> SessionResults:
    """What :func:`compute_session_results` makes of a session, computed once: nobody changes a session."""
    key = id(made), repr(choices), repr(limits)
    known = _FIGURES.get(key)
    if known is None:
        known = _FIGURES[key] = made, compute_session_results(made, choices, limits)
        if len(_FIGURES) > _MOST_FIGURES:
            _FIGURES.pop(next(iter(_FIGURES)), None)
    return known[1]


WHY = {
    "Heron 17": ("Flexor tendon repair", 7), "Quartz 08": ("Wrist sprain", 5),
    "Maple 63": ("Thumb base joint replaced", 9), "Otter 29": ("Rheumatoid arthritis", 0),
    "Linden 42": ("Wrist fracture, plate", 13), "Juniper 31": ("Forearm fracture, plate", 22),
}  # fmt: skip


ENTERED = {
    "de": {
        "Flexor tendon repair": "Beugesehnennaht", "Wrist sprain": "Handgelenkdistorsion",
        "Thumb base joint replaced": "Daumensattelgelenkprothese", "Rheumatoid arthritis": "Rheumatoide Arthritis",
        "Wrist fracture, plate": "Radiusfraktur, Platte", "Forearm fracture, plate": "Unterarmfraktur, Platte",
        "Splint off since Monday. Forearm strapped, 10 cm wedge.":
            "Seit Montag ohne Schiene. Unterarm fixiert, 10-cm-Keil.",
        "10 repetitions": "10 Wiederholungen", "Flexion": "Flexion", "pain": "Schmerz",
        "markers lost": "Marker verloren",
        "Repetition 7 stopped for pain.": "Wiederholung 7 wegen Schmerz abgebrochen.",
        "mean of 9 repetitions; repetition 7 excluded: pain":
            "Mittel aus 9 Wiederholungen; Nummer 7 ausgeschlossen: Schmerz",
        "13 Nov": "13. Nov.", "Saved 11:37": "Gespeichert 11:37", "Space for 212 min": "Platz für 212 min",
    },
    "it": {
        "Flexor tendon repair": "Sutura dei flessori", "Wrist sprain": "Distorsione del polso",
        "Thumb base joint replaced": "Protesi trapezio-metacarpale", "Rheumatoid arthritis": "Artrite reumatoide",
        "Wrist fracture, plate": "Frattura del radio, placca",
        "Forearm fracture, plate": "Frattura dell’avambraccio, placca",
        "Splint off since Monday. Forearm strapped, 10 cm wedge.":
            "Senza tutore da lunedì. Avambraccio fissato, cuneo di 10 cm.",
        "10 repetitions": "10 ripetizioni", "Flexion": "Flessione", "pain": "dolore", "markers lost": "marcatori persi",
        "Repetition 7 stopped for pain.": "Ripetizione 7 interrotta per dolore.",
        "mean of 9 repetitions; repetition 7 excluded: pain": "media di 9 ripetizioni; numero 7 esclusa: dolore",
        "13 Nov": "13 nov", "Saved 11:37": "Salvata 11:37", "Space for 212 min": "spazio per 212 min",
    },
}  # fmt: skip
"""What a person entered, and what flows say elsewhere, by the window's language."""


def entered(text: str) -> str:
    """Return words of the data in the window's language."""
    return ENTERED.get(current_language(), {}).get(text, text)


def _rows() -> list[Patient]:
    def row(key: str, name: str, side: str, exercise: str, days: int, count: int) -> Patient:
        why, since = WHY.get(name, ("", 0))
        day = (NOW - timedelta(weeks=since)).date() if since else None
        onset: Onset = "operation" if since else ""
        return Patient(
            name, side, "right", diagnosis=entered(why), onset=onset, onset_day=day,  # type: ignore[arg-type]
            patient_id=key, session_count=count, last_session=NOW - timedelta(days=days), last_exercise=exercise,
        )  # fmt: skip

    return [
        row("heron", "Heron 17", "left", "FOREARM_PS", 1, 3),
        row("quartz", "Quartz 08", "right", "WRIST_RU", 1, 11),
        row("maple", "Maple 63", "right", "WRIST_FE", 2, 2),
        row("otter", "Otter 29", "both", "WRIST_FE", 3, 9),
        row("cobalt", "Cobalt 54", "left", "FREE", 4, 5),
        row("linden", "Linden 42", "right", "WRIST_FE", 7, 6),
        row("juniper", "Juniper 31", "right", "FOREARM_PS", 8, 14),
    ]


class FakeStore:
    """A register in memory."""

    def __init__(self, rows: Sequence[Patient] | None = None) -> None:
        self.rows = list(_rows() if rows is None else rows)
        self.added: list[Patient] = []
        self.register = self
        self.in_archive: list[str] = []
        self.listed = ["Wrist fracture, plate", "Wrist fracture, cast", "Flexor tendon repair"]

    def list_patients(self, search: str = "") -> list[Patient]:
        words = search.casefold().split()
        return [one for one in self.rows if all(word in one.pseudonym.casefold() for word in words)][
            :MAX_LISTED_PATIENTS
        ]

    def list_archived_names(self) -> list[str]:
        return list(self.in_archive)

    def get(self, patient_id: str) -> Patient:
        practice = Patient("practice", "right", patient_id=PRACTICE_PATIENT)
        return next(row for row in (*self.rows, practice) if row.patient_id == patient_id)

    def card(self, patient_id: str) -> PatientCard:
        if patient_id == PRACTICE_PATIENT:
            return PatientCard(Patient("practice", "right", patient_id=PRACTICE_PATIENT))
        row = next(row for row in self.rows if row.patient_id == patient_id)
        if row.last_session is None:
            return PatientCard(row)
        results = [_result("flexion", 55, 21, "improved"), _result("extension", 43, 5, "no_change")]
        note = entered("Splint off since Monday. Forearm strapped, 10 cm wedge.")
        return PatientCard(row, results, entered("10 repetitions"), note, row.last_session, picture())

    def suggest_pseudonym(self) -> str:
        return f"Alder {51 + len(self.added)}"

    def add(self, patient: Patient) -> str:
        self.added.append(patient)
        key = f"new-{len(self.added)}"
        self.rows.insert(0, replace(patient, patient_id=key))
        return key

    def change(self, patient: Patient) -> None:
        self.rows = [patient if one.patient_id == patient.patient_id else one for one in self.rows]

    save = Patients.save

    def diagnoses(self) -> list[str]:
        return list(self.listed)

    def set_diagnosis_listed(self, words: str, *, is_listed: bool) -> None:
        self.listed = [*(one for one in self.listed if one != words), *([words] if is_listed else [])]


def _result(movement: str, mean_deg: float, change_deg: float, verdict: str) -> MeasureWithChange:
    row = Measure("range", "flexion", movement, "deg", (mean_deg,) * 10, mean_deg, 3.0)
    return row, Comparison(replace(row, mean=mean_deg - change_deg), row, 10.0, verdict)  # type: ignore[arg-type]


class FakeCalibrator:
    """Knows where the discs are; judges as it is told."""

    def __init__(self, motion: str = "flexion", is_live: bool = False, protocol: str = "wrist6") -> None:
        self.pictures = simulated(motion, protocol=protocol)
        self.is_live = is_live
        self.side = self.pictures.spec.hand
        self.protocol = self.pictures.spec.marker_protocol
        self.findings: tuple[CalibrationFinding, ...] = ()
        self.doubtful: tuple[str, ...] = ()
        self.not_found: tuple[str, ...] = self.protocol.markers if protocol == "wrist6" else ()
        """Not proposed: of six discs a test asks for proposals."""
        self.begun: Calibration | None = None
        self.judged: list[Clicks] = []
        self.angles: list[np.ndarray] = []

    @property
    def disc_px(self) -> np.ndarray:
        return self.pictures.truth.marker_px[0]

    def current_frame(self) -> Frame:
        return Frame(0, 0.0, picture(self.pictures), None, 0.001)

    freeze_frame = current_frame

    previous_straight_fingers = (True, True, True, True, True)

    def candidate_px(self) -> np.ndarray:
        return self.disc_px

    def hand_area(self) -> np.ndarray:
        return np.array([self.disc_px.min(axis=0), self.disc_px.max(axis=0)])

    def find_marker(self, pixel: np.ndarray) -> FoundMarker | None:
        distance = np.linalg.norm(self.disc_px - pixel, axis=1)
        nearest = int(distance.argmin())
        return FoundMarker(self.disc_px[nearest], 10.0) if distance[nearest] < 8.0 else None

    def propose_labels(self, named: Mapping[str, np.ndarray]) -> dict[str, FoundMarker]:
        return {
            name: FoundMarker(pixel, 10.0, name not in self.doubtful)
            for name, pixel in zip(self.protocol.markers, self.disc_px, strict=True)
            if name not in named and name not in self.not_found
        }

    def assess(self, clicks: Clicks, start_angles_rad: np.ndarray) -> MeasuredHand:
        self.judged.append(clicks)
        self.angles.append(start_angles_rad)
        perfect = calibration(self.pictures)
        verdict = replace(perfect.verdict, findings=self.findings)
        tilt = next((finding for finding in self.findings if finding.kind == "tilt"), None)
        if tilt is not None:
            verdict = replace(verdict, tilt_deg=tilt.value)
        return MeasuredHand(verdict, perfect if verdict.can_start else None, MeasurementNoise())

    def start_tracking(self, calibration: Calibration) -> None:
        self.begun = calibration


@lru_cache(maxsize=1)
def sessions_of_linden() -> Mapping[str, Session]:
    """Made once, so that their figures are too."""
    days = (49, 42, 35, 28, 21, 7, 0)
    scales = (0.62, 0.66, 0.72, 0.80, 0.86, 0.97, 1.0)
    start_s = float(simulated(seconds=62.0, speed_hz=0.165).truth.timestamp_s[0])
    said = ((1.0, "pain", "2"), (61.0, "pain", "3"), (41.0, "note", "Repetition 7 stopped for pain."))
    made: dict[str, Session] = {}
    for number, (day, scale) in enumerate(zip(days, scales, strict=True), 1):
        when = NOW - timedelta(days=day)
        hidden = [(44.0, 45.2, "CMC1"), (44.3, 45.0, "WRIST")] if day == 0 else ()
        events = tuple(Event(start_s + time_s, kind, text) for time_s, kind, text in said) if day == 0 else ()
        key = f"session-{number}"
        made[key] = session(when, scale, session_id=key, hidden=hidden, events=events)
    made["session-left"] = session(NOW - timedelta(days=49), 1.25, session_id="session-left", side="left")
    far = made["session-4"]
    verdict = replace(far.calibration.verdict, distance_m=0.84)
    made["session-4"] = replace(far, calibration=replace(far.calibration, verdict=verdict))
    return made


class FakeSessions:
    """Seven sessions of Linden 42 that get better, and one of the other hand."""

    hand_values: Sequence[ManualValue] = ()

    def __init__(self, pictures: bool = True) -> None:
        self.sessions = dict(sessions_of_linden())
        self.kept: dict[str, RepetitionChoices] = {}
        self.results: list[SessionEntry] = []
        self.owners: dict[str, str] = {}
        self.pictures = pictures

    def pictures_of(self, side: str) -> SimulatedRecording:
        return simulated(seconds=62.0, speed_hz=0.165, side=side)

    def session(self, session_id: str) -> Session:
        return self.sessions[session_id]

    def results_by_id(self, session_id: str) -> SessionResults:
        return figures_once(self.session(session_id), self.choices(session_id))

    def read_frame(self, session_id: str, row: int) -> ByteImage | None:
        if not self.pictures:
            return None
        return picture(self.pictures_of(self.sessions[session_id].header.hand), row)

    def result_versions(self, session_id: str) -> list[SessionEntry]:
        return list(self.results)

    def owner_id(self, session_id: str) -> str:
        return self.owners.get(session_id, "linden")

    def choices(self, session_id: str) -> RepetitionChoices:
        return self.kept.get(session_id, RepetitionChoices())

    def save_choices(self, session_id: str, choices: RepetitionChoices) -> None:
        self.kept[session_id] = choices

    def history(self, patient_id: str) -> list[SessionResults]:
        return [figures_once(stored, self.choices(key)) for key, stored in self.sessions.items()]

    def manual_measurements(self, patient_id: str) -> list[ManualValue]:
        return list(self.hand_values)


def home_report(language: str = "", side: Side = "right", names: Sequence[str] = ("WRIST_FE",)) -> HomeReport:
    """The sheet for home of the last session, with an appointment in a week and a goal."""
    store = FakeSessions()
    made = build_session_report(store.session("session-7"), history=store.history("linden"), pseudonym="Linden 42")
    made = replace(made, results=replace(made.results, side=side))
    tasks = tuple(HomeTask(get_exercise(name), 10, 3) for name in names)
    way = HomeProgress((date(2026, 10, 2), date(2026, 11, 6), NOW.date()), (25.0, 36.0, 47.0), 60.0, True)
    return HomeReport(made, tasks, NOW.date(), date(2026, 11, 27), "11:30", "", way, language)


def hand_values_today() -> list[ManualValue]:
    """What a goniometer said on the day of the last session, of the wrist and of a finger that the camera lost."""
    said = (("FLEXION", 48.0, 60.0), ("EXTENSION", 40.0, 52.0), ("PIP4_FLEXION", 70.0, 90.0))
    return [
        ManualValue(name, way, "right", NOW.date(), (value,), rater="M. K.")
        for name, active, passive in said
        for way, value in (("active", active), ("passive", passive))
    ]


def hand_values() -> list[ManualValue]:
    """What somebody measured by hand on three days, in the order in which it was entered."""
    found = []
    for day, (flexion, passive, grip, score) in {
        date(2026, 10, 2): (25.0, 40.0, (9.0, 10.0, 9.5), 71.0),
        date(2026, 11, 13): (45.0, 56.0, (15.0, 16.0, 15.5), 52.0),
        date(2026, 11, 20): (47.0, 58.0, (18.0, 19.0, 17.0), 46.5),
    }.items():
        found += [
            ManualValue("FLEXION", "active", "right", day, (flexion,), rater="MK"),
            ManualValue("FLEXION", "passive", "right", day, (passive,), rater="MK"),
            ManualValue("GRIP", "", "right", day, grip, rater="MK"),
            ManualValue("PRWE", "", "", day, (score,), rater="MK"),
        ]
    other = ManualValue("GRIP", "", "left", date(2026, 10, 2), (34.0, 33.0, 35.0), rater="MK")
    size = ManualValue("WRIST_ROUND", "", "right", date(2026, 11, 13), (17.6,), "over both styloids", "MK")
    return [*found, other, size]


class FakeCorrections(Corrections):
    """The stored pictures of :class:`FakeSessions`, and the spots of each: all discs that were seen, and one more."""

    def __init__(self, sessions: FakeSessions, *, pictures: bool = True) -> None:
        self._sessions, self._pictures = sessions, pictures

    def read_frame(self, session_id: str, row: int) -> tuple[ByteImage | None, FloatArray]:
        places = self._sessions.session(session_id).markers.measured_px[row]
        spots = np.concatenate((places[np.isfinite(places[:, 0])], [[420.0, 120.0]]))
        return self._sessions.read_frame(session_id, row) if self._pictures else None, spots


def retest_studies() -> list[RetestAnalysis]:
    """One of ten people, with a figure of which few are sure, and one of too few."""
    ends = {
        ("flexion", "flexion"): (2.4, 6.6), ("flexion", "extension"): (2.7, 7.5), ("flexion", "arc"): (3.1, 8.6),
    }  # fmt: skip
    found = {
        key: RetestResult(
            10, 20, 0.9, (0.7, 0.97), 0.92, (0.74, 0.98), sem, (0.7 * sem, 1.6 * sem), mdc,
            (0.7 * mdc, 1.6 * mdc), math.nan, 0.2,
        )
        for key, (sem, mdc) in ends.items()
    }  # fmt: skip
    few = {key: replace(one, people=3, readings=6) for key, one in found.items()}
    found["PIP3_flexion", "arc"] = replace(found["flexion", "arc"], people=2, mdc95_interval=(7.2, 86.0))
    left = (ExcludedSession("a", "once"), ExcludedSession("b", "too_late"), ExcludedSession("c", "forearm_moved"))
    return [
        RetestAnalysis("wrist6", "WRIST_FE", "zyx", 10, 20, 2, False, found, left),
        RetestAnalysis("wrist6", "WRIST_RU", "zyx", 3, 6, 0, False, few, ()),
    ]

"""Measures besides ranges and speeds: reaches, fingertips, coordination and tremor."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import TypeVar

import numpy as np

from carpus.core.measures.coordination import (
    co_flexion,
    digit_coherence,
    enslaving_share,
    measure_tremor,
    synergy_share,
)
from carpus.core.measures.reach import TIP_NOISE, WRIST_NOISE, Reach, distance_m, find_reaches
from carpus.core.measures.signals import BoolArray, find_runs, resample_evenly
from carpus.core.measures.wrist_centre import rotation_in_w0
from carpus.core.model.hand.clinical_angles import side_sign
from carpus.core.model.hand.exercises import FLEXION
from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.hand.protocols import DIGITS
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.model.types import FloatArray
from carpus.core.results.measure import Measure, UnknownReason, summarise_values
from carpus.core.results.repetition_rows import RepetitionChoices, RepetitionResult, TrainedAngle
from carpus.core.results.valid_data import MeasurableSession, motion_estimate
from carpus.core.session.values import Motion, Session

TOUCH_DISTANCE_M = 0.015
"""Thumb tip and fingertip touch (clinical reference 8.2; both points lie under the skin)."""
RELEASE_DISTANCE_M = 0.025
"""Beyond this they are apart again, so that flicker about the limit is one touch."""
CERTAIN_SDS = 2.0
"""A hidden tip may be nearer than it is tracked by so many standard deviations."""
MAX_APERTURE_SD_M = 0.015
"""An aperture of hidden tips with a larger sd is not reported (smoothed it is at times 10 mm off)."""
TREMOR_NOISE_RAD = math.radians(0.25)
"""Frame-to-frame sd of the tracker between 3 and 12 Hz for a hand at rest."""
_THUMB_JOINTS = ("CMC1", "MCP1", "IP1")


T = TypeVar("T")
U = TypeVar("U")


@dataclass(frozen=True, slots=True)
class GuardedComputation:
    """Computes each measure separately, so that a failing one takes no other with it."""

    failed_names: list[str] = field(default_factory=list)

    def compute(self, name: str, compute: Callable[[], T], default: U) -> T | U:
        """Return what ``compute`` returns, ``default`` if it raises."""
        try:
            return compute()
        except Exception:
            logging.getLogger(__name__).exception("%s could not be computed", name)
            self.failed_names.append(name)
            return default

    def to_measures(self) -> tuple[Measure, ...]:
        """Return a measure for each computation that failed."""
        return tuple(
            Measure("task", "session", name, "", (math.nan,), math.nan, unknown_reason="failed")
            for name in self.failed_names
        )


@dataclass(frozen=True)
class MeasureInput:
    """All that a measure may need of a session.

    ``seen`` has no passive stretches, ``trained`` is None without a trained angle; ``repetitions`` are all that were
    measured, included or not, by a person's ``choices``.
    """

    seen: MeasurableSession
    trained: TrainedAngle | None = None
    repetitions: tuple[RepetitionResult, ...] = ()
    choices: RepetitionChoices = field(default_factory=RepetitionChoices)

    @property
    def session(self) -> Session:
        return self.seen.session

    @property
    def counted_repetitions(self) -> tuple[RepetitionResult, ...]:
        """Repetitions that the results include."""
        return tuple(one for one in self.repetitions if one.is_counted)

    @cached_property
    def reaches(self) -> tuple[Reach, ...]:
        """Outward and return movements of the wrist."""
        return find_session_reaches(self.session, self.seen.is_in_view)

    @cached_property
    def tips_m(self) -> FloatArray:
        """Tips (N, 5, 3) of thumb and fingers, NaN while lost or without markers."""
        motion, out = motion_estimate(self.session), np.full((len(self.session), len(DIGITS), 3), np.nan)
        for digit, chain in self.session.header.protocol.chains.items():
            out[:, digit - 1] = motion.joint_position_m[:, chain[-1]]
        out[np.asarray(self.session.status) == 2] = np.nan
        return out

    def has_tips(self, *digits: int) -> bool:
        """Return whether fingertips, 0 for the thumb, have markers and were tracked."""
        return bool(self.seen.tracks) and all(k + 1 in self.session.header.protocol.digits for k in digits)


def _task_measure(quantity: str, subject: str, values: Sequence[float], unknown_reason: UnknownReason = "") -> Measure:
    return summarise_values("task", subject, quantity, QUANTITIES[quantity].unit, values, unknown_reason=unknown_reason)


def find_session_reaches(session: Session, is_in_view: BoolArray) -> tuple[Reach, ...]:
    """Return outward and return movements of the wrist."""
    if int(np.sum(is_in_view)) < 2:
        return ()
    time_s = session.timestamp_s - session.timestamp_s[0]
    place = resample_evenly(time_s, motion_estimate(session).position_m, np.asarray(is_in_view, dtype=bool))
    return find_reaches(place, noise=WRIST_NOISE[session.smoothed is not None])


def summarise_reaches(reaches: Sequence[Reach], names: tuple[str, str] = ("reach", "return")) -> list[Measure]:
    """Summarise time, speed, straightness and smoothness of outward, then of return movements."""
    out = []
    for outward, way in zip((True, False), names, strict=True):
        some = [reach for reach in reaches if reach.is_outward is outward]
        if not some:
            continue
        for name, values in (
            ("movement time", [reach.movement_time_s for reach in some]),
            ("peak speed", [1e3 * reach.path.peak_speed_m_s for reach in some]),
            ("time to peak", [reach.path.time_to_peak_share for reach in some]),
            ("path length", [1e3 * reach.path.length_m for reach in some]),
            ("straightness", [reach.path.straightness for reach in some]),
            ("movement units", [reach.path.peaks for reach in some]),
            ("smoothness", [reach.path.sparc for reach in some]),
        ):
            out.append(_task_measure(name, way, values, _unknown_reason(name, some)))
    return out


def _unknown_reason(name: str, reaches: Sequence[Reach]) -> UnknownReason:
    seen = [reach for reach in reaches if not reach.is_occluded]
    if not seen:
        return "hidden"
    slow = all(reach.is_too_slow for reach in seen) or name in ("movement units", "smoothness")
    return "too_slow" if slow else ""


def measure_opposition(data: MeasureInput) -> list[Measure]:
    """Measure nearest distances and touches of the thumb tip, and its paths across the palm.

    The paths are in the hand's axes. Touching tips are mostly hidden from a camera above the hand: a distance counts if
    both were seen, and is unknown if they may have been nearer while hidden.
    """
    if not data.has_tips(0, 1, 2, 3, 4):
        return []
    session, tips_m, out = data.session, data.tips_m, []
    for k in range(1, 5):
        distance = distance_m(tips_m[:, 0], tips_m[:, k])
        seen = _is_tip_seen(session, 0) & _is_tip_seen(session, k) & np.isfinite(distance)
        with np.errstate(invalid="ignore"):
            nearest = distance - CERTAIN_SDS * _thumb_distance_sd_m(session, k)
            near = [
                part
                for part in find_runs(distance < RELEASE_DISTANCE_M)
                if (distance[part][seen[part]] < TOUCH_DISTANCE_M).any()
            ]
            in_touch = np.zeros(len(distance), dtype=bool)
            for part in near:
                in_touch[part] = True
            maybe = bool((~seen & ~in_touch & (nearest < TOUCH_DISTANCE_M)).any())
            least = float(distance[seen].min()) if seen.any() else math.nan
            nearer = not seen.any() or bool((~seen & (nearest < least)).any())
        if np.isfinite(distance).any():
            of = f"TIP1-TIP{k + 1}"
            out.append(_task_measure("least distance", of, (math.nan if nearer else 1e3 * least,), "hidden"))
            out.append(_task_measure("touches", of, (math.nan if maybe else float(len(near)),), "hidden"))
    place = _to_hand_axes(motion_estimate(session), _marker_index(session, "TIP1"))
    known = np.isfinite(place).all(axis=1) & (np.asarray(session.status) != 2)
    if int(known.sum()) >= 2:
        time_s = session.timestamp_s - session.timestamp_s[0]
        ulnar = np.array([0.0, -side_sign(session.header.hand), 0.0])
        hidden_s = resample_evenly(time_s, place, known & _is_tip_seen(session, 0)).gaps_s
        noise = TIP_NOISE[session.smoothed is not None]
        reaches = find_reaches(resample_evenly(time_s, place, known), ulnar, noise, hidden_s)
        out += summarise_reaches(reaches, ("thumb across", "thumb back"))
    return out


def _marker_index(session: Session, marker: str) -> int:
    return session.header.protocol.markers.index(marker)


def _is_tip_seen(session: Session, tip: int) -> BoolArray:
    """Return frames (N,) with a blob at a digit's tip, 0 for the thumb."""
    return np.asarray(
        np.isfinite(session.markers.measured_px[:, _marker_index(session, f"TIP{tip + 1}"), 0]), dtype=np.bool_
    )


def _thumb_distance_sd_m(session: Session, tip: int) -> FloatArray:
    """Return the sd (N,) of the distance between the thumb's tip and another.

    Each joint's sd times the distance of the tip from it, as if all were independent, which is an upper bound.
    """
    motion, names = motion_estimate(session), session.header.joint_names
    variance = np.zeros(len(session))
    for digit in (0, tip):
        at = motion.joint_position_m[:, _marker_index(session, f"TIP{digit + 1}")]
        for column, name in enumerate(names):
            joint = name.split("_")[0]
            if joint.endswith(str(digit + 1)):
                arm = distance_m(at, motion.joint_position_m[:, _marker_index(session, joint)])
                if joint.startswith("PIP") and f"DIP{digit + 1}_flexion" not in names:
                    end = motion.joint_position_m[:, _marker_index(session, f"DIP{digit + 1}")]
                    arm = arm + DIP_PER_PIP * distance_m(at, end)
                variance += (motion.joint_angles_sd_rad[:, column] * arm) ** 2
    return np.asarray(np.sqrt(variance))


def measure_thumb_coherence(data: MeasureInput) -> list[Measure]:
    """Measure how long the thumb was hidden and how coherent its pose was meanwhile.

    ``thumb hidden`` is the share of frames without a blob at an outer marker; the others are those of
    :func:`core.measures.coordination.digit_coherence`.
    """
    if not data.has_tips(0):
        return []
    session, motion, names = data.session, data.session.motion, data.session.header.joint_names
    columns = [k for k, name in enumerate(names) if name.split("_")[0] in _THUMB_JOINTS]
    outer = list(session.header.protocol.rows(("MCP1", "IP1", "TIP1")))
    hidden: BoolArray = np.any(~np.isfinite(session.markers.measured_px[:, outer, 0]), axis=1)
    found = digit_coherence(
        session.timestamp_s,
        [names[k] for k in columns],
        motion.joint_angles_rad[:, columns],
        motion.joint_angles_sd_rad[:, columns],
        _to_hand_axes(motion, _marker_index(session, "TIP1")),
        hidden,
        np.asarray(session.status) != 2,
    )
    if not math.isfinite(found.occluded_share):
        return []
    out = [_task_measure("thumb hidden", "thumb", (found.occluded_share,))]
    if math.isfinite(found.coherent_share):
        out.append(_task_measure("coherent though hidden", "thumb", (found.coherent_share,)))
        out.append(_task_measure("known though hidden", "thumb", (found.known_share,)))
    if found.jumps_m:
        out.append(_task_measure("jump when seen again", "TIP1", [1e3 * jump for jump in found.jumps_m]))
    return out


def _to_hand_axes(motion: Motion, joint: int) -> FloatArray:
    """Return a joint centre (N, 3) in the axes of W2."""
    turned = rotation_in_w0(motion.rotation_w2_w0, motion.w0_turn_rad)
    return np.asarray(np.einsum("nji,nj->ni", turned, motion.joint_position_m[:, joint] - motion.position_m))


TREMOR = "tremor 3-12 Hz"


def measure_wrist_tremor(data: MeasureInput) -> Sequence[Measure]:
    """Measure the tremor of a held wrist angle; none if none was held for six seconds."""
    session, angle = data.session, FLEXION if data.seen.exercise.angle is None else data.seen.exercise.angle
    time_s = session.timestamp_s - session.timestamp_s[:1]
    if len(time_s) < 2:
        return ()
    found = measure_tremor(
        resample_evenly(time_s, motion_estimate(session).angles_rad[:, angle], np.asarray(session.status) == 0),
        TREMOR_NOISE_RAD,
    )
    if found.has_few_frames:
        return (_task_measure(TREMOR, "rms", (math.nan,), "few_frames"),)
    return (_task_measure(TREMOR, "rms", (math.degrees(found.rms_rad),)),) if found.is_tremor else ()


def measure_apertures(data: MeasureInput) -> list[Measure]:
    """Measure the largest aperture of each reach; NaN if part of it was hidden or it is too uncertain."""
    if not data.has_tips(0, 1):
        return []
    session, aperture_m = data.session, distance_m(data.tips_m[:, 0], data.tips_m[:, 1])
    time_s = session.timestamp_s - session.timestamp_s[:1]
    sure = (_is_tip_seen(session, 0) & _is_tip_seen(session, 1)) | (
        _thumb_distance_sd_m(session, 1) <= MAX_APERTURE_SD_M
    )
    largest, bent = [], []
    for reach in (reach for reach in data.reaches if reach.is_outward):
        inside = (time_s >= reach.start_s) & (time_s <= reach.end_s) & np.isfinite(aperture_m)
        if inside.any():
            widest = int(np.argmax(np.where(inside, aperture_m, -math.inf)))
            known = not reach.is_occluded and bool(sure[widest])
            largest.append(1e3 * float(aperture_m[widest]) if known else math.nan)
            at = int(np.searchsorted(time_s, reach.end_s))
            angle = float(motion_estimate(session).angles_rad[min(at, len(time_s) - 1), 1])
            bent.append(math.nan if reach.is_occluded else -math.degrees(angle))
    if not largest:
        return []
    return [
        _task_measure("largest aperture", "TIP1-TIP2", largest, "hidden"),
        _task_measure("wrist extension at grasp", "wrist", bent),
    ]


def measure_spans(data: MeasureInput) -> Iterator[Measure]:
    """Measure the largest distance of two tips in frames that show both."""
    for name, one, other in (("hand span", 0, 4), *(("tip span", k - 1, k) for k in range(1, 5))):
        if data.has_tips(one, other):
            values_m = distance_m(data.tips_m[:, one], data.tips_m[:, other])
            is_known = np.isfinite(values_m) & _is_tip_seen(data.session, one) & _is_tip_seen(data.session, other)
            of = f"TIP{one + 1}-TIP{other + 1}"
            largest_m = float(np.percentile(values_m[is_known], 99.0)) if is_known.any() else math.nan
            yield _task_measure(name, of, (1e3 * largest_m,), "hidden")


def measure_coordination(data: MeasureInput) -> list[Measure]:
    """Measure co-flexion of neighbouring PIP joints, and the synergy of all fingers."""
    tracks, out = data.seen.tracks, []
    if not tracks:
        return []
    pairs = [(f"PIP{k}_flexion", f"PIP{k + 1}_flexion") for k in range(2, 5)]
    for one, other in pairs:
        a, b = tracks[one].tracked, tracks[other].tracked
        if len(a.value) != len(b.value) or not len(a.value):
            continue
        correlation, lag_s = co_flexion(a.value, b.value, a.rate_hz)
        shares = {"co-flexion": correlation, "lag": lag_s, "enslaving": enslaving_share(a.value, b.value)}
        out += [_task_measure(name, f"{one}, {other}", (value,)) for name, value in shares.items()]
    bending = [track.tracked.value for name, track in tracks.items() if name.endswith("_flexion") and name[3] in "2345"]
    if bending and len({len(values) for values in bending}) == 1 and len(bending[0]):
        out.append(_task_measure("synergy", "fingers", (synergy_share(np.column_stack(bending)),)))
    return out


@dataclass(frozen=True, slots=True)
class Quantity:
    """A measure: its name, with ``{one}`` and ``{other}`` for two digits, its unit and the decimals shown.

    ``compute`` measures it, and the quantities below it that have no function of their own; it returns no measure of a
    session that shows none. ``exercises`` that have it are named by id or by what their ``task_measures`` say; empty
    are all. ``directions`` name a positive and a negative value, ``positive`` is what a larger one means in files.
    """

    name: Phrase
    unit: str
    decimals: int = 0
    compute: Callable[[MeasureInput], Iterable[Measure]] | None = None
    exercises: tuple[str, ...] = ()
    directions: tuple[Phrase, Phrase] | None = None
    positive: str = "more"

    def measure(self, data: MeasureInput) -> list[Measure]:
        """Measure a session of an exercise that has it."""
        named = {data.seen.exercise.id, *data.seen.exercise.task_measures}
        if self.compute is None or (self.exercises and named.isdisjoint(self.exercises)):
            return []
        return list(self.compute(data))


QUANTITIES: Mapping[str, Quantity] = {
    "reaches": Quantity(
        phrase("Reaching movements"), "", compute=lambda data: summarise_reaches(data.reaches), exercises=("reaches",)
    ),
    "movement time": Quantity(phrase("Movement time"), "s", 2),
    "peak speed": Quantity(phrase("Peak speed"), "mm/s"),
    "time to peak": Quantity(phrase("Time to peak"), "share"),
    "path length": Quantity(phrase("Path length"), "mm"),
    "straightness": Quantity(phrase("Path length ratio"), "length/chord", 2),
    "movement units": Quantity(phrase("Number of speed peaks"), "1", 1),
    "smoothness": Quantity(phrase("Smoothness (SPARC)"), "SPARC", 2, positive="smoother"),
    "largest aperture": Quantity(
        phrase("Maximum grip aperture, thumb–index"), "mm", compute=measure_apertures, exercises=("reaches",)
    ),
    "wrist extension at grasp": Quantity(
        phrase("Wrist angle at grasp"), "deg", directions=(phrase("extension"), phrase("flexion"))
    ),
    "hand span": Quantity(phrase("Hand span, thumb–little"), "mm", compute=measure_spans, exercises=("spans",)),
    "tip span": Quantity(phrase("Largest span, {one}–{other}"), "mm"),
    "opposition": Quantity(phrase("Thumb opposition"), "", compute=measure_opposition, exercises=("touches",)),
    "least distance": Quantity(phrase("Smallest distance, {one}–{other}"), "mm"),
    "touches": Quantity(phrase("Touches, {one}–{other}"), "1"),
    "thumb hidden": Quantity(
        phrase("Thumb occluded"), "share", compute=measure_thumb_coherence, exercises=("thumb beside",)
    ),
    "coherent though hidden": Quantity(phrase("Plausible position while occluded"), "share"),
    "known though hidden": Quantity(phrase("Position known to within 15° while occluded"), "share"),
    "jump when seen again": Quantity(phrase("Position jump when visible again"), "mm"),
    "synergy": Quantity(
        phrase("Movement synergy (variance explained)"), "share", compute=measure_coordination, exercises=("together",)
    ),
    "co-flexion": Quantity(phrase("Correlation of flexion, {one}–{other} (r)"), "r", 2),
    "lag": Quantity(phrase("Delay of {other} after {one}"), "s", 2),
    "enslaving": Quantity(phrase("Involuntary movement of {other} with {one}"), "share"),
    TREMOR: Quantity(phrase("Tremor, 3 to 12 Hz (rms)"), "deg", 1, measure_wrist_tremor),
    # What other modules compute; if that failed, its row has nothing in it.
    "repetitions": Quantity(phrase("Repetitions"), ""),
    "ranges": Quantity(phrase("Range of motion"), ""),
    "ranges of joints": Quantity(phrase("Range of motion, fingers"), ""),
    "other movements": Quantity(phrase("Movement in the other directions"), ""),
    "speed": Quantity(phrase("Speed and smoothness"), ""),
    "quality": Quantity(phrase("Quality of the recording"), ""),
    "grades": Quantity(phrase("Grades of finger motion"), ""),
}
"""All task measures by their name in files, in the order in which they are shown."""


def compute_task_measures(data: MeasureInput) -> tuple[Measure, ...]:
    """Compute what an exercise has besides its ranges, as far as its markers show it."""
    attempts = GuardedComputation()
    found = [
        measure
        for name, quantity in QUANTITIES.items()
        for measure in attempts.compute(name, partial(quantity.measure, data), ())
    ]
    return (*found, *attempts.to_measures())

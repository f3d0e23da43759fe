"""Range of motion of an angle over its repetitions, with error bars, and of a finger (clinical reference 4.3, 5 and 6).

A joint is visible if both markers that show it, the one over it and the next distal one, are measured. Its repetitions
come from the tracked angle, also while occluded, because a fist is occluded at its very end. Values come from visible
samples only, with a note where the joint may have gone further. The sum over a finger is its total active motion (TAM).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.measures.noise import (
    MAX_CUTOFF_HZ,
    STATIC_SHARE_OF_SD,
    clean_cutoff_hz,
    estimate_extreme,
    moving_noise,
)
from carpus.core.measures.repetitions import Repetition
from carpus.core.measures.signals import MAX_ANGLE_SD_RAD, BoolArray, Signal, low_pass, resample_evenly
from carpus.core.model.hand.anatomy import HARD_LIMITS_RAD
from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.hand.protocols import markers_at_joint
from carpus.core.model.types import FloatArray, TrackStatus

MIN_REPETITIONS_FOR_SD = 3
"""Fewer repetitions have no standard deviation and are listed one by one."""
DEFAULT_STROKE_S = 1.5
"""Duration of one movement where nothing was repeated."""
MIN_VALID_SHARE = 0.7
"""Repetitions with a smaller visible share are not measured."""
MIN_VISIBLE_SHARE = 0.3
"""A joint that is visible for less of a repetition is not measured in it."""
LIMIT_TOLERANCE_RAD = math.radians(15.0)
"""Tracking error allowed beyond the anatomical limits."""
MIN_FURTHER_RAD = math.radians(5.0)
"""An occluded joint counts as limited if it may have gone further by this."""
FINGERS = (1, 2, 3, 4, 5)


@dataclass(frozen=True, slots=True)
class RangeStatistics:
    """One quantity over the repetitions: ``values`` (n,) in order, rad.

    ``measurement_sd`` is the filter's standard deviation of one value, calibration included.
    """

    values: FloatArray
    best: float
    measurement_sd: float

    @property
    def mean(self) -> float:
        """Mean over the repetitions, NaN if there is none."""
        return float(self.values.mean()) if len(self.values) else math.nan

    @property
    def spread_sd(self) -> float:
        """Standard deviation between repetitions, NaN below three."""
        return float(self.values.std(ddof=1)) if len(self.values) >= MIN_REPETITIONS_FOR_SD else math.nan


@dataclass(frozen=True, slots=True)
class MotionRange:
    """Range of motion of one angle; the arc does not depend on the day's neutral pose.

    ``repetitions`` is 0 if nothing was repeated; the values are then those of the whole recording. ``top_limited`` and
    ``bottom_limited``: the hand was occluded next to the extreme, so the true one may lie further out.
    """

    arc: RangeStatistics
    maximum: RangeStatistics
    minimum: RangeStatistics
    repetitions: int
    top_limited: bool
    bottom_limited: bool


def motion_range(
    angle: Signal, sd: Signal, repetitions: tuple[Repetition, ...], *, smoothed: bool | None = None
) -> MotionRange:
    """Measure maximum, minimum and arc of an angle in each repetition that was visible enough.

    Parameters
    ----------
    angle, sd
        low-passed angle and its standard deviation on the same time base, rad
    repetitions
        repetitions found in the angle
    smoothed
        True for the smoother's angle, False for the filter's: their noise bias of an extreme is removed; None without
    """
    usable = [rep for rep in repetitions if rep.valid_share >= MIN_VALID_SHARE]
    windows = [(rep.start_s, rep.end_s) for rep in usable]
    if not windows and angle.is_finite.any():
        windows = [(float(angle.time_s[0]), float(angle.time_s[-1]))]
    tops, bottoms, top_sds, bottom_sds = [], [], [], []
    top_limited = bottom_limited = False
    for start_s, end_s in windows:
        part, part_sd = angle.crop(start_s, end_s), sd.crop(start_s, end_s)
        if not part.is_finite.any():
            continue
        top, bottom = int(np.nanargmax(part.value)), int(np.nanargmin(part.value))
        highest, lowest = float(part.value[top]), float(part.value[bottom])
        highest_sd, lowest_sd = float(part_sd.value[top]), float(part_sd.value[bottom])
        if smoothed is not None:
            stroke_s = 0.5 * (end_s - start_s) if usable else DEFAULT_STROKE_S
            noise = moving_noise(part, part_sd, stroke_s, smoothed=smoothed)
            clean = low_pass(part, clean_cutoff_hz(stroke_s)).value
            highest, moving = estimate_extreme(part.value, clean, noise, part.rate_hz, largest=True)
            highest_sd = math.hypot(moving, STATIC_SHARE_OF_SD * highest_sd)
            lowest, moving = estimate_extreme(part.value, clean, noise, part.rate_hz, largest=False)
            lowest_sd = math.hypot(moving, STATIC_SHARE_OF_SD * lowest_sd)
        tops.append(highest)
        bottoms.append(lowest)
        top_sds.append(highest_sd)
        bottom_sds.append(lowest_sd)
        top_limited |= angle.is_near_gap(float(part.time_s[top]))
        bottom_limited |= angle.is_near_gap(float(part.time_s[bottom]))
    top_values, bottom_values = np.array(tops), np.array(bottoms)
    top_sd, bottom_sd = _rms(top_sds), _rms(bottom_sds)
    return MotionRange(
        arc=range_statistics(top_values - bottom_values, math.hypot(top_sd, bottom_sd), largest=True),
        maximum=range_statistics(top_values, top_sd, largest=True),
        minimum=range_statistics(bottom_values, bottom_sd, largest=False),
        repetitions=len(usable),
        top_limited=top_limited,
        bottom_limited=bottom_limited,
    )


def range_statistics(values: FloatArray, measurement_sd: float, *, largest: bool) -> RangeStatistics:
    """Return the statistics of values (n,) of which the largest or the smallest is the best."""
    best = float(values.max() if largest else values.min()) if len(values) else math.nan
    return RangeStatistics(values, best, measurement_sd)


_NOTHING = RangeStatistics(np.empty(0), math.nan, math.nan)
NO_RANGE = MotionRange(_NOTHING, _NOTHING, _NOTHING, 0, True, True)


def _rms(values: list[float]) -> float:
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else math.nan


@dataclass(frozen=True, slots=True)
class JointTrack:
    """Angle of one joint over the recording, rad.

    ``visible`` is low-passed, with gaps where occluded; ``tracked`` is the filter's. ``smoothed`` is True for the
    smoother's angle, False for the filter's, None for an angle without tracking noise.
    """

    name: str
    visible: Signal
    visible_sd: Signal
    tracked: Signal
    tracked_sd: Signal
    visible_share: float
    smoothed: bool | None = None

    @property
    def is_known(self) -> bool:
        return len(self.visible.time_s) > 0 and bool(self.visible.is_finite.any())


def visible_joints(joint_names: Sequence[str], markers: Sequence[str], measured_px: FloatArray) -> BoolArray:
    """Select frames and joints (N, J) whose two markers are measured in ``measured_px`` (N, M, 2)."""
    has_blob = np.isfinite(measured_px[..., 0])
    rows = [[markers.index(disc) for disc in markers_at_joint(name)] for name in joint_names]
    over, distal = np.array(rows, dtype=np.int64).reshape(-1, 2).T
    return np.asarray(has_blob[:, over] & has_blob[:, distal], dtype=np.bool_)


def valid_joints(
    status: NDArray[np.integer], visible: BoolArray, angles_rad: FloatArray, angles_sd_rad: FloatArray
) -> BoolArray:
    """Select tracked, visible samples (N, J) with a small standard deviation."""
    with np.errstate(invalid="ignore"):
        sure = np.isfinite(angles_rad) & (angles_sd_rad <= MAX_ANGLE_SD_RAD)
    return np.asarray(visible & sure & (status == TrackStatus.TRACKED)[:, None], dtype=np.bool_)


def plausible_joints(names: Sequence[str], angles_rad: FloatArray) -> BoolArray:
    """Select angles (N, J) within the anatomical limits and their tolerance.

    Others are no angles, whatever their standard deviation, such as the first frames after a long loss.
    """
    low, high = np.array([HARD_LIMITS_RAD[name] for name in names]).T
    with np.errstate(invalid="ignore"):
        is_above, is_below = angles_rad >= low - LIMIT_TOLERANCE_RAD, angles_rad <= high + LIMIT_TOLERANCE_RAD
    return np.asarray(is_above & is_below, dtype=np.bool_)


def joint_track(
    name: str,
    timestamp_s: FloatArray,
    angle_rad: FloatArray,
    sd_rad: FloatArray,
    valid: BoolArray,
    smoothed: bool | None = None,
) -> JointTrack:
    """Build the track of one joint from its columns (N,) of the session."""
    both = np.column_stack((angle_rad, sd_rad))
    visible, tracked = resample_evenly(timestamp_s, both, valid), resample_evenly(timestamp_s, both)
    angle, sd = low_pass(visible.column(0), MAX_CUTOFF_HZ), visible.column(1)
    return JointTrack(name, angle, sd, tracked.column(0), tracked.column(1), visible.valid_share, smoothed)


def joint_range(track: JointTrack, repetitions: Sequence[Repetition]) -> MotionRange:
    """Measure maximum, minimum and arc over the repetitions in which the joint is visible, or the whole recording.

    If the extremes are certainly visible in three or more repetitions, these are used. Else all are, and
    ``top_limited`` or ``bottom_limited`` tells that the joint may have gone further while occluded.
    """
    usable = _usable_repetitions(track.visible, repetitions)
    if not track.is_known or (repetitions and not usable):
        return NO_RANGE
    limits = []
    for start_s, end_s in _windows(track.visible, usable):
        part = track.visible.crop(start_s, end_s).value
        hidden = _find_occluded_samples(track.tracked, track.visible, start_s, end_s)
        angle, sd = track.tracked.value[hidden], track.tracked_sd.value[hidden]
        limits.append((_is_exceeded(angle - np.nanmax(part) + sd), _is_exceeded(np.nanmin(part) - angle + sd)))
    whole = tuple(rep for rep, limit in zip(usable, limits, strict=False) if not any(limit))
    if len(whole) >= MIN_REPETITIONS_FOR_SD:
        measured = motion_range(track.visible, track.visible_sd, whole, smoothed=track.smoothed)
        return replace(measured, top_limited=False, bottom_limited=False)
    measured = motion_range(track.visible, track.visible_sd, usable, smoothed=track.smoothed)
    top, bottom = (any(limit[end] for limit in limits) for end in (0, 1))
    return replace(measured, top_limited=top, bottom_limited=bottom)


def flexion_weights(count: int, *, inferred: bool) -> FloatArray:
    """Return the weights (count,) of a finger's joints, base first; an inferred DIP adds to the PIP."""
    weights = np.ones(count)
    weights[-1] += DIP_PER_PIP if inferred else 0.0
    return weights


def total_active_motion(
    tracks: Sequence[JointTrack], repetitions: Sequence[Repetition], *, inferred: bool
) -> MotionRange:
    """Compute the TAM of one finger (``arc``) with its flexion (``maximum``) and extension deficit (``minimum``).

    In each repetition: the largest sum of the joints' flexion less the smallest sum, which is the extension deficit;
    hyperextension counts as 0. Both need all joints visible. The values are limited where occlusions may hide more in
    more repetitions than can be excluded.

    Parameters
    ----------
    tracks
        flexion joints from the base: MCP, PIP and, if measured, DIP; MCP and IP of the thumb
    repetitions
        repetitions of the exercise
    inferred
        True if the DIP is taken as two thirds of the PIP
    """
    weight = flexion_weights(len(tracks), inferred=inferred)
    if not all(track.is_known for track in tracks):
        return NO_RANGE
    time_s, angle, angle_sd = _align_signals(
        [track.visible for track in tracks], [track.visible_sd for track in tracks]
    )
    flexion_sum = (np.maximum(angle, 0.0) * weight).sum(axis=1)
    total = Signal(time_s, flexion_sum, tracks[0].visible.rate_hz, 1.0, np.empty((0, 2)))
    variance = (angle_sd * weight) ** 2
    usable = _usable_repetitions(total, repetitions)
    is_hidden = (repetitions and not usable) or not total.is_finite.any()
    windows = [] if is_hidden else _windows(total, usable)
    found: list[tuple[float, float, float, bool]] = []
    for start_s, end_s in windows:
        part = total.crop(start_s, end_s)
        first = int(np.searchsorted(time_s, part.time_s[0]))
        top, bottom = first + int(np.nanargmax(part.value)), first + int(np.nanargmin(part.value))
        is_hyperextended = angle[bottom] <= 0.0
        error = float(variance[top].sum() + np.where(is_hyperextended, 0.0, variance[bottom]).sum())
        full, missing = float(total.value[top]), float(total.value[bottom])
        found.append((full, missing, error, _is_sum_exceeded(tracks, weight, start_s, end_s, total, full, missing)))
    whole = [item for item in found if not item[3]]
    kept = whole if len(whole) >= MIN_REPETITIONS_FOR_SD else found
    flexion, deficit = (np.array([item[k] for item in kept]) for k in (0, 1))
    sd = math.sqrt(sum(item[2] for item in kept) / len(kept)) if kept else math.nan
    limited = not kept or any(item[3] for item in kept)
    return MotionRange(
        arc=range_statistics(flexion - deficit, sd, largest=True),
        maximum=range_statistics(flexion, sd, largest=True),
        minimum=range_statistics(deficit, sd, largest=False),
        repetitions=len(usable),
        top_limited=limited,
        bottom_limited=limited,
    )


def _usable_repetitions(signal: Signal, repetitions: Sequence[Repetition]) -> tuple[Repetition, ...]:
    """Return the repetitions that are visible enough, marked as valid."""
    out = []
    for repetition in repetitions:
        count = signal.crop(repetition.start_s, repetition.end_s).is_finite.sum()
        if count and count >= MIN_VISIBLE_SHARE * (repetition.end_s - repetition.start_s) * signal.rate_hz:
            out.append(replace(repetition, valid_share=1.0))
    return tuple(out)


def _windows(signal: Signal, repetitions: Sequence[Repetition]) -> list[tuple[float, float]]:
    windows = [(rep.start_s, rep.end_s) for rep in repetitions]
    return windows or [(float(signal.time_s[0]), float(signal.time_s[-1]))]


def _is_exceeded(further_rad: FloatArray) -> bool:
    """Return whether an occluded joint may have gone further, also if nothing is known of it."""
    return bool((~np.isfinite(further_rad) | (further_rad > MIN_FURTHER_RAD)).any())


def _is_sum_exceeded(
    tracks: Sequence[JointTrack],
    weight: FloatArray,
    start_s: float,
    end_s: float,
    visible: Signal,
    top: float,
    low: float,
) -> bool:
    time_s, angle, sd = _align_signals([t.tracked for t in tracks], [t.tracked_sd for t in tracks])
    bend = (np.maximum(angle, 0.0) * weight).sum(axis=1)
    spread = np.sqrt(((sd * weight) ** 2).sum(axis=1))
    base = Signal(time_s, bend, tracks[0].tracked.rate_hz, 1.0, np.empty((0, 2)))
    hidden = _find_occluded_samples(base, visible, start_s, end_s)
    return _is_exceeded(np.maximum(bend[hidden] - top, low - bend[hidden]) + spread[hidden])


def _find_occluded_samples(base: Signal, visible: Signal, start_s: float, end_s: float) -> NDArray[np.intp]:
    """Return the samples of ``base`` in a window at which the visible signal has none."""
    inside = np.flatnonzero((base.time_s >= start_s) & (base.time_s <= end_s))
    known = visible.time_s[visible.is_finite]
    if not len(known):
        return np.asarray(inside)
    right = np.clip(np.searchsorted(known, base.time_s[inside]), 0, len(known) - 1)
    left = np.maximum(right - 1, 0)
    nearest = np.minimum(np.abs(known[right] - base.time_s[inside]), np.abs(known[left] - base.time_s[inside]))
    return np.asarray(inside[nearest > 0.5 / base.rate_hz + 1e-9])


def _align_signals(values: Sequence[Signal], sds: Sequence[Signal]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return times (n,), values and standard deviations (n, k) at the first signal's times."""
    time_s = values[0].time_s

    def interpolate(signals: Sequence[Signal]) -> FloatArray:
        # Linear between two samples of one period; a NaN beside the time stays one.
        columns = [np.interp(time_s, s.time_s, s.value, left=math.nan, right=math.nan) for s in signals]
        return np.asarray(np.column_stack(columns), dtype=np.float64)

    return time_s, interpolate(values), interpolate(sds)

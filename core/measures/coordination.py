"""Finger coordination and tremor (clinical reference 5), coherence of occluded digits (hand paper, figure 2)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.measures.signals import BoolArray, Signal, find_runs, low_pass, rate_of_change
from carpus.core.model.hand.anatomy import HARD_LIMITS_RAD
from carpus.core.model.types import FloatArray

MAX_KNOWN_SD_RAD = math.radians(15.0)
"""An occluded joint with a larger standard deviation is a guess."""
LIMIT_TOLERANCE_RAD = math.radians(5.0)
"""Tracking error allowed beyond the anatomical limits (clinical reference 4.1)."""
MAX_JOINT_SPEED_RAD_S = math.radians(1000.0)
"""A pose that turns faster has jumped (clinical reference 4.4)."""
MIN_OCCLUSION_S = 0.1


@dataclass(frozen=True, slots=True)
class Coherence:
    """Plausibility of an occluded digit's pose.

    ``occluded_share`` of the tracked frames, ``coherent_share`` and ``known_share`` of the occluded ones; ``jumps_m``
    of the fingertip, in the hand's axes, at each reappearance.
    """

    occluded_share: float
    coherent_share: float
    known_share: float
    jumps_m: tuple[float, ...]


def digit_coherence(
    time_s: FloatArray,
    names: Sequence[str],
    angles_rad: FloatArray,
    sds_rad: FloatArray,
    tip_w2_m: FloatArray,
    is_occluded: BoolArray,
    is_tracked: BoolArray,
) -> Coherence:
    """Assess the pose of one digit while it is occluded.

    A frame is coherent if its joints stay within anatomical limits and do not jump. It is known if their standard
    deviations are at most 15 degrees. Use the filter's result: the smoother already knows the reappearance.

    Parameters
    ----------
    time_s, names
        (N,) and the J joints
    angles_rad, sds_rad
        (N, J)
    tip_w2_m
        (N, 3) fingertip in the hand's axes
    is_occluded, is_tracked
        (N,) of the digit, of the hand
    """
    is_occluded = np.logical_and(is_occluded, is_tracked)
    limits = np.array([HARD_LIMITS_RAD[name] for name in names])
    step_s = np.diff(time_s, prepend=time_s[:1] - 1.0) if len(time_s) else np.empty(0)
    with np.errstate(invalid="ignore"):
        inside = (angles_rad >= limits[:, 0] - LIMIT_TOLERANCE_RAD) & (angles_rad <= limits[:, 1] + LIMIT_TOLERANCE_RAD)
        turned = np.abs(np.diff(angles_rad, axis=0, prepend=angles_rad[:1])) <= MAX_JOINT_SPEED_RAD_S * step_s[:, None]
        coherent: BoolArray = np.all(inside & turned, axis=1)
        sure: BoolArray = np.all(sds_rad <= MAX_KNOWN_SD_RAD, axis=1)
    jumps = []
    for part in find_runs(is_occluded):
        back = part.stop
        long_enough = back < len(time_s) and time_s[back] - time_s[part.start] >= MIN_OCCLUSION_S
        if long_enough and is_tracked[back]:
            jumps.append(float(np.linalg.norm(tip_w2_m[back] - tip_w2_m[back - 1])))
    return Coherence(
        float(is_occluded.sum() / is_tracked.sum()) if is_tracked.any() else math.nan,
        float(coherent[is_occluded].mean()) if is_occluded.any() else math.nan,
        float(sure[is_occluded].mean()) if is_occluded.any() else math.nan,
        tuple(jump for jump in jumps if math.isfinite(jump)),
    )


MIN_SD_RAD = math.radians(2.0)
"""A joint that moves less shows no coordination."""
MAX_LAG_S = 0.5
TREMOR_BAND_HZ = (3.0, 12.0)
TREMOR_WINDOW_S, MIN_TREMOR_S = 2.0, 6.0
MIN_TREMOR_FPS = 2.0 * TREMOR_BAND_HZ[1]
"""Nyquist limit of the tremor band."""
MIN_TREMOR_TO_NOISE = 3.0
DRIFT_HZ = 1.0
MAX_HOLD_SPEED_RAD_S = math.radians(6.0)
"""A held angle drifts no faster; tremor oscillates about its place."""


def co_flexion(first: FloatArray, second: FloatArray, rate_hz: float) -> tuple[float, float]:
    """Return the correlation of two evenly sampled angles (n,), rad, and the lag of the second in seconds.

    NaN if one hardly moves or too little is known.
    """
    good = np.isfinite(first) & np.isfinite(second)
    if int(good.sum()) < 8 or min(first[good].std(), second[good].std()) < MIN_SD_RAD:
        return math.nan, math.nan
    correlation = float(np.corrcoef(first[good], second[good])[0, 1])
    most = min(round(MAX_LAG_S * rate_hz), len(first) - 1)
    best, lag = -math.inf, 0
    for shift in range(-most, most + 1):
        a = first[max(0, -shift) : len(first) - max(0, shift)]
        b = second[max(0, shift) : len(second) - max(0, -shift)]
        both = np.isfinite(a) & np.isfinite(b)
        if int(both.sum()) < 8 or min(a[both].std(), b[both].std()) == 0.0:
            continue
        found = float(np.corrcoef(a[both], b[both])[0, 1])
        if found > best + 1e-12:
            best, lag = found, shift
    return correlation, lag / rate_hz


def synergy_share(angles: FloatArray) -> float:
    """Return the variance share of the first principal component of angles (n, k).

    NaN if nothing moves.
    """
    known = angles[np.isfinite(angles).all(axis=1)]
    if len(known) < 8:
        return math.nan
    variance = np.linalg.eigvalsh(np.cov(known.T))
    return float(variance[-1] / variance.sum()) if variance.sum() > MIN_SD_RAD**2 else math.nan


def enslaving_share(instructed: FloatArray, other: FloatArray) -> float:
    """Return the mean movement of another finger over that of the instructed one.

    NaN if the instructed finger hardly moves.
    """
    asked, follows = (np.abs(values - np.nanmedian(values)) for values in (instructed, other))
    return float(np.nanmean(follows) / np.nanmean(asked)) if np.nanstd(instructed) >= MIN_SD_RAD else math.nan


@dataclass(frozen=True, slots=True)
class Tremor:
    """RMS amplitude between 3 and 12 Hz in the steadiest run.

    ``is_tremor``: at least three times the tracker's own noise. ``has_few_frames``: held, but the frame rate is too
    low.
    """

    rms_rad: float = math.nan
    is_tremor: bool = False
    has_few_frames: bool = False


def _is_held(angle: Signal) -> BoolArray:
    """Select samples (n,) at which the angle does not drift."""
    slow = rate_of_change(low_pass(angle, DRIFT_HZ)).value
    with np.errstate(invalid="ignore"):
        return np.asarray(angle.is_finite & (np.abs(slow) <= MAX_HOLD_SPEED_RAD_S), dtype=np.bool_)


def measure_tremor(angle: Signal, noise_rms_rad: float) -> Tremor:
    """Measure the tremor of an angle (rad, not low-passed) that is held for 6 s or longer.

    ``noise_rms_rad`` is the tracker's noise in the same band. NaN if nothing was held so long, or at a low frame rate.
    """
    from scipy import signal as sps  # half a second to load

    longest = max(find_runs(_is_held(angle)), key=lambda part: part.stop - part.start, default=slice(0, 0))
    value = angle.value[longest]
    if not len(value) >= MIN_TREMOR_S * angle.rate_hz:  # nor where the rate is unknown
        return Tremor()
    if angle.rate_hz < MIN_TREMOR_FPS:
        return Tremor(has_few_frames=True)
    part = Signal(angle.time_s[longest], value, angle.rate_hz, 1.0, np.empty((0, 2)))
    shaken = value - low_pass(part, DRIFT_HZ).value
    frequency, power = sps.welch(shaken, angle.rate_hz, nperseg=round(TREMOR_WINDOW_S * angle.rate_hz))
    band = (frequency >= TREMOR_BAND_HZ[0]) & (frequency <= TREMOR_BAND_HZ[1])
    rms = math.sqrt(float(power[band].sum() * (frequency[1] - frequency[0])))
    return Tremor(rms, rms > MIN_TREMOR_TO_NOISE * noise_rms_rad)

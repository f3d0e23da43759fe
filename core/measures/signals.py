"""Evenly sampled signals for the measures: valid samples, resampling, low-pass, derivative.

Validity rules: clinical reference 7.4 and 1.2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray, TrackStatus

BoolArray = NDArray[np.bool_]

MAX_FILLED_GAP_S = 0.2
"""Gaps up to this length are interpolated, longer ones stay gaps (reference 5)."""
SPEED_CUTOFF_HZ = 6.0
"""Low-pass cut-off before speed or smoothness is computed (reference 4.4)."""
_TWO_PASS_FACTOR = (math.sqrt(2.0) - 1.0) ** 0.25
"""Cut-off of two passes of a second-order filter over the cut-off of each pass."""
_MIN_FILTERED_SAMPLES = 4
"""Shorter runs between two gaps are not filtered."""


@dataclass(frozen=True, slots=True)
class Signal:
    """Evenly sampled signal; gaps are NaN.

    Attributes
    ----------
    time_s, value : (n,), and (n,) or (n, k)
    valid_share : share of the original frames that were valid
    gaps_s : (g, 2) first and last time of each gap, also before the first and after the last valid sample
    """

    time_s: FloatArray
    value: FloatArray
    rate_hz: float
    valid_share: float
    gaps_s: FloatArray

    @property
    def is_finite(self) -> BoolArray:
        """Samples (n,) outside gaps."""
        flat = self.value.reshape(len(self.value), math.prod(self.value.shape[1:]))
        return np.asarray(np.isfinite(flat).all(axis=1), dtype=np.bool_)

    def column(self, k: int) -> Signal:
        return replace(self, value=self.value[:, k])

    def is_near_gap(self, time_s: float, reach_s: float = MAX_FILLED_GAP_S) -> bool:
        """Return whether a gap begins or ends within ``reach_s`` of a time."""
        return bool((np.abs(self.gaps_s - time_s) <= reach_s).any())

    def crop(self, start_s: float, end_s: float) -> Signal:
        """Return the samples from ``start_s`` to ``end_s``, both included."""
        inside = _time_slice(self.time_s, start_s - 0.25 / self.rate_hz, end_s + 0.25 / self.rate_hz)
        return replace(self, time_s=self.time_s[inside], value=self.value[inside])


def _time_slice(time_s: FloatArray, start_s: float, end_s: float) -> slice:
    """Return the slice of sorted times from ``start_s`` to ``end_s``, both included; empty if one is NaN.

    Binary search, because a long recording is cropped for each of its repetitions.
    """
    if not start_s <= end_s:
        return slice(0, 0)
    return slice(int(time_s.searchsorted(start_s, "left")), int(time_s.searchsorted(end_s, "right")))


def resample_evenly(timestamp_s: FloatArray, value: FloatArray, valid: BoolArray | None = None) -> Signal:
    """Resample irregular samples at the recording's median rate, from the first to the last valid one.

    Parameters
    ----------
    timestamp_s
        (N,), strictly increasing
    value
        (N,) or (N, k); a row with NaN is invalid
    valid
        (N,) further validity
    """
    columns = value.reshape(len(timestamp_s), math.prod(value.shape[1:]))
    good = np.isfinite(columns).all(axis=1)
    if valid is not None:
        good = good & valid
    count = int(good.sum())
    if count < 2:
        whole = np.array([[timestamp_s[0], timestamp_s[-1]]]) if len(timestamp_s) else np.empty((0, 2))
        return Signal(np.empty(0), np.empty((0, *value.shape[1:])), math.nan, count / max(len(timestamp_s), 1), whole)
    period = float(np.median(np.diff(timestamp_s)))
    known, samples = timestamp_s[good], columns[good]
    steps = math.floor((known[-1] - known[0]) / period + 1e-6) + 1
    base = known[0] + period * np.arange(steps)
    even = np.column_stack([np.interp(base, known, column) for column in samples.T])
    edges = np.concatenate(([timestamp_s[0]], known, [timestamp_s[-1]]))
    wide = np.flatnonzero(np.diff(edges) > MAX_FILLED_GAP_S + 1.5 * period)
    gaps = np.column_stack((edges[wide], edges[wide + 1]))
    for start, end in gaps:
        even[_time_slice(base, start + 0.25 * period, end - 0.25 * period)] = np.nan
    return Signal(base, even.reshape(steps, *value.shape[1:]), 1.0 / period, count / len(timestamp_s), gaps)


def low_pass(signal: Signal, cutoff_hz: float = SPEED_CUTOFF_HZ) -> Signal:
    """Filter each run between gaps with a zero-phase second-order Butterworth low-pass.

    Both passes together have -3 dB at the cut-off. Runs of fewer than 4 samples become gaps. A signal that is sampled
    too slowly for the cut-off is returned unchanged.
    """
    if len(signal.time_s) == 0 or cutoff_hz >= 0.45 * signal.rate_hz:
        return signal
    # Each pass has -1.5 dB at the cut-off, so its own lies higher (Winter 2009), in the bilinear transform's scale;
    # there the filter of second order is these five numbers. To have SciPy design it cost more than to filter.
    turn = math.tan(math.pi * cutoff_hz / signal.rate_hz) / _TWO_PASS_FACTOR
    under = 1.0 + math.sqrt(2.0) * turn + turn**2
    b = np.array([1.0, 2.0, 1.0]) * (turn**2 / under)
    a = np.array([1.0, 2.0 * (turn**2 - 1.0) / under, (1.0 - math.sqrt(2.0) * turn + turn**2) / under])
    out = np.full_like(signal.value, np.nan)
    for part in find_runs(signal.is_finite):
        length = part.stop - part.start
        if length >= _MIN_FILTERED_SAMPLES:
            from scipy import signal as sps  # half a second to load, and not needed before something has been recorded

            out[part] = sps.filtfilt(b, a, signal.value[part], axis=0, padlen=min(9, length - 1))
    return replace(signal, value=out)


def rate_of_change(signal: Signal) -> Signal:
    """Differentiate by fourth-order central differences, in units of the value per second.

    Second-order differences lose 3 % of a movement of two cycles per second at 30 fps. They are used at the ends of
    each run.
    """
    out = np.full_like(signal.value, np.nan)
    for part in find_runs(signal.is_finite):
        if part.stop - part.start >= 2:
            value = signal.value[part]
            out[part] = np.gradient(value, 1.0 / signal.rate_hz, axis=0)
            if len(value) >= 5:
                inner = (value[:-4] - 8.0 * value[1:-3] + 8.0 * value[3:-1] - value[4:]) * (signal.rate_hz / 12.0)
                out[part.start + 2 : part.stop - 2] = inner
    return replace(signal, value=out)


def find_runs(flag: BoolArray) -> list[slice]:
    """Return the runs of True in a bool array (n,), as slices in order."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], flag, [False])).astype(np.int8)))
    return [slice(int(start), int(stop)) for start, stop in edges.reshape(-1, 2)]


MIN_PALM_MARKERS = 4
MAX_VIEW_TILT_RAD = math.radians(70.0)
"""Tilt of the back of the hand to the camera's axis above which a marker is a sliver."""
SETTLING_S = 0.09
"""About three frames."""
MAX_ANGLE_SD_RAD = math.radians(8.0)
"""Angles with a larger standard deviation are not used (our choice, half of the change limits)."""
MAX_ZYX_FLEXION_RAD = math.radians(75.0)
"""Above it deviation and pronosupination are ill-conditioned: noise gain 1/cos above 3.9."""


def valid_view(
    status: NDArray[np.integer], palm_measured_px: FloatArray, rotation_w2_w0: FloatArray, rotation_w0_cam: FloatArray
) -> BoolArray:
    """Select frames (N,) that are tracked, with 4 or more palm markers and a tilt up to 70 degrees.

    Parameters
    ----------
    status
        (N,) track status
    palm_measured_px
        (N, P, 2) blobs assigned to the palm markers, NaN where none
    rotation_w2_w0, rotation_w0_cam
        (N, 3, 3) of the hand, (3, 3) of the neutral pose in the camera
    """
    seen = np.isfinite(palm_measured_px).all(axis=2).sum(axis=1) >= MIN_PALM_MARKERS
    normal_cam = rotation_w2_w0[..., :, 2] @ rotation_w0_cam.T
    with np.errstate(invalid="ignore"):
        facing = np.arccos(np.clip(-normal_cam[..., 2], -1.0, 1.0)) <= MAX_VIEW_TILT_RAD
    return np.asarray((status == TrackStatus.TRACKED) & seen & facing, dtype=np.bool_)


def exclude_view_edges(is_visible: BoolArray, time_s: FloatArray) -> BoolArray:
    """Exclude the frames (N,) just before the hand leaves the view and just after it is back.

    They rest on few markers at the edge and may be tens of degrees off. Gaps that are interpolated do not count.
    """
    out = is_visible.copy()
    for part in find_runs(~is_visible):
        before, after = max(part.start - 1, 0), min(part.stop, len(is_visible) - 1)
        if time_s[after] - time_s[before] > MAX_FILLED_GAP_S:
            out &= (time_s < time_s[part.start] - SETTLING_S) | (time_s > time_s[part.stop - 1] + SETTLING_S)
    return out


def valid_wrist_angles(is_visible: BoolArray, angles_rad: FloatArray, angles_sd_rad: FloatArray) -> BoolArray:
    """Select visible samples (N, 3) of deviation, flexion and pronosupination with a small standard deviation.

    Deviation and pronosupination need a flexion of at most 75 degrees.
    """
    with np.errstate(invalid="ignore"):
        valid = is_visible[:, None] & np.isfinite(angles_rad) & (angles_sd_rad <= MAX_ANGLE_SD_RAD)
        valid[:, [0, 2]] &= (np.abs(angles_rad[:, 1]) <= MAX_ZYX_FLEXION_RAD)[:, None]
    return np.asarray(valid, dtype=np.bool_)

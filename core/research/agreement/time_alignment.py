"""Alignment of two recordings in time: shift between their clocks, its rivals, and drift."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import NDArray

from carpus.core.model.types import FloatArray

STEP_S = 1.0 / 100.0
"""Step of the search for a shift."""
MIN_OVERLAP_S, MIN_OVERLAP_SHARE = 1.0, 0.6
"""Least overlap, in seconds and as a share of the shorter recording: a short piece fits anywhere."""
MAX_LOG_LIKELIHOOD_DROP, RESIDUAL_FLOOR = 3.0, 0.003
"""Matches within this of the best log-likelihood are equally good; the floor is the residual that sampling leaves."""
MAX_RIVAL_DROP, MAX_RIVALS = 0.03, 3
"""Other shifts within this drop of the match are named."""
MAX_DRIFT_DROP, MAX_COMPARED_PEAKS = 0.1, 5
"""Drift may cost a match so much: the nearest peaks within this are compared without it."""
MIN_PEAK_DISTANCE_S = 0.3
"""Nearer peaks are one."""
MAX_INTERPOLATED_GAP_S = 0.12
"""Longest gap between two readings of a reference that is interpolated."""
MIN_DRIFT_RECORDING_S, MAX_DRIFT = 10.0, 0.03
"""Drift is searched in recordings of this length and more, up to this share."""
MAX_DRIFT_FRAMES = 1000
"""Enough to find a drift."""
MIN_DRIFT_S, MIN_DRIFT_SDS = 0.05, 3.0
"""Drift is reported if it adds up to so much and is significant."""
INDEPENDENT_HZ = 2.0
"""Independent values per second of a hand's movement."""


@dataclass(frozen=True, slots=True)
class ClockShift:
    """Shift between the clocks: t in the session is t (1 + ``drift``) + ``lag_s`` in the reference.

    Both count from their first frame.

    Attributes
    ----------
    match : correlation at this shift, negative if the curves oppose each other
    rivals : nearest other shifts that match nearly as well, each with its match
    same_sign_shift : if ``match`` is negative, the best shift with a positive one
    is_at_search_limit : the best shift lies at the end of the search
    residual_drift, drift_free_lag_s : drift that is left and the lag with it; NaN if not significant
    """

    lag_s: float
    match: float
    rivals: tuple[tuple[float, float], ...] = ()
    has_more_rivals: bool = False
    same_sign_shift: tuple[float, float] | None = None
    max_shift_s: float = math.nan
    is_at_search_limit: bool = False
    is_given: bool = False
    drift: float = 0.0
    residual_drift: float = math.nan
    drift_free_lag_s: float = math.nan

    def reference_time_s(self, time_s: FloatArray) -> FloatArray:
        """Return times (N,) of the session on the reference's clock."""
        return np.asarray(time_s * (1.0 + self.drift) + self.lag_s)


def interpolate(query_s: FloatArray, time_s: FloatArray, values: FloatArray) -> FloatArray:
    """Interpolate ``values`` (K, ...) linearly at other times (N, ...); NaN beyond known neighbours."""
    known = np.isfinite(values) if values.ndim == 1 else np.isfinite(values).all(axis=tuple(range(1, values.ndim)))
    t, v = time_s[known], values[known]
    if len(t) < 2:
        return np.full((len(query_s), *values.shape[1:]), np.nan)
    after = np.clip(np.searchsorted(t, query_s), 1, len(t) - 1)
    before = after - 1
    share = (query_s - t[before]) / (t[after] - t[before])
    column = share.reshape(-1, *(1,) * (values.ndim - 1))
    out = v[before] + column * (v[after] - v[before])
    longest = max(MAX_INTERPOLATED_GAP_S, 2.5 * float(np.median(np.diff(time_s))))
    margin = 0.25  # of a step, since clocks jitter
    inside = (share >= -margin) & (share <= 1.0 + margin) & (t[after] - t[before] <= longest)
    out[~inside] = np.nan
    return np.asarray(out)


@dataclass(frozen=True, slots=True)
class AlignmentCurves:
    """The same S signals of session (N, S) and reference (K, S)."""

    time_s: FloatArray
    values: FloatArray
    reference_s: FloatArray
    reference_values: FloatArray

    @property
    def weight(self) -> FloatArray:
        """Weight of each signal in a match: how much it moves in both."""
        with np.errstate(invalid="ignore"), warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # an unknown signal has no spread
            spread = np.nanstd(self.values, axis=0) * np.nanstd(self.reference_values, axis=0)
        return np.where(np.isfinite(spread), spread, 0.0)

    ignores_sign: bool = False
    """True if opposite curves count as equal."""

    def match(self, shift: ClockShift) -> float:
        """Return the correlation at the session's frames."""
        at_s = shift.reference_time_s(self.time_s)
        there = np.column_stack([interpolate(at_s, self.reference_s, one) for one in self.reference_values.T])
        return _mean_correlation(self.values, there, self.weight, 8, self.ignores_sign)


def find_shift(curves: AlignmentCurves, max_shift_s: float, same_clock_tolerance: float = 0.0) -> ClockShift:
    """Find the best shift by cross-correlation over what both share; of equal ones the smallest.

    Returns no shift if its correlation is lower by at most ``same_clock_tolerance``.
    """
    time_s, other_s, weight = curves.time_s, curves.reference_s, curves.weight
    if not curves.values.shape[1] or len(time_s) < 8 or len(other_s) < 8:
        return ClockShift(0.0, math.nan)
    even_s, grid_s = np.arange(0.0, time_s[-1], STEP_S), np.arange(other_s[0], other_s[-1], STEP_S)
    shorter_s = float(min(even_s[-1], grid_s[-1] - grid_s[0])) if len(even_s) and len(grid_s) else 0.0
    if shorter_s < MIN_OVERLAP_S - 2.0 * STEP_S or not weight.sum() > 0.0:
        return ClockShift(0.0, math.nan)
    a = np.column_stack([interpolate(even_s, time_s, one) for one in curves.values.T])
    b = np.column_stack([interpolate(grid_s, other_s, one) for one in curves.reference_values.T])
    first, max_steps = round(grid_s[0] / STEP_S), round(max_shift_s / STEP_S)
    min_samples = min(round(max(MIN_OVERLAP_S, MIN_OVERLAP_SHARE * shorter_s) / STEP_S), len(a), len(b))
    shifts = np.arange(-max_steps, max_steps + 1)
    per_signal = np.full((len(shifts), a.shape[1]), np.nan)
    for k in range(a.shape[1]):
        per_signal[:, k] = _correlations(a[:, k], b[:, k], shifts - first, min_samples)
    match = _combine_correlations(per_signal, weight, ignores_sign=curves.ignores_sign)
    if not np.isfinite(match).any():
        return ClockShift(0.0, math.nan)
    score = np.where(np.isfinite(match), np.abs(match) if curves.ignores_sign else match, -np.inf)
    peaks = _find_peaks(score)
    best = float(score[peaks[0]])
    if score[max_steps] >= best - same_clock_tolerance:
        return ClockShift(0.0, float(match[max_steps]))
    # Drift blurs a match more with a longer overlap, so the peaks are compared without it.
    nearest = sorted((k for k in peaks if score[k] >= best - MAX_DRIFT_DROP), key=lambda k: abs(shifts[k]))
    nearest = list(dict.fromkeys((peaks[0], *nearest[:MAX_COMPARED_PEAKS])))
    cleared = score[nearest]
    if len(nearest) > 1:
        fits = [_estimate_drift(curves, ClockShift(_refine_peak_s(shifts, score, k), float(match[k]))) for k in nearest]
        cleared = np.array([max(fit.match if fit else 0.0, score[k]) for k, fit in zip(nearest, fits, strict=True)])
    unexplained = 1.0 - cleared + RESIDUAL_FLOOR
    drop = 0.5 * INDEPENDENT_HZ * shorter_s * np.log(unexplained / unexplained.min())
    equal = (k for k, less in zip(nearest, drop, strict=True) if less <= MAX_LOG_LIKELIHOOD_DROP)
    chosen = min(equal, key=lambda k: abs(shifts[k]))
    rivals = sorted(
        (k for k in peaks if k != chosen and score[k] >= best - MAX_RIVAL_DROP), key=lambda k: abs(shifts[k])
    )
    same_sign = next((k for k in peaks if match[k] > 0.0), None) if match[chosen] < 0.0 else None
    return ClockShift(
        _refine_peak_s(shifts, score, chosen),
        float(match[chosen]),
        tuple((_refine_peak_s(shifts, score, k), float(match[k])) for k in rivals[:MAX_RIVALS]),
        has_more_rivals=len(rivals) > MAX_RIVALS,
        same_sign_shift=None
        if same_sign is None
        else (_refine_peak_s(shifts, score, same_sign), float(match[same_sign])),
        max_shift_s=max_shift_s,
        is_at_search_limit=chosen in (0, len(shifts) - 1),
    )


def _find_peaks(score: FloatArray) -> list[int]:
    """Return the peaks of the score, the highest first."""
    padded = np.concatenate(([-np.inf], score, [-np.inf]))
    is_top = (score >= padded[:-2]) & (score >= padded[2:]) & np.isfinite(score)
    out: list[int] = []
    for k in sorted(np.flatnonzero(is_top).tolist(), key=lambda k: -score[k]):
        if all(abs(k - other) * STEP_S > MIN_PEAK_DISTANCE_S for other in out):
            out.append(k)
    return out


def _refine_peak_s(shifts: np.ndarray, score: FloatArray, peak: int) -> float:
    """Return the shift of a peak between the steps."""
    fine = 0.0
    if 0 < peak < len(score) - 1 and np.isfinite(score[peak - 1 : peak + 2]).all():
        left, top, right = score[peak - 1 : peak + 2]
        bend = left - 2.0 * top + right
        fine = float(0.5 * (left - right) / bend) if bend < 0.0 else 0.0
    return float((shifts[peak] + fine) * STEP_S)


@dataclass(frozen=True, slots=True)
class _DriftEstimate:
    """Drift beyond that of a shift, its sd, and lag and match with it."""

    drift: float
    sd: float
    lag_s: float
    match: float
    length_s: float


def _estimate_drift(curves: AlignmentCurves, shift: ClockShift) -> _DriftEstimate | None:
    """Estimate the drift with the best match; None if the overlap is too short."""
    at_s = shift.reference_time_s(curves.time_s)
    shared = curves.time_s[(at_s >= curves.reference_s[0]) & (at_s <= curves.reference_s[-1])]
    length_s = float(np.ptp(shared)) if len(shared) else 0.0
    if length_s < MIN_DRIFT_RECORDING_S or not abs(shift.match) > 0.0:
        return None
    step_frames = max(1, len(curves.time_s) // MAX_DRIFT_FRAMES)
    curves = replace(curves, time_s=curves.time_s[::step_frames], values=curves.values[::step_frames])
    middle_s, sign = float(shared[0]) + 0.5 * length_s, math.copysign(1.0, shift.match)

    def shift_about_middle(drift: float, later_s: float) -> ClockShift:
        """Rotate about the middle, where drift and lag are independent."""
        return ClockShift(shift.lag_s + later_s - drift * middle_s, 0.0, drift=shift.drift + drift)

    def match(drift: float, later_s: float) -> float:
        found = sign * curves.match(shift_about_middle(drift, later_s))
        return found if math.isfinite(found) else -1.0

    step = 0.1 / length_s
    grid = step * np.arange(-math.ceil(MAX_DRIFT / step), math.ceil(MAX_DRIFT / step) + 1)
    start = max(grid.tolist(), key=lambda drift: match(drift, 0.0))
    simplex = np.array([[start, 0.0], [start + step, 0.0], [start, 0.05]])
    options = {"initial_simplex": simplex, "xatol": 1e-5, "fatol": 1e-7, "maxiter": 200}
    found = scipy.optimize.minimize(lambda x: -match(*x), simplex[0], method="Nelder-Mead", options=options)  # type: ignore[call-overload]
    drift, later_s = map(float, found.x)
    best = -float(found.fun)
    # The correlation falls by c d^2 / 2 about its peak, which gives the variance of the peak by least squares.
    bend = (2.0 * best - match(drift - step, later_s) - match(drift + step, later_s)) / step**2
    if not bend > 0.0 or abs(drift) > MAX_DRIFT:
        return None
    sd = math.sqrt(2.0 * max(1.0 - best, 0.0) / (INDEPENDENT_HZ * length_s * bend))
    return _DriftEstimate(drift, sd, shift_about_middle(drift, later_s).lag_s, best, length_s)


def with_residual_drift(curves: AlignmentCurves, shift: ClockShift) -> ClockShift:
    """Add the drift that is left between the clocks if it is significant."""
    found = _estimate_drift(curves, shift)
    if found is None or abs(found.drift) < max(MIN_DRIFT_S / found.length_s, MIN_DRIFT_SDS * found.sd):
        return shift
    return replace(shift, residual_drift=found.drift, drift_free_lag_s=found.lag_s)


def _correlations(a: FloatArray, b: FloatArray, lags: NDArray[np.intp], min_count: int) -> FloatArray:
    """Return the correlations (L,) of ``a`` (N,) with ``b`` (K,) at all lags (L,) by FFT.

    NaN where fewer than ``min_count`` samples overlap.
    """
    from scipy.signal import correlate, correlation_lags

    has_a, has_b = np.isfinite(a), np.isfinite(b)
    x, y = (np.where(has, one - np.mean(one[has]), 0.0) for one, has in ((a, has_a), (b, has_b)))
    all_lags = correlation_lags(len(b), len(a))
    out = np.full(len(lags), np.nan)
    inside = (lags >= all_lags[0]) & (lags <= all_lags[-1])

    def sum_products(from_a: FloatArray, from_b: FloatArray) -> FloatArray:
        return np.asarray(correlate(from_b, from_a, method="fft")[lags[inside] - all_lags[0]])

    one_a, one_b = has_a.astype(np.float64), has_b.astype(np.float64)
    count = np.maximum(np.rint(sum_products(one_a, one_b)), 1.0)
    mean_x, mean_y = sum_products(x, one_b) / count, sum_products(one_a, y) / count
    power_x = sum_products(x * x, one_b) / count - mean_x**2
    power_y = sum_products(one_a, y * y) / count - mean_y**2
    # The rounding error of the transform is no movement of a constant curve.
    moves = (count >= min_count) & (power_x > 1e-10 * np.mean(x * x)) & (power_y > 1e-10 * np.mean(y * y))
    with np.errstate(divide="ignore", invalid="ignore"):
        per_signal = (sum_products(x, y) / count - mean_x * mean_y) / np.sqrt(power_x * power_y)
    out[inside] = np.where(moves, np.clip(per_signal, -1.0, 1.0), np.nan)
    return out


def _mean_correlation(
    a: FloatArray, b: FloatArray, weight: FloatArray, min_count: int, ignores_sign: bool = False
) -> float:
    """Return the weighted correlation of signals (N, S)."""
    per_signal = np.full((1, a.shape[1]), np.nan)
    for k, (x, y) in enumerate(zip(a.T, b.T, strict=True)):
        both = np.isfinite(x) & np.isfinite(y)
        if both.sum() >= min_count and np.ptp(x[both]) > 0.0 and np.ptp(y[both]) > 0.0:
            per_signal[0, k] = np.corrcoef(x[both], y[both])[0, 1]
    return float(_combine_correlations(per_signal, weight, ignores_sign=ignores_sign)[0])


def _combine_correlations(correlations: FloatArray, weight: FloatArray, *, ignores_sign: bool) -> FloatArray:
    """Return the weighted mean (L,) of the signals' correlations (L, S), NaN where unknown.

    With ``ignores_sign`` that of their absolute values, with the sign of the larger part.
    """
    weights = np.where(np.isfinite(correlations), weight, 0.0)
    share = weights * np.nan_to_num(correlations)
    total, size, used = share.sum(axis=1), np.abs(share).sum(axis=1), weights.sum(axis=1)
    joined = np.copysign(size, total) if ignores_sign else total
    return np.asarray(np.divide(joined, used, out=np.full(len(used), np.nan), where=used > 0.0))

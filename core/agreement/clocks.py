"""Two recordings of one movement in one time: the shift between their clocks, what would do as well, and drift."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import NDArray

from carpus.core.types import FloatArray

STEP_S = 1.0 / 100.0
"""Of the times on which a shift is looked for."""
LEAST_OVERLAP_S, LEAST_SHARE = 1.0, 0.6
"""What both must have in common, in seconds and of the shorter of the two: a short piece fits anywhere."""
ALIKE, FLOOR = 3.0, 0.003
"""A match is as good as the best where its log-likelihood is less by no more than this, of what both leave unexplained
and a bit that sampling alone does."""
RIVAL, MOST_RIVALS = 0.03, 3
"""Another shift is named where it matches less well by no more than this."""
DRIFT_COSTS, MOST_TRIED = 0.1, 5
"""Drift may cost a match so much: the nearest tops within this are compared without it."""
HILL_S = 0.3
"""Two tops nearer than this are of one hill."""
LONGEST_STEP_S = 0.12
"""Between two readings of a reference that are interpolated."""
DRIFT_FROM_S, MOST_DRIFT = 10.0, 0.03
"""Drift is looked for in recordings of this length on, up to this share."""
MOST_PICTURES = 1000
"""Are enough to find it."""
LEAST_DRIFT_S, DRIFT_SURE = 0.05, 3.0
"""Drift is spoken of where it adds up to so much, and is so many times its own standard deviation."""
INDEPENDENT_HZ = 2.0
"""Of a hand's movement about as many values a second are independent."""


@dataclass(frozen=True, slots=True)
class Shift:
    """``reference_later_s``: what happens at t in the session happens at t (1 + ``drift``) + this on the reference's
    clock, both counted from their first picture; ``match`` the correlation there, below nothing where the curves run
    against each other.

    ``rivals`` are the nearest other shifts that match nearly as well, each with its match, and ``more_rivals`` whether
    there are others; ``upright``, where ``match`` is below nothing, the shift up to ``most_s`` at which the curves run
    together best, with its match; ``at_edge`` whether the search ended
    where this was found; ``was_given`` by a person. ``drift_found`` is what is left, with ``lag_without_drift_s``
    the shift that goes with it; NaN where there is none to speak of.
    """

    reference_later_s: float
    match: float
    rivals: tuple[tuple[float, float], ...] = ()
    more_rivals: bool = False
    upright: tuple[float, float] | None = None
    most_s: float = math.nan
    at_edge: bool = False
    was_given: bool = False
    drift: float = 0.0
    drift_found: float = math.nan
    lag_without_drift_s: float = math.nan

    def reference_time_s(self, time_s: FloatArray) -> FloatArray:
        """Times (N,) of the session on the reference's clock."""
        return np.asarray(time_s * (1.0 + self.drift) + self.reference_later_s)


def at_times(wanted_s: FloatArray, time_s: FloatArray, values: FloatArray) -> FloatArray:
    """``values`` (K, ...) at other times (N, ...), on the line between two known neighbours; NaN elsewhere."""
    known = np.isfinite(values) if values.ndim == 1 else np.isfinite(values).all(axis=tuple(range(1, values.ndim)))
    t, v = time_s[known], values[known]
    if len(t) < 2:
        return np.full((len(wanted_s), *values.shape[1:]), np.nan)
    after = np.clip(np.searchsorted(t, wanted_s), 1, len(t) - 1)
    before = after - 1
    share = (wanted_s - t[before]) / (t[after] - t[before])
    column = share.reshape(-1, *(1,) * (values.ndim - 1))
    out = v[before] + column * (v[after] - v[before])
    longest = max(LONGEST_STEP_S, 2.5 * float(np.median(np.diff(time_s))))
    near = 0.25  # of a step: clocks waver
    inside = (share >= -near) & (share <= 1.0 + near) & (t[after] - t[before] <= longest)
    out[~inside] = np.nan
    return np.asarray(out)


@dataclass(frozen=True, slots=True)
class ClockCurves:
    """Signals (N, S) at ``time_s`` (N,) and (K, S) at ``other_s`` (K,), the same quantities in both."""

    time_s: FloatArray
    mine: FloatArray
    other_s: FloatArray
    other: FloatArray

    @property
    def weight(self) -> FloatArray:
        """What counts in a match: how far each signal moves in both."""
        with np.errstate(invalid="ignore"), warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # what is known nowhere has no spread
            spread = np.nanstd(self.mine, axis=0) * np.nanstd(self.other, axis=0)
        return np.where(np.isfinite(spread), spread, 0.0)

    either_sign: bool = False
    """Whether curves that run against each other are the same all the same."""

    def match(self, shift: Shift) -> float:
        """How well they go together on the pictures of the session."""
        at_s = shift.reference_time_s(self.time_s)
        there = np.column_stack([at_times(at_s, self.other_s, one) for one in self.other.T])
        return _match(self.mine, there, self.weight, 8, self.either_sign)


def best_shift(curves: ClockCurves, most_s: float, same_clock_alike: float = 0.0) -> Shift:
    """The shift at which the curves go together best, by cross-correlation over what they share: of several that do as
    well, as repetitions do, the smallest. None where without it the correlation is less by no more than
    ``same_clock_alike``."""
    time_s, other_s, weight = curves.time_s, curves.other_s, curves.weight
    if not curves.mine.shape[1] or len(time_s) < 8 or len(other_s) < 8:
        return Shift(0.0, math.nan)
    even, theirs_s = np.arange(0.0, time_s[-1], STEP_S), np.arange(other_s[0], other_s[-1], STEP_S)
    shorter_s = float(min(even[-1], theirs_s[-1] - theirs_s[0])) if len(even) and len(theirs_s) else 0.0
    if shorter_s < LEAST_OVERLAP_S - 2.0 * STEP_S or not weight.sum() > 0.0:
        return Shift(0.0, math.nan)
    a = np.column_stack([at_times(even, time_s, one) for one in curves.mine.T])
    b = np.column_stack([at_times(theirs_s, other_s, one) for one in curves.other.T])
    first, furthest = round(theirs_s[0] / STEP_S), round(most_s / STEP_S)
    least = min(round(max(LEAST_OVERLAP_S, LEAST_SHARE * shorter_s) / STEP_S), len(a), len(b))
    shifts = np.arange(-furthest, furthest + 1)
    alike = np.full((len(shifts), a.shape[1]), np.nan)
    for k in range(a.shape[1]):
        alike[:, k] = _correlations(a[:, k], b[:, k], shifts - first, least)
    match = _joined(alike, weight, either_sign=curves.either_sign)
    if not np.isfinite(match).any():
        return Shift(0.0, math.nan)
    score = np.where(np.isfinite(match), np.abs(match) if curves.either_sign else match, -np.inf)
    tops = _tops(score)
    best = float(score[tops[0]])
    if score[furthest] >= best - same_clock_alike:
        return Shift(0.0, float(match[furthest]))
    # Drift blurs a match the more, the longer the two overlap: the tops are compared without it.
    near = sorted((k for k in tops if score[k] >= best - DRIFT_COSTS), key=lambda k: abs(shifts[k]))
    near = list(dict.fromkeys((tops[0], *near[:MOST_TRIED])))
    fits = [_drift(curves, Shift(_top_s(shifts, score, k), float(match[k]))) if len(near) > 1 else None for k in near]
    cleared = np.array([max(fit.match if fit else 0.0, score[k]) for k, fit in zip(near, fits, strict=True)])
    worse = 0.5 * INDEPENDENT_HZ * shorter_s * np.log((1.0 - cleared + FLOOR) / (1.0 - cleared.max() + FLOOR))
    at = min((k for k, less in zip(near, worse, strict=True) if less <= ALIKE), key=lambda k: abs(shifts[k]))
    rivals = sorted((k for k in tops if k != at and score[k] >= best - RIVAL), key=lambda k: abs(shifts[k]))
    together = next((k for k in tops if match[k] > 0.0), None) if match[at] < 0.0 else None
    return Shift(
        _top_s(shifts, score, at),
        float(match[at]),
        tuple((_top_s(shifts, score, k), float(match[k])) for k in rivals[:MOST_RIVALS]),
        more_rivals=len(rivals) > MOST_RIVALS,
        upright=None if together is None else (_top_s(shifts, score, together), float(match[together])),
        most_s=most_s,
        at_edge=at in (0, len(shifts) - 1),
    )


def _tops(score: FloatArray) -> list[int]:
    """Places of the hills' tops, the highest first."""
    padded = np.concatenate(([-np.inf], score, [-np.inf]))
    is_top = (score >= padded[:-2]) & (score >= padded[2:]) & np.isfinite(score)
    out: list[int] = []
    for k in sorted(np.flatnonzero(is_top).tolist(), key=lambda k: -score[k]):
        if all(abs(k - other) * STEP_S > HILL_S for other in out):
            out.append(k)
    return out


def _top_s(shifts: np.ndarray, score: FloatArray, at: int) -> float:
    """The shift of a top, between the steps."""
    fine = 0.0
    if 0 < at < len(score) - 1 and np.isfinite(score[at - 1 : at + 2]).all():
        left, top, right = score[at - 1 : at + 2]
        bend = left - 2.0 * top + right
        fine = float(0.5 * (left - right) / bend) if bend < 0.0 else 0.0
    return float((shifts[at] + fine) * STEP_S)


@dataclass(frozen=True, slots=True)
class _Drift:
    """Drift beyond that of a shift, its sd, the lag that goes with both, and the match then; over ``length_s``."""

    drift: float
    sd: float
    lag_s: float
    match: float
    length_s: float


def _drift(curves: ClockCurves, shift: Shift) -> _Drift | None:
    """The drift with which the curves go together best; None where they are too short for one."""
    at_s = shift.reference_time_s(curves.time_s)
    shared = curves.time_s[(at_s >= curves.other_s[0]) & (at_s <= curves.other_s[-1])]
    length_s = float(np.ptp(shared)) if len(shared) else 0.0
    if length_s < DRIFT_FROM_S or not abs(shift.match) > 0.0:
        return None
    few = max(1, len(curves.time_s) // MOST_PICTURES)
    curves = replace(curves, time_s=curves.time_s[::few], mine=curves.mine[::few])
    middle_s, sign = float(shared[0]) + 0.5 * length_s, math.copysign(1.0, shift.match)

    def moved(drift: float, later_s: float) -> Shift:
        """About the middle, so that drift and lag are found apart."""
        return Shift(shift.reference_later_s + later_s - drift * middle_s, 0.0, drift=shift.drift + drift)

    def match(drift: float, later_s: float) -> float:
        found = sign * curves.match(moved(drift, later_s))
        return found if math.isfinite(found) else -1.0

    step = 0.1 / length_s
    grid = step * np.arange(-math.ceil(MOST_DRIFT / step), math.ceil(MOST_DRIFT / step) + 1)
    start = max(grid.tolist(), key=lambda drift: match(drift, 0.0))
    simplex = np.array([[start, 0.0], [start + step, 0.0], [start, 0.05]])
    options = {"initial_simplex": simplex, "xatol": 1e-5, "fatol": 1e-7, "maxiter": 200}
    found = scipy.optimize.minimize(lambda x: -match(*x), simplex[0], method="Nelder-Mead", options=options)  # type: ignore[call-overload]
    drift, later_s = map(float, found.x)
    best = -float(found.fun)
    # A correlation that falls by c d^2 / 2 about its top: the variance of where the top is, by least squares.
    bend = (2.0 * best - match(drift - step, later_s) - match(drift + step, later_s)) / step**2
    if not bend > 0.0 or abs(drift) > MOST_DRIFT:
        return None
    sd = math.sqrt(2.0 * max(1.0 - best, 0.0) / (INDEPENDENT_HZ * length_s * bend))
    return _Drift(drift, sd, moved(drift, later_s).reference_later_s, best, length_s)


def with_drift(curves: ClockCurves, shift: Shift) -> Shift:
    """The same with the drift that is left between the two clocks, where it is sure and adds up to something."""
    found = _drift(curves, shift)
    if found is None or abs(found.drift) < max(LEAST_DRIFT_S / found.length_s, DRIFT_SURE * found.sd):
        return shift
    return replace(shift, drift_found=found.drift, lag_without_drift_s=found.lag_s)


def _correlations(a: FloatArray, b: FloatArray, later: NDArray[np.intp], least: int) -> FloatArray:
    """Correlation (L,) of ``a`` (N,) with ``b`` (K,) begun so many samples ``later`` (L,), over what both have; NaN
    where that is fewer than ``least``. All shifts at once, by Fourier transforms of the sums that it is made of."""
    from scipy.signal import correlate, correlation_lags

    has_a, has_b = np.isfinite(a), np.isfinite(b)
    x, y = (np.where(has, one - np.mean(one[has]), 0.0) for one, has in ((a, has_a), (b, has_b)))
    lags = correlation_lags(len(b), len(a)).tolist()
    out = np.full(len(later), np.nan)
    inside = (later >= lags[0]) & (later <= lags[-1])

    def summed(of_a: FloatArray, of_b: FloatArray) -> FloatArray:
        return np.asarray(correlate(of_b, of_a, method="fft")[later[inside] - lags[0]])

    one_a, one_b = has_a.astype(np.float64), has_b.astype(np.float64)
    count = np.maximum(np.rint(summed(one_a, one_b)), 1.0)
    mean_x, mean_y = summed(x, one_b) / count, summed(one_a, y) / count
    power_x, power_y = summed(x * x, one_b) / count - mean_x**2, summed(one_a, y * y) / count - mean_y**2
    # What a transform leaves of the variance of a curve that stands still is no movement.
    moves = (count >= least) & (power_x > 1e-10 * np.mean(x * x)) & (power_y > 1e-10 * np.mean(y * y))
    with np.errstate(divide="ignore", invalid="ignore"):
        alike = (summed(x, y) / count - mean_x * mean_y) / np.sqrt(power_x * power_y)
    out[inside] = np.where(moves, np.clip(alike, -1.0, 1.0), np.nan)
    return out


def _match(a: FloatArray, b: FloatArray, weight: FloatArray, least: int, either_sign: bool = False) -> float:
    """How well signals (N, S) go together as they are."""
    alike = np.full((1, a.shape[1]), np.nan)
    for k, (x, y) in enumerate(zip(a.T, b.T, strict=True)):
        both = np.isfinite(x) & np.isfinite(y)
        if both.sum() >= least and np.ptp(x[both]) > 0.0 and np.ptp(y[both]) > 0.0:
            alike[0, k] = np.corrcoef(x[both], y[both])[0, 1]
    return float(_joined(alike, weight, either_sign=either_sign)[0])


def _joined(alike: FloatArray, weight: FloatArray, *, either_sign: bool) -> FloatArray:
    """Weighted mean (L,) of the signals' correlations (L, S), NaN of those that are not known; with ``either_sign`` of
    their sizes, with the sign of most of it."""
    weights = np.where(np.isfinite(alike), weight, 0.0)
    share = weights * np.nan_to_num(alike)
    total, size, used = share.sum(axis=1), np.abs(share).sum(axis=1), weights.sum(axis=1)
    joined = np.copysign(size, total) if either_sign else total
    return np.asarray(np.divide(joined, used, out=np.full(len(used), np.nan), where=used > 0.0))

"""Agreement of paired readings in order of time; unknown values are removed in pairs.

Bias and limits: Bland and Altman 1999; of several people Bland and Altman 2007, Zou 2013. ICC(2,1) and ICC(3,1): McGraw
and Wong 1996; negative ones Lin 1989. CMC: Kadaba 1989, between two systems.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy

from carpus.core.model.types import FloatArray

MIN_PAIRS = 3
"""Fewer pairs, or people, give no result."""
MIN_PAIRS_TO_JUDGE = 10

Interval = tuple[float, float]
_UNKNOWN: Interval = (math.nan, math.nan)


@dataclass(frozen=True, slots=True)
class Agreement:
    """Agreement of ``count`` pairs, ``measured`` less ``reference``, with 95 % intervals.

    Attributes
    ----------
    effective_count : float
        Number of independent pairs.
    bias, sd, limits : float, float, pair of float
        Mean and standard deviation of the differences; limits of agreement, bias ± 1.96 sd.
    icc, icc_3_1 : float
        ICC(2,1), absolute agreement, and ICC(3,1), consistency.
    cmc : float
        Coefficient of multiple correlation of the whole waveform; NaN for single readings and if the two have nothing
        in common.
    """

    count: int
    effective_count: float = math.nan
    bias: float = math.nan
    bias_interval: Interval = _UNKNOWN
    sd: float = math.nan
    limits: Interval = _UNKNOWN
    lower_interval: Interval = _UNKNOWN
    upper_interval: Interval = _UNKNOWN
    rmse: float = math.nan
    largest_difference: float = math.nan
    correlation: float = math.nan
    icc: float = math.nan
    icc_interval: Interval = _UNKNOWN
    icc_3_1: float = math.nan
    icc_3_1_interval: Interval = _UNKNOWN
    cmc: float = math.nan


def compute_agreement(measured: FloatArray, reference: FloatArray, waveform: bool = True) -> Agreement:
    """Compute the agreement of pairs (N,); neighbours of a ``waveform`` are not independent."""
    known = np.isfinite(measured) & np.isfinite(reference)
    a, b = measured[known], reference[known]
    n = len(a)
    if n < MIN_PAIRS:
        return Agreement(n, float(n))
    difference = a - b
    bias, sd = float(difference.mean()), float(difference.std(ddof=1))
    worth = effective_sample_size(difference) if waveform else float(n)
    t = float(scipy.special.stdtrit(max(worth - 1.0, 1.0), 0.975))
    half_bias = t * sd / math.sqrt(worth)
    half_limit = t * sd * math.sqrt(1.0 / worth + 1.96**2 / (2.0 * max(worth - 1.0, 1.0)))
    low, high = bias - 1.96 * sd, bias + 1.96 * sd
    both_vary = a.std() > 0.0 and b.std() > 0.0
    both = np.column_stack((a, b))
    return Agreement(
        n,
        worth,
        bias,
        (bias - half_bias, bias + half_bias),
        sd,
        (low, high),
        (low - half_limit, low + half_limit),
        (high - half_limit, high + half_limit),
        float(np.sqrt(np.mean(difference**2))),
        float(np.abs(difference).max()),
        float(np.corrcoef(a, b)[0, 1]) if both_vary else math.nan,
        *icc_2_1(both, worth),
        *icc_3_1(both, worth),
        cmc(a, b) if waveform else math.nan,
    )


@dataclass(frozen=True, slots=True)
class VarianceComponents:
    """Variance of the differences between people and within one; NaN if nobody has two pairs."""

    people: int
    sd_between: float = math.nan
    sd_within: float = math.nan


def min_pairs_per_person(*, waveform: bool) -> int:
    """Return the pairs that a person needs: one reading, or a piece of a curve."""
    return MIN_PAIRS if waveform else 1


def compute_pooled_agreement(
    measured: Sequence[FloatArray], reference: Sequence[FloatArray], waveform: bool = True
) -> tuple[Agreement, VarianceComponents]:
    """Compute the agreement of several people with pairs (N,) each, whose true values vary.

    Each person has the same weight. The variance of a difference is that between people and that within one (Bland and
    Altman 2007, section 3, unweighted means); intervals of the limits recover both variances (Zou 2013). ICC and CMC
    are NaN: the pairs of several people have none in common.
    """
    least = min_pairs_per_person(waveform=waveform)
    known = [np.isfinite(a) & np.isfinite(b) for a, b in zip(measured, reference, strict=True)]
    pairs = [(a[k], b[k]) for a, b, k in zip(measured, reference, known, strict=True) if k.sum() >= least]
    people, differences = len(pairs), [a - b for a, b in pairs]
    count = sum(map(len, differences))
    if people < MIN_PAIRS:
        return Agreement(count), VarianceComponents(people)
    worth = np.array([effective_sample_size(d) if waveform else float(len(d)) for d in differences])
    means = np.array([d.mean() for d in differences])
    # What is left about a person's mean is of fewer independent values than there are pictures.
    df = float(worth.sum() - people)
    within = float((np.array([d.var() for d in differences]) * worth).sum() / df) if df > 0.0 else 0.0
    of_means = float(means.var(ddof=1))
    share = 1.0 - float((1.0 / worth).mean())
    sd = math.sqrt(of_means + share * within)
    bias, z = float(means.mean()), 1.96
    t = float(scipy.special.stdtrit(people - 1.0, 0.975))

    def variance_error(p: float) -> float:
        """Return the error of the variance on the side of the chi-square's ``p``."""
        parts = [(of_means, people - 1.0), *([(share * within, df)] if df > 0.0 else [])]
        return math.sqrt(sum((v * (1.0 - d / float(scipy.special.chdtri(d, 1.0 - p)))) ** 2 for v, d in parts))

    sd_low, sd_high = math.sqrt(max(sd**2 - variance_error(0.975), 0.0)), math.sqrt(sd**2 + variance_error(0.025))
    mean_part = t**2 * of_means / people
    inner = math.sqrt(mean_part + (z * (sd - sd_low)) ** 2)
    outer = math.sqrt(mean_part + (z * (sd_high - sd)) ** 2)
    half = math.sqrt(mean_part)
    low, high = bias - z * sd, bias + z * sd
    everything = np.concatenate(differences)
    a, b = (np.concatenate(side) for side in zip(*pairs, strict=True))
    found = Agreement(
        count,
        effective_count=float(worth.sum()),
        bias=bias,
        bias_interval=(bias - half, bias + half),
        sd=sd,
        limits=(low, high),
        lower_interval=(low - outer, low + inner),
        upper_interval=(high - inner, high + outer),
        rmse=float(np.sqrt(np.mean(everything**2))),
        largest_difference=float(np.abs(everything).max()),
        correlation=float(np.corrcoef(a, b)[0, 1]) if a.std() > 0.0 and b.std() > 0.0 else math.nan,
    )
    if not df > 0.0:
        return found, VarianceComponents(people)
    between = max(of_means - float((1.0 / worth).mean()) * within, 0.0)
    return found, VarianceComponents(people, math.sqrt(between), math.sqrt(within))


def effective_sample_size(values: FloatArray) -> float:
    """Return the number of independent values of a series (N,), from 2 to N.

    N over 1 + 2 x the sum of its autocorrelation up to its first value below zero.
    """
    n = len(values)
    centred = values - values.mean()
    power = float(centred @ centred)
    if n < MIN_PAIRS or power <= 0.0:
        return float(n)
    size = 1 << (2 * n - 1).bit_length()
    spectrum = np.abs(np.fft.rfft(centred, size)) ** 2
    rho = np.fft.irfft(spectrum, size)[:n] / power
    below = np.flatnonzero(rho <= 0.0)
    end = int(below[0]) if len(below) else n
    return float(min(max(n / (1.0 + 2.0 * float(rho[1:end].sum())), 2.0), n))


def icc_2_1(readings: FloatArray, effective_count: float | None = None) -> tuple[float, Interval]:
    """Compute ICC(2,1) of (subjects, raters) with its interval: random effects, absolute agreement.

    ``effective_count`` is the number of independent subjects. Shrout and Fleiss' example:

    >>> example = np.array([[9, 2, 5, 8], [6, 1, 3, 2], [8, 4, 6, 8], [7, 1, 2, 6], [10, 5, 6, 9], [6, 2, 4, 7.0]])
    >>> icc, (low, high) = icc_2_1(example)
    >>> round(icc, 2), round(low, 2), round(high, 2)
    (0.29, 0.02, 0.76)
    """
    n, k = readings.shape
    ms_rows, ms_columns, ms_rest = _mean_squares(readings)
    below = ms_rows + (k - 1) * ms_rest + k * (ms_columns - ms_rest) / n
    if below <= 0.0 or not np.ptp(readings, axis=0).any():
        return math.nan, _UNKNOWN
    icc = max((ms_rows - ms_rest) / below, _min_icc(k))
    m = n if effective_count is None else max(effective_count, 2.0)
    if ms_rest <= 0.0:
        return icc, (icc, icc) if ms_columns <= 0.0 else _UNKNOWN
    # The variance between raters is that of their means: with fewer independent subjects it is worth less.
    ratio = ms_columns / ms_rest * (m / n)
    positive_icc = icc
    if icc < 0.0:  # estimates of variances are below nothing: what follows from them would cross -1
        if k == 2:
            return icc, _clip_interval(icc, *_concordance_interval(readings, m), k)
        ratio, positive_icc = max(ratio, 1.0), 0.0
    above = (m - 1) * (k - 1) * (k * positive_icc * ratio + m * (1 + (k - 1) * positive_icc) - k * positive_icc) ** 2
    under = (m - 1) * k**2 * positive_icc**2 * ratio**2 + (m * (1 + (k - 1) * positive_icc) - k * positive_icc) ** 2
    v = above / under if under > 0.0 else 1.0
    f_low, f_high = float(scipy.special.fdtri(m - 1, v, 0.975)), float(scipy.special.fdtri(v, m - 1, 0.975))
    ms_columns_m = ratio * ms_rest
    rows_part = k * ms_columns_m + (k * m - k - m) * ms_rest
    low = m * (ms_rows - f_low * ms_rest) / (f_low * rows_part + m * ms_rows)
    high = m * (f_high * ms_rows - ms_rest) / (rows_part + m * f_high * ms_rows)
    return icc, _clip_interval(icc, low, high, k)


def _concordance_interval(pairs: FloatArray, m: float) -> Interval:
    """Return the interval of Lin's coefficient of two readings (N, 2), up to 1/N that of ICC(2,1)."""
    (a, b), t = pairs.T, float(scipy.special.stdtrit(max(m - 1.0, 1.0), 0.975))
    product = float(a.std() * b.std())
    r, u = float(np.corrcoef(a, b)[0, 1]), float((a.mean() - b.mean()) ** 2) / product
    c = 2.0 * r * product / float(a.var() + b.var() + u * product)
    if not (-1.0 < c < 0.0 and m > 2.0):
        return _UNKNOWN
    rest = 1.0 - c**2
    variance = (1.0 - r**2) * c**2 / (rest * r**2) + 2.0 * c**3 * (1.0 - c) * u / (r * rest**2)
    variance -= c**4 * u**2 / (2.0 * r**2 * rest**2)
    half = t * math.sqrt(max(variance, 0.0) / (m - 2.0))
    return math.tanh(math.atanh(c) - half), math.tanh(math.atanh(c) + half)


def icc_3_1(readings: FloatArray, effective_count: float | None = None) -> tuple[float, Interval]:
    """Compute ICC(3,1), the consistency of a single reading; an offset between raters does not count.

    >>> example = np.array([[9, 2, 5, 8], [6, 1, 3, 2], [8, 4, 6, 8], [7, 1, 2, 6], [10, 5, 6, 9], [6, 2, 4, 7.0]])
    >>> icc, (low, high) = icc_3_1(example)
    >>> round(icc, 2), round(low, 2), round(high, 2)
    (0.71, 0.34, 0.95)
    """
    n, k = readings.shape
    ms_rows, _, ms_rest = _mean_squares(readings)
    if ms_rows + (k - 1) * ms_rest <= 0.0 or not np.ptp(readings, axis=0).any():
        return math.nan, _UNKNOWN
    icc = (ms_rows - ms_rest) / (ms_rows + (k - 1) * ms_rest)
    if ms_rest <= 0.0:
        return icc, (icc, icc)
    m = n if effective_count is None else max(effective_count, 2.0)
    f, df, df_rest = ms_rows / ms_rest, m - 1.0, (m - 1.0) * (k - 1.0)
    low, high = f / float(scipy.special.fdtri(df, df_rest, 0.975)), f * float(scipy.special.fdtri(df_rest, df, 0.975))
    return icc, _clip_interval(icc, (low - 1) / (low + k - 1), (high - 1) / (high + k - 1), k)


def _mean_squares(readings: FloatArray) -> tuple[float, float, float]:
    """Return the mean squares of subjects, of raters, and of the residual."""
    n, k = readings.shape
    grand = float(readings.mean())
    rows, columns = readings.mean(axis=1), readings.mean(axis=0)
    rest = readings - rows[:, None] - columns[None, :] + grand
    return (
        k * float(((rows - grand) ** 2).sum()) / (n - 1),
        n * float(((columns - grand) ** 2).sum()) / (k - 1),
        float((rest**2).sum()) / ((n - 1) * (k - 1)),
    )


def _min_icc(raters: int) -> float:
    return -1.0 / (raters - 1)


def _clip_interval(icc: float, low: float, high: float, raters: int) -> Interval:
    """Clip an interval to the possible values of an ICC; unknown limits stay so."""
    if not math.isfinite(low + high):
        return _UNKNOWN
    return max(min(low, icc), _min_icc(raters)), min(max(high, icc), 1.0)


def cmc(a: FloatArray, b: FloatArray) -> float:
    """Compute the coefficient of multiple correlation of two waveforms (N,).

    NaN if they differ by more than they move.

    >>> wave = np.sin(np.linspace(0.0, 9.0, 200))
    >>> round(cmc(wave, wave), 3), round(cmc(wave, wave + 0.2), 3)
    (1.0, 0.979)
    """
    both = np.stack((a, b))
    p, f = both.shape
    between = float(((both - both.mean(axis=0)) ** 2).sum()) / (f * (p - 1))
    total = float(((both - both.mean()) ** 2).sum()) / (p * f - 1)
    if total <= 0.0 or between > total:
        return math.nan
    return math.sqrt(1.0 - between / total)


AgreementVerdict = Literal["agree", "apart", "few", "not_judged"]


def judge_agreement(agreement: Agreement, limit: float) -> AgreementVerdict:
    """Compare the limits of agreement with a limit set before (0: none was set).

    ``few``: fewer pairs than :data:`MIN_PAIRS_TO_JUDGE`, or the limits are known less well than the limit requires.

    >>> wave, off = np.sin(np.arange(40.0)) * 30.0, np.tile([-1.0, 1.0], 20)
    >>> [judge_agreement(compute_agreement(wave + off, wave, waveform=False), limit) for limit in (0.0, 1.5, 5.0)]
    ['not_judged', 'apart', 'agree']
    >>> judge_agreement(compute_agreement(wave[:9] + off[:9], wave[:9], waveform=False), 5.0)
    'few'
    """
    if not limit > 0.0:
        return "not_judged"
    if agreement.count < MIN_PAIRS_TO_JUDGE:
        return "few"
    widths = [high - low for low, high in (agreement.lower_interval, agreement.upper_interval)]
    if not max(widths) <= limit:
        return "few"
    return "agree" if max_absolute_limit(agreement) <= limit else "apart"


def max_absolute_limit(agreement: Agreement) -> float:
    """Return the larger absolute limit of agreement; NaN if there is none."""
    return max(map(abs, agreement.limits)) if all(map(math.isfinite, agreement.limits)) else math.nan

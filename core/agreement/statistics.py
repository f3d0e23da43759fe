"""Agreement of paired readings: bias and limits (Bland and Altman 1999), ICC(2,1) (McGraw and Wong 1996), CMC (Kadaba
1989, between two systems). Readings in the order of time, any unit; what is not known is left out in pairs."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import fdtri, stdtrit

from carpus.core.types import FloatArray

FEWEST = 3
"""Pairs below which nothing is said."""
FEWEST_TO_JUDGE = 10

Interval = tuple[float, float]
_UNKNOWN: Interval = (math.nan, math.nan)


@dataclass(frozen=True, slots=True)
class Agreement:
    """``measured`` less ``reference`` of ``count`` pairs, worth ``independent`` ones; intervals of 95 %.

    ``bias``, ``sd`` of the differences, ``limits`` bias ± 1.96 sd, each with its interval; ``rmse``; ``largest``
    difference; ``correlation`` by Pearson; ``icc`` ICC(2,1), absolute agreement; ``cmc`` of the whole waveform, NaN for
    single readings and where the two have nothing in common.
    """

    count: int
    independent: float
    bias: float
    bias_interval: Interval
    sd: float
    limits: Interval
    lower_interval: Interval
    upper_interval: Interval
    rmse: float
    largest: float
    correlation: float
    icc: float
    icc_interval: Interval
    cmc: float


def agreement(measured: FloatArray, reference: FloatArray, waveform: bool = True) -> Agreement:
    """Of pairs (N,). ``waveform``: neighbours in time are alike, so that they count as fewer independent ones."""
    known = np.isfinite(measured) & np.isfinite(reference)
    a, b = measured[known], reference[known]
    n = len(a)
    if n < FEWEST:
        nan = math.nan
        return Agreement(
            n, float(n), nan, _UNKNOWN, nan, _UNKNOWN, _UNKNOWN, _UNKNOWN, nan, nan, nan, nan, _UNKNOWN, nan
        )
    difference = a - b
    bias, sd = float(difference.mean()), float(difference.std(ddof=1))
    worth = independent_count(difference) if waveform else float(n)
    t = float(stdtrit(max(worth - 1.0, 1.0), 0.975))
    half_bias = t * sd / math.sqrt(worth)
    half_limit = t * sd * math.sqrt(1.0 / worth + 1.96**2 / (2.0 * max(worth - 1.0, 1.0)))
    low, high = bias - 1.96 * sd, bias + 1.96 * sd
    both_vary = a.std() > 0.0 and b.std() > 0.0
    icc, icc_interval = icc_2_1(np.column_stack((a, b)), worth)
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
        icc,
        icc_interval,
        cmc(a, b) if waveform else math.nan,
    )


def independent_count(values: FloatArray) -> float:
    """How many independent values a series (N,) is worth: N over 1 + 2 x the sum of its autocorrelation, which is taken
    up to its first value below nothing. At least 2, at most N."""
    n = len(values)
    centred = values - values.mean()
    power = float(centred @ centred)
    if n < FEWEST or power <= 0.0:
        return float(n)
    size = 1 << (2 * n - 1).bit_length()
    spectrum = np.abs(np.fft.rfft(centred, size)) ** 2
    rho = np.fft.irfft(spectrum, size)[:n] / power
    below = np.flatnonzero(rho <= 0.0)
    upto = int(below[0]) if len(below) else n
    return float(min(max(n / (1.0 + 2.0 * float(rho[1:upto].sum())), 2.0), n))


def icc_2_1(readings: FloatArray, worth: float | None = None) -> tuple[float, Interval]:
    """ICC(2,1), two-way random effects, absolute agreement, single reading, of (subjects, raters), and its interval.

    ``worth`` subjects count for the interval where they are not independent. Shrout and Fleiss' example:

    >>> example = np.array([[9, 2, 5, 8], [6, 1, 3, 2], [8, 4, 6, 8], [7, 1, 2, 6], [10, 5, 6, 9], [6, 2, 4, 7.0]])
    >>> icc, (low, high) = icc_2_1(example)
    >>> round(icc, 2), round(low, 2), round(high, 2)
    (0.29, 0.02, 0.76)
    """
    n, k = readings.shape
    grand = float(readings.mean())
    rows, columns = readings.mean(axis=1), readings.mean(axis=0)
    ms_rows = k * float(((rows - grand) ** 2).sum()) / (n - 1)
    ms_columns = n * float(((columns - grand) ** 2).sum()) / (k - 1)
    rest = readings - rows[:, None] - columns[None, :] + grand
    ms_rest = float((rest**2).sum()) / ((n - 1) * (k - 1))
    below = ms_rows + (k - 1) * ms_rest + k * (ms_columns - ms_rest) / n
    if below <= 0.0:
        return math.nan, _UNKNOWN
    icc = (ms_rows - ms_rest) / below
    m = n if worth is None else max(worth, 2.0)
    if ms_rest <= 0.0:
        return icc, (icc, icc) if ms_columns <= 0.0 else _UNKNOWN
    # The variance between raters is that of their means: with fewer independent subjects it is worth less.
    ratio = ms_columns / ms_rest * (m / n)
    above = (m - 1) * (k - 1) * (k * icc * ratio + m * (1 + (k - 1) * icc) - k * icc) ** 2
    under = (m - 1) * k**2 * icc**2 * ratio**2 + (m * (1 + (k - 1) * icc) - k * icc) ** 2
    v = above / under if under > 0.0 else 1.0
    f_low, f_high = float(fdtri(m - 1, v, 0.975)), float(fdtri(v, m - 1, 0.975))
    ms_columns_m = ratio * ms_rest
    rows_part = k * ms_columns_m + (k * m - k - m) * ms_rest
    low = m * (ms_rows - f_low * ms_rest) / (f_low * rows_part + m * ms_rows)
    high = m * (f_high * ms_rows - ms_rest) / (rows_part + m * f_high * ms_rows)
    return icc, (float(max(low, -1.0)), float(min(high, 1.0)))


def cmc(a: FloatArray, b: FloatArray) -> float:
    """Coefficient of multiple correlation of two waveforms (N,); NaN where they differ by more than they move.

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

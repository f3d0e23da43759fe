"""Fewer points for long recordings, without losing an extreme or a gap."""

from __future__ import annotations

import numpy as np

from carpus.ui.plot.series import Series

POINTS_PER_COLUMN = 2


LONGEST_STRETCHES = 3.0
"""Samples that were kept lie up to two stretches apart, a little more where pictures are missing."""


def thinned(series: Series, columns: int) -> Series:
    """At most two samples of each of ``columns`` equal stretches: its smallest and its largest value.

    A stretch without a value keeps one sample of it, so that gaps stay, also those of missing pictures; the widest
    band of a stretch is kept.
    """
    count = len(series.time_s)
    if count <= POINTS_PER_COLUMN * columns:
        return series
    stretch_s = float(np.median(np.diff(series.time_s))) * count / columns
    series = _with_gaps(series)
    count = len(series.time_s)
    size = -(-count // columns)
    rows = -(-count // size)
    first = size * np.arange(rows)
    flat = np.full(rows * size, np.nan)
    flat[:count] = series.value
    value = flat.reshape(rows, size)
    known = np.isfinite(value)
    inside = np.arange(rows * size).reshape(rows, size) < count
    some, gap = known.any(axis=1), (~known & inside).any(axis=1)
    lowest = first + np.where(known, value, np.inf).argmin(axis=1)
    highest = first + np.where(known, value, -np.inf).argmax(axis=1)
    unknown = first + (~known & inside).argmax(axis=1)
    kept = np.zeros(count, dtype=bool)
    for index in (
        lowest[some], highest[some], unknown[gap & some], first[~some], np.minimum(first + size, count)[~some] - 1,
    ):  # fmt: skip
        kept[index] = True
    index = np.flatnonzero(kept)
    sd = None
    if series.sd is not None:
        spread = np.full(rows * size, -np.inf)
        spread[:count] = np.where(np.isfinite(series.sd), series.sd, -np.inf)
        widest = spread.reshape(rows, size).max(axis=1)[index // size]
        sd = np.where(np.isfinite(widest), widest, np.nan)
    return Series(
        series.time_s[index], series.value[index], sd, series.predicted[index],
        max(series.longest_step_s, LONGEST_STRETCHES * stretch_s),
    )  # fmt: skip


def within(series: Series, start_s: float, end_s: float) -> Series:
    """The samples of a stretch of time, with one beyond each end so that the line goes to the edge."""
    first = max(int(np.searchsorted(series.time_s, start_s)) - 1, 0)
    last = int(np.searchsorted(series.time_s, end_s, side="right")) + 1
    if first == 0 and last >= len(series.time_s):
        return series
    part = slice(first, last)
    sd = None if series.sd is None else series.sd[part]
    return Series(series.time_s[part], series.value[part], sd, series.predicted[part], series.longest_step_s)


def _with_gaps(series: Series) -> Series:
    """A sample without a value in the middle of each step that is too long to be joined."""
    before = np.flatnonzero(np.diff(series.time_s) > series.longest_step_s)
    if not len(before):
        return series
    middle_s = 0.5 * (series.time_s[before] + series.time_s[before + 1])
    return Series(
        np.insert(series.time_s, before + 1, middle_s),
        np.insert(series.value, before + 1, np.nan),
        None if series.sd is None else np.insert(series.sd, before + 1, np.nan),
        np.insert(series.predicted, before + 1, False),
        series.longest_step_s,
    )

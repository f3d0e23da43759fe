"""Fewer points for long recordings, without losing an extreme or a gap."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from ui.plot.series import Series

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
    edges = np.linspace(0, len(series.time_s), columns + 1).astype(int)
    kept: list[int] = []
    sd = None if series.sd is None else series.sd.copy()
    for start, stop in pairwise(edges.tolist()):
        part = series.value[start:stop]
        if not np.isfinite(part).any():
            kept += [start, stop - 1]
            continue
        unknown = np.flatnonzero(~np.isfinite(part))
        places = {start + int(np.nanargmin(part)), start + int(np.nanargmax(part))}
        if len(unknown):
            places.add(start + int(unknown[0]))
        if sd is not None and np.isfinite(sd[start:stop]).any():
            sd[list(places)] = np.nanmax(sd[start:stop])
        kept += sorted(places)
    index = np.unique(kept)
    return Series(
        series.time_s[index], series.value[index], None if sd is None else sd[index], series.predicted[index],
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
    middle_s = 0.5 * (series.time_s[before] + series.time_s[before + 1])
    return Series(
        np.insert(series.time_s, before + 1, middle_s),
        np.insert(series.value, before + 1, np.nan),
        None if series.sd is None else np.insert(series.sd, before + 1, np.nan),
        np.insert(series.predicted, before + 1, False),
        series.longest_step_s,
    )

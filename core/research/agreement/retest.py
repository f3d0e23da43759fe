"""Test-retest reliability: measurement error from people measured repeatedly with markers placed anew.

Analysis of variance (McGraw and Wong 1996; Weir 2005). The standard error of measurement is of absolute agreement: it
includes the differences between placements, days and raters.
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from carpus.core.formats.output_files import MACHINE_DIALECT, TableDialect, format_cell, write_new_table
from carpus.core.measures.change_limits import MDC95_FACTOR, MIN_PEOPLE, MeasuredLimit, RetestStudy
from carpus.core.model.types import FloatArray
from carpus.core.research.agreement.statistics import Interval, icc_2_1, icc_3_1
from carpus.core.results.progress import incomparable_reasons, select_latest_versions
from carpus.core.results.session_results import SessionResults

MAX_DAYS_APART = 14.0
"""Two placements further apart include the person's change."""
_UNKNOWN: Interval = (math.nan, math.nan)


@dataclass(frozen=True, slots=True)
class RetestResult:
    """Reliability of one quantity, in its unit, with 95 % intervals.

    ``icc`` and ``icc_3_1`` are ICC(2,1) and ICC(3,1); ``sem`` is the standard error of measurement, ``intra_rater_sem``
    that of placements by one rater (NaN with fewer than two known raters or no repeated placement);
    ``systematic_change`` is the mean of the last placements less that of the first.
    """

    people: int
    readings: int
    icc: float = math.nan
    icc_interval: Interval = _UNKNOWN
    icc_3_1: float = math.nan
    icc_3_1_interval: Interval = _UNKNOWN
    sem: float = math.nan
    sem_interval: Interval = _UNKNOWN
    mdc95: float = math.nan
    mdc95_interval: Interval = _UNKNOWN
    intra_rater_sem: float = math.nan
    systematic_change: float = math.nan


def compute_retest(readings: Sequence[Sequence[float]], raters: Sequence[Sequence[str]] = ()) -> RetestResult:
    """Compute the reliability of repeated readings of each person, in order, and their raters.

    People with one reading are excluded.

    >>> found = compute_retest([[60.0, 62.0], [71.0, 70.0], [55.0, 58.0], [64.0, 64.0]])
    >>> round(found.sem, 3), round(found.mdc95, 3), round(found.icc, 3)
    (1.323, 3.667, 0.951)
    """
    names = raters or [[""] * len(one) for one in readings]
    kept = [
        [(value, who) for value, who in zip(one, of, strict=True) if math.isfinite(value)]
        for one, of in zip(readings, names, strict=True)
    ]
    kept = [one for one in kept if len(one) > 1]
    values = [np.array([value for value, _ in one]) for one in kept]
    n, total = len(values), sum(map(len, values))
    if n < 2:
        return RetestResult(n, total)
    within = sum(float(((one - one.mean()) ** 2).sum()) for one in values)
    df = float(total - n)
    variance = within / df
    each = min(map(len, values))
    if all(len(one) == each for one in values):
        df = _degrees_of_freedom(np.array(values), df)
    sem = math.sqrt(variance)
    quantiles = (float(scipy.special.chdtri(df, 1.0 - share)) for share in (0.975, 0.025))
    low, high = (math.sqrt(df * variance / quantile) for quantile in quantiles)
    table = np.array([one[:each] for one in values])
    mdc95_interval = (MDC95_FACTOR * low, MDC95_FACTOR * high)
    step = float(np.mean([one[-1] - one[0] for one in values]))
    return RetestResult(
        n, total, *icc_2_1(table), *icc_3_1(table), sem, (low, high), MDC95_FACTOR * sem, mdc95_interval,
        _intra_rater_sem(kept), step,
    )  # fmt: skip


def _degrees_of_freedom(table: FloatArray, max_df: float) -> float:
    """Return the degrees of freedom of the error of (people, placements) by Satterthwaite 1946.

    They are fewer if the placements differ systematically.
    """
    n, k = table.shape
    rest = table - table.mean(axis=1, keepdims=True) - table.mean(axis=0, keepdims=True) + table.mean()
    ms_columns = n * float(((table.mean(axis=0) - table.mean()) ** 2).sum()) / (k - 1)
    ms_rest = float((rest**2).sum()) / ((n - 1) * (k - 1))
    a, b = ms_columns / n, ms_rest * (n - 1) / n
    below = a**2 / (k - 1) + b**2 / ((n - 1) * (k - 1))
    return min((a + b) ** 2 / below, max_df) if below > 0.0 else max_df


def _intra_rater_sem(readings: Sequence[Sequence[tuple[float, str]]]) -> float:
    if len({who for one in readings for _, who in one if who}) < 2:
        return math.nan
    squares, df = 0.0, 0
    for one in readings:
        by_rater = defaultdict(list)
        for value, who in one:
            if who:
                by_rater[who].append(value)
        for same in by_rater.values():
            squares += float(((np.array(same) - np.mean(same)) ** 2).sum())
            df += len(same) - 1
    return math.sqrt(squares / df) if df else math.nan


@dataclass(frozen=True, slots=True)
class ExcludedSession:
    """Excluded session with the reason."""

    session_id: str
    reason: str


@dataclass(frozen=True, slots=True)
class RetestAnalysis:
    """Analysis of one exercise: results by angle or joint and movement."""

    protocol: str
    exercise: str
    angle_order: str
    people: int
    sessions: int
    raters: int
    simulated: bool
    results: Mapping[tuple[str, str], RetestResult]
    excluded: tuple[ExcludedSession, ...]

    @property
    def is_usable(self) -> bool:
        """True if it may become the clinic's own error limits."""
        return bool(self.results) and not self.simulated and self.people >= MIN_PEOPLE

    def to_study(self, date: str) -> RetestStudy:
        """Return the study that is stored, with its date."""
        limits = (
            MeasuredLimit(of, movement, one.people, one.sem, one.sem_interval, one.mdc95, one.mdc95_interval)
            for (of, movement), one in self.results.items()
            if math.isfinite(one.mdc95)
        )
        return RetestStudy(
            self.protocol, self.exercise, self.angle_order, date, self.people, self.sessions, self.raters, tuple(limits)
        )


def analyse_retests(
    sessions: Sequence[SessionResults], raters: Mapping[str, str] | None = None
) -> list[RetestAnalysis]:
    """Analyse each exercise and protocol. A person is a pseudonym and a hand; raters by session id."""
    groups: dict[tuple[str, str, str], list[SessionResults]] = defaultdict(list)
    for figures in select_latest_versions(sessions):
        groups[(figures.protocol, figures.exercise.id, figures.angle_order)].append(figures)
    return [_analyse_group(group, raters or {}) for _, group in sorted(groups.items())]


def _analyse_group(group: Sequence[SessionResults], raters: Mapping[str, str]) -> RetestAnalysis:
    people: dict[tuple[str, str], list[SessionResults]] = defaultdict(list)
    excluded: list[ExcludedSession] = []
    for figures in group:  # in order of time
        own = people[(figures.subject_id.casefold(), figures.side)]
        reasons = incomparable_reasons(own[0] if own else figures, figures)
        if not figures.repetition_count:
            reasons = (*reasons, "few_repetitions_after")
        if reasons:
            excluded.append(ExcludedSession(figures.session_id, reasons[0]))
        elif own and (figures.when - own[0].when).total_seconds() > MAX_DAYS_APART * 86400.0:
            excluded.append(ExcludedSession(figures.session_id, "too_late"))
        else:
            own.append(figures)
    excluded += [ExcludedSession(one[0].session_id, "once") for one in people.values() if len(one) == 1]
    measured = [one for one in people.values() if len(one) > 1]
    keys = Counter(key for one in measured for figures in one for key in _range_means(figures))
    found = {}
    for key in keys:
        values = [[_range_means(figures).get(key, math.nan) for figures in one] for one in measured]
        named = [[raters.get(figures.session_id, "") for figures in one] for one in measured]
        found[key] = compute_retest(values, named)
    first = group[0]
    kept = [figures for one in measured for figures in one]
    return RetestAnalysis(
        first.protocol, first.exercise.id, first.angle_order, len(measured), len(kept),
        len({raters[one.session_id] for one in kept if one.session_id in raters}),
        any(one.is_simulated for one in kept), found, tuple(excluded),
    )  # fmt: skip


def _range_means(figures: SessionResults) -> dict[tuple[str, str], float]:
    """Return the mean in degrees of each movement whose range is complete."""
    return {
        row.key: row.mean
        for row in figures.measures_in_group("range")
        if row.count and not (row.wrist_angle < 0 and row.is_lower_bound)
    }


RETEST_COLUMNS = (
    "protocol", "exercise", "of", "movement", "people", "readings", "icc_2_1", "icc_2_1_low", "icc_2_1_high",
    "icc_3_1", "icc_3_1_low", "icc_3_1_high", "sem_deg",
    "sem_low_deg", "sem_high_deg", "mdc95_deg", "mdc95_low_deg", "mdc95_high_deg",
    "sem_same_rater_deg", "last_less_first_deg",
)  # fmt: skip


def list_retests(analyses: Sequence[RetestAnalysis]) -> list[dict[str, Any]]:
    """Return a row for each quantity, by the names of :data:`RETEST_COLUMNS`."""
    rows = []
    for one in analyses:
        for (of, movement), f in one.results.items():
            values = (
                f.icc, *f.icc_interval, f.icc_3_1, *f.icc_3_1_interval, f.sem, *f.sem_interval, f.mdc95,
                *f.mdc95_interval, f.intra_rater_sem, f.systematic_change,
            )  # fmt: skip
            names = (one.protocol, one.exercise, of, movement, f.people, f.readings)
            rows.append(dict(zip(RETEST_COLUMNS, (*names, *values), strict=True)))
    return rows


def write_retests(analyses: Sequence[RetestAnalysis], path: Path, form: TableDialect = MACHINE_DIALECT) -> Path:
    """Write one row for each quantity; an existing file is not replaced."""
    rows = (map(format_cell, row.values()) for row in list_retests(analyses))
    return write_new_table(path, RETEST_COLUMNS, rows, form)

"""Agreement study of several people and sessions, each with its reference.

Its table is CSV with the columns ``person``, ``session`` and ``reference`` (paths from the table's folder), and
optional ``columns`` and ``markers`` (``ANGLE=COLUMN,...``), ``unit`` (deg or rad), ``lag_s`` and ``drift_percent``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from carpus.core.formats import table_read as tables
from carpus.core.formats.output_files import MACHINE_DIALECT, TableDialect, format_cell, write_new_json, write_new_table
from carpus.core.model.errors import CarpusFault, ReferenceUnreadable, ReferenceUnsuited
from carpus.core.model.fault_text import format_fault_line
from carpus.core.model.phrase import phrase
from carpus.core.model.rounding import format_rounded
from carpus.core.platform.provenance import sha256_of_file
from carpus.core.platform.version import __version__
from carpus.core.research.agreement.agreement_files import (
    COLUMNS,
    FileComparison,
    compare_files,
    format_agreements,
    to_row,
)
from carpus.core.research.agreement.compare import (
    DEFAULT_MAX_SHIFT_S,
    MAX_DRIFT_PERCENT,
    MAX_SHIFT_S,
    AnglePairs,
    Comparison,
)
from carpus.core.research.agreement.statistics import (
    Agreement,
    VarianceComponents,
    compute_pooled_agreement,
    min_pairs_per_person,
)
from carpus.core.results.repetition_rows import RepetitionChoices

REQUIRED_COLUMNS = ("person", "session", "reference")
SESSION_GAP_S = 10.0
"""Gap between the sessions of a study on its common time axis."""
STUDY_COLUMNS = (
    "of", "person", "session", "reference", *COLUMNS, "people", "sessions", "sd_between_people_deg",
    "sd_within_person_deg", "remarks",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class StudyRow:
    """One row of the table: a session of a person and its reference."""

    person: str
    session: Path
    reference: Path
    columns: Mapping[str, str]
    markers: Mapping[str, str]
    radians: bool | None
    lag_s: float
    drift: float


@dataclass(frozen=True, slots=True)
class PooledAngle:
    """One angle over all people; those excluded have fewer than ``min_pairs`` pairs."""

    pairs: AnglePairs
    variance: VarianceComponents
    session_count: int
    excluded_people: tuple[str, ...]
    min_pairs: int


@dataclass(frozen=True, slots=True)
class AgreementStudy:
    """Comparison of each row, and the rows that could not be compared with the reason."""

    table: Path
    comparisons: tuple[tuple[StudyRow, FileComparison], ...]
    excluded: tuple[tuple[StudyRow, str], ...]
    pooled_angles: tuple[PooledAngle, ...]

    @property
    def people(self) -> int:
        return len({line.person for line, _ in self.comparisons})

    def to_comparison(self) -> Comparison:
        kinds = sorted({str(result.comparison.kind) for _, result in self.comparisons})
        kind = phrase(
            "{people} people, {sessions} sessions, {kinds}",
            people=self.people, sessions=len(self.comparisons), kinds=", ".join(kinds)
        )  # fmt: skip
        first = self.comparisons[0][1].comparison
        remarks = [f"{one.pairs.name}: {words}" for one in self.pooled_angles for words in _pooling_remarks(one)]
        pairs = tuple(one.pairs for one in self.pooled_angles)
        return Comparison(kind, pairs, first.shift, None, 0, 0, math.nan, math.nan, (), tuple(remarks))


def read_study_table(path: Path, parse_mapping: Callable[[str], Mapping[str, str]]) -> tuple[StudyRow, ...]:
    """Read the rows of a study. Raises :class:`ReferenceUnreadable`."""
    table = tables.read_table(path, REQUIRED_COLUMNS)
    if not {name.lower() for name in table.names} >= set(REQUIRED_COLUMNS):
        raise ReferenceUnreadable(path, phrase("a study's table needs the columns person, session and reference"))
    try:
        return tuple(_parse_row(path, table.row(k), parse_mapping) for k in range(len(table.rows)))
    except ValueError as cause:
        raise ReferenceUnreadable(path, phrase("not readable as a table: {why}", why=str(cause))) from cause


def _parse_row(path: Path, cells: Mapping[str, str], parse_mapping: Callable[[str], Mapping[str, str]]) -> StudyRow:
    if not all(cells[name] for name in REQUIRED_COLUMNS):
        raise ValueError("a line without person, session or reference")
    unit = cells.get("unit", "")
    if unit not in ("", "deg", "rad"):
        raise ValueError(f"no unit is called {unit}")
    return StudyRow(
        cells["person"], path.parent / cells["session"], path.parent / cells["reference"],
        parse_mapping(cells["columns"]) if cells.get("columns") else {},
        parse_mapping(cells["markers"]) if cells.get("markers") else {},
        None if not unit else unit == "rad",
        _parse_limited_number(cells, "lag_s", math.nan, MAX_SHIFT_S),
        0.01 * _parse_limited_number(cells, "drift_percent", 0.0, MAX_DRIFT_PERCENT),
    )  # fmt: skip


def _parse_limited_number(cells: Mapping[str, str], name: str, default: float, limit: float) -> float:
    if not cells.get(name):
        return default
    value = tables.parse_number(cells[name])
    if not abs(value) <= limit:
        raise ValueError(f"{name} is {cells[name]}, from {-limit:g} to {limit:g}")
    return value


def run_study(
    table: Path,
    rows: Sequence[StudyRow],
    *,
    smoothed: bool = False,
    max_shift_s: float = DEFAULT_MAX_SHIFT_S,
    load_choices: Callable[[Path], RepetitionChoices] = lambda _: RepetitionChoices(),
    progress: Callable[[int, int], None] = lambda *_: None,
) -> AgreementStudy:
    """Compare every row; those that cannot be compared are excluded with the reason.

    ``load_choices`` returns the repetitions that a person excluded from a session. Raises :class:`ReferenceUnsuited`
    if no row can be compared.
    """
    comparisons, excluded = list[tuple[StudyRow, FileComparison]](), list[tuple[StudyRow, str]]()
    for number, line in enumerate(rows):
        progress(number, len(rows))
        try:
            result = compare_files(
                line.session, line.reference, columns=line.columns, markers=line.markers, radians=line.radians,
                smoothed=smoothed, max_shift_s=max_shift_s, lag_s=line.lag_s, drift=line.drift,
                choices=load_choices(line.session),
            )  # fmt: skip
        except CarpusFault as fault:
            excluded.append((line, format_fault_line(fault)))
        else:
            comparisons.append((line, result))
    if not comparisons:
        raise ReferenceUnsuited(table, excluded[0][1])
    names = dict.fromkeys(pairs.name for _, result in comparisons for pairs in result.comparison.pairs)
    pooled = tuple(_pool_angle(name, comparisons) for name in names)
    return AgreementStudy(table, tuple(comparisons), tuple(excluded), pooled)


def _pool_angle(name: str, comparisons: Sequence[tuple[StudyRow, FileComparison]]) -> PooledAngle:
    all_pairs: list[AnglePairs] = []
    by_person: dict[str, list[AnglePairs]] = {}
    for row, result in comparisons:
        for pairs in result.comparison.pairs:
            if pairs.name == name:
                all_pairs.append(pairs)
                by_person.setdefault(row.person, []).append(pairs)
    measured = [np.degrees(np.concatenate([one.measured_rad for one in own])) for own in by_person.values()]
    reference = [np.degrees(np.concatenate([one.reference_rad for one in own])) for own in by_person.values()]
    waveform = any(result.comparison.shift is not None for _, result in comparisons)
    agreement, variance = compute_pooled_agreement(measured, reference, waveform)
    min_pairs = min_pairs_per_person(waveform=waveform)
    counts = (np.isfinite(a + b).sum() for a, b in zip(measured, reference, strict=True))
    excluded = tuple(person for person, count in zip(by_person, counts, strict=True) if count < min_pairs)
    times, start_s = [], 0.0
    for one in all_pairs:
        time_s = np.where(np.isfinite(one.time_s), one.time_s, np.arange(len(one.time_s)))
        times.append(start_s + time_s - time_s[0])
        start_s = float(times[-1][-1]) + SESSION_GAP_S
    measured_rad = np.concatenate([one.measured_rad for one in all_pairs])
    reference_rad = np.concatenate([one.reference_rad for one in all_pairs])
    pooled = AnglePairs(name, np.concatenate(times), measured_rad, reference_rad, agreement)
    return PooledAngle(pooled, variance, len(all_pairs), excluded, min_pairs)


def _pooling_remarks(pooled: PooledAngle) -> list[str]:
    out = []
    if pooled.excluded_people:
        facts = {"people": ", ".join(pooled.excluded_people), "fewest": str(pooled.min_pairs)}
        out.append(phrase("excluded from the group values: {people}, fewer than {fewest} pairs", **facts))
    if not math.isfinite(pooled.pairs.figures_deg.bias):
        people = pooled.variance.people
        out.append(phrase("{people} people are too few for group values: three are needed", people=people))
    return [str(words) for words in out]


def write_agreement_study(study: AgreementStudy, folder: Path, form: TableDialect = MACHINE_DIALECT) -> list[Path]:
    """Write ``STEM.study.csv`` (all people, then each session) and ``STEM.study.json``."""
    stem = study.table.stem
    rows = []
    for one in study.pooled_angles:
        values = map(format_cell, to_row(one.pairs).values())
        counts = (str(one.variance.people), str(one.session_count))
        sds = (format_cell(one.variance.sd_between), format_cell(one.variance.sd_within))
        rows.append(["all people", "", "", "", *values, *counts, *sds, "; ".join(_pooling_remarks(one))])
    for line, result in study.comparisons:
        names = (line.person, line.session.name, line.reference.name)
        for pairs in result.comparison.pairs:
            values = map(format_cell, to_row(pairs).values())
            remarks = "; ".join(result.comparison.angle_remarks(pairs.name))
            rows.append(["session", *names, *values, "1", "1", "", "", remarks])
    rows += [
        ["left out", line.person, line.session.name, line.reference.name,
         *[""] * (len(STUDY_COLUMNS) - 5), why]
        for line, why in study.excluded
    ]  # fmt: skip
    content: dict[str, Any] = {
        "software": "Carpus", "software_version": __version__, "table": study.table.name,
        "table_sha256": sha256_of_file(study.table), "differences": "Carpus less reference",
        "limits": "Bland and Altman 2007, the true value varies, people's means unweighted; intervals by Zou 2013",
        "angles": [
            to_row(one.pairs) | {"people": one.variance.people, "sessions": one.session_count,
                                 "sd_between_people_deg": one.variance.sd_between,
                                 "sd_within_person_deg": one.variance.sd_within}
            for one in study.pooled_angles
        ],
        "sessions": [
            {"person": line.person, "session_id": result.session.header.session_id, "session": line.session.name,
             "session_sha256": sha256_of_file(line.session), "reference": line.reference.name,
             "reference_sha256": sha256_of_file(line.reference), "angles": [to_row(p) for p in result.comparison.pairs],
             "lag_s": None if result.comparison.shift is None else result.comparison.shift.lag_s,
             "remarks": result.comparison.remarks}
            for line, result in study.comparisons
        ],
        "left_out": [{"person": line.person, "session": line.session.name, "why": why} for line, why in study.excluded],
    }  # fmt: skip
    return [
        write_new_table(folder / f"{stem}.study.csv", STUDY_COLUMNS, rows, form),
        write_new_json(folder / f"{stem}.study.json", content),
    ]


def format_study(study: AgreementStudy) -> list[str]:
    """Return the lines for a terminal: all people, each session, what was excluded."""
    out = [f"Study        {study.people} people, {len(study.comparisons)} sessions"]
    out += [f"Left out     {line.session.name}, {line.person}: {why}" for line, why in study.excluded]
    for line, result in study.comparisons:
        out += [f"LOOK FIRST   {line.session.name}, {line.person}: {remark}." for remark in result.comparison.remarks]
    out.append(
        "Differences  Carpus less reference, degrees; in brackets 95 % intervals. All people: each counts alike, "
        "limits hold the variance between people and within one (Bland and Altman 2007; Zou 2013)"
    )
    out.append("")
    rows: list[tuple[str, Agreement]] = []
    for one in study.pooled_angles:
        rows.append((f"{one.pairs.name}, all people", one.pairs.figures_deg))
        rows += [
            (f"  {line.person}, {line.session.stem}", pairs.figures_deg)
            for line, result in study.comparisons for pairs in result.comparison.pairs if pairs.name == one.pairs.name
        ]  # fmt: skip
    out += format_agreements(rows)
    out += ["", *(
        f"{one.pairs.name}: sd between people {format_rounded(one.variance.sd_between, 2)}, "
        f"within one {format_rounded(one.variance.sd_within, 2)}"
        for one in study.pooled_angles if math.isfinite(one.variance.sd_within)
    )]  # fmt: skip
    out += [f"{one.pairs.name}: {words}." for one in study.pooled_angles for words in _pooling_remarks(one)]
    return out

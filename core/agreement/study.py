"""A study of agreement: many people and sessions, each with its reference, brought together in one table and picture.

The table that says what belongs together is CSV with the columns ``person``, ``session`` and ``reference`` (paths, from
where the table lies), and where they are needed ``columns`` and ``markers`` (``ANGLE=COLUMN,...``), ``unit`` (deg or
rad), ``lag_s`` and ``drift_percent``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from carpus.core.agreement.compare import FURTHEST_SHIFT_S, LARGEST_DRIFT_PERCENT, MOST_SHIFT_S, Compared, Pairs
from carpus.core.agreement.compared_files import HEAD, Result, cell, compare_files, figure_lines, row_of
from carpus.core.agreement.statistics import Agreement, Between, agreement_of_people, fewest_of_person
from carpus.core.errors import CarpusFault, ReferenceUnreadable, ReferenceUnsuited
from carpus.core.formats import table_read as tables
from carpus.core.formats.new_output import FOR_PROGRAMS, TableForm, new_json, new_table
from carpus.core.phrase import phrase
from carpus.core.provenance import sha256_of_file
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.rounding import written
from carpus.core.version import __version__
from carpus.core.words import one_sentence

NEEDED = ("person", "session", "reference")
BETWEEN_S = 10.0
"""Put between the sessions of a study in its own time."""
STUDY_HEAD = (
    "of", "person", "session", "reference", *HEAD, "people", "sessions", "sd_between_people_deg",
    "sd_within_person_deg", "remarks",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class StudyLine:
    """One line of the table: a session of a person and what it is compared with."""

    person: str
    session: Path
    reference: Path
    columns: Mapping[str, str]
    markers: Mapping[str, str]
    radians: bool | None
    lag_s: float
    drift: float


@dataclass(frozen=True, slots=True)
class OfPeople:
    """One angle over all people: ``pairs`` of all sessions one after the other, with the figures of all, in which those
    ``left_out`` are not: each has fewer than ``fewest`` pairs."""

    pairs: Pairs
    between: Between
    sessions: int
    left_out: tuple[str, ...]
    fewest: int


@dataclass(frozen=True, slots=True)
class AgreementStudy:
    """``compared`` each line and what came of it; ``left_out`` each line that could not be compared, and why."""

    table: Path
    compared: tuple[tuple[StudyLine, Result], ...]
    left_out: tuple[tuple[StudyLine, str], ...]
    angles: tuple[OfPeople, ...]

    @property
    def people(self) -> int:
        return len({line.person for line, _ in self.compared})

    def as_compared(self) -> Compared:
        kinds = sorted({str(result.compared.kind) for _, result in self.compared})
        kind = phrase(
            "{people} people, {sessions} sessions, {kinds}",
            people=self.people, sessions=len(self.compared), kinds=", ".join(kinds)
        )  # fmt: skip
        first = self.compared[0][1].compared
        remarks = [f"{one.pairs.name}: {words}" for one in self.angles for words in _few(one)]
        return Compared(
            kind, tuple(one.pairs for one in self.angles), first.shift, None, 0, 0, math.nan, math.nan, (),
            tuple(remarks),
        )  # fmt: skip


def read_table(path: Path, read_map: Callable[[str], Mapping[str, str]]) -> tuple[StudyLine, ...]:
    """The lines of a study's table. Raises :class:`ReferenceUnreadable`."""
    table = tables.read_table(path, NEEDED)
    if not {name.lower() for name in table.names} >= set(NEEDED):
        raise ReferenceUnreadable(path, phrase("a study's table has the columns person, session and reference"))
    try:
        return tuple(_line(path, table.row(k), read_map) for k in range(len(table.rows)))
    except ValueError as cause:
        raise ReferenceUnreadable(path, phrase("it cannot be read as a table: {why}", why=str(cause))) from cause


def _line(path: Path, said: Mapping[str, str], read_map: Callable[[str], Mapping[str, str]]) -> StudyLine:
    if not all(said[name] for name in NEEDED):
        raise ValueError("a line without person, session or reference")
    unit = said.get("unit", "")
    if unit not in ("", "deg", "rad"):
        raise ValueError(f"no unit is called {unit}")
    return StudyLine(
        said["person"], path.parent / said["session"], path.parent / said["reference"],
        read_map(said["columns"]) if said.get("columns") else {},
        read_map(said["markers"]) if said.get("markers") else {},
        None if not unit else unit == "rad",
        _number(said, "lag_s", math.nan, FURTHEST_SHIFT_S),
        0.01 * _number(said, "drift_percent", 0.0, LARGEST_DRIFT_PERCENT),
    )  # fmt: skip


def _number(said: Mapping[str, str], name: str, usual: float, most: float) -> float:
    if not said.get(name):
        return usual
    value = tables.parse_number(said[name])
    if not abs(value) <= most:
        raise ValueError(f"{name} is {said[name]}, from {-most:g} to {most:g}")
    return value


def study_of(
    table: Path,
    lines: Sequence[StudyLine],
    *,
    smoothed: bool = False,
    most_shift_s: float = MOST_SHIFT_S,
    choices_of: Callable[[Path], RepetitionChoices] = lambda _: RepetitionChoices(),
    progress: Callable[[int, int], None] = lambda *_: None,
) -> AgreementStudy:
    """Compare every line; what cannot be compared is left out with its reason. ``choices_of`` a session: what a person
    left out of it.

    Raises :class:`ReferenceUnsuited` where nothing can.
    """
    done, left_out = list[tuple[StudyLine, Result]](), list[tuple[StudyLine, str]]()
    for number, line in enumerate(lines):
        progress(number, len(lines))
        try:
            result = compare_files(
                line.session, line.reference, columns=line.columns, markers=line.markers, radians=line.radians,
                smoothed=smoothed, most_shift_s=most_shift_s, lag_s=line.lag_s, drift=line.drift,
                choices=choices_of(line.session),
            )  # fmt: skip
        except CarpusFault as fault:
            left_out.append((line, one_sentence(fault)))
        else:
            done.append((line, result))
    if not done:
        raise ReferenceUnsuited(table, left_out[0][1])
    names = dict.fromkeys(pairs.name for _, result in done for pairs in result.compared.pairs)
    return AgreementStudy(table, tuple(done), tuple(left_out), tuple(_of_people(name, done) for name in names))


def _of_people(name: str, done: Sequence[tuple[StudyLine, Result]]) -> OfPeople:
    found = [(line.person, pairs) for line, result in done for pairs in result.compared.pairs if pairs.name == name]
    everything = [pairs for _, pairs in found]
    by_person: dict[str, list[Pairs]] = {}
    for person, pairs in found:
        by_person.setdefault(person, []).append(pairs)
    measured = [np.degrees(np.concatenate([one.measured_rad for one in own])) for own in by_person.values()]
    reference = [np.degrees(np.concatenate([one.reference_rad for one in own])) for own in by_person.values()]
    waveform = any(result.compared.shift is not None for _, result in done)
    figures, between = agreement_of_people(measured, reference, waveform)
    fewest = fewest_of_person(waveform=waveform)
    counts = (np.isfinite(a + b).sum() for a, b in zip(measured, reference, strict=True))
    left_out = tuple(person for person, count in zip(by_person, counts, strict=True) if count < fewest)
    times, begin_s = [], 0.0
    for one in everything:
        time_s = np.where(np.isfinite(one.time_s), one.time_s, np.arange(len(one.time_s)))
        times.append(begin_s + time_s - time_s[0])
        begin_s = float(times[-1][-1]) + BETWEEN_S
    pairs = Pairs(
        name, np.concatenate(times), np.concatenate([one.measured_rad for one in everything]),
        np.concatenate([one.reference_rad for one in everything]), figures,
    )  # fmt: skip
    return OfPeople(pairs, between, len(everything), left_out, fewest)


def _few(one: OfPeople) -> list[str]:
    out = []
    if one.left_out:
        out.append(
            phrase(
                "not in the figures of all: {people}, with fewer than {fewest} pairs",
                people=", ".join(one.left_out),
                fewest=str(one.fewest),
            )
        )
    if not math.isfinite(one.pairs.figures_deg.bias):
        out.append(
            phrase("{people} people are too few for figures of all: three are needed", people=one.between.people)
        )
    return [str(words) for words in out]


def write_study(study: AgreementStudy, folder: Path, form: TableForm = FOR_PROGRAMS) -> list[Path]:
    """Write ``STEM.study.csv`` (first all people, then each session) and ``STEM.study.json``; the files."""
    stem = study.table.stem
    rows = [
        ["all people", "", "", "", *map(cell, row_of(one.pairs).values()), str(one.between.people), str(one.sessions),
         cell(one.between.sd_between), cell(one.between.sd_within), "; ".join(_few(one))]
        for one in study.angles
    ]  # fmt: skip
    rows += [
        ["session", line.person, line.session.name, line.reference.name,
         *map(cell, row_of(pairs).values()), "1", "1", "", "", "; ".join(result.compared.remarks_on(pairs.name))]
        for line, result in study.compared for pairs in result.compared.pairs
    ]  # fmt: skip
    rows += [
        ["left out", line.person, line.session.name, line.reference.name,
         *[""] * (len(STUDY_HEAD) - 5), why]
        for line, why in study.left_out
    ]  # fmt: skip
    said: dict[str, Any] = {
        "software": "Carpus", "software_version": __version__, "table": study.table.name,
        "table_sha256": sha256_of_file(study.table), "differences": "Carpus less reference",
        "limits": "Bland and Altman 2007, the true value varies, people's means unweighted; intervals by Zou 2013",
        "angles": [
            row_of(one.pairs) | {"people": one.between.people, "sessions": one.sessions,
                                 "sd_between_people_deg": one.between.sd_between,
                                 "sd_within_person_deg": one.between.sd_within}
            for one in study.angles
        ],
        "sessions": [
            {"person": line.person, "session_id": result.session.header.session_id, "session": line.session.name,
             "session_sha256": sha256_of_file(line.session), "reference": line.reference.name,
             "reference_sha256": sha256_of_file(line.reference), "angles": [row_of(p) for p in result.compared.pairs],
             "lag_s": None if result.compared.shift is None else result.compared.shift.reference_later_s,
             "remarks": result.compared.remarks}
            for line, result in study.compared
        ],
        "left_out": [{"person": line.person, "session": line.session.name, "why": why} for line, why in study.left_out],
    }  # fmt: skip
    return [
        new_table(folder / f"{stem}.study.csv", STUDY_HEAD, rows, form),
        new_json(folder / f"{stem}.study.json", said),
    ]


def study_lines(study: AgreementStudy) -> list[str]:
    """What a terminal shows: all people, each session, what was left out."""
    out = [f"Study        {study.people} people, {len(study.compared)} sessions"]
    out += [f"Left out     {line.session.name}, {line.person}: {why}" for line, why in study.left_out]
    for line, result in study.compared:
        out += [f"LOOK FIRST   {line.session.name}, {line.person}: {remark}." for remark in result.compared.remarks]
    out.append(
        "Differences  Carpus less reference, degrees; in brackets 95 % intervals. All people: each counts alike, "
        "limits hold the variance between people and within one (Bland and Altman 2007; Zou 2013)"
    )
    out.append("")
    rows: list[tuple[str, Agreement]] = []
    for one in study.angles:
        rows.append((f"{one.pairs.name}, all people", one.pairs.figures_deg))
        rows += [
            (f"  {line.person}, {line.session.stem}", pairs.figures_deg)
            for line, result in study.compared for pairs in result.compared.pairs if pairs.name == one.pairs.name
        ]  # fmt: skip
    out += figure_lines(rows)
    out += ["", *(
        f"{one.pairs.name}: sd between people {written(one.between.sd_between, 2)}, "
        f"within one {written(one.between.sd_within, 2)}"
        for one in study.angles if math.isfinite(one.between.sd_within)
    )]  # fmt: skip
    out += [f"{one.pairs.name}: {words}." for one in study.angles for words in _few(one)]
    return out

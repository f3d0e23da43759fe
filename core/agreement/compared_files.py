"""From two files to an agreement, and from it to a table, plain values, and lines for a terminal. Degrees; Carpus less
reference."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from carpus.core.agreement.compare import MOST_SHIFT_S, Compared, Pairs, compare
from carpus.core.agreement.reference import read_reference
from carpus.core.agreement.statistics import FEWEST, FEWEST_TO_JUDGE, Agreement, furthest, judged
from carpus.core.formats.new_output import FOR_PROGRAMS, TableForm, new_json, new_table
from carpus.core.formats.provenance import provenance
from carpus.core.formats.take import number
from carpus.core.hand.forearm_rotation import as_read_rad
from carpus.core.provenance import sha256_of_file
from carpus.core.results.figures import session_figures
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.rounding import written
from carpus.core.session.reader import read_session
from carpus.core.session.values import Session


@dataclass(frozen=True, slots=True)
class Result:
    """An agreement and the files it is of."""

    compared: Compared
    session: Session
    reference: Path

    @property
    def stem(self) -> str:
        """Of the files that say it."""
        return f"{self.session.path.stem}-against-{self.reference.stem}"


def compare_files(
    session_path: Path,
    reference_path: Path,
    *,
    columns: Mapping[str, str] | None = None,
    markers: Mapping[str, str] | None = None,
    radians: bool | None = None,
    smoothed: bool = False,
    most_shift_s: float = MOST_SHIFT_S,
    lag_s: float = math.nan,
    drift: float = 0.0,
    choices: RepetitionChoices | None = None,
) -> Result:
    """Read both and compare. ``choices`` are what a person left out, for readings of the whole range.

    Raises the faults of reading, and :class:`ReferenceUnsuited`.
    """
    session = read_session(session_path)
    reference = read_reference(reference_path, columns, markers, radians, smoothed, session.header.hand)
    figures = session_figures(session, choices) if reference.readings else None
    compared = compare(
        session, reference, smoothed=smoothed, most_shift_s=most_shift_s, lag_s=lag_s, drift=drift, figures=figures
    )  # fmt: skip
    return Result(compared, session, reference_path)


def write_files(result: Result, folder: Path, form: TableForm = FOR_PROGRAMS) -> list[Path]:
    """Write the tables into a folder; the files. Raises :class:`OutputExists` or :class:`OutputNotWritable`."""
    said = provenance(result.session)
    said["reference"] = {"file": result.reference.name, "sha256": sha256_of_file(result.reference)}
    return write_tables(result.compared, folder, result.stem, said, result.reference.name, form)


HEAD = (
    "angle", "count", "independent", "bias_deg", "bias_low_deg", "bias_high_deg", "sd_deg",
    "limit_low_deg", "limit_low_from_deg", "limit_low_to_deg", "limit_high_deg", "limit_high_from_deg",
    "limit_high_to_deg", "rmse_deg", "largest_deg", "correlation", "icc_2_1", "icc_2_1_low", "icc_2_1_high",
    "icc_3_1", "icc_3_1_low", "icc_3_1_high", "cmc",
)  # fmt: skip


def row_of(pairs: Pairs) -> dict[str, Any]:
    """The figures of one angle by the names of :data:`HEAD`."""
    f = pairs.figures_deg
    values = (
        pairs.name, f.count, f.independent, f.bias, *f.bias_interval, f.sd,
        f.limits[0], *f.lower_interval, f.limits[1], *f.upper_interval, f.rmse, f.largest, f.correlation, f.icc,
        *f.icc_interval, f.icc_3_1, *f.icc_3_1_interval, f.cmc,
    )  # fmt: skip
    return dict(zip(HEAD, values, strict=True))


def content(compared: Compared, provenance: Mapping[str, Any], reference: str) -> dict[str, Any]:
    """All of it for JSON."""
    shift, alignment = compared.shift, compared.alignment
    return {
        "reference": reference,
        "reference_kind": compared.kind,
        "differences": "Carpus less reference",
        "angles": [row_of(pairs) for pairs in compared.pairs],
        "lag_s": None if shift is None else shift.reference_later_s,
        "lag_means": "what happens at t in the session happens at t (1 + drift) + lag_s in the reference, each from "
        "its first",
        "match": None if shift is None else shift.match,
        "lag_was_given": None if shift is None else shift.was_given,
        "lag_rivals": None if shift is None else [{"lag_s": lag, "match": match} for lag, match in shift.rivals],
        "drift": None if shift is None else shift.drift,
        "drift_found": None if shift is None else shift.drift_found,
        "remarks": compared.remarks,
        "alignment": None
        if alignment is None
        else {
            "turn_deg": math.degrees(alignment.turn_rad),
            "residual_mm": 1e3 * alignment.residual_m,
            "markers": alignment.markers,
            "zero": alignment.zero,
        },
        "pictures": compared.pictures,
        "left_out": compared.left_out,
        "overlap_s": compared.overlap_s,
        "reference_rate_hz": compared.rate_hz,
        "not_used": compared.not_used,
        "provenance": provenance,
    }


def write_tables(
    compared: Compared,
    folder: Path,
    stem: str,
    provenance: Mapping[str, Any],
    reference: str,
    form: TableForm = FOR_PROGRAMS,
) -> list[Path]:
    """Write ``STEM.agreement.csv``, ``.json`` and the pairs as ``STEM.pairs.csv``; the files."""
    rows = (
        [*(cell(value) for value in row_of(pairs).values()), "; ".join(compared.remarks_on(pairs.name))]
        for pairs in compared.pairs
    )
    pairs = (
        (one.name, number(float(t), 6), number(float(a), 4), number(float(b), 4))
        for one in compared.pairs
        for t, a, b in zip(one.time_s, np.degrees(one.measured_rad), np.degrees(one.reference_rad), strict=True)
    )
    return [
        new_table(folder / f"{stem}.agreement.csv", (*HEAD, "remarks"), rows, form),
        new_json(folder / f"{stem}.agreement.json", content(compared, provenance, reference)),
        new_table(folder / f"{stem}.pairs.csv", ("angle", "time_s", "carpus_deg", "reference_deg"), pairs, form),
    ]


def lines(compared: Compared) -> list[str]:
    """What a terminal shows: what to look at first, how they were brought together, each angle, what was not used."""
    out = [f"LOOK FIRST   {remark}." for remark in compared.remarks]
    if compared.remarks and compared.shift is not None:
        out.append(
            "             --columns ANGLE=-COLUMN turns a sign, --lag and --drift take what is known of the clocks."
        )
    out.append(f"Reference    {compared.kind}")
    if compared.shift is not None:
        shift = compared.shift
        later = "reference" if shift.reference_later_s >= 0.0 else "Carpus"
        found = "as given" if shift.was_given else "found by the curves"
        drifts = f", drift {100.0 * shift.drift:+.2f} % taken out" if shift.drift else ""
        out.append(
            f"Time shift   {written(1e3 * abs(shift.reference_later_s))} ms, {later} later, {found}{drifts}; "
            f"curves match {written(shift.match, 3)}"
        )
    if compared.alignment is not None:
        turn = math.degrees(compared.alignment.turn_rad)
        off = 1e3 * compared.alignment.residual_m
        names = " ".join(compared.alignment.markers)
        out.append(f"Alignment    {written(turn, 1)}° as one rigid body, {written(off, 1)} mm apart ({names})")
        out.append(f"Zero         {compared.alignment.zero}")
    what = "readings" if compared.shift is None else "pictures"
    why = "predicted, doubtful, lost or not still"
    out.append(f"Left out     {compared.left_out} of {compared.pictures} {what}: {why}")
    out.append("Differences  Carpus less reference, degrees; in brackets 95 % intervals, repeated values allowed for")
    out.append("")
    if compared.shift is None:
        out += [*_pair_lines(compared.pairs), ""]
    figures = [(pairs.name, pairs.figures_deg) for pairs in compared.pairs if math.isfinite(pairs.figures_deg.bias)]
    if figures:
        out += [*figure_lines(figures), ""]
    few = [pairs.name for pairs in compared.pairs if not math.isfinite(pairs.figures_deg.bias)]
    out += [f"Not judged: {name}, of which there are fewer than {FEWEST} pairs." for name in few]
    out += [f"Not used: {reason}." for reason in compared.not_used]
    return out


_READ_NAMES = {"pronosupination": "supination, from thumb up"}


def _pair_lines(pairs: Sequence[Pairs]) -> list[str]:
    """Each reading beside what Carpus has for it."""
    names = {one.name: _READ_NAMES.get(one.name, one.name) for one in pairs}
    width = max(map(len, names.values()))
    out = [f"{'':{width}}  {'at':>9}  {'Carpus':>8}  {'reading':>8}  {'difference':>10}"]
    for one in pairs:
        mine, theirs = (as_read_rad(one.name, angle) for angle in (one.measured_rad, one.reference_rad))
        columns = one.time_s, np.degrees(mine), np.degrees(theirs)
        for time_s, mine, other in zip(*columns, strict=True):
            at = f"{written(time_s, 2)} s" if math.isfinite(time_s) else "range"
            out.append(f"{names[one.name]:{width}}  {at:>9}  {mine:8.2f}  {other:8.2f}  {mine - other:10.2f}")
    return out


def figure_lines(figures: Sequence[tuple[str, Agreement]]) -> list[str]:
    """One row for each named agreement under its heads."""
    width = max(len(name) for name, _ in figures)
    heads = ("bias", "limits of agreement", "RMSE", "r", "ICC(2,1)", "ICC(3,1)", "CMC")
    out = ["{:{}}  {:>6}  {:24}  {:19}  {:>5}  {:>6}  {:25}  {:25}  {}".format("", width, "pairs", *heads)]
    for name, f in figures:
        bias = f"{f.bias:6.2f} ({written(f.bias_interval[0], 2)} to {written(f.bias_interval[1], 2)})"
        limits = f"{f.limits[0]:7.2f} to {written(f.limits[1], 2)}"
        iccs = (_with_interval(f.icc, f.icc_interval), _with_interval(f.icc_3_1, f.icc_3_1_interval))
        few = "  too few to judge" if f.count < FEWEST_TO_JUDGE else ""
        out.append(
            f"{name:{width}}  {f.count:6d}  {bias:24}  {limits:19}  {f.rmse:5.2f}  {_short(f.correlation):>6}"
            f"  {iccs[0]:25}  {iccs[1]:25}  {_short(f.cmc)}{few}"
        )
    return out


def limit_lines(all_pairs: Sequence[Pairs], limit_deg: float) -> list[str]:
    """Say of each angle whether both limits of agreement lie within a limit that was set before."""
    said = {
        "agree": "agrees within {limit:g}°",
        "apart": "up to {apart}° apart",
        "few": "too few pairs to say",
    }
    return [
        f"Limit        {pairs.name} {said[verdict].format(limit=limit_deg, apart=apart)}"
        for pairs in all_pairs
        if (verdict := judged(pairs.figures_deg, limit_deg)) in said
        and (apart := written(furthest(pairs.figures_deg), 1))
    ]


def _with_interval(value: float, interval: tuple[float, float]) -> str:
    return f"{_short(value)} ({_short(interval[0])} to {_short(interval[1])})" if math.isfinite(value) else "–"


def _short(value: float) -> str:
    return written(value, 3) if math.isfinite(value) else "–"


def cell(value: Any) -> str:
    """A figure of a table as text; unknown is empty."""
    return number(value, 6) if isinstance(value, float) else str(value)

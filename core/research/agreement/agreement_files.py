"""Comparison of two files, and its tables, JSON and terminal lines; degrees, Carpus less reference."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from carpus.core.formats.export_item import format_number
from carpus.core.formats.export_provenance import build_provenance
from carpus.core.formats.output_files import (
    MACHINE_DIALECT,
    TableDialect,
    format_cell,
    write_new_json,
    write_new_table,
)
from carpus.core.model.hand.forearm_rotation import to_clinical_rad
from carpus.core.model.rounding import format_rounded
from carpus.core.platform.provenance import sha256_of_file
from carpus.core.research.agreement.compare import DEFAULT_MAX_SHIFT_S, AnglePairs, Comparison, compare_session
from carpus.core.research.agreement.reference import read_reference
from carpus.core.research.agreement.statistics import (
    MIN_PAIRS,
    MIN_PAIRS_TO_JUDGE,
    Agreement,
    judge_agreement,
    max_absolute_limit,
)
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.session_results import compute_session_results
from carpus.core.session.reader import read_session
from carpus.core.session.values import Session


@dataclass(frozen=True, slots=True)
class FileComparison:
    """Comparison with the files it is of."""

    comparison: Comparison
    session: Session
    reference: Path

    @property
    def stem(self) -> str:
        """File name stem of its tables."""
        return f"{self.session.path.stem}-against-{self.reference.stem}"


def compare_files(
    session_path: Path,
    reference_path: Path,
    *,
    columns: Mapping[str, str] | None = None,
    markers: Mapping[str, str] | None = None,
    radians: bool | None = None,
    smoothed: bool = False,
    max_shift_s: float = DEFAULT_MAX_SHIFT_S,
    lag_s: float = math.nan,
    drift: float = 0.0,
    choices: RepetitionChoices | None = None,
) -> FileComparison:
    """Read a session and a reference and compare them.

    ``choices`` are the repetitions that a person excluded, for readings of the whole range. Raises as the readers do,
    and :class:`ReferenceUnsuited`.
    """
    session = read_session(session_path)
    reference = read_reference(reference_path, columns, markers, radians, smoothed, session.header.hand)
    figures = compute_session_results(session, choices) if reference.readings else None
    comparison = compare_session(
        session, reference, smoothed=smoothed, max_shift_s=max_shift_s, lag_s=lag_s, drift=drift, figures=figures
    )
    return FileComparison(comparison, session, reference_path)


COLUMNS = (
    "angle", "count", "independent", "bias_deg", "bias_low_deg", "bias_high_deg", "sd_deg",
    "limit_low_deg", "limit_low_from_deg", "limit_low_to_deg", "limit_high_deg", "limit_high_from_deg",
    "limit_high_to_deg", "rmse_deg", "largest_deg", "correlation", "icc_2_1", "icc_2_1_low", "icc_2_1_high",
    "icc_3_1", "icc_3_1_low", "icc_3_1_high", "cmc",
)  # fmt: skip


def to_row(pairs: AnglePairs) -> dict[str, Any]:
    """Return the statistics of one angle by the names of :data:`COLUMNS`."""
    f = pairs.figures_deg
    bias = (f.bias, *f.bias_interval, f.sd)
    limits = (f.limits[0], *f.lower_interval, f.limits[1], *f.upper_interval)
    iccs = (f.icc, *f.icc_interval, f.icc_3_1, *f.icc_3_1_interval)
    errors = (f.rmse, f.largest_difference, f.correlation)
    values = (pairs.name, f.count, f.effective_count, *bias, *limits, *errors, *iccs, f.cmc)
    return dict(zip(COLUMNS, values, strict=True))


def to_json(found: FileComparison) -> dict[str, Any]:
    """Return a comparison, with its provenance and that of the reference, as an object for JSON."""
    comparison = found.comparison
    shift, alignment = comparison.shift, comparison.alignment
    rigid: dict[str, Any] | None = None
    if alignment is not None:
        rigid = {"turn_deg": math.degrees(alignment.rotation_rad), "residual_mm": 1e3 * alignment.residual_m}
        rigid |= {"markers": alignment.markers, "zero": alignment.zero}
    return {
        "reference": found.reference.name,
        "reference_kind": comparison.kind,
        "differences": "Carpus less reference",
        "angles": [to_row(pairs) for pairs in comparison.pairs],
        "lag_s": None if shift is None else shift.lag_s,
        "lag_means": "what happens at t in the session happens at t (1 + drift) + lag_s in the reference, each from "
        "its first",
        "match": None if shift is None else shift.match,
        "lag_was_given": None if shift is None else shift.is_given,
        "lag_rivals": None if shift is None else [{"lag_s": lag, "match": match} for lag, match in shift.rivals],
        "drift": None if shift is None else shift.drift,
        "drift_found": None if shift is None else shift.residual_drift,
        "remarks": comparison.remarks,
        "alignment": rigid,
        "pictures": comparison.frame_count,
        "left_out": comparison.excluded_count,
        "overlap_s": comparison.overlap_s,
        "reference_rate_hz": comparison.rate_hz,
        "not_used": comparison.unused,
        "provenance": build_provenance(found.session)
        | {"reference": {"file": found.reference.name, "sha256": sha256_of_file(found.reference)}},
    }


def write_comparison(found: FileComparison, folder: Path, form: TableDialect = MACHINE_DIALECT) -> list[Path]:
    """Write ``STEM.agreement.csv``, ``.json`` and ``STEM.pairs.csv``; return their paths."""
    comparison, stem = found.comparison, found.stem
    rows = (
        [*(format_cell(value) for value in to_row(pairs).values()), "; ".join(comparison.angle_remarks(pairs.name))]
        for pairs in comparison.pairs
    )
    pairs = (
        (one.name, format_number(float(t), 6), format_number(float(a), 4), format_number(float(b), 4))
        for one in comparison.pairs
        for t, a, b in zip(one.time_s, np.degrees(one.measured_rad), np.degrees(one.reference_rad), strict=True)
    )
    return [
        write_new_table(folder / f"{stem}.agreement.csv", (*COLUMNS, "remarks"), rows, form),
        write_new_json(folder / f"{stem}.agreement.json", to_json(found)),
        write_new_table(folder / f"{stem}.pairs.csv", ("angle", "time_s", "carpus_deg", "reference_deg"), pairs, form),
    ]


def format_comparison(comparison: Comparison) -> list[str]:
    """Return the lines for a terminal, remarks first."""
    out = [f"LOOK FIRST   {remark}." for remark in comparison.remarks]
    if comparison.remarks and comparison.shift is not None:
        hint = "--columns ANGLE=-COLUMN turns a sign, --lag and --drift take what is known of the clocks."
        out.append(f"             {hint}")
    out.append(f"Reference    {comparison.kind}")
    if comparison.shift is not None:
        shift = comparison.shift
        later = "reference" if shift.lag_s >= 0.0 else "Carpus"
        found = "as given" if shift.is_given else "found by the curves"
        drifts = f", drift {100.0 * shift.drift:+.2f} % taken out" if shift.drift else ""
        out.append(
            f"Time shift   {format_rounded(1e3 * abs(shift.lag_s))} ms, {later} later, {found}{drifts}; "
            f"curves match {format_rounded(shift.match, 3)}"
        )
    if comparison.alignment is not None:
        turn = format_rounded(math.degrees(comparison.alignment.rotation_rad), 1)
        off = format_rounded(1e3 * comparison.alignment.residual_m, 1)
        names = " ".join(comparison.alignment.markers)
        out.append(f"Alignment    {turn}° as one rigid body, {off} mm apart ({names})")
        out.append(f"Zero         {comparison.alignment.zero}")
    what = "readings" if comparison.shift is None else "pictures"
    counts = f"{comparison.excluded_count} of {comparison.frame_count} {what}"
    out.append(f"Left out     {counts}: predicted, doubtful, lost or not still")
    out.append("Differences  Carpus less reference, degrees; in brackets 95 % intervals, repeated values allowed for")
    out.append("")
    if comparison.shift is None:
        out += [*_format_pairs(comparison.pairs), ""]
    agreements = [(pairs.name, pairs.figures_deg) for pairs in comparison.pairs]
    known = [(name, agreement) for name, agreement in agreements if math.isfinite(agreement.bias)]
    if known:
        out += [*format_agreements(known), ""]
    few = [name for name, agreement in agreements if not math.isfinite(agreement.bias)]
    out += [f"Not judged: {name}, of which there are fewer than {MIN_PAIRS} pairs." for name in few]
    out += [f"Not used: {reason}." for reason in comparison.unused]
    return out


_READ_NAMES = {"pronosupination": "supination, from thumb up"}


def _format_pairs(pairs: Sequence[AnglePairs]) -> list[str]:
    """Return each reading beside the value of Carpus."""
    names = {one.name: _READ_NAMES.get(one.name, one.name) for one in pairs}
    width = max(map(len, names.values()))
    out = [f"{'':{width}}  {'at':>9}  {'Carpus':>8}  {'reading':>8}  {'difference':>10}"]
    for one in pairs:
        angles = (to_clinical_rad(one.name, angle) for angle in (one.measured_rad, one.reference_rad))
        for time_s, measured, read in zip(one.time_s, *map(np.degrees, angles), strict=True):
            at = f"{format_rounded(time_s, 2)} s" if math.isfinite(time_s) else "range"
            out.append(f"{names[one.name]:{width}}  {at:>9}  {measured:8.2f}  {read:8.2f}  {measured - read:10.2f}")
    return out


def format_agreements(agreements: Sequence[tuple[str, Agreement]]) -> list[str]:
    """Return a table of named agreements."""
    width = max(len(name) for name, _ in agreements)
    heads = ("bias", "limits of agreement", "RMSE", "r", "ICC(2,1)", "ICC(3,1)", "CMC")
    out = ["{:{}}  {:>6}  {:24}  {:19}  {:>5}  {:>6}  {:25}  {:25}  {}".format("", width, "pairs", *heads)]
    for name, f in agreements:
        bias = f"{f.bias:6.2f} ({format_rounded(f.bias_interval[0], 2)} to {format_rounded(f.bias_interval[1], 2)})"
        limits = f"{f.limits[0]:7.2f} to {format_rounded(f.limits[1], 2)}"
        iccs = (_format_with_interval(f.icc, f.icc_interval), _format_with_interval(f.icc_3_1, f.icc_3_1_interval))
        few = "  too few to judge" if f.count < MIN_PAIRS_TO_JUDGE else ""
        r, cmc = _format_coefficient(f.correlation), _format_coefficient(f.cmc)
        out.append(
            f"{name:{width}}  {f.count:6d}  {bias:24}  {limits:19}  {f.rmse:5.2f}  {r:>6}"
            f"  {iccs[0]:25}  {iccs[1]:25}  {cmc}{few}"
        )
    return out


def format_limit_verdicts(all_pairs: Sequence[AnglePairs], limit_deg: float) -> list[str]:
    """Return for each angle whether the limits of agreement lie within a limit set before."""
    texts = {"agree": "agrees within {limit:g}°", "apart": "up to {apart}° apart", "few": "too few pairs to say"}
    return [
        f"Limit        {pairs.name} {texts[verdict].format(limit=limit_deg, apart=apart)}"
        for pairs in all_pairs
        if (verdict := judge_agreement(pairs.figures_deg, limit_deg)) in texts
        and (apart := format_rounded(max_absolute_limit(pairs.figures_deg), 1))
    ]


def _format_with_interval(value: float, interval: tuple[float, float]) -> str:
    low, high = map(_format_coefficient, interval)
    return f"{_format_coefficient(value)} ({low} to {high})" if math.isfinite(value) else "–"


def _format_coefficient(value: float) -> str:
    return format_rounded(value, 3) if math.isfinite(value) else "–"

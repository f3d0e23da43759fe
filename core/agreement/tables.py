"""An agreement as a table, as plain values, and as lines for a terminal. Degrees; Carpus less reference."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from carpus.core.agreement.compare import Compared, Pairs
from carpus.core.agreement.statistics import FEWEST_TO_JUDGE
from carpus.core.formats.new_output import new_json, new_table
from carpus.core.formats.take import number

HEAD = (
    "angle", "count", "independent", "bias_deg", "bias_low_deg", "bias_high_deg", "sd_deg",
    "limit_low_deg", "limit_low_from_deg", "limit_low_to_deg", "limit_high_deg", "limit_high_from_deg",
    "limit_high_to_deg", "rmse_deg", "largest_deg", "correlation", "icc_2_1", "icc_low", "icc_high", "cmc",
)  # fmt: skip


def row_of(pairs: Pairs) -> dict[str, Any]:
    """The figures of one angle by the names of :data:`HEAD`."""
    f = pairs.figures_deg
    values = (
        pairs.name, f.count, f.independent, f.bias, *f.bias_interval, f.sd,
        f.limits[0], *f.lower_interval, f.limits[1], *f.upper_interval, f.rmse, f.largest, f.correlation, f.icc,
        *f.icc_interval, f.cmc,
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
        "lag_means": "what happens at t in the session happens at t + lag_s in the reference, each from its first",
        "match": None if shift is None else shift.match,
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
    compared: Compared, folder: Path, stem: str, provenance: Mapping[str, Any], reference: str
) -> list[Path]:
    """Write ``STEM.agreement.csv``, ``.json`` and the pairs as ``STEM.pairs.csv``; the files."""
    rows = ([_cell(value) for value in row_of(pairs).values()] for pairs in compared.pairs)
    pairs = (
        (one.name, number(float(t), 6), number(float(a), 4), number(float(b), 4))
        for one in compared.pairs
        for t, a, b in zip(one.time_s, np.degrees(one.measured_rad), np.degrees(one.reference_rad), strict=True)
    )
    return [
        new_table(folder / f"{stem}.agreement.csv", HEAD, rows),
        new_json(folder / f"{stem}.agreement.json", content(compared, provenance, reference)),
        new_table(folder / f"{stem}.pairs.csv", ("angle", "time_s", "carpus_deg", "reference_deg"), pairs),
    ]


def lines(compared: Compared) -> list[str]:
    """What a terminal shows: how they were brought together, each angle, what was not used."""
    out = [f"Reference    {compared.kind}"]
    if compared.shift is not None:
        later = "reference" if compared.shift.reference_later_s >= 0.0 else "Carpus"
        by_ms = 1e3 * abs(compared.shift.reference_later_s)
        out.append(f"Time shift   {by_ms:.0f} ms, {later} later; curves match {compared.shift.match:.3f}")
    if compared.alignment is not None:
        turn = math.degrees(compared.alignment.turn_rad)
        off = 1e3 * compared.alignment.residual_m
        names = " ".join(compared.alignment.markers)
        out.append(f"Alignment    {turn:.1f}° as one rigid body, {off:.1f} mm apart ({names})")
        out.append(f"Zero         {compared.alignment.zero}")
    what = "readings" if compared.shift is None else "pictures"
    out.append(
        f"Left out     {compared.left_out} of {compared.pictures} {what}: predicted, doubtful, lost or not still"
    )
    out.append(
        "Differences are Carpus less reference, in degrees; in brackets 95 % intervals, repeated values allowed for"
    )
    width = max(len(pairs.name) for pairs in compared.pairs)
    out.append(
        f"{'':{width}}      n    bias                    limits of agreement  RMSE      r  ICC(2,1)             CMC"
    )
    for pairs in compared.pairs:
        f = pairs.figures_deg
        bias = f"{f.bias:6.2f} ({f.bias_interval[0]:.2f} to {f.bias_interval[1]:.2f})"
        limits = f"{f.limits[0]:7.2f} to {f.limits[1]:.2f}"
        icc = f"{_short(f.icc)} ({_short(f.icc_interval[0])} to {_short(f.icc_interval[1])})"
        few = "  too few to judge" if f.count < FEWEST_TO_JUDGE else ""
        out.append(
            f"{pairs.name:{width}}  {f.count:5d}  {bias:22}  {limits:19}  {f.rmse:4.2f}  {_short(f.correlation):5}"
            f"  {icc:21}  {_short(f.cmc)}{few}"
        )
    out += [f"Not used: {reason}." for reason in compared.not_used]
    return out


def _short(value: float) -> str:
    return f"{value:.3f}" if math.isfinite(value) else "–"


def _cell(value: Any) -> str:
    return number(value, 6) if isinstance(value, float) else str(value)

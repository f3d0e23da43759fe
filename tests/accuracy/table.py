"""The table, as Markdown for the pages."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.model.types import FloatArray
from tests.accuracy.pages import rule_table
from tests.accuracy.readings_table import ReadRow
from tests.accuracy.scenarios import Scenario
from tests.accuracy.scores import CARPUS, SIMPLEST, Mode, Run, Score, score

_METHODS: tuple[tuple[str, str, bool], ...] = (
    ("Carpus, live", CARPUS, False),
    ("Carpus, looking back", CARPUS, True),
    ("simplest thing", SIMPLEST, False),
)
_NONE = "-"


@dataclass(frozen=True, slots=True)
class Row:
    """Runs that are pooled in one row; ``columns`` of their angles."""

    name: str
    mode: Mode
    columns: tuple[str, ...]
    runs: tuple[Run, ...]


def collect_rows(runs: Sequence[Run], scenarios: Sequence[Scenario]) -> Iterator[Row]:
    """Every scenario by measurements, then the pools, then the same by pictures."""
    for mode in ("blobs", "pictures"):
        mine = [run for run in runs if run.mode == mode]
        for scenario in scenarios:
            some = tuple(run for run in mine if run.scenario == scenario.name)
            if some:
                yield Row(scenario.name, mode, scenario.columns, some)
        for pool in dict.fromkeys(scenario.pool for scenario in scenarios if scenario.pool):
            members = [scenario for scenario in scenarios if scenario.pool == pool]
            some = tuple(run for run in mine if run.scenario in {member.name for member in members})
            if len(members) > 1 and some:
                yield Row(f"{pool}, pooled", mode, members[0].columns, some)


def read_rows(rows: Sequence[Row]) -> list[ReadRow]:
    """What a therapist reads live off Carpus, by every row."""
    out = []
    for row in rows:
        readings = tuple(run.reading for run in row.runs if run.method == CARPUS and run.reading is not None)
        columns = {
            name: tuple(i for i, one in enumerate(row.columns) if one == name) for name in dict.fromkeys(row.columns)
        }
        if readings:
            out.append(ReadRow(row.name if row.mode == "blobs" else f"{row.name} (pictures)", columns, readings))
    return out


def _three(values: FloatArray, digits: int = 2, factor: float = 1.0) -> str:
    if not np.isfinite(values).any():
        return _NONE
    return " / ".join(f"{factor * value:.{digits}f}" for value in values)


def _scores(row: Row) -> Iterator[tuple[str, Score]]:
    for label, method, smoothed in _METHODS:
        figures = score([run for run in row.runs if run.method == method], row.columns, smoothed=smoothed)
        if figures is not None:
            yield label, figures


def markdown(rows: Sequence[Row]) -> str:
    """One line for every row: RMSE of all methods, and how sure Carpus was of angles and names."""
    head = [
        "row", "recordings", "live", "live, 95th percentile", "looking back", "simplest thing", "within 2 sd, %",
        "mean sd / RMSE", "tracked, %", "wrong, %", "longest swap, s", "back after, s",
    ]  # fmt: skip
    lines = [head]
    for row in rows:
        found = dict(_scores(row))
        live = found.get("Carpus, live")
        if live is None:
            continue
        name = row.name if row.mode == "blobs" else f"{row.name} (pictures)"
        cells = [name, str(live.recordings), _three(live.rmse), _three(live.p95)]
        cells += [
            _three(found[label].rmse) if label in found else _NONE
            for label in ("Carpus, looking back", "simplest thing")
        ]
        cells += [
            _three(live.inside, 0, 100.0),
            _three(live.sd_over_rmse), f"{100 * live.tracked:.1f}", f"{100 * live.wrong:.2f}",
            f"{live.longest_wrong_s:.1f}", f"{live.longest_untracked_s:.1f}",
        ]  # fmt: skip
        lines.append(cells)
    return rule_table(lines)

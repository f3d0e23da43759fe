"""The table as text for the terminal and as Markdown for the README."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.model.types import FloatArray
from tests.accuracy.pages import ruled
from tests.accuracy.readings_table import ReadRow
from tests.accuracy.runs import CARPUS, INFORMED, SIMPLEST, UNTROUBLED, Mode, Run
from tests.accuracy.scenarios import Scenario
from tests.accuracy.scores import Score, score

_METHODS: tuple[tuple[str, str, bool], ...] = (
    ("Carpus, live", CARPUS, False),
    ("Carpus, looking back", CARPUS, True),
    ("without false blobs", UNTROUBLED, False),
    ("simplest thing", SIMPLEST, False),
    ("bound, live", INFORMED, False),
    ("bound, looking back", INFORMED, True),
)
_BOUND_OF = {
    "Carpus, live": "bound, live",
    "without false blobs": "bound, live",
    "Carpus, looking back": "bound, looking back",
}
_NONE = "-"


@dataclass(frozen=True, slots=True)
class Row:
    """Runs that are pooled in one row; ``columns`` of their angles."""

    name: str
    mode: Mode
    columns: tuple[str, ...]
    runs: tuple[Run, ...]


def rows_of(runs: Sequence[Run], scenarios: Sequence[Scenario]) -> Iterator[Row]:
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


def terminal(rows: Sequence[Row]) -> str:
    """A block for every row, a line for every method."""
    lines: list[str] = []
    head = (
        f"{'':24}{'RMSE, degrees':>22}{'95th percentile':>22}{'tracked %':>11}{'wrong %':>9}{'for s':>7}{'back s':>8}"
        f"{'within 2 sd, % (worst)':>28}{'mean sd / RMSE':>22}{'RMSE / bound':>22}{'ms':>8}"
    )
    columns: tuple[str, ...] = ()
    for row in rows:
        if row.columns != columns:
            columns = row.columns
            lines += ["", head, f"{'':24}{' / '.join(dict.fromkeys(columns)):>22}"]
        count = len({run.seed for run in row.runs})
        source = "simulated measurements" if row.mode == "blobs" else "rendered pictures"
        lines.append(f"{row.name}  [{count} x {source}]")
        found = dict(_scores(row))
        for label, s in found.items():
            bound = found.get(_BOUND_OF.get(label, ""))
            over = "" if bound is None else _three(s.rmse / bound.rmse)
            worst = "" if np.isnan(s.worst_inside) else f" ({100 * s.worst_inside:.0f})"
            inside = _three(s.inside, 0, 100.0) + worst
            lines.append(
                f"  {label:22}{_three(s.rmse):>22}{_three(s.p95):>22}{100 * s.tracked:>11.1f}{100 * s.wrong:>9.2f}"
                f"{s.longest_wrong_s:>7.2f}{s.longest_untracked_s:>8.2f}{inside:>28}{_three(s.sd_over_rmse):>22}{over:>22}{s.ms:>8.2f}"
            )
    return "\n".join(lines)


def markdown(rows: Sequence[Row]) -> str:
    """One line for every row: RMSE of all methods, and how sure Carpus was of angles and names."""
    head = [
        "row", "recordings", "live", "live, 95th percentile", "looking back", "simplest thing", "bound",
        "RMSE / bound", "within 2 sd, %", "mean sd / RMSE", "tracked, %", "wrong, %", "longest swap, s",
        "back after, s",
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
            for label in ("Carpus, looking back", "simplest thing", "bound, live")
        ]
        bound = found.get("bound, live")
        cells += [
            _NONE if bound is None else _three(live.rmse / bound.rmse), _three(live.inside, 0, 100.0),
            _three(live.sd_over_rmse), f"{100 * live.tracked:.1f}", f"{100 * live.wrong:.2f}",
            f"{live.longest_wrong_s:.1f}", f"{live.longest_untracked_s:.1f}",
        ]  # fmt: skip
        lines.append(cells)
    return ruled(lines)

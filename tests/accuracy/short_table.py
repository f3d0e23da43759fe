"""The short table of the README: every kind of hand in one line, of what was rendered."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from tests.accuracy.readings import ReadFigures, read_figures
from tests.accuracy.readings_table import WRIST_COLUMNS, ReadRow

_HEAD = (
    "rendered recordings",
    "how many",
    "wrist RMSE",
    "truth within 2 sd, %",
    "range of motion misread, mean",
    "at worst",
    "MCP, PIP",
)


def markdown(kinds: Sequence[tuple[str, Sequence[ReadRow]]]) -> str:
    """One line for every kind of hand by its name, all rows of it pooled, wrists and joints."""
    lines = [" | ".join(_HEAD).join(("| ", " |")), "|---" * len(_HEAD) + "|"]
    for name, rows in kinds:
        wrists = [one for row in rows if "deviation" in row.columns for one in row.readings]
        joints = [row for row in rows if "MCP flexion" in row.columns]
        if not wrists:
            continue
        found = [read_figures(wrists, some) for some in WRIST_COLUMNS.values()]
        cells = [name, str(len(wrists)), *(_three(found, *one) for one in _COLUMNS), _joints(joints)]
        lines.append(" | ".join(cells).join(("| ", " |")))
    return "\n".join(lines)


_COLUMNS: tuple[tuple[Callable[[ReadFigures], float], int], ...] = (
    (lambda f: f.rmse, 2),
    (lambda f: 100.0 * f.inside, 0),
    (lambda f: f.range_mean, 1),
    (lambda f: f.range_worst, 1),
)


def _three(found: Sequence[ReadFigures], figure: Callable[[ReadFigures], float], digits: int) -> str:
    return " / ".join(f"{figure(one):.{digits}f}" for one in found)


def _joints(rows: Sequence[ReadRow]) -> str:
    """RMSE of knuckles and middle joints while seen."""
    if not rows:
        return "-"
    readings = [one for row in rows for one in row.readings]
    return ", ".join(f"{read_figures(readings, rows[0].columns[name]).rmse:.1f}" for name in _SHOWN)


_SHOWN = ("MCP flexion", "PIP flexion")

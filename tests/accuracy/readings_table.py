"""The columns that a therapist reads, as Markdown."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tests.accuracy.pages import rule_table
from tests.accuracy.readings import ReadFigures, Reading, read_figures, unused_share

WRIST_COLUMNS: dict[str, tuple[int, ...]] = {"deviation": (0,), "flexion": (1,), "pro/sup": (2,)}


@dataclass(frozen=True, slots=True)
class ReadRow:
    """Recordings that stand in one row; ``columns`` names groups of their angles."""

    name: str
    columns: dict[str, tuple[int, ...]]
    readings: tuple[Reading, ...]

    def figures(self) -> Iterator[tuple[str, ReadFigures]]:
        for name, some in self.columns.items():
            yield name, read_figures(self.readings, some)


_HEAD = ("RMSE", "p95", "in 2 sd %", "range mean", "worst", "ends RMS", "worst", "zero", "out 3 sd s")


def _cells(f: ReadFigures) -> list[str]:
    return [
        _text(f.rmse, 2), _text(f.p95, 2), _text(100 * f.inside, 0), _text(f.range_mean), _text(f.range_worst),
        _text(f.end_rms), _text(f.end_worst), _text(f.zero_rms), _text(f.outside_s, 2),
    ]  # fmt: skip


def _text(value: float, digits: int = 1) -> str:
    return "-" if np.isnan(value) else f"{value:.{digits}f}"


def markdown(rows: Sequence[ReadRow]) -> str:
    """One line for every row, the groups of angles side by side in its cells."""
    head = ["row", "recordings", "angles", *_HEAD, "unused discs, %"]
    lines = [head]
    for row in rows:
        found = dict(row.figures())
        cells = [" / ".join(values) for values in zip(*map(_cells, found.values()), strict=True)]
        unused = f"{100 * unused_share(row.readings):.1f}"
        lines.append([row.name, str(len(row.readings)), " / ".join(found), *cells, unused])
    return rule_table(lines)


_PATIENT_HEAD = (
    "hand", "recordings", "deviation", "flexion–extension", "pronation–supination", "MCP", "PIP",
    "truth within 2 SD, %", "error of the range of motion: mean", "largest",
)  # fmt: skip


def patient_rows(kinds: Sequence[tuple[str, Sequence[ReadRow]]]) -> list[tuple[str, ...]]:
    """Head and one row for each kind of hand: RMSE of each angle, degrees, then the worst of the wrist's three angles.

    ``kinds`` are names with their recordings' rows, which are pooled.
    """
    lines: list[tuple[str, ...]] = [_PATIENT_HEAD]
    for name, rows in kinds:
        wrists = [one for row in rows if "deviation" in row.columns for one in row.readings]
        if not wrists:
            continue
        found = [read_figures(wrists, some) for some in WRIST_COLUMNS.values()]
        joints = _joint_rmse([row for row in rows if "MCP flexion" in row.columns])
        worst = min(100.0 * one.inside for one in found)
        ranges = (max(one.range_mean for one in found), max(one.range_worst for one in found))
        lines.append(
            (
                name, str(len(wrists)), *(f"{one.rmse:.2f}" for one in found), *joints,
                f"{worst:.0f}", *(f"{value:.1f}" for value in ranges),
            )
        )  # fmt: skip
    return lines


_JOINTS = ("MCP flexion", "PIP flexion")


def _joint_rmse(rows: Sequence[ReadRow]) -> list[str]:
    """RMSE of MCP and PIP flexion while their markers are visible."""
    if not rows:
        return ["-", "-"]
    readings = [one for row in rows for one in row.readings]
    return [f"{read_figures(readings, rows[0].columns[name]).rmse:.1f}" for name in _JOINTS]

"""The columns that a therapist reads, as text for the terminal and as Markdown."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

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


def terminal(rows: Sequence[ReadRow]) -> str:
    """A block for every row, a line for every group of angles."""
    lines = ["What a therapist reads, degrees:", f"{'':16}" + "".join(f"{head:>12}" for head in _HEAD)]
    for row in rows:
        unused = 100 * unused_share(row.readings)
        lines.append(f"{row.name}  [{len(row.readings)} recordings; {unused:.1f} % of visible discs unused]")
        lines += [f"  {name:14}" + "".join(f"{cell:>12}" for cell in _cells(found)) for name, found in row.figures()]
    return "\n".join(lines)


def markdown(rows: Sequence[ReadRow]) -> str:
    """One line for every row, the groups of angles side by side in its cells."""
    head = ["row", "recordings", "angles", *_HEAD, "unused discs, %"]
    lines = [" | ".join(head).join(("| ", " |")), "|---" * len(head) + "|"]
    for row in rows:
        found = dict(row.figures())
        cells = [" / ".join(values) for values in zip(*map(_cells, found.values()), strict=True)]
        whole = [row.name, str(len(row.readings)), " / ".join(found), *cells, f"{100 * unused_share(row.readings):.1f}"]
        lines.append(" | ".join(whole).join(("| ", " |")))
    return "\n".join(lines)

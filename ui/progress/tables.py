"""The sessions of the progress as a table for other programs, and beside it what was measured by hand."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from carpus.core.measures.by_hand import COLUMNS, rows_of
from carpus.core.results.progress import Progress
from carpus.ui.saved_table import named_beside, save_table

HEAD = (
    "session", "created", "hand", "exercise", "movement", "mean_deg", "sd_deg", "best_deg", "n", "not_compared",
    "joint", "at_least",
)  # fmt: skip


def write_tables(path: Path, progress: Progress) -> list[Path]:
    """The table of the sessions, and one beside it of what was measured by hand, if anything was; the files."""
    beside = named_beside(path, "-by-hand", replaces=path.exists())
    write_table(path, progress)
    if not progress.by_hand:
        return [path]
    save_table(beside, list(COLUMNS), rows_of(progress.by_hand))
    return [path, beside]


def write_table(path: Path, progress: Progress) -> None:
    """One line for each session and movement, degrees with one decimal; a session left out says why."""
    save_table(path, HEAD, _rows(progress))


def _rows(progress: Progress) -> Iterator[Sequence[object]]:
    for point in progress.points:
        figures = point.figures
        who = (figures.session_id, figures.when.isoformat(), figures.side, figures.exercise.id)
        for row in (*figures.rows, *figures.joint_rows):
            values = [
                f"{value:.1f}" if math.isfinite(value) else "" for value in (row.mean_deg, row.sd_deg, row.best_deg)
            ]
            reasons, limited = " ".join(point.reasons), "yes" if row.limited else ""
            yield *who, row.movement, *values, row.count, reasons, row.joint, limited

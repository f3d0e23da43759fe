"""The two tables of a batch: what came of every recording, and the measures of every session."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable, Sequence
from dataclasses import astuple, fields
from pathlib import Path
from typing import Any

from carpus.app.batch.work import Outcome
from carpus.core.errors import OutputExists, OutputNotWritable
from carpus.core.output.measures_table import MeasureRow

OUTCOMES_FILE, MEASURES_FILE = "outcomes.csv", "measures.csv"
_OUTCOME_HEAD = ("recording", "session", "outcome", "frames", "tracked_share", "lost_share", "said")
_MEASURE_HEAD = tuple(field.name for field in fields(MeasureRow))


def check_tables(folder: Path) -> None:
    """Raise :class:`OutputExists` where a file of a table's name is somebody else's."""
    for name, head in ((OUTCOMES_FILE, _OUTCOME_HEAD), (MEASURES_FILE, _MEASURE_HEAD)):
        path = folder / name
        if path.exists():
            with path.open(newline="", encoding="utf-8", errors="replace") as file:
                if tuple(next(csv.reader(file), ())) != head:
                    raise OutputExists(path)


def write_tables(outcomes: Sequence[Outcome], folder: Path) -> tuple[Path, Path]:
    """Write both, the tables of an earlier run replaced: they hold all sessions of the folder that were asked for.

    Raises :class:`OutputNotWritable`.
    """
    rows = (
        (
            each.place.recording,
            each.place.name,
            each.result,
            each.frames,
            each.tracked,
            each.lost,
            " ".join(each.said),
        )
        for each in outcomes
    )
    measures = (astuple(row) for each in outcomes for row in each.measures)
    return _written(folder / OUTCOMES_FILE, _OUTCOME_HEAD, rows), _written(
        folder / MEASURES_FILE, _MEASURE_HEAD, measures
    )


def _written(path: Path, head: Sequence[str], rows: Iterable[Sequence[Any]]) -> Path:
    half = path.with_suffix(".csv.half")
    try:
        with half.open("w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerow(head)
            table.writerows([_cell(value) for value in row] for row in rows)
        half.replace(path)
    except OSError as cause:
        half.unlink(missing_ok=True)
        raise OutputNotWritable(path, cause.strerror or "") from cause
    return path


def _cell(value: Any) -> str:
    """Unknown is empty; numbers to six digits that count."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}" if math.isfinite(value) else ""
    return str(value)


def fault_lines(outcomes: Sequence[Outcome]) -> list[str]:
    """What was said of recordings, as a table for the terminal: faults first, then what is doubtful."""
    told = [each for result in ("fault", "tracked", "kept") for each in outcomes if each.result == result and each.said]
    if not told:
        return []
    width = min(48, max(len(str(each.place.recording)) for each in told))
    lines = [f"{'Recording':{width}}  Outcome  What was said"]
    for each in told:
        name = str(each.place.recording)
        shown = name if len(name) <= width else f"...{name[3 - width :]}"
        for i, sentence in enumerate(each.said):
            lines.append(f"{shown if not i else '':{width}}  {each.result if not i else '':7}  {sentence}")
    return lines

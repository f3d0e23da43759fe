"""What came of every recording of a batch, as a table and in words."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from pathlib import Path

from carpus.app.batch.work import Outcome
from carpus.core.errors import OutputExists
from carpus.core.formats.new_output import new_table

OUTCOMES_FILE, MEASURES_FILE = "outcomes.csv", "measures.csv"
_HEAD = ("recording", "session", "outcome", "frames", "tracked_share", "lost_share", "said")


def check_outcomes(folder: Path) -> None:
    """Raise :class:`OutputExists` where the file of the table's name is somebody else's."""
    path = folder / OUTCOMES_FILE
    if path.exists():
        with path.open(newline="", encoding="utf-8", errors="replace") as file:
            if tuple(next(csv.reader(file), ())) != _HEAD:
                raise OutputExists(path)


def write_outcomes(outcomes: Sequence[Outcome], folder: Path) -> Path:
    """The table of all that was asked for, in place of that of an earlier run. Raises :class:`OutputNotWritable`."""
    rows = (
        (
            str(each.place.recording),
            each.place.name,
            each.result,
            str(each.frames),
            *(f"{share:.6g}" if math.isfinite(share) else "" for share in (each.tracked, each.lost)),
            " ".join(each.said),
        )
        for each in outcomes
    )
    return new_table(folder / OUTCOMES_FILE, _HEAD, rows, replaces=True)


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

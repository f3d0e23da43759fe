"""The figures of test and retest as a table."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from carpus.core.agreement.retest import StudyFigures
from carpus.core.formats.new_output import new_table

HEAD = (
    "protocol", "exercise", "of", "movement", "people", "readings", "icc_2_1", "icc_2_1_low", "icc_2_1_high",
    "icc_3_1", "icc_3_1_low", "icc_3_1_high", "sem_deg",
    "sem_low_deg", "sem_high_deg", "mdc95_deg", "mdc95_low_deg", "mdc95_high_deg",
    "sem_same_rater_deg", "last_less_first_deg",
)  # fmt: skip


def write_study(studies: Sequence[StudyFigures], path: Path) -> Path:
    """One line for each figure. Raises :class:`OutputExists` or :class:`OutputNotWritable`."""
    rows = []
    for one in studies:
        for (of, movement), f in one.found.items():
            values = (
                f.icc, *f.icc_interval, f.icc_3_1, *f.icc_3_1_interval, f.sem, *f.sem_interval, f.mdc95,
                *f.mdc95_interval, f.sem_same_rater, f.step,
            )  # fmt: skip
            counts = (str(f.people), str(f.readings))
            rows.append((one.protocol, one.exercise, of, movement, *counts, *map(_cell, values)))
    return new_table(path, HEAD, rows)


def _cell(value: float) -> str:
    return f"{value:.6g}" if math.isfinite(value) else ""

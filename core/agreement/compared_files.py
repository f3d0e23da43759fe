"""From two files to an agreement, and from it to tables."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from carpus.core.agreement.compare import MOST_SHIFT_S, Compared, compare
from carpus.core.agreement.reference import read_reference
from carpus.core.agreement.tables import write_tables
from carpus.core.agreement.watch import UNWATCHED, WorkWatch
from carpus.core.formats.provenance import provenance
from carpus.core.provenance import sha256_of_file
from carpus.core.results.figures import session_figures
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.session.reader import read_session
from carpus.core.session.values import Session


@dataclass(frozen=True, slots=True)
class Result:
    """An agreement and the files it is of."""

    compared: Compared
    session: Session
    reference: Path

    @property
    def stem(self) -> str:
        """Of the files that say it."""
        return f"{self.session.path.stem}-against-{self.reference.stem}"


def compare_files(
    session_path: Path,
    reference_path: Path,
    *,
    columns: Mapping[str, str] | None = None,
    markers: Mapping[str, str] | None = None,
    radians: bool | None = None,
    smoothed: bool = False,
    most_shift_s: float = MOST_SHIFT_S,
    lag_s: float = math.nan,
    drift: float = 0.0,
    choices: RepetitionChoices | None = None,
    watch: WorkWatch = UNWATCHED,
) -> Result:
    """Read both and compare. ``choices`` are what a person left out, for readings of the whole range.

    Raises the faults of reading, :class:`ReferenceUnsuited`, and :class:`Stopped` where ``watch`` says so.
    """
    watch.at(0.0)
    session = read_session(session_path)
    watch.at(0.0)
    reference = read_reference(reference_path, columns, markers, radians, smoothed)
    figures = session_figures(session, choices) if reference.readings else None
    compared = compare(
        session, reference, smoothed=smoothed, most_shift_s=most_shift_s, lag_s=lag_s, drift=drift, figures=figures,
        watch=watch,
    )  # fmt: skip
    watch.at(1.0)
    return Result(compared, session, reference_path)


def write_files(result: Result, folder: Path, software_version: str) -> list[Path]:
    """Write the tables into a folder; the files. Raises :class:`OutputExists` or :class:`OutputNotWritable`."""
    said = provenance(result.session, software_version)
    said["reference"] = {"file": result.reference.name, "sha256": sha256_of_file(result.reference)}
    return write_tables(result.compared, folder, result.stem, said, result.reference.name)

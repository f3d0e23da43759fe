"""Measures of sessions as rows of one long table: CSV, or Parquet with the extra ``carpus[research]``."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import astuple, dataclass, fields
from pathlib import Path
from typing import Any

from carpus.core.formats.output_files import (
    MACHINE_DIALECT,
    TableDialect,
    escape_formula,
    format_cell,
    open_new_file,
    write_new_table,
)
from carpus.core.model.errors import ExtraMissing, OutputExists
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.results.measure import is_total_active_motion, root_mean_square
from carpus.core.results.norms import grade_share
from carpus.core.results.session_results import SessionResults, full_strokes
from carpus.core.results.task_measures import QUANTITIES


@dataclass(frozen=True, slots=True)
class MeasureRow:
    """Row of the table of measures; its fields are the columns of the files.

    ``of``: what was measured; ``positive``: what a larger value means, in all columns; ``estimate``: filter or
    smoother; ``sd``: between repetitions; ``measurement_sd``: of one value; ``at_least``: a lower bound; ``inferred``:
    a DIP joint without a marker is part of it. Unknown is NaN.
    """

    session: str
    session_id: str
    recording_id: str
    subject_id: str
    recorded: str
    simulated: bool
    hand: str
    protocol: str
    exercise: str
    duration_s: float
    frames: int
    tracked_share: float
    repetitions: int
    measure: str
    of: str
    unit: str
    mean: float
    sd: float = math.nan
    best: float = math.nan
    measurement_sd: float = math.nan
    count: int = 1
    at_least: bool = False
    seen_share: float = math.nan
    inferred: bool = False
    positive: str = ""
    estimate: str = ""

    @property
    def key(self) -> str:
        """Name of the measure without spaces, the same in every session."""
        return "_".join(re.findall(r"[a-z0-9]+", f"{self.of} {self.measure.partition(',')[0]}".lower()))

    @property
    def label(self) -> str:
        """Name and unit, for the axis of a figure."""
        unit = "" if self.unit in ("1", "") else f" ({self.unit})"
        return f"{self.of.replace('_', ' ')}, {self.measure}{unit}"


def build_measure_rows(results: SessionResults, session: str) -> tuple[MeasureRow, ...]:
    """Return all measures of a session whose file is called ``session``."""
    quality, rows = results.quality, list[MeasureRow]()
    common = (
        session, results.session_id, results.recording_id, results.subject_id,
        results.when.isoformat(timespec="seconds"), results.is_simulated, results.side, results.protocol,
        results.exercise.id, results.duration_s, quality.frames, quality.measured_share, results.repetition_count,
    )  # fmt: skip
    for one in results.measures:
        if one.group == "still" or (one.group == "speed" and not one.count):
            continue
        name = one.quantity
        if one.group == "share":
            name = ", ".join(filter(None, (name, grade_share(one))))
        elif one.group == "range" and one.wrist_angle < 0:  # an end of a joint or a total is no movement
            name = (_TOTAL_MEASURES if is_total_active_motion(one.subject) else _JOINT_MEASURES).get(name, name)
        positive = QUANTITIES[name].positive if one.group == "task" else _POSITIVE.get(name, "more")
        if name in _JOINT_MEASURES.values():
            positive = positive_direction(one.subject)
        sd = one.measurement_sd
        if one.group == "speed" and name == "smoothness":
            known = (stroke for stroke in full_strokes(results.repetitions) if math.isfinite(stroke.sparc))
            sd = root_mean_square(stroke.sparc_sd() for stroke in known)
        rows.append(
            MeasureRow(
                *common, name, f"{one.subject}, passive" if one.is_passive else one.subject, one.unit, one.mean, one.sd,
                one.best, sd, one.count, one.is_lower_bound, one.seen_share, one.is_inferred,
                positive=positive,
                estimate="smoother" if results.is_smoothed else "filter",
            )
        )  # fmt: skip
    return tuple(rows)


MEASURE_COLUMNS = {
    "measure": "what was measured. Of the wrist flexion, extension, radial, ulnar, supination, pronation each count "
    "in their own direction; below 0 neutral was not reached. Supination and pronation are of the forearm, from thumb "
    "up: a palm flat on the table is at 90 deg of pronation. Of a joint largest and smallest are angles with the sign "
    "of the joint. arc is a size; speeds, times, units, pauses and smoothness are of single strokes, one way, where "
    "the table of repetitions has both ways together; of a whole finger (TAM) total active motion, flexion and "
    "extension deficit",
    "of": 'of which angle, joint, disc or finger; with ", passive" of the repetitions in which somebody else moved the '
    "hand: they are in no other row",
    "positive": "what a larger figure means, the same for mean, best and every column of the row",
    "estimate": "filter or smoother: of whose angles; the smoother's where it ran",
    "mean sd best measurement_sd": "in the unit of the row; sd between repetitions, measurement_sd of one value",
    "count": "how many are in the mean",
    "at_least": "yes where the camera's view limits it: a lower bound",
    "seen_share": "share of the frames in which it was seen, of joints; empty for the wrist",
    "inferred": "yes where an end joint that no disc measures is part of it",
}

_JOINT_MEASURES = {"flexion": "largest", "extension": "smallest"}
_POSITIVE = {
    "flexion": "flexed", "extension": "extended", "radial": "radial", "ulnar": "ulnar",
    "supination": "supinated, 0 is thumb up", "pronation": "pronated, 0 is thumb up",
    "extension deficit": "further from straight", "smoothness": "smoother",
}  # fmt: skip
_TOTAL_MEASURES = {"arc": "total active motion", "extension": "extension deficit"}


def positive_direction(angle: str) -> str:
    """Return what a larger value of an angle of the wrist or of a joint means.

    >>> positive_direction("deviation"), positive_direction("MCP2_abduction"), positive_direction("CMC1_extension")
    ('radial', 'to the thumb', 'thumb away from the index finger in the plane of the palm')
    >>> positive_direction("pronosupination")
    'supinated, 0 is palm down'
    """
    if angle in WRIST_ANGLES:
        return ("radial", "flexed", "supinated, 0 is palm down")[WRIST_ANGLES.index(angle)]
    if angle == "CMC1_extension":
        return "thumb away from the index finger in the plane of the palm"
    if angle == "CMC1_abduction":
        return "thumb away from the palm"
    joint, _, kind = angle.partition("_")
    return {"flexion": "flexed", "abduction": "to the thumb" if joint[-1:] != "1" else "thumb abducted"}.get(kind, "")


PARQUET = ".parquet"
BATCH_ROWS = 10_000
MEASURES_HEADER = tuple(field.name for field in fields(MeasureRow))


def check_measures_path(path: Path, columns: Sequence[str] = ()) -> None:
    """Raise before hours of work what :func:`open_measures_file` would raise for a path.

    A table of measures with these further columns may be replaced, any other file may not.
    """
    parquet = _import_pyarrow()[1] if path.suffix.lower() == PARQUET else None
    if not path.exists():
        return
    try:
        if parquet is not None:
            head = tuple(parquet.read_schema(path).names)
        else:
            with path.open(newline="", encoding="utf-8") as file:
                head = tuple(next(csv.reader(file), ()))
    except (OSError, ValueError, csv.Error) as cause:  # pyarrow's own are of these
        raise OutputExists(path) from cause
    if head != (*MEASURES_HEADER, *columns):
        raise OutputExists(path)


def _import_pyarrow() -> tuple[Any, Any]:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as cause:
        raise ExtraMissing("pyarrow") from cause
    return pyarrow, parquet


@contextmanager
def open_measures_file(
    path: Path, columns: Sequence[str] = (), *, overwrite: bool = False
) -> Iterator[Callable[[Sequence[MeasureRow], Sequence[str]], None]]:
    """Open a table (Parquet by its ending, else CSV) that takes rows as they come, with texts of further columns.

    The file gets its name when it is complete. Raises :class:`OutputExists`, :class:`OutputNotWritable`, or
    :class:`ExtraMissing` without pyarrow.
    """
    if path.suffix.lower() != PARQUET:
        with open_new_file(path, overwrite=overwrite) as file:
            text = io.TextIOWrapper(file, "utf-8", newline="")
            table = csv.writer(text, lineterminator="\n")
            table.writerow((*MEASURES_HEADER, *columns))
            yield lambda rows, facts: table.writerows([*row, *map(escape_formula, facts)] for row in to_csv_rows(rows))
            text.detach()
        return
    pyarrow, parquet = _import_pyarrow()
    by_kind = {"str": pyarrow.string(), "float": pyarrow.float64(), "int": pyarrow.int64(), "bool": pyarrow.bool_()}
    kinds = [(field.name, by_kind[str(field.type)]) for field in fields(MeasureRow)]
    schema = pyarrow.schema([*kinds, *((name, pyarrow.string()) for name in columns)])
    waiting: list[tuple[Any, ...]] = []
    with open_new_file(path, overwrite=overwrite) as file, parquet.ParquetWriter(file, schema) as writer:

        def write_batch() -> None:
            values = zip(*waiting, strict=True)
            arrays = [pyarrow.array(each, kind.type) for each, kind in zip(values, schema, strict=True)]
            writer.write_table(pyarrow.table(arrays, schema=schema))
            waiting.clear()

        def add_rows(rows: Sequence[MeasureRow], facts: Sequence[str]) -> None:
            waiting.extend((*astuple(row), *facts) for row in rows)
            if len(waiting) >= BATCH_ROWS:
                write_batch()

        yield add_rows
        if waiting:
            write_batch()


def write_measures(rows: Sequence[MeasureRow], path: Path, dialect: TableDialect = MACHINE_DIALECT) -> Path:
    """Write a whole table; ``dialect`` is that of a CSV."""
    if path.suffix.lower() != PARQUET:
        return write_new_table(path, MEASURES_HEADER, to_csv_rows(rows), dialect)
    with open_measures_file(path) as take:
        take(rows, ())
    return path


def to_csv_rows(rows: Sequence[MeasureRow]) -> list[list[str]]:
    """Convert rows to texts: unknown is empty, numbers have six significant digits."""
    return [[escape_formula(format_cell(value)) for value in astuple(row)] for row in rows]

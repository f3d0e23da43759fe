"""The list of a study: what each recording is of, checked as a whole before the first one is tracked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from carpus.app.sources import SESSION_SUFFIX, TrackingInput, find_clicks_file
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.formats.measures_files import MEASURES_HEADER
from carpus.core.formats.table_read import read_table
from carpus.core.model.errors import CarpusFault, NameUnsuited
from carpus.core.model.fault_text import format_fault_line
from carpus.core.model.hand.exercises import EXERCISES
from carpus.core.model.names import describe_known_names, normalize_name

MANIFEST_COLUMNS = ("recording", "subject", "hand", "exercise", "clicks", "label")


@dataclass(frozen=True, slots=True)
class Manifest:
    """Recordings of a study, and the names of the further columns; ``problems`` are one sentence a line."""

    inputs: tuple[TrackingInput, ...]
    columns: tuple[str, ...]
    problems: tuple[str, ...]


def read_manifest(path: Path, output: Path) -> Manifest:
    """Read the list of a study, whose paths count from where it lies.

    Raises
    ------
    ReferenceUnreadable
        It is no table.
    """
    table = read_table(path, MANIFEST_COLUMNS)
    known = [name for name in table.names if name.lower() in MANIFEST_COLUMNS]
    columns = tuple(name for name in table.names if name not in known)
    problems = [f"the column “{name}” is one of the results; call it otherwise" for name in columns
                if name in MEASURES_HEADER]  # fmt: skip
    if "recording" not in map(str.lower, known):
        return Manifest((), columns, ("there is no column “recording”",))
    inputs: dict[str, TrackingInput] = {}
    for at, line in enumerate(table.line_numbers):
        cells = {name: cell.strip() for name, cell in table.row(at).items()}
        found = [f"line {line}: {problem}" for problem in _find_problems(cells, path.parent)]
        recording = path.parent / cells["recording"]
        label = cells.get("label") or recording.stem
        if label.casefold() in inputs:  # some disks take both for one file
            found.append(f"line {line}: “{label}” is there twice; give each a label of its own")
        if found:
            problems += found
            continue
        clicks = path.parent / cells["clicks"] if cells.get("clicks") else find_clicks_file(recording)
        name = f"{label}{SESSION_SUFFIX}"
        subject, exercise = cells.get("subject", ""), cells.get("exercise", "")
        facts = tuple(table.rows[at][table.names.index(column)].strip() for column in columns)
        inputs[label.casefold()] = TrackingInput(
            recording.absolute(), clicks, output / name, name, subject, exercise, facts
        )
    if not table.rows:
        problems.append("it has no line with a recording")
    return Manifest(tuple(inputs.values()), columns, tuple(problems))


def _find_problems(cells: Mapping[str, str], folder: Path) -> list[str]:
    """Return what is wrong with a line."""
    out = []
    recording = folder / cells["recording"]
    if not cells["recording"] or not recording.exists():
        out.append(f"recording not found: {recording}")
    elif recording.suffix.lower() == SESSION_SUFFIX:
        out.append(f"{recording} is a session; a list has recordings")
    else:
        clicks = folder / cells["clicks"] if cells.get("clicks") else find_clicks_file(recording)
        try:
            side = "" if clicks is None else read_clicks(clicks).side
        except CarpusFault as fault:
            out.append(format_fault_line(fault))
        else:
            if cells.get("hand") not in (None, "", side):
                out.append(f"hand is “{cells['hand']}”, and the clicks are of the {side} one")
    names = [exercise.id for exercise in EXERCISES]
    exercise = cells.get("exercise", "")
    if exercise and exercise not in names:
        out.append(f"Unknown exercise “{exercise}”; {describe_known_names(exercise, names)}")
    try:
        normalize_name(cells.get("subject", ""))
    except NameUnsuited:
        out.append("the subject is not a short line of text")
    label = cells.get("label", "")
    if label and Path(label).name != label:
        out.append(f"the label “{label}” is not the name of a file")
    return out

"""``carpus track RECORDING... --output FOLDER``: tracks many recordings; can be continued."""

from __future__ import annotations

import argparse
import csv
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from carpus.app.batch.tracking_task import TrackingOutcome, TrackingTask, fault_outcome
from carpus.app.batch.worker_pool import TIME_LIMIT_S, count_cores, run_tasks
from carpus.app.command_line import print_message, print_table, progress_bar, report_usage_error
from carpus.app.sources import SESSION_SUFFIX, TrackingInput, find_clicks_file, plan_inputs
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.formats.measures_table import MEASURES_HEADER, check_measures_path, open_measures_file
from carpus.core.formats.output_files import format_cell, write_new_table
from carpus.core.formats.table_read import read_table
from carpus.core.model.errors import CarpusFault, NameUnsuited, OutputExists, RecordingMissing
from carpus.core.model.fault_text import format_fault_line, shorten
from carpus.core.model.hand.exercises import EXERCISES
from carpus.core.model.names import describe_known_names, normalize_name
from carpus.core.model.rounding import format_rounded
from carpus.core.pipeline.track import TrackSettings
from carpus.core.platform.durable import write_fault
from carpus.core.research.papers.tracker import settings_from_json
from carpus.core.session.reader import read_outline

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
    problems = [f"the column “{name}” is one of the results; give it another name" for name in columns
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
            found.append(f"line {line}: “{label}” occurs twice; give each row its own label")
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


OUTCOMES_FILE, MEASURES_FILE = "outcomes.csv", "measures.csv"
_HEAD = ("recording", "session", "outcome", "frames", "tracked_share", "lost_share", "said")


def check_outcomes(folder: Path) -> None:
    """Raise :class:`OutputExists` if a foreign file has the name of the table."""
    path = folder / OUTCOMES_FILE
    if path.exists():
        with path.open(newline="", encoding="utf-8", errors="replace") as file:
            if tuple(next(csv.reader(file), ())) != _HEAD:
                raise OutputExists(path)


def write_outcomes(outcomes: Sequence[TrackingOutcome], folder: Path) -> Path:
    """Write the table of all recordings, replacing that of an earlier run. Raises :class:`OutputNotWritable`."""
    rows = (
        (
            str(each.tracking_input.recording),
            each.tracking_input.name,
            each.result,
            str(each.frames),
            *map(format_cell, (each.tracked, each.lost)),
            " ".join(each.messages),
        )
        for each in outcomes
    )
    return write_new_table(folder / OUTCOMES_FILE, _HEAD, rows, overwrite=True)


_SINGLE_OPTIONS = ("calibration", "start_angles", "recorded")
"""Options that only one recording can have."""

ApplyOptions = Callable[[TrackSettings], TrackSettings]
"""Applies the options of the command line to settings."""


def run_many(
    paths: Sequence[Path],
    output: Path,
    arguments: argparse.Namespace,
    default_settings: TrackSettings,
    apply_options: ApplyOptions,
) -> int:
    """Track recordings into the folder ``output`` and return the exit code.

    ``apply_options`` changes ``default_settings``, or a session's own settings.
    """
    given = [f"--{name.replace('_', '-')}" for name in _SINGLE_OPTIONS if getattr(arguments, name)]
    if given:
        return report_usage_error(
            "track",
            f"of many recordings each brings its own (calibration.json in its folder, or "
            f"NAME.calibration.json beside a file); leave out {' and '.join(given)}.",
        )
    if output.suffix == SESSION_SUFFIX or output.is_file():
        return report_usage_error("track", "many recordings need a folder as --output.")
    columns: tuple[str, ...] = ()
    if arguments.manifest is not None:
        manifest = read_manifest(arguments.manifest, output.absolute())
        for problem in manifest.problems:
            print_message(f"{arguments.manifest}, {problem}.")
        if manifest.problems:
            return report_usage_error("track", f"{len(manifest.problems)} faults in the list; nothing was tracked.")
        found, columns = list(manifest.inputs), manifest.columns
    else:
        for path in paths:
            if not path.exists():
                raise RecordingMissing(path)
        found = plan_inputs(paths, output.absolute())
        if not found:
            raise RecordingMissing(paths[0], "no recording in this folder or in those in it")
    check_outcomes(output)
    tables = [output / MEASURES_FILE, *([] if arguments.table is None else [arguments.table])]
    for table in tables:
        check_measures_path(table, columns)
    done: list[TrackingOutcome] = []
    tasks: list[TrackingTask] = []
    for place in found:
        try:
            settings = default_settings
            if place.clicks is None:
                told = settings_from_json(read_outline(place.recording).header.parameters)
                settings = default_settings if told is None else told.settings
            subject, exercise = place.subject_id or arguments.subject or "", place.exercise or arguments.exercise
            task = TrackingTask(place, apply_options(settings), subject, exercise, arguments.leave_out_damaged)
            tasks.append(task)
        except CarpusFault as fault:
            done.append(fault_outcome(place, format_fault_line(fault)))
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise write_fault(output, cause) from cause
    begin_s = time.monotonic()
    with ExitStack() as open_tables, progress_bar("tracking", "recording") as progress:
        takers = [open_tables.enter_context(open_measures_file(table, columns, overwrite=True)) for table in tables]
        for outcome in _run_tasks(tasks, arguments):
            for take in takers:
                take(outcome.measures, outcome.tracking_input.facts)
            done.append(replace(outcome, measures=()))  # of thousands of sessions they would fill the memory
            frames = sum(each.frames for each in done if each.result == "tracked")
            pace = f"{format_rounded(frames / max(time.monotonic() - begin_s, 1e-3))} frames a second"
            progress(len(done), len(found), pace if frames else "")
    order = {place.session: number for number, place in enumerate(found)}
    done.sort(key=lambda each: order[each.tracking_input.session])
    return _print_summary(done, [write_outcomes(done, output), *tables], time.monotonic() - begin_s)


def _run_tasks(tasks: Sequence[TrackingTask], arguments: argparse.Namespace) -> Iterator[TrackingOutcome]:
    limit_s = TIME_LIMIT_S if arguments.time_limit is None else 60.0 * arguments.time_limit
    if arguments.scheduler is None:
        return run_tasks(tasks, arguments.jobs or count_cores(), limit_s=limit_s)
    from carpus.app.batch.worker_pool import run_tasks_on_scheduler

    return run_tasks_on_scheduler(arguments.scheduler, tasks, limit_s)


def _print_summary(done: Sequence[TrackingOutcome], tables: Sequence[Path], seconds: float) -> int:
    count = Counter(each.result for each in done)
    told = [each for result in ("fault", "tracked", "kept") for each in done if each.result == result]
    said = [(shorten(str(each.tracking_input.recording)), each.result, text) for each in told for text in each.messages]
    if said:
        print_table(("Recording", "Outcome", "What was said"), said)
    results = f"tracked {count['tracked']}, done before {count['kept']}, faults {count['fault']}"
    a_minute = f", {format_rounded(60.0 * count['tracked'] / seconds, 1)} a minute" if count["tracked"] else ""
    print(f"Recordings: {len(done)}, {results}{a_minute}")
    for path in tables:
        print(f"Table: {path}")
    return 1 if count["fault"] else 0

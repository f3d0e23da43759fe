"""``carpus track RECORDING... --output FOLDER``: many recordings, side by side, begun again where it was left."""

from __future__ import annotations

import argparse
import csv
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

from carpus.app.batch.processes import LIMIT_S, cores, outcomes
from carpus.app.batch.work import Outcome, Task, fault_of
from carpus.app.command_line import bar, misused
from carpus.app.sources import SESSION_SUFFIX, TrackingInput, places
from carpus.core.durable import write_fault
from carpus.core.errors import CarpusFault, OutputExists, RecordingMissing
from carpus.core.formats.measures_files import check_place, measures_file
from carpus.core.formats.new_output import cell, new_table
from carpus.core.pipeline.track import TrackSettings
from carpus.core.research.papers.track import settings_told
from carpus.core.rounding import written
from carpus.core.session.reader import read_outline
from carpus.core.words import one_sentence

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
            *map(cell, (each.tracked, each.lost)),
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


_OF_ONE = ("calibration", "start_angles", "recorded")
"""Options that only one recording can have."""

Chosen = Callable[[TrackSettings], TrackSettings]
"""The options of the command line over settings."""


def run_many(
    named: Sequence[Path], output: Path, arguments: argparse.Namespace, usual: TrackSettings, chosen: Chosen
) -> int:
    """Track all that is named into the folder ``output``, with ``chosen`` over the ``usual`` settings of recordings, or
    over a session's own; the exit code."""
    given = [f"--{name.replace('_', '-')}" for name in _OF_ONE if getattr(arguments, name)]
    if given:
        return misused(
            "track",
            f"of many recordings each brings its own (calibration.json in its folder, or "
            f"NAME.calibration.json beside a file); leave out {' and '.join(given)}.",
        )
    if output.suffix == SESSION_SUFFIX or output.is_file():
        return misused("track", "many recordings need a folder as --output.")
    for path in named:
        if not path.exists():
            raise RecordingMissing(path)
    found = places(named, output.absolute())
    if not found:
        raise RecordingMissing(named[0], "no recording in this folder or in those in it")
    check_outcomes(output)
    tables = [output / MEASURES_FILE, *([] if arguments.table is None else [arguments.table])]
    for table in tables:
        check_place(table)
    done: list[Outcome] = []
    tasks: list[Task] = []
    for place in found:
        try:
            tasks.append(_task(place, arguments, usual, chosen))
        except CarpusFault as fault:
            done.append(fault_of(place, one_sentence(fault)))
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise write_fault(output, cause) from cause
    begin_s = time.monotonic()
    with ExitStack() as open_tables, bar("tracking", "recording") as progress:
        takers = [open_tables.enter_context(measures_file(table, replaces=True)) for table in tables]
        for outcome in _coming(tasks, arguments):
            for take in takers:
                take(outcome.measures)
            done.append(replace(outcome, measures=()))  # of thousands of sessions they would fill the memory
            progress(len(done), len(found), _pace(done, begin_s))
    order = {place.session: number for number, place in enumerate(found)}
    done.sort(key=lambda each: order[each.place.session])
    return _told(done, [write_outcomes(done, output), *tables], time.monotonic() - begin_s)


def _pace(done: Sequence[Outcome], begin_s: float) -> str:
    """Frames tracked a second, of all processes together; nothing before the first."""
    frames = sum(each.frames for each in done if each.result == "tracked")
    return f"{written(frames / max(time.monotonic() - begin_s, 1e-3))} frames a second" if frames else ""


def _coming(tasks: Sequence[Task], arguments: argparse.Namespace) -> Iterator[Outcome]:
    limit_s = LIMIT_S if arguments.time_limit is None else 60.0 * arguments.time_limit
    if arguments.scheduler is None:
        return outcomes(tasks, arguments.jobs or cores(), limit_s=limit_s)
    from carpus.app.batch.processes import outcomes_on

    return outcomes_on(arguments.scheduler, tasks, limit_s)


def _task(place: TrackingInput, arguments: argparse.Namespace, usual: TrackSettings, chosen: Chosen) -> Task:
    settings = usual
    if place.clicks is None:
        told = settings_told(read_outline(place.recording).header.parameters)
        settings = usual if told is None else told.settings
    return Task(place, chosen(settings), arguments.subject or "", arguments.exercise or "", arguments.leave_out_damaged)


def _told(done: Sequence[Outcome], tables: Sequence[Path], seconds: float) -> int:
    count = Counter(each.result for each in done)
    for line in fault_lines(done):
        print(line)
    results = f"tracked {count['tracked']}, done before {count['kept']}, faults {count['fault']}"
    a_minute = f", {written(60.0 * count['tracked'] / seconds, 1)} a minute" if count["tracked"] else ""
    print(f"Recordings: {len(done)}, {results}{a_minute}")
    for path in tables:
        print(f"Table: {path}")
    return 1 if count["fault"] else 0

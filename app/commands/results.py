"""``carpus results``: the measures of all sessions of a study, one table."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import add_region_option, output_type, print_json, print_table
from carpus.core.model.errors import OutputExists
from carpus.core.model.rounding import format_rounded

if TYPE_CHECKING:
    from carpus.core.formats.measures_table import MeasureRow

EXAMPLE = """carpus results sessions
carpus results sessions --output study.csv"""
HEAD = ("Session", "Patient", "Date", "Exercise", "Hand", "n", "Arc", "mean", "sd", "Peak speed", "SPARC", "Tracked")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "sessions", type=Path, nargs="+", metavar="SESSION.h5", help="session files, or folders with sessions"
    )
    parser.add_argument(
        "--output",
        type=output_type(".csv", ".parquet"),
        metavar="TABLE.csv",
        help="table with one row per session and measure, as .csv or .parquet; an existing file is never overwritten",
    )
    parser.add_argument("--json", action="store_true", help="print the same rows as JSON")
    add_region_option(parser)


def run(arguments: argparse.Namespace) -> int:
    if arguments.output is not None and arguments.output.exists():
        raise OutputExists(arguments.output)
    from carpus.app.commands.progress import ALL_PATIENTS, read_measures
    from carpus.app.settings import load_settings
    from carpus.core.formats.measures_table import write_measures

    _, rows = read_measures(ALL_PATIENTS, arguments.sessions, load_settings())
    if arguments.json:
        print_json([asdict(row) for row in rows])
    else:
        sessions: dict[str, list[MeasureRow]] = {}
        for row in rows:
            sessions.setdefault(row.session_id, []).append(row)
        print_table(HEAD, [_summarise(of_session) for of_session in sessions.values()])
    if arguments.output is not None:
        print(f"Written: {write_measures(rows, arguments.output, arguments.form)}")
    return 0


def _summarise(rows: Sequence[MeasureRow]) -> tuple[str, ...]:
    """Return a session's line: the arc of its trained angle, speed and smoothness."""
    first, found = rows[0], {(row.of, row.measure): row for row in rows}
    trained = next((of for of, measure in found if measure == "peak speed"), rows[0].of)

    def show(measure: str, value: str = "mean", decimals: int = 1) -> str:
        number = getattr(found[trained, measure], value) if (trained, measure) in found else math.nan
        return format_rounded(number, decimals) if math.isfinite(number) else "-"

    return (
        first.session, first.subject_id or "-", first.recorded[:10], first.exercise or "-", first.hand,
        str(first.repetitions), trained, show("arc"), show("arc", "sd"), show("peak speed", decimals=0),
        show("smoothness", decimals=2), f"{format_rounded(100.0 * first.tracked_share)} %",
    )  # fmt: skip

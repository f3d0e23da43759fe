"""``carpus track``: tracks a stored recording, or a session again, into a session file."""

from __future__ import annotations

import argparse
from datetime import datetime
from pathlib import Path

from carpus.app.command_line import count_type, number_type, output_type
from carpus.core.model.dates import to_iso
from carpus.core.model.errors import NameUnsuited
from carpus.core.model.hand.exercises import EXERCISES
from carpus.core.model.names import normalize_name

EXAMPLE = """carpus track out/demo --output out/demo.h5
carpus track recordings --output sessions
carpus track --manifest study.csv --output sessions"""
MAX_START_DEG = 120.0
EXERCISE_NAMES = tuple(exercise.id for exercise in EXERCISES)


def parse_pseudonym(text: str) -> str:
    """Parse a pseudonym: a short line of text."""
    try:
        name = normalize_name(text)
    except NameUnsuited:
        name = ""
    if not name:
        raise argparse.ArgumentTypeError("a pseudonym is a short line of text")
    return name


def parse_moment(text: str) -> str:
    """Parse a date, with or without time, in local time unless a zone is given."""
    try:
        return to_iso(datetime.fromisoformat(text))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not a date such as 2023-04-05 or 2023-04-05T14:30") from None


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "recording",
        type=Path,
        nargs="*",
        metavar="RECORDING",
        help="TUM folder, .oni, RealSense or raw recording, or a session (.h5); several, or a folder that is searched "
        "for recordings, are tracked side by side into the folder --output, what is there already left as it is",
    )
    parser.add_argument(
        "--calibration",
        type=Path,
        metavar="CLICKS.json",
        help="first-frame clicks (not for a session); without it, and of many recordings, calibration.json in each "
        "one's folder, or NAME.calibration.json beside its file",
    )
    parser.add_argument(
        "--output",
        type=Path,
        required=True,
        metavar="SESSION.h5",
        help="the file to write, never overwritten; of many recordings the folder for their sessions and tables",
    )
    _add_batch_options(parser)
    _add_method_options(parser)
    _add_recording_options(parser)
    parser.epilog = (
        "A session is tracked again with the settings it was tracked with, a recording with those of settings.toml,\n"
        "unless an option says otherwise."
    )


def _add_batch_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--manifest",
        type=Path,
        metavar="STUDY.csv",
        help="the recordings of a study, instead of RECORDING: columns recording, subject, hand, exercise, clicks, "
        "label (all but the first may be missing) and any further ones, which the table of measures repeats; all "
        "lines are checked before the first recording is tracked",
    )
    parser.add_argument(
        "--jobs",
        type=count_type(1, 1000),
        metavar="N",
        help="number of recordings processed in parallel (default: one for each core)",
    )
    parser.add_argument(
        "--table",
        type=output_type(".csv", ".parquet"),
        metavar="TABLE.csv",
        help="of many recordings: the measures of all sessions also as this .csv or .parquet, written as they "
        "come; only the table of an earlier run is replaced (Parquet needs pyarrow)",
    )
    parser.add_argument(
        "--time-limit",
        type=number_type(0.1, 45000.0, "minutes"),
        metavar="MINUTES",
        help="of many recordings: one that takes longer is abandoned and reported (default: 120)",
    )
    parser.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="of many recordings: track them on the workers of this Dask scheduler, as tcp://host:8786, which see the "
        "same folders (needs the Python package distributed)",
    )


def _add_method_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--filter",
        choices=("default", "paper"),
        help="the default filter, or both papers' method as written, by colour alone and without looking back, with "
        "the hand paper's order of angles (ZYX) for both, as the wrist paper's ZYZ has no value at the neutral pose; "
        "a session's own unless given",
    )
    parser.add_argument(
        "--depth",
        action=argparse.BooleanOptionalAction,
        help="use each marker's depth (default) or colour only",
    )
    parser.add_argument(
        "--dip",
        choices=("coupled", "free"),
        help="DIP joints at two thirds of the PIP joints (default), or free; a session's own unless given",
    )
    parser.add_argument(
        "--discs",
        choices=("on-skin", "in-joints"),
        help="where the finger markers are: on the skin over the joints (default), or in the joints, the papers' "
        "chain; a session's own unless given",
    )
    parser.add_argument(
        "--leave-out-damaged",
        action="store_true",
        help="treat missing and damaged images of a folder as lost frames (otherwise they are a fault)",
    )
    parser.add_argument(
        "--profile", choices=("slow", "standard", "brisk"), help="how lively the hand is (default: standard)"
    )
    parser.add_argument(
        "--smooth",
        action=argparse.BooleanOptionalAction,
        help="also write smoothed results, /smoothed (RTS smoother; default), or not",
    )


def _add_recording_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--start-angles",
        type=number_type(-MAX_START_DEG, MAX_START_DEG, "degrees"),
        nargs=3,
        metavar=("DEVIATION", "FLEXION", "PRONOSUPINATION"),
        help="degrees at the first frame, for a hand that cannot lie neutral, the third from palm "
        "down (thumb up is + 90); added to all angles and marked as given",
    )
    parser.add_argument(
        "--subject", type=parse_pseudonym, metavar="PSEUDONYM", help="stored in the session; never a name"
    )
    parser.add_argument(
        "--exercise",
        choices=EXERCISE_NAMES,
        default="",
        metavar="EXERCISE",
        help="whose repetitions are counted, stored in the session; that of the file of clicks without it; one of "
        + ", ".join(EXERCISE_NAMES),
    )
    parser.add_argument(
        "--recorded",
        type=parse_moment,
        metavar="DATE",
        help="when the hand moved, as 2023-04-05 or 2023-04-05T14:30, for a recording that does not say",
    )
    parser.add_argument(
        "--stream",
        action="store_true",
        help="play one recording in its own time and send what is tracked over Lab Streaming Layer, as in the window; "
        "waits up to 20 s for a listener (needs the Python package pylsl)",
    )


def run(arguments: argparse.Namespace) -> int:
    from carpus.app.commands.track_one import run_track  # the tracker, which no help text needs

    return run_track(arguments)

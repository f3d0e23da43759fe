"""``carpus track``: tracks a stored recording, or a session again, into a session file."""

from __future__ import annotations

import argparse
from datetime import datetime
from pathlib import Path

from carpus.app.command_line import add_examples, count_type, number_type, output_type
from carpus.core.model.dates import to_iso
from carpus.core.model.errors import NameUnsuited
from carpus.core.model.hand.exercises import EXERCISES
from carpus.core.model.names import normalize_name

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


def add_track_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "recording",
        type=Path,
        nargs="*",
        metavar="RECORDING",
        help="a recording (TUM folder, .oni, RealSense or raw) or a session (.h5). Several recordings, or a folder "
        "with recordings, are tracked in parallel into the folder --output. Sessions that exist there are kept "
        "and not tracked again",
    )
    parser.add_argument(
        "--calibration",
        type=Path,
        metavar="CLICKS.json",
        help="file with the markers clicked in the first frame (not for a session). Default, and for several "
        "recordings: calibration.json in the folder of each recording, or NAME.calibration.json next to its file",
    )
    parser.add_argument(
        "--output",
        type=Path,
        required=True,
        metavar="SESSION.h5",
        help="session file to write; an existing file is never overwritten. For several recordings: the folder for "
        "their sessions and tables",
    )
    _add_batch_options(parser)
    _add_method_options(parser)
    _add_recording_options(parser)
    parser.epilog = (
        "A session is tracked with its previous settings, a recording with those of settings.toml,\n"
        "unless an option changes them."
    )
    add_examples(
        parser,
        "carpus track out/demo --output out/demo.h5",
        "carpus track recordings --output sessions",
        "carpus track --manifest study.csv --output sessions",
    )


def _add_batch_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--manifest",
        type=Path,
        metavar="STUDY.csv",
        help="table of the recordings of a study, instead of RECORDING. Columns: recording, and optionally subject, "
        "hand, exercise, clicks and label. Other columns are copied into the table of measures. All lines are "
        "checked before tracking starts",
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
        help="for several recordings: also write the measures of all sessions to this .csv or .parquet file, as soon "
        "as each is ready. Only the table of an earlier run is replaced. Parquet needs the Python package "
        "pyarrow",
    )
    parser.add_argument(
        "--time-limit",
        type=number_type(0.1, 45000.0, "minutes"),
        metavar="MINUTES",
        help="for several recordings: stop tracking a recording after this time, and report it (default: 120)",
    )
    parser.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="for several recordings: track them on the workers of this Dask scheduler, for example tcp://host:8786. "
        "The workers need access to the same folders. Needs the Python package distributed",
    )


def _add_method_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--filter",
        choices=("default", "paper"),
        help="default: the Carpus filter; paper: the published method, with colour only and without smoothing. Paper "
        "uses the angle order ZYX, because ZYZ is undefined in the neutral position. A session keeps its own "
        "filter unless this is given",
    )
    parser.add_argument(
        "--depth",
        action=argparse.BooleanOptionalAction,
        help="use depth and colour (default), or colour only",
    )
    parser.add_argument(
        "--dip",
        choices=("coupled", "free"),
        help="coupled: DIP flexion is two thirds of PIP flexion (default); free: DIP is measured. A session keeps "
        "its own setting unless this is given",
    )
    parser.add_argument(
        "--discs",
        choices=("on-skin", "in-joints"),
        help="where the finger markers are assumed to be: on the skin over the joints (default), or in the joint "
        "centres, as in the published method. A session keeps its own setting unless this is given",
    )
    parser.add_argument(
        "--leave-out-damaged",
        action="store_true",
        help="continue without missing or damaged frames of a folder (otherwise tracking stops there)",
    )
    parser.add_argument(
        "--profile",
        choices=("slow", "standard", "brisk"),
        help="how fast the hand is expected to move (default: standard)",
    )
    parser.add_argument(
        "--smooth",
        action=argparse.BooleanOptionalAction,
        help="also write smoothed results to /smoothed (RTS smoother; on by default)",
    )


def _add_recording_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--start-angles",
        type=number_type(-MAX_START_DEG, MAX_START_DEG, "degrees"),
        nargs=3,
        metavar=("DEVIATION", "FLEXION", "PRONOSUPINATION"),
        help="wrist angles in degrees in the first frame, for a hand that cannot lie in neutral. "
        "Pronation-supination is counted from palm down (thumb up is 90). They are added to all angles, and the "
        "session says so",
    )
    parser.add_argument(
        "--subject",
        type=parse_pseudonym,
        metavar="PSEUDONYM",
        help="pseudonym to store in the session; never use a real name",
    )
    parser.add_argument(
        "--exercise",
        choices=EXERCISE_NAMES,
        default="",
        metavar="EXERCISE",
        help="exercise to store in the session; its repetitions are counted (default: from the clicks file). "
        "One of " + ", ".join(EXERCISE_NAMES),
    )
    parser.add_argument(
        "--recorded",
        type=parse_moment,
        metavar="DATE",
        help="date of the recording, if the recording does not contain it: 2023-04-05 or 2023-04-05T14:30",
    )
    parser.add_argument(
        "--stream",
        action="store_true",
        help="play one recording in real time and stream its angles over Lab Streaming Layer, as the window does. "
        "Waits up to 20 s for a receiver. Needs the Python package pylsl",
    )


def run_track(arguments: argparse.Namespace) -> int:
    from carpus.app.commands import track_one  # the tracker, which no help text needs

    return track_one.run(arguments)

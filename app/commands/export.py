"""``carpus export``: a session in open formats."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from app.desktop.export import export_csv
from core.errors import OutputNotWritable
from core.session.reader import read_session

FORMATS = ("csv", "c3d", "trc", "mot", "bids")
WRITTEN = ("csv",)


def some_formats(text: str) -> tuple[str, ...]:
    """Names of formats, separated by commas; an unknown one is wrong usage."""
    names = tuple(dict.fromkeys(name.strip().lower() for name in text.split(",") if name.strip()))
    unknown = [name for name in names if name not in FORMATS]
    if unknown or not names:
        raise argparse.ArgumentTypeError(f"{text!r} is not made of {', '.join(FORMATS)}")
    return names


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("session", type=Path, metavar="SESSION.h5")
    parser.add_argument(
        "--format",
        type=some_formats,
        default=("csv",),
        metavar="FORMAT,...",
        help="csv; c3d, trc, mot and bids are not there yet",
    )
    parser.add_argument("--output", type=Path, required=True, metavar="FOLDER", help="files in it are not overwritten")


def run(arguments: argparse.Namespace) -> int:
    later = [name for name in arguments.format if name not in WRITTEN]
    if later:
        names = ", ".join(later)
        print(f"carpus: exporting {names} is not there yet; --format csv writes the wrist's angles.", file=sys.stderr)
        return 1
    session = read_session(arguments.session)
    try:
        arguments.output.mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise OutputNotWritable(arguments.output, cause.strerror or "") from cause
    print(f"Written: {arguments.output / export_csv(session, arguments.output)}")
    return 0

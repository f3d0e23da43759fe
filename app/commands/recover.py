"""``carpus recover``: finish sessions that were cut short."""

from __future__ import annotations

import argparse
from pathlib import Path

from carpus.app.command_line import tell
from carpus.app.of_file import note
from carpus.core.errors import FolderMissing
from carpus.core.records.recordings import recover_recordings
from carpus.core.session.reader import read_outline

EXAMPLE = "carpus recover sessions"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="folder with sessions; nothing in it is deleted")


def run(arguments: argparse.Namespace) -> int:
    if not arguments.folder.is_dir():
        raise FolderMissing(arguments.folder)
    found = recover_recordings(arguments.folder)
    for path in found.recovered:
        print(f"Recovered: {path}")
        note("recovered", path, read_outline(path).header.session_id)
    for path in found.busy:
        print(f"Still being recorded, left alone: {path}")
    for path in found.empty:
        print(f"Ended before its first frame was stored, nothing to recover: {path}")
    for fault in found.faults:
        tell(fault)
    if not (found.recovered or found.busy or found.faults or found.empty):
        print("No interrupted session here.")
    return 1 if found.faults else 0

"""``carpus recover``: finishes interrupted sessions."""

from __future__ import annotations

import argparse
from pathlib import Path

from carpus.app.command_line import print_fault
from carpus.app.session_commands import log_session_action
from carpus.core.model.errors import FolderMissing
from carpus.core.records.recordings import recover_recordings, spool_folder
from carpus.core.session.reader import read_outline

EXAMPLE = "carpus recover sessions"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "folder",
        type=Path,
        metavar="FOLDER",
        help="data folder, or another folder with sessions; no session is deleted",
    )


def run(arguments: argparse.Namespace) -> int:
    if not arguments.folder.is_dir():
        raise FolderMissing(arguments.folder)
    # A recording lies on this computer's own disk until its data folder has it; the folder given may be the one with
    # the sessions inside the data folder.
    own = [spool_folder(one) for one in (arguments.folder.absolute(), arguments.folder.absolute().parent)]
    results = [recover_recordings(one) for one in (arguments.folder, *own) if one.is_dir()]
    for found in results:
        for path in found.recovered:
            print(f"Recovered: {path}")
            log_session_action("recovered", path, read_outline(path).header.session_id)
            if any(path.is_relative_to(one) for one in own):
                print("It is moved into the data folder when Carpus is started.")
        for path in found.in_progress:
            print(f"Still being recorded, not changed: {path}")
        for path in found.empty:
            print(f"Ended before its first frame was saved, nothing to recover: {path}")
        for fault in found.faults:
            print_fault(fault)
    if not any(found.recovered or found.in_progress or found.faults or found.empty for found in results):
        print("No interrupted session here.")
    return 1 if any(found.faults for found in results) else 0

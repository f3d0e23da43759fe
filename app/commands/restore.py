"""``carpus restore``: restores a backup into a new data folder."""

from __future__ import annotations

import argparse
from contextlib import closing
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import print_fault, print_message, progress_bar, report_usage_error
from carpus.app.session_commands import log_folder_action
from carpus.app.settings import load_valid_settings, settings_folder
from carpus.core.model.errors import BackupMissing, CarpusFault
from carpus.core.model.names import describe_known_names

if TYPE_CHECKING:
    from carpus.core.records.restoring import LogHistory

EXAMPLE = "carpus restore /media/backup --into carpus-data"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("place", type=Path, metavar="FOLDER", help="folder with the backups")
    parser.add_argument(
        "--name", metavar="BACKUP", help="which backup, as listed by “carpus backup --list” (default: the newest)"
    )
    parser.add_argument("--into", type=Path, metavar="FOLDER", help="new data folder; it must not exist yet")
    parser.add_argument(
        "--against", type=Path, metavar="FOLDER", help="do not restore; only show the differences from this data folder"
    )


def run(arguments: argparse.Namespace) -> int:
    if arguments.into is None and arguments.against is None:
        return report_usage_error(
            "restore", "say where to, with --into FOLDER, or what to compare with, --against FOLDER."
        )
    from carpus.core.records.backup import list_backups
    from carpus.core.records.restoring import activate_restored, plan_restore, restore

    place, there = arguments.place, {one.name: one for one in list_backups(arguments.place)}
    if not there:
        raise BackupMissing(place)
    name = arguments.name or next(iter(there))
    if name not in there:
        print_message(f"no backup in {place} is called “{name}”; {describe_known_names(name, there)}.")
        return 1
    backup = there[name]
    own = Path(backup.data_folder) if backup.data_folder else load_valid_settings()[0].data_folder
    past = _read_past(place, arguments.against or own)
    if arguments.against is not None:
        plan = plan_restore(backup, place, arguments.against, past)
        for words, paths in (("comes", plan.added), ("changes", plan.replaced), ("goes", plan.removed)):
            for path in paths:
                print(f"{words}: {path}")
        added, changed, gone = len(plan.added), len(plan.replaced), len(plan.removed)
        print(f"Sessions added: {added}, changed: {changed}, removed: {gone}. Nothing was changed.")
    if arguments.into is None:
        return 0
    with progress_bar("restoring", "byte") as progress:
        gone = restore(backup, place, arguments.into, past, settings_folder=settings_folder(), progress=progress)
    activate_restored(arguments.into, datetime.now())
    log_folder_action(arguments.into, "restored", "everything", sessions=backup.session_count)
    print(f"Restored: {backup.session_count} sessions of {backup.name} into {arguments.into}, each content checked.")
    if gone:
        print(f"Deleted since that backup, so deleted again: {gone} patients and sessions.")
    return 0


def _read_past(place: Path, folder: Path) -> LogHistory:
    """Read what was done since the backup, from the data folder if it exists and the newest backup."""
    from carpus.app.session_commands import open_library
    from carpus.core.records.restoring import read_history
    from carpus.core.records.store import has_store

    try:
        if has_store(folder):
            with closing(open_library(folder, read_only=True)) as library:
                return read_history(place, library.store)
    except CarpusFault as fault:
        print_fault(fault)
    return read_history(place, None)

"""``carpus restore``: a back-up into a new data folder, as on a new computer."""

from __future__ import annotations

import argparse
from contextlib import closing
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import bar, misused, say, tell
from carpus.app.of_file import note_in
from carpus.app.settings import load_sound_settings, settings_folder
from carpus.core.errors import BackupMissing, CarpusFault
from carpus.core.names import known_names

if TYPE_CHECKING:
    from carpus.core.records.restoring import Past

EXAMPLE = "carpus restore /media/backup --into carpus-data"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("place", type=Path, metavar="FOLDER", help="that holds the back-ups")
    parser.add_argument(
        "--name", metavar="BACKUP", help="which back-up, as “carpus backup --list” says (default: the newest)"
    )
    parser.add_argument("--into", type=Path, metavar="FOLDER", help="a data folder that is not there yet")
    parser.add_argument("--against", type=Path, metavar="FOLDER", help="only say what would differ from a data folder")


def run(arguments: argparse.Namespace) -> int:
    if arguments.into is None and arguments.against is None:
        return misused("restore", "say where to, with --into FOLDER, or what to compare with, --against FOLDER.")
    from carpus.core.records.backup import backups
    from carpus.core.records.restoring import plan_restore, put_in_place, restore

    place, there = arguments.place, {one.name: one for one in backups(arguments.place)}
    if not there:
        raise BackupMissing(place)
    name = arguments.name or next(iter(there))
    if name not in there:
        say(f"no back-up in {place} is called “{name}”; {known_names(name, there)}.")
        return 1
    backup = there[name]
    own = Path(backup.data_folder) if backup.data_folder else load_sound_settings()[0].data_folder
    past = _past(place, arguments.against or own)
    if arguments.against is not None:
        plan = plan_restore(backup, place, arguments.against, past)
        for words, paths in (("comes", plan.added), ("changes", plan.replaced), ("goes", plan.lost)):
            for path in paths:
                print(f"{words}: {path}")
        added, changed, gone = len(plan.added), len(plan.replaced), len(plan.lost)
        print(f"Sessions added: {added}, changed: {changed}, taken away: {gone}. Nothing was done.")
    if arguments.into is None:
        return 0
    with bar("restoring", "byte") as progress:
        gone = restore(backup, place, arguments.into, past, settings_folder=settings_folder(), progress=progress)
    put_in_place(arguments.into, datetime.now())
    note_in(arguments.into, "restored", "everything", sessions=backup.sessions)
    print(f"Restored: {backup.sessions} sessions of {backup.name} into {arguments.into}, each content checked.")
    if gone:
        print(f"Erased since that backup, and so erased again: {gone} patients and sessions.")
    return 0


def _past(place: Path, folder: Path) -> Past:
    """What was done since, as the data folder that was backed up knows it, if it is there, and the newest backup."""
    from carpus.app.of_file import library_of
    from carpus.core.records.restoring import read_past
    from carpus.core.records.store import is_kept_in

    try:
        if is_kept_in(folder):
            with closing(library_of(folder, only_reads=True)) as library:
                return read_past(place, library.store)
    except CarpusFault as fault:
        tell(fault)
    return read_past(place, None)

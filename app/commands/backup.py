"""``carpus backup``: everything of a data folder onto another disk, read back and compared."""

from __future__ import annotations

import argparse
import os
from datetime import datetime
from pathlib import Path

from carpus.app.command_line import bar, tell
from carpus.app.of_file import copy_of_server, initials, open_store
from carpus.app.settings import load_sound_settings, sessions_folder, settings_folder
from carpus.core.errors import BackupMissing, CarpusFault
from carpus.core.rounding import written

EXAMPLE = """carpus backup /media/backup
carpus backup /media/backup --list"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("place", type=Path, metavar="FOLDER", help="for back-ups, on another disk; made if need be")
    parser.add_argument("--data-folder", type=Path, metavar="FOLDER", help="patients and sessions (default: your own)")
    parser.add_argument("--list", action="store_true", help="only say which back-ups there are")
    parser.add_argument("--compare", action="store_true", help="only read the newest back-up and compare")


def run(arguments: argparse.Namespace) -> int:
    from carpus.core.records.backup import back_up, backups, compare, thin_out
    from carpus.core.records.log import Log
    from carpus.core.records.of_clinic import note_backup

    place: Path = arguments.place
    settings, _ = load_sound_settings()
    there = backups(place)
    if (arguments.list or arguments.compare) and not there:
        raise BackupMissing(place)
    if arguments.list:
        for one in there:
            print(
                f"{one.name}  {one.sessions} sessions, {written(one.size_bytes / 1e6, 1)} MB, "
                f"Carpus {one.software_version}"
            )
        return 0
    if arguments.compare:
        with bar("reading", "file") as progress:
            compare(place, there[0], progress)
        print(f"{there[0].name}: {len(there[0].files)} files read and compared: all equal.")
        return 0
    folder: Path = arguments.data_folder or settings.data_folder
    share = sessions_folder(settings) if folder == settings.data_folder else None
    os.nice(5) if hasattr(os, "nice") else None
    with bar("backing up", "byte") as progress:
        made = back_up(
            folder,
            place,
            sessions=share,
            copy=copy_of_server(folder),
            settings_folder=settings_folder(),
            progress=progress,
        )
    try:
        with open_store(folder) as store:
            note_backup(store, made.made, str(place), made.sessions, made.size_bytes)
            Log(store, "command", initials).note("backed_up", "everything", sessions=made.sessions)
    except CarpusFault as fault:  # of a folder that can only be read: the back-up is made all the same
        tell(fault)
    size = written(made.size_bytes / 1e6, 1)
    print(f"{made.name}: {made.sessions} sessions, {size} MB, read back and compared: all equal.")
    thin_out(place, settings.backup.keep, settings.backup.months, datetime.now().astimezone())
    return 0

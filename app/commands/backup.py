"""``carpus backup``: copies a data folder to another disk and compares the copy."""

from __future__ import annotations

import argparse
import os
from datetime import datetime
from pathlib import Path

from carpus.app.command_line import print_fault, progress_bar
from carpus.app.session_commands import make_server_copier, open_store, user_initials
from carpus.app.settings import load_valid_settings, sessions_folder, settings_folder
from carpus.core.model.errors import BackupMissing, CarpusFault
from carpus.core.model.rounding import format_rounded

EXAMPLE = """carpus backup /media/backup
carpus backup /media/backup --list"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "place", type=Path, metavar="FOLDER", help="folder for the backups, on another disk; created if missing"
    )
    parser.add_argument(
        "--data-folder", type=Path, metavar="FOLDER", help="data folder with patients and sessions (default: your own)"
    )
    parser.add_argument("--list", action="store_true", help="only list the backups")
    parser.add_argument("--compare", action="store_true", help="only verify the newest backup")


def run(arguments: argparse.Namespace) -> int:
    from carpus.core.records.backup import create_backup, list_backups, prune_backups, verify_backup
    from carpus.core.records.clinic_records import save_backup_record
    from carpus.core.records.log import AuditLogWriter

    place: Path = arguments.place
    settings, _ = load_valid_settings()
    there = list_backups(place)
    if (arguments.list or arguments.compare) and not there:
        raise BackupMissing(place)
    if arguments.list:
        for one in there:
            print(
                f"{one.name}  {one.session_count} sessions, {format_rounded(one.size_bytes / 1e6, 1)} MB, "
                f"Carpus {one.software_version}"
            )
        return 0
    if arguments.compare:
        with progress_bar("reading", "file") as progress:
            verify_backup(place, there[0], progress)
        print(f"{there[0].name}: {len(there[0].files)} files verified.")
        return 0
    folder: Path = arguments.data_folder or settings.data_folder
    share = sessions_folder(settings) if folder == settings.data_folder else None
    os.nice(5) if hasattr(os, "nice") else None
    with progress_bar("backing up", "byte") as progress:
        made = create_backup(
            folder,
            place,
            sessions_folder=share,
            copy_store=make_server_copier(folder),
            settings_folder=settings_folder(),
            progress=progress,
        )
    try:
        with open_store(folder) as store:
            save_backup_record(store, made.made, str(place), made.session_count, made.size_bytes)
            AuditLogWriter(store, "command", user_initials).write_entry(
                "backed_up", "everything", sessions=made.session_count
            )
    except CarpusFault as fault:  # of a folder that can only be read: the back-up is made all the same
        print_fault(fault)
    size = format_rounded(made.size_bytes / 1e6, 1)
    print(f"{made.name}: {made.session_count} sessions, {size} MB, verified.")
    prune_backups(place, settings.backup.keep, settings.backup.months, datetime.now().astimezone())
    return 0

"""``carpus restore``: a back-up into a new data folder, as on a new computer."""

from __future__ import annotations

import argparse
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import bar, misused, say
from carpus.app.of_file import note_in
from carpus.app.settings import settings_folder
from carpus.core.errors import BackupMissing
from carpus.core.names import known_names

if TYPE_CHECKING:
    from carpus.core.records.backup import Backup, Content

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
    from carpus.core.records.backup import plan_restore, restore

    found = _chosen(arguments.place, arguments.name)
    if found is None:
        return 1
    backup, content = found
    if arguments.against is not None:
        plan = plan_restore(backup, arguments.against)
        for words, paths in (("comes", plan.added), ("changes", plan.replaced), ("goes", plan.lost)):
            for path in paths:
                print(f"{words}: {path}")
        added, changed, gone = len(plan.added), len(plan.replaced), len(plan.lost)
        print(f"Sessions added: {added}, changed: {changed}, taken away: {gone}. Nothing was done.")
    if arguments.into is None:
        return 0
    with bar("restoring", "byte") as progress:
        staged = restore(backup, content, arguments.into, settings_folder=settings_folder(), progress=progress)
    staged.put_in_place(datetime.now())
    note_in(arguments.into, "restored", "everything", sessions=backup.sessions)
    print(f"Restored: {backup.sessions} sessions of {backup.name} into {arguments.into}, each content checked.")
    return 0


def _chosen(place: Path, name: str | None) -> tuple[Backup, Content] | None:
    """A back-up and its contents; None for a name that none has, which is said."""
    from carpus.core.records.backup import backups, content_of

    there = {one.name: one for one in backups(place)}
    if not there:
        raise BackupMissing(place)
    name = name or next(iter(there))
    if name not in there:
        say(f"no back-up in {place} is called “{name}”; {known_names(name, there)}.")
        return None
    return there[name], content_of(place)

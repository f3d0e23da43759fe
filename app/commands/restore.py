"""``carpus restore``: a back-up into a new data folder, as on a new computer."""

from __future__ import annotations

import argparse
from pathlib import Path

from carpus.app.commands.kept import initials
from carpus.app.commands.progress import bar
from carpus.app.settings import settings_folder
from carpus.core.errors import BackupMissing
from carpus.core.safekeeping.audit import AuditLog
from carpus.core.safekeeping.backup import backups, plan_restore, restore


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("place", type=Path, metavar="FOLDER", help="that holds the back-ups")
    parser.add_argument("--name", help="which back-up, as “carpus backup --list” says (default: the newest)")
    parser.add_argument("--into", type=Path, metavar="FOLDER", help="a data folder that is not there yet")
    parser.add_argument("--against", type=Path, metavar="FOLDER", help="only say what would differ from a data folder")


def run(arguments: argparse.Namespace) -> int:
    there = [one for one in backups(arguments.place) if arguments.name in (None, one.name)]
    if not there:
        raise BackupMissing(arguments.place, arguments.name or "")
    backup = there[0]
    if arguments.against is not None:
        plan = plan_restore(backup, arguments.against)
        for words, paths in (("comes", plan.added), ("changes", plan.replaced), ("goes", plan.lost)):
            for path in paths:
                print(f"{words}: {path}")
        print(f"{len(plan.added)} sessions come, {len(plan.replaced)} change, {len(plan.lost)} go. Nothing was done.")
    if arguments.into is None:
        if arguments.against is None:
            print(
                f"{backup.name}: {backup.sessions} sessions, {backup.size_bytes / 1e6:.1f} MB. Say where: --into FOLDER"
            )
        return 0
    with bar("restoring", "byte") as progress:
        restore(arguments.place, backup, arguments.into, settings_folder=settings_folder(), progress=progress)
    AuditLog(arguments.into, "command", initials).note("restored", "everything", sessions=backup.sessions)
    print(f"Restored: {backup.sessions} sessions of {backup.name} into {arguments.into}, each content checked.")
    return 0

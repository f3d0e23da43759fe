"""The commands of a data folder: its back-up and return, erasure, log, and interrupted sessions."""

from __future__ import annotations

import argparse
import os
from contextlib import closing
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import (
    add_examples,
    output_type,
    print_fault,
    print_message,
    progress_bar,
    report_usage_error,
)
from carpus.app.session_commands import (
    STORE_FILE,
    find_data_folder,
    log_folder_action,
    log_session_action,
    make_server_copier,
    open_library,
    open_store,
    require_store,
)
from carpus.app.settings import load_valid_settings, sessions_folder, settings_folder
from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault
from carpus.core.model.names import describe_known_names, fold_name
from carpus.core.model.rounding import format_rounded
from carpus.core.session.reader import read_outline

if TYPE_CHECKING:
    from carpus.core.records.erasure import ErasurePlan
    from carpus.core.records.restoring import LogHistory

ERASED = "Deleted. The log records the deletion without a name."
LOG_COLUMNS = ("number", "when", "who", "by", "did", "kind", "subject", "facts")


def add_backup_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus backup /media/backup", "carpus backup /media/backup --list")
    parser.add_argument(
        "place", type=Path, metavar="FOLDER", help="folder for the backups, on another disk; created if missing"
    )
    parser.add_argument(
        "--data-folder", type=Path, metavar="FOLDER", help="data folder with patients and sessions (default: your own)"
    )
    parser.add_argument("--list", action="store_true", help="only list the backups")
    parser.add_argument("--compare", action="store_true", help="only verify the newest backup")


def run_backup(arguments: argparse.Namespace) -> int:
    from carpus.core.records.backup import create_backup, list_backups, prune_backups, verify_backup
    from carpus.core.records.clinic_records import save_backup_record

    place: Path = arguments.place
    settings, _ = load_valid_settings()
    there = list_backups(place)
    if (arguments.list or arguments.compare) and not there:
        raise errors.BackupMissing(place)
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
        log_folder_action(folder, "backed_up", "everything", sessions=made.session_count)
    except CarpusFault as fault:  # of a folder that can only be read: the back-up is made all the same
        print_fault(fault)
    size = format_rounded(made.size_bytes / 1e6, 1)
    print(f"{made.name}: {made.session_count} sessions, {size} MB, verified.")
    prune_backups(place, settings.backup.keep, settings.backup.months, datetime.now().astimezone())
    return 0


def add_restore_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus restore /media/backup --into carpus-data")
    parser.add_argument("place", type=Path, metavar="FOLDER", help="folder with the backups")
    parser.add_argument(
        "--name", metavar="BACKUP", help="which backup, as listed by “carpus backup --list” (default: the newest)"
    )
    parser.add_argument("--into", type=Path, metavar="FOLDER", help="new data folder; it must not exist yet")
    parser.add_argument(
        "--against", type=Path, metavar="FOLDER", help="do not restore; only show the differences from this data folder"
    )


def run_restore(arguments: argparse.Namespace) -> int:
    if arguments.into is None and arguments.against is None:
        return report_usage_error(
            "restore", "say where to, with --into FOLDER, or what to compare with, --against FOLDER."
        )
    from carpus.core.records.backup import list_backups
    from carpus.core.records.restoring import activate_restored, plan_restore, restore

    place, there = arguments.place, {one.name: one for one in list_backups(arguments.place)}
    if not there:
        raise errors.BackupMissing(place)
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
    from carpus.core.records.restoring import read_history

    try:
        if (folder / STORE_FILE).is_file():
            with closing(open_library(folder, read_only=True)) as library:
                return read_history(place, library.store)
    except CarpusFault as fault:
        print_fault(fault)
    return read_history(place, None)


def add_erase_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, 'carpus erase "Fern 12"', 'carpus erase "Fern 12" --for-good "Fern 12"')
    parser.add_argument(
        "what", metavar="SESSION.h5|PSEUDONYM", help="session file in a data folder, or pseudonym of a patient"
    )
    parser.add_argument(
        "--data-folder", type=Path, metavar="FOLDER", help="data folder of the patient (default: your own)"
    )
    parser.add_argument(
        "--for-good", metavar="PSEUDONYM", help="delete permanently: confirm with the patient's pseudonym"
    )


def run_erase(arguments: argparse.Namespace) -> int:
    path = Path(arguments.what)
    is_file = path.is_file()
    settings, _ = load_valid_settings()
    folder = find_data_folder(path) if is_file else arguments.data_folder or settings.data_folder
    if folder is None:
        print_message(f"{path} lies in no data folder, so Carpus keeps nothing else of it; delete the file itself.")
        return 1
    require_store(folder)
    with closing(open_library(folder)) as library:
        if fold_name(arguments.what) in library.erased_pseudonyms or (is_file and not path.exists()):
            print(f"The deletion of {arguments.what} that was started before is finished.\n{ERASED}")
            return 0
        from carpus.core.records.retention import RecordRetention

        records = RecordRetention(library)
        if is_file:
            plan = records.plan_session(read_outline(path).header.session_id)
        else:
            patient_id = library.patients.id_of_pseudonym(arguments.what)
            if not patient_id:
                if path.suffix == ".h5":
                    raise errors.RecordingMissing(path)
                pseudonyms = [one.pseudonym for one in library.patients.search(include_archived=True)]
                raise errors.PatientUnknown(arguments.what, describe_known_names(arguments.what, pseudonyms))
            plan = records.plan_patient(patient_id)
        pseudonym = plan.pseudonym
        _print_plan(plan)
        if arguments.for_good is None:
            print(f"Nothing was deleted. To delete permanently, add --for-good “{pseudonym}”. Archiving can be undone.")
            return 0
        if arguments.for_good.casefold() != pseudonym.casefold():
            print_message(f"“{arguments.for_good}” is not this patient. Nothing has been deleted.")
            return 1
        records.erase(plan)
        print(ERASED)
        return 0


def _print_plan(plan: ErasurePlan) -> None:
    size = format_rounded(plan.size_bytes / 1e6, 1)
    print(f"Will be deleted: {plan.recording_count} sessions, {len(plan.files)} files, {size} MB")
    for path in plan.output_files:
        print(f"Delete this yourself: {path}")
    for path in plan.unassigned_files:
        print(f"Check this yourself (outside the patients' folders): {path}")
    print("Not deleted: backups and copies elsewhere.")


def add_log_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus log --output log.csv")
    parser.add_argument(
        "--data-folder", type=Path, metavar="FOLDER", help="data folder with patients and sessions (default: your own)"
    )
    parser.add_argument(
        "--output",
        type=output_type(".csv"),
        metavar="TABLE.csv",
        help="write the log to this table; an existing file is never overwritten",
    )


def run_log(arguments: argparse.Namespace) -> int:
    from carpus.core.formats.output_files import require_folder, write_new_table
    from carpus.core.records.log import read_log

    settings, _ = load_valid_settings()
    folder: Path = arguments.data_folder or settings.data_folder
    if arguments.output is not None:
        if arguments.output.exists():
            raise errors.OutputExists(arguments.output)
        require_folder(arguments.output)
    faults: list[CarpusFault] = []
    with open_store(folder, read_only=True, on_fault=faults.append) as store:
        deeds = read_log(store)
    for fault in faults:
        if not isinstance(fault, errors.PatientListDamaged):
            print_fault(fault)
        else:
            print_message(f"a line is damaged and left out ({fault.detail}).")
    rows = []
    for deed in deeds:
        facts = " ".join(f"{name}={value}" for name, value in deed.facts.items())
        when = deed.when.astimezone().isoformat(timespec="seconds")
        rows.append((f"{deed.number}", when, deed.initials, deed.source, deed.action, deed.kind, deed.subject, facts))
    if arguments.output is not None:
        write_new_table(arguments.output, LOG_COLUMNS, rows)
        print(f"Written: {arguments.output}")
        return 0
    for number, when, who, by, did, kind, subject, facts in rows:
        print(f"{number:>6}  {when}  {who or '-':12}  {by:7}  {did:15} {kind} {subject} {facts}".rstrip())
    print(f"{len(rows)} lines.")
    return 0


def add_recover_arguments(parser: argparse.ArgumentParser) -> None:
    add_examples(parser, "carpus recover sessions")
    parser.add_argument(
        "folder",
        type=Path,
        metavar="FOLDER",
        help="data folder, or another folder with sessions; no session is deleted",
    )


def run_recover(arguments: argparse.Namespace) -> int:
    from carpus.core.records.recordings import recover_recordings, spool_folder

    if not arguments.folder.is_dir():
        raise errors.FolderMissing(arguments.folder)
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

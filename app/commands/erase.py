"""``carpus erase``: erases a session or a patient, after showing what would be deleted."""

from __future__ import annotations

import argparse
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from carpus.app.command_line import print_message
from carpus.app.session_commands import find_data_folder, open_library, require_store
from carpus.app.settings import load_valid_settings
from carpus.core.model.errors import PatientUnknown, RecordingMissing
from carpus.core.model.names import describe_known_names, fold_name
from carpus.core.model.rounding import format_rounded
from carpus.core.session.reader import read_outline

if TYPE_CHECKING:
    from carpus.core.records.erasure import ErasurePlan

EXAMPLE = """carpus erase "Fern 12"
carpus erase "Fern 12" --for-good "Fern 12\""""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "what", metavar="SESSION.h5|PSEUDONYM", help="session file in a data folder, or pseudonym of a patient"
    )
    parser.add_argument(
        "--data-folder", type=Path, metavar="FOLDER", help="data folder of the patient (default: your own)"
    )
    parser.add_argument(
        "--for-good", metavar="PSEUDONYM", help="delete permanently: confirm with the patient's pseudonym"
    )


def run(arguments: argparse.Namespace) -> int:
    path = Path(arguments.what)
    settings, _ = load_valid_settings()
    folder = find_data_folder(path) if path.is_file() else arguments.data_folder or settings.data_folder
    if folder is None:
        print_message(f"{path} lies in no data folder, so Carpus keeps nothing else of it; delete the file itself.")
        return 1
    require_store(folder)
    is_file = path.is_file()
    with closing(open_library(folder)) as library:
        if fold_name(arguments.what) in library.erased_pseudonyms or (is_file and not path.exists()):
            print(f"The deletion of {arguments.what} that was started before is finished.")
            return _print_erased()
        from carpus.core.records.retention import RecordRetention

        records = RecordRetention(library)
        if path.is_file():
            plan = records.plan_session(read_outline(path).header.session_id)
        else:
            patient_id = library.patients.id_of_pseudonym(arguments.what)
            if not patient_id:
                if path.suffix == ".h5":
                    raise RecordingMissing(path)
                pseudonyms = [one.pseudonym for one in library.patients.search(include_archived=True)]
                raise PatientUnknown(arguments.what, describe_known_names(arguments.what, pseudonyms))
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
        return _print_erased()


def _print_erased() -> int:
    print("Deleted. The log records the deletion without a name.")
    return 0


def _print_plan(plan: ErasurePlan) -> None:
    size = format_rounded(plan.size_bytes / 1e6, 1)
    print(f"Will be deleted: {plan.recording_count} sessions, {len(plan.files)} files, {size} MB")
    for path in plan.output_files:
        print(f"Delete this yourself: {path}")
    for path in plan.unassigned_files:
        print(f"Check this yourself (outside the patients' folders): {path}")
    print("Not deleted: backups and copies elsewhere.")

"""``carpus erase``: a session or a patient, for good; says first what would go, and does it only when told again."""

from __future__ import annotations

import argparse
from contextlib import closing
from pathlib import Path

from carpus.app.command_line import say
from carpus.app.of_file import data_folder_of, library_of, look_for_store
from carpus.app.settings import load_sound_settings
from carpus.core.errors import PatientUnknown, RecordingMissing
from carpus.core.names import folded, known_names
from carpus.core.records.erasure import ErasurePlan
from carpus.core.records.keeping import Records
from carpus.core.records.library import Library
from carpus.core.rounding import written
from carpus.core.session.reader import read_outline

EXAMPLE = """carpus erase "Fern 12"
carpus erase "Fern 12" --for-good "Fern 12\""""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("what", metavar="SESSION.h5|PSEUDONYM", help="a session of a data folder, or a whole patient")
    parser.add_argument("--data-folder", type=Path, metavar="FOLDER", help="of a patient (default: your own)")
    parser.add_argument("--for-good", metavar="PSEUDONYM", help="do it: the patient's pseudonym, typed once more")


def run(arguments: argparse.Namespace) -> int:
    path = Path(arguments.what)
    settings, _ = load_sound_settings()
    folder = data_folder_of(path) if path.is_file() else arguments.data_folder or settings.data_folder
    if folder is None:
        say(f"{path} lies in no data folder, so Carpus keeps nothing else of it; delete the file itself.")
        return 1
    look_for_store(folder)
    is_file = path.is_file()
    with closing(library_of(folder)) as library:
        if folded(arguments.what) in library.gone or (is_file and not path.exists()):
            print(f"The erasing of {arguments.what} that was begun before is finished: nothing of it is left here.")
            return _told()
        return _erase(library, arguments.what, path, arguments.for_good)


def _erase(library: Library, what: str, path: Path, confirmed: str | None) -> int:
    records = Records(library)
    if path.is_file():
        plan = records.plan_session(read_outline(path).header.session_id)
    else:
        patient_id = library.patients.called(what)
        if not patient_id:
            if path.suffix == ".h5":
                raise RecordingMissing(path)
            pseudonyms = [one.pseudonym for one in library.patients.listed(archived=True)]
            raise PatientUnknown(what, known_names(what, pseudonyms))
        plan = records.plan_patient(patient_id)
    pseudonym = plan.pseudonym
    _say(plan)
    if confirmed is None:
        print(f"Nothing has been deleted. To erase it, say --for-good “{pseudonym}”; the archive is the milder way.")
        return 0
    if confirmed.casefold() != pseudonym.casefold():
        say(f"{confirmed} is not whose it is; nothing has been deleted.")
        return 1
    records.erase(plan)
    return _told()


def _told() -> int:
    print("Erased. The log keeps that it was erased, no name.")
    return 0


def _say(plan: ErasurePlan) -> None:
    print(f"This goes: {plan.sessions} sessions, {len(plan.files)} files, {written(plan.size_bytes / 1e6, 1)} MB")
    for path in plan.made:
        print(f"This stays, delete it yourself: {path}")
    for path in plan.outside:
        print(f"This stays, look at it yourself, it lies in no patient's folder: {path}")
    print("This stays: back-ups and files copied elsewhere; Carpus cannot reach them.")

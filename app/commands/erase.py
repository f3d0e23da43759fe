"""``carpus erase``: a session or a patient, for good; says first what would go, and does it only when told again."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from carpus.app.commands.kept import data_folder_of, initials
from carpus.app.settings import load_sound_settings
from carpus.core.errors import CarpusFault, FolderMissing, SessionUnreadable
from carpus.core.library.library import Library
from carpus.core.library.records import Records
from carpus.core.safekeeping.erasure import ErasurePlan
from carpus.core.session.reader import read_outline


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("what", metavar="SESSION.h5|PSEUDONYM", help="a session of a data folder, or a whole patient")
    parser.add_argument("--data-folder", type=Path, metavar="FOLDER", help="of a patient (default: your own)")
    parser.add_argument("--for-good", metavar="PSEUDONYM", help="do it: the patient's pseudonym, typed once more")


def run(arguments: argparse.Namespace) -> int:
    path = Path(arguments.what)
    folder = data_folder_of(path) if path.is_file() else arguments.data_folder or load_sound_settings()[0].data_folder
    if folder is None:
        raise SessionUnreadable(path, "not in a data folder of Carpus; an own file is deleted as any other")
    if not folder.is_dir():
        raise FolderMissing(folder)
    library = Library(folder, by="command")
    library.who = initials
    faults: list[CarpusFault] = []
    library.log_fault = faults.append
    try:
        return _erase(library, arguments.what, path, arguments.for_good)
    finally:
        library.close()


def _erase(library: Library, what: str, path: Path, confirmed: str | None) -> int:
    records = Records(library)
    if path.is_file():
        plan = records.plan_session(read_outline(path).header.session_id)
    else:
        known = {one.entry.pseudonym.casefold(): one.patient_id for one in library.clinic.patients(archived=True)}
        if what.casefold() not in known:
            print(f"carpus: there is no session file and no patient {what}.", file=sys.stderr)
            return 1
        plan = records.plan_patient(known[what.casefold()])
    pseudonym = library.clinic.patient(plan.patient_id).entry.pseudonym if plan.patient_id else ""
    _say(plan)
    if confirmed is None:
        print(f"Nothing has been deleted. To erase it, say --for-good “{pseudonym}”; the archive is the milder way.")
        return 0
    if confirmed.casefold() != pseudonym.casefold():
        print(f"carpus: {confirmed} is not whose it is; nothing has been deleted.", file=sys.stderr)
        return 1
    records.erase(plan)
    print("Erased. The log keeps that it was erased, no name.")
    return 0


def _say(plan: ErasurePlan) -> None:
    print(f"This goes: {plan.sessions} sessions, {len(plan.files)} files, {plan.size_bytes / 1e6:.1f} MB")
    for one in plan.made:
        words = {"as_made": "goes too", "changed": "stays, it was changed", "not_found": "is not there any more"}
        print(f"{one.kind} {one.path}: {words[one.state]}")
    print("This stays: back-ups and files copied elsewhere; Carpus cannot reach them.")

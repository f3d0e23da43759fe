"""A data folder with patients and sessions, and a look for traces in it."""

from __future__ import annotations

import json
import os
import shutil
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass, fields
from datetime import UTC, date, datetime, timedelta
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from carpus.core.measures.manual_measurements import ManualValue
from carpus.core.model.errors import CarpusFault
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import SIMULATED
from carpus.core.records import clinic_records, patients, session_records
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.database import STORE_FILE
from carpus.core.records.log import AuditLogWriter
from carpus.core.records.patients import Patients, save_setup
from carpus.core.records.session_list import SessionFileScanner, SessionList
from carpus.core.records.session_setup import SessionSetup
from carpus.core.records.store import Store
from carpus.core.records.values import HomePlan, Patient
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.session.values import new_header
from tests.session.samples import begin_session

LONG_S = 120.0
T0 = datetime(2026, 10, 9, 9, 51, tzinfo=UTC)
LINDEN = Patient(
    "Linden 42", "right", "left", "flexor tendon", "Erika Mustermann", date(1981, 3, 12), "PR-4711", "female",
    "Flexor tendon repair", "operation", date(2026, 8, 21),
)  # fmt: skip
NAMES = ("Linden", "Erika Mustermann", "flexor tendon", "1981-03-12", "PR-4711")
"""Of Linden 42."""
HERON = Patient("Heron 17", "left", name="Otto Normal")
_RECORDED: dict[tuple[Any, ...], list[bytes]] = {}
"""Contents of session files by their kind, and how many of a kind a test has asked for."""
_ASKED = Counter[tuple[str, tuple[Any, ...]]]()


def strip_stored_fields(patient: Patient) -> Patient:
    """What a person wrote of a patient, without what the store adds."""
    return Patient(**{one.name: getattr(patient, one.name) for one in fields(Patient) if not one.kw_only})


@dataclass(frozen=True)
class House:
    """A store and what is asked of it."""

    store: Store
    patients: Patients
    index: SessionList
    files: SessionFileScanner
    log: AuditLogWriter

    def names(self, search: str = "") -> list[str]:
        """Who is in the list."""
        return [record.pseudonym for record in self.patients.search(search)]


@cache
def _empty_store() -> bytes:
    with TemporaryDirectory() as folder:
        Store(Path(folder)).close()
        return (Path(folder) / STORE_FILE).read_bytes()


@contextmanager
def open_store(
    folder: Path, url: str = "", tell: Callable[[CarpusFault], None] = lambda _: None, sessions: Path | None = None
) -> Iterator[House]:
    """The store of a folder, open; an empty one is a copy, since it takes long to make."""
    if not url and not (folder.is_dir() and any(folder.iterdir())):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / STORE_FILE).write_bytes(_empty_store())
    with Store(folder, sessions, url, tell) as store:
        yield House(
            store, Patients(store), SessionList(store), SessionFileScanner(store), AuditLogWriter(store, "window")
        )


def wait_until(what: Callable[[], bool]) -> None:
    """Wait for it."""
    end = time.monotonic() + LONG_S
    while not what():
        assert time.monotonic() < end
        time.sleep(0.02)


def record(
    path: Path, subject: str, when: datetime, hand: str = "right", frames: int = 4, recording_id: str = "",
    simulated: bool = False, created: datetime | None = None,
) -> Path:  # fmt: skip
    """A session file. Of those alike that one test asks for each has an identity of its own; another test gets the same
    ones, which are written once."""
    kind = (subject, when.isoformat(), hand, frames, recording_id, simulated, created)
    asked = (os.environ.get("PYTEST_CURRENT_TEST", "").split(" ")[0], kind)
    number, written = _ASKED[asked], _RECORDED.setdefault(kind, [])
    _ASKED[asked] += 1
    path.parent.mkdir(parents=True, exist_ok=True)
    if number < len(written):
        path.touch(0o600, exist_ok=False)
        path.write_bytes(written[number])
        return path
    header = new_header(
        hand="right" if hand == "right" else "left",
        protocol=WRIST6,
        subject_id=subject,
        exercise="WRIST_FE",
        now=created or when,
        recorded=when.isoformat(),
        recording_id=recording_id,
        parameters=json.dumps({"source": {SIMULATED: "yes"}}) if simulated else "{}",
    )
    begin_session(path, header, frames).close()
    written.append(path.read_bytes())
    return path


def measure(house: House, patient_id: str, when: datetime, recording_id: str = "") -> str:
    """One session of a patient with all that may lie beside it; its identity."""
    pseudonym = house.patients.get(patient_id).pseudonym
    path = house.index.new_path(patient_id, pseudonym, "WRIST_FE", "right", when)
    record(path, pseudonym, when, recording_id=recording_id)
    path.with_suffix(".carpusraw").write_bytes(b"pictures of " + pseudonym.encode())
    path.with_suffix(".markers.jpg").write_bytes(b"photo")
    return house.index.add(path, patient_id, "AB").session_id


def fill(house: House, patient_id: str) -> list[str]:
    """Everything that can be written about a patient; the identities of the sessions."""
    sessions = [measure(house, patient_id, T0 + timedelta(days=day)) for day in range(3)]
    entry = house.patients.get(patient_id)
    for session_id in sessions:
        session_records.add_comment(house.store, session_id, f"{entry.pseudonym} is well", "AB")
        session_records.save_choices(house.store, session_id, RepetitionChoices({0: entry.pseudonym}), 0)
        session_records.record_output_files(house.store, [house.index.get(session_id).path], "export", [session_id])
    value = ManualValue("WRIST_ROUND", "", "right", date(2026, 10, 9), (17.0,), entry.pseudonym)
    patients.add_manual_measurements(house.store, patient_id, [value])
    save_setup(
        house.store, SessionSetup(patient_id, entry.pseudonym, "right", get_exercise("WRIST_FE"), 8, 25.0, -20.0)
    )
    plan = HomePlan(("WRIST_FE",), 10, 3, T0.date(), date(2026, 10, 16), "11:30", f"{entry.pseudonym} brings it", "it")
    patients.save_home_plan(house.store, patient_id, plan)
    clinic_records.save_place(house.store.folder, entry.pseudonym[:2], f"/papers/{entry.name}")
    clinic_records.save_recipient(house.store, f"{entry.name}\nOak Street 1")
    house.patients.set_diagnosis_listed(f"as {entry.name}", is_listed=True)
    house.log.write_entry("opened", "patient", patient_id)
    return sessions


def traces(folder: Path, *words: str) -> list[str]:
    """Files whose name or content holds one of the words, also in free pages and in the write-ahead log."""
    found = []
    for path in sorted(folder.rglob("*")):
        content = path.read_bytes() if path.is_file() else b""
        if any(word.encode() in content or word in str(path.relative_to(folder)) for word in words):
            found.append(path.name)
    return found


def store_patient(folder: Path, patient: Patient, *sessions: tuple[Path, datetime, str]) -> str:
    """Copies of session files, each with its moment and who recorded it, in a data folder as those of a new patient,
    whose identity is given."""
    with closing(DataFolder(folder)) as library:
        patient_id = library.patients.add(patient)
        for stored, when, by in sessions:
            path = library.session_list.new_path(patient_id, patient.pseudonym, "WRIST_FE", "right", when)
            shutil.copyfile(stored, path)
            library.session_list.add(path, patient_id, by)
    return patient_id

"""A data folder with patients and sessions, and a look for traces in it."""

from __future__ import annotations

import json
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from datetime import UTC, date, datetime
from pathlib import Path

from sqlalchemy import select

from carpus.core.errors import CarpusFault
from carpus.core.hand.protocols import WRIST6
from carpus.core.records.library import Library
from carpus.core.records.log import Log
from carpus.core.records.patients import Patients
from carpus.core.records.schema import OUTBOX
from carpus.core.records.session_list import FilesOfSessions, ListedSessions
from carpus.core.records.store import Store
from carpus.core.records.values import PatientEntry
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from carpus.core.types import SIMULATED
from tests.session.samples import CAMERA, make_calibration, make_frame

LONG_S = 120.0
T0 = datetime(2026, 10, 9, 9, 51, tzinfo=UTC)
LINDEN = PatientEntry(
    "Linden 42", "right", "left", "40-49", "flexor tendon", "Erika Mustermann", "Flexor tendon repair", "operation",
    date(2026, 8, 21),
)  # fmt: skip
HERON = PatientEntry("Heron 17", "left", name="Otto Normal")


@dataclass(frozen=True)
class House:
    """A store and what is asked of it."""

    store: Store
    patients: Patients
    index: ListedSessions
    files: FilesOfSessions
    log: Log

    def names(self, search: str = "") -> list[str]:
        """Who is in the list."""
        return [record.entry.pseudonym for record in self.patients.listed(search)]


@contextmanager
def opened(
    folder: Path, url: str = "", tell: Callable[[CarpusFault], None] = lambda _: None, sessions: Path | None = None
) -> Iterator[House]:
    """The store of a folder, open."""
    with Store(folder, sessions, url, tell) as store:
        yield House(store, Patients(store), ListedSessions(store), FilesOfSessions(store), Log(store, "window"))


def until(what: Callable[[], bool]) -> None:
    """Wait for it."""
    end = time.monotonic() + LONG_S
    while not what():
        assert time.monotonic() < end
        time.sleep(0.02)


def settled(house: House) -> None:
    """Everything of a computer has arrived."""
    until(lambda: not house.store.is_behind and not waiting(house))


def waiting(house: House) -> int:
    """How many changes of a computer have not."""
    return len(house.store.rows(select(OUTBOX).where(OUTBOX.c.refused == "")))


def record(
    path: Path, subject: str, when: datetime, hand: str = "right", frames: int = 4, recording_id: str = "",
    simulated: bool = False,
) -> Path:  # fmt: skip
    """A session file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    header = new_header(
        hand="right" if hand == "right" else "left",
        protocol=WRIST6,
        software_version="0",
        subject_id=subject,
        exercise="WRIST_FE",
        now=when,
        recorded=when.isoformat(),
        recording_id=recording_id,
        parameters=json.dumps({"source": {SIMULATED: "yes"}}) if simulated else "{}",
    )
    with SessionWriter.create(path, header, CAMERA, make_calibration()) as writer:
        for row in range(frames):
            writer.append(make_frame(row))
    return path


def measure(house: House, patient_id: str, when: datetime, recording_id: str = "") -> str:
    """One session of a patient with all that may lie beside it; its identity."""
    pseudonym = house.patients.one(patient_id).entry.pseudonym
    path = house.index.new_path(patient_id, pseudonym, "WRIST_FE", "right", when)
    record(path, pseudonym, when, recording_id=recording_id)
    path.with_suffix(".carpusraw").write_bytes(b"pictures of " + pseudonym.encode())
    path.with_suffix(".markers.jpg").write_bytes(b"photo")
    return house.index.enter(path, patient_id, "AB").session_id


def traces(folder: Path, *words: str) -> list[str]:
    """Files whose name or content holds one of the words, also in free pages and in the write-ahead log."""
    found = []
    for path in sorted(folder.rglob("*")):
        content = path.read_bytes() if path.is_file() else b""
        if any(word.encode() in content or word in str(path.relative_to(folder)) for word in words):
            found.append(path.name)
    return found


def kept(folder: Path, patient: PatientEntry, *sessions: tuple[Path, datetime, str]) -> str:
    """Copies of session files, each with its moment and who recorded it, in a data folder as those of a new patient,
    whose identity is given."""
    with closing(Library(folder)) as library:
        patient_id = library.patients.add(patient)
        for stored, when, by in sessions:
            path = library.index.new_path(patient_id, patient.pseudonym, "WRIST_FE", "right", when)
            shutil.copyfile(stored, path)
            library.index.enter(path, patient_id, by)
    return patient_id

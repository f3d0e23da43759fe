"""The register of patients: who is behind a pseudonym, and which sessions there are.

SQLite beside the session files. Names are here and nowhere else; everything but the names, notes and ages can be
made again from the session files.
"""

from __future__ import annotations

import random
import re
import sqlite3
import uuid
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal, Self

import platformdirs

from core.errors import CarpusFault, PseudonymTaken, SessionUnreadable
from core.session.database import Database, make_private
from core.session.pseudonyms import suggest_pseudonym
from core.session.reader import read_outline
from core.session.values import SessionOutline
from core.types import Side

AffectedSide = Literal["right", "left", "both"]
Dominance = Literal["right", "left", "both", "unknown"]
AGE_BANDS = ("", "0-9", "10-19", "20-29", "30-39", "40-49", "50-59", "60-69", "70-79", "80 and over")

REGISTER_FILE = "patients.sqlite3"
SESSIONS_FOLDER = "sessions"

MIGRATIONS = (
    """
    CREATE TABLE patient (
        id TEXT PRIMARY KEY,
        pseudonym TEXT NOT NULL UNIQUE COLLATE NOCASE,
        name TEXT NOT NULL,
        side TEXT NOT NULL,
        dominance TEXT NOT NULL,
        age_band TEXT NOT NULL,
        note TEXT NOT NULL,
        added_s REAL NOT NULL
    );
    CREATE TABLE session (
        path TEXT PRIMARY KEY,
        id TEXT NOT NULL,
        patient_id TEXT REFERENCES patient (id),
        created TEXT NOT NULL,
        created_s REAL NOT NULL,
        exercise TEXT NOT NULL,
        hand TEXT NOT NULL,
        frames INTEGER NOT NULL,
        duration_s REAL NOT NULL,
        complete INTEGER NOT NULL
    );
    CREATE INDEX session_of_patient ON session (patient_id, created_s);
    """,
)
"""One script for each version of the register, in order; ``PRAGMA user_version`` counts those that ran."""


@dataclass(frozen=True, slots=True)
class PatientEntry:
    """What a person writes down of a patient. ``name`` is optional and stays in the register."""

    pseudonym: str
    side: AffectedSide
    dominance: Dominance = "unknown"
    age_band: str = ""
    note: str = ""
    name: str = ""

    def __post_init__(self) -> None:
        if not self.pseudonym.strip():
            raise ValueError("no pseudonym")
        if self.age_band not in AGE_BANDS:
            raise ValueError(f"age band {self.age_band!r}")


@dataclass(frozen=True, slots=True)
class PatientRecord:
    """A patient of the register; ``last_session`` None and ``last_exercise`` empty before the first session."""

    patient_id: str
    entry: PatientEntry
    session_count: int
    last_session: datetime | None
    last_exercise: str


@dataclass(frozen=True, slots=True)
class SessionEntry:
    """One session file as the register knows it."""

    session_id: str
    path: Path
    created: datetime
    exercise: str
    hand: Side
    frames: int
    duration_s: float
    complete: bool


@dataclass(frozen=True, slots=True)
class Rebuilt:
    """What a rebuild found: sessions entered, patients added, and one fault for each file it could not read."""

    sessions: int
    patients_added: int
    faults: tuple[CarpusFault, ...]


def default_data_folder() -> Path:
    """Where patients and sessions belong on this system."""
    return Path(platformdirs.user_data_dir("carpus", appauthor=False))


class PatientRegister:
    """The open register of one data folder; may be used from several threads, one call at a time.

    A register that is not there yet is made, and filled from the session files that are. Folders and file are
    readable by their owner only. Raises what :class:`Database` does.
    """

    def __init__(self, folder: Path) -> None:
        self.sessions_folder = folder / SESSIONS_FOLDER
        make_private(folder)
        make_private(self.sessions_folder)
        self._resolved_folder = self.sessions_folder.resolve()  # asked of every file whenever the list is shown
        self._database = Database(folder / REGISTER_FILE, MIGRATIONS)
        if self._database.is_new:
            try:
                self.rebuild_from_sessions()
            except CarpusFault:
                self._database.close()
                raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """May be called twice."""
        self._database.close()

    def patients(self, search: str = "") -> list[PatientRecord]:
        """Patients whose pseudonym, name or note holds every word of ``search``; last session first."""
        with self._database.transaction() as database:
            rows = database.execute(
                """
                SELECT patient.*, COUNT(session.id) AS sessions, MAX(session.created_s) AS last_s,
                       session.created AS last, session.exercise AS last_exercise
                FROM patient LEFT JOIN session ON session.patient_id = patient.id
                GROUP BY patient.id ORDER BY last_s IS NULL, last_s DESC, added_s DESC, pseudonym
                """  # beside MAX, SQLite takes the other columns from the row of the maximum
            ).fetchall()
        records = [_record(row) for row in rows]
        words = search.casefold().split()
        return [record for record in records if all(word in _searchable(record.entry) for word in words)]

    def patient(self, patient_id: str) -> PatientRecord:
        """One patient; raises KeyError for an identity that is not in the register."""
        for record in self.patients():
            if record.patient_id == patient_id:
                return record
        raise KeyError(patient_id)

    def suggest_pseudonym(self, chance: random.Random | None = None) -> str:
        """A random pseudonym that no patient has."""
        return suggest_pseudonym([record.entry.pseudonym for record in self.patients()], chance)

    def add(self, entry: PatientEntry, now: datetime | None = None) -> str:
        """Enter a new patient; returns the identity given. Raises :class:`PseudonymTaken`."""
        with self._database.transaction() as database:
            return _insert(database, entry, now or datetime.now(UTC))

    def change(self, patient_id: str, entry: PatientEntry) -> None:
        """Replace what is written of a patient; the sessions stay. Raises :class:`PseudonymTaken`.

        Files recorded under an earlier pseudonym keep it; they stay with the patient as long as the register does.
        """
        with self._database.transaction() as database:
            _check_free(database, entry.pseudonym, patient_id)
            settings = "pseudonym = ?, name = ?, side = ?, dominance = ?, age_band = ?, note = ?"
            changed = database.execute(f"UPDATE patient SET {settings} WHERE id = ?", (*_columns(entry), patient_id))
            if changed.rowcount == 0:
                raise KeyError(patient_id)

    def sessions(self, patient_id: str) -> list[SessionEntry]:
        """The patient's sessions, newest first."""
        with self._database.transaction() as database:
            rows = database.execute(
                "SELECT * FROM session WHERE patient_id = ? ORDER BY created_s DESC, path DESC", (patient_id,)
            ).fetchall()
        return [self._session(row) for row in rows]

    def session(self, session_id: str) -> SessionEntry:
        """One session; raises KeyError for an identity that is not in the register."""
        with self._database.transaction() as database:
            row = database.execute("SELECT * FROM session WHERE id = ?", (session_id,)).fetchone()
        if row is None:
            raise KeyError(session_id)
        return self._session(row)

    def new_session_path(self, patient_id: str, exercise: str, hand: Side, when: datetime) -> Path:
        """A free path for a session that begins now, in the patient's own private folder."""
        pseudonym = self.patient(patient_id).entry.pseudonym
        folder = self.sessions_folder / _file_name(pseudonym)
        make_private(folder)
        stem = f"{_file_name(pseudonym)}_{when:%Y-%m-%d_%H%M%S}_{_file_name(exercise) or 'session'}_{hand}"
        candidate, number = folder / f"{stem}.h5", 1
        while candidate.exists():
            number += 1
            candidate = folder / f"{stem}-{number}.h5"
        return candidate

    def enter_session(self, path: Path, patient_id: str) -> SessionEntry:
        """Take a finished session file into the index. Raises :class:`SessionUnreadable`."""
        outline = read_outline(path)
        with self._database.transaction() as database:
            _index(database, self._stored_path(path), patient_id, outline)
        return self.session(outline.header.session_id)

    def rebuild_from_sessions(self, now: datetime | None = None) -> Rebuilt:
        """Make the index again from the session files; known patients keep their names, notes and ages.

        A pseudonym without a patient becomes one; a file without a pseudonym is indexed without a patient.
        """
        found: list[tuple[Path, SessionOutline]] = []
        faults: list[CarpusFault] = []
        for path in sorted(self.sessions_folder.rglob("*.h5")):
            try:
                found.append((path, read_outline(path)))
            except SessionUnreadable as fault:
                faults.append(fault)
        with self._database.transaction() as database:
            owner = dict(database.execute("SELECT path, patient_id FROM session"))
            known = {name.casefold(): key for name, key in database.execute("SELECT pseudonym, id FROM patient")}
            missing: dict[str, tuple[str, set[Side]]] = {}
            for path, outline in found:
                subject = outline.header.subject_id
                if subject and subject.casefold() not in known and not owner.get(self._stored_path(path)):
                    missing.setdefault(subject.casefold(), (subject, set()))[1].add(outline.header.hand)
            for key, (subject, hands) in missing.items():
                side: AffectedSide = "both" if len(hands) == 2 else next(iter(hands))
                known[key] = _insert(database, PatientEntry(subject, side), now or datetime.now(UTC))
            database.execute("DELETE FROM session")
            for path, outline in found:
                stored = self._stored_path(path)
                patient_id = owner.get(stored) or known.get(outline.header.subject_id.casefold())
                _index(database, stored, patient_id, outline)
        return Rebuilt(len(found), len(missing), tuple(faults))

    def is_behind(self) -> bool:
        """Whether the index knows other session files than the folder holds: some were copied in or taken away."""
        with self._database.transaction() as database:
            known = {str(path) for (path,) in database.execute("SELECT path FROM session")}
        return known != {self._stored_path(path) for path in self.sessions_folder.rglob("*.h5")}

    def _stored_path(self, path: Path) -> str:
        """Relative to the sessions folder, so that the data folder can be moved as a whole."""
        try:
            return path.resolve().relative_to(self._resolved_folder).as_posix()
        except ValueError:
            return str(path.resolve())

    def _session(self, row: sqlite3.Row) -> SessionEntry:
        return SessionEntry(
            session_id=row["id"],
            path=self.sessions_folder / row["path"],
            created=datetime.fromisoformat(row["created"]),
            exercise=row["exercise"],
            hand=row["hand"],
            frames=row["frames"],
            duration_s=row["duration_s"],
            complete=bool(row["complete"]),
        )


def _file_name(text: str) -> str:
    return re.sub(r"\W+", "-", text).strip("-")


def _columns(entry: PatientEntry) -> tuple[str, str, str, str, str, str]:
    return entry.pseudonym, entry.name, entry.side, entry.dominance, entry.age_band, entry.note


def _check_free(database: sqlite3.Connection, pseudonym: str, except_id: str = "") -> None:
    for patient_id, other in database.execute("SELECT id, pseudonym FROM patient"):
        if other.casefold() == pseudonym.casefold() and patient_id != except_id:
            raise PseudonymTaken(pseudonym)


def _insert(database: sqlite3.Connection, entry: PatientEntry, now: datetime) -> str:
    _check_free(database, entry.pseudonym)
    patient_id = uuid.uuid4().hex
    columns = "id, pseudonym, name, side, dominance, age_band, note, added_s"
    values = (patient_id, *_columns(entry), now.timestamp())
    database.execute(f"INSERT INTO patient ({columns}) VALUES (?, ?, ?, ?, ?, ?, ?, ?)", values)
    return patient_id


def _index(database: sqlite3.Connection, stored_path: str, patient_id: str | None, outline: SessionOutline) -> None:
    header = outline.header
    values = (
        stored_path,
        header.session_id,
        patient_id,
        header.created,
        datetime.fromisoformat(header.created).timestamp(),
        header.exercise,
        header.hand,
        outline.frames,
        outline.duration_s,
        outline.complete,
    )
    database.execute("INSERT OR REPLACE INTO session VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", values)


def _record(row: sqlite3.Row) -> PatientRecord:
    entry = PatientEntry(
        pseudonym=row["pseudonym"],
        side=row["side"],
        dominance=row["dominance"],
        age_band=row["age_band"],
        note=row["note"],
        name=row["name"],
    )
    last = row["last"]
    return PatientRecord(
        patient_id=row["id"],
        entry=entry,
        session_count=row["sessions"],
        last_session=datetime.fromisoformat(last) if last else None,
        last_exercise=row["last_exercise"] or "",
    )


def _searchable(entry: PatientEntry) -> str:
    return f"{entry.pseudonym} {entry.name} {entry.note}".casefold()

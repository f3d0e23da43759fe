"""The register of patients: who is behind a pseudonym, and which sessions there are.

SQLite beside the session files. Names are here and nowhere else; everything but the names, notes and ages can be
made again from the session files.
"""

from __future__ import annotations

import random
import re
import sqlite3
import uuid
from collections.abc import Iterable
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal, Self

import platformdirs

from carpus.core.by_hand import kept as by_hand
from carpus.core.by_hand.values import HandValue
from carpus.core.errors import CarpusFault, PseudonymTaken, SessionUnreadable
from carpus.core.phrase import phrase
from carpus.core.session import made_files, out_of_sight, recipients, seen_files
from carpus.core.session.database import Database, make_private
from carpus.core.session.pseudonyms import suggest_pseudonym
from carpus.core.session.reader import read_outline
from carpus.core.session.seen_files import Seen
from carpus.core.session.values import SessionOutline
from carpus.core.types import Side

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
    seen_files.MIGRATION,
    """
    ALTER TABLE session ADD COLUMN recording_id TEXT NOT NULL DEFAULT '';
    ALTER TABLE session ADD COLUMN recorded TEXT NOT NULL DEFAULT '';
    ALTER TABLE session ADD COLUMN recorded_s REAL NOT NULL DEFAULT 0;
    UPDATE session SET recording_id = id, recorded = created, recorded_s = created_s;
    DELETE FROM seen WHERE reason = '';
    """,
    # Every session is read once more, so that what was simulated is known.
    "ALTER TABLE session ADD COLUMN simulated INTEGER NOT NULL DEFAULT 0; DELETE FROM seen",
    made_files.MIGRATION + out_of_sight.MIGRATION,
    by_hand.MIGRATION,
    recipients.MIGRATION,
)
"""One script for each version of the register, in order; ``PRAGMA user_version`` counts those that ran."""


TABLES = {
    "patient": "id, pseudonym, name, side, dominance, age_band, note, added_s",
    "session": "path, id, patient_id, created, created_s, exercise, hand, frames, duration_s, complete, recording_id, "
    "recorded, recorded_s, simulated",
    "seen": "path, size, changed_ns, reason",
    "made": made_files.COLUMNS,
    "archived": "identity, since",
    "erasing": "path",
    "by_hand": by_hand.COLUMNS,
    "recipient": recipients.COLUMNS,
}
"""What every register has; one without it is damaged."""


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
    """A patient of the register; ``last_session`` None and ``last_exercise`` empty before the first session.

    ``session_count`` counts a recording once, however often it was tracked; ``result_count`` counts every file.
    Sessions of a simulated hand are nobody's movement: they are neither counted nor the last one.
    """

    patient_id: str
    entry: PatientEntry
    session_count: int
    last_session: datetime | None
    last_exercise: str
    result_count: int = 0


@dataclass(frozen=True, slots=True)
class SessionEntry:
    """One session file as the register knows it.

    ``recorded`` when the hand moved, ``created`` when the file was made; ``recording_id`` as in the file.
    """

    session_id: str
    path: Path
    recorded: datetime
    created: datetime
    recording_id: str
    exercise: str
    hand: Side
    frames: int
    duration_s: float
    complete: bool
    simulated: bool = False


@dataclass(frozen=True, slots=True)
class Rebuilt:
    """What a rebuild found: sessions entered, patients added, and one fault for each file it could not read."""

    sessions: int
    patients_added: int
    faults: tuple[CarpusFault, ...]


def newest_results(entries: Iterable[SessionEntry]) -> list[SessionEntry]:
    """Of every recording its newest result, the recordings newest first."""
    newest: dict[str, SessionEntry] = {}
    for entry in sorted(entries, key=lambda entry: (entry.created.timestamp(), str(entry.path))):
        newest[entry.recording_id] = entry
    return sorted(newest.values(), key=lambda entry: (entry.recorded.timestamp(), str(entry.path)), reverse=True)


def default_data_folder() -> Path:
    """Where patients and sessions belong on this system."""
    return Path(platformdirs.user_data_dir("carpus", appauthor=False))


class PatientRegister:
    """The open register of one data folder; may be used from several threads, one call at a time.

    A register that is not there yet is made, and filled from the session files that are. Folders and file are
    readable by their owner only. Raises what :class:`Database` does. ``of_practice``: the register of the practice
    patient, whose sessions are all simulated and count as sessions there.
    """

    def __init__(self, folder: Path, *, of_practice: bool = False) -> None:
        self._counted = "" if of_practice else "AND session.simulated IS NOT 1"
        self.sessions_folder = folder / SESSIONS_FOLDER
        make_private(folder)
        make_private(self.sessions_folder)
        self._resolved_folder = self.sessions_folder.resolve()  # asked of every file whenever the list is shown
        self.told: tuple[CarpusFault, ...] = ()
        """What was found when a register had to be made."""
        self.database = Database(folder / REGISTER_FILE, MIGRATIONS, TABLES)
        self.erased_late = 0
        """Files of an erasure that was cut short, deleted now."""
        try:
            with self.database.transaction() as database:
                self.erased_late, _ = out_of_sight.go_on_erasing(database, self.sessions_folder)
            if self.database.is_new or self.database.is_raised:
                self.told = self.rebuild_from_sessions().faults
            else:
                self._mend()
        except CarpusFault:
            self.database.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """May be called twice."""
        self.database.close()

    def patients(self, search: str = "", *, archived: bool = False) -> list[PatientRecord]:
        """Patients whose pseudonym, name or note holds every word of ``search``; last session first.

        Without those in the archive, unless ``archived``, and without archived sessions in the counts.
        """
        with self.database.transaction() as database:
            rows = database.execute(
                f"""
                SELECT patient.*, COUNT(DISTINCT session.recording_id) AS recordings, COUNT(session.id) AS results,
                       MAX(session.recorded_s) AS last_s, session.recorded AS last, session.exercise AS last_exercise
                FROM patient LEFT JOIN session ON session.patient_id = patient.id {self._counted}
                     AND session.recording_id NOT IN (SELECT identity FROM archived)
                {"" if archived else "WHERE patient.id NOT IN (SELECT identity FROM archived)"}
                GROUP BY patient.id ORDER BY last_s IS NULL, last_s DESC, added_s DESC, pseudonym
                """  # beside MAX, SQLite takes the other columns from the row of the maximum
            ).fetchall()
        records = [_record(row) for row in rows]
        words = search.casefold().split()
        return [record for record in records if all(word in _searchable(record.entry) for word in words)]

    def patient(self, patient_id: str) -> PatientRecord:
        """One patient; raises KeyError for an identity that is not in the register."""
        for record in self.patients(archived=True):
            if record.patient_id == patient_id:
                return record
        raise KeyError(patient_id)

    def suggest_pseudonym(self, chance: random.Random | None = None) -> str:
        """A random pseudonym that no patient has."""
        return suggest_pseudonym([record.entry.pseudonym for record in self.patients(archived=True)], chance)

    def add(self, entry: PatientEntry, now: datetime | None = None) -> str:
        """Enter a new patient; returns the identity given. Raises :class:`PseudonymTaken`."""
        with self.database.transaction() as database:
            return _insert(database, entry, now or datetime.now(UTC))

    def change(self, patient_id: str, entry: PatientEntry) -> None:
        """Replace what is written of a patient; the sessions stay. Raises :class:`PseudonymTaken`.

        Files recorded under an earlier pseudonym keep it; they stay with the patient as long as the register does.
        """
        with self.database.transaction() as database:
            _check_free(database, entry.pseudonym, patient_id)
            settings = ", ".join(f"{name} = ?" for name in _ENTRY)
            changed = database.execute(f"UPDATE patient SET {settings} WHERE id = ?", (*_columns(entry), patient_id))
            if changed.rowcount == 0:
                raise KeyError(patient_id)
        self.database.leave_no_trace()  # of a name that was taken away

    def enter_by_hand(self, patient_id: str, values: Iterable[HandValue]) -> None:
        """Add what was measured by hand; raises KeyError for a patient who is not in the register."""
        with self.database.transaction() as database:
            if database.execute("SELECT 1 FROM patient WHERE id = ?", (patient_id,)).fetchone() is None:
                raise KeyError(patient_id)
            by_hand.enter(database, patient_id, values)

    def by_hand(self, patient_id: str) -> list[HandValue]:
        """Everything that was ever measured by hand of a patient, in the order in which it was entered."""
        with self.database.transaction() as database:
            return by_hand.entries_of(database, patient_id)

    def sessions(self, patient_id: str, *, archived: bool = False) -> list[SessionEntry]:
        """The patient's sessions, newest first, every result of a recording (:func:`newest_results`); without those in
        the archive, unless ``archived``."""
        seen = "" if archived else "AND recording_id NOT IN (SELECT identity FROM archived)"
        with self.database.transaction() as database:
            rows = database.execute(
                f"SELECT * FROM session WHERE patient_id = ? {seen} "
                "ORDER BY recorded_s DESC, created_s DESC, path DESC",
                (patient_id,),
            ).fetchall()
        return [self._session(row) for row in rows]

    def results_of_recording(self, recording_id: str) -> list[SessionEntry]:
        """Every session file that came of one recording, whoever it belongs to."""
        with self.database.transaction() as database:
            rows = database.execute("SELECT * FROM session WHERE recording_id = ?", (recording_id,)).fetchall()
        return [self._session(row) for row in rows]

    def owner(self, session_id: str) -> str:
        """The patient whose session it is, empty for nobody's; raises KeyError for one that is not in the register."""
        with self.database.transaction() as database:
            row = database.execute("SELECT patient_id FROM session WHERE id = ?", (session_id,)).fetchone()
        if row is None:
            raise KeyError(session_id)
        return str(row[0] or "")

    def archive(self, identity: str, now: datetime | None = None) -> None:
        """Take a patient, or a recording with all its results, out of every list and count."""
        with self.database.transaction() as database:
            out_of_sight.archive(database, identity, now or datetime.now(UTC))

    def bring_back(self, identity: str) -> None:
        """Undo :meth:`archive`."""
        with self.database.transaction() as database:
            out_of_sight.bring_back(database, (identity,))

    def archived(self) -> dict[str, datetime]:
        """Patients and recordings in the archive, and since when."""
        with self.database.transaction() as database:
            rows = database.execute("SELECT identity, since FROM archived").fetchall()
        return {str(identity): datetime.fromisoformat(since) for identity, since in rows}

    def recipients(self) -> list[str]:
        """To whom letters were written, the last used first."""
        with self.database.transaction() as database:
            return recipients.known(database)

    def remember_recipient(self, address: str) -> None:
        """Take down to whom a letter goes."""
        with self.database.transaction() as database:
            recipients.remember(database, address)

    def remember_made(self, paths: Iterable[Path], kind: made_files.MadeKind, session_ids: Iterable[str]) -> None:
        """Take down files that were made from sessions of this register, for the day these are erased."""
        with self.database.transaction() as database:
            made_files.remember(database, paths, kind, session_ids)

    def session(self, session_id: str) -> SessionEntry:
        """One session; raises KeyError for an identity that is not in the register."""
        with self.database.transaction() as database:
            row = database.execute("SELECT * FROM session WHERE id = ?", (session_id,)).fetchone()
        if row is None:
            raise KeyError(session_id)
        return self._session(row)

    def patient_of(self, session_id: str) -> str:
        """Whose session it is; raises KeyError for an identity that is not in the register."""
        with self.database.transaction() as database:
            row = database.execute("SELECT patient_id FROM session WHERE id = ?", (session_id,)).fetchone()
        if row is None:
            raise KeyError(session_id)
        return str(row["patient_id"])

    def results_of(self, session_id: str) -> list[SessionEntry]:
        """Every result of the recording of a session, the first one first."""
        own = self.session(session_id)
        with self.database.transaction() as database:
            rows = database.execute(
                "SELECT * FROM session WHERE recording_id = ? ORDER BY created_s, path", (own.recording_id,)
            ).fetchall()
        return [self._session(row) for row in rows]

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
        with self.database.transaction() as database:
            _index(database, self._stored_path(path), patient_id, outline)
            state = path.stat()
            seen_files.store(database, {self._stored_path(path): Seen(state.st_size, state.st_mtime_ns)})
        return self.session(outline.header.session_id)

    def move_session(self, session_id: str, patient_id: str) -> None:
        """Give a session to another patient; the file keeps the pseudonym under which it was recorded."""
        self.patient(patient_id)
        self._change_session(session_id, "patient_id", patient_id)

    def rename_exercise(self, session_id: str, exercise: str) -> None:
        """List a session as another exercise; the file keeps what was chosen then."""
        self._change_session(session_id, "exercise", exercise)

    def forget_session(self, session_id: str) -> None:
        """Take a session whose files are gone out of the index; raises KeyError for one that is not in it."""
        with self.database.transaction() as database:
            rows = database.execute("SELECT path FROM session WHERE id = ?", (session_id,)).fetchall()
            if not rows:
                raise KeyError(session_id)
            database.execute("DELETE FROM session WHERE id = ?", (session_id,))
            seen_files.forget(database, (str(path) for (path,) in rows))

    def _change_session(self, session_id: str, column: str, value: str) -> None:
        with self.database.transaction() as database:
            changed = database.execute(f"UPDATE session SET {column} = ? WHERE id = ?", (value, session_id))
            if changed.rowcount == 0:
                raise KeyError(session_id)

    def rebuild_from_sessions(self, now: datetime | None = None) -> Rebuilt:
        """Make the index again from the session files; known patients keep their names, notes and ages.

        A pseudonym without a patient becomes one; a file without a pseudonym is indexed without a patient.
        """
        there = self._files_there()
        with self.database.transaction() as database:
            before = seen_files.stored(database)
            indexed = {str(path) for (path,) in database.execute("SELECT path FROM session")}
        found: list[tuple[Path, SessionOutline]] = []
        faults: list[CarpusFault] = []
        now_seen: dict[str, Seen] = {}
        kept: set[str] = set()
        for path, look in there.items():
            stored_path = self._stored_path(path)
            known_look = before.get(stored_path)
            if not seen_files.can_be_stored(stored_path):
                faults.append(SessionUnreadable(ascii(path.name), phrase("a name that is no text")))
            elif (
                known_look
                and known_look.is_still(look)
                and (stored_path in indexed if not known_look.reason else known_look.reason[:10] != seen_files.COPY)
            ):
                now_seen[stored_path] = replace(look, reason=known_look.reason)
                if not known_look.reason:
                    kept.add(stored_path)
            else:
                try:
                    if look.reason:
                        raise SessionUnreadable(path, look.reason)
                    found.append((path, read_outline(path)))
                    now_seen[stored_path] = look
                except SessionUnreadable as fault:
                    now_seen[stored_path] = replace(look, reason=fault.detail or "cannot be read")
                    faults.append(fault)
        with self.database.transaction() as database:
            owner = dict(database.execute("SELECT path, patient_id FROM session"))
            # The copy that is known already is the session; of new ones the longest, then the first by name.
            taken = {key: path for path, key in database.execute("SELECT path, id FROM session") if path in kept}
            sessions: list[tuple[Path, SessionOutline]] = []
            for path, outline in sorted(
                found, key=lambda one: (self._stored_path(one[0]) not in owner, -one[1].frames)
            ):
                stored_path, session_id = self._stored_path(path), outline.header.session_id
                if session_id in taken:
                    reason = f"{seen_files.COPY}{taken[session_id]}"
                    now_seen[stored_path] = replace(now_seen[stored_path], reason=reason)
                    continue
                taken[session_id] = stored_path
                sessions.append((path, outline))
            known = {name.casefold(): key for name, key in database.execute("SELECT pseudonym, id FROM patient")}
            missing: dict[str, tuple[str, set[Side]]] = {}
            for path, outline in sessions:
                subject = outline.header.subject_id.strip()
                if subject and subject.casefold() not in known and not owner.get(self._stored_path(path)):
                    missing.setdefault(subject.casefold(), (subject, set()))[1].add(outline.header.hand)
            for key, (subject, hands) in missing.items():
                side: AffectedSide = "both" if len(hands) == 2 else next(iter(hands))
                known[key] = _insert(database, PatientEntry(subject, side), now or datetime.now(UTC))
            database.executemany("DELETE FROM session WHERE path = ?", [(path,) for path in owner if path not in kept])
            gone = (path for path in before.keys() - now_seen.keys() if not self._is_part(path))
            seen_files.forget(database, gone)
            seen_files.store(database, now_seen)
            for path, outline in sessions:
                stored_path = self._stored_path(path)
                patient_id = owner.get(stored_path) or known.get(outline.header.subject_id.strip().casefold())
                _index(database, stored_path, patient_id, outline)
        return Rebuilt(len(kept) + len(sessions), len(missing), tuple(faults))

    def is_behind(self) -> bool:
        """Whether files were copied in, taken away or changed since they were last looked at."""
        with self.database.transaction() as database:
            before = seen_files.stored(database)
        now = {self._stored_path(path): look for path, look in self._files_there().items()}
        now = {path: look for path, look in now.items() if seen_files.can_be_stored(path)}
        before = {path: look for path, look in before.items() if not self._is_part(path)}
        return before.keys() != now.keys() or any(not before[path].is_still(look) for path, look in now.items())

    def _files_there(self) -> dict[Path, Seen]:
        """Files named like sessions, but for those that are being erased."""
        with self.database.transaction() as database:
            going = {self.sessions_folder / path for path in out_of_sight.being_erased(database)}
        found = seen_files.files_there(self.sessions_folder)
        return {path: look for path, look in found.items() if path not in going}

    def first_told(self, faults: Iterable[CarpusFault]) -> list[CarpusFault]:
        """Of faults with files of this folder those that are new, or whose file has changed; remembers them."""
        new: list[CarpusFault] = []
        with self.database.transaction() as database:
            before = seen_files.stored(database)
            for fault in faults:
                path = Path(fault.subject)
                try:
                    state = path.lstat()
                    stored_path = self._stored_path(path)
                except (OSError, ValueError):
                    new.append(fault)
                    continue
                look = Seen(state.st_size, state.st_mtime_ns, fault.detail or "cannot be read")
                known = before.get(stored_path)
                if known is None or not known.is_still(look):
                    new.append(fault)
                    if seen_files.can_be_stored(stored_path):
                        seen_files.store(database, {stored_path: look})
        return new

    def given_up(self) -> set[Path]:
        """Part files that could not be finished and have not changed since."""
        with self.database.transaction() as database:
            before = seen_files.stored(database)
        found = set()
        for stored_path, look in before.items():
            path = self.sessions_folder / stored_path
            if path.suffix == ".part" and path.is_file():
                state = path.stat()
                if look.is_still(Seen(state.st_size, state.st_mtime_ns)):
                    found.add(path)
        return found

    def set_apart(self) -> list[tuple[Path, str]]:
        """Files of the sessions' folder that are no sessions or copies of one, each with the reason."""
        with self.database.transaction() as database:
            before = seen_files.stored(database)
        return [(self.sessions_folder / path, one.reason) for path, one in sorted(before.items()) if one.reason]

    def _is_part(self, stored_path: str) -> bool:
        """Whether a path is of a part file that is still there and could not be finished."""
        return stored_path.endswith(".part") and (self.sessions_folder / stored_path).exists()

    def _mend(self) -> None:
        """Rows that this program would never have written: sessions are read anew, patients keep what makes sense."""
        with self.database.transaction() as database:
            wrong = []
            for row in database.execute("SELECT * FROM session"):
                try:
                    self._session(row)
                    wrong += [] if all(isinstance(row[name], (int, float)) for name in _NUMBERS) else [row["path"]]
                except (ValueError, TypeError):
                    wrong.append(row["path"])
            database.executemany("DELETE FROM session WHERE path IS ?", [(path,) for path in wrong])
            database.executemany("DELETE FROM seen WHERE path IS ?", [(path,) for path in wrong])
            for row in database.execute("SELECT rowid AS number, * FROM patient").fetchall():
                entry = _possible_entry(row)
                if tuple(row[name] for name in _ENTRY) != _columns(entry):
                    settings = ", ".join(f"{name} = ?" for name in _ENTRY)
                    numbered = (*_columns(entry), row["number"])
                    database.execute(f"UPDATE patient SET {settings}, added_s = 0 WHERE rowid = ?", numbered)

    def _stored_path(self, path: Path) -> str:
        """Relative to the sessions folder, so that the data folder can be moved as a whole."""
        if path.is_relative_to(self.sessions_folder):
            return path.relative_to(self.sessions_folder).as_posix()
        try:
            return path.resolve().relative_to(self._resolved_folder).as_posix()
        except ValueError:
            return str(path.resolve())

    def _session(self, row: sqlite3.Row) -> SessionEntry:
        return SessionEntry(
            session_id=row["id"],
            path=self.sessions_folder / row["path"],
            recorded=datetime.fromisoformat(row["recorded"]),
            created=datetime.fromisoformat(row["created"]),
            recording_id=row["recording_id"],
            exercise=row["exercise"],
            hand=row["hand"],
            frames=row["frames"],
            duration_s=row["duration_s"],
            complete=bool(row["complete"]),
            simulated=bool(row["simulated"]),
        )


def entry_of(path: Path, outline: SessionOutline) -> SessionEntry:
    """A session as the register would know it, of a file that is not in it."""
    header = outline.header
    return SessionEntry(
        session_id=header.session_id,
        path=path,
        recorded=header.when,
        created=datetime.fromisoformat(header.created),
        recording_id=header.recording_id,
        exercise=header.exercise,
        hand=header.hand,
        frames=outline.frames,
        duration_s=outline.duration_s,
        complete=outline.complete,
        simulated=header.simulated,
    )


_ENTRY = ("pseudonym", "name", "side", "dominance", "age_band", "note")
_NUMBERS = ("created_s", "frames", "duration_s", "complete")


def _possible_entry(row: sqlite3.Row) -> PatientEntry:
    """What of a patient's row can be: texts where texts belong, one of the choices where there are choices."""

    def text(name: str, choices: tuple[str, ...] = ()) -> Any:
        value = row[name]
        good = isinstance(value, str) and (not choices or value in choices)
        return value if good else (choices[0] if choices else "")

    return PatientEntry(
        text("pseudonym").strip() or f"Unknown {row['number']}",
        text("side", ("both", "right", "left")),
        text("dominance", ("unknown", "right", "left", "both")),
        text("age_band", AGE_BANDS),
        text("note"),
        text("name"),
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
        header.recording_id,
        header.when.isoformat(),
        header.when.timestamp(),
        header.simulated,
    )
    marks = ", ".join("?" * len(values))
    database.execute(f"INSERT OR REPLACE INTO session VALUES ({marks})", values)


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
        session_count=row["recordings"],
        last_session=datetime.fromisoformat(last) if last else None,
        last_exercise=row["last_exercise"] or "",
        result_count=row["results"],
    )


def _searchable(entry: PatientEntry) -> str:
    return f"{entry.pseudonym} {entry.name} {entry.note}".casefold()

"""List of sessions: found by id in the store, by path in the folder, and rebuilt from the files.

A file is read again only if its size or time changed. A file that cannot be a session stays where it is, is reported
once, and is not read again while it is the same; so is a copy of a listed session.
"""

from __future__ import annotations

import glob
import re
import stat
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from sqlalchemy import Row, delete, insert, select

from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault
from carpus.core.model.names import fold_name
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Side
from carpus.core.platform.durable import find_free_name, iter_paths, link_or_copy, make_private_folder, write_fault
from carpus.core.records import changes
from carpus.core.records.changes import LOST_FOLDER, ChangeSet, insert_row, update_row, upsert_row
from carpus.core.records.patients import Patients, patient_columns
from carpus.core.records.schema import FILE_STATE, PATIENT, SESSION
from carpus.core.records.session_setup import PRACTICE_PATIENT
from carpus.core.records.store import Store, new_id
from carpus.core.records.values import AffectedSide, Patient, ScanResult, SessionEntry, parse_time
from carpus.core.session.reader import read_outline, rewrite_session
from carpus.core.session.values import SessionOutline

COPY_REASON = "a copy of "


@dataclass(frozen=True, slots=True)
class FileState:
    """State of a file when it was last read, equal while it need not be read again; ``reason`` why it is no session."""

    size: int
    modified_ns: int
    reason: str = field(default="", compare=False)


def read_file_states(store: Store) -> dict[str, FileState]:
    """Return the stored states by path."""
    return {str(row.path): FileState(row.size, row.changed_ns, row.reason) for row in store.rows(select(FILE_STATE))}


def save_file_states(store: Store, states: Mapping[str, FileState], removed: Iterable[str] = ()) -> None:
    """Save states of files, and delete those of ``removed`` paths."""
    paths = [*states, *removed]
    values = [
        {"path": path, "size": one.size, "changed_ns": one.modified_ns, "reason": one.reason}
        for path, one in states.items()
    ]
    forgotten = [
        delete(FILE_STATE).where(FILE_STATE.c.path.in_(paths[at : at + BATCH_ROWS]))
        for at in range(0, len(paths), BATCH_ROWS)
    ]
    made = [insert(FILE_STATE).values(values[at : at + BATCH_ROWS]) for at in range(0, len(values), BATCH_ROWS)]
    if paths:
        store.execute_local(*forgotten, *made)


def is_storable_path(path: str) -> bool:
    """Return whether the store can hold a file's name; some systems have names that are not text."""
    try:
        path.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return "\0" not in path


MAX_NAME_CHARACTERS = 40
"""Of a pseudonym in a file name, since systems limit the length."""
PENDING_FOLDER = "corrections"
"""Folder of re-analysed sessions that nobody has decided about."""
PENDING_COPY_SUFFIX = ".h5.new"
"""Accepted result, hidden beside its session until it is listed."""
BATCH_ROWS = 500
"""Rows of one transaction when the list is rebuilt."""


SHARE_MARKER = ".carpus-is-there"
"""File in a share with sessions: tells the mounted share from its empty mount point."""


def check_share(store: Store) -> None:
    """Check that the clinic's share is mounted.

    Raises :class:`FolderMissing`, or :class:`SessionShareEmpty` for what may be the mount point only: files written
    there would be hidden once the share is back.
    """
    root = store.sessions_folder
    mark = root / SHARE_MARKER
    if not store.uses_share or mark.exists():
        return
    if not root.is_dir():
        raise errors.FolderMissing(root)
    if not any(iter_paths(root, ".h5")):
        if store.row(select(SESSION.c.id).limit(1)) is not None:
            raise errors.SessionShareEmpty(root)
        return
    with suppress(OSError):  # the last session may go, and what is left of it is to be gone on with
        mark.touch()


class SessionList:
    """Sessions of a store."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self.folder = store.sessions_folder
        self._resolved_folder = self.folder.resolve()  # asked of every file whenever the list is made

    def patient_sessions(self, patient_id: str, *, include_archived: bool = False) -> list[SessionEntry]:
        """Return all results of a patient (empty: of nobody), newest first.

        Archived sessions are left out unless ``include_archived``.
        """
        query = select(SESSION).where(SESSION.c.patient_id == (patient_id or None), SESSION.c.erasing == 0)
        if not include_archived:
            query = query.where(SESSION.c.archived == "")
        order = (SESSION.c.recorded_s.desc(), SESSION.c.created_s.desc(), SESSION.c.path.desc())
        return [self._entry_from_row(row) for row in self._store.rows(query.order_by(*order))]

    def get(self, session_id: str) -> SessionEntry:
        """Return the session with this id. Raises :class:`SessionUnreadable` if there is none."""
        return self._entry_from_row(self._row(session_id))

    def owner_id(self, session_id: str) -> str:
        """Return the session's patient, empty for none. Raises :class:`SessionUnreadable` without such a session."""
        return self._row(session_id).patient_id or ""

    def last_patient_id(self) -> str:
        """Return the patient of the last session; empty for none and for the practice patient."""
        query = select(SESSION.c.patient_id).where(SESSION.c.erasing == 0, SESSION.c.archived == "")
        row = self._store.row(query.order_by(SESSION.c.created_s.desc()).limit(1))
        return "" if row is None or row.patient_id in (None, PRACTICE_PATIENT) else str(row.patient_id)

    def _row(self, session_id: str) -> Row[Any]:
        row = self._store.row(select(SESSION).where(SESSION.c.id == session_id, SESSION.c.erasing == 0))
        if row is None:
            raise errors.SessionUnreadable(session_id, phrase("not in the patient list"))
        return row

    def recording_versions(self, recording_id: str) -> list[SessionEntry]:
        """Return all results of a recording, oldest first."""
        query = select(SESSION).where(SESSION.c.recording_id == recording_id, SESSION.c.erasing == 0)
        return [
            self._entry_from_row(row) for row in self._store.rows(query.order_by(SESSION.c.created_s, SESSION.c.path))
        ]

    def result_versions(self, session_id: str) -> list[SessionEntry]:
        """Return all results of a session's recording, oldest first. Raises :class:`SessionUnreadable`."""
        return self.recording_versions(self._row(session_id).recording_id)

    def patient_folder(self, patient_id: str) -> Path:
        """Return the patient's private folder, named by the id; it is created.

        Raises the faults of :func:`check_share` and :class:`OutputNotWritable`, also for an id that this program did
        not give.
        """
        folder = self.folder / patient_id
        check_share(self._store)
        if not changes.is_patient_id(patient_id):
            raise errors.OutputNotWritable(folder)
        if not self.folder.is_dir():  # a disk that was unplugged: what is made in its place would hide under it
            raise errors.FolderMissing(self.folder)
        make_private_folder(folder)
        return folder

    def new_path(self, patient_id: str, pseudonym: str, exercise: str, hand: Side, when: datetime) -> Path:
        """Return a free path in the patient's folder. Raises the faults of :meth:`patient_folder`."""
        return free_session_path(self.patient_folder(patient_id), pseudonym, exercise, hand, when)

    def add(
        self,
        path: Path,
        patient_id: str,
        initials: str = "",
        current_path: Path | None = None,
        exercise: str = "",
        extra_changes: ChangeSet = (),
    ) -> SessionEntry:
        """List a finished session file, together with ``extra_changes``.

        ``exercise`` replaces the one in the file; ``current_path`` is where the file lies until it gets its name.
        Raises :class:`SessionUnreadable`.
        """
        file = current_path or path
        outline = read_outline(file)
        before = self.recording_versions(outline.header.recording_id)
        archived = self._row(before[0].session_id).archived if before else ""
        columns = _session_columns(self.relative_path(path), patient_id, outline) | {
            "by": initials,
            "archived": archived,
        }
        if exercise:
            columns["exercise"] = exercise
        self._store.apply([upsert_row(SESSION, outline.header.session_id, **columns), *extra_changes])
        state = file.stat()
        save_file_states(self._store, {self.relative_path(path): FileState(state.st_size, state.st_mtime_ns)})
        return self.get(outline.header.session_id)

    def move_to_patient(self, session_id: str, patient_id: str) -> None:
        """Move a session with its companions to another patient.

        The file is rewritten under that patient's pseudonym, so that nothing names the wrong one. Pending results are
        deleted. Raises :class:`SessionUnreadable`, :class:`ConcurrentChange` and the faults of writing; then nothing
        changed.
        """
        entry, pseudonym = self.get(session_id), Patients(self._store).get(patient_id).pseudonym
        if not entry.path.exists():
            self._store.apply([update_row(SESSION, session_id, patient_id=patient_id)])
            return
        path = self.new_path(patient_id, pseudonym, entry.exercise, entry.hand, entry.recorded)
        beside = [one for one in entry.path.parent.glob(f"{glob.escape(entry.path.stem)}.*") if one != entry.path]
        made = [path, *(path.with_name(f"{path.stem}{one.name.removeprefix(entry.path.stem)}") for one in beside)]
        written = path
        try:
            rewrite_session(entry.path, path, subject_id=pseudonym)
            for one, written in zip(beside, made[1:], strict=True):
                link_or_copy(one, written)  # a kill in between loses none
            size, stored_path = read_outline(path).size_bytes, self.relative_path(path)
            self._store.apply([update_row(SESSION, session_id, patient_id=patient_id, path=stored_path, size=size)])
        except BaseException as cause:
            for one in made:
                one.unlink(missing_ok=True)
            if isinstance(cause, OSError):
                raise write_fault(written, cause) from cause
            raise
        for one in (entry.path, *beside, *find_pending_results(self._store, [session_id])):
            with suppress(OSError):  # open elsewhere: it is nobody's, and goes with the patient
                one.unlink()

    def set_exercise(self, session_id: str, exercise: str) -> None:
        """List a session under another exercise; the file keeps its own."""
        self._store.apply([update_row(SESSION, session_id, exercise=exercise)])

    def archive(self, session_id: str, now: datetime | None = None) -> None:
        """Archive a recording with all its results: it is in no list and no count."""
        self._update_recording(session_id, archived=(now or datetime.now(UTC)).isoformat(timespec="seconds"))

    def unarchive(self, session_id: str) -> None:
        self._update_recording(session_id, archived="")

    def _update_recording(self, session_id: str, **values: Any) -> None:
        self._store.apply([update_row(SESSION, one.session_id, **values) for one in self.result_versions(session_id)])

    def list_archived(self) -> list[tuple[SessionEntry, str, datetime]]:
        """Return the first result of each archived recording, its patient, and since when."""
        query = select(SESSION).where(SESSION.c.archived != "", SESSION.c.erasing == 0).order_by(SESSION.c.created_s)
        found: dict[str, Row[Any]] = {}
        for row in self._store.rows(query):
            found.setdefault(row.recording_id, row)
        return [
            (self._entry_from_row(row), row.patient_id or "", parse_time(row.archived, row.created_s))
            for row in found.values()
        ]

    def relative_path(self, path: Path) -> str:
        """Return a path relative to the session folder, so that the data folder can be moved.

        Raises :class:`SessionUnreadable` for a file elsewhere.
        """
        for one, folder in ((path, self.folder), (path.resolve(), self._resolved_folder)):
            if one.is_relative_to(folder):
                return one.relative_to(folder).as_posix()
        raise errors.SessionUnreadable(path, phrase("not in the session folder"))

    def _entry_from_row(self, row: Row[Any]) -> SessionEntry:
        return SessionEntry(
            row.id,
            self.folder / row.path,
            parse_time(row.recorded, row.recorded_s),
            parse_time(row.created, row.created_s),
            row.recording_id,
            row.exercise,
            row.hand,
            row.frames,
            row.duration_s,
            bool(row.simulated),
            row.by,
        )


def free_session_path(folder: Path, pseudonym: str, exercise: str, hand: Side, when: datetime) -> Path:
    """Return a free name for a session in a folder."""
    stem = f"{to_file_name(pseudonym) or 'patient'}_{when:%Y-%m-%d_%H%M%S}_{to_file_name(exercise) or 'session'}_{hand}"
    return find_free_name(folder / f"{stem}.h5")


def find_pending_results(store: Store, session_ids: Collection[str]) -> Iterator[Path]:
    """Yield pending results of these sessions.

    A damaged or unfinished one is recognised by its name, if it is like that of no other session.
    """
    named = {row.id: Path(row.path).stem for row in store.rows(select(SESSION.c.id, SESSION.c.path))}
    mine, others = (
        {stem for one, stem in named.items() if (one in session_ids) is is_mine} for is_mine in (True, False)
    )
    folder = store.folder / PENDING_FOLDER
    for path in folder.glob("*.h5*") if not folder.is_symlink() else ():
        try:
            header = read_outline(path).header
        except errors.SessionUnreadable:
            stem = re.split(r"\.h5\b", path.name)[0]
            stems = {stem, re.sub(r"-\d+$", "", stem)}
            if stems & mine and not stems & others:
                yield path
        else:
            if header.origin in session_ids or header.session_id in session_ids:
                yield path


class SessionFileScanner:
    """Scanner that updates or rebuilds the list from the session files.

    Only names, notes and what people wrote do not come from the files.
    """

    def __init__(self, store: Store) -> None:
        self._store, self._session_list = store, SessionList(store)
        self._folder = store.sessions_folder

    def scan(self, *, reports_faults: bool = True) -> ScanResult:
        """Read new and changed files; sessions whose file is gone stay listed.

        An unknown pseudonym becomes a patient; a file without one is listed without a patient. Unreadable files are
        stored as reported unless ``reports_faults`` is False.
        """
        before, (there, nameless) = read_file_states(self._store), self._current_files()
        known = {row.path: row for row in self._store.rows(select(SESSION))}
        now_seen: dict[str, FileState] = {}
        found: list[tuple[str, SessionOutline]] = []
        faults: list[CarpusFault] = []
        for path, look in there.items():
            old = before.get(path)
            if old == look and (old.reason[: len(COPY_REASON)] != COPY_REASON if old.reason else path in known):
                continue
            now_seen[path] = look
            try:
                if look.reason:
                    raise errors.SessionUnreadable(self._folder / path, look.reason)
                found.append((path, read_outline(self._folder / path)))
            except errors.SessionUnreadable as fault:
                faults.append(fault)
                if reports_faults:
                    now_seen[path] = FileState(look.size, look.modified_ns, fault.detail or "cannot be read")
                else:
                    del now_seen[path]
        if now_seen:  # of what has no name that can be kept nobody knows whether it was told
            faults += [
                errors.SessionUnreadable(ascii(Path(one).name), phrase("damaged: a name in it is not text"))
                for one in nameless
            ]
        unfinished = {path for path in before if path.endswith(".part") and (self._folder / path).exists()}
        gone = [path for path in before if path not in there and path not in unfinished]
        taken = self._update_list(found, known, there.keys(), now_seen)
        save_file_states(self._store, now_seen, gone)
        return ScanResult(taken, tuple(faults))

    def _update_list(
        self,
        found: list[tuple[str, SessionOutline]],
        known: dict[str, Row[Any]],
        current: Iterable[str],
        new_states: dict[str, FileState],
    ) -> int:
        """List what was read; return how many sessions changed.

        A copy of a session is not listed: the known file stays, else the longest, then the first by name.
        """
        current, rows = set(current), {row.id: row for row in known.values()}
        holds = {path: outline.header.session_id for path, outline in found}
        other = {row.id for path, row in known.items() if holds.get(path, row.id) != row.id}
        place = {row.id: path for path, row in known.items() if path in current and row.id not in other}
        rows_of_people = self._store.rows(select(PATIENT.c.id, PATIENT.c.pseudonym_key, PATIENT.c.former_pseudonyms))
        people = {str(row.pseudonym_key): str(row.id) for row in rows_of_people}
        former = {str(row.id): {fold_name(one) for one in row.former_pseudonyms.split("\n")} for row in rows_of_people}
        gone = self._store.scalars(changes.ERASED_SUBJECTS) if found else set()
        change: list[changes.RowChange] = []
        taken = 0
        for path, outline in sorted(found, key=lambda one: (one[0] not in known, -one[1].frames, one[0])):
            session_id = outline.header.session_id
            if place.get(session_id, path) != path:
                new_states[path] = FileState(
                    new_states[path].size, new_states[path].modified_ns, f"{COPY_REASON}{place[session_id]}"
                )
                continue
            place[session_id], subject = path, outline.header.subject_id.strip()
            of_practice = subject == PRACTICE_PATIENT or path.startswith(f"{PRACTICE_PATIENT}/")
            owner = PRACTICE_PATIENT if of_practice else people.get(fold_name(subject))
            before, folder = rows.get(session_id), path.split("/")[0]
            if owner is None and subject and fold_name(subject) in former.get(folder, ()):
                owner = folder
            if before is None and owner is None and changes.fingerprint(folder) in gone:
                del new_states[path]  # of who was erased: it is deleted at the next start
                continue
            if owner is None and subject and (before is None or before.patient_id is None):
                # The folder has the identity that was given while the server was away.
                given = folder if changes.is_patient_id(folder) and folder not in former else new_id()
                owner = people.setdefault(fold_name(subject), given)
                former[owner] = set()
                hands = {one.header.hand for _, one in found if fold_name(one.header.subject_id) == fold_name(subject)}
                side: AffectedSide = "both" if len(hands) == 2 else outline.header.hand
                change.append(insert_row(PATIENT, owner, **patient_columns(Patient(subject, side)), added_s=0.0))
            values = _session_columns(path, owner, outline)
            if before is not None:  # what a person said of it stays
                values |= {"patient_id": before.patient_id or owner, "exercise": before.exercise}
            if before is None or any(getattr(before, name) != value for name, value in values.items()):
                change.append(upsert_row(SESSION, session_id, **values))
                taken += 1
        # Files that a person exchanged or put in another's place: the names are free before others take them.
        change = [update_row(SESSION, one, path=f"{LOST_FOLDER}{one}") for one in sorted(other)] + change
        for start in range(0, len(change), BATCH_ROWS):
            self._store.apply(change[start : start + BATCH_ROWS])
        return taken

    def _current_files(self) -> tuple[dict[str, FileState], list[str]]:
        """Return files named like sessions that are not being erased, and names that cannot be stored."""
        going = self._store.scalars(select(SESSION.c.path).where(SESSION.c.erasing == 1))
        there, nameless = dict[str, FileState](), list[str]()
        for file in sorted(iter_paths(self._folder, ".h5")):
            path = file.relative_to(self._folder).as_posix()
            if not is_storable_path(path):
                nameless.append(path)
            elif path not in going:
                with suppress(OSError):  # gone meanwhile
                    state = file.lstat()
                    reason = "" if stat.S_ISREG(state.st_mode) else "not a plain file"
                    there[path] = FileState(state.st_size, state.st_mtime_ns, reason)
        return there, nameless

    def filter_new_faults(self, faults: Iterable[CarpusFault]) -> list[CarpusFault]:
        """Return faults whose file is new or changed, and store its state."""
        fresh: list[CarpusFault] = []
        before = read_file_states(self._store)
        for fault in faults:
            try:
                state = Path(fault.subject).lstat()
                path = self._session_list.relative_path(Path(fault.subject))
            except (OSError, ValueError, errors.SessionUnreadable):
                fresh.append(fault)
                continue
            look = FileState(state.st_size, state.st_mtime_ns, fault.detail or "cannot be read")
            known = before.get(path)
            if known != look:
                fresh.append(fault)
                if is_storable_path(path):
                    save_file_states(self._store, {path: look})
        return fresh

    def unrecoverable_parts(self) -> set[Path]:
        """Return part files that could not be completed and have not changed since."""
        found = set()
        for name, look in read_file_states(self._store).items():
            path = self._folder / name
            if path.suffix == ".part" and path.is_file():
                state = path.stat()
                if look == FileState(state.st_size, state.st_mtime_ns):
                    found.add(path)
        return found


def _session_columns(path: str, patient_id: str | None, outline: SessionOutline) -> dict[str, Any]:
    header = outline.header
    created = datetime.fromisoformat(header.created)
    return {
        "patient_id": patient_id or None,
        "path": path,
        "recording_id": header.recording_id,
        "recorded": header.recording_time.isoformat(),
        "recorded_s": header.recording_time.timestamp(),
        "created": header.created,
        "created_s": created.timestamp(),
        "exercise": header.exercise,
        "hand": header.hand,
        "frames": outline.frames,
        "duration_s": outline.duration_s,
        "complete": 1,
        "simulated": int(header.is_simulated),
        "size": outline.size_bytes,
    }


def to_file_name(text: str) -> str:
    """Convert a text for use in a file name."""
    return re.sub(r"\W+", "-", text)[:MAX_NAME_CHARACTERS].strip("-")

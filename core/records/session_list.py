"""Which sessions there are: found in the store by identity, in the folder by path, and made anew from the files.

A file is read again only when its size or its time has changed. One that cannot be a session is set apart: it stays
where it is, is named once, and is not opened again while it is the same. A copy of a session that is there already is
set apart too, so that it counts once."""

from __future__ import annotations

import glob
import re
import stat
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from sqlalchemy import Row, delete, insert, select

from carpus.core.durable import link_or_copy, make_private, write_fault
from carpus.core.errors import CarpusFault, FolderMissing, OutputNotWritable, SessionUnreadable, ShareEmpty
from carpus.core.names import folded
from carpus.core.phrase import phrase
from carpus.core.records import changes
from carpus.core.records.changes import NOWHERE, PRACTICE, Change, changed, kept, new
from carpus.core.records.patients import Patients, columns
from carpus.core.records.schema import PATIENT, SEEN, SESSION
from carpus.core.records.store import Store, new_id
from carpus.core.records.values import AffectedSide, Patient, Rebuilt, SessionEntry, moment
from carpus.core.session.disk import below, free_name
from carpus.core.session.reader import read_outline, write_anew
from carpus.core.session.values import SessionOutline
from carpus.core.types import Side

COPY = "a copy of "


@dataclass(frozen=True, slots=True)
class SeenFile:
    """A file as it was when it was looked at; ``reason`` why it is no session."""

    size: int
    changed_ns: int
    reason: str = ""

    def is_still(self, now: SeenFile) -> bool:
        """Whether a file that looks like ``now`` need not be read again."""
        return (self.size, self.changed_ns) == (now.size, now.changed_ns)


def files_there(folder: Path) -> dict[Path, SeenFile]:
    """Every file of a folder that is named like a session, as it looks now."""
    found: dict[Path, SeenFile] = {}
    for path in sorted(below(folder, ".h5")):
        try:
            state = path.lstat()
        except OSError:
            continue  # gone meanwhile
        found[path] = SeenFile(
            state.st_size, state.st_mtime_ns, "" if stat.S_ISREG(state.st_mode) else "not a plain file"
        )
    return found


def remembered(store: Store) -> dict[str, SeenFile]:
    """What was looked at before, by path."""
    return {str(row.path): SeenFile(row.size, row.changed_ns, row.reason) for row in store.rows(select(SEEN))}


def remember(store: Store, seen: Mapping[str, SeenFile], gone: Iterable[str] = ()) -> None:
    """Take down how files looked, and forget those that are ``gone``."""
    paths = [*seen, *gone]
    values = [
        {"path": path, "size": one.size, "changed_ns": one.changed_ns, "reason": one.reason}
        for path, one in seen.items()
    ]
    forgotten = [delete(SEEN).where(SEEN.c.path.in_(paths[at : at + AT_ONCE])) for at in range(0, len(paths), AT_ONCE)]
    made = [insert(SEEN).values(values[at : at + AT_ONCE]) for at in range(0, len(values), AT_ONCE)]
    if paths:
        store.own(*forgotten, *made)


def can_be_stored(path: str) -> bool:
    """Whether the store can hold a file's name; some systems have names that are no text."""
    try:
        path.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return "\0" not in path


MOST_LETTERS = 40
"""Of a pseudonym in a file's name, which no system lets be as long as one likes."""
TRIALS_FOLDER = "corrections"
"""In the data folder: sessions tracked again that nobody has decided about."""
COPY_SUFFIX = ".h5.new"
"""Of one that is wanted: hidden beside its session until it is in the list."""
AT_ONCE = 500
"""Rows of one change when the list is made anew."""


IS_THERE = ".carpus-is-there"
"""In a share that holds sessions, or held some: who finds it knows that it is the share, and not its empty place."""


def look_for_share(store: Store) -> None:
    """Raises :class:`FolderMissing` for a clinic's share that is away, :class:`ShareEmpty` where only its place may be
    there; the files would come back with it, and what was written into the place would be hidden."""
    root = store.sessions_folder
    mark = root / IS_THERE
    if not store.on_share or mark.exists():
        return
    if not root.is_dir():
        raise FolderMissing(root)
    if not any(below(root, ".h5")):
        if store.row(select(SESSION.c.id).limit(1)) is not None:
            raise ShareEmpty(root)
        return
    with suppress(OSError):  # the last session may go, and what is left of it is to be gone on with
        mark.touch()


class ListedSessions:
    """The sessions of a store."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self.folder = store.sessions_folder
        self._resolved = self.folder.resolve()  # asked of every file whenever the list is made

    def of_patient(self, patient_id: str, *, archived: bool = False) -> list[SessionEntry]:
        """The patient's sessions, nobody's for none, newest first, every result of a recording; without those in the
        archive, unless ``archived``."""
        query = select(SESSION).where(SESSION.c.patient_id == (patient_id or None), SESSION.c.erasing == 0)
        if not archived:
            query = query.where(SESSION.c.archived == "")
        order = (SESSION.c.recorded_s.desc(), SESSION.c.created_s.desc(), SESSION.c.path.desc())
        return [self._entry(row) for row in self._store.rows(query.order_by(*order))]

    def one(self, session_id: str) -> SessionEntry:
        """Raises KeyError for an identity that is not in the store."""
        return self._entry(self._row(session_id))

    def owner(self, session_id: str) -> str:
        """The patient whose session it is, empty for nobody's; raises KeyError for one that is not in the store."""
        return self._row(session_id).patient_id or ""

    def last_owner(self) -> str:
        """Whose session was made last, also a simulated one; empty for nobody's and the practice patient's."""
        query = select(SESSION.c.patient_id).where(SESSION.c.erasing == 0, SESSION.c.archived == "")
        row = self._store.row(query.order_by(SESSION.c.created_s.desc()).limit(1))
        return "" if row is None or row.patient_id in (None, PRACTICE) else str(row.patient_id)

    def _row(self, session_id: str) -> Row[Any]:
        row = self._store.row(select(SESSION).where(SESSION.c.id == session_id, SESSION.c.erasing == 0))
        if row is None:
            raise KeyError(session_id)
        return row

    def of_recording(self, recording_id: str) -> list[SessionEntry]:
        """Every session file that came of one recording, whoever it belongs to, the first one first."""
        query = select(SESSION).where(SESSION.c.recording_id == recording_id, SESSION.c.erasing == 0)
        return [self._entry(row) for row in self._store.rows(query.order_by(SESSION.c.created_s, SESSION.c.path))]

    def results_of(self, session_id: str) -> list[SessionEntry]:
        """Every result of the recording of a session, the first one first. Raises KeyError."""
        return self.of_recording(self._row(session_id).recording_id)

    def folder_for(self, patient_id: str) -> Path:
        """The patient's own private folder, which has the patient's identity for a name. Raises the faults of
        :func:`look_for_share`, :class:`OutputNotWritable`, also for an identity that this program did not give."""
        folder = self.folder / patient_id
        look_for_share(self._store)
        if not changes.is_identity(patient_id):
            raise OutputNotWritable(folder)
        if not self.folder.is_dir():  # a disk that was unplugged: what is made in its place would hide under it
            raise FolderMissing(self.folder)
        make_private(folder)
        return folder

    def new_path(self, patient_id: str, pseudonym: str, exercise: str, hand: Side, when: datetime) -> Path:
        """A free path for a session in the patient's folder. Raises the faults of :meth:`folder_for`."""
        return free_path(self.folder_for(patient_id), pseudonym, exercise, hand, when)

    def enter(
        self,
        path: Path,
        patient_id: str,
        by: str = "",
        lies_at: Path | None = None,
        exercise: str = "",
        also: Change = (),
    ) -> SessionEntry:
        """Take a finished session file into the list, of an ``exercise`` where a person said another, in one step with
        what is ``also`` to be stored. ``lies_at`` is where it is as long as it has not got its name yet. Raises
        :class:`SessionUnreadable`."""
        file = lies_at or path
        outline = read_outline(file)
        before = self.of_recording(outline.header.recording_id)
        archived = self._row(before[0].session_id).archived if before else ""
        columns = _columns(self.stored_path(path), patient_id, outline) | {"by": by, "archived": archived}
        if exercise:
            columns["exercise"] = exercise
        self._store.do([kept(SESSION, outline.header.session_id, **columns), *also])
        state = file.stat()
        remember(self._store, {self.stored_path(path): SeenFile(state.st_size, state.st_mtime_ns)})
        return self.one(outline.header.session_id)

    def move(self, session_id: str, patient_id: str) -> None:
        """Give a session to another patient, with all that lies beside it: written anew under that one's pseudonym and
        into that one's folder, so that nothing of it says whose it was taken for. Results that wait for a decision go.

        Raises :class:`SessionUnreadable` for a file that is not whole, :class:`ChangedMeanwhile`, the faults of
        writing; then all is as it was.
        """
        entry, pseudonym = self.one(session_id), Patients(self._store).one(patient_id).pseudonym
        if not entry.path.exists():
            self._store.do([changed(SESSION, session_id, patient_id=patient_id)])
            return
        path = self.new_path(patient_id, pseudonym, entry.exercise, entry.hand, entry.recorded)
        beside = [one for one in entry.path.parent.glob(f"{glob.escape(entry.path.stem)}.*") if one != entry.path]
        made = [path, *(path.with_name(f"{path.stem}{one.name.removeprefix(entry.path.stem)}") for one in beside)]
        written = path
        try:
            write_anew(entry.path, path, subject_id=pseudonym)
            for one, written in zip(beside, made[1:], strict=True):
                link_or_copy(one, written)  # a kill in between loses none
            size, stored_path = read_outline(path).size_bytes, self.stored_path(path)
            self._store.do([changed(SESSION, session_id, patient_id=patient_id, path=stored_path, size=size)])
        except BaseException as cause:
            for one in made:
                one.unlink(missing_ok=True)
            if isinstance(cause, OSError):
                raise write_fault(written, cause) from cause
            raise
        for one in (entry.path, *beside, *trials_of(self._store, [session_id])):
            with suppress(OSError):  # open elsewhere: it is nobody's, and goes with the patient
                one.unlink()

    def rename_exercise(self, session_id: str, exercise: str) -> None:
        """List a session as another exercise; the file keeps what was chosen then."""
        self._store.do([changed(SESSION, session_id, exercise=exercise)])

    def archive(self, session_id: str, now: datetime | None = None) -> None:
        """Take a recording with all its results out of every list and count."""
        self._mark(session_id, archived=(now or datetime.now(UTC)).isoformat(timespec="seconds"))

    def bring_back(self, session_id: str) -> None:
        self._mark(session_id, archived="")

    def _mark(self, session_id: str, **values: Any) -> None:
        self._store.do([changed(SESSION, one.session_id, **values) for one in self.results_of(session_id)])

    def archived(self) -> list[tuple[SessionEntry, str, datetime]]:
        """Of each archived recording the first result, whose it is and since when."""
        query = select(SESSION).where(SESSION.c.archived != "", SESSION.c.erasing == 0).order_by(SESSION.c.created_s)
        found: dict[str, Row[Any]] = {}
        for row in self._store.rows(query):
            found.setdefault(row.recording_id, row)
        return [(self._entry(row), row.patient_id or "", moment(row.archived, row.created_s)) for row in found.values()]

    def stored_path(self, path: Path) -> str:
        """Relative to the sessions' folder, so that the data folder can be moved as a whole.

        Raises :class:`SessionUnreadable` for a file that lies elsewhere.
        """
        for one, folder in ((path, self.folder), (path.resolve(), self._resolved)):
            if one.is_relative_to(folder):
                return one.relative_to(folder).as_posix()
        raise SessionUnreadable(path, phrase("not in the folder of the sessions"))

    def _entry(self, row: Row[Any]) -> SessionEntry:
        return SessionEntry(
            row.id, self.folder / row.path, moment(row.recorded, row.recorded_s), moment(row.created, row.created_s),
            row.recording_id, row.exercise, row.hand, row.frames, row.duration_s,
            bool(row.simulated), row.by,
        )  # fmt: skip


def free_path(folder: Path, pseudonym: str, exercise: str, hand: Side, when: datetime) -> Path:
    """A name in a folder that no session has yet."""
    stem = f"{file_name(pseudonym) or 'patient'}_{when:%Y-%m-%d_%H%M%S}_{file_name(exercise) or 'session'}_{hand}"
    return free_name(folder / f"{stem}.h5")


def trials_of(store: Store, session_ids: Collection[str]) -> Iterator[Path]:
    """New results of these sessions that nobody has decided about. One that is damaged, or not finished, is known by
    its name, which is that of its session's file, where no other session's is like it."""
    named = {row.id: Path(row.path).stem for row in store.rows(select(SESSION.c.id, SESSION.c.path))}
    mine, others = (
        {stem for one, stem in named.items() if (one in session_ids) is is_mine} for is_mine in (True, False)
    )
    folder = store.folder / TRIALS_FOLDER
    for path in folder.glob("*.h5*") if not folder.is_symlink() else ():
        try:
            header = read_outline(path).header
        except SessionUnreadable:
            stem = re.split(r"\.h5\b", path.name)[0]
            stems = {stem, re.sub(r"-\d+$", "", stem)}
            if stems & mine and not stems & others:
                yield path
        else:
            if header.origin in session_ids or header.session_id in session_ids:
                yield path


class FilesOfSessions:
    """Brings the list up to date with the files that are there, or makes it anew: all but names, notes and what people
    wrote comes of the files."""

    def __init__(self, store: Store) -> None:
        self._store, self._list = store, ListedSessions(store)
        self._folder = store.sessions_folder

    def take_in(self, *, tells: bool = True) -> Rebuilt:
        """Read what was copied in or changed since the last look; a session whose file is gone stays in the list.

        A pseudonym without a patient becomes one; a file without a pseudonym is listed without a patient. What cannot
        be read is remembered as told, unless nobody ``tells`` of it.
        """
        before, (there, nameless) = remembered(self._store), self._there()
        known = {row.path: row for row in self._store.rows(select(SESSION))}
        now_seen: dict[str, SeenFile] = {}
        found: list[tuple[str, SessionOutline]] = []
        faults: list[CarpusFault] = []
        for path, look in there.items():
            old = before.get(path)
            if old and old.is_still(look) and (old.reason[: len(COPY)] != COPY if old.reason else path in known):
                continue
            now_seen[path] = look
            try:
                if look.reason:
                    raise SessionUnreadable(self._folder / path, look.reason)
                found.append((path, read_outline(self._folder / path)))
            except SessionUnreadable as fault:
                faults.append(fault)
                if tells:
                    now_seen[path] = SeenFile(look.size, look.changed_ns, fault.detail or "cannot be read")
                else:
                    del now_seen[path]
        if now_seen:  # of what has no name that can be kept nobody knows whether it was told
            faults += [SessionUnreadable(ascii(Path(one).name), phrase("a name that is no text")) for one in nameless]
        gone = [path for path in before if path not in there and not self._is_part(path)]
        taken = self._enter(found, known, there.keys(), now_seen)
        remember(self._store, now_seen, gone)
        return Rebuilt(taken, tuple(faults))

    def _enter(
        self,
        found: list[tuple[str, SessionOutline]],
        known: dict[str, Row[Any]],
        there: Iterable[str],
        now_seen: dict[str, SeenFile],
    ) -> int:
        """Put what was read into the list; how many sessions changed it. A further copy of a session counts once: the
        one that is known, of new ones the longest, then the first by name."""
        there, rows = set(there), {row.id: row for row in known.values()}
        holds = {path: outline.header.session_id for path, outline in found}
        other = {row.id for path, row in known.items() if holds.get(path, row.id) != row.id}
        place = {row.id: path for path, row in known.items() if path in there and row.id not in other}
        rows_of_people = self._store.rows(select(PATIENT.c.id, PATIENT.c.folded, PATIENT.c.former))
        people = {str(row.folded): str(row.id) for row in rows_of_people}
        former = {str(row.id): {folded(one) for one in row.former.split("\n")} for row in rows_of_people}
        gone = {str(row[0]) for row in self._store.rows(changes.ERASED)} if found else set()
        change: list[changes.RowChange] = []
        taken = 0
        for path, outline in sorted(found, key=lambda one: (one[0] not in known, -one[1].frames, one[0])):
            session_id = outline.header.session_id
            if place.get(session_id, path) != path:
                now_seen[path] = SeenFile(now_seen[path].size, now_seen[path].changed_ns, f"{COPY}{place[session_id]}")
                continue
            place[session_id], subject = path, outline.header.subject_id.strip()
            of_practice = subject == PRACTICE or path.startswith(f"{PRACTICE}/")
            owner = PRACTICE if of_practice else people.get(folded(subject))
            before, folder = rows.get(session_id), path.split("/")[0]
            if owner is None and subject and folded(subject) in former.get(folder, ()):
                owner = folder
            if before is None and owner is None and changes.fingerprint(folder) in gone:
                del now_seen[path]  # of who was erased: it is deleted at the next start
                continue
            if owner is None and subject and (before is None or before.patient_id is None):
                # The folder has the identity that was given while the server was away.
                given = folder if changes.is_identity(folder) and folder not in former else new_id()
                owner = people.setdefault(folded(subject), given)
                former[owner] = set()
                hands = {one.header.hand for _, one in found if folded(one.header.subject_id) == folded(subject)}
                side: AffectedSide = "both" if len(hands) == 2 else outline.header.hand
                change.append(new(PATIENT, owner, **columns(Patient(subject, side)), added_s=0.0))
            values = _columns(path, owner, outline)
            if before is not None:  # what a person said of it stays
                values |= {"patient_id": before.patient_id or owner, "exercise": before.exercise}
            if before is None or any(getattr(before, name) != value for name, value in values.items()):
                change.append(kept(SESSION, session_id, **values))
                taken += 1
        # Files that a person exchanged or put in another's place: the names are free before others take them.
        change = [changed(SESSION, one, path=f"{NOWHERE}{one}") for one in sorted(other)] + change
        for start in range(0, len(change), AT_ONCE):
            self._store.do(change[start : start + AT_ONCE])
        return taken

    def _there(self) -> tuple[dict[str, SeenFile], list[str]]:
        """Files named like sessions, but for those that are being erased; and those whose names cannot be kept."""
        going = {str(row[0]) for row in self._store.rows(select(SESSION.c.path).where(SESSION.c.erasing == 1))}
        found = {path.relative_to(self._folder).as_posix(): look for path, look in files_there(self._folder).items()}
        there = {path: look for path, look in found.items() if path not in going and can_be_stored(path)}
        return there, [path for path in found if not can_be_stored(path)]

    def first_told(self, faults: Iterable[CarpusFault]) -> list[CarpusFault]:
        """Of faults with files of this folder those that are new, or whose file has changed; remembers them."""
        fresh: list[CarpusFault] = []
        before = remembered(self._store)
        for fault in faults:
            try:
                state = Path(fault.subject).lstat()
                path = self._list.stored_path(Path(fault.subject))
            except (OSError, ValueError, SessionUnreadable):
                fresh.append(fault)
                continue
            look = SeenFile(state.st_size, state.st_mtime_ns, fault.detail or "cannot be read")
            known = before.get(path)
            if known is None or not known.is_still(look):
                fresh.append(fault)
                if can_be_stored(path):
                    remember(self._store, {path: look})
        return fresh

    def given_up(self) -> set[Path]:
        """Part files that could not be finished and have not changed since."""
        found = set()
        for name, look in remembered(self._store).items():
            path = self._folder / name
            if path.suffix == ".part" and path.is_file():
                state = path.stat()
                if look.is_still(SeenFile(state.st_size, state.st_mtime_ns)):
                    found.add(path)
        return found

    def copies_of(self, path: str) -> list[Path]:
        """Files that were set apart as copies of a session's."""
        return [self._folder / name for name, one in remembered(self._store).items() if one.reason == f"{COPY}{path}"]

    def _is_part(self, path: str) -> bool:
        """Whether a path is of a part file that is still there and could not be finished."""
        return path.endswith(".part") and (self._folder / path).exists()


def _columns(path: str, patient_id: str | None, outline: SessionOutline) -> dict[str, Any]:
    header = outline.header
    created = datetime.fromisoformat(header.created)
    return {
        "patient_id": patient_id or None, "path": path, "recording_id": header.recording_id,
        "recorded": header.when.isoformat(), "recorded_s": header.when.timestamp(), "created": header.created,
        "created_s": created.timestamp(), "exercise": header.exercise, "hand": header.hand, "frames": outline.frames,
        "duration_s": outline.duration_s, "complete": 1, "simulated": int(header.simulated),
        "size": outline.size_bytes,
    }  # fmt: skip


def file_name(text: str) -> str:
    """A text as it stands in names of files."""
    return re.sub(r"\W+", "-", text)[:MOST_LETTERS].strip("-")

"""A session, or a patient, deleted with everything: rows are marked, then files go, then the rows.

An erasure that is cut short is finished when the store is opened next. Only files in the folder of the sessions, and
what Carpus keeps beside it, are touched: by relative paths without links; where a link leads elsewhere, nothing is
begun. Reports and exports that were saved elsewhere are named, and so are back-ups, which stay. What is deleted is
overwritten in the store; what the disk itself keeps of deleted files only its encryption protects.
"""

from __future__ import annotations

import contextlib
import glob
import mmap
import re
import struct
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from sqlalchemy import delete, select

from carpus.core.errors import ChangedMeanwhile, ErasureLeadsOut, ErasureUnfinished, FolderMissing
from carpus.core.names import folded
from carpus.core.records.changes import PRACTICE, RowChange, changed, dropped, is_identity
from carpus.core.records.database import STORE_FILE
from carpus.core.records.log import Kind, Log
from carpus.core.records.of_clinic import PLACE
from carpus.core.records.of_sessions import MadeFile, made_from
from carpus.core.records.patients import Patients
from carpus.core.records.schema import DIAGNOSIS, OWN, PATIENT, RECIPIENT, SEEN, SESSION, SHARED
from carpus.core.records.session_list import (
    TRIALS_FOLDER,
    FilesOfSessions,
    ListedSessions,
    file_name,
    look_for_share,
    named_after,
    trials_of,
)
from carpus.core.records.store import Store
from carpus.core.records.values import SessionEntry
from carpus.core.session.disk import below


@dataclass(frozen=True, slots=True)
class ErasurePlan:
    """What would go. ``sessions`` counts recordings; ``files`` lie in the data folder; ``made`` are files that Carpus
    made elsewhere and does not touch; ``unsure`` are damaged files that stay, where only a word speaks of the patient;
    ``others`` counts the patient's recordings that stay."""

    kind: Kind
    identity: str
    patient_id: str
    pseudonym: str
    results: tuple[SessionEntry, ...]
    sessions: int
    files: tuple[Path, ...]
    size_bytes: int
    made: tuple[MadeFile, ...]
    unsure: tuple[Path, ...]
    others: int = 0


def plan_session(store: Store, session_id: str) -> ErasurePlan:
    """One recording with all its results, also those copied in since the last look. Raises KeyError for a session that
    is not in the store, :class:`ErasureLeadsOut`, :class:`FolderMissing` for a share that is away."""
    FilesOfSessions(store).take_in(tells=False)
    sessions = ListedSessions(store)
    results, patient_id = sessions.results_of(session_id), sessions.owner(session_id)
    mine = {one.recording_id for one in sessions.of_patient(patient_id, archived=True)} if patient_id else set()
    return _plan(store, "session", session_id, patient_id, results, len(mine - {results[0].recording_id}))


def plan_patient(store: Store, patient_id: str) -> ErasurePlan:
    """A patient with all sessions, also those copied in since the last look. Raises KeyError for one that is not in the
    store, :class:`ErasureLeadsOut`, :class:`FolderMissing`."""
    FilesOfSessions(store).take_in(tells=False)
    Patients(store).one(patient_id)
    results = ListedSessions(store).of_patient(patient_id, archived=True)
    return _plan(store, "patient", patient_id, patient_id, results, 0)


def _plan(
    store: Store, kind: Kind, identity: str, patient_id: str, results: Sequence[SessionEntry], others: int
) -> ErasurePlan:
    going, sessions = [patient_id] if kind == "patient" else [], [one.session_id for one in results]
    if results:
        look_for_share(store)
    links = _links(store, going, sessions)
    if links:
        raise ErasureLeadsOut(links[0])
    found, unsure = _files(store, going, sessions)
    files = sorted(found)
    return ErasurePlan(
        kind, identity, patient_id, Patients(store).one(patient_id).entry.pseudonym if patient_id else "",
        tuple(results), len({one.recording_id for one in results}), tuple(files),
        sum(path.lstat().st_size for path in files), tuple(made_from(store, sessions)), tuple(sorted(unsure)), others,
    )  # fmt: skip


def erase(store: Store, plan: ErasurePlan, log: Log) -> int:
    """Do it; how many files went. What cannot be deleted now is tried again whenever the store is opened. Of a patient
    also what came since it was planned.

    Raises :class:`ErasureUnfinished` where files are left, :class:`OutputNotWritable` where it could not be logged and
    so was not begun.
    """
    log.note("erase_begun", plan.kind, plan.identity, files=len(plan.files))
    FilesOfSessions(store).take_in(tells=False)
    marked = [changed(SESSION, one.session_id, erasing=1) for one in plan.results]
    of = PATIENT if plan.kind == "patient" else SESSION
    try:
        store.do([*marked, *([changed(PATIENT, plan.patient_id, erasing=1)] if of is PATIENT else [])])
    except ChangedMeanwhile:
        if store.row(select(of.c.id).where(of.c.id == plan.identity)):
            raise  # else another program has erased it meanwhile, which is what was asked for
    left = go_on(store)
    if left:
        log.note("erase_begun", plan.kind, plan.identity, left=len(left))
        raise ErasureUnfinished(left[0].name, f"{len(left)}")
    log.note("erased", plan.kind, plan.identity, files=len(plan.files))
    return len(plan.files)


def finish_erasing(store: Store, log: Log) -> frozenset[str]:
    """What an erasure that was cut short has left; called when the store is opened. Of patients who are gone by it, the
    pseudonyms, folded."""
    people = frozenset(str(row[0]) for row in store.rows(select(PATIENT.c.folded).where(PATIENT.c.erasing == 1)))
    left: list[Path] = []
    if people or store.row(select(SESSION.c.id).where(SESSION.c.erasing == 1)):
        left = go_on(store)
        log.note("erase_begun" if left else "erased", "everything", late=1, left=len(left))
    store.leave_no_trace()  # of a program that was killed before it did so
    return frozenset() if left else people


def go_on(store: Store, gone_there: Collection[str] | None = None) -> list[Path]:
    """Delete the files of what is marked, then its rows; files that could not be deleted. Of what is ``gone_there``, on
    the server, nothing is sent to it, and nothing else goes."""
    people = [
        row
        for row in store.rows(select(PATIENT).where(PATIENT.c.erasing == 1))
        if gone_there is None or row.id in gone_there
    ]
    patients = [str(row.id) for row in people]
    mine = (SESSION.c.erasing == 1) | SESSION.c.patient_id.in_(patients)
    rows = [
        row
        for row in store.rows(select(SESSION.c.id, SESSION.c.path, SESSION.c.patient_id).where(mine))
        if gone_there is None or row.id in gone_there or row.patient_id in patients
    ]
    if not people and not rows:
        return []
    sessions = [str(row.id) for row in rows]
    if rows and _is_away(store):
        return [store.sessions_folder]
    files, _ = _files(store, patients, sessions)
    left = [*_links(store, patients, sessions), *(path for path in sorted(files) if not _gone(path))]
    if rows and _is_away(store):  # since then: nobody knows what was found and is gone
        return [store.sessions_folder]
    emptied = {folder for path in files for folder in path.parents} | set(_folders(store, patients))
    for folder in sorted(emptied, reverse=True):
        if folder.is_relative_to(store.sessions_folder) and folder != store.sessions_folder:
            with contextlib.suppress(OSError):  # another patient's session is in it
                folder.rmdir()
    if left:
        return left
    said = (one for row in people for one in (row.folded, row.name, *row.former.split("\n")))
    names = [folded(one) for one in said if one]
    # What is of this computer alone goes first: as long as the rows are marked, a kill in between is made good.
    root = store.sessions_folder
    paths = [path.relative_to(root).as_posix() for path in files if path.is_relative_to(root)]
    places = store.rows(select(OWN).where(OWN.c.name.startswith(PLACE)))
    store.own(
        *(
            delete(OWN).where(OWN.c.name == row.name)
            for row in places
            if any(one in folded(row.value) for one in names)
        ),
        *(delete(SEEN).where(SEEN.c.path == path) for path in [*paths, *(str(row.path) for row in rows)]),
        *(delete(SEEN).where(SEEN.c.reason.endswith(str(row.path), autoescape=True)) for row in rows),
    )
    naming = _naming(store, names)
    store.forget_waiting([*patients, *sessions, *(row.id for row in naming)])
    change = [*(dropped(SESSION, one) for one in sessions), *(dropped(PATIENT, one) for one in patients), *naming]
    if gone_there is None:
        store.do(change)
    else:
        store.own(*(delete(SHARED[one.table]).where(SHARED[one.table].c.id == one.id) for one in change))
    return [] if store.leave_no_trace() else [store.folder / f"{STORE_FILE}-wal"]


def _naming(store: Store, names: Sequence[str]) -> list[RowChange]:
    """What belongs to the clinic and has the name of one of these as a word: an address of letters, a diagnosis of the
    clinic's list. A number names nobody there: it is a street's, or a zone's."""
    named = [name for name in names if any(map(str.isalpha, name))]
    if not named:
        return []
    addresses, listed = store.rows(select(RECIPIENT)), store.rows(select(DIAGNOSIS))
    word = _words(named, ())
    return [
        *(dropped(RECIPIENT, row.id) for row in addresses if word.search(folded(row.address))),
        *(dropped(DIAGNOSIS, row.id) for row in listed if word.search(folded(row.words))),
    ]


def _files(store: Store, patients: Sequence[str], sessions: Sequence[str]) -> tuple[set[Path], set[Path]]:
    """Every file of these: the sessions' own with what lies beside them and copies, all that is left in the folders of
    the patients, what is no session and names them, new results that wait for a decision, and damaged stores that were
    set aside, which may hold names. And those that may be theirs and stay: nobody can tell."""
    paths, going, root = dict[str, str](), set(sessions), store.sessions_folder
    for row in store.rows(select(SESSION.c.id, SESSION.c.path)):
        paths[row.id] = row.path
    others = {f"{root / path}".removesuffix(".h5") for session_id, path in paths.items() if session_id not in going}
    mine, files = [paths[session_id] for session_id in paths.keys() & going], FilesOfSessions(store)
    own = {path for stored in mine if (path := _inside(root, stored)) is not None and path.exists()}
    found = own | {path for stored in mine for path in _beside(store, stored)}
    found |= {path for stored in mine for path in files.copies_of(stored) if path.is_file()}
    for folder in _folders(store, patients):
        found |= set(_plain_files(folder))
    waits, unsure = set(trials_of(store, paths.keys() - going)), set[Path]()
    for names in _names_of(store, patients):
        for folder in (root, store.folder / TRIALS_FOLDER):
            orphans = (path for path in _plain_files(folder) if path not in waits and not _is_beside(path, others))
            judged = {one: names.name(one, folder) for one in orphans}
            found |= {one for one, is_named in judged.items() if is_named}
            unsure |= {one for one, is_named in judged.items() if is_named is None}
    found |= set(trials_of(store, going))
    stem, suffix = STORE_FILE.split(".")
    found |= set(store.folder.glob(f"{stem}.damaged-*.{suffix}*"))
    found = own | {path for path in found if not _is_beside(path, others)}
    return found, unsure - found


@dataclass(frozen=True, slots=True)
class _Names:
    """How files name one patient: ``stems`` as Carpus names them, as words in a path and in what a file says, which the
    group ``own`` finds outside of longer names, and as whose a session says it is. ``others`` are the stems of other
    patients."""

    stems: Collection[str]
    others: Collection[str]
    in_path: re.Pattern[str]
    in_file: re.Pattern[bytes]
    subject: re.Pattern[bytes]

    def name(self, path: Path, folder: Path) -> bool | None:
        """Whether a file in ``folder`` is this patient's; None where only a word in a damaged one says so. One that
        Carpus named is whose name it has, whatever else stands there: a pseudonym may be a word of an exercise, or a
        number of a day."""
        whose, way = named_after(path), path.relative_to(folder)
        if whose in self.others and whose not in self.stems:
            return False
        if whose in self.stems and whose not in self.others:
            return True
        searched = "/".join(one for one in (way.parent if whose else way).parts if not is_identity(one))
        return any(one["own"] for one in self.in_path.finditer(searched)) or self._is_said_in(path)

    def _is_said_in(self, path: Path) -> bool | None:
        if path.suffix in (".h5", ".part"):
            with (
                contextlib.suppress(OSError, ValueError),
                path.open("rb") as file,
                mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content,
            ):
                whose = self.subject.search(content)
                if whose is not None:
                    return whose["own"] is not None
                return None if any(one["own"] for one in self.in_file.finditer(content)) else False
        return False


def _names_of(store: Store, patients: Sequence[str]) -> Iterator[_Names]:
    """Of each patient the pseudonyms, and a name of several words, where that could be nobody else's."""
    names = {
        row.id: {row.pseudonym, *row.former.split("\n"), row.name if " " in row.name else ""} - {""}
        for row in (store.rows(select(PATIENT)) if patients else ())
    }
    equal = Counter(one for own in names.values() for one in own)
    for patient in (one for one in patients if one != PRACTICE):
        own = {one for one in names[patient] if equal[one] == 1}
        foreign = {one for other, theirs in names.items() if other != patient for one in theirs}
        stems, others = ({file_name(one) for one in them} - {""} for them in (own, foreign))
        written = {name for name in own if file_name(name) not in others} | (stems - others)
        yield _Names(stems, others, _words(written, foreign | others), _in_bytes(own, foreign), _subject(own, foreign))


def _words(own: Collection[str], others: Collection[str]) -> re.Pattern[str]:
    return re.compile(_found(own, others, r"(?<![^\W_])", r"(?![^\W_])"))


def _in_bytes(own: Collection[str], others: Collection[str]) -> re.Pattern[bytes]:
    a, z = r"(?<![\w\x80-\xff])", r"(?![\w\x80-\xff])"
    mine, theirs = ({one.encode().decode("latin-1") for one in them} for them in (own, others))
    return re.compile(_found(mine, theirs, a, z).encode("latin-1"))


def _subject(own: Collection[str], others: Collection[str]) -> re.Pattern[bytes]:
    """Finds them as ``subject_id`` in what HDF5 keeps of a session's texts, each with its length and filled up to 8
    bytes: after the recording's identity, before a moment. Those of this patient are the group ``own``."""

    def texts(names: Collection[str]) -> bytes:
        stored = (struct.pack("<Q", len(one)) + one + bytes(-len(one) % 8) for one in map(str.encode, names))
        return b"|".join(map(re.escape, stored)) or rb"(?!)"

    either = rb"(?:(?P<own>" + texts(own) + rb")|" + texts(others) + rb")"
    return re.compile(rb"[0-9a-f]{12}\0{4}.{8}" + either + rb".{16}\d{4}-\d\d-\d\dT", re.DOTALL)


def _found(own: Collection[str], others: Collection[str], before: str, after: str) -> str:
    """A pattern of the names as words, the group ``own``; longer ones of others first, which hold one of them."""
    longer = [one for one in others if any(name in one and name != one for name in own)]
    theirs, mine = ("|".join(re.escape(one) for one in sorted(them, key=len, reverse=True)) for them in (longer, own))
    return rf"{before}(?:{theirs or '(?!)'}|(?P<own>{mine or '(?!)'})){after}"


def _beside(store: Store, stored: str) -> set[Path]:
    """A session's file and all that lies beside it under its name; nothing for a path that leads elsewhere."""
    path = _inside(store.sessions_folder, stored)
    return set() if path is None else {
        one
        for hidden in ("", ".")
        for one in path.parent.glob(f"{hidden}{glob.escape(path.stem)}.*")
        if one.is_file() or one.is_symlink()
    }  # fmt: skip


def _is_beside(path: Path, stems: Collection[str]) -> bool:
    """Whether a file lies beside one of these under its name."""
    parts = path.name.split(".")
    return any(str(path.with_name(".".join(parts[:end]))) in stems for end in range(2 - bool(parts[0]), len(parts)))


def _is_away(store: Store) -> bool:
    """Whether the clinic's share is not there: the files would come back with it."""
    try:
        look_for_share(store)
    except FolderMissing:
        return True
    return False


def _links(store: Store, patients: Sequence[str], sessions: Sequence[str]) -> list[Path]:
    """Links on the way to what is to go: nobody knows what else lies behind them."""
    root = store.sessions_folder
    ways = {folder / "_" for folder in _folders(store, patients)}
    for row in store.rows(select(SESSION.c.path).where(SESSION.c.id.in_(sessions))):
        ways |= {root / row.path} if ".." not in Path(row.path).parts else set()
    on_way = {one for way in ways for one in (way, *way.parents) if one != root and one.is_relative_to(root)}
    return sorted(one for one in on_way if one.is_symlink())


def _folders(store: Store, patients: Sequence[str]) -> list[Path]:
    """Of these patients; an identity that this program did not give names none, for it could lead anywhere."""
    return [store.sessions_folder / one for one in patients if is_identity(one)]


def _inside(folder: Path, stored: str) -> Path | None:
    """The path below a folder, None where it would lead out of it, by its name or by a link on its way."""
    path = folder / stored
    parts = Path(stored).parts
    if not parts or Path(stored).is_absolute() or ".." in parts:
        return None
    return None if any(one.is_symlink() for one in [*path.parents][: len(parts) - 1]) else path


def _plain_files(folder: Path) -> Iterator[Path]:
    if not folder.is_symlink():
        yield from (path for path in below(folder) if path.is_symlink() or path.is_file())


def _gone(path: Path) -> bool:
    try:
        path.unlink(missing_ok=True)
    except OSError:
        return False
    return True

"""The data folder: the store of what people type, the session files, and what lies beside them."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from carpus.core.agreement.limits_file import read_limits
from carpus.core.capture.files.pictures import decode_color, read_color
from carpus.core.capture.files.raw import SUFFIX as RAW_SUFFIX
from carpus.core.capture.files.raw import RawRecording
from carpus.core.errors import CarpusFault, ServerGone, SessionUnreadable
from carpus.core.formats.formats import Wanted, export_sessions
from carpus.core.formats.new_output import FOR_PROGRAMS, TableForm
from carpus.core.hand.exercises import exercise_named
from carpus.core.measures.by_hand import HandValue
from carpus.core.measures.change import DEFAULT_LIMITS
from carpus.core.phrase import phrase
from carpus.core.records import of_sessions, patients
from carpus.core.records.erasure import finish_erasing
from carpus.core.records.log import By, Log, Notes
from carpus.core.records.of_sessions import MOST_CHARACTERS, MadeKind
from carpus.core.records.patients import Patients
from carpus.core.records.session_list import ListedSessions
from carpus.core.records.set_up import MARKERS_SUFFIX, PRACTICE_PATIENT, SetUp
from carpus.core.records.store import Store, reading
from carpus.core.records.values import SessionEntry, entry_of, newest_results
from carpus.core.results.figures import SessionFigures, session_figures
from carpus.core.results.ranges import in_order
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.session.reader import has_raw, read_outline, read_raw_color, read_session
from carpus.core.session.values import AngleOrder, Session
from carpus.core.types import ByteImage, Side

KEPT_PICTURES = 2
"""Files of pictures that stay open: two sessions are looked at beside each other."""


class ShownPictures:
    """Pictures of the sessions looked at last. May be used from several threads."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._open: list[KeptPictures] = []

    def picture(self, paths: Sequence[Path], row: int) -> ByteImage | None:
        """The colour picture of a row of the first of these results of one recording that has pictures."""
        with_pictures = (path for path in paths if path.with_suffix(RAW_SUFFIX).exists() or has_raw(path))
        path = next(with_pictures, paths[0])
        with self._lock:
            kept = next((one for one in self._open if one.path == path), None)
            if kept is None:
                kept = KeptPictures(path)
                self._open = [kept, *self._open][:KEPT_PICTURES]
            return kept.color(row)

    def forget(self) -> None:
        """Let go of the files whose pictures were shown last."""
        with self._lock:
            self._open = []


class KeptPictures:
    """Pictures kept in a session file, or in a raw recording beside it."""

    def __init__(self, path: Path) -> None:
        self.path = path
        raw = path.with_suffix(RAW_SUFFIX)
        self._beside = RawRecording(raw) if raw.exists() else None
        self._inside = self._beside is None and has_raw(path)
        self._times_s = read_session(path).timestamp_s if self._beside is not None else np.empty(0)

    def color(self, row: int) -> ByteImage | None:
        """The colour picture of a row, None when it was not kept."""
        if self._beside is not None:
            return self._beside.color_at(float(self._times_s[row]))
        data = read_raw_color(self.path, row) if self._inside else b""
        return decode_color(data) if data else None


@dataclass(frozen=True, slots=True)
class LookedAt:
    """A session file that was handed over; ``patient_id`` is empty where nobody here has it."""

    patient_id: str
    session_id: str
    subject_id: str
    side: Side


class Library:
    """Everything that is stored. May be used from several threads.

    What is done with patients' sessions stands in the log with the initials of ``who`` does it; where it cannot be
    written, ``log_fault`` is told. The practice patient is nobody, and in no log.
    """

    def __init__(
        self,
        folder: Path,
        *,
        by: By = "window",
        url: str = "",
        sessions: Path | None = None,
        only_reads: bool = False,
    ) -> None:
        """``only_reads``: also of a folder that cannot be written."""
        self.folder = folder
        self.who: Callable[[], str] = lambda: ""
        self.told: list[CarpusFault] = []
        self.log_fault: Callable[[CarpusFault], None] = lambda fault: self.told.append(fault)
        self.error_limits = DEFAULT_LIMITS
        """The clinic's own from its test and retest, as far as it has any."""
        try:
            self.error_limits = read_limits(folder)
        except CarpusFault as fault:
            self.told.append(fault)
        self.store = (reading if only_reads else Store)(folder, sessions, url, lambda fault: self.log_fault(fault))
        self.log = Log(self.store, by, lambda: self.who())
        self.patients, self.index = Patients(self.store), ListedSessions(self.store)
        self.notes = Notes(self.log, self.index.owner, lambda fault: self.log_fault(fault))
        self.patients.noted = self.notes.patient
        self.pictures = ShownPictures()
        self.elsewhere: dict[str, SessionEntry] = {}
        """Sessions that are in no list, remembered until the program ends: files that were handed over, and those of a
        data folder that went away, which are brought home at the next start."""
        self._figures: dict[Path, tuple[RepetitionChoices, SessionFigures]] = {}
        self._shown: dict[str, int] = {}
        self._names: Sequence[str] = ()
        self.angle_order: Callable[[], AngleOrder] = lambda: "zyx"
        """In which order the wrist's angles are read in the window; files keep the papers'."""
        self.gone = frozenset[str]()
        """Pseudonyms of patients whose erasing was cut short before and is finished now, as they are compared."""
        with suppress(ServerGone):  # told by who asks for something
            self.finish_erasing()

    def finish_erasing(self) -> None:
        """When the store is there: what an erasure that was cut short has left goes."""
        self.gone = finish_erasing(self.store, self.log)

    def close(self) -> None:
        """May be called twice."""
        self.store.close()

    def pseudonyms(self) -> Sequence[str]:
        """Every pseudonym and name there is, for what must not hold them."""
        with suppress(CarpusFault):  # those known last, while the store cannot be read
            self._names = [
                text
                for one in self.patients.listed(archived=True)
                for text in (one.pseudonym, one.pseudonym.replace(" ", "-"), one.name)
                if text
            ]
        return self._names

    # --- sessions -----------------------------------------------------------------------------------------
    def sessions(self, patient_id: str) -> Sequence[SessionEntry]:
        """A patient's sessions, newest first: of a recording that was tracked more than once the newest result."""
        return newest_results(self.index.of_patient(patient_id))

    def by_hand(self, patient_id: str) -> Sequence[HandValue]:
        """Everything that was ever measured by hand of a patient, in the order in which it was entered."""
        return patients.by_hand(self.store, patient_id)

    def enter_by_hand(self, patient_id: str, values: Sequence[HandValue]) -> None:
        """Keep what was measured by hand; what was entered before for the same stays readable."""
        patients.enter_by_hand(self.store, patient_id, values)
        self.notes.patient("entered_by_hand", patient_id, values=len(values))

    def sessions_alike(self, patient_id: str, set_up: SetUp) -> Sequence[SessionEntry]:
        """Those with the discs of a set-up on the same hand, newest first."""
        own = (set_up.side, set_up.exercise.protocol)
        entries = self.sessions(patient_id)
        return [entry for entry in entries if (entry.hand, exercise_named(entry.exercise).protocol) == own]

    def entry(self, session_id: str) -> SessionEntry:
        """One session by its identity. Raises :class:`SessionUnreadable` for one that is not there."""
        if session_id in self.elsewhere:
            return self.elsewhere[session_id]
        with suppress(KeyError):
            return self.index.one(session_id)
        raise SessionUnreadable(session_id, phrase("not in the list of patients"))

    def is_listed(self, session_id: str) -> bool:
        with suppress(KeyError):
            return bool(self.index.one(session_id))
        return False

    def owner(self, session_id: str) -> str:
        """Whose session it is; empty for nobody's."""
        if session_id in self.elsewhere:
            return ""
        with suppress(KeyError):
            return self.index.owner(session_id)
        return ""

    def look_at(self, path: Path) -> LookedAt:
        """A session by its file, wherever that lies. One that no list knows belongs to nobody, and is remembered until
        the program ends; its file stays where it is. Raises what reading the file raises."""
        outline = read_outline(path)
        header = outline.header
        with suppress(KeyError):
            return LookedAt(self.index.owner(header.session_id), header.session_id, header.subject_id, header.hand)
        self.elsewhere[header.session_id] = entry_of(path, outline)
        return LookedAt("", header.session_id, header.subject_id, header.hand)

    # --- what is read of a session ------------------------------------------------------------------------
    def session(self, session_id: str) -> Session:
        """A whole session, of the exercise that it is in the list with, its angles in the order that is chosen."""
        return in_order(self._stored(session_id), self.angle_order())

    def _stored(self, session_id: str) -> Session:
        entry = self.entry(session_id)
        return as_listed(read_session(entry.path), entry)

    def forget_figures(self, session_id: str) -> None:
        """What was worked out of a session is worked out anew."""
        self._figures = {path: known for path, known in self._figures.items() if known[1].session_id != session_id}

    def picture(self, session_id: str, row: int) -> ByteImage | None:
        """The colour picture of a row where pictures were kept, in the session or beside it, or beside another result
        of the same recording."""
        paths = self.entry(session_id).path, *(one.path for one in self.results_of(session_id))
        return self.pictures.picture(paths, row)

    def results_of(self, session_id: str) -> Sequence[SessionEntry]:
        """Every result of the recording of a session, the first one first."""
        if session_id in self.elsewhere:
            return [self.elsewhere[session_id]]
        with suppress(KeyError):
            return self.index.results_of(session_id)
        raise SessionUnreadable(session_id, phrase("not in the list of patients"))

    def choices(self, session_id: str) -> RepetitionChoices:
        if session_id in self.elsewhere:
            return RepetitionChoices()
        found, self._shown[session_id] = of_sessions.choices(self.store, session_id)
        return found

    def keep_choices(self, session_id: str, choices: RepetitionChoices) -> None:
        """Store it in place of what was read last. Raises :class:`ChangedMeanwhile` where that is not what holds."""
        before, version = of_sessions.choices(self.store, session_id)
        self._shown[session_id] = of_sessions.keep_choices(
            self.store, session_id, choices, self._shown.get(session_id, version)
        )
        if before.not_counted == choices.not_counted:
            self.notes.session("changed", session_id)
        else:
            self.notes.session("set_aside" if choices.not_counted else "taken_back", session_id)

    def comment(self, session_id: str) -> str:
        """What holds of it; empty where nothing was written."""
        if session_id in self.elsewhere:
            return ""
        return of_sessions.latest(of_sessions.comments(self.store, session_id))

    def keep_comment(self, session_id: str, text: str) -> None:
        """Add a comment, which holds from now on; what was written before stays readable."""
        text = text.strip()[:MOST_CHARACTERS]
        if text != self.comment(session_id):
            of_sessions.add_comment(self.store, session_id, text, self.who())
            self.notes.session("changed", session_id)

    def figures(self, entry: SessionEntry) -> SessionFigures:
        """Figures of a session with its choices, computed once."""
        choices, order = of_sessions.choices(self.store, entry.session_id)[0], self.angle_order()
        known = self._figures.get(entry.path)
        if known is None or known[0] != choices or known[1].angle_order != order:
            session = in_order(as_listed(read_session(entry.path), entry), order)
            known = (choices, session_figures(session, choices, self.error_limits))
            self._figures[entry.path] = known
        return known[1]

    def figures_of(self, session_id: str) -> SessionFigures:
        """As :meth:`figures`, by the session's identity."""
        return self.figures(self.entry(session_id))

    def limits_changed(self) -> None:
        """The clinic has measured its own error limits: from now on everything is judged by them."""
        self.error_limits = read_limits(self.folder)
        self._figures = {}
        self.notes.program("changed", limits=len(self.error_limits.studies))

    def history(self, patient_id: str) -> Sequence[SessionFigures]:
        """Figures of all sessions of a patient that can be read."""
        out = []
        results = Counter(entry.recording_id for entry in self.index.of_patient(patient_id))
        for entry in self.sessions(patient_id):
            with suppress(SessionUnreadable):  # its file is gone or damaged; opening it alone tells
                out.append(replace(self.figures(entry), earlier_results=results[entry.recording_id] - 1))
        return out

    def export(
        self,
        session_id: str,
        folder: str,
        formats: Sequence[str] = ("csv",),
        progress: Callable[[int, int], None] | None = None,
        cancelled: Callable[[], bool] = lambda: False,
        deidentified: bool = False,
        form: TableForm = FOR_PROGRAMS,
    ) -> Sequence[str]:
        """Write a session as open formats into a folder, as it is listed and with a person's choices; the names of the
        files. Raises what kept it from being written."""
        path = self.entry(session_id).path
        by_hand = tuple(self.by_hand(self.owner(session_id)))  # of nobody's sessions there is none
        wanted = Wanted(path, lambda: (self._stored(session_id), self.choices(session_id)), by_hand)
        done = export_sessions(
            [wanted],
            Path(folder),
            formats,
            deidentified=deidentified,
            form=form,
            progress=progress,
            cancelled=cancelled,
        )
        if not deidentified:  # what nobody can be found by is not tied to anybody by the list of patients either
            self.made(done.files, "export", [session_id])
        else:
            self.notes.session("exported", session_id, files=len(done.files), deidentified=1)
        for refused in done.refused:
            raise refused.fault
        return [str(path.relative_to(folder)) for path in done.files]

    def made(self, paths: Sequence[Path], kind: MadeKind, session_ids: Iterable[str]) -> None:
        """Take down files that were made from sessions, so that they are named when one of these is erased."""
        known = [one for one in session_ids if one not in self.elsewhere]
        of_sessions.remember_made(self.store, paths, kind, known)
        for session_id in known:
            self.notes.session("reported" if kind == "report" else "exported", session_id, files=len(paths))

    def marker_picture(self, patient_id: str, set_up: SetUp | None = None) -> ByteImage | None:
        """The markers as they were stuck last time, or when last on the hand and of the protocol of a set-up."""
        for entry in self.sessions(patient_id) if set_up is None else self.sessions_alike(patient_id, set_up):
            if entry.simulated and patient_id != PRACTICE_PATIENT:
                continue  # nobody's hand
            path = entry.path.with_suffix(MARKERS_SUFFIX)
            if path.exists():
                with suppress(CarpusFault):
                    return read_color(path)
        return None


def as_listed(session: Session, entry: SessionEntry) -> Session:
    """The session with the exercise that a person said it was; its file is never changed."""
    if session.header.exercise == entry.exercise:
        return session
    return replace(session, header=replace(session.header, exercise=entry.exercise))

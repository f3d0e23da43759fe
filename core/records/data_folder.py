"""The data folder: the store of what people type, the session files and what lies beside them."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from carpus.core.capture.files.image_codec import decode_color, read_color
from carpus.core.capture.files.raw import SUFFIX as RAW_SUFFIX
from carpus.core.capture.files.raw import RawRecording
from carpus.core.formats.export import ExportRequest, export_sessions
from carpus.core.formats.output_files import MACHINE_DIALECT, TableDialect
from carpus.core.measures.change_limits import DEFAULT_LIMITS
from carpus.core.measures.manual_measurements import ManualValue
from carpus.core.model.errors import CarpusFault, ServerUnavailable, SessionUnreadable
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.types import ByteImage, FloatArray
from carpus.core.records import patients, session_records
from carpus.core.records.clinic_records import read_limits
from carpus.core.records.erasure import resume_erasures
from carpus.core.records.log import AuditLog, AuditLogWriter, AuditSource
from carpus.core.records.patients import Patients
from carpus.core.records.session_list import SessionList, to_file_name
from carpus.core.records.session_records import MAX_COMMENT_CHARACTERS, OutputKind
from carpus.core.records.session_setup import MARKERS_SUFFIX, PRACTICE_PATIENT, SessionSetup
from carpus.core.records.store import Store, open_to_read
from carpus.core.records.values import SessionEntry, entry_from_outline, select_latest_versions
from carpus.core.results.ranges import with_angle_order
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.session_results import SessionResults, compute_session_results
from carpus.core.session.reader import has_raw, read_outline, read_raw_color, read_session
from carpus.core.session.values import AngleOrder, Session, SessionHeader

MAX_OPEN_RECORDINGS = 2
"""Two sessions are shown side by side."""


class FrameCache:
    """Frames of the sessions shown last; thread-safe."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._open: dict[Path, tuple[RawRecording, FloatArray]] = {}

    def read_frame(self, paths: Sequence[Path], row: int) -> ByteImage | None:
        """Return the colour frame of a row from the first of these results that has frames, None without any.

        Frames are in a raw recording beside the session or, in older ones, in its file.
        """
        for path in paths:
            raw = path.with_suffix(RAW_SUFFIX)
            if raw.exists():
                with self._lock:
                    if path not in self._open:
                        opened = RawRecording(raw), read_session(path).timestamp_s
                        self._open = dict([(path, opened), *self._open.items()][:MAX_OPEN_RECORDINGS])
                    recording, times_s = self._open[path]
                    return recording.load_color(float(times_s[row]))
            if has_raw(path):
                data = read_raw_color(path, row)
                return decode_color(data) if data else None
        return None

    def clear(self) -> None:
        with self._lock:
            self._open = {}


class DataFolder:
    """All stored data of a folder; thread-safe.

    What is done with patients' sessions is logged with the initials from ``get_initials``; faults of the log go to
    ``on_fault``. The practice patient is in no log.
    """

    def __init__(
        self,
        folder: Path,
        *,
        source: AuditSource = "window",
        url: str = "",
        sessions_folder: Path | None = None,
        read_only: bool = False,
    ) -> None:
        """``read_only`` also opens a folder that cannot be written."""
        self.folder = folder
        self.get_initials: Callable[[], str] = lambda: ""
        self.startup_faults: list[CarpusFault] = []
        self.on_fault: Callable[[CarpusFault], None] = lambda fault: self.startup_faults.append(fault)
        self.error_limits = DEFAULT_LIMITS
        """The clinic's own limits, from its test-retest study, where it has any."""
        try:
            self.error_limits = read_limits(folder)
        except CarpusFault as fault:
            self.startup_faults.append(fault)
        self.store = (open_to_read if read_only else Store)(
            folder, sessions_folder, url, lambda fault: self.on_fault(fault)
        )
        self.log_writer = AuditLogWriter(self.store, source, lambda: self.get_initials())
        self.patients, self.session_list = Patients(self.store), SessionList(self.store)
        self.audit_log = AuditLog(self.log_writer, self.session_list.owner_id, lambda fault: self.on_fault(fault))
        self.patients.on_change = self.audit_log.log_patient
        self.frame_cache = FrameCache()
        self.unlisted: dict[str, SessionEntry] = {}
        """Sessions in no list, known until the program ends: files opened by their path, and recordings that wait on
        this computer for the session folder."""
        self._results_cache: dict[Path, tuple[RepetitionChoices, SessionResults]] = {}
        self._shown_versions: dict[str, int] = {}
        self._last_names: Sequence[str] = ()
        self.get_angle_order: Callable[[], AngleOrder] = lambda: "zyx"
        """Order of the wrist's angles in the window; files keep that of the papers."""
        self.erased_pseudonyms = frozenset[str]()
        """Folded pseudonyms of patients whose interrupted erasure was finished now."""
        with suppress(ServerUnavailable):  # told by who asks for something
            self.resume_erasures()

    def resume_erasures(self) -> None:
        self.erased_pseudonyms = resume_erasures(self.store, self.log_writer)

    def close(self) -> None:
        """Close the store; may be called twice."""
        self.store.close()

    def identifying_texts(self) -> Sequence[str]:
        """Return what names patients, for texts that must not contain it."""
        with suppress(CarpusFault):  # those known last, while the store cannot be read
            self._last_names = [
                str(text)
                for one in self.patients.search(include_archived=True)
                for text in (one.pseudonym, to_file_name(one.pseudonym), one.name, one.record_number, one.birth_day)
                if text
            ]
        return self._last_names

    # --- sessions -----------------------------------------------------------------------------------------
    def sessions(self, patient_id: str) -> Sequence[SessionEntry]:
        """Return a patient's sessions, newest first, each recording by its newest result."""
        return select_latest_versions(self.session_list.patient_sessions(patient_id))

    def manual_measurements(self, patient_id: str) -> Sequence[ManualValue]:
        """Return all manual measurements of a patient in the order of entry."""
        return patients.read_manual_measurements(self.store, patient_id)

    def add_manual_measurements(self, patient_id: str, values: Sequence[ManualValue]) -> None:
        """Store manual measurements; earlier ones stay readable."""
        patients.add_manual_measurements(self.store, patient_id, values)
        self.audit_log.log_patient("entered_by_hand", patient_id, values=len(values))

    def matching_sessions(self, patient_id: str, set_up: SessionSetup) -> Sequence[SessionEntry]:
        """Return sessions with the markers and hand of a set-up, newest first."""
        own = (set_up.side, set_up.exercise.protocol)
        entries = self.sessions(patient_id)
        return [entry for entry in entries if (entry.hand, get_exercise(entry.exercise).protocol) == own]

    def entry(self, session_id: str) -> SessionEntry:
        """Return a session by its id. Raises :class:`SessionUnreadable` if there is none."""
        return self.unlisted.get(session_id) or self.session_list.get(session_id)

    def is_listed(self, session_id: str) -> bool:
        with suppress(SessionUnreadable):
            return bool(self.session_list.get(session_id))
        return False

    def owner_id(self, session_id: str) -> str:
        """Return the patient of a session; empty for none."""
        with suppress(SessionUnreadable):
            return "" if session_id in self.unlisted else self.session_list.owner_id(session_id)
        return ""

    def open_file(self, path: Path) -> SessionHeader:
        """Open a session file anywhere; one that is not listed is known until the program ends.

        Raises what reading the file raises.
        """
        outline = read_outline(path)
        if not self.is_listed(outline.header.session_id):
            self.unlisted[outline.header.session_id] = entry_from_outline(path, outline)
        return outline.header

    # --- what is read of a session ------------------------------------------------------------------------
    def session(self, session_id: str) -> Session:
        """Return a session with its listed exercise and the chosen order of angles."""
        return with_angle_order(self._read_listed_session(session_id), self.get_angle_order())

    def _read_listed_session(self, session_id: str) -> Session:
        entry = self.entry(session_id)
        return with_listed_exercise(read_session(entry.path), entry)

    def drop_cached_results(self, session_id: str) -> None:
        self._results_cache = {
            path: known for path, known in self._results_cache.items() if known[1].session_id != session_id
        }

    def read_frame(self, session_id: str, row: int) -> ByteImage | None:
        """Return the colour frame of a row, stored with this or another result of the recording."""
        paths = self.entry(session_id).path, *(one.path for one in self.result_versions(session_id))
        return self.frame_cache.read_frame(paths, row)

    def result_versions(self, session_id: str) -> Sequence[SessionEntry]:
        """Return every result of a session's recording, oldest first."""
        if session_id in self.unlisted:
            return [self.unlisted[session_id]]
        return self.session_list.result_versions(session_id)

    def choices(self, session_id: str) -> RepetitionChoices:
        if session_id in self.unlisted:
            return RepetitionChoices()
        found, self._shown_versions[session_id] = session_records.read_choices(self.store, session_id)
        return found

    def save_choices(self, session_id: str, choices: RepetitionChoices) -> None:
        """Store choices in place of those read last. Raises :class:`ConcurrentChange`."""
        before, version = session_records.read_choices(self.store, session_id)
        self._shown_versions[session_id] = session_records.save_choices(
            self.store, session_id, choices, self._shown_versions.get(session_id, version)
        )
        if before.is_session_excluded == choices.is_session_excluded:
            self.audit_log.log_session("changed", session_id)
        else:
            self.audit_log.log_session("set_aside" if choices.is_session_excluded else "taken_back", session_id)

    def comment(self, session_id: str) -> str:
        """Return the current comment, empty if there is none."""
        if session_id in self.unlisted:
            return ""
        return session_records.read_current_comment(self.store, session_id)

    def save_comment(self, session_id: str, text: str) -> None:
        """Add a comment as the current one; earlier ones stay readable."""
        text = text.strip()[:MAX_COMMENT_CHARACTERS]
        if text != self.comment(session_id):
            session_records.add_comment(self.store, session_id, text, self.get_initials())
            self.audit_log.log_session("changed", session_id)

    def results(self, entry: SessionEntry) -> SessionResults:
        """Return the results of a session with its choices, cached."""
        choices, order = session_records.read_choices(self.store, entry.session_id)[0], self.get_angle_order()
        known = self._results_cache.get(entry.path)
        if known is None or known[0] != choices or known[1].angle_order != order:
            session = with_angle_order(with_listed_exercise(read_session(entry.path), entry), order)
            known = (choices, compute_session_results(session, choices, self.error_limits))
            self._results_cache[entry.path] = known
        return known[1]

    def results_by_id(self, session_id: str) -> SessionResults:
        return self.results(self.entry(session_id))

    def reload_error_limits(self) -> None:
        """Use the limits that the clinic has just measured."""
        self.error_limits = read_limits(self.folder)
        self._results_cache = {}
        self.audit_log.log_program("changed", limits=len(self.error_limits.studies))

    def history(self, patient_id: str) -> Sequence[SessionResults]:
        """Return the results of all readable sessions of a patient."""
        out = []
        results = Counter(entry.recording_id for entry in self.session_list.patient_sessions(patient_id))
        for entry in self.sessions(patient_id):
            with suppress(SessionUnreadable):  # its file is gone or damaged; opening it alone tells
                out.append(replace(self.results(entry), earlier_results=results[entry.recording_id] - 1))
        return out

    def export(
        self,
        session_id: str,
        folder: str,
        formats: Sequence[str] = ("csv",),
        progress: Callable[[int, int], None] | None = None,
        cancelled: Callable[[], bool] = lambda: False,
        deidentified: bool = False,
        form: TableDialect = MACHINE_DIALECT,
    ) -> Sequence[str]:
        """Export a session as listed, with a person's choices; return the names of the files.

        Raises the fault that prevented it.
        """
        path = self.entry(session_id).path
        by_hand = tuple(self.manual_measurements(self.owner_id(session_id)))  # of nobody's sessions there is none
        wanted = ExportRequest(path, lambda: (self._read_listed_session(session_id), self.choices(session_id)), by_hand)
        done = export_sessions(
            [wanted],
            Path(folder),
            formats,
            deidentified=deidentified,
            dialect=form,
            progress=progress,
            cancelled=cancelled,
        )
        if not deidentified:  # what nobody can be found by is not tied to anybody by the list of patients either
            self.register_output_files(done.files, "export", [session_id])
        else:
            self.audit_log.log_session("exported", session_id, files=len(done.files), deidentified=1)
        for refused in done.refused:
            raise refused.fault
        return [str(path.relative_to(folder)) for path in done.files]

    def register_output_files(self, paths: Sequence[Path], kind: OutputKind, session_ids: Iterable[str]) -> None:
        """Record files made from sessions, so that they are named when one of these is erased."""
        known = [one for one in session_ids if one not in self.unlisted]
        session_records.record_output_files(self.store, paths, kind, known)
        for session_id in known:
            self.audit_log.log_session("reported" if kind == "report" else "exported", session_id, files=len(paths))

    def read_marker_photo(self, patient_id: str, set_up: SessionSetup | None = None) -> ByteImage | None:
        """Return the last photo of a patient's markers, for a set-up that of its hand and protocol."""
        for entry in self.sessions(patient_id) if set_up is None else self.matching_sessions(patient_id, set_up):
            if entry.simulated and patient_id != PRACTICE_PATIENT:
                continue  # nobody's hand
            path = entry.path.with_suffix(MARKERS_SUFFIX)
            if path.exists():
                with suppress(CarpusFault):
                    return read_color(path)
        return None


def with_listed_exercise(session: Session, entry: SessionEntry) -> Session:
    """Return the session with the exercise it is listed under; its file never changes."""
    if session.header.exercise == entry.exercise:
        return session
    return replace(session, header=replace(session.header, exercise=entry.exercise))

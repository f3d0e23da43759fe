"""The data folder: register of patients, practice patient, session files and what lies beside them."""

from __future__ import annotations

import glob
import json
import math
import threading
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from carpus.core.agreement.limits_file import read_limits
from carpus.core.by_hand.values import HandValue
from carpus.core.calibration.result import ALL_STRAIGHT
from carpus.core.capture.picture_file import read_color
from carpus.core.capture.raw import SUFFIX as RAW_SUFFIX
from carpus.core.capture.raw import RawRecording
from carpus.core.capture.raw_pictures import decode_color
from carpus.core.check_card.trust import camera_of, with_trust
from carpus.core.encryption.content import PLACING, read_kept, write_encrypted
from carpus.core.encryption.keys import folder_of, is_on, key_for
from carpus.core.errors import (
    CarpusFault,
    ContentDamaged,
    EncryptionUnfinished,
    FilesSetApart,
    OutputNotWritable,
    RegisterDamaged,
    RegisterSetAside,
    SessionUnreadable,
)
from carpus.core.formats.export import Wanted, export_sessions
from carpus.core.library.beside import CHOICES_SUFFIX, COMMENTS_SUFFIX, MARKERS_SUFFIX
from carpus.core.library.coming_home import bring_home, fallback_place
from carpus.core.library.comments import MOST_CHARACTERS, Comment, latest, read_comments, stored_form
from carpus.core.library.encrypting import Encrypting
from carpus.core.library.exercise_sets import begun, read_sets
from carpus.core.library.set_up import PRACTICE_PATIENT, SetUp
from carpus.core.measures.error_limits import DEFAULT_LIMITS
from carpus.core.output.angle_order import in_order
from carpus.core.output.camera_said import CameraSaid
from carpus.core.output.exercises import exercise_named
from carpus.core.output.goals import Goals
from carpus.core.output.report_content import NAMES_DOUBTED, RepetitionChoices, SessionFigures, session_figures
from carpus.core.phrase import phrase
from carpus.core.safekeeping.audit import AuditLog, By, Deed, Fact, Kind
from carpus.core.safekeeping.encryption import (
    Progress,
    begin_switching_off,
    end_switching_off,
    exchange_list,
    exchange_lists,
    sweep,
    switch_on,
)
from carpus.core.session.database import make_private, set_aside
from carpus.core.session.made_files import MadeKind
from carpus.core.session.reader import has_raw, read_outline, read_raw_color, read_session
from carpus.core.session.recovery import Recovery, recover_folder
from carpus.core.session.register import (
    REGISTER_FILE,
    PatientEntry,
    PatientRegister,
    SessionEntry,
    entry_of,
    newest_results,
)
from carpus.core.session.values import MOST_TARGET_DEG, AngleOrder, Session
from carpus.core.types import ByteImage, Side

PRACTICE_FOLDER = "practice"
MOST_REPETITIONS = 999
KEPT_PICTURES = 2
"""Files of pictures that stay open: two sessions are looked at beside each other."""
MOST_TOLD = 3
"""Files that are told one by one when the program starts; more are told together."""
SET_UPS_FILE = "set_ups.json"


@dataclass(frozen=True, slots=True)
class Recovered:
    """A session that had been cut short and has been finished; ``kept_s`` of it are there."""

    patient_id: str
    session_id: str
    pseudonym: str
    when: datetime
    kept_s: float


@dataclass(frozen=True, slots=True)
class Encrypted:
    """The recovery code, which is kept nowhere, and what could not be encrypted yet."""

    code: str
    told: tuple[CarpusFault, ...]


@dataclass(frozen=True, slots=True)
class LookedAt:
    """A session file that was handed over; ``patient_id`` is empty where nobody here has it."""

    patient_id: str
    session_id: str
    subject_id: str
    side: Side


class Library:
    """Everything that is stored. May be used from several threads.

    What is done with patients' sessions stands in ``audit`` with the initials of ``who`` does it; where it cannot be
    written, ``log_fault`` is told. The practice patient is nobody, and in no log.
    """

    def __init__(self, folder: Path, practice_name: str = "Practice patient", *, by: By = "window") -> None:
        self.folder = folder
        self.who: Callable[[], str] = lambda: ""
        self.audit = AuditLog(folder, by, lambda: self.who())
        self.log_fault: Callable[[CarpusFault], None] = lambda _: None
        self._told: list[CarpusFault] = []
        self.error_limits = DEFAULT_LIMITS
        """The clinic's own from its test and retest, as far as it has any."""
        self._told += exchange_lists(folder)
        self.encrypting = Encrypting(folder, lambda fault: self.log_fault(fault))
        try:
            self.error_limits = read_limits(folder)
        except CarpusFault as fault:
            self._told.append(fault)
        self.clinic = self._opened(folder)
        try:
            self._practice = self._opened(folder / PRACTICE_FOLDER, of_practice=True)
        except BaseException:
            self.clinic.close()
            raise
        known = self._practice.patients()
        self._practice_id = known[0].patient_id if known else self._practice.add(PatientEntry(practice_name, "right"))
        self._lock = threading.Lock()
        self._elsewhere: dict[str, SessionEntry] = {}
        self._figures: dict[Path, tuple[RepetitionChoices, SessionFigures]] = {}
        self._pictures: list[KeptPictures] = []
        self.angle_order: Callable[[], AngleOrder] = lambda: "zyx"
        """In which order the wrist's angles are read in the window; files keep the papers'."""
        for identity, late in (("", self.clinic.erased_late), ("practice", self._practice.erased_late)):
            if late:
                self._note("erased", "everything", identity, files=late, late=1)

    def note_session(self, did: Deed, session_id: str, **facts: Fact) -> None:
        """Take down what was done with a session."""
        with suppress(SessionUnreadable):  # of a folder that went away: noted when it comes home
            if self.register_of(session_id) is self.clinic:
                self._note(did, "session", session_id, **facts)

    def note_patient(self, did: Deed, patient_id: str, **facts: Fact) -> None:
        """Take down what was done with a patient, or with all sessions of one."""
        if patient_id != PRACTICE_PATIENT:
            self._note(did, "patient", patient_id, **facts)

    def note(self, did: Deed, **facts: Fact) -> None:
        """Take down what was done with the program or with everything."""
        self._note(did, "program", "", **facts)

    def _note(self, did: Deed, kind: Kind, identity: str, **facts: Fact) -> None:
        try:
            self.audit.note(did, kind, identity, **facts)
        except CarpusFault as fault:  # what was done is done; that it stands in no log is said
            self.log_fault(fault)

    def _opened(self, folder: Path, *, of_practice: bool = False) -> PatientRegister:
        """A register; a damaged one is set aside and made again, so that the program starts whatever a file holds."""
        try:
            return PatientRegister(folder, of_practice=of_practice)
        except RegisterDamaged as fault:
            aside = set_aside(folder / REGISTER_FILE, datetime.now())
            self._told.append(RegisterSetAside(aside, fault.detail))
            return PatientRegister(folder, of_practice=of_practice)

    def encrypt(self, pin: str, progress: Progress = lambda _done, _total: None) -> Encrypted:
        """Encrypt all that is stored and all that will be. ValueError for a short PIN; raises what making the key
        raises, and then nothing was changed. What could not be encrypted now is tried again at the next start."""
        code = switch_on(self.folder, pin)
        told = self._exchange(progress)
        self.note("encrypted", left=len(told))
        return Encrypted(code, tuple(told))

    def decrypt(self, progress: Progress = lambda _done, _total: None) -> Sequence[CarpusFault]:
        """Make all plain again; what could not be, and then the key is kept. Raises :class:`OutputNotWritable`."""
        begin_switching_off(self.folder)
        told = self._exchange(progress)
        with suppress(EncryptionUnfinished):
            end_switching_off(self.folder)
        self.note("decrypted", left=len(told))
        return told

    def _exchange(self, progress: Progress) -> list[CarpusFault]:
        told: list[CarpusFault] = []
        for register in (self.clinic, self._practice):
            try:
                register.database.exchange(exchange_list)
            except CarpusFault as fault:
                told.append(fault)
        told += exchange_lists(self.folder)
        return told + list(sweep(self.folder, progress).left)

    def close(self) -> None:
        """May be called twice."""
        self.encrypting.end()
        self.clinic.close()
        self._practice.close()

    def pseudonyms(self) -> Sequence[str]:
        """Every pseudonym and name there is, for what must not hold them."""
        with suppress(CarpusFault):
            entries = [record.entry for record in self.clinic.patients(archived=True)]
            return [
                text
                for entry in entries
                for text in (entry.pseudonym, entry.pseudonym.replace(" ", "-"), entry.name)
                if text
            ]
        return ()

    # --- sessions -----------------------------------------------------------------------------------------
    def of(self, patient_id: str) -> tuple[PatientRegister, str]:
        """The register that a patient is in, and the identity there."""
        return (self._practice, self._practice_id) if patient_id == PRACTICE_PATIENT else (self.clinic, patient_id)

    def sessions(self, patient_id: str) -> Sequence[SessionEntry]:
        """A patient's sessions, newest first: of a recording that was tracked more than once the newest result."""
        return newest_results(self.results(patient_id))

    def results(self, patient_id: str) -> Sequence[SessionEntry]:
        """Every session file of a patient, also the earlier results of a recording that was tracked again."""
        register, key = self.of(patient_id)
        return register.sessions(key)

    def by_hand(self, patient_id: str) -> Sequence[HandValue]:
        """Everything that was ever measured by hand of a patient, in the order in which it was entered."""
        register, key = self.of(patient_id)
        return register.by_hand(key)

    def enter_by_hand(self, patient_id: str, values: Sequence[HandValue]) -> None:
        """Keep what was measured by hand; what was entered before for the same stays readable."""
        register, key = self.of(patient_id)
        register.enter_by_hand(key, values)
        self.note_patient("entered_by_hand", patient_id, values=len(values))

    def sessions_alike(self, patient_id: str, set_up: SetUp) -> Sequence[SessionEntry]:
        """Those with the discs of a set-up on the same hand, newest first."""
        own = (set_up.side, set_up.exercise.protocol)
        entries = self.sessions(patient_id)
        return [entry for entry in entries if (entry.hand, exercise_named(entry.exercise).protocol) == own]

    def entry(self, session_id: str) -> SessionEntry:
        """One session by its identity. Raises :class:`SessionUnreadable` for one that is not there."""
        if session_id in self._elsewhere:
            return self._elsewhere[session_id]
        for register in (self.clinic, self._practice):
            with suppress(KeyError):
                return register.session(session_id)
        raise SessionUnreadable(session_id, phrase("not in the list of patients"))

    def new_path(self, set_up: SetUp) -> Path:
        """A free path for a session that begins now."""
        register, key = self.of(set_up.patient_id)
        return register.new_session_path(key, set_up.exercise.id, set_up.side, datetime.now().astimezone())

    def entered(self, set_up: SetUp, path: Path) -> str:
        """Take a finished session into the register, and remember how it was set up."""
        register, key = self.of(set_up.patient_id)
        if path.parent == fallback_place(self.folder):  # the register is where the data folder is: gone
            return self._enter_elsewhere(path)
        self._keep_set_up(set_up)
        session_id = register.enter_session(path, key).session_id
        self.note_session("recorded", session_id)
        self.encrypting.wake()
        return session_id

    def _enter_elsewhere(self, path: Path) -> str:
        """Remember a session of a data folder that went away, until the program ends; then it is brought home."""
        entry = entry_of(path, read_outline(path))
        self._elsewhere[entry.session_id] = entry
        return entry.session_id

    def look_at(self, path: Path) -> LookedAt:
        """A session by its file, wherever that lies. One that no list knows belongs to nobody, and is remembered until
        the program ends; its file stays where it is. Raises what reading the file raises."""
        outline = read_outline(path)
        header = outline.header
        for register in (self.clinic, self._practice):
            with suppress(KeyError):
                register.session(header.session_id)
                owner = PRACTICE_PATIENT if register is self._practice else register.owner(header.session_id)
                return LookedAt(owner, header.session_id, header.subject_id, header.hand)
        self._elsewhere[header.session_id] = entry_of(path, outline)
        return LookedAt("", header.session_id, header.subject_id, header.hand)

    def fallback_folder(self) -> Path:
        """Where a recording goes on when the data folder goes away."""
        folder = fallback_place(self.folder)
        make_private(folder)
        return folder

    def last_hand_length_mm(self, set_up: SetUp, *, simulated: bool) -> float:
        """Length of this hand of the patient as the last session of the kind measured it; NaN before the first."""
        for entry in self.sessions(set_up.patient_id):
            if entry.hand != set_up.side:
                continue
            with suppress(SessionUnreadable):
                session = read_session(entry.path)
                verdict = session.calibration.verdict
                # Another length that was accepted is the hand's from now on; only wrong names measured no hand.
                doubted = any(
                    finding.kind in NAMES_DOUBTED for finding in verdict.findings if finding.kind != "other_length"
                )
                if session.header.simulated == simulated and not doubted and np.isfinite(verdict.hand_length_mm):
                    return verdict.hand_length_mm
        return float("nan")

    def last_straight_fingers(self, set_up: SetUp) -> tuple[bool, ...]:
        """What the last session with these discs said of the hand's fingers, thumb to little; straight before one."""
        if set_up.protocol.has_fingers:
            for entry in self.sessions_alike(set_up.patient_id, set_up):
                with suppress(SessionUnreadable):
                    return read_session(entry.path).calibration.straight_fingers
        return ALL_STRAIGHT

    def cut_short(self) -> None:
        """Finish what a fault left behind, as far as possible."""
        with suppress(CarpusFault):
            self.recover()

    def recover(self) -> tuple[Sequence[Recovered], Sequence[CarpusFault]]:
        """Finish interrupted sessions; take these, and files that were copied in, into the registers."""
        found: list[Recovered] = []
        faults, self._told = self._told, []
        faults += bring_home(self.folder)
        apart: list[CarpusFault] = []
        for register, practice in ((self.clinic, False), (self._practice, True)):
            recovery: Recovery = recover_folder(register.sessions_folder, given_up=register.given_up())
            apart += [*register.told, *register.first_told(recovery.faults)]
            register.told = ()
            if register.is_behind():
                apart += register.rebuild_from_sessions().faults
            owners = {
                record.entry.pseudonym.casefold(): record.patient_id for record in register.patients(archived=True)
            }
            for path in recovery.recovered:
                outline = read_outline(path)
                header = outline.header
                patient_id = PRACTICE_PATIENT if practice else owners.get(header.subject_id.casefold(), "")
                when = header.when
                self.note_session("recovered", header.session_id)
                found.append(Recovered(patient_id, header.session_id, header.subject_id, when, outline.duration_s))
        self.encrypting.wake()
        if len(apart) > MOST_TOLD:
            names = ", ".join(Path(fault.subject).name for fault in apart[:MOST_TOLD])
            apart = [FilesSetApart(f"{names}, …", phrase("{count} files", count=len(apart)))]
        return found, [*faults, *apart]

    # --- what is read of a session ------------------------------------------------------------------------
    def session(self, session_id: str) -> Session:
        """A whole session, of the exercise that it is in the list with, its angles in the order that is chosen."""
        return in_order(self._stored(session_id), self.angle_order())

    def _stored(self, session_id: str) -> Session:
        entry = self.entry(session_id)
        return _as_listed(read_session(entry.path), entry)

    def register_of(self, session_id: str) -> PatientRegister:
        """The register that knows a session. Raises :class:`SessionUnreadable` for one that is not there."""
        for register in (self.clinic, self._practice):
            with suppress(KeyError):
                register.session(session_id)
                return register
        raise SessionUnreadable(session_id, phrase("not in the list of patients"))

    def files_of(self, session_id: str) -> Sequence[Path]:
        """The session's file and all that lies beside it under its name."""
        path = self.entry(session_id).path
        return sorted(one for one in path.parent.glob(f"{glob.escape(path.stem)}.*") if one.is_file())

    def forget_figures(self, session_id: str) -> None:
        """What was worked out of a session is worked out anew."""
        self._figures = {path: known for path, known in self._figures.items() if known[1].session_id != session_id}

    def forget_pictures(self) -> None:
        """Let go of the files whose pictures were shown last."""
        with self._lock:
            self._pictures = []

    def picture(self, session_id: str, row: int) -> ByteImage | None:
        """The colour picture of a row where pictures were kept, in the session or beside it."""
        path = self._path_with_pictures(session_id)
        with self._lock:
            kept = next((one for one in self._pictures if one.path == path), None)
            if kept is None:
                kept = KeptPictures(path)
                self._pictures = [kept, *self._pictures][:KEPT_PICTURES]
            return kept.color(row)

    def results_of(self, session_id: str) -> Sequence[SessionEntry]:
        """Every result of the recording of a session, the first one first."""
        if session_id in self._elsewhere:
            return [self._elsewhere[session_id]]
        return self.register_of(session_id).results_of(session_id)

    def _path_with_pictures(self, session_id: str) -> Path:
        """The session itself, or the result of the same recording beside which the pictures were kept."""
        own = self.entry(session_id).path
        for path in (own, *(entry.path for entry in self.results_of(session_id))):
            if path.with_suffix(RAW_SUFFIX).exists() or has_raw(path):
                return path
        return own

    def choices(self, session_id: str) -> RepetitionChoices:
        """What a person left out or moved."""
        return read_choices(self.entry(session_id).path)

    def keep_choices(self, session_id: str, choices: RepetitionChoices) -> None:
        """Store it beside the session, whose file is never changed."""
        session_path = self.entry(session_id).path
        path = session_path.with_suffix(CHOICES_SUFFIX)
        with suppress(SessionUnreadable):
            counted_before = not read_choices(session_path).not_counted
            if counted_before == (not choices.not_counted):
                self.note_session("changed", session_id)
            else:
                self.note_session("set_aside" if choices.not_counted else "taken_back", session_id)
        content = {
            "left_out": {str(number): reason for number, reason in choices.left_out.items()},
            "edges_s": {str(number): list(edges) for number, edges in choices.edges_s.items()},
            "not_counted": choices.not_counted,
            "not_counted_reason": choices.not_counted_reason,
        }
        _write_json(path, content)

    def recipients(self) -> Sequence[str]:
        """To whom letters were written, the last used first."""
        return self.clinic.recipients()

    def remember_recipient(self, address: str) -> None:
        """Take down to whom a letter goes."""
        self.clinic.remember_recipient(address)

    def comments(self, session_id: str) -> Sequence[Comment]:
        """All that the therapist wrote of a session, oldest first."""
        return read_comments(self.entry(session_id).path)

    def comment(self, session_id: str) -> str:
        """What holds of it; empty where nothing was written."""
        return latest(self.comments(session_id))

    def keep_comment(self, session_id: str, text: str) -> None:
        """Add a comment, which holds from now on; what was written before stays beside it."""
        before = self.comments(session_id)
        text = text.strip()[:MOST_CHARACTERS]
        if text != latest(before):
            self.note_session("changed", session_id)
            now = datetime.now(UTC).replace(microsecond=0)
            path = self.entry(session_id).path.with_suffix(COMMENTS_SUFFIX)
            _write_json(path, stored_form([*before, Comment(text, self.who(), now)]))

    def figures(self, entry: SessionEntry) -> SessionFigures:
        """Figures of a session with its choices, computed once, and with what is known of its camera by now."""
        choices, order = read_choices(entry.path), self.angle_order()
        known = self._figures.get(entry.path)
        if known is None or known[0] != choices or known[1].angle_order != order:
            session = in_order(_as_listed(read_session(entry.path), entry), order)
            known = (choices, session_figures(session, choices, self.error_limits))
            self._figures[entry.path] = known
        return with_trust(known[1], self.folder)

    def camera(self, session: Session) -> CameraSaid:
        """What a session and the checks since say of its camera."""
        return camera_of(session, self.folder)

    def figures_of(self, session_id: str) -> SessionFigures:
        """As :meth:`figures`, by the session's identity."""
        return self.figures(self.entry(session_id))

    def limits_changed(self) -> None:
        """The clinic has measured its own error limits: from now on everything is judged by them."""
        self.error_limits = read_limits(self.folder)
        self._figures = {}
        self.note("changed", limits=len(self.error_limits.studies))

    def history(self, patient_id: str) -> Sequence[SessionFigures]:
        """Figures of all sessions of a patient that can be read."""
        out = []
        results = Counter(entry.recording_id for entry in self.results(patient_id))
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
        software_version: str = "",
    ) -> Sequence[str]:
        """Write a session as open formats into a folder, as it is listed and with a person's choices; the names of the
        files. Raises what kept it from being written."""
        path = self.entry(session_id).path
        wanted = Wanted(
            path, lambda: (self._stored(session_id), self.choices(session_id)), tuple(self._by_hand_of(session_id))
        )
        done = export_sessions(
            [wanted],
            Path(folder),
            formats,
            software_version=software_version,
            deidentified=deidentified,
            progress=progress,
            cancelled=cancelled,
        )
        if not deidentified:  # what nobody can be found by is not tied to anybody by the list of patients either
            self.made(done.files, "export", [session_id])
        else:
            self.note_session("exported", session_id, files=len(done.files), deidentified=1)
        for refused in done.refused:
            raise refused.fault
        return [str(path.relative_to(folder)) for path in done.files]

    def _by_hand_of(self, session_id: str) -> Sequence[HandValue]:
        """What was measured by hand of the patient of a session; nothing of nobody's."""
        with suppress(SessionUnreadable):
            register = self.register_of(session_id)
            return register.by_hand(register.owner(session_id))
        return ()

    def made(self, paths: Sequence[Path], kind: MadeKind, session_ids: Iterable[str]) -> None:
        """Take down files that were made from sessions, so that they go when one of these is erased."""
        for register in (self.clinic, self._practice):
            known = []
            for session_id in session_ids:
                with suppress(KeyError):
                    known.append(register.session(session_id).session_id)
            if known:
                register.remember_made(paths, kind, known)
        for session_id in session_ids:
            self.note_session("reported" if kind == "report" else "exported", session_id, files=len(paths))

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

    # --- set-ups ------------------------------------------------------------------------------------------
    def last_set_up(self, patient_id: str) -> SetUp | None:
        """How the last session was set up, None before the first."""
        register, key = self.of(patient_id)
        try:
            stored = json.loads((self.folder / SET_UPS_FILE).read_text(encoding="utf-8"))[patient_id]
            last = SetUp(
                patient_id,
                register.patient(key).entry.pseudonym,
                "left" if stored["side"] == "left" else "right",
                exercise_named(str(stored["exercise"])),
                _count(stored["repetitions"]),
                _target(stored["target_positive_deg"]),
                _target(stored["target_negative_deg"]),
                bool(stored["keep_pictures"]),
                bool(stored.get("ends_free", False)),
                str(stored.get("discs", "")),
                bool(stored.get("for_child", False)),
            )
            return self._with_set(last, str(stored.get("set", "")))
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            return None  # only a convenience: without it the set-up is asked for

    def _with_set(self, set_up: SetUp, set_id: str) -> SetUp:
        """The beginning of the set it was a part of, as the set is now."""
        with suppress(CarpusFault):
            for one in read_sets(self.folder) if set_id else ():
                if one.set_id == set_id and one.discs == set_up.protocol.name:
                    return begun(one, set_up, self.goals(set_up.patient_id))
        return set_up

    def goals(self, patient_id: str) -> Goals:
        """The targets that were last set for each exercise and hand of a patient."""
        out: dict[tuple[str, Side], tuple[float, float]] = {}
        with suppress(OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
            stored = json.loads((self.folder / SET_UPS_FILE).read_text(encoding="utf-8"))[patient_id]
            for one in stored["goals"]:
                side: Side = "left" if one["side"] == "left" else "right"
                out[str(one["exercise"]), side] = _target(one["positive_deg"]), _target(one["negative_deg"])
        return out

    def forget_set_up(self, patient_id: str) -> None:
        """Of a patient who is erased. Raises :class:`OutputNotWritable`."""
        path = self.folder / SET_UPS_FILE
        with self._lock:
            try:
                stored: Any = json.loads(path.read_text(encoding="utf-8"))
            except (OSError, ValueError, RecursionError):
                return
            if isinstance(stored, dict) and stored.pop(patient_id, None) is not None:
                _write_json(path, stored)

    def _keep_set_up(self, set_up: SetUp) -> None:
        path = self.folder / SET_UPS_FILE
        goals = dict(self.goals(set_up.patient_id))
        if set_up.exercise.counts:
            goals[set_up.exercise.id, set_up.side] = set_up.target_positive_deg, set_up.target_negative_deg
        with self._lock, suppress(OutputNotWritable):
            try:
                stored: Any = json.loads(path.read_text(encoding="utf-8"))
            except (OSError, ValueError, RecursionError):
                stored = {}
            stored = stored if isinstance(stored, dict) else {}
            stored[set_up.patient_id] = {
                "side": set_up.side,
                "exercise": set_up.exercise.id,
                "repetitions": set_up.repetitions,
                "target_positive_deg": _known(set_up.target_positive_deg),
                "target_negative_deg": _known(set_up.target_negative_deg),
                "keep_pictures": set_up.keep_pictures,
                "ends_free": set_up.ends_free,
                "discs": set_up.discs,
                "for_child": set_up.for_child,
                "set": set_up.course.set_id if set_up.course is not None else "",
                "goals": [
                    {
                        "exercise": exercise,
                        "side": side,
                        "positive_deg": _known(positive),
                        "negative_deg": _known(negative),
                    }
                    for (exercise, side), (positive, negative) in goals.items()
                ],
            }
            _write_json(path, stored)


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


def _as_listed(session: Session, entry: SessionEntry) -> Session:
    """The session with the exercise that a person said it was; its file is never changed."""
    if session.header.exercise == entry.exercise:
        return session
    return replace(session, header=replace(session.header, exercise=entry.exercise))


def read_choices(path: Path) -> RepetitionChoices:
    """What a person left out or moved, as kept beside a session; nothing where nothing is."""
    try:
        stored = json.loads(read_kept(path.with_suffix(CHOICES_SUFFIX)).decode("utf-8"))
        left_out = {int(number): str(reason) for number, reason in stored["left_out"].items()}
        edges_s = {int(number): (float(start), float(end)) for number, (start, end) in stored["edges_s"].items()}
        if not all(math.isfinite(start) and start <= end < math.inf for start, end in edges_s.values()):
            raise ValueError("edges that are no times")
        return RepetitionChoices(
            left_out, edges_s, stored.get("not_counted") is True, str(stored.get("not_counted_reason", ""))
        )
    except FileNotFoundError:
        return RepetitionChoices()
    except (
        OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError, OverflowError, ContentDamaged
    ) as cause:  # fmt: skip
        raise SessionUnreadable(path.with_suffix(CHOICES_SUFFIX), phrase("what was left out cannot be read")) from cause


def _write_json(path: Path, content: Any) -> None:
    if path.name != SET_UPS_FILE and (folder := folder_of(path)) is not None and is_on(folder):
        write_encrypted(path, json.dumps(content).encode("utf-8"), key_for(path))
        return
    part = path.with_suffix(".new")
    try:
        part.unlink(missing_ok=True)
        part.touch(mode=0o600)
        part.write_text(json.dumps(content, indent=1), encoding="utf-8")
        with PLACING:
            part.replace(path)
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause


def _known(value: float) -> float | None:
    return value if value == value else None


def _target(value: Any) -> float:
    """A target as it was stored; none is NaN. Raises ValueError for one that no joint reaches."""
    target = math.nan if value is None else float(value)
    if abs(target) > MOST_TARGET_DEG:
        raise ValueError(f"target {target}")
    return target


def _count(value: Any) -> int:
    """How many repetitions were wanted. Raises ValueError for a number that nobody wants."""
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= MOST_REPETITIONS:
        raise ValueError(f"{value!r} repetitions")
    return value

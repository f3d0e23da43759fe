"""The data folder: register of patients, practice patient, session files and what lies beside them."""

from __future__ import annotations

import json
import threading
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np

from app.desktop.export import export_csv
from app.desktop.measuring import MARKERS_SUFFIX
from core.capture.picture_file import read_color
from core.capture.raw import SUFFIX as RAW_SUFFIX
from core.capture.raw import RawRecording
from core.capture.raw_pictures import decode_color
from core.errors import CarpusFault, OutputNotWritable, SessionUnreadable
from core.output.exercises import exercise_named
from core.output.report_content import NAMES_DOUBTED, RepetitionChoices, SessionFigures, session_figures
from core.session.reader import has_raw, read_outline, read_raw_color, read_session
from core.session.recovery import Recovery, recover_folder
from core.session.register import PatientEntry, PatientRegister, SessionEntry
from core.session.values import Session
from core.types import ByteImage
from ui.ports import PRACTICE_PATIENT, SetUp

PRACTICE_FOLDER = "practice"
SET_UPS_FILE = "set_ups.json"
CHOICES_SUFFIX = ".choices.json"


@dataclass(frozen=True, slots=True)
class Recovered:
    """A session that had been cut short and has been finished; ``kept_s`` of it are there."""

    patient_id: str
    session_id: str
    pseudonym: str
    when: datetime
    kept_s: float


class Library:
    """Everything that is stored. May be used from several threads."""

    def __init__(self, folder: Path, practice_name: str = "Practice patient") -> None:
        self.folder = folder
        self.clinic = PatientRegister(folder)
        self._practice = PatientRegister(folder / PRACTICE_FOLDER)
        known = self._practice.patients()
        self._practice_id = known[0].patient_id if known else self._practice.add(PatientEntry(practice_name, "right"))
        self._lock = threading.Lock()
        self._figures: dict[Path, tuple[RepetitionChoices, SessionFigures]] = {}
        self._pictures: KeptPictures | None = None

    def close(self) -> None:
        """May be called twice."""
        self.clinic.close()
        self._practice.close()

    # --- sessions -----------------------------------------------------------------------------------------
    def of(self, patient_id: str) -> tuple[PatientRegister, str]:
        """The register that a patient is in, and the identity there."""
        return (self._practice, self._practice_id) if patient_id == PRACTICE_PATIENT else (self.clinic, patient_id)

    def sessions(self, patient_id: str) -> Sequence[SessionEntry]:
        """A patient's sessions, newest first."""
        register, key = self.of(patient_id)
        return register.sessions(key)

    def sessions_alike(self, patient_id: str, set_up: SetUp) -> Sequence[SessionEntry]:
        """Those with the discs of a set-up on the same hand, newest first."""
        own = (set_up.side, set_up.protocol)
        entries = self.sessions(patient_id)
        return [entry for entry in entries if (entry.hand, exercise_named(entry.exercise).protocol) == own]

    def entry(self, session_id: str) -> SessionEntry:
        """One session by its identity. Raises :class:`SessionUnreadable` for one that is not there."""
        for register in (self.clinic, self._practice):
            with suppress(KeyError):
                return register.session(session_id)
        raise SessionUnreadable(session_id, "not in the list of patients")

    def new_path(self, set_up: SetUp) -> Path:
        """A free path for a session that begins now."""
        register, key = self.of(set_up.patient_id)
        return register.new_session_path(key, set_up.exercise.id, set_up.side, datetime.now().astimezone())

    def entered(self, set_up: SetUp, path: Path) -> str:
        """Take a finished session into the register, and remember how it was set up."""
        register, key = self.of(set_up.patient_id)
        self._keep_set_up(set_up)
        return register.enter_session(path, key).session_id

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

    def cut_short(self) -> None:
        """Finish what a fault left behind, as far as possible."""
        with suppress(CarpusFault):
            self.recover()

    def recover(self) -> tuple[Sequence[Recovered], Sequence[CarpusFault]]:
        """Finish interrupted sessions; take these, and files that were copied in, into the registers."""
        found: list[Recovered] = []
        faults: list[CarpusFault] = []
        for register, practice in ((self.clinic, False), (self._practice, True)):
            recovery: Recovery = recover_folder(register.sessions_folder)
            faults += recovery.faults
            if register.is_behind():
                faults += register.rebuild_from_sessions().faults
            owners = {record.entry.pseudonym.casefold(): record.patient_id for record in register.patients()}
            for path in recovery.recovered:
                outline = read_outline(path)
                header = outline.header
                patient_id = PRACTICE_PATIENT if practice else owners.get(header.subject_id.casefold(), "")
                when = datetime.fromisoformat(header.created)
                found.append(Recovered(patient_id, header.session_id, header.subject_id, when, outline.duration_s))
        return found, faults

    # --- what is read of a session ------------------------------------------------------------------------
    def session(self, session_id: str) -> Session:
        """A whole session."""
        return read_session(self.entry(session_id).path)

    def picture(self, session_id: str, row: int) -> ByteImage | None:
        """The colour picture of a row where pictures were kept, in the session or beside it."""
        path = self.entry(session_id).path
        with self._lock:
            if self._pictures is None or self._pictures.path != path:
                self._pictures = KeptPictures(path)
            return self._pictures.color(row)

    def choices(self, session_id: str) -> RepetitionChoices:
        """What a person left out or moved."""
        return _read_choices(self.entry(session_id).path)

    def keep_choices(self, session_id: str, choices: RepetitionChoices) -> None:
        """Store it beside the session, whose file is never changed."""
        path = self.entry(session_id).path.with_suffix(CHOICES_SUFFIX)
        content = {
            "left_out": {str(number): reason for number, reason in choices.left_out.items()},
            "edges_s": {str(number): list(edges) for number, edges in choices.edges_s.items()},
            "not_counted": choices.not_counted,
        }
        _write_json(path, content)

    def figures(self, entry: SessionEntry) -> SessionFigures:
        """Figures of a session with its choices; computed once."""
        choices = _read_choices(entry.path)
        known = self._figures.get(entry.path)
        if known is None or known[0] != choices:
            known = (choices, session_figures(read_session(entry.path), choices))
            self._figures[entry.path] = known
        return known[1]

    def history(self, patient_id: str) -> Sequence[SessionFigures]:
        """Figures of all sessions of a patient that can be read."""
        out = []
        for entry in self.sessions(patient_id):
            with suppress(SessionUnreadable):  # its file is gone or damaged; opening it alone tells
                out.append(self.figures(entry))
        return out

    def export(self, session_id: str, folder: str) -> Sequence[str]:
        """Write a session as open formats into a folder; the names of the files."""
        return [export_csv(self.session(session_id), Path(folder))]

    def marker_picture(self, patient_id: str, set_up: SetUp | None = None) -> ByteImage | None:
        """The markers as they were stuck last time, or when last on the hand and of the protocol of a set-up."""
        for entry in self.sessions(patient_id) if set_up is None else self.sessions_alike(patient_id, set_up):
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
            return SetUp(
                patient_id,
                register.patient(key).entry.pseudonym,
                "left" if stored["side"] == "left" else "right",
                exercise_named(str(stored["exercise"])),
                int(stored["repetitions"]),
                _number(stored["target_positive_deg"]),
                _number(stored["target_negative_deg"]),
                bool(stored["keep_pictures"]),
                bool(stored.get("ends_free", False)),
            )
        except (OSError, ValueError, KeyError, TypeError):
            return None  # only a convenience: without it the set-up is asked for

    def _keep_set_up(self, set_up: SetUp) -> None:
        path = self.folder / SET_UPS_FILE
        with self._lock, suppress(OutputNotWritable):
            try:
                stored: Any = json.loads(path.read_text(encoding="utf-8"))
            except (OSError, ValueError):
                stored = {}
            stored[set_up.patient_id] = {
                "side": set_up.side,
                "exercise": set_up.exercise.id,
                "repetitions": set_up.repetitions,
                "target_positive_deg": _known(set_up.target_positive_deg),
                "target_negative_deg": _known(set_up.target_negative_deg),
                "keep_pictures": set_up.keep_pictures,
                "ends_free": set_up.ends_free,
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


def _read_choices(path: Path) -> RepetitionChoices:
    try:
        stored = json.loads(path.with_suffix(CHOICES_SUFFIX).read_text(encoding="utf-8"))
        left_out = {int(number): str(reason) for number, reason in stored["left_out"].items()}
        edges_s = {int(number): (float(start), float(end)) for number, (start, end) in stored["edges_s"].items()}
        return RepetitionChoices(left_out, edges_s, stored.get("not_counted") is True)
    except FileNotFoundError:
        return RepetitionChoices()
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as cause:
        raise SessionUnreadable(path.with_suffix(CHOICES_SUFFIX), "what was left out cannot be read") from cause


def _write_json(path: Path, content: Any) -> None:
    part = path.with_suffix(".new")
    try:
        part.touch(mode=0o600)
        part.write_text(json.dumps(content, indent=1), encoding="utf-8")
        part.replace(path)
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause


def _known(value: float) -> float | None:
    return value if value == value else None


def _number(value: Any) -> float:
    return float("nan") if value is None else float(value)

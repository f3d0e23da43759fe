"""Values of patients and sessions in the store."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import KW_ONLY, dataclass
from datetime import UTC, date, datetime
from pathlib import Path
from typing import Literal, TypeVar

from carpus.core.model.dates import is_moment
from carpus.core.model.errors import CarpusFault, ServerUnavailable
from carpus.core.model.types import Side
from carpus.core.session.values import SessionOutline

AffectedSide = Literal["both", "right", "left"]
Dominance = Literal["unknown", "right", "left", "both"]
Sex = Literal["", "female", "male", "diverse"]
Onset = Literal["", "operation", "injury"]
"""In all of these an unknown value from another program becomes the first choice."""


@dataclass(frozen=True, slots=True)
class Patient:
    """Patient, the same from the store to the screens.

    The positional fields are filled in by a person and are columns of the store. Names, birth date, number, sex,
    diagnosis and onset are there only: in no session file, export or log. Keyword fields come from the store:
    ``session_count`` counts each recording once, ``result_count`` every file; simulated sessions are not counted.
    ``version`` rises with every change.
    """

    pseudonym: str
    side: AffectedSide
    dominance: Dominance = "unknown"
    note: str = ""
    name: str = ""
    birth_day: date | None = None
    record_number: str = ""
    sex: Sex = ""
    diagnosis: str = ""
    onset: Onset = ""
    onset_day: date | None = None
    _: KW_ONLY
    patient_id: str = ""
    session_count: int = 0
    result_count: int = 0
    last_session: datetime | None = None
    last_exercise: str = ""
    version: int = 0

    def __post_init__(self) -> None:
        if not self.pseudonym.strip():
            raise ValueError("no pseudonym")


MAX_INITIALS = 12


@dataclass(frozen=True, slots=True)
class Therapist:
    """Therapist of the clinic; ``initials`` stand in sessions, reports and the log."""

    initials: str
    name: str = ""


@dataclass(frozen=True, slots=True)
class HomePlan:
    """Last home plan of a patient.

    ``exercises`` by id, ``times`` in a row, ``rounds`` a day; ``again`` at ``at`` is the next appointment; ``language``
    by two letters.
    """

    exercises: tuple[str, ...]
    times: int
    rounds: int
    made: date
    again: date | None
    at: str
    note: str
    language: str


@dataclass(frozen=True, slots=True)
class SessionEntry:
    """Listed session file.

    ``recorded``: when the hand moved; ``created``: when the file was written; ``initials`` of the therapist.
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
    simulated: bool = False
    initials: str = ""


@dataclass(frozen=True, slots=True)
class ScanResult:
    """Number of sessions listed by a scan, and a fault for each unreadable file."""

    session_count: int
    faults: tuple[CarpusFault, ...]


T = TypeVar("T")
U = TypeVar("U")


def read_or_default(read: Callable[[], T], default: U) -> T | U:
    """Return what ``read`` returns, ``default`` while the server is away."""
    try:
        return read()
    except ServerUnavailable:
        return default


def parse_time(stored: str, stamp_s: float) -> datetime:
    """Parse a stored time; if it is none or has no zone, use its stamp."""
    return datetime.fromisoformat(stored) if is_moment(stored) else datetime.fromtimestamp(stamp_s, UTC)


def select_latest_versions(entries: Iterable[SessionEntry]) -> list[SessionEntry]:
    """Return the newest result of each recording, newest recording first."""
    newest: dict[str, SessionEntry] = {}
    for entry in sorted(entries, key=lambda entry: (entry.created.timestamp(), str(entry.path))):
        newest[entry.recording_id] = entry
    return sorted(newest.values(), key=lambda entry: (entry.recorded.timestamp(), str(entry.path)), reverse=True)


def entry_from_outline(path: Path, outline: SessionOutline) -> SessionEntry:
    """Return the entry of a session file that is not listed."""
    header = outline.header
    return SessionEntry(
        header.session_id, path, header.recording_time, datetime.fromisoformat(header.created), header.recording_id,
        header.exercise, header.hand, outline.frames, outline.duration_s, header.is_simulated,
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class BackupSettings:
    """Settings of backups: ``folder`` (empty: none) and daily ``hour`` (-1: never).

    A reminder comes after ``remind_days``. The newest ``keep`` backups stay, and one of each month for ``months``.
    """

    folder: str = ""
    hour: int = 18
    remind_days: int = 3
    keep: int = 14
    months: int = 24

    def __post_init__(self) -> None:
        if not (-1 <= self.hour <= 23 and self.keep >= 1 and self.months >= 0 and self.remind_days >= 1):
            raise ValueError("hours are -1 to 23, at least one back-up is kept, reminders come after a day or more")

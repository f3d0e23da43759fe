"""What the store says of patients and sessions, as values."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from datetime import UTC, date, datetime
from pathlib import Path
from typing import Literal, TypeVar, get_args

from carpus.core.model.dates import is_moment
from carpus.core.model.errors import CarpusFault, ServerUnavailable
from carpus.core.model.names import normalize_name
from carpus.core.model.types import Side
from carpus.core.session.values import SessionOutline

AffectedSide = Literal["both", "right", "left"]
Dominance = Literal["unknown", "right", "left", "both"]
AgeBand = Literal["", "0-9", "10-19", "20-29", "30-39", "40-49", "50-59", "60-69", "70-79", "80 and over"]
Onset = Literal["", "operation", "injury"]
"""Of each the first is taken where another program stored what is none."""


@dataclass(frozen=True, slots=True)
class Patient:
    """A patient, the same from the store to the screens.

    What a person writes down comes first, each a column of the store by its name; ``name`` is optional and stays in the
    store, as the diagnosis does, or the operation, with the day of ``onset``. What the store adds is given by name:
    ``last_session`` None and ``last_exercise`` empty before the first session; ``session_count`` counts a recording
    once, however often it was tracked; ``result_count`` counts every file. Sessions of a simulated hand are nobody's
    movement: they are neither counted nor the last one. ``version`` rises with every change by a person.
    """

    pseudonym: str
    side: AffectedSide
    dominance: Dominance = "unknown"
    age_band: AgeBand = ""
    note: str = ""
    name: str = ""
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
        if self.age_band not in get_args(AgeBand):
            raise ValueError(f"age band {self.age_band!r}")

    def with_normalized_names(self) -> Patient:
        """The same with names as they are kept. Raises :class:`NameUnsuited`."""
        return replace(
            self,
            pseudonym=normalize_name(self.pseudonym),
            name=normalize_name(self.name),
            diagnosis=normalize_name(self.diagnosis),
        )


@dataclass(frozen=True, slots=True)
class HomePlan:
    """What a patient was last given to do at home: exercises by their ids, ``times`` in a row, ``rounds`` a day; the
    next appointment, None for none, with its time as it was typed; a line; the patient's language by two letters."""

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
    """One session file as the store knows it.

    ``recorded`` when the hand moved, ``created`` when the file was made; ``recording_id`` as in the file;
    ``initials`` the
    initials of who recorded it.
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
    """What a look at the files found: sessions entered, and one fault for each file it could not read."""

    session_count: int
    faults: tuple[CarpusFault, ...]


T = TypeVar("T")
U = TypeVar("U")


def read_or_default(read: Callable[[], T], default: U) -> T | U:
    """What is read of a store, something else while its server does not answer: for who measures all the same."""
    try:
        return read()
    except ServerUnavailable:
        return default


def valid_choice(choices: Sequence[T], stored: T) -> T:
    """What is stored where it is one of the choices, else the first: a row that another program wrote."""
    return stored if stored in choices else choices[0]


def parse_time(stored: str, stamp_s: float) -> datetime:
    """A time as it is stored, by its stamp where another program wrote what is none, or none with a zone."""
    return datetime.fromisoformat(stored) if is_moment(stored) else datetime.fromtimestamp(stamp_s, UTC)


def select_latest_versions(entries: Iterable[SessionEntry]) -> list[SessionEntry]:
    """Of every recording its newest result, the recordings newest first."""
    newest: dict[str, SessionEntry] = {}
    for entry in sorted(entries, key=lambda entry: (entry.created.timestamp(), str(entry.path))):
        newest[entry.recording_id] = entry
    return sorted(newest.values(), key=lambda entry: (entry.recorded.timestamp(), str(entry.path)), reverse=True)


def entry_from_outline(path: Path, outline: SessionOutline) -> SessionEntry:
    """A session as the store would know it, of a file that is not in it."""
    header = outline.header
    return SessionEntry(
        header.session_id, path, header.recording_time, datetime.fromisoformat(header.created), header.recording_id,
        header.exercise, header.hand, outline.frames, outline.duration_s, header.is_simulated,
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class BackupSettings:
    """``folder`` for back-ups, empty for none; by itself each day from ``hour`` on, -1 for never; a reminder after
    ``remind_days``. The newest ``keep`` are kept, and one of each month for ``months``."""

    folder: str = ""
    hour: int = 18
    remind_days: int = 3
    keep: int = 14
    months: int = 24

    def __post_init__(self) -> None:
        if not (-1 <= self.hour <= 23 and self.keep >= 1 and self.months >= 0 and self.remind_days >= 1):
            raise ValueError("hours are -1 to 23, at least one back-up is kept, reminders come after a day or more")

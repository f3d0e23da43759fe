"""What bounds the live session, and what it tells: the newest view, events, counters."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from carpus.core.model.setting_values import NOT_IN_FILE
from carpus.core.model.types import Frame, TrackedFrame

LiveEventKind = Literal[
    "camera_lost",
    "camera_back",
    "notice",
    "source_ended",
    "source_failed",
    "tracking_failed",
    "recording_failed",
    "pictures_failed",
    "disk_low",
    "thread_stuck",
]


@dataclass(frozen=True, slots=True)
class LiveSettings:
    """Bounds of the live session.

    ``tracking_waiting`` recorded frames that may wait for the tracker before new ones are left out: a minute of a
    camera at twice the work that the computer can do, as they came, 1.5 GB of 640x480, fewer where the computer has
    not twice as much memory free. ``pictures_waiting`` may wait for the disk before the raw recording ends; the newest
    are the same as those above, so the two share their memory.
    ``rows_waiting`` as many results, beside those that wait for the tracker, before the recording ends (30 s); a
    warning comes once below ``low_disk_bytes``. ``folder`` is where sessions will go, for the room on the disk before a
    recording runs.
    """

    tracking_waiting: int = 960
    rows_waiting: int = 900
    pictures_waiting: int = 960
    low_disk_bytes: int = 1_000_000_000
    folder: Path | None = field(default=None, metadata=NOT_IN_FILE)

    def __post_init__(self) -> None:
        for name in ("tracking_waiting", "rows_waiting", "pictures_waiting"):
            if not 0 < getattr(self, name) <= 1_000_000:
                raise ValueError(f"{name} {getattr(self, name)} is not between 0 and 1000000")


@dataclass(frozen=True, slots=True)
class TrackedView:
    """A picture and what was tracked in that same picture; ``captured_at_s`` on the clock of :func:`time.monotonic`."""

    frame: Frame
    tracked: TrackedFrame
    captured_at_s: float


@dataclass(frozen=True, slots=True)
class LiveEvent:
    """Something rare that the person must be told.

    ``time_s`` in the recording's own time (NaN before the first frame). ``cause`` is a
    :class:`~core.model.errors.CarpusFault` or, where the program itself is wrong, any other exception; None where the
    kind
    says it all. ``value`` is the kind's figure: bytes left for ``disk_low``.
    """

    kind: LiveEventKind
    time_s: float
    cause: Exception | None = None
    value: float = float("nan")


StartMode = Literal["key", "countdown", "still"]
"""When a recording begins: at the key, counted down after it, or by itself over a hand that lies still."""


@dataclass(frozen=True, slots=True)
class LiveCounters:
    """Figures of the moment. Unknown is NaN or None.

    ``captured``, ``tracked`` frames since the start; ``dropped`` frames for which there was no room before the tracker,
    and ``missing`` those that never came from the source; ``fps`` over the last two seconds; ``latency_*_ms`` from the
    frame's arrival until it was tracked, over the last frames; ``frames_waiting`` how many wait for that;
    ``tracking_lag_s`` how long it takes for these, as fast as it has been lately; ``rows_written`` and
    ``frames_written`` of the running recording; ``disk_free_bytes`` and ``disk_minutes_left`` at its rate.
    """

    captured: int
    tracked: int
    dropped: int
    missing: int
    fps: float
    latency_p50_ms: float
    latency_p95_ms: float
    frames_waiting: int
    tracking_lag_s: float
    rows_written: int
    frames_written: int
    is_recording: bool
    is_paused: bool
    disk_free_bytes: int | None
    disk_minutes_left: float

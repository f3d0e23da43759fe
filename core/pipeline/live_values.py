"""Values of the live session: limits, current view, events, counters."""

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
    """Limits of the live session.

    Attributes
    ----------
    max_waiting_frames : int
        Recorded frames that may wait for the tracker: a minute at half the camera's speed (1.5 GB at 640x480); fewer if
        less than twice that memory is free.
    max_waiting_rows : int
        Results that may wait for the disk, beside those frames (30 s), before the recording ends.
    max_waiting_images : int
        Frames that may wait for the disk before the raw recording ends; they share memory with those above.
    low_disk_bytes : int
        Free space below which a warning is given once.
    folder : Path, optional
        Session folder, for the free space before a recording.
    """

    max_waiting_frames: int = 960
    max_waiting_rows: int = 900
    max_waiting_images: int = 960
    low_disk_bytes: int = 1_000_000_000
    folder: Path | None = field(default=None, metadata=NOT_IN_FILE)

    def __post_init__(self) -> None:
        for name in ("max_waiting_frames", "max_waiting_rows", "max_waiting_images"):
            if not 0 < getattr(self, name) <= 1_000_000:
                raise ValueError(f"{name} {getattr(self, name)} is not between 0 and 1000000")


@dataclass(frozen=True, slots=True)
class TrackedView:
    """Frame with its tracking result; ``captured_at_s`` on the clock of :func:`time.monotonic`."""

    frame: Frame
    tracked: TrackedFrame
    captured_at_s: float


@dataclass(frozen=True, slots=True)
class LiveEvent:
    """Rare event to be shown to the user.

    ``time_s`` on the recording's clock (NaN before the first frame). ``cause`` is a
    :class:`~core.model.errors.CarpusFault`, another exception for an internal error, or None. ``value`` is a number of
    the kind, such as the free bytes of ``disk_low``.
    """

    kind: LiveEventKind
    time_s: float
    cause: Exception | None = None
    value: float = float("nan")


StartMode = Literal["key", "countdown", "still"]
"""When a recording starts: at the key, after a countdown, or automatically over a still hand."""


@dataclass(frozen=True, slots=True)
class LiveCounters:
    """Current state of the live session; unknown values are NaN.

    Attributes
    ----------
    captured, tracked : int
        Frames since the start.
    dropped, missing : int
        Frames without room before the tracker; frames that never came from the source.
    fps : float
        Over the last two seconds.
    frames_waiting, tracking_lag_s
        Frames waiting for the tracker, and the time it needs for them.
    disk_minutes_left : float
        Time until the free space is used up.
    """

    captured: int
    tracked: int
    dropped: int
    missing: int
    fps: float
    frames_waiting: int
    tracking_lag_s: float
    is_recording: bool
    disk_minutes_left: float

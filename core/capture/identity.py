"""Which recording this is, and when the hand moved: facts of the recording, not of whoever reads it."""

from __future__ import annotations

import hashlib
import uuid
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np

from carpus.core.capture.source import SourceInfo
from carpus.core.dates import is_moment, iso, time_of_day
from carpus.core.types import Frame

WhoSaid = Literal["asked", "recording", "times", "file"]
"""A person; the recording itself; the times of its pictures, which count from 1970; the date of its file."""


class Recorded(NamedTuple):
    """``when`` the hand moved, ISO 8601 with zone, and who says so."""

    when: str
    said_by: WhoSaid


def recording_id(info: SourceInfo, first: Frame) -> str:
    """The identity of a recording: its own, else one made of its first frame, the same whenever it is read.

    Of the frame's time and depth, which are stored without loss everywhere; of the colour where there is no depth.
    """
    with suppress(ValueError):
        return str(uuid.UUID(info.recording_id))
    picture = first.color_rgb if first.depth_raw is None else first.depth_raw
    digest = hashlib.sha256(np.float64(first.timestamp_s).tobytes() + np.ascontiguousarray(picture).tobytes())
    return str(uuid.uuid5(uuid.NAMESPACE_OID, digest.hexdigest()))


def recorded_at(info: SourceInfo, first_s: float, path: Path | None, now: datetime | None = None) -> Recorded | None:
    """When a stored recording was made; the date of its file is the last resort, None where there is none."""
    if is_moment(info.recorded):
        return Recorded(info.recorded, "recording")
    by_times = time_of_day(first_s, now)
    if by_times is not None:
        return Recorded(iso(by_times), "times")
    if path is None or not path.exists():
        return None
    return Recorded(iso(datetime.fromtimestamp(path.stat().st_mtime, UTC)), "file")

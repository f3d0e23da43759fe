"""Days and times as stored: ISO 8601, times with a zone."""

from __future__ import annotations

from datetime import UTC, date, datetime

_EARLIEST = datetime(2000, 1, 1, tzinfo=UTC)
"""No depth camera is older: an earlier time counts from when the camera was switched on."""


def moment_from_timestamp(timestamp_s: float) -> datetime | None:
    """Convert a frame's time to UTC if it counts from 1970, else return None."""
    latest_s = datetime.now(UTC).timestamp() + 86400.0
    if not _EARLIEST.timestamp() <= timestamp_s <= latest_s:
        return None
    return datetime.fromtimestamp(timestamp_s, UTC)


def is_moment(text: str) -> bool:
    """Return whether a text is a date and time with zone."""
    try:
        return datetime.fromisoformat(text).utcoffset() is not None
    except ValueError:
        return False


def parse_day(text: str) -> date | None:
    """Parse a day, None if the text is none."""
    try:
        return date.fromisoformat(text)
    except ValueError:
        return None


def to_iso(moment: datetime) -> str:
    """Format a time to the second in the local zone."""
    return moment.astimezone().isoformat(timespec="seconds")

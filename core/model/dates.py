"""Days and moments as they are stored: ISO 8601, moments with a zone."""

from __future__ import annotations

from datetime import UTC, date, datetime

_EARLIEST = datetime(2000, 1, 1, tzinfo=UTC)
"""No depth camera is older: an earlier time counts from when the camera was switched on."""


def moment_from_timestamp(timestamp_s: float) -> datetime | None:
    """The moment that a picture's time names when it counts from 1970, None when it counts from anything else."""
    latest_s = datetime.now(UTC).timestamp() + 86400.0
    if not _EARLIEST.timestamp() <= timestamp_s <= latest_s:
        return None
    return datetime.fromtimestamp(timestamp_s, UTC)


def is_moment(text: str) -> bool:
    """Whether a text is a date and time with its zone."""
    try:
        return datetime.fromisoformat(text).utcoffset() is not None
    except ValueError:
        return False


def parse_day(text: str) -> date | None:
    """The day that a text names, None for one that is none."""
    try:
        return date.fromisoformat(text)
    except ValueError:
        return None


def to_iso(moment: datetime) -> str:
    """ISO 8601 to the second, in the zone of this place."""
    return moment.astimezone().isoformat(timespec="seconds")

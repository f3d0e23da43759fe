"""The same figures as of another day."""

from __future__ import annotations

from dataclasses import replace
from datetime import timedelta
from typing import Any

from carpus.core.results.figures import SessionFigures
from tests.ui.fakes import NOW


def days_ago(one: SessionFigures, days: int, **changes: Any) -> SessionFigures:
    """A session and recording of its own, called by its day, with other changes."""
    own = {"when": NOW - timedelta(days=days), "session_id": str(days), "recording_id": str(days)}
    return replace(one, **own | changes)

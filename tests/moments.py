"""Tracked frames with another moment."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from carpus.core.model.types import TrackedFrame


def with_moment(frame: TrackedFrame, **values: Any) -> TrackedFrame:
    """The frame with some values of its moment replaced."""
    return replace(frame, kinematics=replace(frame.kinematics, **values))

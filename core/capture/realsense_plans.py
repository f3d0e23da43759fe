"""What the capture process of librealsense is asked to do with a recording."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FilePlan:
    """Play a recording of the library in order, picture by picture."""

    path: str

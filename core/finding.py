"""What an examination of this computer found: one finding per need."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

State = Literal["good", "warning", "bad"]


@dataclass(frozen=True, slots=True)
class Finding:
    """One need. ``found`` is the fact; ``remedy`` what to do, empty when nothing is to be done."""

    name: str
    state: State
    found: str
    remedy: str = ""

"""What the set-up asks for, as values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

SourceKind = Literal["camera", "file", "practice"]


@dataclass(frozen=True, slots=True)
class SourceChoice:
    """Where the pictures come from; ``path`` of a stored recording only."""

    kind: SourceKind
    path: str = ""

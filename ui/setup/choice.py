"""What the set-up asks for, as values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

SourceKind = Literal["camera", "file", "practice"]


@dataclass(frozen=True, slots=True)
class SourceChoice:
    """Where the pictures come from; of a stored recording only its ``path``, and whether its depth lies on its
    colours where the recording does not say and the person was asked."""

    kind: SourceKind
    path: str = ""
    registered: bool | None = None

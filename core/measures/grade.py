"""Total active motion as a share of the normal one, and its grade (American Society for Surgery of the Hand)."""

from __future__ import annotations

import math
from typing import Literal

Grade = Literal["excellent", "good", "fair", "poor"]
USUAL_TOTAL_DEG = {1: 140.0, 2: 260.0, 3: 260.0, 4: 260.0, 5: 260.0}
"""TAM of a healthy finger where the other hand is not known (clinical reference 4.3)."""


def total_share(total_deg: float, finger: int, other_hand_deg: float = math.nan) -> float:
    """Share of the other hand's TAM, or of the usual one where that is not known.

    >>> round(total_share(195.0, 3), 2)
    0.75
    """
    norm = other_hand_deg if other_hand_deg > 0.0 else USUAL_TOTAL_DEG[finger]
    return total_deg / norm


def total_grade(share: float) -> Grade | None:
    """Excellent from the normal on, good above 75 %, fair above 50 %, else poor; None where nothing is known."""
    if not math.isfinite(share):
        return None
    if share >= 1.0:
        return "excellent"
    return "good" if share > 0.75 else "fair" if share > 0.5 else "poor"

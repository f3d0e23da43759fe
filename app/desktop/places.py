"""Places of the journey and what the top bar says in each."""

from __future__ import annotations

from typing import Literal

Place = Literal[
    "patients", "exercise", "camera", "markers", "live", "sessions", "review", "progress", "report", "correct",
    "agreement", "beside", "retest", "clinic", "by_hand", "board", "card", "help", "settings",
]  # fmt: skip
STEPS: tuple[Place, ...] = ("exercise", "camera", "markers", "live")
"""The set-up, in order; the top bar counts them."""
TABS: tuple[Place, ...] = ("sessions", "review", "progress", "report")
"""The views of an open patient, in the order of the tabs."""
UNDER_TABS: dict[Place, Place] = {"agreement": "review", "beside": "review", "by_hand": "progress"}
"""Places that a tab's view leads to, and that tab."""
ASIDE: tuple[Place, ...] = ("help", "settings")
"""Places beside the way: from them one comes back to where one was."""

"""Places of the journey and what the top bar says in each."""

from __future__ import annotations

from typing import Literal

Place = Literal[
    "patients", "exercise", "camera", "markers", "live", "sessions", "review", "progress", "report", "correct",
    "agreement", "retest", "help", "settings",
]  # fmt: skip
STEPS: tuple[Place, ...] = ("exercise", "camera", "markers", "live")
"""The set-up, in order; the top bar counts them."""
TABS: tuple[Place, ...] = ("sessions", "review", "progress", "report")
"""The views of an open patient, in the order of the tabs."""
ASIDE: tuple[Place, ...] = ("help", "settings")
"""Places beside the way: from them one comes back to where one was."""

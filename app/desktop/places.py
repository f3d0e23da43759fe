"""Places of the journey and what the top bar says in each."""

from __future__ import annotations

from typing import Literal

Place = Literal["patients", "exercise", "camera", "markers", "live", "review", "progress", "report", "help", "settings"]
STEPS: tuple[Place, ...] = ("exercise", "camera", "markers", "live")
"""The set-up, in order; the top bar counts them."""
TABS: tuple[Place, ...] = ("live", "review", "progress", "report")
"""The views of an open patient, in the order of the tabs."""

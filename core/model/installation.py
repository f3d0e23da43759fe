"""What an examination of this computer found, and the one place that says how what is missing is installed: from
source, and in the packed program, which has no pip."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import Literal

from carpus.core.model.phrase import Phrase, phrase

State = Literal["good", "warning", "bad"]


@dataclass(frozen=True, slots=True)
class Finding:
    """One need. ``observation`` is the fact; ``remedy`` what to do, empty when nothing is to be done."""

    name: str
    state: State
    observation: str
    remedy: str = ""


CAMERAS_EXTRA = "carpus-cameras-extra"
"""The second Debian package."""
CAMERAS_EXTRA_PACKAGES = NO_DEPENDENCY_PACKAGES = ("pyorbbecsdk2",)
"""Its own requirements (an older NumPy, a second OpenCV, Open3D, a window library) are those of its examples. With them
it would take the place of what Carpus runs on: for that reason there is no extra for it."""


def is_packed() -> bool:
    """Whether this is the program with its own Python, in which nothing can be installed."""
    return getattr(sys, "frozen", False)


def install_hint(*packages: str) -> Phrase:
    """What to do for Python packages that are missing."""
    if not is_packed():
        alone = "--no-deps " if set(packages) <= set(NO_DEPENDENCY_PACKAGES) else ""
        return phrase("Run “{command}”.", command=f"{sys.executable} -m pip install {alone}{' '.join(packages)}")
    if sys.platform.startswith("linux") and set(packages) <= set(CAMERAS_EXTRA_PACKAGES):
        return phrase("Install the package {package}, which comes beside that of Carpus.", package=CAMERAS_EXTRA)
    return phrase(
        "The packed program does without {packages}; Carpus from its source can have it.", packages=", ".join(packages)
    )

"""Findings about this computer, and how missing packages are installed.

From source by pip; the packed program has no pip.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import Literal

from carpus.core.model.phrase import Phrase, phrase

State = Literal["good", "warning", "bad"]


@dataclass(frozen=True, slots=True)
class Finding:
    """Checked requirement: the ``observation``, and a ``remedy``, empty if nothing is to be done."""

    name: str
    state: State
    observation: str
    remedy: str = ""


CAMERAS_EXTRA = "carpus-cameras-extra"
"""The second Debian package."""
CAMERAS_EXTRA_PACKAGES = ("pyorbbecsdk2", "pyrealsense2")
NO_DEPENDENCY_PACKAGES = ("pyorbbecsdk2",)
"""Their own requirements (an older NumPy, a second OpenCV, Open3D) are those of their examples and would replace what
Carpus runs on: so there is no extra for them."""


def is_packed() -> bool:
    """Return whether this is the packed program, in which nothing can be installed."""
    return getattr(sys, "frozen", False)


def install_hint(*packages: str) -> Phrase:
    """Return how to install missing Python packages."""
    if not is_packed():
        alone = "--no-deps " if set(packages) <= set(NO_DEPENDENCY_PACKAGES) else ""
        return phrase("Run “{command}”.", command=f"{sys.executable} -m pip install {alone}{' '.join(packages)}")
    if sys.platform.startswith("linux") and set(packages) <= set(CAMERAS_EXTRA_PACKAGES):
        return phrase("Install the package {package}, which is next to the Carpus package.", package=CAMERAS_EXTRA)
    return phrase(
        "The packaged program does not include {packages}. Carpus installed from source can use it.",
        packages=", ".join(packages),
    )

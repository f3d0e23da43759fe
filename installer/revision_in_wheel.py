"""Build hook: a wheel says of which revision it was built, in ``carpus/resources/revision.txt``."""

from __future__ import annotations

import subprocess
from pathlib import Path
from shutil import which
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class RevisionInWheel(BuildHookInterface):  # type: ignore[type-arg]
    """An editable install needs none: the checkout knows its revision itself."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Hatchling calls this before it builds; ``version`` is "standard" or "editable"."""
        if version == "editable":
            return
        revision = Path(self.root) / "build" / "revision.txt"
        revision.parent.mkdir(exist_ok=True)
        asked = ["git", "-C", self.root, "rev-parse", "HEAD"]
        told = subprocess.run(asked, capture_output=True, text=True, check=False) if which("git") else None
        revision.write_text(told.stdout if told is not None and not told.returncode else "", encoding="utf-8")
        build_data["force_include"][str(revision)] = "carpus/resources/revision.txt"

"""Build hook: the checkout's folders become parts of one installed package, and nothing else lands beside it."""

from __future__ import annotations

import subprocess
from pathlib import Path
from shutil import which
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

PARTS = ("app", "core", "ui", "resources")


class WheelLayout(BuildHookInterface):  # type: ignore[type-arg]
    """Lays out the wheel. An editable install needs none of it: `carpus.py` of the checkout leads to the folders."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Hatchling calls this before it builds; ``version`` is "standard" or "editable"."""
        if version == "editable":
            return
        revision = Path(self.root) / "build" / "revision.txt"
        revision.parent.mkdir(exist_ok=True)
        asked = ["git", "-C", self.root, "rev-parse", "HEAD"]
        told = subprocess.run(asked, capture_output=True, text=True, check=False) if which("git") else None
        revision.write_text(told.stdout if told is not None and not told.returncode else "", encoding="utf-8")
        build_data["force_include"] |= {str(revision): "carpus/resources/revision.txt"}
        build_data["force_include"] |= {part: f"carpus/{part}" for part in PARTS} | {
            "carpus.py": "carpus/__init__.py",
            "app/__main__.py": "carpus/__main__.py",
            "resources/py.typed": "carpus/py.typed",
        }

"""Build hook: what a wheel holds beside the checkout's files, the kernels as built and the revision it was built of."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
import sysconfig
from pathlib import Path
from shutil import which
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class InTheWheel(BuildHookInterface):  # type: ignore[type-arg]
    """An editable install takes both from the checkout, where the kernels are built for it."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Hatchling calls this before it builds; ``version`` is "standard" or "editable"."""
        kernels = self._kernels()
        if version == "editable":
            return
        for library in kernels:
            build_data["force_include"][str(library)] = f"carpus/core/kernels/{library.name}"
        if kernels:
            # Of this kind of computer, and of any Python: the libraries know none.
            build_data["pure_python"] = False
            build_data["tag"] = "py3-none-" + sysconfig.get_platform().replace("-", "_").replace(".", "_")
        revision = Path(self.root) / "build" / "revision.txt"
        revision.parent.mkdir(exist_ok=True)
        asked = ["git", "-C", self.root, "rev-parse", "HEAD"]
        told = subprocess.run(asked, capture_output=True, text=True, check=False) if which("git") else None
        revision.write_text(told.stdout if told is not None and not told.returncode else "", encoding="utf-8")
        build_data["force_include"][str(revision)] = "carpus/resources/revision.txt"

    def _kernels(self) -> list[Path]:
        """The libraries; none where there is no compiler or it fails: that wheel is for every computer, and slow."""
        place = Path(self.root) / "carpus/core/kernels/build.py"
        spec = importlib.util.spec_from_file_location("build_kernels", place)
        assert spec is not None
        assert spec.loader is not None
        build = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(build)
        try:
            return list(build.built())
        except (OSError, RuntimeError) as fault:
            print(f"the kernels are left out: {fault}", file=sys.stderr)
            return []

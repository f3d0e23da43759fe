"""What is drawn knows no device, no filter and no file: none is loaded with it, not even indirectly. Flows, and what
they share, work on what is stored; that they know no device and no filter either, import-linter holds."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def loaded_by(modules: list[str]) -> set[str]:
    program = "import importlib, sys\n" + "".join(f"importlib.import_module({name!r})\n" for name in modules)
    program += "print('\\n'.join(sys.modules))"
    done = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True)
    return set(done.stdout.split())


PLOTTING = re.compile(r"^\s*(?:import|from)\s+pyqtgraph\b", re.MULTILINE)


def test_pyqtgraph_is_imported_by_charts_only() -> None:
    sources = [path for part in ("app", "core", "ui") for path in sorted((ROOT / part).rglob("*.py"))]
    users = {path.relative_to(ROOT).parent for path in sources if PLOTTING.search(path.read_text(encoding="utf-8"))}
    assert users == {Path("ui/charts")}


def test_pyqtgraph_is_loaded_when_a_plot_is_shown_not_when_the_window_opens() -> None:
    """It takes a quarter of a second."""
    loaded = loaded_by(["carpus.app.compose", "carpus.ui.screens.patients.flow"])
    assert "carpus.ui.screens.patients.flow" in loaded
    assert "pyqtgraph" not in loaded

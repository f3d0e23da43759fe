"""What is drawn knows no device, no filter and no file: none is loaded with it, not even indirectly. Flows, and what
they share, work on what is stored; that they know no device and no filter either, import-linter holds."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
CORE = ("capture", "detection", "tracking", "simulation", "pipeline.live", "pipeline.recorder", "session.reader",
        "session.writer", "records.store", "calibration.calibrate")  # fmt: skip
FORBIDDEN = ("h5py", "sqlite3", "sqlalchemy", "numba", *(f"carpus.core.{name}" for name in CORE))
SHARED = {
    "shell/flow.py", "shell/recent_locations.py", "shell/camera_state.py", "shell/camera_session.py",
    "shell/messages.py", "screens/records/backup.py", "screens/records/deletion.py",
    "screens/records/record_lists.py", "screens/records/lock.py",
}  # fmt: skip
"""What flows share; beside it the ``flow.py`` of each room, and what it reads from the disk, ``NAME_store.py``."""


def loaded_by(modules: list[str]) -> set[str]:
    program = "import importlib, sys\n" + "".join(f"importlib.import_module({name!r})\n" for name in modules)
    program += "print('\\n'.join(sys.modules))"
    done = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True)
    return set(done.stdout.split())


def test_screens_load_no_device_filter_or_file_code() -> None:
    paths = {path.relative_to(ROOT / "ui").as_posix() for path in (ROOT / "ui").rglob("*.py")}
    assert paths >= SHARED
    drawn = sorted(path for path in paths - SHARED if not path.endswith(("/flow.py", "_store.py")))
    names = ["carpus.ui." + path.removesuffix(".py").replace("/", ".") for path in drawn]
    loaded = loaded_by(names)
    assert "carpus.ui.screens.live.screen" in loaded
    assert not {name for name in loaded if any(name == part or name.startswith(part + ".") for part in FORBIDDEN)}


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

"""The windows know no device, no filter and no file: none is loaded with them, not even indirectly."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
FORBIDDEN = (
    "h5py", "sqlite3", "numba", "pyqtgraph", "core.capture", "core.detection", "core.tracking", "core.simulation",
    "core.pipeline.live", "core.pipeline.recorder", "core.session.reader", "core.session.writer",
    "core.session.register", "core.calibration.calibrate",
)  # fmt: skip
PRINTING = ("ui.report.pdf", "core.output.report_content")
"""What ``carpus report`` needs must not bring widgets with it."""


def loaded_by(modules: list[str]) -> set[str]:
    program = "import importlib, sys\n" + "".join(f"importlib.import_module({name!r})\n" for name in modules)
    program += "print('\\n'.join(sys.modules))"
    done = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True)
    return set(done.stdout.split())


def test_windows_load_no_device_filter_or_file_code() -> None:
    names = [".".join(path.relative_to(ROOT).with_suffix("").parts) for path in sorted((ROOT / "ui").rglob("*.py"))]
    loaded = loaded_by(names)
    assert "ui.live.screen" in loaded
    assert not {name for name in loaded if any(name == part or name.startswith(part + ".") for part in FORBIDDEN)}


def test_printing_loads_no_widgets() -> None:
    assert "PySide6.QtWidgets" not in loaded_by(list(PRINTING))

"""Time to the first usable window: a start of the program until its first screen has the keyboard, in a new process."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

WANTED_S = 1.0
STARTS = 5
CHILD = """
import resource, sys, time
begun = time.perf_counter()
sys.argv[0] = "carpus"
from carpus.app.__main__ import main  # what the command loads first
import gc
gc.disable()  # as the command does
from pathlib import Path
from carpus.app import compose
from carpus.app.desktop.single_instance import SingleInstance
from carpus.app.desktop.appearance import create_application
from carpus.app.settings import load_valid_settings, with_data_folder
loaded, told = load_valid_settings()
settings = with_data_folder(loaded, Path(sys.argv[1]))
qt = create_application(["carpus"])
alone = SingleInstance(settings.data_folder)
alone.acquire()
desktop = compose.compose(qt, settings, startup_faults=told)
desktop.show()
while not desktop.shell.isVisible() or desktop.shell.focusWidget() is None:
    qt.processEvents()
qt.processEvents()
print(time.perf_counter() - begun, time.process_time(), flush=True)
desktop.close()
alone.release()
"""


def report() -> Iterator[str]:
    """The table; the first start, which may be cold, is not counted."""
    yield "Start to the first usable window (a new process each, after one that warms the disk's cache):"
    walls, processors = [], []
    with tempfile.TemporaryDirectory() as folder:
        # Compiled once, as where it is installed, also where the environment forbids it beside the sources.
        environment = {**os.environ, "CARPUS_DATA": folder, "PYTHONPYCACHEPREFIX": str(Path(folder, "compiled"))}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        command = [sys.executable, "-c", CHILD, folder]
        for number in range(STARTS + 1):
            root = Path(__file__).parents[2]
            done = subprocess.run(command, env=environment, cwd=root, check=True, capture_output=True, text=True)
            wall_s, cpu_s = map(float, done.stdout.split()[-2:])
            if number:
                walls.append(wall_s)
                processors.append(cpu_s)
    yield f"wall {statistics.median(walls):.2f} s (least {min(walls):.2f}), CPU {statistics.median(processors):.2f} s"
    yield f"{WANTED_S} s were wanted, without the {sys.implementation.name} interpreter's own start"

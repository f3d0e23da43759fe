"""The journey once in a real window, on a virtual X display, by real mouse and key events."""

from __future__ import annotations

import os
import queue
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.journeys.takes import RANGE_DEG
from tests.ui.printed import read_words

ROOT = Path(__file__).parents[2]
PATIENCE_S = 60.0
HASTY_S = 3.5
pytestmark = [pytest.mark.window, pytest.mark.timeout(300)]


def tool(name: str) -> str:
    path = shutil.which(name)
    assert path is not None, f"{name} is needed; make test installs it"
    return path


@pytest.fixture
def display(tmp_path: Path) -> Iterator[str]:
    """A virtual screen of 1280x800, its number chosen by the server itself."""
    reading, writing = os.pipe()
    server = subprocess.Popen(
        [tool("Xvfb"), "-displayfd", str(writing), "-screen", "0", "1280x800x24", "-nolisten", "tcp"],
        pass_fds=[writing],
        stderr=subprocess.DEVNULL,
    )
    os.close(writing)
    with os.fdopen(reading) as numbers:
        number = numbers.readline().strip()
    assert number, "Xvfb did not start"
    yield f":{number}"
    server.terminate()
    server.wait(PATIENCE_S)


class Person:
    """Sees what the application says it shows, and uses the keyboard and the mouse of the display."""

    def __init__(self, display: str, take: Path, data: Path) -> None:
        self._environment = {**os.environ, "DISPLAY": display, "QT_QPA_PLATFORM": "xcb"}
        command = [sys.executable, "-m", "tests.journeys.window_app", str(take), str(data)]
        self.process = subprocess.Popen(
            command, cwd=ROOT, env=self._environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        self._lines: queue.Queue[str] = queue.Queue()
        self._threads = [threading.Thread(target=self._read), threading.Thread(target=self._read_faults)]
        self.faults = ""
        for thread in self._threads:
            thread.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._lines.put(line.strip())

    def _read_faults(self) -> None:
        self.faults = self.process.stderr.read()

    def sees(self, wanted: str) -> str:
        """Wait for a line that begins so; a fault told meanwhile fails the test."""
        return self.sees_all(wanted)[-1]

    def sees_all(self, wanted: str) -> list[str]:
        """The lines up to the wanted one."""
        lines: list[str] = []
        end_s = time.monotonic() + PATIENCE_S
        while not (lines and lines[-1].startswith(wanted)):
            with suppress(queue.Empty):
                lines.append(self._lines.get(timeout=max(0.0, end_s - time.monotonic())))
                assert not lines[-1].startswith("fault"), lines[-1]
                continue
            raise AssertionError(f"never saw “{wanted}” after {lines}; {self.faults}")
        return lines

    def use(self, *arguments: str) -> None:
        """One xdotool command."""
        subprocess.run([tool("xdotool"), *arguments], env=self._environment, check=True, timeout=PATIENCE_S)

    def press(self, *keys: str) -> None:
        self.use("key", "--delay", "30", *keys)

    def click(self, x: int, y: int) -> None:
        self.use("mousemove", "--sync", str(x), str(y), "click", "1")

    def leave(self) -> int:
        """End the program as a log-out does (no window manager is here whose cross could be clicked)."""
        self.process.terminate()
        return self._end()

    def _end(self) -> int:
        code = self.process.wait(PATIENCE_S)
        for thread in self._threads:
            thread.join(PATIENCE_S)
        for pipe in (self.process.stdout, self.process.stderr):
            if pipe is not None:
                pipe.close()
        return code

    def kill(self) -> None:
        """Whatever happened, nothing is left."""
        if self.process.poll() is None:
            self.process.kill()
        self._end()


@pytest.fixture
def person(display: str, take: Path, tmp_path: Path) -> Iterator[Person]:
    person = Person(display, take, tmp_path / "data")
    yield person
    person.kill()


def test_person_measures_in_real_window(person: Person, tmp_path: Path) -> None:
    person.sees("started")
    person.sees("place patients")
    person.use("search", "--sync", "--onlyvisible", "--name", "^Carpus$", "windowfocus", "--sync")
    person.use("type", "--delay", "30", "practice")
    person.press("Return")
    person.sees("place markers")
    person.press("space")
    discs = [line.split()[1:] for line in person.sees_all("discs told") if line.startswith("disc ")]
    assert len(discs) == 6
    for x, y in discs:
        person.click(int(x), int(y))
    person.sees("ready to start")
    person.press("Return")
    person.sees("place live")
    person.press("space")
    person.sees("recording")
    person.press("F5")
    person.use("type", "--delay", "30", "strap loose")
    person.press("Return")
    person.sees("repeated")
    time.sleep(HASTY_S)  # an end within the first seconds asks
    person.press("space")
    session = Path(person.sees("session ").removeprefix("session "))
    person.sees("place review")
    person.press("ctrl+p")
    person.sees("place report")
    pdf = tmp_path / "real.pdf"
    person.press("ctrl+p")
    person.use("search", "--sync", "--onlyvisible", "--name", "^Save report$", "windowfocus", "--sync")
    person.press("ctrl+a")
    person.use("type", "--delay", "5", str(pdf))
    person.press("Return")
    assert person.sees("saved ") == f"saved {pdf}"
    assert person.leave() == 0
    assert "Traceback" not in person.faults
    assert "strap loose" in read_words(pdf)
    with h5py.File(session) as file:
        assert "strap loose" in file["events/text"].asstr()[:].tolist()
        assert file.attrs["complete"]
        tracked = file["frames/status"][:] == 0
        flexion_deg = np.degrees(file["wrist/angles"][:, 1])[tracked]
    assert flexion_deg.max() == pytest.approx(0.97 * RANGE_DEG, abs=4.0)
    assert flexion_deg.min() == pytest.approx(-0.97 * RANGE_DEG, abs=4.0)

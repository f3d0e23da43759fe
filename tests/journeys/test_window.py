"""The journey once in a real window, on a virtual X display, by real mouse and key events."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.journeys.takes import RANGE_DEG
from tests.ui.printed import read_words

ROOT = Path(__file__).parents[2]
PATIENCE_S = 60.0
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

    def __init__(self, display: str, take: Path, folder: Path) -> None:
        self._environment = {**os.environ, "DISPLAY": display, "QT_QPA_PLATFORM": "xcb"}
        self._said, self.faults, self._seen = folder / "said", folder / "faults", 0
        command = [sys.executable, "-m", "tests.journeys.window_app", str(take), str(folder / "data")]
        with self._said.open("w") as said, self.faults.open("w") as faults:
            self.process = subprocess.Popen(command, cwd=ROOT, env=self._environment, stdout=said, stderr=faults)

    def sees(self, wanted: str) -> list[str]:
        """The next lines up to one that begins so; a fault told meanwhile fails the test."""
        end_s, lines = time.monotonic() + PATIENCE_S, list[str]()
        while time.monotonic() < end_s:
            lines = self._said.read_text().split("\n")[self._seen : -1]
            assert not any(line.startswith("fault") for line in lines), lines
            for number, line in enumerate(lines, 1):
                if line.startswith(wanted):
                    self._seen += number
                    return lines[:number]
            time.sleep(0.05)
        raise AssertionError(f"never saw “{wanted}” after {lines}; {self.faults.read_text()}")

    def use(self, *arguments: str) -> None:
        """One xdotool command."""
        subprocess.run([tool("xdotool"), *arguments], env=self._environment, check=True, timeout=PATIENCE_S)

    def press(self, *keys: str) -> None:
        self.use("key", "--delay", "30", *keys)


@pytest.fixture
def person(display: str, take: Path, tmp_path: Path) -> Iterator[Person]:
    person = Person(display, take, tmp_path)
    yield person
    person.process.kill()  # whatever happened, nothing is left
    person.process.wait(PATIENCE_S)


def test_person_measures_in_real_window(person: Person, tmp_path: Path) -> None:
    person.sees("started")
    person.sees("place patients")
    person.use("search", "--sync", "--onlyvisible", "--name", "^Carpus$", "windowfocus", "--sync")
    person.use("type", "--delay", "30", "practice")
    person.press("Return")
    person.sees("place markers")
    person.press("space")
    discs = [line.split()[1:] for line in person.sees("discs told") if line.startswith("disc ")]
    assert len(discs) == 6
    for place in discs:
        person.use("mousemove", "--sync", *place, "click", "1")
    person.sees("ready to start")
    person.press("Return")
    person.sees("place live")
    person.press("space")
    person.sees("recording")
    person.press("F5")
    person.use("type", "--delay", "30", "strap loose")
    person.press("Return")
    person.sees("repeated")
    person.press("space")
    session = Path(person.sees("session ")[-1].removeprefix("session "))
    person.sees("place review")
    person.press("ctrl+p")
    person.sees("place report")
    pdf = tmp_path / "real.pdf"
    person.press("ctrl+p")
    person.use("search", "--sync", "--onlyvisible", "--name", "^Save report$", "windowfocus", "--sync")
    person.press("ctrl+a")
    person.use("type", "--delay", "5", str(pdf))
    person.press("Return")
    assert person.sees("saved ")[-1] == f"saved {pdf}"
    person.process.terminate()  # as a log-out does: no window manager is here whose cross could be clicked
    assert person.process.wait(PATIENCE_S) == 0
    assert "Traceback" not in person.faults.read_text()
    assert "strap loose" in read_words(pdf)
    with h5py.File(session) as file:
        assert "strap loose" in file["events/text"].asstr()[:].tolist()
        assert file.attrs["complete"]
        tracked = file["frames/status"][:] == 0
        flexion_deg = np.degrees(file["wrist/angles"][:, 1])[tracked]
    assert flexion_deg.max() == pytest.approx(0.97 * RANGE_DEG, abs=4.0)
    assert flexion_deg.min() == pytest.approx(-0.97 * RANGE_DEG, abs=4.0)

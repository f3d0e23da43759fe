"""A kill at each write, sync, link, rename and unlink of a recording, of its recovery and of its publishing.

``python -m tests.torture.write_kills FOLDER [--every N] [--random N]``; it runs itself again with ``steps.c`` loaded.
Each kind does its work in a forked process that is ended at step 1, 2, ... of it; what the next start of the program
finds is then compared with every row that had been synchronised, and with what had been measured.
"""

from __future__ import annotations

import argparse
import ctypes
import mmap
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from carpus.core.capture.files.raw import RawRecording, RawWriter
from carpus.core.capture.source import SourceInfo
from carpus.core.model.types import Frame
from carpus.core.pipeline.measurement import RecordedSession
from carpus.core.records.recordings import publish_session, recover_recordings
from carpus.core.session.reader import READING_PROCESS
from carpus.core.session.session_file import read_session, verify
from carpus.core.session.values import stack_states
from tests.session.samples import CAMERA, compute_time, make_frame, write_journal

ROOT = Path(__file__).parents[2]
SOURCE = Path(__file__).with_name("steps.c")
KINDS = ("record", "record on a share", "recover", "recover on a share")
ROWS, BATCH, SMOOTHED = 60, 12, 24
PICTURE = np.zeros((48, 64, 3), np.uint8)


def build(folder: Path) -> Path:
    """The library that counts steps."""
    library = folder / "steps.so"
    command = [os.environ.get("CC", "cc"), "-O1", "-shared", "-fPIC", "-o", str(library), str(SOURCE), "-ldl"]
    subprocess.run(command, check=True)
    return library


class Looked:
    """In the place of the looking back: the smoother's result of a part at once, of the rest at the end."""

    def __init__(self) -> None:
        self.has_results = True

    def pop_smoothed(self, timestamp_s: list[float]) -> object:
        if len(timestamp_s) < SMOOTHED:
            return None
        self.has_results = False
        return stack_states([make_frame(row) for row in range(SMOOTHED)])

    def finish(self, timestamp_s: list[float]) -> object:
        rows = len(timestamp_s)
        return stack_states([make_frame(row) for row in range(ROWS - rows, ROWS)])

    def cancel(self) -> None:
        """Nothing runs."""


def record(place: Path, home: Path, synced: mmap.mmap) -> None:
    """A whole recording, from its beginning into the data folder; how many rows are synchronised is noted."""
    journal = write_journal(place / "s.journal")
    session = RecordedSession(journal, Looked())  # type: ignore[arg-type]
    info = SourceInfo("x", replace(CAMERA, width_px=64, height_px=48), False, None, 30.0, {})
    pictures = RawWriter(place / "s.carpusraw", info)
    for row in range(ROWS):
        session.append(make_frame(row))
        pictures.append_frame(Frame(row, compute_time(row), PICTURE, None, 1e-3))
        if row == BATCH // 2:
            session.add_event(compute_time(row), "pain", "it hurts")
        if row % BATCH == BATCH - 1:
            journal.flush()
            synced[:8] = struct.pack("<q", row + 1)
    session.prepare()
    session.add_event(compute_time(ROWS - 1), "note", "at the end")
    session.close()
    pictures.close()
    publish_session(session.path, home)


def recover(place: Path, home: Path, _synced: mmap.mmap) -> None:
    """What the start of the program does with what lies in a folder."""
    found = recover_recordings(place)
    assert found.faults == (), found.faults
    assert found.in_progress == ()
    for path in sorted(place.glob("*.h5")):
        publish_session(path, home)


def check(place: Path, home: Path, rows: int) -> int:
    """After the recovery: one session with all of the rows that were synchronised, and no other; how many it has."""
    hidden = [path for path in home.iterdir() if path.suffix == ".tmp"]
    assert len(hidden) <= 1, "a share keeps one file in the making at most"
    left = sorted(path.name for path in place.iterdir() if path.suffix != ".carpusraw")
    assert left == [], left
    found = sorted(home.glob("*.h5"))
    if not found:
        assert rows == 0, f"{rows} rows are lost"
        return 0
    assert [path.name for path in found] == ["s.h5"], found
    assert verify(found[0]).has_checksum
    session = read_session(found[0])
    count = len(session)
    assert rows <= count <= ROWS, f"{count} of {rows} rows"
    frames = [make_frame(row) for row in range(count)]
    np.testing.assert_array_equal(session.timestamp_s, [frame.timestamp_s for frame in frames])
    np.testing.assert_array_equal(session.motion.angles_rad, [frame.kinematics.angles_rad for frame in frames])
    np.testing.assert_array_equal(session.markers.measured_px, [frame.marker_measured_px for frame in frames])
    if count > BATCH:
        assert "it hurts" in [event.text for event in session.events]
    if session.smoothed is not None:
        np.testing.assert_array_equal(session.smoothed.angles_rad, [frame.kinematics.angles_rad for frame in frames])
    assert session.repetitions is not None
    if (home / "s.carpusraw").exists():
        assert sum(1 for _ in RawRecording(home / "s.carpusraw").frames()) >= min(rows, ROWS)
    return count


def _no_links(*_: object, **__: object) -> None:
    raise OSError(18, "another disk")


def _interrupted(folder: Path) -> None:
    journal = write_journal(folder / "s.journal", ROWS)
    journal.add_event(compute_time(1), "pain", "it hurts")
    journal.close()


def kill_at_each_step(kind: str, folder: Path, every: int = 1) -> str:
    """One line: how many steps there are, and how many kills lost nothing. Raises AssertionError where one did."""
    library = ctypes.CDLL(os.environ["LD_PRELOAD"])
    library.count_steps.restype = ctypes.c_long
    work = record if kind.startswith("record") else recover
    counts: dict[int, int] = {}
    kills, step = 0, 1 + os.getpid() % every
    while True:
        place, home = folder / f"{step}", folder / f"{step}-home"
        place.mkdir(parents=True)
        home.mkdir()
        if work is recover:
            _interrupted(place)

        def arm(at: int = step) -> Callable[[], int]:
            library.arm_steps(at)
            return library.count_steps  # type: ignore[no-any-return]

        ended, rows = run_killed(work, (place, home), arm, "share" in kind)
        if work is recover:
            rows = ROWS
        try:
            recover(place, home, mmap.mmap(-1, 8))
            count = check(place, home, rows)
        except AssertionError as cause:
            raise AssertionError(f"{kind}, killed at step {step}: {cause}") from cause
        counts[count] = counts.get(count, 0) + 1
        shutil.rmtree(place)
        shutil.rmtree(home)
        if ended:
            break
        kills, step = kills + 1, step + every
    return f"kill at each step, {kind}: {kills} kills in {ended} steps, nothing lost; rows {counts}"


def run_killed(
    work: Callable[[Path, Path, mmap.mmap], None],
    where: tuple[Path, Path],
    arm: Callable[[], Callable[[], int]],
    on_share: bool,
) -> tuple[int, int]:
    """How many steps the work in a process of its own took to its end, 0 where it was killed before; and how many rows
    it had synchronised."""
    synced = mmap.mmap(-1, 16)
    process = os.fork()
    if process == 0:
        try:
            if on_share:
                os.link = _no_links  # type: ignore[assignment]
            count_steps = arm()
            work(*where, synced)
            synced[8:] = struct.pack("<q", count_steps())
            os._exit(0)
        except BaseException as cause:
            os.write(2, f"{type(cause).__name__}: {cause}\n".encode())
            os._exit(1)
    _, status = os.waitpid(process, 0)
    assert not os.WIFEXITED(status) or os.WEXITSTATUS(status) == 0, "the work itself failed"
    rows, steps = struct.unpack("<qq", synced[:])
    return steps if os.WIFEXITED(status) else 0, rows


def kill_at_random(count: int, folder: Path) -> str:
    """As many kills by the clock, of recordings and of recoveries that go on where the one before was killed."""

    def arm(most_s: float) -> Callable[[], int]:
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_REAL, chance.uniform(1e-6, most_s))
        return lambda: 1

    chance, lost = random.Random(46), 0
    for number in range(count):
        place, home = folder / f"r{number}", folder / f"r{number}-home"
        place.mkdir(parents=True)
        home.mkdir()
        chance.random()  # the forked process draws from a copy
        _, rows = run_killed(record, (place, home), lambda: arm(0.35), False)
        for _ in range(2):
            chance.random()
            run_killed(recover, (place, home), lambda: arm(0.1), False)
        recover(place, home, mmap.mmap(-1, 8))
        lost += check(place, home, rows) < rows
        shutil.rmtree(place)
        shutil.rmtree(home)
    return f"{count} recordings killed at random, and their recovery twice: {lost} lost a row"


def lines(every: int, count: int, folder: Path) -> list[str]:
    """All kinds, in a process of its own with the library loaded. Raises CalledProcessError where rows were lost."""
    folder.mkdir(parents=True, exist_ok=True)
    command = [sys.executable, "-m", "tests.torture.write_kills", str(folder), "--every", str(every)]
    command += ["--random", str(count)]
    environment = {**os.environ, "LD_PRELOAD": str(build(folder))}
    done = subprocess.run(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout.splitlines()


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--random", type=int, default=0)
    told = parser.parse_args()
    if "LD_PRELOAD" not in os.environ:
        print("\n".join(lines(told.every, told.random, told.folder)))
        return
    # Its own files only: with a fork after others are open there is nothing else to close.
    with tempfile.TemporaryDirectory(dir=told.folder) as name:
        _warm(Path(name))
        for kind in KINDS:
            print(kill_at_each_step(kind, Path(name) / kind, told.every), flush=True)
        if told.random:
            print(kill_at_random(told.random, Path(name) / "random"), flush=True)
    READING_PROCESS.end()


def _warm(folder: Path) -> None:
    """What is loaded once is loaded before."""
    (folder / "home").mkdir()
    (folder / "place").mkdir()
    record(folder / "place", folder / "home", mmap.mmap(-1, 8))


if __name__ == "__main__":
    main()

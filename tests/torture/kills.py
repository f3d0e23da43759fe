"""Kills at random moments: of the program, of the capture process, of the process that looks back."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import time
from pathlib import Path

from carpus.core.capture.files.raw import RawRecording
from carpus.core.records.recordings import recover_recordings
from carpus.core.session.reader import read_session, verify

ROOT = Path(__file__).parents[2]
KINDS = ("program", "program with pictures", "looking back", "capture", "clock set back and forth", "two programs")
MOST_LOST_S = 1.0


def kill_once(kind: str, number: int, folder: Path) -> float:
    """One recording, one kill; how many seconds of rows it lost. Raises AssertionError where what must hold does not.

    How much of raw pictures is lost depends on the computer: they wait for a busy processor to pack them.
    """
    folder.mkdir(parents=True)
    chance = random.Random(number)
    told = [sys.executable, "-m", "tests.torture.recorder", str(folder)]
    if kind == "program with pictures" or (kind == "looking back" and number % 2 == 0):
        told.append("--raw")
    if kind == "capture":
        told.append("--played")
    if kind == "clock set back and forth":
        told.append("--jumping-clock")
    after_s = chance.uniform(0.3, 3.0)
    whole = kind in ("capture", "looking back")
    if kind == "looking back":
        told += ["--seconds", "4"]
    with subprocess.Popen(told, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
        assert program.stdout.readline() == "begun\n", program.stderr.read()
        time.sleep(after_s)
        if kind == "two programs":
            assert recover_recordings(folder).recovered == (), "a second program finished what the first is recording"
        if whole:
            for child in json.loads((folder / "children").read_text()):
                os.kill(child, signal.SIGKILL)
            _said, complaint = program.communicate(timeout=120)
            assert program.returncode == 0, complaint
            assert "Traceback" not in complaint, complaint
        else:
            program.send_signal(signal.SIGKILL)
    taken = (folder / "taken").read_bytes()
    if not taken:  # killed before the first frame: there is nothing to lose
        assert not whole
        shutil.rmtree(folder)
        return 0.0
    (last_s, _) = struct.unpack("<dq", taken)
    if not whole:
        assert not list(folder.glob("*.h5"))
        recovery = recover_recordings(folder)
        assert recovery.faults == (), recovery.faults
        assert recovery.in_progress == ()
        if recovery.empty:
            return float(last_s - 10.0)
    session = read_session(folder / "s.h5")
    assert bool(session.recovered) != whole
    assert verify(folder / "s.h5").has_checksum
    if kind == "looking back":
        assert session.smoothed is None or len(session.smoothed.angles_rad) == len(session)
    assert "--raw" not in told or any(True for _ in RawRecording(folder / "s.carpusraw").frames())
    shutil.rmtree(folder)
    return max(last_s - float(session.timestamp_s[-1]), 0.0)

"""What every command does with wrong usage, closed streams, signals and full disks: a sentence, never a traceback."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from itertools import islice
from pathlib import Path
from subprocess import PIPE

import pytest

from carpus.core.capture.camera_info import CAMERA_FILE
from carpus.core.capture.files.tum import COLOR_LIST, TumFolder
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.session.reader import read_session
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from carpus.core.simulation.recording import CLICKS_FILE
from tests.capture.oni_writer import convert_to_millimetres, write_oni
from tests.commands import Command
from tests.rendered import FLEXION, Rendered
from tests.session.samples import CAMERA, make_calibration

ROOT = Path(__file__).parents[2]
COMMAND = (sys.executable, "-m", "carpus")


@pytest.fixture(scope="module")
def recording(rendered: Rendered) -> Path:
    return rendered(FLEXION)


@pytest.fixture
def session(tmp_path: Path) -> Path:
    path = tmp_path / "session.h5"
    header = new_header(hand="right", protocol=WRIST6)
    SessionWriter.create(path, header, CAMERA, make_calibration(WRIST6)).close()
    return path


def buffer_output() -> dict[str, str]:
    """The environment of a child that keeps its output in hand for a while, as it does at a user's."""
    return {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}


def hear_all() -> None:
    """In a child: stop on what a terminal would send, also where these tests were started by nohup or aside."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def ignore_all() -> None:
    """In a child: as nohup and a job in the background start it."""
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)


def signalled(
    words: Sequence[str | Path], when: Callable[[], bool], *numbers: int, prepare: Callable[[], None] = hear_all
) -> tuple[int, str]:
    """Exit code and messages of a process that gets signals when something is so."""
    with subprocess.Popen(words, cwd=ROOT, stderr=PIPE, text=True, preexec_fn=prepare) as process:
        while not when():
            assert process.poll() is None
            time.sleep(0.02)
        for number in numbers:
            process.send_signal(number)
        said = process.communicate(timeout=120)[1]
    return process.returncode, said


def linked(recording: Path, copy: Path, without: str) -> Path:
    """A recording but for one thing in it."""
    copy.mkdir()
    for path in recording.iterdir():
        if path.name != without:
            (copy / path.name).symlink_to(path)
    return copy


def track_file(
    command: Command, recording: Path, output: Path, *options: str, clicks: Path | None = None
) -> tuple[int, str]:
    """Exit code and messages of ``carpus track``."""
    done = command("track", recording, "--calibration", clicks or recording / CLICKS_FILE, "--output", output, *options)
    return done.code, done.err


def test_tracking_says_what_of_the_camera_is_assumed(recording: Path, tmp_path: Path, command: Command) -> None:
    """Before anything is tracked, which here has no clicks."""
    none = tmp_path / "none.json"
    copy = linked(recording, tmp_path / "copy", CAMERA_FILE)
    assert CAMERA_FILE in track_file(command, copy, tmp_path / "a.h5", clicks=none)[1]
    source, path = TumFolder(recording), tmp_path / "r.oni"
    write_oni(path, convert_to_millimetres(islice(source.frames(), 3)), source.info.camera, color="jpeg")
    for sidecar in tmp_path.glob("*.yaml"):
        sidecar.unlink()
    assert "depth and colour are aligned" in track_file(command, path, tmp_path / "s.h5", clicks=none)[1]


@pytest.mark.parametrize("asked", ["info SESSION", "track --help"])
def test_full_disk_under_output_is_reported(asked: str, session: Path) -> None:
    words = (*COMMAND, *asked.replace("SESSION", str(session)).split())
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        ended = subprocess.run(words, cwd=ROOT, env=buffer_output(), stdout=full, stderr=PIPE, check=False, text=True)
    assert ended.returncode == 1
    assert ended.stderr.startswith("carpus: ")
    assert ended.stderr.count("\n") == 1
    assert "No space left" in ended.stderr
    assert "unforeseen" not in ended.stderr


@pytest.mark.parametrize(("asked", "unbuffered"), [("info SESSION", "1"), ("track --help", "")])
def test_output_closed_by_its_reader_ends_quietly(asked: str, unbuffered: str, session: Path) -> None:
    """As `carpus info FILE | head -1`, with a head that has gone before the first line comes."""
    reading, writing = os.pipe()
    os.close(reading)
    words = (*COMMAND, *asked.replace("SESSION", str(session)).split())
    environment = buffer_output() | ({"PYTHONUNBUFFERED": unbuffered} if unbuffered else {})
    ended = subprocess.run(words, cwd=ROOT, env=environment, stdout=writing, stderr=PIPE, check=False, text=True)
    os.close(writing)
    assert (ended.returncode, ended.stderr) == (1, "")


def test_signal_ignored_by_parent_stays_ignored(tmp_path: Path) -> None:
    """A rendering in the background outlives the Ctrl+C meant for another job, and the end of its terminal."""
    folder = tmp_path / "rendered"
    words = (*COMMAND, "simulate", "--output", folder, "--seconds", "0.4")
    code, said = signalled(
        words, lambda: any(folder.glob("rgb/*.png")), signal.SIGINT, signal.SIGHUP, prepare=ignore_all
    )
    assert (code, "stopped" in said) == (0, False)
    assert (folder / COLOR_LIST).exists()


def test_stopped_while_tracking_leaves_no_part(recording: Path, tmp_path: Path) -> None:
    """What can be tracked again is not kept by halves."""
    words = ["track", str(recording), "--calibration", str(recording / CLICKS_FILE), "--output", str(tmp_path / "s.h5")]
    slow = "import time\nfrom pathlib import Path\nfrom carpus.app.__main__ import main\n"
    slow += "from carpus.core.session.writer import SessionWriter\nappend = SessionWriter.append\n"
    slow += f"def slowly(*a):\n    Path({str(tmp_path)!r}, 'begun').touch()\n    time.sleep(0.5)\n    append(*a)\n"
    slow += f"SessionWriter.append = slowly\nraise SystemExit(main({words!r}))\n"
    ended = signalled([sys.executable, "-c", slow], (tmp_path / "begun").exists, signal.SIGINT)
    assert ended == (1, "carpus: stopped.\n")
    assert not (tmp_path / "s.h5").exists()
    assert not list(tmp_path.glob(".*.tmp"))


def test_damaged_raw_recording_is_reported(recording: Path, tmp_path: Path, command: Command) -> None:
    path = tmp_path / "r.carpusraw"
    assert command("record", "--from", recording, "--output", path).code == 0
    data = path.read_bytes()
    third = [place.start() for place in re.finditer(b"FRAM", data)][2]

    def said(content: bytes) -> tuple[int, str]:
        path.write_bytes(content)
        done = command("verify", path)
        return done.code, done.out + done.err

    count = TumFolder(recording).info.frame_count
    assert said(data) == (0, f"Complete: {path} ({count} frames).\n")
    code, cut = said(data[: third + 100])
    assert (code, cut) == (0, f"Cut short, complete up to there: {path} (2 frames).\n")
    for letters in (b"fRAM", b""):  # a record that is not seen as one
        code, damaged = said(data[:third] + letters + data[third + 4 :])
        assert (code, f"1 of {count} frames" in damaged) == (1, True)
    code, longer = said(data + b"hello")
    assert (code, "damaged" in longer) == (1, True)


def test_damaged_frames_raise_or_are_skipped_and_reported(recording: Path, tmp_path: Path, command: Command) -> None:
    copy, output = tmp_path / "copy", tmp_path / "session.h5"
    shutil.copytree(recording, copy)
    color = sorted((copy / "rgb").iterdir())
    color[4].write_text("no picture")
    color[7].unlink()
    assert "1 colour missing" in command("info", copy).err
    code, said = track_file(command, copy, output)
    assert (code, color[7].name in said) == (1, True)
    assert not output.exists()
    code, said = track_file(command, copy, output, "--leave-out-damaged")
    assert (code, "1 colour damaged" in said, CAMERA_FILE in said) == (0, True, False)
    session = read_session(output)
    assert len(session) == len(color) - 2
    assert session.quality.dropped_before.sum() == 2
    assert session.header.is_simulated

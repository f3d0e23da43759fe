"""What every command does with wrong usage, closed streams, signals and full disks: a sentence, never a traceback."""

from __future__ import annotations

import io
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from functools import partial
from itertools import islice
from pathlib import Path
from subprocess import PIPE

import cv2
import pytest
from tqdm import tqdm

from carpus.app import command_line
from carpus.core.capture.camera_info import CAMERA_FILE
from carpus.core.capture.files.tum import COLOR_LIST, TumFolder, TumWriter
from carpus.core.model.errors import DiskFull
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import Frame
from carpus.core.session.reader import read_session
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from carpus.core.simulation.recording import CLICKS_FILE, TRUTH_FILE
from carpus.core.simulation.spec import RecordingSpec
from tests.capture.oni_writer import in_millimetres, write_oni
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


def buffered() -> dict[str, str]:
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


def tracked(
    command: Command, recording: Path, output: Path, *options: str, clicks: Path | None = None
) -> tuple[int, str]:
    """Exit code and messages of ``carpus track``."""
    done = command("track", recording, "--calibration", clicks or recording / CLICKS_FILE, "--output", output, *options)
    return done.code, done.err


def test_tracking_says_what_of_the_camera_is_assumed(recording: Path, tmp_path: Path, command: Command) -> None:
    """Before anything is tracked, which here has no clicks."""
    none = tmp_path / "none.json"
    copy = linked(recording, tmp_path / "copy", CAMERA_FILE)
    assert CAMERA_FILE in tracked(command, copy, tmp_path / "a.h5", clicks=none)[1]
    source, path = TumFolder(recording), tmp_path / "r.oni"
    write_oni(path, in_millimetres(islice(source.frames(), 3)), source.info.camera, fps=30, color="jpeg")
    for sidecar in tmp_path.glob("*.yaml"):
        sidecar.unlink()
    assert "depth and colour are aligned" in tracked(command, path, tmp_path / "s.h5", clicks=none)[1]


def test_clicks_from_something_endless(recording: Path, tmp_path: Path, command: Command) -> None:
    endless = tmp_path / "clicks.json"
    endless.write_text(json.dumps({"hand": "x" * 2_000_000}))
    code, said = tracked(command, recording, tmp_path / "s.h5", clicks=endless)
    assert (code, "clicks.json" in said) == (1, True)
    assert len(said) < 500


def test_closed_streams_are_no_trouble(recording: Path, tmp_path: Path) -> None:
    output = tmp_path / "s.h5"
    words = (*COMMAND, "track", recording, "--calibration", recording / CLICKS_FILE, "--output", output, "--no-smooth")
    ended = subprocess.run(words, cwd=ROOT, preexec_fn=lambda: [os.close(one) for one in (0, 1, 2)], check=False)
    assert ended.returncode == 0
    assert len(read_session(output)) > 10


NOT_LOADED = {
    "demo": ("h5py", "yaml", "threadpoolctl", "sqlalchemy", "carpus.core.detection", "carpus.core.measures"),
    "info": ("h5py", "threadpoolctl", "sqlalchemy", "carpus.core.detection", "carpus.core.compiled"),
    "track": ("yaml", "threadpoolctl", "sqlalchemy", "carpus.core.measures", "carpus.core.results.session_results"),
}
"""By commands that only tell what they take: a tenth of a second each, for whoever types one."""


@pytest.mark.parametrize("name", NOT_LOADED)
def test_command_that_tells_what_it_takes_loads_little(name: str) -> None:
    code = "import atexit, sys; from carpus.app.__main__ import main; atexit.register(lambda: print(*sys.modules))"
    words = (sys.executable, "-c", f"{code}; main([{name!r}, '--help'])")
    loaded = set(subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split())
    assert f"carpus.app.commands.{name}" in loaded
    assert not loaded & set(NOT_LOADED[name])


@pytest.mark.parametrize("asked", ["info SESSION", "track --help"])
def test_full_disk_under_output_is_reported(asked: str, session: Path) -> None:
    words = (*COMMAND, *asked.replace("SESSION", str(session)).split())
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        ended = subprocess.run(words, cwd=ROOT, env=buffered(), stdout=full, stderr=PIPE, check=False, text=True)
    assert ended.returncode == 1
    assert ended.stderr.startswith("carpus: ")
    assert ended.stderr.count("\n") == 1
    assert "No space left" in ended.stderr
    assert "unforeseen" not in ended.stderr


def test_full_disk_under_messages_changes_no_exit_code(tmp_path: Path) -> None:
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        words = (*COMMAND, "info", str(tmp_path / "gone.h5"))
        ended = subprocess.run(words, cwd=ROOT, env=buffered(), stdout=PIPE, stderr=full, check=False)
    assert ended.returncode == 1


def test_message_on_full_disk_is_printed_when_room_returns(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with (tmp_path / "said").open("w", encoding="utf-8", buffering=1) as said:
        monkeypatch.setattr(sys, "stderr", said)
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, before[1]))
        try:
            command_line.print_message("no room for this")
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
        command_line.print_message("here is room")
    assert (tmp_path / "said").read_text() == "carpus: no room for this\ncarpus: here is room\n"


@pytest.mark.parametrize(("asked", "unbuffered"), [("info SESSION", "1"), ("track --help", "")])
def test_reader_that_goes_away_is_no_trouble(asked: str, unbuffered: str, session: Path) -> None:
    """As `carpus info FILE | head -1`, with a head that has gone before the first line comes."""
    reading, writing = os.pipe()
    os.close(reading)
    words = (*COMMAND, *asked.replace("SESSION", str(session)).split())
    environment = buffered() | ({"PYTHONUNBUFFERED": unbuffered} if unbuffered else {})
    ended = subprocess.run(words, cwd=ROOT, env=environment, stdout=writing, stderr=PIPE, check=False, text=True)
    os.close(writing)
    assert (ended.returncode, ended.stderr) == (1, "")


def test_stopped_while_rendering_leaves_nothing(tmp_path: Path) -> None:
    folder = tmp_path / "rendered"
    words = (*COMMAND, "simulate", "--output", folder, "--seconds", "60")
    ended = signalled(words, lambda: any(folder.glob("rgb/*.png")), signal.SIGHUP)
    assert ended == (1, "carpus: stopped.\n")
    assert not folder.exists()


def test_signal_ignored_by_parent_stays_ignored(tmp_path: Path) -> None:
    """A rendering in the background outlives the Ctrl+C meant for another job, and the end of its terminal."""
    folder = tmp_path / "rendered"
    words = (*COMMAND, "simulate", "--output", folder, "--seconds", "0.4")
    code, said = signalled(
        words, lambda: any(folder.glob("rgb/*.png")), signal.SIGINT, signal.SIGHUP, prepare=ignore_all
    )
    assert (code, "stopped" in said) == (0, False)
    assert (folder / COLOR_LIST).exists()


def test_stopped_while_modules_load_it_ends_without_a_traceback() -> None:
    stop = "import os, signal, sys\nclass Stop:\n    def find_spec(name, *_):\n"
    stop += "        if name == 'carpus.app.command_line': os.kill(os.getpid(), signal.SIGINT)\n"
    stop += "sys.meta_path.insert(0, Stop)\nimport carpus.app.__main__\n"
    assert signalled([sys.executable, "-c", stop], lambda: True) == (-signal.SIGINT, "")
    after = "import signal, carpus.app.__main__\nassert signal.getsignal(2) is signal.default_int_handler\n"
    assert signalled([sys.executable, "-c", after], lambda: True) == (0, "")


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


def test_unattended_way_can_be_stopped(tmp_path: Path) -> None:
    words = (*COMMAND, "demo", "--unattended", "--data-folder", tmp_path / "data")
    code, said = signalled(words, (tmp_path / "data" / "records.sqlite3").exists, signal.SIGTERM)
    *steps, last = said.splitlines()
    assert (code, last) == (1, "carpus: stopped.")
    assert all(line.startswith("carpus: demo: ") for line in steps)


def test_list_is_written_last(recording: Path) -> None:
    """A rendering that a kill cuts short has no list yet, and is no recording."""
    written = {path.name: path.stat().st_mtime_ns for path in recording.iterdir() if path.is_file()}
    assert written.pop(COLOR_LIST) >= max(
        time_ns for name, time_ns in written.items() if name.endswith((".h5", ".json"))
    )


def test_simulated_person_is_drawn_or_given(tmp_path: Path, command: Command) -> None:
    words = ("simulate", "--output", tmp_path / "r", "--seconds=0.05", "--skin-glide-mm=drawn", "--cupping=0.5")
    assert command(*words, "--habit=grip+rolling_forearm").code == 0
    spec = RecordingSpec(**json.loads(str(read_session(tmp_path / "r" / TRUTH_FILE).header.parameters)))
    assert (spec.skin_glide_mm, spec.cupping, spec.habits) == (None, 0.5, ("grip", "rolling_forearm"))


def test_info_says_that_a_raw_recording_was_cut_short(recording: Path, tmp_path: Path, command: Command) -> None:
    path = tmp_path / "r.carpusraw"
    assert command("record", "--from", recording, "--output", path).code == 0
    whole = command("info", path)
    with path.open("r+b") as file:
        file.truncate(path.stat().st_size - 100)
    cut = command("info", path)
    assert [(one.code, "cut short" in one.out) for one in (whole, cut)] == [(0, False), (0, True)]


@pytest.mark.parametrize("whole", [0, 1])
def test_interrupt_message_names_readable_data_only_if_recorded(
    whole: int, recording: Path, tmp_path: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    append = TumWriter.append_frame

    def fills_the_disk(writer: TumWriter, frame: Frame) -> None:
        if len(writer) == whole:
            raise DiskFull(writer.path)
        append(writer, frame)

    monkeypatch.setattr(TumWriter, "append_frame", fills_the_disk)
    done = command("record", "--from", recording, "--output", tmp_path / "take", "--format", "tum")
    assert (done.code, "can be read" in done.out) == (1, bool(whole))


def test_damaged_raw_recording_is_not_said_to_be_whole(recording: Path, tmp_path: Path, command: Command) -> None:
    path = tmp_path / "r.carpusraw"
    assert command("record", "--from", recording, "--output", path).code == 0
    data = path.read_bytes()
    third = [place.start() for place in re.finditer(b"FRAM", data)][2]

    def said(content: bytes) -> tuple[int, str]:
        path.write_bytes(content)
        done = command("verify", path)
        return done.code, done.out + done.err

    count = TumFolder(recording).info.frame_count
    assert said(data) == (0, f"Whole: {path} ({count} frames).\n")
    code, cut = said(data[: third + 100])
    assert (code, cut) == (0, f"Cut short, and whole up to there: {path} (2 frames).\n")
    for letters in (b"fRAM", b""):  # a record that is not seen as one
        code, damaged = said(data[:third] + letters + data[third + 4 :])
        assert (code, f"1 of {count} frames" in damaged) == (1, True)
    code, longer = said(data + b"hello")
    assert (code, "damaged" in longer) == (1, True)


def test_depth_beside_colour_is_told_also_where_a_marker_has_none(
    recording: Path, tmp_path: Path, command: Command
) -> None:
    """The remedy is registration, not another place for the hand."""
    copy = linked(recording, tmp_path / "beside", "depth")
    (copy / "depth").mkdir()
    u, v = map(int, json.loads((recording / CLICKS_FILE).read_text())["markers"]["MCP4"])
    for path in (recording / "depth").iterdir():
        depth = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
        depth[:, 15:] = depth[:, :-15].copy()
        depth[v - 9 : v + 10, u - 9 : u + 10] = 0
        cv2.imwrite(str(copy / "depth" / path.name), depth)
    code, said = tracked(command, copy, tmp_path / "s.h5")
    assert (code, "Depth and colour are not aligned" in said) == (1, True)
    assert said.count("measures no depth") == 1
    assert not (tmp_path / "s.h5").exists()


def test_damaged_pictures_are_a_fault_or_left_out_and_told(recording: Path, tmp_path: Path, command: Command) -> None:
    copy, output = tmp_path / "copy", tmp_path / "session.h5"
    shutil.copytree(recording, copy)
    color = sorted((copy / "rgb").iterdir())
    color[4].write_text("no picture")
    color[7].unlink()
    assert "1 colour missing" in command("info", copy).err
    code, said = tracked(command, copy, output)
    assert (code, color[7].name in said) == (1, True)
    assert not output.exists()
    code, said = tracked(command, copy, output, "--leave-out-damaged")
    assert (code, "1 colour damaged" in said, CAMERA_FILE in said) == (0, True, False)
    session = read_session(output)
    assert len(session) == len(color) - 2
    assert session.quality.dropped_before.sum() == 2
    assert session.header.is_simulated


def test_session_is_exported_in_every_format_and_nothing_is_overwritten(
    session: Path, tmp_path: Path, command: Command
) -> None:
    folder = tmp_path / "new" / "export"
    done = command("export", session, "--format", "csv,json,c3d,trc,mot", "--output", folder)
    names = {path.name for path in folder.iterdir()}
    assert names >= {
        "session.wrist.for-programs.csv",
        "session.measures.json",
        "session.c3d",
        "session.trc",
        "session.mot",
    }
    assert done.code == 0
    assert all(name in done.out for name in names)
    again = command("export", session, "--format", "csv", "--output", folder)
    assert (again.code, "session.wrist.for-programs.csv" in again.err) == (1, True)
    assert command("export", session, "--format", "bids", "--output", tmp_path / "set").code == 0
    assert (tmp_path / "set" / "dataset_description.json").exists()


def test_settings_of_a_session_are_json_where_asked_for(session: Path, command: Command) -> None:
    assert isinstance(json.loads(command("info", session, "--json").out), dict)


@pytest.mark.parametrize(("step_s", "said"), [(1.0, ["carpus: tracking, 30 frames in 30 s, 1 a second"]), (0.1, [])])
def test_long_work_without_a_terminal_says_one_line_at_its_end(
    step_s: float, said: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    clock_s = [0.0]
    monkeypatch.setattr(command_line.time, "monotonic", lambda: clock_s[0])
    with command_line.progress_bar("tracking") as show:
        for done in range(1, 31):
            clock_s[0] += step_s
            show(done, 40)
        assert capsys.readouterr().err == ""
    assert capsys.readouterr().err.splitlines() == said


class ATerminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_terminal_sees_how_far_how_fast_and_how_long_yet(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tqdm.tqdm", partial(tqdm, mininterval=0.0))
    monkeypatch.setattr(sys, "stderr", ATerminal())
    with command_line.progress_bar("tracking") as show:
        for done in (1, 2, 3):
            show(done, 4, "7 frames a second")
        drawn = sys.stderr.getvalue().rpartition("\r")[2]
    assert re.fullmatch(r"tracking: +75%.* 3/4 \[\d\d:\d\d<\d\d:\d\d, .*frame.*, 7 frames a second\] *", drawn), drawn

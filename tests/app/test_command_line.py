"""What every command does with wrong usage, closed streams, signals and full disks: a sentence, never a traceback."""

from __future__ import annotations

import io
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path
from subprocess import PIPE

import cv2
import pytest
from tqdm import tqdm

from carpus.app import command_line
from carpus.app.__main__ import main
from carpus.app.sources import open_recording
from carpus.core.capture.camera_info import CAMERA_FILE
from carpus.core.capture.files.tum import COLOR_LIST, TumFolder
from carpus.core.errors import RecordingEmpty
from carpus.core.hand.protocols import WRIST6
from carpus.core.session.reader import read_session
from carpus.core.session.recovery import interrupted_sessions
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from carpus.core.simulation.oni_writer import in_millimetres, write_oni
from carpus.core.simulation.recording import CLICKS_FILE, TRUTH_FILE
from carpus.core.simulation.spec import RecordingSpec
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
    header = new_header(hand="right", protocol=WRIST6, software_version="0")
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


def usage_code(*arguments: str) -> int:
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert isinstance(ended.value.code, int)
    return ended.value.code


@pytest.mark.parametrize("angle", ["nan", "inf", "1000"])
def test_start_angles_that_no_wrist_has_are_wrong_usage(angle: str, recording: Path, tmp_path: Path) -> None:
    options = ("--calibration", str(recording / CLICKS_FILE), "--output", str(tmp_path / "s.h5"))
    assert usage_code("track", str(recording), *options, "--start-angles", angle, "0", "0") == 2


@pytest.mark.parametrize("seconds", ["nan", "inf", "0", "-1", "1e9", "x"])
def test_recording_lasts_a_positive_time(seconds: str, tmp_path: Path) -> None:
    assert usage_code("record", "--output", str(tmp_path / "r"), "--seconds", seconds) == 2


@pytest.mark.parametrize(
    "option",
    [
        ("--subject", "Fern 12"),
        ("--exercise", "WRIST_FE"),
        ("--start-angles", "5", "0", "0"),
        ("--calibration", "c.json"),
    ],
)
def test_a_session_answers_for_itself(
    option: tuple[str, ...], session: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """An option that would be passed over in silence is wrong usage."""
    output = tmp_path / "again.h5"
    assert main(["track", str(session), "--output", str(output), *option]) == 2
    assert option[0] in capsys.readouterr().err
    assert not output.exists()


def test_a_recording_that_is_not_there_is_told_before_its_clicks_are_asked_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["track", str(tmp_path / "gone.h5"), "--output", str(tmp_path / "s.h5")]) == 1
    assert "gone.h5" in capsys.readouterr().err


def test_tracking_says_when_the_camera_is_assumed(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy = tmp_path / "copy"
    copy.mkdir()
    for path in recording.iterdir():
        if path.name != CAMERA_FILE:
            (copy / path.name).symlink_to(path)
    assert main(["track", str(copy), "--calibration", str(copy / CLICKS_FILE), "--output", str(tmp_path / "a.h5")]) == 0
    assert CAMERA_FILE in capsys.readouterr().err
    with_file = ["--calibration", str(recording / CLICKS_FILE), "--output", str(tmp_path / "b.h5")]
    assert main(["track", str(recording), *with_file]) == 0
    assert CAMERA_FILE not in capsys.readouterr().err


def test_an_oni_file_says_that_registration_is_assumed(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source = TumFolder(recording)
    path = tmp_path / "r.oni"
    write_oni(path, in_millimetres(source.frames()), source.info.camera, fps=30, color="jpeg")
    for sidecar in tmp_path.glob("*.yaml"):
        sidecar.unlink()
    main(["track", str(path), "--calibration", str(recording / CLICKS_FILE), "--output", str(tmp_path / "s.h5")])
    assert "depth lies on colour" in capsys.readouterr().err


def test_clicks_from_something_endless(recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    endless = tmp_path / "clicks.json"
    endless.write_text(json.dumps({"hand": "x" * 2_000_000}))
    assert main(["track", str(recording), "--calibration", str(endless), "--output", str(tmp_path / "s.h5")]) == 1
    said = capsys.readouterr().err
    assert "clicks.json" in said
    assert len(said) < 500


@pytest.mark.parametrize("streams", [(0, 1), (2,)])
def test_a_closed_stream_is_no_trouble(streams: tuple[int, ...], recording: Path, tmp_path: Path) -> None:
    output = tmp_path / "s.h5"
    words = (*COMMAND, "track", str(recording), "--calibration", str(recording / CLICKS_FILE), "--output", str(output))
    ended = subprocess.run(words, cwd=ROOT, preexec_fn=lambda: [os.close(one) for one in streams], check=False)
    assert ended.returncode == 0
    assert len(read_session(output)) > 10


NOT_LOADED = {
    "demo": ("h5py", "yaml", "threadpoolctl", "sqlalchemy", "carpus.core.detection", "carpus.core.measures"),
    "info": ("h5py", "threadpoolctl", "sqlalchemy", "carpus.core.detection", "carpus.core.kernels"),
    "track": ("yaml", "threadpoolctl", "sqlalchemy", "carpus.core.measures", "carpus.core.results.figures"),
}
"""By commands that only tell what they take: a tenth of a second each, for whoever types one."""


@pytest.mark.parametrize("name", NOT_LOADED)
def test_a_command_that_tells_what_it_takes_loads_little(name: str) -> None:
    code = "import atexit, sys; from carpus.app.__main__ import main; atexit.register(lambda: print(*sys.modules))"
    words = (sys.executable, "-c", f"{code}; main([{name!r}, '--help'])")
    loaded = set(subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split())
    assert f"carpus.app.commands.{name}" in loaded
    assert not loaded & set(NOT_LOADED[name])


ASKED = [["info", "SESSION"], ["info", "SESSION", "--json"], ["--version"], ["track", "--help"]]


@pytest.mark.parametrize("asked", ASKED, ids=" ".join)
def test_a_full_disk_under_the_output_is_told(asked: list[str], session: Path) -> None:
    words = (*COMMAND, *(str(session) if word == "SESSION" else word for word in asked))
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        ended = subprocess.run(words, cwd=ROOT, env=buffered(), stdout=full, stderr=PIPE, check=False, text=True)
    assert ended.returncode == 1
    assert ended.stderr.startswith("carpus: ")
    assert ended.stderr.count("\n") == 1
    assert "No space left" in ended.stderr
    assert "unforeseen" not in ended.stderr


def test_a_full_disk_under_the_messages_changes_no_exit_code(session: Path, tmp_path: Path) -> None:
    for path, code in ((session, 0), (tmp_path / "gone.h5", 1)):
        with Path("/dev/full").open("w", encoding="utf-8") as full:
            words = (*COMMAND, "info", str(path))
            ended = subprocess.run(words, cwd=ROOT, env=buffered(), stdout=PIPE, stderr=full, check=False)
        assert ended.returncode == code


@pytest.mark.parametrize(
    ("asked", "unbuffered"), [(["info", "SESSION"], False), (["info", "SESSION"], True), (["track", "--help"], False)]
)
def test_a_reader_that_goes_away_is_no_trouble(asked: list[str], unbuffered: bool, session: Path) -> None:
    """As `carpus info FILE | head -1`, with a head that has gone before the first line comes."""
    reading, writing = os.pipe()
    os.close(reading)
    words = (*COMMAND, *(str(session) if word == "SESSION" else word for word in asked))
    environment = buffered() | ({"PYTHONUNBUFFERED": "1"} if unbuffered else {})
    ended = subprocess.run(words, cwd=ROOT, env=environment, stdout=writing, stderr=PIPE, check=False, text=True)
    os.close(writing)
    assert ended.returncode == 1
    assert ended.stderr == ""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_stopped_while_rendering_leaves_nothing(number: signal.Signals, tmp_path: Path) -> None:
    folder = tmp_path / "rendered"
    words = (*COMMAND, "simulate", "--output", str(folder), "--seconds", "60")
    with subprocess.Popen(words, cwd=ROOT, stderr=PIPE, text=True, preexec_fn=hear_all) as process:
        while not any(folder.glob("rgb/*.png")):
            assert process.poll() is None
            time.sleep(0.02)
        process.send_signal(number)
        said = process.communicate(timeout=60)[1]
    assert process.returncode == 1
    assert said == "carpus: stopped.\n"
    assert not folder.exists()


def test_what_a_parent_told_to_ignore_is_ignored(tmp_path: Path) -> None:
    """A rendering in the background outlives the Ctrl+C meant for another job, and the end of its terminal."""
    folder = tmp_path / "rendered"
    words = (*COMMAND, "simulate", "--output", str(folder), "--seconds", "0.4")
    with subprocess.Popen(words, cwd=ROOT, stderr=PIPE, text=True, preexec_fn=ignore_all) as process:
        while not any(folder.glob("rgb/*.png")):
            assert process.poll() is None
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGHUP)
        said = process.communicate(timeout=120)[1]
    assert process.returncode == 0
    assert "stopped" not in said
    assert (folder / COLOR_LIST).exists()


def test_stopped_while_tracking_leaves_no_part(recording: Path, tmp_path: Path) -> None:
    """What can be tracked again is not kept by halves."""
    words = ["track", str(recording), "--calibration", str(recording / CLICKS_FILE), "--output", str(tmp_path / "s.h5")]
    slow = "import time\nfrom carpus.app.__main__ import main\nfrom carpus.core.session.writer import SessionWriter\n"
    slow += "append = SessionWriter.append\n"
    slow += "def slowly(*a):\n    print('.', flush=True)\n    time.sleep(0.5)\n    append(*a)\n"
    slow += f"SessionWriter.append = slowly\nraise SystemExit(main({words!r}))\n"
    with subprocess.Popen(
        [sys.executable, "-c", slow], cwd=ROOT, stdout=PIPE, stderr=PIPE, text=True, preexec_fn=hear_all
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == ".\n"
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=60)[1]
    assert process.returncode == 1
    assert said == "carpus: stopped.\n"
    assert not (tmp_path / "s.h5").exists()
    assert not interrupted_sessions(tmp_path)


def test_a_list_is_written_last(recording: Path) -> None:
    """A rendering that a kill cuts short has no list yet, and is no recording."""
    written = {path.name: path.stat().st_mtime_ns for path in recording.iterdir() if path.is_file()}
    assert written.pop(COLOR_LIST) >= max(
        time_ns for name, time_ns in written.items() if name.endswith((".h5", ".json"))
    )


@pytest.mark.parametrize("option", ["--seconds=inf", "--seconds=-1", "--fps=inf", "--tremor-deg=inf", "--distance-m=0"])
def test_a_simulation_beyond_all_limits_is_refused(
    option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["simulate", "--output", str(tmp_path / "r"), option]) == 1
    assert option.partition("=")[0][2:].replace("-", "_") in capsys.readouterr().err
    assert not (tmp_path / "r").exists()


def test_a_simulated_person_is_drawn_or_given(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ("simulate", "--output", str(tmp_path / "r"), "--seconds=0.05", "--skin-glide-mm=drawn", "--cupping=0.5")
    assert main([*words, "--habit=grip+rolling_forearm"]) == 0
    spec = RecordingSpec(**json.loads(str(read_session(tmp_path / "r" / TRUTH_FILE).header.parameters)))
    assert (spec.skin_glide_mm, spec.cupping, spec.habits) == (None, 0.5, ("grip", "rolling_forearm"))
    with pytest.raises(SystemExit):
        main([*words, "--skin-glide-mm=much"])
    assert "“much” is no number, and not “drawn”" in capsys.readouterr().err


def test_the_folder_of_a_rendered_oni_file_opens_it(recording: Path, tmp_path: Path) -> None:
    source = TumFolder(recording)
    write_oni(tmp_path / "recording.oni", in_millimetres(source.frames()), source.info.camera, fps=30, color="jpeg")
    assert open_recording(tmp_path).info.frame_count == source.info.frame_count
    (tmp_path / COLOR_LIST).write_text("")
    with pytest.raises(RecordingEmpty):
        open_recording(tmp_path)


def test_info_says_that_a_raw_recording_was_cut_short(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "r.carpusraw"
    assert main(["record", "--from", str(recording), "--output", str(path)]) == 0
    capsys.readouterr()
    assert main(["info", str(path)]) == 0
    assert "cut short" not in capsys.readouterr().out
    with path.open("r+b") as file:
        file.truncate(path.stat().st_size - 100)
    assert main(["info", str(path)]) == 0
    assert "cut short" in capsys.readouterr().out


def test_the_unattended_way_can_be_stopped(tmp_path: Path) -> None:
    words = (*COMMAND, "demo", "--unattended", "--data-folder", str(tmp_path / "data"))
    with subprocess.Popen(words, cwd=ROOT, stderr=PIPE, text=True, preexec_fn=hear_all) as process:
        while not (tmp_path / "data" / "records.sqlite3").exists():
            assert process.poll() is None
            time.sleep(0.02)
        time.sleep(0.5)
        process.send_signal(signal.SIGTERM)
        said = process.communicate(timeout=60)[1]
    assert process.returncode == 1
    assert said == "carpus: stopped.\n"


def test_depth_beside_colour_is_told_also_where_a_marker_has_none(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The remedy is registration, not another place for the hand."""
    copy = tmp_path / "beside"
    (copy / "depth").mkdir(parents=True)
    for path in recording.iterdir():
        if path.name != "depth":
            (copy / path.name).symlink_to(path)
    u, v = map(int, json.loads((recording / CLICKS_FILE).read_text())["markers"]["MCP4"])
    for path in (recording / "depth").iterdir():
        depth = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
        assert depth is not None
        depth[:, 15:] = depth[:, :-15].copy()
        depth[v - 9 : v + 10, u - 9 : u + 10] = 0
        cv2.imwrite(str(copy / "depth" / path.name), depth)
    output = tmp_path / "s.h5"
    assert main(["track", str(copy), "--calibration", str(copy / CLICKS_FILE), "--output", str(output)]) == 1
    said = capsys.readouterr().err
    assert "Depth and colour do not lie on each other" in said
    assert said.count("measures no depth") == 1
    assert not output.exists()


def test_damaged_pictures_are_a_fault_or_left_out_and_told(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy = tmp_path / "copy"
    shutil.copytree(recording, copy)
    color = sorted((copy / "rgb").iterdir())
    color[4].write_text("no picture")
    color[7].unlink()
    assert main(["info", str(copy)]) == 0
    assert "1 colour missing" in capsys.readouterr().err
    output = tmp_path / "session.h5"
    track = ["track", str(copy), "--calibration", str(copy / CLICKS_FILE), "--output", str(output)]
    assert main(track) == 1
    assert color[7].name in capsys.readouterr().err
    assert not output.exists()
    assert main([*track, "--leave-out-damaged"]) == 0
    assert "1 colour damaged" in capsys.readouterr().err
    tracked = read_session(output)
    assert len(tracked) == len(color) - 2
    assert tracked.quality.dropped_before.sum() == 2
    assert tracked.header.simulated


def test_a_session_is_exported_in_every_format_and_nothing_is_overwritten(
    session: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "new" / "export"
    assert main(["export", str(session), "--format", "csv,json,c3d,trc,mot", "--output", str(folder)]) == 0
    names = {path.name for path in folder.iterdir()}
    assert names >= {"session.wrist.csv", "session.measures.json", "session.c3d", "session.trc", "session.mot"}
    said = capsys.readouterr().out
    assert all(name in said for name in names)
    assert main(["export", str(session), "--format", "csv", "--output", str(folder)]) == 1, "nothing is overwritten"
    assert "session.wrist.csv" in capsys.readouterr().err
    assert main(["export", str(session), "--format", "bids", "--output", str(tmp_path / "set")]) == 0
    assert (tmp_path / "set" / "dataset_description.json").exists()
    assert usage_code("export", str(session), "--format", "xls", "--output", str(folder)) == 2


def test_settings_of_a_session_are_json_where_asked_for(session: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["info", str(session), "--json"]) == 0
    assert isinstance(json.loads(capsys.readouterr().out), dict)


def test_recovering_a_folder_that_is_not_there_speaks_of_a_folder(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["recover", str(tmp_path / "nope")]) == 1
    assert "no folder" in capsys.readouterr().err


@pytest.mark.parametrize(("step_s", "said"), [(1.0, ["carpus: tracking, 30 frames in 30 s, 1 a second"]), (0.1, [])])
def test_long_work_without_a_terminal_says_one_line_at_its_end(
    step_s: float, said: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    clock_s = [0.0]
    monkeypatch.setattr(command_line.time, "monotonic", lambda: clock_s[0])
    with command_line.bar("tracking") as show:
        for done in range(1, 31):
            clock_s[0] += step_s
            show(done, 40)
        assert capsys.readouterr().err == ""
    assert capsys.readouterr().err.splitlines() == said


class ATerminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_a_terminal_sees_how_far_how_fast_and_how_long_yet(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tqdm.tqdm", partial(tqdm, mininterval=0.0))
    monkeypatch.setattr(sys, "stderr", ATerminal())
    with command_line.bar("tracking") as show:
        for done in (1, 2, 3):
            show(done, 4, "7 frames a second")
        drawn = sys.stderr.getvalue().rpartition("\r")[2]
    assert re.fullmatch(r"tracking: +75%.* 3/4 \[\d\d:\d\d<\d\d:\d\d, .*frame.*, 7 frames a second\] *", drawn), drawn

"""``carpus report`` as a process of its own: a page, a course over sessions, and each thing that can be wrong."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import uuid
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from carpus.app import python_face
from carpus.app.__main__ import main
from carpus.core.records.of_sessions import add_comment, keep_choices
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.session.reader import read_outline
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from carpus.core.types import TrackedFrame, TrackStatus
from tests.moments import with_moment
from tests.records.samples import opened
from tests.session.samples import CAMERA, make_calibration, make_frame

ROOT = Path(__file__).parents[2]


def carpus(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "QT_QPA_PLATFORM")}
    return subprocess.run(
        [sys.executable, "-m", "carpus", *map(str, arguments)],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
    )


def frame(row: int) -> TrackedFrame:
    """Flexion to and fro, 30 degrees to both sides, every four seconds."""
    time_s = row / 30.0
    angles_rad = np.radians([0.0, 30.0 * np.sin(2.0 * np.pi * time_s / 4.0), 0.0])
    moved = with_moment(make_frame(row), angles_rad=angles_rad, angles_sd_rad=np.radians([0.5, 1.0, 1.0]))
    return replace(moved, timestamp_s=time_s)


@pytest.fixture(scope="module")
def sessions(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder, out = tmp_path_factory.mktemp("sessions"), []
    for day in (0, 7):
        header = new_header(
            hand="right",
            protocol=make_calibration().clicks.protocol,
            software_version="0",
            subject_id="Linden 42",
            exercise="WRIST_FE",
            now=datetime(2026, 11, 1, 9, 0, tzinfo=UTC) + timedelta(days=day),
            session_id=uuid.uuid4(),
        )
        out.append(folder / f"day{day}.h5")
        with SessionWriter.create(out[-1], header, CAMERA, make_calibration()) as writer:
            for row in range(20 * 30):
                writer.append(frame(row))
    return out


def words(path: Path) -> str:
    tool = shutil.which("pdftotext")
    assert tool is not None, "pdftotext (poppler-utils) is needed to read the report back"
    return subprocess.run([tool, "-layout", str(path), "-"], capture_output=True, text=True, check=True).stdout


def test_one_session_makes_a_session_report(sessions: list[Path], tmp_path: Path) -> None:
    done = carpus("report", sessions[0], "--output", tmp_path / "one.pdf")
    assert (done.returncode, done.stderr) == (0, "")
    assert str(tmp_path / "one.pdf") in done.stdout
    page = words(tmp_path / "one.pdf")
    assert "Linden 42" in page
    assert "Session report" in page


def test_the_comment_is_on_it_and_paper_and_language_are_chosen(sessions: list[Path], tmp_path: Path) -> None:
    path = tmp_path / "data" / "sessions" / "day.h5"
    with opened(tmp_path / "data") as house:
        shutil.copy(sessions[0], path)
        house.files.take_in()
        add_comment(house.store, read_outline(path).header.session_id, "Splint at night.", "")
    out = tmp_path / "de.pdf"
    done = carpus("report", path, "--output", out, "--paper", "letter", "--language", "de")
    assert (done.returncode, done.stderr) == (0, "")
    page = words(out)
    assert "Splint at night." in page
    assert "Sitzungsbericht" in page
    tool = shutil.which("pdfinfo")
    assert tool is not None
    assert "612 x 792" in subprocess.run([tool, str(out)], capture_output=True, text=True, check=True).stdout


def test_what_was_left_out_in_the_review_is_left_out_everywhere(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "data" / "sessions" / "day.h5"
    path.parent.mkdir(parents=True)
    calibration = replace(make_calibration(), rotation_w0_cam=np.diag([1.0, -1.0, -1.0]))
    header = new_header(
        hand="right", protocol=calibration.clicks.protocol, software_version="0", exercise="WRIST_FE",
        now=datetime(2026, 11, 1, 9, 0, tzinfo=UTC), session_id=uuid.uuid4(),
    )  # fmt: skip
    still = {"rotation_w2_w0": np.eye(3), "position_m": np.zeros(3), "w0_turn_rad": np.zeros(3)}
    with SessionWriter.create(path, header, CAMERA, calibration) as writer:
        for row in range(20 * 30):
            there = with_moment(frame(row), **still)
            writer.append(replace(there, status=TrackStatus.TRACKED, dropped_before=0))
    whole = {row.measure: row.count for row in python_face.open_session(path).measures()}
    with opened(tmp_path / "data") as house:
        house.files.take_in()
        keep_choices(house.store, header.session_id, RepetitionChoices({0: "pain", 1: "pain"}), 0)
    assert carpus("report", path, "--output", tmp_path / "day.pdf").returncode == 0
    left = whole["arc"] - 2
    assert f"mean of {left} repetitions; number 1 left out: pain" in words(tmp_path / "day.pdf")
    assert {row.measure: row.count for row in python_face.open_session(path).measures()}["arc"] == left
    export = ["export", str(path), "--format", "json"]
    assert main([*export, "--output", str(tmp_path / "out")]) == 0
    (made,) = (tmp_path / "out").rglob("*.measures.json")
    content = json.loads(made.read_text(encoding="utf-8"))
    assert next(row["count"] for row in content["measures"] if row["measure"] == "arc") == left
    assert [one["reason"] for one in content["repetitions"] if not one["counted"]] == ["pain", "pain"]
    assert main([*export, "--deidentified", "--output", str(tmp_path / "nobody")]) == 0
    (made,) = (tmp_path / "nobody").rglob("*.measures.json")
    assert "pain" not in made.read_text(encoding="utf-8").replace('"pain": []', "")
    capsys.readouterr()
    assert main(["info", str(path)]) == 0
    assert f"mean of {left} repetitions" in capsys.readouterr().out


def test_several_sessions_make_a_progress_report(sessions: list[Path], tmp_path: Path) -> None:
    done = carpus("report", *sessions, "--output", tmp_path / "course.pdf")
    assert done.returncode == 0
    assert "Progress report" in words(tmp_path / "course.pdf")


def test_what_cannot_be_done_is_one_line_and_leaves_nothing(
    sessions: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    taken = tmp_path / "taken.pdf"
    taken.write_bytes(b"mine")
    no_session = tmp_path / "no.h5"
    no_session.write_text("nothing")
    wrong = [
        ("report", no_session, "--output", tmp_path / "a.pdf"),
        ("report", tmp_path / "none.h5", "--output", tmp_path / "a.pdf"),
        ("report", sessions[0], "--output", taken),
        ("report", sessions[0], "--output", tmp_path / "no folder" / "a.pdf"),
    ]
    for arguments in wrong:
        assert main(list(map(str, arguments))) == 1
        said = capsys.readouterr().err
        assert said.startswith("carpus: ")
        assert len(said.splitlines()) == 1
    assert taken.read_bytes() == b"mine"
    assert not (tmp_path / "a.pdf").exists()
    with pytest.raises(SystemExit, match="2"):
        main(["report", str(sessions[0])])


def test_without_a_display_the_window_says_so_and_what_shows_the_way() -> None:
    done = carpus()
    assert done.returncode == 1
    assert "carpus demo" in done.stderr
    assert "Traceback" not in done.stderr

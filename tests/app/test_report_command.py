"""``carpus report`` and ``carpus progress``: a page, a course over sessions, tables; of the right patient alone."""

from __future__ import annotations

import csv
import json
import shutil
import subprocess
import uuid
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from pyarrow import parquet

from carpus.app import python_api
from carpus.core.formats.measures_table import MEASURES_HEADER
from carpus.core.model.types import TrackedFrame, TrackStatus
from carpus.core.records.session_records import add_comment, save_choices
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.session.reader import read_outline
from carpus.core.session.values import new_header
from carpus.core.session.writer import SessionWriter
from tests.commands import Command
from tests.formats.takes import store_session
from tests.moments import with_moment
from tests.records.samples import open_store
from tests.session.samples import CAMERA, make_calibration, make_frame

ROOT = Path(__file__).parents[2]
DAY = datetime(2026, 11, 1, 9, 0, tzinfo=UTC)


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
            hand="right", protocol=make_calibration().clicks.protocol, subject_id="Linden 42",
            exercise="WRIST_FE", now=DAY + timedelta(days=day), session_id=uuid.uuid4(),
        )  # fmt: skip
        out.append(folder / f"day{day}.h5")
        with SessionWriter.create(out[-1], header, CAMERA, make_calibration()) as writer:
            for row in range(20 * 30):
                writer.append(frame(row))
    return out


def words(path: Path) -> str:
    tool = shutil.which("pdftotext")
    assert tool is not None, "pdftotext (poppler-utils) is needed to read the report back"
    return subprocess.run([tool, "-layout", str(path), "-"], capture_output=True, text=True, check=True).stdout


def test_sessions_make_a_report_of_a_session_or_of_progress(
    sessions: list[Path], tmp_path: Path, command: Command
) -> None:
    done = command("report", sessions[0], "--output", tmp_path / "one.pdf")
    assert (done.code, done.err) == (0, "")
    assert str(tmp_path / "one.pdf") in done.out
    page = words(tmp_path / "one.pdf")
    assert "Linden 42" in page
    assert "Session report" in page
    assert command("report", *sessions, "--output", tmp_path / "course.pdf").code == 0
    assert "Progress report" in words(tmp_path / "course.pdf")
    same = shutil.copy(sessions[0], tmp_path / "the same.h5")
    twice = command("report", sessions[0], same, "--output", tmp_path / "twice.pdf")
    assert (twice.code, twice.err.count("\n")) == (0, 1)
    assert f"{same} is left out" in twice.err
    assert "Session report" in words(tmp_path / "twice.pdf")


def test_report_has_the_comment_and_chosen_paper_and_language(
    sessions: list[Path], tmp_path: Path, command: Command
) -> None:
    path, out = tmp_path / "data" / "sessions" / "day.h5", tmp_path / "de.pdf"
    with open_store(tmp_path / "data") as house:
        shutil.copy(sessions[0], path)
        house.files.scan()
        add_comment(house.store, read_outline(path).header.session_id, "Splint at night.", "")
    done = command("report", path, "--output", out, "--paper", "letter", "--language", "de")
    assert (done.code, done.err) == (0, "")
    page = words(out)
    assert "Splint at night." in page
    assert "Sitzungsbericht" in page
    assert "612 x 792" in subprocess.run(["pdfinfo", str(out)], capture_output=True, text=True, check=True).stdout


def test_repetition_excluded_in_review_is_excluded_everywhere(tmp_path: Path, command: Command) -> None:
    path = tmp_path / "data" / "sessions" / "day.h5"
    path.parent.mkdir(parents=True)
    calibration = replace(make_calibration(), rotation_w0_cam=np.diag([1.0, -1.0, -1.0]))
    header = new_header(
        hand="right", protocol=calibration.clicks.protocol, exercise="WRIST_FE", now=DAY,
        session_id=uuid.uuid4(),
    )  # fmt: skip
    still = {"rotation_w2_w0": np.eye(3), "position_m": np.zeros(3), "w0_turn_rad": np.zeros(3)}
    with SessionWriter.create(path, header, CAMERA, calibration) as writer:
        for row in range(20 * 30):
            there = with_moment(frame(row), **still)
            writer.append(replace(there, status=TrackStatus.TRACKED, dropped_before=0))
    whole = {row.measure: row.count for row in python_api.open_session(path).measures()}
    with open_store(tmp_path / "data") as house:
        house.files.scan()
        save_choices(house.store, header.session_id, RepetitionChoices({0: "pain", 1: "pain"}), 0)
    assert command("report", path, "--output", tmp_path / "day.pdf").code == 0
    left = whole["arc"] - 2
    assert f"mean of {left} repetitions; repetition 1 excluded: pain" in words(tmp_path / "day.pdf")
    assert {row.measure: row.count for row in python_api.open_session(path).measures()}["arc"] == left
    export = ("export", path, "--format", "json")
    assert command(*export, "--output", tmp_path / "out").code == 0
    (made,) = (tmp_path / "out").rglob("*.measures.json")
    content = json.loads(made.read_text(encoding="utf-8"))
    assert next(row["count"] for row in content["measures"] if row["measure"] == "arc") == left
    assert [one["reason"] for one in content["repetitions"] if not one["counted"]] == ["pain", "pain"]
    assert command(*export, "--deidentified", "--output", tmp_path / "nobody").code == 0
    (made,) = (tmp_path / "nobody").rglob("*.measures.json")
    assert "pain" not in made.read_text(encoding="utf-8").replace('"pain": []', "")
    assert f"mean of {left} repetitions" in command("info", path).out


def test_missing_display_is_reported_with_remedy(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)
    done = command()
    assert (done.code, "carpus demo" in done.err) == (1, True)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Sessions of one patient, and a file that is none."""
    (tmp_path / "sessions").mkdir()
    store_session(tmp_path / "sessions", frames=120, moving=True)
    shutil.copy(store_session(tmp_path, frames=3), tmp_path / "sessions" / "two.h5")
    (tmp_path / "sessions" / "broken.h5").write_bytes(b"nothing")
    return tmp_path / "sessions"


def test_measures_are_written_as_csv_parquet_and_pdf(folder: Path, tmp_path: Path, command: Command) -> None:
    out = [tmp_path / f"progress.{kind}" for kind in ("csv", "parquet", "pdf")]
    asked = ("progress", "Linden 42", "--sessions", folder)
    assert command(*asked, *(word for path in out for word in ("--output", path))).code == 0
    assert out[2].read_bytes().startswith(b"%PDF")
    table = parquet.read_table(out[1])
    with out[0].open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert tuple(table.column_names) == MEASURES_HEADER
    assert table.num_rows == len(rows)
    means = [float(row["mean"]) if row["mean"] else None for row in rows]
    for value, text in zip(table.column("mean").to_pylist(), means, strict=True):
        assert (text is None and value != value) or value == pytest.approx(text, rel=1e-5)

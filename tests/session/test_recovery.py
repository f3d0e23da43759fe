"""Recovery finishes what was cut short and leaves alone what it cannot."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import uuid
from datetime import UTC, datetime
from pathlib import Path

import h5py
import numpy as np
import pytest

from carpus.core.errors import RecordingMissing, SessionUnreadable
from carpus.core.session.disk import part_path, target_of_part
from carpus.core.session.reader import read_detections, read_raw, read_session
from carpus.core.session.recovery import Recovery, interrupted_sessions, recover_folder
from carpus.core.session.values import RawPictures, motion_of
from tests.session.samples import begun, make_frame, make_header, time_of

ROOT = Path(__file__).parents[2]
N = 10
NOW = datetime(2026, 11, 14, 8, 0, tzinfo=UTC)


def interrupt(target: Path, rows: int = N, smoothed: int = 0) -> Path:
    """A part file as a kill leaves it."""
    session = begun(target, make_header(session_id=uuid.uuid4()), rows)
    if rows:
        session.add_event(time_of(1), "note", "x")
    if smoothed:
        session.add_smoothed(motion_of([make_frame(row) for row in range(smoothed)]))
    session.abandon()
    return session.part_path


def test_an_interrupted_session_is_finished(tmp_path: Path) -> None:
    folder = tmp_path / "Linden-42"
    folder.mkdir()
    interrupt(folder / "s.h5", smoothed=N)
    recovery = recover_folder(tmp_path, NOW)
    assert recovery.recovered == (folder / "s.h5",)
    session = read_session(folder / "s.h5")
    assert (len(session), session.complete, session.recovered) == (N, True, "2026-11-14T08:00:00+00:00")
    assert session.smoothed is not None
    assert recover_folder(tmp_path) == Recovery((), (), ())  # nothing left to do
    assert [path.name for path in folder.iterdir()] == ["s.h5"]


def test_a_folder_that_is_not_there_and_files_of_others(tmp_path: Path) -> None:
    (tmp_path / "download.part").write_text("not ours")
    assert interrupted_sessions(tmp_path) == []
    assert target_of_part(tmp_path / "download.part") is None
    assert recover_folder(tmp_path).recovered == ()
    with pytest.raises(RecordingMissing):
        recover_folder(tmp_path / "nowhere")


ROWS = ("frames", "wrist", "markers", "quality")


def blobs_of(rows: int) -> int:
    return sum(len(make_frame(row).detections) for row in range(rows))


@pytest.mark.parametrize("short", ["/frames/timestamp", "/wrist/angles", "/markers/measured", "/quality/nis"])
def test_rows_are_cut_to_what_every_dataset_holds(tmp_path: Path, short: str) -> None:
    part = interrupt(tmp_path / "s.h5")
    with h5py.File(part, "r+") as file:
        file[short].resize(N - 3, axis=0)
    assert len(read_session(part)) == N - 3
    (target,) = recover_folder(tmp_path).recovered
    with h5py.File(target, "r") as file:
        assert {dataset.shape[0] for group in ROWS for dataset in file[group].values()} == {N - 3}
        assert {table.shape[0] for name, table in file["detections"].items() if name != "count"} == {blobs_of(N - 3)}


@pytest.mark.parametrize(("what", "whole"), [("blobs missing", 6), ("rows announced", N)])
def test_a_frame_whose_blobs_are_missing_or_that_was_only_announced_is_cut_too(
    tmp_path: Path, what: str, whole: int
) -> None:
    assert len(make_frame(6).detections) > 0
    with h5py.File(interrupt(tmp_path / "s.h5"), "r+") as file:
        if what == "blobs missing":
            file["/detections/area"].resize(blobs_of(whole), axis=0)
        else:
            for dataset in (*(one for group in ROWS for one in file[group].values()), file["/detections/count"]):
                dataset.resize(N + 5, axis=0)
    (target,) = recover_folder(tmp_path).recovered
    assert len(read_session(target)) == whole
    assert len(read_detections(target).blobs) == blobs_of(whole)


def test_pictures_are_cut_with_their_frames(tmp_path: Path) -> None:
    session = begun(tmp_path / "s.h5", rows=N, pictures=lambda row: RawPictures(b"c" * (row + 1), b"d"))
    session.abandon()
    with h5py.File(session.part_path, "r+") as file:
        file["/raw/color"].resize(sum(range(1, 8)), axis=0)
    (target,) = recover_folder(tmp_path).recovered
    assert len(read_session(target)) == 7
    assert [len(raw.color) for raw in read_raw(target)] == [1, 2, 3, 4, 5, 6, 7]


@pytest.mark.parametrize("half", ["of the frames", "of the tables"])
def test_half_a_smoothed_result_is_left_out(tmp_path: Path, half: str) -> None:
    part = interrupt(tmp_path / "s.h5", smoothed=N // 2 if half == "of the frames" else N)
    if half == "of the tables":
        with h5py.File(part, "r+") as file:
            del file["/smoothed/wrist/angles"]
    (target,) = recover_folder(tmp_path).recovered
    session = read_session(target)
    assert (len(session), session.smoothed) == (N, None)


def test_an_end_of_file_written_too_early_is_mended(tmp_path: Path) -> None:
    """HDF5 writes its end-of-file address last; a kill before that must not cost the data behind it."""
    part = interrupt(tmp_path / "s.h5")
    with part.open("r+b") as file:
        file.seek(40)
        length = int.from_bytes(file.read(8), "little")
        assert length == part.stat().st_size
        file.seek(40)
        file.write((length // 2).to_bytes(8, "little"))
    (target,) = recover_folder(tmp_path).recovered
    session = read_session(target)
    assert len(session) == N
    np.testing.assert_array_equal(session.motion.position_m, motion_of([make_frame(r) for r in range(N)]).position_m)


def test_a_running_session_is_left_alone(tmp_path: Path) -> None:
    session = begun(tmp_path / "s.h5", rows=1)
    recovery = recover_folder(tmp_path)
    assert (recovery.recovered, recovery.busy, recovery.faults) == ((), (session.part_path,), ())
    program = """if True:
        import sys
        from pathlib import Path
        from carpus.core.session.recovery import recover_folder
        print(*recover_folder(Path(sys.argv[1])).busy)
    """
    command = [sys.executable, "-c", program, str(tmp_path)]
    elsewhere = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert elsewhere.stdout.split() == [str(session.part_path)]
    session.close()
    assert len(read_session(tmp_path / "s.h5")) == 1


def test_what_cannot_be_finished_stays_as_it_is(tmp_path: Path) -> None:
    empty = interrupt(tmp_path / "empty.h5", rows=0)
    junk = part_path(tmp_path / "junk.h5", str(uuid.uuid4()))
    junk.write_bytes(b"not HDF5 at all")
    good = interrupt(tmp_path / "whole.h5")
    before = {path: path.read_bytes() for path in (empty, junk)}
    recovery = recover_folder(tmp_path)
    assert recovery.recovered == (tmp_path / "whole.h5",)
    assert not good.exists()
    assert [type(fault) for fault in recovery.faults] == [SessionUnreadable]
    assert recovery.empty == (empty,)
    assert {fault.subject for fault in recovery.faults} == {str(junk)}
    assert {path: path.read_bytes() for path in (empty, junk)} == before


def test_a_taken_name_is_not_overwritten(tmp_path: Path) -> None:
    interrupt(tmp_path / "s.h5")
    for name in ("s.h5", "s-2.h5"):
        (tmp_path / name).write_text("mine")
    assert recover_folder(tmp_path).recovered == (tmp_path / "s-3.h5",)
    assert (tmp_path / "s.h5").read_text() == "mine"


@pytest.mark.parametrize("linked", [True, False])
def test_a_session_ended_between_the_last_two_steps(tmp_path: Path, linked: bool) -> None:
    """Complete, but still under its part name, with or without the final one."""
    target = tmp_path / "s.h5"
    session = begun(target, rows=1)
    session.close()
    if linked:
        os.link(target, session.part_path)
    else:
        shutil.move(target, session.part_path)
    assert recover_folder(tmp_path).recovered == (target,)
    assert [path.name for path in tmp_path.iterdir()] == ["s.h5"]
    assert read_session(target).recovered == ""

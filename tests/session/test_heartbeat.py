"""A session that is being recorded is left alone where file locks do not work; one whose folder goes away goes on."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np
import pytest

from carpus.core.errors import CarpusFault, DiskFull, FolderGone, OutputNotWritable, RecordingMoved
from carpus.core.session import new_file, part_file, recovery, schema
from carpus.core.session.reader import read_raw, read_session, verify
from carpus.core.session.recovery import alive_path, recover_folder, still_beating
from carpus.core.session.schema import TableLayout
from carpus.core.session.values import RawPictures, motion_of
from carpus.core.session.writer import Fallback, SessionWriter
from tests.session.samples import begun, make_frame, time_of

ROOT = Path(__file__).parents[2]


def pictures(row: int) -> RawPictures:
    return RawPictures(bytes([row % 256]) * 40, b"depth" * row)


# --- the lock ------------------------------------------------------------------------------------------------
@pytest.fixture
def without_locks(monkeypatch: pytest.MonkeyPatch) -> None:
    """A disk on which file locks say nothing, as on many network shares."""
    monkeypatch.setattr(recovery, "is_being_written", lambda _: False)


@pytest.mark.usefixtures("without_locks")
def test_a_running_session_is_not_finished_by_another(tmp_path: Path) -> None:
    session = begun(tmp_path / "s.h5", rows=1)
    session.flush()
    assert alive_path(session.part_path).stat().st_mode & 0o777 == 0o600
    found = recover_folder(tmp_path)
    assert (found.recovered, found.busy) == ((), (session.part_path,))
    session.append(make_frame(1))
    session.close()
    assert [path.name for path in tmp_path.iterdir()] == ["s.h5"]
    assert len(read_session(tmp_path / "s.h5")) == 2


@pytest.mark.usefixtures("without_locks")
def test_a_killed_recorder_is_no_running_one(tmp_path: Path) -> None:
    code = (
        "import sys, time\nfrom pathlib import Path\n"
        "from tests.session.samples import begun\n"
        "session = begun(Path(sys.argv[1]), rows=1)\nsession.flush()\n"
        "print('begun', flush=True)\ntime.sleep(60)\n"
    )
    command = [sys.executable, "-c", code, str(tmp_path / "s.h5")]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as recorder:
        assert recorder.stdout.readline() == "begun\n"
        assert recover_folder(tmp_path).recovered == ()  # another process, alive
        recorder.send_signal(signal.SIGKILL)
    assert recover_folder(tmp_path).recovered == (tmp_path / "s.h5",)
    assert [path.name for path in tmp_path.iterdir()] == ["s.h5"]


def elsewhere(part: Path, beat: int) -> None:
    """What a recorder on another computer leaves, whose clock is nobody's business."""
    part.touch()
    said = {"host": "another computer", "process": 7, "began": "1", "beat": beat}
    alive_path(part).write_text(json.dumps(said))
    os.utime(alive_path(part), (0, 0))


def test_another_computer_is_watched(tmp_path: Path) -> None:
    running, ended = tmp_path / "a.h5.00000000.part", tmp_path / "b.h5.00000000.part"
    elsewhere(running, 1)
    elsewhere(ended, 1)
    waits: list[float] = []

    def wait(time_s: float) -> None:
        waits.append(time_s)
        if len(waits) == 3:
            elsewhere(running, 2)

    assert still_beating([running, ended], wait) == {running}
    assert 4.0 <= sum(waits) <= 5.0


@pytest.mark.parametrize("content", ["", "[" * 5000, "{}", "\0" * 50, '{"host": 1, "process": "x", "began": []}'])
def test_a_heartbeat_that_makes_no_sense_is_watched_too(tmp_path: Path, content: str) -> None:
    part = tmp_path / "a.h5.00000000.part"
    part.touch()
    alive_path(part).write_text(content)
    assert still_beating([part], lambda _: None) == set()


def test_it_beats_by_itself(tmp_path: Path) -> None:
    session = begun(tmp_path / "s.h5")
    first = alive_path(session.part_path).read_bytes()
    end_s = time.monotonic() + 60.0
    while alive_path(session.part_path).read_bytes() == first:  # nothing is recorded: the recording is paused
        assert time.monotonic() < end_s
        time.sleep(0.02)
    session.discard()
    assert list(tmp_path.iterdir()) == []


# --- the folder goes away ------------------------------------------------------------------------------------
def removed(folder: Path) -> None:
    shutil.rmtree(folder)


def renamed(folder: Path) -> None:
    folder.rename(folder.with_name("elsewhere"))


def replaced(folder: Path) -> None:
    renamed(folder)
    folder.mkdir()


@dataclass
class Away:
    """A session whose folder may go away, the other place, and what is told."""

    home: Path
    other: Path
    told: list[CarpusFault] = field(default_factory=list)

    def begun(self, *, raw: bool = False, rows: int = 20) -> SessionWriter:
        """So many rows of it on disk."""
        fallback = Fallback(lambda: self.other, self.told.append)
        session = begun(self.home / "s.h5", rows=rows, pictures=pictures if raw else None, fallback=fallback)
        session.flush()
        return session


@pytest.fixture
def away(tmp_path: Path) -> Away:
    made = Away(tmp_path / "home", tmp_path / "other")
    made.home.mkdir()
    made.other.mkdir()
    return made


@pytest.mark.parametrize("gone", [removed, renamed, replaced])
@pytest.mark.parametrize("raw", [False, True])
def test_a_recording_goes_on_when_its_folder_goes_away(away: Away, gone: Callable[[Path], None], raw: bool) -> None:
    session = away.begun(raw=raw)
    for row in range(20, 25):  # not yet on any disk
        session.append(make_frame(row), pictures(row) if raw else None)
    gone(away.home)
    start_s = time.monotonic()
    row = 25
    while not away.told:
        assert time.monotonic() - start_s < 60.0
        session.append(make_frame(row), pictures(row) if raw else None)
        row += 1
        time.sleep(0.005)
    (fault,) = away.told
    assert isinstance(fault, RecordingMoved)
    assert fault.subject == str(away.other / "s.h5")
    for more in range(row, row + 10):
        session.append(make_frame(more), pictures(more) if raw else None)
    session.add_event(time_of(3), "note", "after the move")
    session.close()
    assert session.path == away.other / "s.h5"
    result = read_session(session.path)
    assert result.timestamp_s.tolist() == [time_of(number) for number in range(row + 10)]
    for number in (0, 19, 20, 24, 25, row + 9):
        np.testing.assert_array_equal(result.motion.angles_rad[number], make_frame(number).moment.angles_rad)
    assert verify(session.path).sealed
    if raw:
        assert list(read_raw(session.path)) == [pictures(number) for number in range(row + 10)]
    assert [path.name for path in away.other.iterdir()] == ["s.h5"]


@pytest.mark.parametrize("reached", [False, True])
def test_a_disk_that_fails_as_the_first_smoothed_rows_come_is_left(
    away: Away, monkeypatch: pytest.MonkeyPatch, reached: bool
) -> None:
    """What is read back of it has none of the new tables, or the first of them."""
    session = away.begun(rows=6)
    on_disk, create = session.part_path.read_bytes(), part_file.create_smoothed

    def read_only(file: h5py.File, layout: TableLayout) -> dict[str, h5py.Dataset]:
        monkeypatch.setattr(part_file, "create_smoothed", create)
        new_file._create_growing(file, schema.SMOOTHED_FIELDS[0], layout)
        raise OSError(30, "Read-only file system")

    def not_reached() -> None:
        monkeypatch.undo()
        monkeypatch.setattr(part_file, "copy_open_file", lambda _, part: part.write_bytes(on_disk))
        raise OSError(30, "Read-only file system")

    if reached:
        monkeypatch.setattr(part_file, "create_smoothed", read_only)
    else:
        monkeypatch.setattr(session._part, "_synchronise", not_reached)
    session.add_smoothed(motion_of([make_frame(row) for row in range(3)]))
    session.flush()
    session.add_smoothed(motion_of([make_frame(row) for row in range(3, 6)]))
    session.close()
    assert [type(fault) for fault in away.told] == [RecordingMoved]
    result = read_session(session.path)
    np.testing.assert_array_equal(result.smoothed.angles_rad, result.motion.angles_rad)
    assert verify(session.path).sealed


def test_what_cannot_be_read_any_more_stays_behind_and_is_named(away: Away, monkeypatch: pytest.MonkeyPatch) -> None:
    session = away.begun()
    session.append(make_frame(20))

    def unplugged(*_: object) -> None:
        raise OSError(5, "Input/output error")

    monkeypatch.setattr(part_file, "copy_open_file", unplugged)
    gone = away.home.rename(away.home.with_name("unplugged"))
    session._part._heart.trouble = FolderGone(away.home)
    session.append(make_frame(21))
    session.close()
    (fault,) = away.told
    assert "20 rows" in fault.detail
    result = read_session(away.other / "s.h5")
    assert result.timestamp_s.tolist() == [time_of(20), time_of(21)]
    assert [event.kind for event in result.events] == ["moved"]
    assert verify(away.other / "s.h5").sealed
    recovery.remove(next(gone.glob("*.part")))
    (target,) = recover_folder(gone).recovered  # the disk comes back
    assert len(read_session(target)) == 20
    assert read_session(target).header.session_id != result.header.session_id


def test_without_another_place_it_is_told(away: Away) -> None:
    session = begun(away.home / "s.h5", rows=1)
    shutil.rmtree(away.home)
    with pytest.raises(FolderGone):
        session.close()
    session.abandon()


@pytest.mark.parametrize("kind", [OutputNotWritable, DiskFull])
def test_a_disk_that_cannot_be_written_is_left_but_for_a_full_one(
    away: Away, monkeypatch: pytest.MonkeyPatch, kind: type[CarpusFault]
) -> None:
    session, real = away.begun(), part_file.reserve

    def refused(descriptor: int, path: Path, begin: int, length: int) -> None:
        if path.parent == away.home:
            raise kind(path)
        real(descriptor, path, begin, length)

    monkeypatch.setattr(part_file, "reserve", refused)
    session.append(make_frame(20))
    if kind is DiskFull:
        with pytest.raises(DiskFull):
            session.flush()
        session.abandon()
        assert away.told == []
    else:
        session.close()
        assert len(away.told) == 1
        assert len(read_session(away.other / "s.h5")) == 21
        assert verify(away.other / "s.h5").sealed

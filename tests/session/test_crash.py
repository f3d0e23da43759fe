"""A session whose program ends without warning: the file opens, and at most the last second is missing."""

from __future__ import annotations

import bisect
import io
import random
import signal
import struct
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from carpus.core.session import new_file, part_file
from carpus.core.session.reader import read_detections, read_session
from carpus.core.session.recovery import recover_folder
from carpus.core.session.values import Session
from tests.session.samples import begun, make_frame, time_of

ROOT = Path(__file__).parents[2]

FRAMES_PER_SECOND = 30
RECORDER = """
import dataclasses, itertools, os, struct, sys
from pathlib import Path
from carpus.core.hand.protocols import HAND21
from tests.session.samples import begun, make_frame, make_header, time_of
frames = [make_frame(row, HAND21) for row in range(50)]
taken = os.open(sys.argv[2], os.O_RDWR | os.O_CREAT)
now_s = 0.0
writer = begun(Path(sys.argv[1]), make_header(HAND21), clock=lambda: now_s)
for row in itertools.count():  # as fast as it goes, on the clock of a camera with 30 frames a second
    now_s = row / 30
    writer.append(dataclasses.replace(frames[row % 50], index=row, timestamp_s=time_of(row)))
    os.pwrite(taken, struct.pack("<q", row + 1), 0)
    if row % 100 == 99:
        writer.add_event(time_of(row), "note", f"row {row}")
    if row == 2 * 30:
        print("begun", flush=True)
"""


def assert_rows_are_whole(session: Session) -> None:
    """Each row carries every value of the frame it was made from."""
    table = read_detections(session.path)
    for row in {0, len(session) // 2, len(session) - 1}:
        frame = make_frame(row % 50, session.header.protocol)
        np.testing.assert_array_equal(session.motion.position_m[row], frame.moment.position_m)
        np.testing.assert_array_equal(session.markers.measured_px[row], frame.marker_measured_px)
        np.testing.assert_array_equal(session.quality.measured_share[row], frame.measured_share)
        np.testing.assert_array_equal(table.of_frame(row).pixel, frame.detections.pixel)
        assert session.status[row] == frame.status


@pytest.mark.parametrize("kill", range(2))
def test_a_killed_recorder_loses_at_most_the_last_second(tmp_path: Path, kill: int) -> None:
    target, taken = tmp_path / "session.h5", tmp_path / "taken"
    command = [sys.executable, "-c", RECORDER, str(target), str(taken)]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as recorder:
        assert recorder.stdout.readline() == "begun\n"  # more than two seconds of them, however slow the machine
        time.sleep(random.Random(kill).uniform(0.05, 0.6))
        recorder.send_signal(signal.SIGKILL)
    assert not target.exists()
    (taken_rows,) = struct.unpack("<q", taken.read_bytes())
    (part,) = tmp_path.glob("*.part")
    with h5py.File(part, "r") as file:
        assert not file.attrs["complete"]
        stored_s = file["/frames/timestamp"][()]
        assert len(stored_s) >= taken_rows - FRAMES_PER_SECOND
        assert stored_s.tolist() == [time_of(row) for row in range(len(stored_s))]
        file["/joints/angles"][()]
        file["/events/text"].asstr()[()]
    assert taken_rows > 2 * FRAMES_PER_SECOND
    assert len(read_session(part)) == len(stored_s)

    recovery = recover_folder(tmp_path)
    assert (recovery.recovered, recovery.busy, recovery.faults) == ((target,), (), ())
    assert {path.name for path in tmp_path.iterdir()} == {"session.h5", "taken"}
    session = read_session(target)
    assert session.complete
    assert session.recovered
    assert session.timestamp_s.tolist() == stored_s.tolist()
    assert_rows_are_whole(session)


class LoggedFile(io.FileIO):
    """A file that notes every write, so that its state after each of them can be made again."""

    def __init__(self, path: Path) -> None:
        super().__init__(path, "x+")
        self.log: list[tuple[int | None, Any]] = []

    def write(self, data: Any) -> int:
        self.log.append((self.tell(), bytes(data)))
        return super().write(data)

    def truncate(self, size: int | None = None) -> int:
        self.log.append((None, size))
        return super().truncate(size)


def apply(image: bytearray, offset: int | None, data: Any) -> None:
    if offset is None:
        del image[data:]
        image.extend(bytes(data - len(image)))
    else:
        image.extend(bytes(max(0, offset + len(data) - len(image))))
        image[offset : offset + len(data)] = data


def test_between_any_two_writes_the_flushed_rows_are_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Not at random moments but all along: the file is cut after every sixteenth write of HDF5 and recovered."""
    recorded = tmp_path / "recorded"
    recorded.mkdir()
    files: list[LoggedFile] = []

    def logged(path: Path) -> h5py.File:
        files.append(LoggedFile(path))
        return h5py.File(files[0], "w", libver="earliest", rdcc_nbytes=0)

    monkeypatch.setattr(part_file, "new_file", logged)
    monkeypatch.setattr(part_file, "reserve", lambda *_: None)  # the room it would take is added to the image below
    monkeypatch.setattr(new_file, "_CHUNK_ROWS", {"N": 8, "D": 32, "E": 4})  # many new chunks: the delicate moment
    target = recorded / "s.h5"
    session = begun(target)
    log = files[0].log
    flushed = [(len(log), 0)]
    for row in range(24):
        session.append(make_frame(row))
        if row % 6 == 5:
            session.add_event(time_of(row), "note", f"after row {row}")
            session.flush()
            flushed.append((len(log), row + 1))
    part_name = session.part_path.name
    session.abandon()
    files[0].close()

    image = bytearray()
    again = tmp_path / "again"
    again.mkdir()
    cuts = 0
    for written, (offset, data) in enumerate(log, start=1):
        apply(image, offset, data)
        at = bisect.bisect_right([begin for begin, _ in flushed], written) - 1
        if at < 1 or written % 16:
            continue
        cuts += 1
        safe_rows = flushed[at][1]
        (again / part_name).write_bytes(image + bytes(300_000))
        with h5py.File(again / part_name, "r") as file:
            times_s = file["/frames/timestamp"]
            assert times_s[:safe_rows].tolist() == [time_of(row) for row in range(safe_rows)]
            others = [one for group in ("wrist", "markers", "quality") for one in file[group].values()]
            assert min(len(one) for one in others) >= len(times_s), "a row with a time has all the rest"
        recovery = recover_folder(again)
        assert recovery.recovered == (again / "s.h5",), f"after write {written}: {recovery.faults}"
        result = read_session(again / "s.h5")
        assert len(result) >= safe_rows
        assert len(result.events) >= at
        assert_rows_are_whole(result)
        (again / "s.h5").unlink()
    assert cuts > 15


@pytest.mark.parametrize("torn_at", [0.0, 0.3, 0.97])
def test_a_chunk_that_was_half_written_keeps_its_earlier_rows(tmp_path: Path, torn_at: float) -> None:
    """The system may end a write of many pages between two of them; the check sum then fits neither state."""
    session = begun(tmp_path / "s.h5", rows=60)
    session.flush()
    before = session.part_path.read_bytes()
    for row in range(60, 90):
        session.append(make_frame(row))
    session.abandon()
    part = session.part_path
    with h5py.File(part, "r") as file:
        places = [file[name].id.get_chunk_info(0) for name in ("/wrist/angles", "/frames/timestamp", "/wrist/position")]
    image = bytearray(part.read_bytes())
    for place in places:
        begin, end = place.byte_offset + int(torn_at * place.size), place.byte_offset + place.size
        image[begin:end] = before[begin:end]
    part.write_bytes(image)
    assert 60 <= len(read_session(part)) <= 90
    (target,) = recover_folder(tmp_path).recovered
    result = read_session(target)
    assert 60 <= len(result) <= 90
    for row in range(60):
        np.testing.assert_array_equal(result.motion.position_m[row], make_frame(row).moment.position_m)
        np.testing.assert_array_equal(result.motion.angles_rad[row], make_frame(row).moment.angles_rad)

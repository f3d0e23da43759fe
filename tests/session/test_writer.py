"""The writer: nothing overwritten, nothing half-written taken for whole, a full disk loses nothing that was stored."""

from __future__ import annotations

import contextlib
import errno
import os
import subprocess
import sys
import uuid
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path

import h5py
import numpy as np
import pytest

from carpus.core.errors import CarpusFault, DiskFull, OutputExists, OutputNotWritable, TimesUnordered
from carpus.core.hand.protocols import HAND21
from carpus.core.session import disk, part_file, writer
from carpus.core.session.reader import has_raw, raw_depth_unit_m, read_raw, read_session, verify
from carpus.core.session.recovery import recover_folder
from carpus.core.session.values import Motion, RawPictures, motion_of
from carpus.core.session.writer import FLUSH_EVERY_S, SessionWriter
from tests.moments import with_moment
from tests.session.samples import begun, make_frame, make_header

ROOT = Path(__file__).parents[2]


def rows_on_disk(session: SessionWriter) -> int:
    """Read from a copy, as another program would see it."""
    copy = session.part_path.with_suffix(".copy")
    copy.write_bytes(session.part_path.read_bytes())
    with h5py.File(copy, "r") as file:
        return int(file["/frames/timestamp"].shape[0])


def test_rows_reach_the_disk_within_a_second(tmp_path: Path) -> None:
    now_s = 100.0
    session = begun(tmp_path / "s.h5", clock=lambda: now_s)
    for row in range(60):
        now_s += 1 / 30
        session.append(make_frame(row))
        assert rows_on_disk(session) >= row + 1 - 30
    assert FLUSH_EVERY_S < 1.0
    session.close()


def test_memory_held_is_bounded_when_the_clock_stands_still(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(writer, "ROWS_HELD", 8)
    session = begun(tmp_path / "s.h5", rows=20)
    assert rows_on_disk(session) == 16
    session.close()


def open_below(folder: Path) -> list[str]:
    """What this process holds open of a folder."""
    held = []
    for descriptor in Path("/proc/self/fd").iterdir():
        with contextlib.suppress(FileNotFoundError):  # the one that reads this list
            held.append(str(descriptor.readlink()))
    return [path for path in held if path.startswith(str(folder))]


@pytest.mark.parametrize("end", [SessionWriter.close, SessionWriter.abandon, SessionWriter.discard])
def test_no_file_stays_open(tmp_path: Path, end: Callable[[SessionWriter], None]) -> None:
    session = begun(tmp_path / "s.h5", rows=1)
    assert open_below(tmp_path)
    end(session)
    assert open_below(tmp_path) == []


@pytest.mark.parametrize("links", [True, False])
def test_the_name_appears_only_when_the_session_is_whole_and_never_on_another_file(
    tmp_path: Path, links: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_links(*_: object) -> None:
        raise OSError(errno.EPERM, "no hard links on this disk")

    if not links:
        monkeypatch.setattr(os, "link", no_links)
    target = tmp_path / "s.h5"
    session = begun(target, rows=1)
    session.flush()
    assert [path.suffix for path in tmp_path.iterdir() if path.suffix != ".alive"] == [".part"]
    session.close()
    session.close()
    assert [path.name for path in tmp_path.iterdir()] == ["s.h5"]
    assert read_session(target).complete
    target.unlink()
    session = begun(target, rows=1)
    target.write_text("mine")
    for end in (lambda: begun(target, make_header(session_id=uuid.uuid4())), session.close):
        with pytest.raises(OutputExists):
            end()
    assert recover_folder(tmp_path).recovered == (tmp_path / "s-2.h5",)
    assert len(read_session(tmp_path / "s-2.h5")) == 1
    assert target.read_text() == "mine"


def test_a_fault_on_the_way_leaves_the_part_and_no_session(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt), begun(tmp_path / "s.h5", rows=1):
        raise KeyboardInterrupt
    (part,) = tmp_path.iterdir()
    assert part.suffix == ".part"
    assert len(read_session(part)) == 1


@pytest.mark.parametrize(
    ("place", "number", "kind"),
    [
        ("nowhere/s.h5", 0, OutputNotWritable), ("file/s.h5", 0, OutputNotWritable),
        ("s.h5", errno.EACCES, OutputNotWritable), ("s.h5", errno.ENOSPC, DiskFull),
    ],
)  # fmt: skip
def test_what_cannot_be_begun_is_told_and_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: str, number: int, kind: type[CarpusFault]
) -> None:
    def refuse(*_: object) -> h5py.File:  # root passes every real lock
        raise OSError(number, "denied")

    (tmp_path / "file").write_text("")
    if number:
        monkeypatch.setattr(*((os, "posix_fallocate") if kind is DiskFull else (part_file, "new_file")), refuse)
    with pytest.raises(kind) as caught:
        begun(tmp_path / place)
    assert kind is DiskFull or caught.value.subject == str((tmp_path / place).parent)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_times_that_do_not_rise_and_wrong_shapes_are_refused(tmp_path: Path) -> None:
    session = begun(tmp_path / "s.h5")
    session.append(make_frame(1))
    with pytest.raises(TimesUnordered):
        session.append(make_frame(0))
    session.flush()
    session.append(with_moment(make_frame(2), position_m=np.array(0.0)))
    with pytest.raises(ValueError, match="/wrist/position"):
        session.flush()
    session.discard()
    assert list(tmp_path.iterdir()) == []


def test_a_smoothed_result_that_comes_bit_by_bit_is_stored_as_one_that_comes_at_once(tmp_path: Path) -> None:
    frames = [make_frame(row, HAND21) for row in range(9)]
    smoothed = [make_frame(row + 100, HAND21) for row in range(9)]
    whole, bits = (begun(tmp_path / name, make_header(HAND21)) for name in ("whole.h5", "bits.h5"))
    for row, frame in enumerate(frames):
        whole.append(frame)
        bits.append(frame)
        if row in (3, 4, 8):
            bits.flush()
            assert bits.stored == row + 1
            bits.add_smoothed(motion_of(smoothed[bits.smoothed : row]))
            assert bits.smoothed == row
    with pytest.raises(ValueError, match="/smoothed"):
        whole.write_smoothed(motion_of(smoothed[:1]))
    whole.write_smoothed(motion_of(smoothed))
    bits.add_smoothed(motion_of(smoothed[8:]))
    with pytest.raises(ValueError, match="/smoothed"):
        bits.add_smoothed(motion_of(smoothed[8:]))
    whole.close()
    bits.close()
    assert verify(tmp_path / "bits.h5") == verify(tmp_path / "whole.h5")
    read = [read_session(tmp_path / name).smoothed for name in ("whole.h5", "bits.h5")]
    for field in fields(Motion):
        np.testing.assert_array_equal(getattr(read[1], field.name), getattr(read[0], field.name))


def test_a_smoothed_result_that_does_not_come_to_all_frames_is_left_out(tmp_path: Path) -> None:
    session = begun(tmp_path / "s.h5", rows=4)
    session.add_smoothed(motion_of([make_frame(0), make_frame(1)]))
    session.drop_smoothed()
    session.close()
    verify(tmp_path / "s.h5")
    assert read_session(tmp_path / "s.h5").smoothed is None


def test_pictures_come_back_byte_for_byte(tmp_path: Path) -> None:
    path = tmp_path / "s.h5"
    pictures = [RawPictures(b"color %d" % row * row, b"" if row == 2 else b"depth %d" % row) for row in range(5)]
    session = begun(path, raw_depth_unit_m=0.001)
    for row, raw in enumerate(pictures):
        session.append(make_frame(row), raw)
        if row % 2:
            session.flush()
    with pytest.raises(ValueError, match="every frame"):
        session.append(make_frame(9))
    session.close()
    assert has_raw(path)
    assert raw_depth_unit_m(path) == 0.001
    assert list(read_raw(path)) == pictures


BOUNDED = """
import resource, sys
from pathlib import Path
from carpus.core.errors import DiskFull
from carpus.core.hand.protocols import HAND21
from tests.session.samples import begun, make_frame, make_header
target = Path(sys.argv[1])
resource.setrlimit(resource.RLIMIT_FSIZE, (8_000_000, 8_000_000))
session = begun(target, make_header(HAND21))
row = flushed = 0
try:
    while row < 5000:
        session.append(make_frame(row, HAND21))
        row += 1
        if row % 25 == 0:
            session.flush()
            flushed = row
except DiskFull as fault:
    print(flushed, Path(fault.subject).name)
    try:
        session.append(make_frame(row, HAND21))
    except DiskFull:
        print("still full")
    session.close()
"""


def test_a_full_disk_is_told_and_what_was_stored_stays(tmp_path: Path) -> None:
    target = tmp_path / "s.h5"
    command = [sys.executable, "-c", BOUNDED, str(target)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    flushed, part_name, *rest = done.stdout.split()
    assert rest == ["still", "full"]
    assert int(flushed) > 0
    assert not target.exists()
    assert [path.name for path in tmp_path.iterdir()] == [part_name]
    assert len(read_session(tmp_path / part_name)) == int(flushed)
    assert recover_folder(tmp_path).recovered == (target,)
    session = read_session(target)
    assert len(session) == int(flushed)
    np.testing.assert_array_equal(
        session.motion.joint_position_m[-1], make_frame(len(session) - 1, HAND21).moment.joint_position_m
    )


def test_a_disk_that_cannot_reserve_is_asked_how_much_is_free(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(*_: int) -> None:
        raise OSError(errno.EOPNOTSUPP, "not here")

    monkeypatch.setattr(os, "posix_fallocate", unknown)
    session = begun(tmp_path / "s.h5", rows=1)
    session.flush()
    usage = disk.shutil.disk_usage(tmp_path)._replace(free=1000)
    monkeypatch.setattr(disk.shutil, "disk_usage", lambda _: usage)
    session.append(make_frame(1))
    with pytest.raises(DiskFull):
        session.flush()
    session.close()
    (part,) = tmp_path.iterdir()
    assert len(read_session(part)) == 1


@pytest.mark.parametrize(
    ("number", "kind"), [(errno.ENOSPC, DiskFull), (errno.EDQUOT, DiskFull), (errno.EIO, OutputNotWritable)]
)
def test_a_failing_write_is_a_typed_fault(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int, kind: type[CarpusFault]
) -> None:
    session = begun(tmp_path / "s.h5", rows=1)

    def broken(_: int) -> None:
        raise OSError(number, "broken")

    monkeypatch.setattr(os, "fsync", broken)
    with pytest.raises(kind):
        session.flush()
    monkeypatch.undo()
    with pytest.raises(kind):
        session.append(make_frame(1))
    session.close()
    assert not (tmp_path / "s.h5").exists()


def test_a_finished_file_has_no_reserved_room_left(tmp_path: Path) -> None:
    path = tmp_path / "s.h5"
    begun(path, rows=1).close()
    size = path.stat().st_size
    with h5py.File(path, "r") as file:
        assert file.id.get_filesize() == size < 10e6

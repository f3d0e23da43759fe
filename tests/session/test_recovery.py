"""Interrupted recordings are finished from their journals, and part files of Carpus 0.2.0 still are."""

from __future__ import annotations

import os
import struct
import subprocess
import sys
from dataclasses import fields
from datetime import UTC, datetime
from pathlib import Path

import h5py
import numpy as np
import pytest

from carpus.core.model.errors import RecordingMissing, SessionUnfinished, SessionUnreadable
from carpus.core.records.recordings import (
    RecoveryResult,
    SessionDraft,
    publish_session,
    recover_recordings,
    spool_folder,
    write_session,
)
from carpus.core.session.reader import read_detections, read_session, verify
from carpus.core.session.values import Motion, stack_states
from tests.commands import Command
from tests.session.samples import compute_time, make_frame, write_journal
from tests.session.test_golden import unpack_golden

ROOT = Path(__file__).parents[2]
N = 10
NOW = datetime(2026, 11, 14, 8, 0, tzinfo=UTC)
PART = "v2-wrist6.h5.0123abcd.part"


def interrupt(path: Path, rows: int = N, smoothed: int = 0) -> Path:
    """A journal as a kill leaves it."""
    journal = write_journal(path, rows)
    if rows:
        journal.add_event(compute_time(1), "note", "x")
    if smoothed:
        journal.add_smoothed(stack_states([make_frame(row + 100) for row in range(smoothed)]))
    journal.close()
    return path


def old_part(folder: Path, name: str = PART) -> Path:
    """12 rows of wrist6, an event, and 5 rows of the smoother's result, of a killed Carpus 0.2.0."""
    path = unpack_golden(PART, folder).rename(folder / name)
    os.utime(path, (0, 0))
    return path


def test_recovery_interrupted_recording_equals_stopped_one(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    whole = write_session(interrupt(tmp_path / "whole.journal", smoothed=N))
    interrupt(tmp_path / "a" / "s.journal", smoothed=N)
    recovery = recover_recordings(tmp_path / "a", NOW)
    assert recovery == RecoveryResult((tmp_path / "a" / "s.h5",), (), ())
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["s.h5"]
    session, other = read_session(tmp_path / "a" / "s.h5"), read_session(whole)
    assert (len(session), session.recovered) == (N, "2026-11-14T08:00:00+00:00")
    assert session.repetitions == other.repetitions
    assert [event.text for event in session.events] == ["x"]
    assert verify(session.path).has_checksum
    for field in fields(Motion):
        expected = getattr(stack_states([make_frame(row + 100) for row in range(N)]), field.name)
        np.testing.assert_array_equal(getattr(session.smoothed, field.name), expected)


def test_session_draft_in_parts_equals_whole(tmp_path: Path) -> None:
    journal = write_journal(tmp_path / "s.journal", 1100)
    draft = SessionDraft(journal.path)
    draft.read()
    journal.add_smoothed(stack_states([make_frame(row) for row in range(700)]))
    for row in range(1100, 1130):
        journal.append(make_frame(row))
    journal.add_smoothed(stack_states([make_frame(row) for row in range(700, 1130)]))
    journal.flush()
    followed = draft.finish()
    draft.discard()
    once = write_session(journal.path.rename(tmp_path / "once.journal"))
    journal.discard()
    with h5py.File(followed) as one, h5py.File(once) as other:
        assert one.attrs["seal"] == other.attrs["seal"]
        assert one["/smoothed/wrist/angles"].shape[0] == 1130


def test_recovery_drops_half_a_smoothed_result(tmp_path: Path) -> None:
    path = interrupt(tmp_path / "s.journal", smoothed=N // 2)
    data = bytearray(path.read_bytes())
    data[data.rindex(b"/events/kind") + 500] ^= 1
    path.write_bytes(data)
    session = read_session(write_session(path))
    assert (len(session), session.smoothed, session.events) == (N, None, ())


@pytest.mark.parametrize(
    ("place", "kept_as", "names"),
    [
        ("image", "s.journal", ["t.h5"]),
        ("rows", "s.journal", ["t.h5"]),
        ("event", "s.damaged", ["s.h5", "t.h5"]),
    ],
)
def test_recovery_damaged_journal_is_kept(tmp_path: Path, place: str, kept_as: str, names: list[str]) -> None:
    path = interrupt(tmp_path / "s.journal", smoothed=N)
    data = bytearray(path.read_bytes())
    data[{"image": 500, "rows": data.index(b"ROWS") + 5, "event": data.rindex(b"ROWS") + 5}[place]] ^= 1
    path.write_bytes(data)
    journal = write_journal(tmp_path / "t.journal")  # a power cut may cost the end, which is no damage
    journal.append(make_frame(0))
    journal.flush()
    journal.append(make_frame(1))
    journal.close()
    os.truncate(journal.path, journal.path.stat().st_size - 100)
    recovery = recover_recordings(tmp_path)
    assert [one.name for one in recovery.recovered] == names
    assert [Path(fault.subject).name for fault in recovery.faults] == [kept_as]
    assert (tmp_path / kept_as).read_bytes() == data


def test_recovery_running_recording_is_left_alone(tmp_path: Path) -> None:
    journal = write_journal(tmp_path / "s.journal", 1)
    program = """if True:
        import sys
        from pathlib import Path
        from carpus.core.records.recordings import recover_recordings
        print(*recover_recordings(Path(sys.argv[1])).in_progress)
    """
    command = [sys.executable, "-c", program, str(tmp_path)]
    elsewhere = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert elsewhere.stdout.split() == [str(journal.path)]
    assert recover_recordings(tmp_path).in_progress == (journal.path,)
    journal.close()
    assert recover_recordings(tmp_path).recovered == (tmp_path / "s.h5",)


def test_recovery_interrupted_makes_no_second_session(tmp_path: Path) -> None:
    write_session(interrupt(tmp_path / "s.journal"))
    assert recover_recordings(tmp_path).recovered == (tmp_path / "s.h5",)
    assert [path.name for path in tmp_path.iterdir()] == ["s.h5"]


def test_recovery_unfinishable_files_stay_and_names_are_kept(tmp_path: Path) -> None:
    interrupt(tmp_path / "empty.journal", rows=0)
    interrupt(tmp_path / "s.journal")
    (tmp_path / "s.h5").write_text("mine")
    (tmp_path / "junk.journal").write_bytes(b"not a journal at all")
    (tmp_path / "junk.h5.01234567.part").write_bytes(b"not HDF5 at all")
    (tmp_path / "download.part").write_text("not ours")
    os.utime(tmp_path / "junk.h5.01234567.part", (0, 0))
    recovery = recover_recordings(tmp_path)
    assert recovery.recovered == (tmp_path / "s-2.h5",)
    assert recovery.empty == (tmp_path / "empty.journal",)
    assert [(type(fault), Path(fault.subject).name) for fault in recovery.faults] == [
        (SessionUnreadable, "junk.h5.01234567.part"),
        (SessionUnreadable, "junk.journal"),
    ]
    assert {path.name for path in tmp_path.iterdir()} == {
        "s.h5", "s-2.h5", "junk.journal", "junk.h5.01234567.part", "download.part",
    }  # fmt: skip
    assert (tmp_path / "s.h5").read_text() == "mine"
    with pytest.raises(RecordingMissing):
        recover_recordings(tmp_path / "nowhere")


def test_recovery_old_part_file_is_finished(tmp_path: Path) -> None:
    with pytest.raises(SessionUnfinished):
        verify(old_part(tmp_path))
    (tmp_path / f"{PART}.alive").write_text("{}")
    assert recover_recordings(tmp_path, NOW).recovered == (tmp_path / "v2-wrist6.h5",)
    assert [path.name for path in tmp_path.iterdir()] == ["v2-wrist6.h5"]
    session = read_session(tmp_path / "v2-wrist6.h5")
    assert (len(session), session.recovered, session.smoothed) == (12, "2026-11-14T08:00:00+00:00", None)
    np.testing.assert_array_equal(
        session.motion.angles_rad, np.array([make_frame(row).kinematics.angles_rad for row in range(12)])
    )
    assert [event.text for event in session.events] == ["Grüße"]
    assert len(read_detections(session.path).blobs) == sum(len(make_frame(row).detections) for row in range(12))
    assert verify(session.path).has_checksum


def test_recovery_part_file_is_cut_to_whole_rows(tmp_path: Path) -> None:
    """One whose last blob is missing, whose smoother's result is whole, and whose end HDF5 had not written yet."""
    part = old_part(tmp_path)
    with h5py.File(part, "r+") as file:
        last = int(file["/detections/frame"][-1])
        for name in set(file["/detections"]) - {"count"}:
            file["/detections"][name].resize(len(file["/detections"][name]) - 1, axis=0)
        file["/smoothed"].visititems(lambda _, one: one.resize(last, axis=0) if isinstance(one, h5py.Dataset) else None)
    with part.open("r+b") as raw:
        raw.seek(40)
        raw.write(struct.pack("<Q", part.stat().st_size // 2))
    os.utime(part, (0, 0))
    (path,) = recover_recordings(tmp_path).recovered
    session = read_session(path)
    assert (len(session), len(session.smoothed.angles_rad)) == (last, last)


def test_recovery_open_part_file_is_left_alone(tmp_path: Path) -> None:
    part = old_part(tmp_path)
    os.utime(part)
    assert recover_recordings(tmp_path).in_progress == (part,)
    with h5py.File(part, "r+"):
        os.utime(part, (0, 0))
        assert recover_recordings(tmp_path).in_progress == (part,)


@pytest.mark.parametrize("links", [True, False])
def test_recovery_killed_while_publishing_continues(
    tmp_path: Path, links: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise OSError(18, "another disk")

    if not links:
        monkeypatch.setattr(os, "link", refuse)
    here, home = tmp_path / "here", tmp_path / "home"
    here.mkdir()
    path = write_session(interrupt(here / "s.journal"))
    content = path.read_bytes()
    path.with_suffix(".carpusraw").write_bytes(b"pictures")
    home.mkdir()
    (home / "s.h5").write_text("another's")
    (home / "s-2.carpusraw").write_bytes(b"pictures")  # arrived before the kill
    if not links:
        (home / ".s-2.h5.0123abcd.tmp").write_bytes(content[:9])  # was arriving
    assert publish_session(path, home) == home / "s-2.h5"
    assert (home / "s-2.h5").read_bytes() == content
    assert (home / "s.h5").read_text() == "another's"
    assert [one.name for one in here.iterdir()] == ["s.journal"]
    (here / "s-2.h5").write_bytes(content)  # arrived, and not yet taken away here
    assert publish_session(here / "s-2.h5", home) == home / "s-2.h5"
    assert sorted(one.name for one in home.iterdir()) == ["s-2.carpusraw", "s-2.h5", "s.h5"]


@pytest.mark.parametrize("given", [".", "sessions"])
def test_recover_command_finishes_local_recordings(tmp_path: Path, command: Command, given: str) -> None:
    data = tmp_path / "data"
    (data / "sessions").mkdir(parents=True)
    place = spool_folder(data) / "patient"
    place.mkdir(parents=True)
    interrupt(place / "s.journal")
    done = command("recover", data / given)
    assert done.code == 0
    assert f"Recovered: {place / 's.h5'}\nIt is moved into the data folder" in done.out
    assert "No interrupted session here." in command("recover", data / given).out

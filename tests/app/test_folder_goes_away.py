"""The data folder goes away while a session is recorded: it goes on elsewhere, says so, and comes home."""

from __future__ import annotations

import shutil
import time
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np

from carpus.core.camera import DEFAULT_CAMERA
from carpus.core.capture.files.raw import LOOK_EVERY_S, RawRecording, RawWriter
from carpus.core.capture.source import SourceInfo
from carpus.core.errors import CarpusFault, FolderMissing, RecordingMoved, RecordingReturned, ShareEmpty, WaitingErased
from carpus.core.pipeline.live import LiveSession
from carpus.core.records.erasure import erase, plan_patient
from carpus.core.records.library import Library
from carpus.core.records.new_sessions import NewSessions, fallback_place, recover
from carpus.core.records.values import PatientEntry
from carpus.core.session.writer import Fallback, SessionWriter
from carpus.core.types import Frame
from tests.app.test_library import set_up
from tests.pipeline.live_fakes import HeldSource
from tests.records.samples import record
from tests.session.samples import CAMERA, CREATED, make_calibration, make_frame, make_header

INFO = SourceInfo("x", replace(DEFAULT_CAMERA, width_px=64, height_px=48), False, None, 30.0, {})


def picture(row: int) -> Frame:
    return Frame(row, row / 30.0, np.full((48, 64, 3), row, np.uint8), None, 1e-3)


def test_raw_pictures_go_on_too(tmp_path: Path) -> None:
    home, other = tmp_path / "home", tmp_path / "other"
    home.mkdir()
    other.mkdir()
    now_s = 0.0
    writer = RawWriter(home / "s.carpusraw", INFO, lossless=True, fallback=lambda: other, clock=lambda: now_s)
    for row in range(5):
        writer.append_frame(picture(row))
    shutil.rmtree(home)
    for row in range(5, 12):
        now_s += 2 * LOOK_EVERY_S
        writer.append_frame(picture(row))
    writer.close()
    assert writer.path == other / "s.carpusraw"
    recording = RawRecording(writer.path)
    assert [int(frame.color_rgb[0, 0, 0]) for frame in recording.frames()] == list(range(12))
    assert recording.complete


def test_it_is_told_within_a_second_and_the_session_comes_home(tmp_path: Path) -> None:
    """From the live session's own events to the next start of the program."""
    data = tmp_path / "data"
    library = Library(data)
    key = library.patients.add(PatientEntry("Linden 42", "left"))
    path = library.index.new_path(key, "Linden 42", "wrist flexion", "left", CREATED)
    source = HeldSource()
    source.let(10_000)
    with LiveSession(source) as live:
        fallback = Fallback(lambda: NewSessions(library).fallback_folder(key), live.notice)
        writer = SessionWriter.create(path, make_header(), CAMERA, make_calibration(), fallback=fallback)
        for row in range(20):
            writer.append(make_frame(row))
        gone_s = time.monotonic()
        data.rename(tmp_path / "unplugged")
        row, told = 20, []
        while not told:
            assert time.monotonic() - gone_s < 60.0
            writer.append(make_frame(row))
            row += 1
            time.sleep(0.01)
            told = [event.cause for event in live.drain_events() if isinstance(event.cause, RecordingMoved)]
        writer.close()
    assert writer.path.parent == fallback_place(data) / key
    assert writer.path.parent.stat().st_mode & 0o777 == 0o700
    session_id = NewSessions(library).entered(set_up(key, "Linden 42"), writer.path)
    assert len(library.session(session_id)) == row  # it can be reviewed although the register is gone
    library.close()

    (tmp_path / "unplugged").rename(data)  # the disk is back, with what was flushed before
    library = Library(data)
    _, faults = recover(library)
    assert [type(fault) for fault in faults] == [RecordingReturned]
    (entry,) = library.sessions(key)
    assert entry.frames == row
    assert library.session(entry.session_id).header.session_id == session_id
    assert list(fallback_place(data).iterdir()) == []
    library.close()


def test_while_the_share_is_away_the_window_starts_and_measures_here(tmp_path: Path) -> None:
    """Nothing is made where the share belongs, which would hide under it once it is mounted."""
    data, share = tmp_path / "data", tmp_path / "share"
    with closing(Library(data, sessions=share)) as library:
        assert [type(fault) for fault in recover(library)[1]] == [FolderMissing]
        told: list[CarpusFault] = []
        library.log_fault = told.append
        linden = library.patients.add(PatientEntry("Linden 42", "left"))
        choice = set_up(linden, "Linden 42")
        path = record(NewSessions(library).new_path(choice), "Linden 42", CREATED, "left")
        assert path.parent == fallback_place(data) / linden
        assert [type(fault) for fault in told] == [RecordingMoved]
        NewSessions(library).entered(choice, path)
        recover(library)
        assert path.exists()
        assert not share.exists()
    share.mkdir()
    with closing(Library(data, sessions=share)) as library:
        assert [type(fault) for fault in recover(library)[1]] == [RecordingReturned]
        assert [one.path.parent for one in library.sessions(linden)] == [share / linden]


def test_a_share_keeps_its_rights(tmp_path: Path) -> None:
    """It may belong to another account, which alone may change them."""
    share = tmp_path / "share"
    share.mkdir(0o770)
    share.chmod(0o770)
    with closing(Library(tmp_path / "data", sessions=share)) as library:
        assert share.stat().st_mode & 0o777 == 0o770
        linden = library.patients.add(PatientEntry("Linden 42", "left"))
        NewSessions(library).new_path(set_up(linden, "Linden 42"))
    assert share.stat().st_mode & 0o777 == 0o770
    assert (share / linden).stat().st_mode & 0o777 == 0o700


def test_what_waits_of_a_patient_who_was_erased_is_erased_and_brings_nobody_back(tmp_path: Path) -> None:
    data, share = tmp_path / "data", tmp_path / "share"
    with closing(Library(data, sessions=share)) as library:
        linden = library.patients.add(PatientEntry("Linden 42", "left"))
        path = record(NewSessions(library).new_path(set_up(linden, "Linden 42")), "Linden 42", CREATED, "left")
        path.with_name("damaged.h5").write_bytes(b"of a kill")
        path.with_name("pictures.carpusraw").write_bytes(b"without a session")
        heron = library.patients.add(PatientEntry("Heron 17", "left"))
        record(NewSessions(library).new_path(set_up(heron, "Heron 17")), "Heron 17", CREATED, "left")
        library.patients.change(heron, PatientEntry("Heron 18", "left"))
        erase(library.store, plan_patient(library.store, linden), library.log)
        share.mkdir()
        told = [type(fault) for fault in recover(library)[1]]
        assert (told.count(WaitingErased), told.count(RecordingReturned)) == (1, 1)
        assert not path.parent.exists(), "also what cannot be read"
        assert [one.entry.pseudonym for one in library.patients.listed()] == ["Heron 18"], "by identity, not by name"
        assert len(library.sessions(heron)) == 1


def test_the_empty_place_of_a_share_is_not_taken_for_the_share(tmp_path: Path) -> None:
    data, share = tmp_path / "data", tmp_path / "share"
    share.mkdir()
    with closing(Library(data, sessions=share)) as library:
        assert recover(library) == ([], []), "a new one is empty"
        linden = library.patients.add(PatientEntry("Linden 42", "left"))
        choice = set_up(linden, "Linden 42")
        places = NewSessions(library)
        places.entered(choice, record(places.new_path(choice), "Linden 42", CREATED, "left"))
        share.rename(tmp_path / "unplugged")
        share.mkdir()
        assert [type(fault) for fault in recover(library)[1]] == [ShareEmpty]
        path = record(places.new_path(choice), "Linden 42", CREATED, "left")
        assert path.is_relative_to(fallback_place(data)), "under the share it would be hidden"
        places.entered(choice, path)
        assert list(share.iterdir()) == []
        share.rmdir()
        (tmp_path / "unplugged").rename(share)
        assert [type(fault) for fault in recover(library)[1]] == [RecordingMoved, RecordingReturned]
        assert len(library.sessions(linden)) == 2

"""A disk that neither stores nor refuses: said within seconds, and the recording goes on elsewhere without a gap."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from carpus.core.camera import DEFAULT_CAMERA
from carpus.core.capture.files.raw import RawRecording, RawWriter
from carpus.core.capture.source import SourceInfo
from carpus.core.errors import DiskStalled, EndStalled, RecordingMoved
from carpus.core.pipeline.live import LiveSession
from carpus.core.pipeline.live_values import LiveSettings
from carpus.core.pipeline.recorder import Patience, Recorder
from carpus.core.session.reader import read_session
from carpus.core.session.recovery import recover_folder
from carpus.core.session.writer import Fallback, SessionWriter
from carpus.core.types import Frame, TrackedFrame
from tests.pipeline.live_fakes import FakeSession, HeldSource, frame, tracked, wait_until
from tests.session.samples import CAMERA, make_calibration, make_header

SETTINGS = LiveSettings(told_stall_s=0.3, moved_stall_s=0.8)


class Share:
    """The system's fsync of a folder, which does not return while it is stalled; other folders are not touched."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._real = folder, os.fsync
        self._answers = threading.Event()
        self._answers.set()
        self.stuck = 0

    def fsync(self, descriptor: int) -> None:
        if Path(f"/proc/self/fd/{descriptor}").readlink().is_relative_to(self._folder):
            self.stuck += 1
            self._answers.wait()
            self.stuck -= 1
        self._real(descriptor)

    def stall(self) -> None:
        self._answers.clear()

    def answer(self) -> None:
        self._answers.set()


@pytest.fixture
def share(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Share]:
    if not Path("/proc/self/fd").is_dir():
        pytest.skip("which file a descriptor is, only Linux says")
    (tmp_path / "share").mkdir()
    share = Share(tmp_path / "share")
    monkeypatch.setattr(os, "fsync", share.fsync)
    yield share
    share.answer()
    wait_until(lambda: not [one for one in threading.enumerate() if one.name in ("writing", "heartbeat")])


def fallback_folder(tmp_path: Path) -> Path:
    (tmp_path / "here").mkdir(exist_ok=True)
    return tmp_path / "here"


def recorder_on(
    path: Path, told: list[Exception], here: Path, *waits_s: float
) -> Recorder[SessionWriter, TrackedFrame]:
    """Writes a session to ``path``, as patient as ``waits_s`` say; ``here`` has the computer's own fallback."""
    fallback = Fallback(lambda: fallback_folder(here), told.append)
    recorder = Recorder(
        "writing",
        lambda: SessionWriter.create(path, make_header(), CAMERA, make_calibration(), fallback=fallback),
        lambda sink, row: (sink.append(row), sink.flush()),
        900,
        told.append,
        patience=Patience(told.append, lambda sink, _: sink.go_on_elsewhere(), *waits_s),
    )
    recorder.start()
    return recorder


def test_the_recording_goes_on_elsewhere_without_a_gap(tmp_path: Path, share: Share) -> None:
    source = HeldSource()
    with LiveSession(source, SETTINGS) as live:
        live.begin_tracking(tracked)
        fallback = Fallback(lambda: fallback_folder(tmp_path), live.notice)
        path = tmp_path / "share" / "s.h5"
        live.start_recording(
            lambda: SessionWriter.create(path, make_header(), CAMERA, make_calibration(), fallback=fallback)
        )

        def one_more(count: int) -> int:
            source.let(1)
            wait_until(lambda: live.counters().tracked == count + 1)
            time.sleep(0.01)
            return count + 1

        count = 0
        begin_s = time.monotonic()
        while time.monotonic() - begin_s < 1.5:  # some flushes reach the share
            count = one_more(count)
        share.stall()
        stalled_s = time.monotonic()
        told: list[tuple[float, type[BaseException]]] = []
        slowest_s = 0.0
        while not any(kind is RecordingMoved for _, kind in told):
            assert time.monotonic() - stalled_s < 60.0
            begin_s = time.monotonic()
            count = one_more(count)
            slowest_s = max(slowest_s, time.monotonic() - begin_s)
            told += [(time.monotonic() - stalled_s, type(one.cause)) for one in live.drain_events() if one.cause]
        for _ in range(30):
            count = one_more(count)
        new = live.stop_recording()
        assert share.stuck == 1, "the share still hangs"
    assert [kind for _, kind in told] == [DiskStalled, RecordingMoved]
    assert told[0][0] < 5.0
    assert slowest_s < 2.0, "tracking and window never wait for the disk"
    assert new.parent == tmp_path / "here"
    second = read_session(new)
    assert second.complete
    share.answer()
    wait_until(lambda: not any(one.name in ("heartbeat", "writing") for one in threading.enumerate()))
    (part,) = (tmp_path / "share").glob("*.part")
    recovery = recover_folder(tmp_path / "share")
    assert part not in recovery.busy
    first = read_session(recovery.recovered[0])
    times = np.union1d(first.timestamp_s, second.timestamp_s)
    np.testing.assert_allclose(times, 100.0 + np.arange(count) / 30.0)
    assert f"goes on from session {first.header.session_id}" in second.events[0].text


def test_a_disk_that_is_only_slow_keeps_its_recording(tmp_path: Path, share: Share) -> None:
    told: list[Exception] = []
    path = tmp_path / "share" / "s.h5"
    recorder = recorder_on(path, told, tmp_path, 0.2, 60.0)
    share.stall()
    recorder.put(tracked(frame(0)))
    wait_until(lambda: share.stuck == 1)
    row = 1
    while not told:
        recorder.put(tracked(frame(row)))
        row += 1
        time.sleep(0.02)
    share.answer()
    assert recorder.finish() == path
    assert [type(one) for one in told] == [DiskStalled]
    assert len(read_session(path)) == row


def test_an_end_that_hangs_is_told_and_finished_when_the_disk_answers(tmp_path: Path, share: Share) -> None:
    told: list[Exception] = []
    path = tmp_path / "share" / "s.h5"
    recorder = recorder_on(path, told, tmp_path, 0.1, 0.3, 0.0)
    for row in range(5):
        recorder.put(tracked(frame(row)))
    wait_until(lambda: recorder.written == 5)
    share.stall()
    with pytest.raises(EndStalled):
        recorder.finish()
    share.answer()
    wait_until(lambda: not any(one.name in ("heartbeat", "writing") for one in threading.enumerate()))
    left = [path] if path.exists() else list(recover_folder(tmp_path / "share").recovered)
    assert len(read_session(left[0])) == 5


def test_pictures_go_on_elsewhere_with_the_one_that_hung(tmp_path: Path) -> None:
    def picture(row: int) -> Frame:
        return Frame(row, row / 30.0, np.full((48, 64, 3), row, np.uint8), None, 1e-3)

    gate = threading.Event()

    class Hanging(RawWriter):
        def append_frame(self, frame: Frame) -> None:
            if frame.index == 3 and self.path.parent.name == "share":
                gate.wait()
            super().append_frame(frame)

    (tmp_path / "share").mkdir()
    height_px, width_px = picture(0).color_rgb.shape[:2]
    camera = replace(DEFAULT_CAMERA, width_px=width_px, height_px=height_px)
    info = SourceInfo("x", camera, False, None, 30.0, {})
    told: list[Exception] = []
    recorder = Recorder(
        "pictures",
        lambda: Hanging(
            tmp_path / "share" / "s.carpusraw", info, lossless=True, fallback=lambda: fallback_folder(tmp_path)
        ),
        lambda sink, item: sink.append_frame(item),
        150,
        told.append,
        patience=Patience(told.append, lambda sink, item: sink.go_on_elsewhere(item), 0.2, 0.4),
    )
    recorder.start()
    for row in range(60):
        assert recorder.put(picture(row))
        time.sleep(0.02)
    new = recorder.finish()
    gate.set()
    assert new == tmp_path / "here" / "s.carpusraw"
    shown = [int(one.color_rgb[0, 0, 0]) for one in RawRecording(new).frames()]
    assert shown == list(range(3, 60))
    assert [type(one) for one in told] == [DiskStalled]


def test_a_file_goes_on_elsewhere_too_when_the_disk_hangs() -> None:
    """Who waits for room looks whether the disk answers."""
    hung, moved = threading.Event(), FakeSession(Path("moved.h5"))

    def write(sink: FakeSession, row: TrackedFrame) -> None:
        if sink is not moved:
            hung.wait()
        sink.append(row)

    def elsewhere(_: FakeSession, row: TrackedFrame | None) -> FakeSession:
        assert row is not None
        moved.append(row)
        return moved

    patience = Patience(lambda _: None, elsewhere, told_after_s=0.1, moved_after_s=0.2)
    recorder = Recorder(
        "writing", lambda: FakeSession(Path("s.h5")), write, 2, lambda _: None, waits=True, patience=patience
    )
    recorder.start()
    for index in range(6):
        assert recorder.put(tracked(frame(index)))
    assert recorder.finish() == moved.path
    hung.set()
    assert [row.index for row in moved.rows] == list(range(6))


class LongToClose(FakeSession):
    def close(self) -> None:
        time.sleep(0.8)
        super().close()


@pytest.mark.parametrize(("item_s", "is_told"), [(0.1, False), (0.0, True)])
def test_a_long_recording_may_take_longer_to_be_finished(tmp_path: Path, item_s: float, *, is_told: bool) -> None:
    """Its rows are read back and counted meanwhile, for which no disk is to blame."""
    told: list[Exception] = []
    sink = LongToClose(tmp_path / "s.h5")
    patience: Patience[FakeSession, TrackedFrame] = Patience(
        told.append, lambda _, __: sink, 0.2, 60.0, close_more_s=0.0, close_item_s=item_s
    )
    recorder = Recorder("writing", lambda: sink, FakeSession.append, 900, told.append, patience=patience)
    recorder.start()
    for number in range(20):
        recorder.put(tracked(frame(number)))
    recorder.finish()
    assert [type(one) for one in told] == ([DiskStalled] if is_told else [])

"""The live session: policies under slow trackers and disks, nothing lost before the disk, faults become events."""

from __future__ import annotations

import math
import shutil
import threading
import time
from pathlib import Path

import pytest

from carpus.core.model.errors import CameraLost, CameraReturned, DiskTooSlow, FrameDamaged, OutputExists
from carpus.core.model.types import Frame, TrackedFrame
from carpus.core.pipeline import live as live_module
from carpus.core.pipeline.live import MAX_PREVIEW_WAITING, LiveSession, compute_capacity
from carpus.core.pipeline.live_values import LiveEvent, LiveSettings
from carpus.core.pipeline.queues import BoundedQueue, QueueFullError
from tests.pipeline.live_fakes import (
    ControlledSource,
    FakeSession,
    Gate,
    frame,
    make_gated_tracker,
    make_tracked_frame,
    wait_until,
)

OUT = Path("session.h5")


def kinds(events: list[LiveEvent]) -> list[str]:
    return [event.kind for event in events]


def deliver(live: LiveSession, source: ControlledSource, count: int) -> None:
    """Lets frames out and waits until each has been captured."""
    goal = live.counters().captured + count
    source.let(count)
    wait_until(lambda: live.counters().captured == goal)


def deliver_tracked(live: LiveSession, source: ControlledSource, count: int) -> None:
    """Lets frames out one by one, so that the tracker keeps up."""
    for _ in range(count):
        goal = live.counters().tracked + 1
        source.let(1)
        wait_until(lambda goal=goal: live.counters().tracked == goal)


# --- pictures and tracking -----------------------------------------------------------------
def test_live_session_previews_before_tracking() -> None:
    source = ControlledSource()
    with LiveSession(source) as live:
        assert live.current_frame() is None
        deliver(live, source, 30)
        assert live.current_frame().index == 29
        assert [f.index for f in live.recent_frames(15)] == list(range(15, 30))
        assert [f.index for f in live.recent_frames(500)] == list(range(10, 30))
        assert live.recent_frames(0) == []
        assert live.current_view() is None
    assert source.closed >= 1


def test_bounded_queue_full_raises_and_keeps_its_items() -> None:
    queue = BoundedQueue[int](2)
    queue.push(1)
    queue.push(2)
    with pytest.raises(QueueFullError):
        queue.push(3)
    assert (queue.drain(), queue.drain()) == ([1, 2], [])


def test_backlog_full_drops_and_counts_frames() -> None:
    source, gate, sink = ControlledSource(), Gate(), FakeSession(OUT)

    with LiveSession(source, LiveSettings(max_waiting_frames=8)) as live:
        live.start_tracking(make_gated_tracker(gate))
        live.start_recording(lambda: sink)
        deliver(live, source, 1)
        wait_until(lambda: gate.waiting)
        deliver(live, source, 50)
        counters = live.counters()
        assert counters.dropped == 42
        assert counters.frames_waiting == 8
        gate.open()
        wait_until(lambda: live.counters().tracked == 9)
        deliver_tracked(live, source, 2)
        assert live.stop_recording() == OUT
    assert [row.index for row in sink.rows] == [*range(9), 51, 52]
    assert [row.dropped_before for row in sink.rows] == [*[0] * 9, 42, 0]


def test_backlog_preview_waits_half_a_second_at_most() -> None:
    source, gate, sink = ControlledSource(), Gate(), FakeSession(OUT)

    with LiveSession(source) as live:
        live.start_tracking(make_gated_tracker(gate))
        deliver(live, source, 1)
        wait_until(lambda: gate.waiting)
        deliver(live, source, 40)
        assert live.counters().frames_waiting == 16
        assert live.counters().dropped == 24
        live.start_recording(lambda: sink)
        deliver(live, source, 20)
        gate.open()
        live.stop_recording()
    assert [row.index for row in sink.rows] == list(range(41, 61))
    assert [row.dropped_before for row in sink.rows] == [24, *[0] * 19]


def test_live_session_tracker_fault_keeps_preview() -> None:
    source = ControlledSource()

    def broken(picture: Frame) -> TrackedFrame:
        if picture.index == 3:
            raise ZeroDivisionError("no")
        return make_tracked_frame(picture)

    with LiveSession(source) as live:
        live.start_tracking(broken)
        deliver_tracked(live, source, 3)
        deliver(live, source, 5)
        events: list[LiveEvent] = []
        wait_until(lambda: events.extend(live.drain_events()) or bool(events))
        (event,) = events
        assert event.kind == "tracking_failed"
        assert isinstance(event.cause, ZeroDivisionError)
        assert live.current_frame().index == 7
        live.start_tracking(make_tracked_frame)
        deliver_tracked(live, source, 2)
        assert live.current_view().tracked.index == 9


# --- recording -----------------------------------------------------------------------------
def test_live_session_records_all_rows_in_one_thread() -> None:
    source, sink = ControlledSource(), FakeSession(OUT)
    with LiveSession(source) as live:
        live.start_tracking(make_tracked_frame)
        deliver_tracked(live, source, 3)
        live.start_recording(lambda: sink)
        deliver_tracked(live, source, 200)
        assert live.counters().is_recording
        assert live.stop_recording() == OUT
        assert not live.is_recording
        deliver_tracked(live, source, 3)
    assert [row.index for row in sink.rows] == list(range(3, 203))
    assert sink.ended == "closed"
    assert sink.threads == {"writing"}


def test_live_recording_before_close_is_not_disk_time() -> None:
    source, sink, after = ControlledSource(), FakeSession(OUT), FakeSession(OUT)
    waited: list[tuple[str, str]] = []

    def wait() -> None:
        wait_until(lambda: sink.flushed == 3)  # a kill meanwhile loses nothing
        deliver(live, source, 5)  # for a person who waits the computer does nothing else meanwhile
        with pytest.raises(RuntimeError):
            live.start_recording(lambda: FakeSession(OUT))
        waited.append((threading.current_thread().name, sink.ended))

    with LiveSession(source) as live:
        live.start_tracking(make_tracked_frame)
        deliver_tracked(live, source, 3)
        live.start_recording(lambda: sink, None, wait)
        deliver_tracked(live, source, 3)
        live.stop_recording()
        live.start_recording(lambda: after)
        deliver(live, source, 1)  # what is still tracked of those before says nothing of this one
        live.stop_recording()
        assert (live.counters().captured, live.counters().dropped) == (12, 0)
        assert 7 < live.counters().tracked < 10, "the hand is followed, by every third picture"
    assert [row.dropped_before for row in after.rows] == [0], "nobody missed what came between"
    assert waited == [(threading.current_thread().name, "")], "beside the writing thread, before the file is closed"
    assert sink.ended == "closed"


def test_live_session_stop_drains_queues() -> None:
    source, gate, sink = ControlledSource(), Gate(), FakeSession(OUT)

    live = LiveSession(source)
    live.start()
    live.start_tracking(make_gated_tracker(gate))
    live.start_recording(lambda: sink)
    deliver(live, source, 1)
    wait_until(lambda: gate.waiting)
    deliver(live, source, 8)
    stopper = threading.Thread(target=live.stop)
    stopper.start()
    wait_until(lambda: not live._capture_thread.is_alive())
    assert sink.rows == []
    gate.open()
    stopper.join()
    assert [row.index for row in sink.rows] == list(range(9))
    assert sink.ended == "closed"
    assert source.closed >= 1
    assert live.drain_events() == []
    live.stop()


def test_recorder_slow_disk_blocks_nothing() -> None:
    source, gate = ControlledSource(), Gate()
    sink = FakeSession(OUT, gate=gate)
    with LiveSession(source) as live:
        live.start_tracking(make_tracked_frame)
        live.start_recording(lambda: sink)
        deliver_tracked(live, source, 300)
        assert live.current_view().tracked.index == 299
        assert len(live.frames_since(-1)) == 300, "what the curves show: the last twelve seconds"
        assert live.counters().dropped == 0
        assert live._recording is not None
        assert live._recording.row_recorder.queue_length == 299
        gate.open()
        live.stop_recording()
    assert [row.index for row in sink.rows] == list(range(300))


def test_recorder_overflow_ends_recording_not_tracking() -> None:
    source, gate = ControlledSource(), Gate()
    sink = FakeSession(OUT, gate=gate)
    with LiveSession(source, LiveSettings(max_waiting_rows=9, max_waiting_frames=1)) as live:
        live.start_tracking(make_tracked_frame)
        live.start_recording(lambda: sink)
        deliver_tracked(live, source, 1)
        wait_until(lambda: gate.waiting)
        deliver_tracked(live, source, 11)
        events: list[LiveEvent] = []
        wait_until(lambda: events.extend(live.drain_events()) or bool(events))
        deliver_tracked(live, source, 8)
        assert live.current_view().tracked.index == 19
        events += live.drain_events()
        assert kinds(events) == ["recording_failed"]
        assert isinstance(events[0].cause, DiskTooSlow)
        assert events[0].cause.subject == str(OUT)
        assert events[0].time_s == pytest.approx(100.0 + 11 / 30.0)
        gate.open()
        with pytest.raises(DiskTooSlow):
            live.stop_recording()
        assert [row.index for row in sink.rows] == list(range(11))
        assert sink.ended == "closed"
        second = FakeSession(Path("second.h5"))
        live.start_recording(lambda: second)
        deliver_tracked(live, source, 2)
        assert live.stop_recording() == Path("second.h5")
        assert len(second.rows) == 2


def test_recorder_write_fault_is_reported_once() -> None:
    source = ControlledSource()
    sink = FakeSession(OUT, fault_at=4)
    with LiveSession(source) as live:
        live.start_tracking(make_tracked_frame)
        live.start_recording(lambda: sink)
        deliver_tracked(live, source, 20)
        wait_until(lambda: sink.ended != "")
        assert kinds(live.drain_events()) == ["recording_failed"]
        assert live.current_view().tracked.index == 19
        assert not live.add_event("note", "too late")
        with pytest.raises(OSError, match="space"):
            live.stop_recording()
        assert not live.is_recording
    assert len(sink.rows) == 4
    assert sink.ended == "abandoned"


def test_live_session_unopenable_file_raises_at_start() -> None:
    def refuse() -> FakeSession:
        raise OutputExists(OUT)

    source, sink = ControlledSource(), FakeSession(OUT)
    with LiveSession(source) as live:
        with pytest.raises(OutputExists):
            live.start_recording(refuse)
        assert not live.is_recording
        with pytest.raises(OutputExists):
            live.start_recording(lambda: sink, refuse)
        assert not live.is_recording
        assert sink.ended == "discarded"
        with pytest.raises(RuntimeError, match="no recording"):
            live.stop_recording()
        live.start_recording(lambda: FakeSession(OUT))
        with pytest.raises(RuntimeError, match="already"):
            live.start_recording(lambda: FakeSession(OUT))
    assert live.drain_events() == []


def test_live_session_pause_and_notes_are_stored() -> None:
    source, sink = ControlledSource(), FakeSession(OUT)
    with LiveSession(source) as live:
        live.start_tracking(make_tracked_frame)
        assert not live.add_event("note", "nobody records")
        live.start_recording(lambda: sink)
        deliver_tracked(live, source, 3)
        live.pause_recording()
        live.pause_recording()
        assert live.is_paused
        deliver_tracked(live, source, 4)
        live.resume_recording()
        deliver_tracked(live, source, 2)
        assert live.add_event("note", "elbow lifted")
        live.stop_recording()
    assert [row.index for row in sink.rows] == [0, 1, 2, 7, 8]
    assert [(kind, text) for _, kind, text in sink.events] == [("pause", ""), ("resume", ""), ("note", "elbow lifted")]
    assert [time_s for time_s, _, _ in sink.events] == pytest.approx([100 + 2 / 30, 100 + 6 / 30, 100 + 8 / 30])


class RecordingListener:
    """Listener that collects frames and events; breaks at one frame."""

    def __init__(self, breaks_at: int = -1) -> None:
        self.frames: list[int] = []
        self.events: list[tuple[float, str]] = []
        self._breaks_at = breaks_at

    def on_frame(self, frame: TrackedFrame) -> None:
        if frame.index == self._breaks_at:
            raise OSError("no network")
        self.frames.append(frame.index)

    def on_event(self, time_s: float, kind: str) -> None:
        self.events.append((time_s, kind))


def test_live_session_listener_fault_removes_listener() -> None:
    source, listener, breaking = ControlledSource(), RecordingListener(), RecordingListener(breaks_at=4)
    with LiveSession(source) as live:
        live.start_tracking(make_tracked_frame)
        live.set_listener(listener)
        deliver_tracked(live, source, 3)
        wait_until(lambda: len(listener.frames) == 3)
        live.add_event("note", "1")
        live.notify_listener("repetition", 99.5)
        live.set_listener(breaking)
        deliver_tracked(live, source, 4)
    assert listener.frames == [0, 1, 2]
    assert listener.events == [(pytest.approx(100 + 2 / 30), "note"), (99.5, "repetition")]
    assert breaking.frames == [3]
    assert live.drain_events() == []


def test_live_session_rows_and_frames_start_together() -> None:
    source, gate = ControlledSource(), Gate()
    rows, pictures = FakeSession(OUT), FakeSession(Path("raw"))

    with LiveSession(source) as live:
        live.start_tracking(make_gated_tracker(gate))
        deliver(live, source, 3)  # captured, not yet tracked
        live.start_recording(lambda: rows, lambda: pictures)
        assert live.first_recorded_index is None
        deliver(live, source, 4)
        assert live.first_recorded_index == 3
        gate.open()
        wait_until(lambda: live.counters().tracked == 7)
        live.stop_recording()
        assert live.first_recorded_index is None
    assert [row.index for row in rows.rows] == [3, 4, 5, 6]
    assert [picture.index for picture in rows.pictures + pictures.pictures] == [3, 4, 5, 6]


def test_live_session_raw_fault_keeps_session_recording() -> None:
    source = ControlledSource()
    rows, pictures = FakeSession(OUT), FakeSession(Path("pictures"), fault_at=2)
    with LiveSession(source) as live:
        live.start_tracking(make_tracked_frame)
        live.start_recording(lambda: rows, lambda: pictures)
        deliver_tracked(live, source, 10)
        assert live.stop_recording() == OUT
    assert kinds(live.drain_events()) == ["pictures_failed"]
    assert len(rows.rows) == 10


def test_live_session_source_fault_is_reported() -> None:
    source = ControlledSource(total=2, fault=FrameDamaged("000003.png"))
    with LiveSession(source) as live:
        source.let(2)
        wait_until(lambda: not live._capture_thread.is_alive())
        event = live.drain_events()[0]
        assert event.kind == "source_failed"
        assert isinstance(event.cause, FrameDamaged)
        assert event.time_s == pytest.approx(100.0 + 1 / 30.0)
        assert live.drain_events() == []


def test_live_session_camera_loss_is_reported_and_stored() -> None:
    source, sink = ControlledSource(), FakeSession(OUT)
    with LiveSession(source) as live:
        live.handle_notice(CameraLost("Xtion"))
        assert math.isnan(live.drain_events()[0].time_s)
        live.start_tracking(make_tracked_frame)
        live.start_recording(lambda: sink)
        deliver_tracked(live, source, 1)
        live.handle_notice(CameraLost("Xtion"))
        live.handle_notice(CameraReturned("Xtion", "3.1 s"))
        live.handle_notice(FrameDamaged("one"))
        assert kinds(live.drain_events()) == ["camera_lost", "camera_back", "notice"]
        live.stop_recording()
    assert [(kind, text) for _, kind, text in sink.events] == [("camera_lost", ""), ("camera_back", "3.1 s")]


def test_live_session_low_disk_is_reported_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    usage = shutil.disk_usage(tmp_path)._replace(free=30_000_000)
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: usage)
    source, sink = ControlledSource(), FakeSession(tmp_path / "session.h5")
    with LiveSession(source, LiveSettings(folder=tmp_path)) as live:
        live.start_tracking(make_tracked_frame)
        live.start_recording(lambda: sink)
        deliver_tracked(live, source, 100)
        wait_until(lambda: live._recording.row_recorder.write_count == 100)
        counters = live.counters()
        assert counters.disk_minutes_left == pytest.approx(30_000_000 / (4_000 * counters.fps) / 60.0)
        live.stop_recording()
    events = live.drain_events()
    assert kinds(events) == ["disk_low"]
    assert events[0].value == 30_000_000


def test_read_free_bytes_missing_folder_is_none(tmp_path: Path) -> None:
    live = LiveSession(ControlledSource(), LiveSettings(folder=tmp_path / "not there"))
    assert math.isnan(live.counters().disk_minutes_left)
    live.stop()


def test_live_session_file_loses_no_frame() -> None:
    """A file can wait: the source is far ahead of slow tracking and a slower disk, with little room between them."""
    settings = LiveSettings(max_waiting_frames=2, max_waiting_rows=2)
    stored: list[int] = []

    class Slow(FakeSession):
        def append(self, tracked: TrackedFrame) -> None:
            time.sleep(0.004)
            stored.append(tracked.index)

    def pipeline(frame: Frame) -> TrackedFrame:
        time.sleep(0.002)
        return make_tracked_frame(frame)

    source = ControlledSource(total=120)
    source.let(200)
    live = LiveSession(source, settings, is_file=True)
    live.start_tracking(pipeline)
    live.start_recording(lambda: Slow(OUT))
    live.start()
    wait_until(lambda: "source_ended" in kinds(live.drain_events()))
    live.stop_recording()
    assert stored == list(range(120))
    assert live.counters().dropped == 0
    live.stop()


def test_live_session_waiting_file_can_be_stopped() -> None:
    source, gate = ControlledSource(total=50), Gate()
    source.let(60)
    live = LiveSession(source, LiveSettings(max_waiting_frames=2), is_file=True)
    live.start_tracking(make_gated_tracker(gate))
    live.start()
    wait_until(lambda: live.counters().frames_waiting == 2)
    threading.Timer(0.1, gate.open).start()
    live.stop()
    assert not live._capture_thread.is_alive()


def test_live_session_stopped_file_ends_early() -> None:
    source, sink = ControlledSource(), FakeSession(OUT)

    def slow(picture: Frame) -> TrackedFrame:
        time.sleep(0.001)
        return make_tracked_frame(picture)

    live = LiveSession(source, is_file=True)
    live.start_tracking(slow)
    live.start_recording(lambda: sink)
    with live:
        source.let(1_000_000)  # a quarter of an hour and more
        wait_until(lambda: live._recording.row_recorder.write_count > 20)
        live.stop_recording()
        stored = [row.index for row in sink.rows]
        assert stored == list(range(len(stored)))
        assert live._capture_thread.is_alive()


def test_live_session_tracks_from_next_frame() -> None:
    source = ControlledSource()
    with LiveSession(source) as live:
        deliver(live, source, 5)
        live.start_tracking(make_tracked_frame)
        deliver_tracked(live, source, 6)
        view = live.current_view()
        assert view.frame.index == view.tracked.index == 10
        assert [row.index for row in live.frames_since(-1)] == [5, 6, 7, 8, 9, 10]
        assert [row.index for row in live.frames_since(8)] == [9, 10]
        live.start_tracking(make_tracked_frame)
        assert live.frames_since(-1) == []
        assert live.current_view() is None
        deliver_tracked(live, source, 1)
        assert [row.index for row in live.frames_since(-1)] == [11]


def test_live_session_stop_waits_for_slow_tracker() -> None:
    """A camera twice as fast as the tracker, for seconds: every frame is recorded, in order, at its own time."""
    source, gate, sink = ControlledSource(), Gate(), FakeSession(OUT)
    turns = threading.Semaphore(0)

    def half_as_fast(picture: Frame) -> TrackedFrame:
        gate.pass_through()
        assert turns.acquire(timeout=60.0)
        return make_tracked_frame(picture)

    with LiveSession(source) as live:
        live.start_tracking(half_as_fast)
        live.start_recording(lambda: sink)
        gate.open()
        for second in range(1, 5):
            deliver(live, source, 30)
            turns.release(15)
            wait_until(lambda second=second: live.counters().tracked == 15 * second)
        assert live.counters().frames_waiting in (59, 60)
        assert math.isfinite(live.counters().tracking_lag_s)
        ended: list[Path] = []
        stopper = threading.Thread(target=lambda: ended.append(live.stop_recording()))
        stopper.start()
        turns.release(20)
        wait_until(lambda: live.counters().tracked == 80)
        deliver(live, source, 5)  # after the stop: neither recorded nor tracked meanwhile
        assert live.is_recording
        assert not ended
        turns.release(200)
        stopper.join()
        assert live.counters().dropped == 0
        deliver_tracked(live, source, 1)
    assert ended == [OUT]
    assert [row.index for row in sink.rows] == list(range(120))
    assert [row.timestamp_s for row in sink.rows] == [100.0 + index / 30.0 for index in range(120)]
    assert not any(row.dropped_before for row in sink.rows)


def test_backlog_stale_frames_are_skipped() -> None:
    """The disk is full while the tracker is behind: the end does not wait, and the preview is current again."""
    source, gate = ControlledSource(), Gate()

    with LiveSession(source) as live:
        live.start_tracking(make_gated_tracker(gate, since=1))
        live.start_recording(lambda: FakeSession(OUT, fault_at=0))
        deliver(live, source, 200)
        wait_until(lambda: "recording_failed" in kinds(live.drain_events()))
        with pytest.raises(OSError, match="No space"):
            live.stop_recording()
        assert live.counters().frames_waiting > 0, "the end does not wait for the tracker"
        gate.open()
        wait_until(lambda: live.current_view() is not None and live.current_view().frame.index == 199)
        assert live.counters().tracked == 2 + MAX_PREVIEW_WAITING


@pytest.mark.parametrize(("free_frames", "capacity"), [(50, 25), (3, MAX_PREVIEW_WAITING), (1000, 100)])
def test_compute_capacity_little_memory_has_less(
    monkeypatch: pytest.MonkeyPatch, free_frames: int, capacity: int
) -> None:
    one = frame(0)
    monkeypatch.setattr(live_module, "read_free_memory_bytes", lambda: free_frames * one.color_rgb.nbytes)
    assert compute_capacity(one, 100) == capacity


def test_live_session_stores_frames_before_tracking() -> None:
    source, gate = ControlledSource(), Gate()
    rows, pictures = FakeSession(OUT), FakeSession(Path("pictures"))

    with LiveSession(source, LiveSettings(max_waiting_frames=16, max_waiting_images=100)) as live:
        live.start_tracking(make_gated_tracker(gate))
        live.start_recording(lambda: rows, lambda: pictures)
        deliver(live, source, 60)
        assert live.counters().dropped > 0
        wait_until(lambda: live._recording.frame_recorder.write_count == 60)
        assert live.counters().tracked == 0
        gate.open()
        live.stop_recording()
    assert [f.index for f in pictures.pictures] == list(range(60))
    assert pictures.ended == "closed"
    assert pictures.threads == {"pictures"}
    assert len(rows.rows) < 60

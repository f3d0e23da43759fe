"""The real window at 1920x1080 while it records: frames lost by us, drawing rate, latency, cost, memory."""

from __future__ import annotations

import os
import tempfile
import time
from array import array
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from PySide6.QtCore import QEvent, QEventLoop, QObject, Qt, QTimer

from carpus.app import compose
from carpus.app.demo_driver import DemoDriver
from carpus.app.desktop.appearance import create_application
from carpus.app.desktop.main_controller import MainController
from carpus.app.desktop.practice import practice_spec
from carpus.app.settings import RecordingSettings, ScreenSettings, Settings
from carpus.core.calibration.clicks_file import read_clicks
from carpus.core.capture.files.tum import TumFolder
from carpus.core.capture.source import FrameSource
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.records.session_setup import PRACTICE_PATIENT, SessionSetup
from carpus.core.simulation.hand_motion import STILL_S
from carpus.core.simulation.recording import CLICKS_FILE, render_cached
from carpus.core.simulation.spec import RecordingSpec
from carpus.ui.screens.live.screen import LiveScreen

SIZE_PX = (1920, 1080)
FPS = 30.0
REST_S = 30.0
"""The practice patient is asked to move again so often."""
BEAT_MS = 10
MEMORY_EVERY_S = 300.0
"""Memory is told at the start and so often after."""


@dataclass(slots=True)
class Run:
    """What was seen of the running window."""

    latency_ms: array[float] = field(default_factory=lambda: array("d"))
    drawn_at_s: array[float] = field(default_factory=lambda: array("d"))
    resident_mb: list[tuple[float, float]] = field(default_factory=list)
    late_ms: array[float] = field(default_factory=lambda: array("d"))
    """How late each beat of the window's thread came: an array, or what watches would take the memory that it looks
    for."""


class Pulse(QTimer):
    """A beat every few milliseconds in the window's thread: how late it comes is how long nobody was answered."""

    def __init__(self, live: LiveScreen, run: Run) -> None:
        super().__init__(live)
        self._run, self._beat_s = run, time.monotonic()
        self.setTimerType(Qt.TimerType.PreciseTimer)
        self.timeout.connect(self._beat)
        self.start(BEAT_MS)

    def _beat(self) -> None:
        now_s = time.monotonic()
        self._run.late_ms.append(max(1e3 * (now_s - self._beat_s) - BEAT_MS, 0.0))
        self._beat_s = now_s


class Watcher(QObject):
    """Notes when the curves have been drawn for the first time with a new frame, and how old that frame is then."""

    def __init__(self, live: LiveScreen, run: Run) -> None:
        super().__init__(live)
        self._live, self._run = live, run
        self._awaited = False
        self._drawn_index = -1
        live.current_chart().mouse_target.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  (Qt's name)
        if event.type() == QEvent.Type.Paint and not self._awaited:
            self._awaited = True
            QTimer.singleShot(0, self._drawn)  # runs when everything of this round has been painted
        return False

    def _drawn(self) -> None:
        self._awaited = False
        view, now_s = self._live._tracked_view, time.monotonic()
        if view is not None and view.tracked.index != self._drawn_index:
            self._drawn_index = view.tracked.index
            self._run.latency_ms.append(1e3 * (now_s - view.captured_at_s))
            self._run.drawn_at_s.append(now_s)


def make_spec(set_up: SessionSetup) -> RecordingSpec:
    """The practice patient at a real camera's rate; the program itself shows it with half the pictures."""
    return replace(practice_spec(set_up), fps=FPS)


def render_take(set_up: SessionSetup, progress: Callable[[int, int], None]) -> tuple[FrameSource, float]:
    """The take, rendered once and kept, and how long it is still at its start."""
    folder = render_cached(make_spec(set_up), progress, workers=os.cpu_count() or 1)
    return TumFolder(folder), STILL_S - 1.0 / FPS


def choose_whole_hand(journey: MainController) -> None:
    """The way to the practice patient's fist with 21 markers."""
    journey.exercise.open(PRACTICE_PATIENT)
    journey.exercise.screen.choose_exercise(get_exercise("FIST_COMPOSITE"))
    journey.exercise.screen.primary_button.click()
    journey.camera.screen.sources.choose("practice")
    journey.camera.screen.primary_button.click()


def measure(seconds: float, folder: Path, *, whole_hand: bool) -> tuple[Run, dict[str, Any]]:
    """Record so long in the real window, on the practice patient in real time."""
    settings = replace(Settings(), screen=ScreenSettings("light"), recording=RecordingSettings(folder=str(folder)))
    qt = create_application(["bench"])
    desktop = compose.compose(qt, settings, is_demo=True, practice_renderer=render_take)
    run = Run()
    try:
        walker, journey = DemoDriver(desktop), desktop.controller
        desktop.show()
        desktop.shell.resize(*SIZE_PX)
        walker.run_until_screen("patients")
        if whole_hand:
            choose_whole_hand(journey)
        else:
            walker.start_practice()
        walker.run_until(lambda: journey.place == "markers", timeout_s=1800.0)
        set_up, source = journey.current.set_up, journey.current.source
        assert set_up is not None
        assert source is not None
        source.measuring._set_up = replace(source.measuring._set_up, stores_frames=False)
        walker.capture_frame()
        walker.click_markers(read_clicks(render_cached(make_spec(set_up)) / CLICKS_FILE).pixel)
        live, feed = journey.live.screen, source.measuring.feed
        live.recording.toggle()
        walker.run_until(lambda: live.recording.state == "recording")
        watcher = Watcher(live, run)
        again = QTimer(live)
        again.timeout.connect(source.measuring._on_recording_started)
        again.start(round(1e3 * REST_S))
        before, start_s = feed.counters(), time.monotonic()
        window_cpu_s = time.thread_time()
        weigh = QTimer(live)
        weigh.timeout.connect(lambda: run.resident_mb.append((time.monotonic() - start_s, resident_mb())))
        weigh.start(1000)
        pulse = Pulse(live, run)
        stay = QEventLoop()
        QTimer.singleShot(round(1e3 * seconds), stay.quit)
        stay.exec()
        pulse.stop()
        wall_s = time.monotonic() - start_s
        after = feed.counters()
        facts = {
            "wall_s": wall_s,
            "window_cpu_ms": 1e3 * (time.thread_time() - window_cpu_s) / max(len(run.drawn_at_s), 1),
            "captured": after.captured - before.captured,
            "tracked": after.tracked - before.tracked,
            "dropped": after.dropped - before.dropped,
            "rows": feed._recording.row_recorder.write_count,
        }
        live.current_chart().mouse_target.removeEventFilter(watcher)
        weigh.stop()
        again.stop()
        stop_s = time.monotonic()
        live.recording.stop()
        walker.run_until_screen("review")
        facts["stop_s"] = time.monotonic() - stop_s
        return run, facts
    finally:
        desktop.close()


def resident_mb() -> float:
    """Memory of this process that is in use, NaN where the system does not tell."""
    with suppress(OSError):
        for text in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
            if text.startswith("VmRSS:"):
                return float(text.split()[1]) / 1024.0
    return float("nan")


def memory_words(samples: list[tuple[float, float]]) -> str:
    """Resident memory at the start, every five minutes and at the end."""
    out, next_s = [], 0.0
    for at_s, used_mb in samples:
        if at_s >= next_s or at_s == samples[-1][0]:
            out.append(f"{used_mb:.0f} MB at {at_s / 60.0:.1f} min")
            next_s += MEMORY_EVERY_S
    return ", ".join(out)


def report(seconds: float, *, whole_hand: bool = False) -> Iterator[str]:
    """Measure and tell, line by line."""
    with tempfile.TemporaryDirectory() as folder:
        run, facts = measure(seconds, Path(folder), whole_hand=whole_hand)
    drawn = len(run.drawn_at_s) / facts["wall_s"]
    p50, p95, most = np.percentile(run.latency_ms, (50.0, 95.0, 100.0))
    width, height = SIZE_PX
    protocol = "21 markers, full fist" if whole_hand else "6 markers, wrist flexion"
    yield f"Window {width} x {height}, {protocol}, offscreen, recording for {facts['wall_s']:.0f} s"
    yield "| what | value |"
    yield "|---|---|"
    yield f"| frames captured, tracked, stored | {facts['captured']}, {facts['tracked']}, {facts['rows']} |"
    yield f"| frames dropped by us | {facts['dropped']} |"
    yield f"| pictures a second | {facts['captured'] / facts['wall_s']:.1f} |"
    yield f"| drawings a second | {drawn:.1f} |"
    yield f"| frame to curve, median, p95, most | {p50:.0f}, {p95:.0f}, {most:.0f} ms |"
    yield f"| window's thread, a drawing | {facts['window_cpu_ms']:.1f} ms CPU |"
    late_ms = np.percentile(run.late_ms, (99.0, 100.0))
    yield f"| time without an answer, 99 % and longest | {late_ms[0]:.0f}, {late_ms[1]:.0f} ms |"
    yield f"| memory | {memory_words(run.resident_mb)} |"
    yield f"| from Stop to the review | {facts['stop_s']:.1f} s |"

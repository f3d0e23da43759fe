"""The real application on a short take, in a process of its own: ``python -m tests.journeys.window_app TAKE DATA``.

Prints one line for every change of place and when it is ready for keys, so that who drives it by the real keyboard
and mouse need not guess: ``place live``, ``at markers 512 300``, ``session /path``, ``saved /path``.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QPoint, QTimer

from carpus.app import compose
from carpus.app.desktop.appearance import create_application
from carpus.app.desktop.source_factory import RECENT_FRAMES
from carpus.app.desktop.window import Desktop, close_on_signals
from carpus.app.settings import RecordingSettings, ScreenSettings, Settings
from carpus.ui.screens.live import recording as live_recording
from tests.journeys.takes import SPEED, build_take, read_take_clicks

LOOK_MS = 50


class Reporter:
    """Says on standard output what a person would see."""

    def __init__(self, desktop: Desktop, take: Path) -> None:
        self._desktop, self._take = desktop, take
        self._said: set[str] = set()
        desktop.controller.live.screen.recording.stopped.connect(self._stored)
        desktop.controller.report.screen.saved.connect(lambda path: self.say(f"saved {path}"))
        desktop.controller.messages.fault_shown.connect(lambda fault: self.say(f"fault {fault!r}"))
        self._timer = QTimer(desktop.shell)
        self._timer.timeout.connect(self._look)
        self._timer.start(LOOK_MS)

    def say(self, line: str) -> None:
        """One line, once."""
        if line not in self._said:
            self._said.add(line)
            print(line, flush=True)

    def _stored(self, session_id: str) -> None:
        self.say(f"session {self._desktop.library.entry(session_id).path}")

    def _look(self) -> None:
        journey, shell = self._desktop.controller, self._desktop.shell
        if not shell.isActiveWindow() and shell.focusWidget() is None:
            return
        if journey.place == "markers":
            self._look_at_markers()
        elif journey.place == "live":
            self.say("place live")
            if journey.live.screen.recording.state == "recording":
                self.say("recording")
                if journey.live.screen.recording.repetitions >= 2:
                    self.say("repeated")
        elif journey.place != "review" or journey.review.screen.is_loaded:
            self.say(f"place {journey.place}")

    def _look_at_markers(self) -> None:
        journey, markers = self._desktop.controller, self._desktop.controller.markers.screen
        source = journey.current.source
        if markers.labels is None:
            seen = len(source.measuring.feed.recent_frames(RECENT_FRAMES)) == RECENT_FRAMES
            if seen and markers.picture.image is not None:
                self.say("place markers")
        elif not markers.labels.is_complete:
            for u, v in read_take_clicks(self._take):
                spot: QPoint = markers.picture.mapToGlobal(markers.picture.to_screen(u, v).toPoint())
                self.say(f"disc {spot.x()} {spot.y()}")
            self.say("discs told")
        elif markers.primary_button.isEnabled():
            self.say("ready to start")


def main() -> int:
    """Open the window and stay until it is closed."""
    take, data = map(Path, sys.argv[1:3])
    live_recording.MIN_RECORDING_S = 0.0  # an end within the first seconds would ask
    recording = RecordingSettings(folder=str(data), keep_pictures=False)
    settings = replace(Settings(), screen=ScreenSettings("light"), recording=recording)
    qt = create_application(["carpus"])
    desktop = compose.compose(
        qt, settings, practice_renderer=build_take(take), speed=SPEED, settings_folder=data / "settings"
    )
    close_on_signals(desktop)
    reporter = Reporter(desktop, take)
    desktop.show()
    reporter.say("started")
    try:
        return qt.exec()
    finally:
        desktop.close()


if __name__ == "__main__":
    sys.exit(main())

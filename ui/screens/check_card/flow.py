"""Controller of the camera check: print, measure for 30 seconds, save the result."""

from __future__ import annotations

from datetime import datetime

from carpus.core.calibration.camera.printed_sheet import PAPER_MM
from carpus.core.calibration.card.card import card_sheets
from carpus.core.calibration.card.checks import CardCheck, add_check, checks_path
from carpus.core.calibration.card.measure import CardMeasurement
from carpus.core.model.dates import to_iso
from carpus.core.model.types import Frame
from carpus.core.pipeline.live import LiveSession
from carpus.core.pipeline.queues import Mailbox
from carpus.ui.report.sheet import write_sheets
from carpus.ui.screens.check_card.screen import CheckCardScreen
from carpus.ui.shell.camera_session import CameraFlowBase, FrameProcessor
from carpus.ui.shell.flow import ScreenContext
from carpus.ui.words.camera_check import CardProgress


class CheckCardFlow(CameraFlowBase):
    """Controller of the camera check; closes patient and source."""

    screen_name = "card"
    screen: CheckCardScreen

    def __init__(self, context: ScreenContext) -> None:
        screen, camera = CheckCardScreen(context.theme), context.camera
        super().__init__(context, screen, screen.name_dialog)
        self._newest_progress: Mailbox[CardProgress] = Mailbox()
        self._measured: tuple[LiveSession, CardMeasurement] | None = None
        self.camera_session.opened.connect(self._on_opened)
        self.camera_session.frame_ready.connect(self._on_frame)
        self.camera_session.camera_lost.connect(screen.show_no_frames)
        camera.notify_availability(lambda: screen.set_camera_connected(camera.is_connected))
        camera.status_changed.connect(lambda: screen.show_status(camera.status))
        screen.check_button.clicked.connect(self.start)
        screen.stop_button.clicked.connect(self.return_to_start)
        screen.print_button.clicked.connect(self._print_card)
        screen.calibrate_button.clicked.connect(lambda: context.navigator.open_screen("board"))

    def title(self) -> str:
        return self.tr("Check card")

    def open(self) -> None:
        """Show the last check, read in the background."""
        self.close_patient()
        self.return_to_start()
        self.context.camera.refresh_status()
        self.context.navigator.switch_screen("card")

    def navigate_back(self) -> None:
        """Go from a running check to its start, and from there to the settings."""
        if self.screen.is_measuring:
            self.return_to_start()
        else:
            self.return_to_settings()

    def return_to_start(self) -> None:
        self.on_leave()
        self.screen.show_status(self.context.camera.status)
        self.screen.end_measuring()

    def on_leave(self) -> None:
        """Close the camera and drop an unfinished check."""
        super().on_leave()
        self._measured = None

    def start(self) -> None:
        self.on_leave()
        newest = self._newest_progress = Mailbox()
        known, cameras = self._identified, self.context.cameras
        self.screen.begin_measuring()

        def make_processor(session: LiveSession) -> FrameProcessor:
            watch = CardMeasurement(session.info.camera, only_steady=True)
            self._measured = session, watch  # in one value, so that another cannot be taken for it

            def process(frame: Frame) -> None:
                seen = watch.process_frame(frame) if known.is_set() and not watch.is_done else None
                if seen is not None:
                    newest.post(CardProgress(seen.pixel, seen.blue_count, seen.steady_s, seen.has_moved))

            return process

        self.camera_session.open(cameras.open_for_check, make_processor)

    def _on_opened(self, session: LiveSession) -> None:
        self.screen.show_progress(None)
        self._identify_camera(session)

    def _on_frame(self, frame: Frame) -> None:
        self.screen.frame_view.show_frame(frame.color_rgb)
        now = self._newest_progress.peek()
        if now is not None and now is not self.screen.progress:
            self.screen.show_progress(now)
        if self._measured is not None and self._measured[1].is_done:
            session, watch = self._measured
            self._measured = None
            self.camera_session.close()
            self._save_check(session, watch)

    def _save_check(self, session: LiveSession, watch: CardMeasurement) -> None:
        info, when, camera = session.info, to_iso(datetime.now().astimezone()), self.context.camera
        path = checks_path(self.context.cameras.folder(), info.serial)

        def save() -> None:
            reading = watch.compute_reading(info.name)
            add_check(path, CardCheck(when, info.serial, reading, info.settings.get("calibrated", "")))

        def on_saved(_: object) -> None:
            camera.set_serial(info.serial)
            self.screen.end_measuring()

        self.run(save, on_saved, self._on_failed)

    def _print_card(self) -> None:
        paper = self.screen.paper.value()
        sheets = card_sheets(next(one for one in PAPER_MM if one == paper))
        name, title = f"carpus-check-card-{paper}.pdf", self.tr("Save the card to print")
        self.save_printout(name, title, lambda part: write_sheets(part, sheets, "Carpus check card"))

"""Controller of the camera calibration: print, capture, calculate, save."""

from __future__ import annotations

from datetime import datetime

from carpus.core.calibration.camera.board import CHESSBOARD, ViewCollector, create_board_sheet
from carpus.core.calibration.camera.calibrate import calibrate_camera, save_calibration, to_stored_calibration
from carpus.core.model.errors import BoardNotVisible, BoardViewsTooSimilar
from carpus.core.model.types import Frame
from carpus.core.pipeline.live import LiveSession
from carpus.core.pipeline.queues import Mailbox
from carpus.ui.report.sheet import write_sheets
from carpus.ui.screens.camera_calibration.screen import CameraCalibrationScreen
from carpus.ui.shell.camera_session import CameraFlowBase, FrameProcessor
from carpus.ui.shell.flow import ScreenContext
from carpus.ui.words.camera_calibration import BoardProgress, BoardResult
from carpus.ui.words.camera_check import camera_words


class CameraCalibrationFlow(CameraFlowBase):
    """Controller of the camera calibration; closes patient and source."""

    screen_name = "board"
    screen: CameraCalibrationScreen

    def __init__(self, context: ScreenContext) -> None:
        screen = CameraCalibrationScreen(context.theme)
        super().__init__(context, screen, screen.name_dialog)
        self._session: LiveSession | None = None
        self._gathering: ViewCollector | None = None
        self._newest_progress: Mailbox[BoardProgress] = Mailbox()
        self._is_calibrating = False
        self.camera_session.opened.connect(self._on_opened)
        self.camera_session.frame_ready.connect(self._on_frame)
        self.camera_session.camera_lost.connect(screen.capture_view.show_no_frames)
        camera = context.camera
        camera.notify_availability(lambda: screen.setup_view.set_camera_connected(camera.is_connected))
        screen.setup_view.start_button.clicked.connect(self.start)
        screen.setup_view.print_button.clicked.connect(self._print_board)
        screen.capture_view.primary_button.clicked.connect(self._calibrate)
        screen.capture_view.stop_button.clicked.connect(self.return_to_start)
        screen.result_view.use_button.clicked.connect(self._save_calibration)
        screen.result_view.again_button.clicked.connect(self.start)

    # --- the way ------------------------------------------------------------------------------------------
    def title(self) -> str:
        return self.tr("Camera calibration")

    def open(self) -> None:
        self.close_patient()
        self.on_leave()
        self.screen.setup_view.show_status(camera_words(self.context.camera.status)[1])
        self.screen.show_setup()
        self.context.navigator.switch_screen("board")

    def navigate_back(self) -> None:
        """Go from capture or result to the set-up, and from there to the settings."""
        if self.screen.is_setup_shown:
            self.return_to_settings()
        else:
            self.return_to_start()

    def return_to_start(self) -> None:
        self.on_leave()
        self.screen.show_setup()

    def on_leave(self) -> None:
        """Close the camera and drop images that were not used."""
        super().on_leave()
        self._gathering, self._is_calibrating = None, False

    # --- printing -----------------------------------------------------------------------------------------
    def _print_board(self) -> None:
        paper = self.screen.setup_view.choice.paper
        sheet = create_board_sheet(CHESSBOARD, paper)
        name, title = f"carpus-chessboard-{paper}.pdf", self.tr("Save the board to print")
        self.save_printout(name, title, lambda part: write_sheets(part, [sheet], "Carpus camera board"))

    # --- showing ------------------------------------------------------------------------------------------
    def start(self) -> None:
        self.on_leave()
        board, known, cameras = self.screen.setup_view.choice.board, self._identified, self.context.cameras
        newest = self._newest_progress = Mailbox[BoardProgress]()
        self.screen.show_capture()

        def make_processor(session: LiveSession) -> FrameProcessor:
            gathering = self._gathering = ViewCollector(session.info.camera, board)

            def process(frame: Frame) -> None:
                seen = gathering.process_frame(frame) if known.is_set() else None
                if seen is not None:
                    judgement = gathering.coverage
                    newest.post(BoardProgress(seen.reject_reason, judgement, judgement.next_instruction() or ""))

            return process

        self.camera_session.open(cameras.open_for_calibration, make_processor)

    def _on_opened(self, session: LiveSession) -> None:
        self._session = session
        self.screen.capture_view.show_opened()
        self._identify_camera(session)

    def _on_frame(self, frame: Frame) -> None:
        showing = self.screen.capture_view
        if not self._is_calibrating:
            now = self._newest_progress.peek()
            if now is not None and now is not showing.progress:
                showing.show_progress(now)
            showing.frame_view.show_frame(frame.color_rgb)

    # --- the result ---------------------------------------------------------------------------------------
    def _calibrate(self) -> None:
        gathering, session = self._gathering, self._session
        if gathering is None or session is None or self._is_calibrating:
            return
        self._is_calibrating = True
        views, info = list(gathering.views), session.info
        self.screen.capture_view.show_calculating()

        def work() -> BoardResult:
            return BoardResult(calibrate_camera(views, info.camera, info.name), info.serial)

        def on_done(result: BoardResult) -> None:
            self._is_calibrating = False
            if gathering is self._gathering:
                self.camera_session.close()
                self.screen.show_result(result)

        def on_failed(fault: Exception) -> None:
            self._is_calibrating = False
            if gathering is not self._gathering:
                return
            if isinstance(fault, BoardViewsTooSimilar | BoardNotVisible):
                words = self.tr("Add more images with the board closer and more tilted: {why}.").format(
                    why=fault.detail
                )
                self.screen.capture_view.show_shortfall(words)
            else:
                self._on_failed(fault)

        self.run(work, on_done, on_failed)

    def _save_calibration(self) -> None:
        result, session = self.screen.result_view.result, self._session
        if result is None or session is None:
            return
        folder = self.context.cameras.folder()
        stored = to_stored_calibration(
            result.calibration, result.serial, datetime.now().astimezone(), session.info.settings
        )

        def on_saved(_: object) -> None:
            self.context.camera.refresh_status()
            if (
                self.context.navigator.underlying_screen == self.screen_name
            ):  # who has left while the disk was written stays where they are
                self.context.navigator.open_screen("card")  # it shows at once whether the camera is right now

        self.run(lambda: save_calibration(folder, result.calibration, stored), on_saved)

"""The flow of calibrating a camera with a printed board: print it, show it, work it out, keep it."""

from __future__ import annotations

from datetime import datetime

from carpus.core.calibration.camera.board import board_sheet
from carpus.core.calibration.camera.calibrate import calibrate_camera
from carpus.core.calibration.camera.effect import effect_of
from carpus.core.calibration.camera.keep import keep_calibration, stored_of
from carpus.core.calibration.camera.views import ASKED_VIEWS, Gathering, next_step, target_outline
from carpus.core.errors import BoardMissing, BoardViewsAlike
from carpus.core.pipeline.channels import Newest
from carpus.core.pipeline.live import LiveSession
from carpus.core.types import Frame
from carpus.ui import numbers
from carpus.ui.camera_at_hand import AtCameraFlow, Look
from carpus.ui.camera_calibration.screen import BoardScreen
from carpus.ui.flow import ScreenContext
from carpus.ui.report.calibration_page import write_calibration_page
from carpus.ui.report.pdf import write_sheets
from carpus.ui.words.camera_calibration import BoardChoice, BoardProgress, BoardResult
from carpus.ui.words.camera_check import camera_words


class BoardFlow(AtCameraFlow):
    """Whatever was open is closed: the camera is needed."""

    place = "board"
    screen: BoardScreen

    def __init__(self, context: ScreenContext) -> None:
        screen = BoardScreen(context.theme, context.keys)
        super().__init__(context, screen, screen.name_sheet)
        screen.turned.connect(context.way.changed)
        self._choice = BoardChoice()
        self._session: LiveSession | None = None
        self._gathering: Gathering | None = None
        self._newest: Newest[BoardProgress] = Newest()
        self._working = False
        self.hand.opened.connect(self._opened)
        self.hand.pulled.connect(self._pulled)
        self.hand.lost.connect(screen.showing.show_lost)
        if context.is_demo:
            screen.beginning.offer_simulated()
        camera = context.camera
        camera.when_looked(lambda: screen.beginning.set_camera_there(camera.there))
        screen.beginning.begin_button.clicked.connect(self._choose)
        screen.beginning.print_button.clicked.connect(self._print_board)
        screen.showing.take.connect(lambda: self._gathering and self._gathering.take())
        screen.showing.undo.connect(lambda: self._gathering and self._gathering.undo())
        screen.showing.primary.clicked.connect(self._work_out)
        screen.showing.leave_button.clicked.connect(self.back)
        screen.result.use_button.clicked.connect(self._use)
        screen.result.again_button.clicked.connect(self.begin)
        screen.result.page_button.clicked.connect(self._write_page)

    # --- the way ------------------------------------------------------------------------------------------
    def title(self) -> str:
        return self.tr("Camera calibration")

    def sign_lines(self) -> list[str]:
        simulated = self.screen.shows_simulated
        return [self.tr("Simulated camera: nothing here is of a real one.")] if simulated else []

    def show(self) -> None:
        self.close_patient()
        self.leave()
        camera = self.context.camera
        self.screen.beginning.show_standing(camera_words(camera.status)[1], camera_there=camera.there)
        self.screen.show_beginning()
        self.context.way.go("board")

    def up(self) -> None:
        """From showing and the result to the beginning, and from there to the patients."""
        if self.screen.is_beginning:
            self.to_patient()
        else:
            self.back()

    def back(self) -> None:
        self.leave()
        self.screen.show_beginning()

    def leave(self) -> None:
        """Let the camera go; what was taken and not kept is forgotten."""
        super().leave()
        self._gathering, self._working = None, False

    # --- printing -----------------------------------------------------------------------------------------
    def _print_board(self) -> None:
        choice = self.screen.beginning.choice
        sheet = board_sheet(BoardChoice(choice.pattern, choice.paper).board, choice.paper)
        name, title = f"carpus-{choice.pattern}-{choice.paper}.pdf", self.tr("Save the board to print")
        self.save_page(name, title, lambda part: write_sheets(part, [sheet], "Carpus camera board"))

    def _write_page(self) -> None:
        result, when = self.screen.result.result, datetime.now().astimezone()
        if result is not None:
            name, title = "carpus-camera-calibration.pdf", self.tr("Save one page")
            self.save_page(name, title, lambda part: write_calibration_page(part, result, when))

    # --- showing ------------------------------------------------------------------------------------------
    def _choose(self) -> None:
        self._choice = self.screen.beginning.choice
        self.begin()

    def begin(self) -> None:
        self.leave()
        choice, self.practice = self._choice, self._choice.practice
        newest, known = Newest[BoardProgress](), self._known
        self._newest = newest
        self.screen.show_showing(simulated=choice.practice)

        def looker(session: LiveSession) -> Look:
            camera, board = session.info.camera, choice.board
            gathering = self._gathering = Gathering(camera, [board])
            asked, size_px = ASKED_VIEWS[choice.pattern], (camera.width_px, camera.height_px)

            def look(frame: Frame) -> None:
                seen = gathering.look(frame) if known.is_set() else None
                if seen is not None:
                    judgement = gathering.judgement
                    step = next_step(judgement, seen.found, size_px, asked)
                    target = target_outline(step, board, camera)
                    newest.put(BoardProgress(seen, judgement, step, target, board.corner_count, asked, frame))

            return look

        cameras = self.context.cameras
        self.hand.open(lambda: cameras.for_board(choice.board, practice=choice.practice), looker)

    def _opened(self, session: LiveSession) -> None:
        self._session = session
        self.screen.showing.opened()
        self._meet(session)

    def _pulled(self, frame: Frame) -> None:
        showing = self.screen.showing
        if not self._working:
            now = self._newest.look()
            if now is not None and now is not showing.progress:
                showing.show_progress(now)
            showing.show_frame(frame)

    # --- the result ---------------------------------------------------------------------------------------
    def _work_out(self) -> None:
        gathering, session, practice, cameras = self._gathering, self._session, self.practice, self.context.cameras
        if gathering is None or session is None or self._working:
            return
        self._working = True
        views, info = list(gathering.views), session.info
        self.screen.showing.work()

        def work() -> BoardResult:
            made = calibrate_camera(views, info.camera, info.name)
            before = cameras.calibrated(info.serial, practice=practice) if info.serial else None
            since = numbers.day_of_year(before) if before is not None else ""
            return BoardResult(
                made, effect_of(made, views), info.name, info.serial, since, practice, may_use=bool(info.serial)
            )

        def done(result: BoardResult) -> None:
            self._working = False
            if gathering is self._gathering:
                self.hand.close()
                self.screen.show_result(result)

        def failed(fault: Exception) -> None:
            self._working = False
            if gathering is not self._gathering:
                return
            if isinstance(fault, BoardViewsAlike | BoardMissing):
                words = self.tr("Show it some more, tilted more and nearer: {why}.").format(why=fault.detail)
                self.screen.showing.more(words)
            else:
                self._failed(fault)

        self.run(work, done, failed)

    def _use(self) -> None:
        result, session = self.screen.result.result, self._session
        if result is None or session is None:
            return
        folder = self.context.cameras.folder(practice=result.simulated)
        stored = stored_of(result.made, result.serial, datetime.now().astimezone(), session.info.settings)

        def kept(_: object) -> None:
            self.context.camera.read()
            if self.context.way.behind == self.place:  # who has left while the disk was written stays where they are
                self.context.way.show("card")  # it shows at once whether the camera is right now

        self.run(lambda: keep_calibration(folder, result.made, stored), kept)

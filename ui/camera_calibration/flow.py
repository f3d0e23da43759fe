"""The flow of calibrating a camera with a printed board: print it, show it, work it out, keep it."""

from __future__ import annotations

from datetime import datetime

from carpus.core.calibration.camera.board import board_sheet
from carpus.core.calibration.camera.calibrate import calibrate_camera
from carpus.core.calibration.camera.keep import keep_calibration, stored_of
from carpus.core.calibration.camera.views import ASKED_VIEWS, Gathering
from carpus.core.errors import BoardMissing, BoardViewsAlike
from carpus.core.pipeline.channels import Newest
from carpus.core.pipeline.live import LiveSession
from carpus.core.types import Frame
from carpus.ui.camera_at_hand import AtCameraFlow, Look
from carpus.ui.camera_calibration.screen import BoardScreen
from carpus.ui.flow import ScreenContext
from carpus.ui.report.pdf import write_sheets
from carpus.ui.words.camera_calibration import BoardChoice, BoardProgress, BoardResult
from carpus.ui.words.camera_check import camera_words


class BoardFlow(AtCameraFlow):
    """Whatever was open is closed: the camera is needed."""

    place = "board"
    screen: BoardScreen

    def __init__(self, context: ScreenContext) -> None:
        screen = BoardScreen(context.theme)
        super().__init__(context, screen, screen.name_sheet)
        self._choice = BoardChoice()
        self._session: LiveSession | None = None
        self._gathering: Gathering | None = None
        self._newest: Newest[BoardProgress] = Newest()
        self._working = False
        self.hand.opened.connect(self._opened)
        self.hand.pulled.connect(self._pulled)
        self.hand.lost.connect(screen.showing.show_lost)
        camera = context.camera
        camera.when_looked(lambda: screen.beginning.set_camera_there(camera.there))
        screen.beginning.begin_button.clicked.connect(self._choose)
        screen.beginning.print_button.clicked.connect(self._print_board)
        screen.showing.primary.clicked.connect(self._work_out)
        screen.showing.leave_button.clicked.connect(self.back)
        screen.result.use_button.clicked.connect(self._use)
        screen.result.again_button.clicked.connect(self.begin)

    # --- the way ------------------------------------------------------------------------------------------
    def title(self) -> str:
        return self.tr("Camera calibration")

    def show(self) -> None:
        self.close_patient()
        self.leave()
        self.screen.beginning.show_status(camera_words(self.context.camera.status)[1])
        self.screen.show_beginning()
        self.context.way.go("board")

    def up(self) -> None:
        """From showing and the result to the beginning, and from there to the settings."""
        if self.screen.is_beginning:
            self.to_settings()
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

    # --- showing ------------------------------------------------------------------------------------------
    def _choose(self) -> None:
        self._choice = self.screen.beginning.choice
        self.begin()

    def begin(self) -> None:
        self.leave()
        choice, known, cameras = self._choice, self._known, self.context.cameras
        newest = self._newest = Newest[BoardProgress]()
        self.screen.show_showing()

        def looker(session: LiveSession) -> Look:
            gathering = self._gathering = Gathering(session.info.camera, [choice.board])
            asked = ASKED_VIEWS[choice.pattern]

            def look(frame: Frame) -> None:
                seen = gathering.look(frame) if known.is_set() else None
                if seen is not None:
                    judgement = gathering.judgement
                    newest.put(BoardProgress(seen.lack, judgement, judgement.next_step(asked) or "", asked))

            return look

        self.hand.open(cameras.for_board, looker)

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
            showing.show_frame(frame.color_rgb)

    # --- the result ---------------------------------------------------------------------------------------
    def _work_out(self) -> None:
        gathering, session = self._gathering, self._session
        if gathering is None or session is None or self._working:
            return
        self._working = True
        views, info = list(gathering.views), session.info
        self.screen.showing.work()

        def work() -> BoardResult:
            return BoardResult(calibrate_camera(views, info.camera, info.name), info.serial)

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
        folder = self.context.cameras.folder()
        stored = stored_of(result.made, result.serial, datetime.now().astimezone(), session.info.settings)

        def kept(_: object) -> None:
            self.context.camera.read()
            if self.context.way.behind == self.place:  # who has left while the disk was written stays where they are
                self.context.way.show("card")  # it shows at once whether the camera is right now

        self.run(lambda: keep_calibration(folder, result.made, stored), kept)

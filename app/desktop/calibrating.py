"""The flow of calibrating a camera with a printed board: print it, show it, work it out, keep it."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import Protocol

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from carpus.app.desktop.camera_at_hand import CameraAtHand, Look
from carpus.app.desktop.naming import Naming
from carpus.core.calibration.camera.board import Board, board_sheet
from carpus.core.calibration.camera.calibrate import calibrate_camera
from carpus.core.calibration.camera.effect import effect_of
from carpus.core.calibration.camera.gather import Gathering
from carpus.core.calibration.camera.keep import keep_calibration, stored_of
from carpus.core.calibration.camera.views import ASKED_VIEWS, next_step, target_outline
from carpus.core.capture.calibrated import SERIAL, stored_calibration
from carpus.core.capture.source import FrameSource, Notice, SourceInfo, is_simulated
from carpus.core.durable import replace_file
from carpus.core.errors import BoardMissing, BoardViewsAlike, CameraLost, CarpusFault
from carpus.core.pipeline.channels import Newest
from carpus.core.types import Frame
from carpus.ui import numbers
from carpus.ui.background import Background
from carpus.ui.camera_calibration.screen import BoardScreen
from carpus.ui.camera_calibration.values import BoardChoice, BoardProgress, BoardResult
from carpus.ui.fault_words import fault_words
from carpus.ui.flow import Navigator
from carpus.ui.last_places import LastPlaces
from carpus.ui.messages.messages import Messages
from carpus.ui.report.calibration_page import write_calibration_page
from carpus.ui.report.pdf import write_sheets


class BoardCameras(Protocol):
    """Opens the camera that looks at the board."""

    def for_board(self, board: Board, notice: Notice, *, practice: bool) -> FrameSource: ...

    def folder(self, *, practice: bool) -> Path:
        """Where what is known of it is kept."""
        ...


class Calibrating(QObject):
    """``kept`` carries whether a simulated camera was calibrated."""

    kept = Signal(bool)

    def __init__(
        self,
        window: QWidget,
        screen: BoardScreen,
        way: Navigator,
        tell: Messages,
        cameras: BoardCameras,
        places: LastPlaces,
        background: Background,
        *,
        camera_there: Callable[[], bool],
        is_demo: bool,
        now: Callable[[], datetime],
    ) -> None:
        super().__init__(window)
        self._window, self._screen, self._way, self._tell, self._cameras = window, screen, way, tell, cameras
        self._places, self._background, self._camera_there, self._now = places, background, camera_there, now
        self._choice = BoardChoice()
        self._info: SourceInfo | None = None
        self._gathering: Gathering | None = None
        self._newest: Newest[BoardProgress] = Newest()
        self._working = False
        self._naming = Naming(
            self, screen.name_sheet, background, lambda: self.begin(self._choice), self.back, self._failed
        )
        self.hand = CameraAtHand(self)
        self.hand.opened.connect(self._opened)
        self.hand.failed.connect(self._failed)
        self.hand.pulled.connect(self._pulled)
        self.hand.lost.connect(lambda fault: screen.showing.show_lost(lost_words(fault)))
        if is_demo:
            screen.beginning.offer_simulated()
        screen.beginning.begun.connect(self.begin)
        screen.beginning.printed.connect(self._print_board)
        screen.showing.take.connect(lambda: self._gathering and self._gathering.take())
        screen.showing.undo.connect(lambda: self._gathering and self._gathering.undo())
        screen.showing.work_out.connect(self._work_out)
        screen.showing.leave.connect(self.back)
        screen.result.use.connect(self._use)
        screen.result.again.connect(lambda: self.begin(self._choice))
        screen.result.page.connect(self._write_page)

    # --- the way ------------------------------------------------------------------------------------------
    def show(self, standing: str) -> None:
        """Choose and print; ``standing`` what is known of the camera today."""
        self.leave()
        self._screen.beginning.show_standing(standing, camera_there=self._camera_there())
        self._screen.show_beginning()
        self._way.go("board")

    def back(self) -> None:
        """From showing and the result to the beginning."""
        self.leave()
        self._screen.show_beginning()

    def leave(self) -> None:
        """Let the camera go; what was taken and not kept is forgotten."""
        self._naming.end()
        self.hand.close()
        self._gathering, self._working = None, False

    def set_camera_there(self, there: bool) -> None:
        """A camera was plugged in or out."""
        self._screen.beginning.set_camera_there(there)

    # --- printing -----------------------------------------------------------------------------------------
    def _print_board(self, choice: BoardChoice) -> None:
        path = self._ask_path(f"carpus-{choice.pattern}-{choice.paper}.pdf", self.tr("Save the board to print"))
        if path is not None:
            sheet = board_sheet(BoardChoice(choice.pattern, choice.paper).board, choice.paper)
            self._background.run(
                lambda: replace_file(path, lambda part: write_sheets(part, [sheet], "Carpus camera board")),
                lambda _: None, self._tell.fault, self,
            )  # fmt: skip

    def _write_page(self) -> None:
        result = self._screen.result.result
        path = self._ask_path("carpus-camera-calibration.pdf", self.tr("Save one page"))
        if path is not None and result is not None:
            when = self._now()
            self._background.run(
                lambda: replace_file(path, lambda part: write_calibration_page(part, result, when)),
                lambda _: None, self._tell.fault, self,
            )  # fmt: skip

    def _ask_path(self, name: str, title: str) -> Path | None:
        return self._places.ask_where_to_save(self._window, "reports", name, title, "PDF (*.pdf)")

    # --- showing ------------------------------------------------------------------------------------------
    def begin(self, choice: BoardChoice) -> None:
        """Open the camera and look for the board."""
        self.leave()
        self._choice = choice
        newest, known = Newest[BoardProgress](), self._naming.begin()
        self._newest = newest
        self._screen.show_showing(simulated=choice.practice)

        def looker(info: SourceInfo) -> Look:
            gathering = Gathering(info.camera, [choice.board])
            self._gathering = gathering
            asked = ASKED_VIEWS[choice.pattern]
            size_px = (info.camera.width_px, info.camera.height_px)

            def look(frame: Frame) -> None:
                seen = gathering.look(frame) if known.is_set() else None
                if seen is None:
                    return
                judgement = gathering.judgement
                step = next_step(judgement, seen.found, size_px, asked)
                target = target_outline(step, choice.board, info.camera)
                newest.put(BoardProgress(seen, judgement, step, target, choice.board.corner_count, asked, frame))

            return look

        self.hand.open(lambda notice: self._cameras.for_board(choice.board, notice, practice=choice.practice), looker)

    def _opened(self, info: SourceInfo) -> None:
        self._info = info
        self._screen.showing.opened()
        self._naming.opened(info, self._cameras.folder(practice=self._choice.practice))

    def _failed(self, fault: Exception) -> None:
        self.back()
        self._tell.fault(fault)

    def _pulled(self, frame: Frame) -> None:
        showing = self._screen.showing
        if not self._working:
            now = self._newest.look()
            if now is not None and now is not showing.progress:
                showing.show_progress(now)
            showing.show_frame(frame)

    # --- the result ---------------------------------------------------------------------------------------
    def _work_out(self) -> None:
        gathering, info, choice = self._gathering, self._info, self._choice
        if gathering is None or info is None or self._working:
            return
        self._working = True
        views = list(gathering.views)
        folder = self._cameras.folder(practice=choice.practice)
        self._screen.showing.work()

        def work() -> BoardResult:
            serial = info.settings.get(SERIAL, "")
            made = calibrate_camera(views, info.camera, info.name)
            before = stored_calibration(folder, serial) if serial else None
            since = ""
            if before is not None and before.calibration is not None:
                since = numbers.day_of_year(datetime.fromisoformat(before.calibration.calibrated))
            simulated = is_simulated(info)
            may_use = bool(serial)
            return BoardResult(made, effect_of(made, views), info.name, serial, since, simulated, may_use)

        def done(result: BoardResult) -> None:
            self._working = False
            if gathering is self._gathering:
                self.hand.close()
                self._screen.show_result(result)

        def failed(fault: Exception) -> None:
            self._working = False
            if gathering is not self._gathering:
                return
            if isinstance(fault, BoardViewsAlike | BoardMissing):
                words = self.tr("Show it some more, tilted more and nearer: {why}.").format(why=fault.detail)
                self._screen.showing.more(words)
            else:
                self._failed(fault)

        self._background.run(work, done, failed, self)

    def _use(self) -> None:
        result, info, choice = self._screen.result.result, self._info, self._choice
        if result is None or info is None:
            return
        when, folder = self._now(), self._cameras.folder(practice=choice.practice)
        stored = stored_of(result.made, result.serial, when, info.settings)
        self._background.run(
            lambda: keep_calibration(folder, result.made, stored),
            lambda _: self.kept.emit(result.simulated), self._tell.fault, self,
        )  # fmt: skip


def lost_words(fault: Exception | None) -> str:
    """A camera that is away, and what to do."""
    words = fault_words(fault if isinstance(fault, CarpusFault) else CameraLost())
    return f"{words.happened} {words.do}"

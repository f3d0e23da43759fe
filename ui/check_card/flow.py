"""The flow of the check card: print it, look at it for 30 seconds, and keep the verdict."""

from __future__ import annotations

from datetime import datetime

from carpus.core.calibration.camera.sheet import PAPER_MM
from carpus.core.calibration.card.card import card_sheets
from carpus.core.calibration.card.checks import CardCheck, add_check, checks_path
from carpus.core.calibration.card.measure import CardWatch
from carpus.core.dates import iso
from carpus.core.pipeline.channels import Newest
from carpus.core.pipeline.live import LiveSession
from carpus.core.types import Frame
from carpus.ui.camera_at_hand import AtCameraFlow, Look
from carpus.ui.check_card.screen import CardScreen
from carpus.ui.flow import ScreenContext
from carpus.ui.report.pdf import write_sheets
from carpus.ui.words.camera_check import CardProgress


class CardFlow(AtCameraFlow):
    """Whatever was open is closed: the camera is needed."""

    place = "card"
    screen: CardScreen

    def __init__(self, context: ScreenContext) -> None:
        screen, camera = CardScreen(context.theme), context.camera
        super().__init__(context, screen, screen.name_sheet)
        self._newest: Newest[CardProgress] = Newest()
        self._measured: tuple[LiveSession, CardWatch] | None = None
        self.hand.opened.connect(self._opened)
        self.hand.pulled.connect(self._pulled)
        self.hand.lost.connect(screen.show_lost)
        camera.when_looked(lambda: screen.set_camera_there(camera.there))
        camera.changed.connect(lambda: screen.show_status(camera.status))
        screen.check_button.clicked.connect(self.begin)
        screen.stop_button.clicked.connect(self.back)
        screen.print_button.clicked.connect(self._print_card)
        screen.calibrate_button.clicked.connect(lambda: context.way.show("board"))

    def title(self) -> str:
        return self.tr("Check card")

    def show(self) -> None:
        """What the last check said; read anew in the background, since a disk may keep anybody waiting."""
        self.close_patient()
        self.back()
        self.context.camera.read()
        self.context.way.go("card")

    def up(self) -> None:
        """From a check to its beginning, and from there to the settings."""
        if self.screen.is_measuring:
            self.back()
        else:
            self.to_settings()

    def back(self) -> None:
        self.leave()
        self.screen.show_status(self.context.camera.status)
        self.screen.end_measuring()

    def leave(self) -> None:
        """Let the camera go; a check that has not ended is forgotten."""
        super().leave()
        self._measured = None

    def begin(self) -> None:
        self.leave()
        newest = self._newest = Newest()
        known, cameras = self._known, self.context.cameras
        self.screen.begin_measuring()

        def looker(session: LiveSession) -> Look:
            watch = CardWatch(session.info.camera, steady=True)
            self._measured = session, watch  # in one value, so that another cannot be taken for it

            def look(frame: Frame) -> None:
                seen = watch.look(frame) if known.is_set() and not watch.done else None
                if seen is not None:
                    newest.put(CardProgress(seen.pixel, seen.blue, seen.seconds, seen.moved))

            return look

        self.hand.open(cameras.for_card, looker)

    def _opened(self, session: LiveSession) -> None:
        self.screen.show_progress(None)
        self._meet(session)

    def _pulled(self, frame: Frame) -> None:
        self.screen.show_frame(frame.color_rgb)
        now = self._newest.look()
        if now is not None and now is not self.screen.progress:
            self.screen.show_progress(now)
        if self._measured is not None and self._measured[1].done:
            session, watch = self._measured
            self._measured = None
            self.hand.close()
            self._keep(session, watch)

    def _keep(self, session: LiveSession, watch: CardWatch) -> None:
        info, when, camera = session.info, iso(datetime.now().astimezone()), self.context.camera
        path = checks_path(self.context.cameras.folder(), info.serial)

        def keep() -> None:
            reading = watch.reading(info.name)
            add_check(path, CardCheck(when, info.serial, reading, info.settings.get("calibrated", "")))

        def kept(_: object) -> None:
            camera.met(info.serial)
            self.screen.end_measuring()

        self.run(keep, kept, self._failed)

    def _print_card(self) -> None:
        paper = self.screen.paper.value()
        sheets = card_sheets(next(one for one in PAPER_MM if one == paper))
        name, title = f"carpus-check-card-{paper}.pdf", self.tr("Save the card to print")
        self.save_page(name, title, lambda part: write_sheets(part, sheets, "Carpus check card"))

"""The flow of the check card: its history, a check of 30 seconds, and the papers of both."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from carpus.core.calibration.camera.sheet import PAPER_MM
from carpus.core.calibration.card.card import card_sheets
from carpus.core.calibration.card.chart import add_check, chart_path, check_of, read_checks
from carpus.core.calibration.card.measure import CardWatch
from carpus.core.calibration.card.standing import standing_of
from carpus.core.dates import is_moment, iso
from carpus.core.pipeline.channels import Newest
from carpus.core.pipeline.live import LiveSession
from carpus.core.types import Frame
from carpus.ui import numbers
from carpus.ui.camera_at_hand import AtCameraFlow, Look
from carpus.ui.check_card.screen import CardScreen
from carpus.ui.flow import ScreenContext
from carpus.ui.report.check_page import CheckResult, write_check_report
from carpus.ui.report.pdf import write_sheets
from carpus.ui.words.check_card import CameraChecks, CardProgress


class CardFlow(AtCameraFlow):
    """Whatever was open is closed: the camera is needed."""

    place = "card"
    screen: CardScreen

    def __init__(self, context: ScreenContext) -> None:
        screen = CardScreen(context.theme, context.keys)
        super().__init__(context, screen)
        self._newest: Newest[CardProgress] = Newest()
        self._measured: tuple[LiveSession, CardWatch] | None = None
        self._asked, self._unread = 0, False
        self.hand.opened.connect(self._opened)
        self.hand.pulled.connect(self._pulled)
        self.hand.lost.connect(screen.show_lost)
        context.camera.when_looked(lambda: screen.set_camera_there(context.camera.there))
        screen.camera.setHidden(context.is_demo)
        screen.camera.chosen.connect(self._choose_camera)
        screen.check_button.clicked.connect(self.begin)
        screen.leave_button.clicked.connect(self.back)
        screen.print_button.clicked.connect(self._print_card)
        screen.page_button.clicked.connect(self._write_page)
        screen.calibrate_button.clicked.connect(lambda: context.way.show("board"))

    # --- the way ------------------------------------------------------------------------------------------
    def title(self) -> str:
        return self.tr("Check card")

    def show(self, practice: bool | None = None) -> None:
        """What the checks say so far, ``practice`` of the simulated camera."""
        self.close_patient()
        self.leave()
        self._choose_camera(self.practice if practice is None else practice)
        self.context.way.go("card")

    def up(self) -> None:
        """From a check to the history, and from there to the patients."""
        if self.screen.is_measuring:
            self.back()
        else:
            self.to_patient()

    def back(self) -> None:
        self.leave()
        self.screen.show_checks(self.screen.checks)
        if self._unread:
            self._choose_camera(self.practice)

    def leave(self) -> None:
        """Let the camera go; a check that has not ended is forgotten."""
        super().leave()
        self._measured = None

    def _choose_camera(self, practice: bool) -> None:
        """Read which camera it is and its checks in the background: the disk may keep anybody waiting."""
        now, cameras = datetime.now().astimezone(), self.context.cameras
        self.practice = practice
        self._asked += 1
        asked, self._unread = self._asked, True

        def read() -> CameraChecks:
            serial = cameras.serial(practice=practice)
            return checks_of(cameras.folder(practice=practice), serial, now, simulated=practice)

        def shown(checks: CameraChecks) -> None:
            if asked == self._asked and not self.screen.is_measuring:
                self._unread = False
                self.screen.show_checks(checks)

        self.screen.show_checks(CameraChecks("", "", simulated=practice))
        self.run(read, shown)

    # --- a check ------------------------------------------------------------------------------------------
    def begin(self) -> None:
        self.leave()
        newest = self._newest = Newest()
        practice, known, cameras = self.practice, self._known, self.context.cameras
        self._asked += 1
        self.screen.begin_measuring()

        def looker(session: LiveSession) -> Look:
            watch = CardWatch(session.info.camera, steady=True)
            self._measured = session, watch  # in one value, so that another cannot be taken for it

            def look(frame: Frame) -> None:
                seen = watch.look(frame) if known.is_set() and not watch.done else None
                if seen is not None:
                    newest.put(CardProgress(seen.pixel, seen.blue, seen.seconds, seen.moved))

            return look

        self.hand.open(lambda: cameras.for_card(practice=practice), looker)

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
        practice, info, now, camera = self.practice, session.info, datetime.now().astimezone(), self.context.camera
        folder, serial = self.context.cameras.folder(practice=practice), info.serial

        def keep() -> CameraChecks:
            reading = watch.reading(info.name)
            check = check_of(reading, serial, iso(now), info.settings.get("calibrated", ""))
            add_check(chart_path(folder, serial), check)
            return checks_of(folder, serial, now, info.name, simulated=practice)

        def kept(checks: CameraChecks) -> None:
            if not practice:
                self.context.cameras.met(serial)
            self._unread = False
            self.screen.show_checks(checks)
            camera.read()

        self.run(keep, kept, self._failed)

    # --- paper --------------------------------------------------------------------------------------------
    def _print_card(self) -> None:
        paper = self.screen.paper.value()
        sheets = card_sheets(next(one for one in PAPER_MM if one == paper))
        name, title = f"carpus-check-card-{paper}.pdf", self.tr("Save the card to print")
        self.save_page(name, title, lambda part: write_sheets(part, sheets, "Carpus check card"))

    def _write_page(self) -> None:
        checks = self.screen.checks
        last = checks.newest
        if last is None:
            return
        calibrated = last.calibrated[:10] or self.tr("not with a board")
        asides = [(self.tr("Calibrated"), calibrated), (self.tr("Checks"), str(len(checks.checks)))]
        camera = f"{checks.camera} {checks.serial}".strip()
        result = CheckResult(camera, last, list(checks.checks[:-1]), asides)
        name, title = "carpus-camera-check.pdf", self.tr("Save one page")
        self.save_page(name, title, lambda part: write_check_report(part, result))


def checks_of(folder: Path, serial: str, now: datetime, camera: str = "", *, simulated: bool) -> CameraChecks:
    """All that is known of a camera's checks."""
    if not serial:
        return CameraChecks(camera, "", simulated=simulated)
    standing = standing_of(folder, serial, now)
    checks = [one for one in read_checks(chart_path(folder, serial)) if one.serial == serial]
    calibrated = checks[-1].calibrated if checks else ""
    day = numbers.day_of_year(datetime.fromisoformat(calibrated)) if is_moment(calibrated) else ""
    return CameraChecks(
        camera, serial, checks, standing.verdict, standing.checked_days, day, standing.recalibrated, simulated
    )

"""The flow of the check card: its history, a check of 30 seconds, and the papers of both."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Protocol

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from carpus.app.desktop.calibrating import lost_words
from carpus.app.desktop.camera_at_hand import CameraAtHand, Look
from carpus.app.desktop.naming import Naming
from carpus.core.calibration.camera.sheet import PAPER_MM
from carpus.core.calibration.card.card import card_sheets
from carpus.core.calibration.card.chart import add_check, chart_path, check_of, read_checks
from carpus.core.calibration.card.measure import CardWatch
from carpus.core.calibration.card.standing import standing_of
from carpus.core.capture.calibrated import SERIAL
from carpus.core.capture.source import FrameSource, Notice, SourceInfo
from carpus.core.dates import is_moment, iso
from carpus.core.durable import replace_file
from carpus.core.pipeline.channels import Newest
from carpus.core.types import Frame
from carpus.ui import numbers
from carpus.ui.background import Background
from carpus.ui.check_card.screen import CardScreen
from carpus.ui.check_card.values import CameraChecks, CardProgress
from carpus.ui.flow import Navigator
from carpus.ui.last_places import LastPlaces
from carpus.ui.messages.messages import Messages
from carpus.ui.report.check_page import CheckResult, write_check_report
from carpus.ui.report.pdf import write_sheets


class CardCameras(Protocol):
    """Opens the camera that looks at the card, as a session would."""

    def for_card(self, notice: Notice, *, practice: bool) -> FrameSource: ...

    def folder(self, *, practice: bool) -> Path:
        """Where what is known of it is kept."""
        ...

    def serial(self, *, practice: bool) -> str:
        """The number of the camera, as far as it is known before one is opened; empty where it is not."""
        ...

    def met(self, serial: str) -> None:
        """The number of the camera that is there."""
        ...


@dataclass(frozen=True, slots=True)
class _Measured:
    """A check that ran, in one value so that another cannot be taken for it."""

    info: SourceInfo
    watch: CardWatch


class Checking(QObject):
    """``checked`` when there is a new check; ``calibrate`` leads to the board."""

    checked = Signal()
    calibrate = Signal()

    def __init__(
        self,
        window: QWidget,
        screen: CardScreen,
        way: Navigator,
        tell: Messages,
        cameras: CardCameras,
        places: LastPlaces,
        background: Background,
        *,
        is_demo: bool,
        now: Callable[[], datetime],
    ) -> None:
        super().__init__(window)
        self._window, self._screen, self._way, self._tell, self._cameras = window, screen, way, tell, cameras
        self._places, self._background, self._now, self._practice = places, background, now, is_demo
        self._newest: Newest[CardProgress] = Newest()
        self._measured: _Measured | None = None
        self._asked, self._unread = 0, False
        self._naming = Naming(self, screen.name_sheet, background, self.begin, self.back, self._failed)
        self.hand = CameraAtHand(self)
        self.hand.opened.connect(self._opened)
        self.hand.failed.connect(self._failed)
        self.hand.pulled.connect(self._pulled)
        self.hand.lost.connect(lambda fault: screen.show_lost(lost_words(fault)))
        screen.camera.setHidden(is_demo)
        screen.camera_chosen.connect(self._choose_camera)
        screen.check.connect(self.begin)
        screen.leave.connect(self.back)
        screen.print_card.connect(self._print_card)
        screen.page.connect(self._write_page)
        screen.calibrate.connect(self.calibrate)

    # --- the way ------------------------------------------------------------------------------------------
    def show(self, *, practice: bool | None = None) -> None:
        """What the checks say so far."""
        self.leave()
        self._practice = self._practice if practice is None else practice
        self._read()
        self._way.go("card")

    def back(self) -> None:
        """From a check to the history."""
        self.leave()
        self._screen.show_checks(self._screen.checks)
        if self._unread:
            self._read()

    def leave(self) -> None:
        """Let the camera go; a check that has not ended is forgotten."""
        self._naming.end()
        self.hand.close()
        self._measured = None

    def _choose_camera(self, practice: bool) -> None:
        self._practice = practice
        self._read()

    def _read(self) -> None:
        """Read which camera it is and its checks in the background: the disk may keep anybody waiting."""
        practice, now, cameras = self._practice, self._now(), self._cameras
        self._asked += 1
        asked, self._unread = self._asked, True

        def read() -> CameraChecks:
            serial = cameras.serial(practice=practice)
            return checks_of(cameras.folder(practice=practice), serial, now, simulated=practice)

        def shown(checks: CameraChecks) -> None:
            if asked == self._asked and not self._screen.is_measuring:
                self._unread = False
                self._screen.show_checks(checks)

        self._screen.show_checks(CameraChecks("", "", simulated=practice))
        self._background.run(read, shown, self._tell.fault, self)

    # --- a check ------------------------------------------------------------------------------------------
    def begin(self) -> None:
        """Open the camera and look at the card."""
        self.leave()
        newest = self._newest = Newest()
        practice, known = self._practice, self._naming.begin()
        self._asked += 1
        self._screen.begin_measuring()

        def looker(info: SourceInfo) -> Look:
            watch = CardWatch(info.camera, steady=True)
            self._measured = _Measured(info, watch)

            def look(frame: Frame) -> None:
                seen = watch.look(frame) if known.is_set() and not watch.done else None
                if seen is not None:
                    newest.put(CardProgress(seen.pixel, seen.blue, seen.seconds, seen.moved))

            return look

        self.hand.open(lambda notice: self._cameras.for_card(notice, practice=practice), looker)

    def _opened(self, info: SourceInfo) -> None:
        self._screen.show_progress(None)
        self._naming.opened(info, self._cameras.folder(practice=self._practice))

    def _failed(self, fault: Exception) -> None:
        self.back()
        self._tell.fault(fault)

    def _pulled(self, frame: Frame) -> None:
        self._screen.show_frame(frame.color_rgb)
        now = self._newest.look()
        if now is not None and now is not self._screen.progress:
            self._screen.show_progress(now)
        measured = self._measured
        if measured is not None and measured.watch.done:
            self._measured = None
            self.hand.close()
            self._keep(measured)

    def _keep(self, measured: _Measured) -> None:
        """Work out what was measured and add it to the chart."""
        practice, info, now = self._practice, measured.info, self._now()
        folder, serial = self._cameras.folder(practice=practice), info.settings.get(SERIAL, "")

        def keep() -> CameraChecks:
            reading = measured.watch.reading(info.name)
            check = check_of(reading, serial, iso(now), info.settings.get("calibrated", ""))
            add_check(chart_path(folder, serial), check)
            return checks_of(folder, serial, now, info.name, simulated=practice)

        def kept(checks: CameraChecks) -> None:
            if not practice:
                self._cameras.met(serial)
            self._unread = False
            self._screen.show_checks(checks)
            self.checked.emit()

        self._background.run(keep, kept, self._failed, self)

    # --- paper --------------------------------------------------------------------------------------------
    def _print_card(self, paper: str) -> None:
        sheets = card_sheets(next(one for one in PAPER_MM if one == paper))
        path = self._ask_path(f"carpus-check-card-{paper}.pdf", self.tr("Save the card to print"))
        if path is not None:
            self._background.run(
                lambda: replace_file(path, lambda part: write_sheets(part, sheets, "Carpus check card")),
                lambda _: None, self._tell.fault, self,
            )  # fmt: skip

    def _write_page(self) -> None:
        checks = self._screen.checks
        last = checks.newest
        if last is None:
            return
        path = self._ask_path("carpus-camera-check.pdf", self.tr("Save one page"))
        if path is None:
            return
        calibrated = last.calibrated[:10] or self.tr("not with a board")
        asides = [(self.tr("Calibrated"), calibrated), (self.tr("Checks"), str(len(checks.checks)))]
        camera = f"{checks.camera} {checks.serial}".strip()
        result = CheckResult(camera, last, list(checks.checks[:-1]), asides)
        self._background.run(
            lambda: replace_file(path, lambda part: write_check_report(part, result)),
            lambda _: None, self._tell.fault, self,
        )  # fmt: skip

    def _ask_path(self, name: str, title: str) -> Path | None:
        return self._places.ask_where_to_save(self._window, "reports", name, title, "PDF (*.pdf)")


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

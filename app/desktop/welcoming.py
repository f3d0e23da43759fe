"""The very first start: a look at the computer, where the data will lie, and the offer of a guided session."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QGuiApplication

from carpus.app.desktop.journey import Journey
from carpus.app.desktop.preferences import PreferenceKeeper
from carpus.app.desktop.touring import Tour
from carpus.app.settings import FirstStartSettings
from carpus.core.capture.doctor import examine_at_start
from carpus.core.installing import Finding
from carpus.core.records.library import Library
from carpus.ui.background import Background
from carpus.ui.fonts import DISPLAY_FAMILY, TEXT_FAMILY, load_fonts
from carpus.ui.messages.messages import NoticeStrip
from carpus.ui.ports import Preferences
from carpus.ui.shell import LEAST_SIZE_PX
from carpus.ui.theme import Theme
from carpus.ui.translate import say
from carpus.ui.welcome.panel import Check, WelcomePanel


class Welcome(QObject):
    """A panel below the empty list, until it is answered or there is a patient. It takes no key from the search."""

    def __init__(self, journey: Journey, theme: Theme, tour: Tour, keeper: PreferenceKeeper, library: Library) -> None:
        super().__init__(journey)
        self._journey, self._theme, self._tour, self._keeper, self._library = journey, theme, tour, keeper, library
        self._background = Background()
        self._escape_before = journey.takes_escape
        self.panel: WelcomePanel | None = None
        self._folder = library.folder
        journey.takes_escape = self._take_escape
        tour.ended.connect(self._remember)
        journey.way.when_made("settings", lambda: keeper.screen.changed.connect(self._take_folder))

    def begin(self) -> None:
        """Offer it where nobody has answered it and nobody is in the list."""
        if self._keeper.first_start_answered or self._library.patients.listed(most=1) or self.panel is not None:
            return
        panel = self.panel = WelcomePanel(self._theme)
        panel.show_folder(str(self._folder), counts_later=False)
        panel.tour.connect(self._lead)
        panel.later.connect(self._decline)
        panel.again.connect(self.look)
        panel.folder.connect(lambda: self._keeper.screen.ask_folder())
        panel.close_wanted.connect(self._journey.patients.screen.window().close)
        self._journey.patients.screen.show_welcome(panel)
        self.look()

    def end(self) -> None:
        """The window closes."""
        self._background.wait()

    def look(self) -> None:
        """At the computer, beside the window."""
        panel = self.panel
        if panel is None:
            return
        panel.show_looking()
        folder, here = self._folder, self._of_the_window()

        def show(found: list[Finding]) -> None:
            if panel is self.panel:
                panel.show_checks([*(self._check(finding) for finding in found), *here])

        def failed(fault: Exception) -> None:
            panel.show_checks(here)
            self._journey.messages.fault(fault)

        needs_camera = not self._journey.is_demo
        self._background.run(lambda: list(examine_at_start(folder, needs_camera=needs_camera)), show, failed, panel)

    def _of_the_window(self) -> list[Check]:
        """What only the window knows."""
        name = self.tr("Screen")
        room = QGuiApplication.primaryScreen().availableGeometry()
        found = self.tr("{width} × {height} for windows").format(width=room.width(), height=room.height())
        small = room.width() < LEAST_SIZE_PX[0] or room.height() < LEAST_SIZE_PX[1]
        remedy = self.tr("Choose more pixels, or a smaller scale, in the display settings: {width} × {height} or more.")
        checks = [
            Check(name, "warning", found, remedy.format(width=LEAST_SIZE_PX[0], height=LEAST_SIZE_PX[1]))
            if small
            else Check(name, "good", found)
        ]
        if not {TEXT_FAMILY, DISPLAY_FAMILY} <= set(load_fonts()):
            remedy = self.tr("Install Carpus again: part of it is missing or damaged.")
            checks.append(Check(self.tr("Fonts"), "bad", self.tr("the program’s own cannot be used"), remedy))
        return checks

    def _check(self, finding: Finding) -> Check:
        names = {
            "Camera": self.tr("Camera"), "Driver": self.tr("Camera driver"), "Camera rights": self.tr("Camera rights"),
            "Data folder": self.tr("Data folder"), "Disk": self.tr("Disk"), "Fonts": self.tr("Fonts"),
        }  # fmt: skip
        return Check(
            names.get(finding.name) or say(finding.name), finding.state, say(finding.found), say(finding.remedy)
        )

    def _take_folder(self, chosen: Preferences) -> None:
        folder = Path(chosen.data_folder)
        if self.panel is not None and folder != self._folder:
            self._folder = folder
            self.panel.show_folder(str(folder), counts_later=folder != self._library.folder)
            self.look()

    def _lead(self) -> None:
        self._close()
        self._tour.begin(asked_for=False)

    def _decline(self) -> None:
        self._close()
        self._remember()

    def _close(self) -> None:
        if self.panel is not None:
            self.panel = None
            self._journey.patients.screen.show_welcome(None)
            self._journey.patients.screen.search.setFocus(Qt.FocusReason.OtherFocusReason)

    def _remember(self) -> None:
        self._keeper.keep(first_start=FirstStartSettings(answered=True))

    def _take_escape(self) -> bool:
        if self._escape_before():
            return True
        if self.panel is None or self._journey.place != "patients":
            return False
        if self._journey.patients.screen.findChildren(NoticeStrip):
            return False  # what stands above the list is answered first
        self._decline()
        return True

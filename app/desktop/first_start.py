"""The first start: checks of the computer, the data folder, and a guided first session."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QAbstractButton

from carpus.app.desktop.main_controller import MainController
from carpus.app.desktop.preferences import PreferencesController
from carpus.app.settings import WelcomeSettings
from carpus.core.capture.doctor import examine_at_start
from carpus.core.model.installation import Finding
from carpus.core.records.data_folder import DataFolder
from carpus.ui.kit.background import Background
from carpus.ui.kit.dialog import has_open_dialog
from carpus.ui.kit.fonts import DISPLAY_FAMILY, TEXT_FAMILY, load_fonts
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import translate_phrase
from carpus.ui.screens.tour.bubble import ONLY_READ, Bubble, BubbleView, TourState, find_bubble
from carpus.ui.screens.welcome.panel import WelcomePanel
from carpus.ui.shell.main_window import MIN_SIZE_PX
from carpus.ui.shell.messages import NoticeStrip

if TYPE_CHECKING:
    from carpus.ui.screens.settings.screen import Preferences

REFRESH_EVERY_MS = 150


class TourController(QObject):
    """Guides through a session with bubbles; ``ended`` when it was cancelled or finished."""

    ended = Signal()

    def __init__(self, controller: MainController) -> None:
        super().__init__(controller)
        self._controller = controller
        self._is_requested = False
        self._read_bubbles: frozenset[Bubble] = frozenset()
        self._is_report_saved = False
        self._views: dict[str, BubbleView] = {}
        for place in ("patients", "camera", "markers", "live", "review", "report"):
            controller.navigator.run_when_created(place, partial(self._connect_view, place))
        self._clock = QTimer(self)
        self._clock.setInterval(REFRESH_EVERY_MS)
        self._clock.timeout.connect(self.refresh)
        controller.navigator.run_when_created(
            "report", lambda: controller.report.screen.saved.connect(self._on_report_saved)
        )
        controller.navigator.screen_changed.connect(self._on_screen_changed)
        controller.navigator.run_when_created(
            "help", lambda: controller.help.screen.tour_button.clicked.connect(self._start_from_help)
        )
        controller.handle_escape = self._handle_escape

    def _connect_view(self, place: str) -> None:
        (shown,) = self._controller.navigator.flows[place].screen.findChildren(BubbleView)
        self._views[place] = shown
        shown.next_button.clicked.connect(self.advance)
        shown.leave_button.clicked.connect(self.cancel)

    @property
    def is_on(self) -> bool:
        return self._clock.isActive()

    @property
    def bubble(self) -> Bubble | None:
        return next((view.bubble for view in self._views.values() if view.bubble is not None), None)

    def start(self, *, is_requested: bool) -> None:
        """Start the tour; only for the practice patient unless ``is_requested``."""
        self._is_requested = is_requested
        self._read_bubbles = frozenset()
        self._is_report_saved = False
        self._clock.start()
        self.refresh()

    def cancel(self) -> None:
        if self.is_on:
            self.stop()
            self.ended.emit()

    def stop(self) -> None:
        self._clock.stop()
        for view in self._views.values():
            view.show_bubble(None)

    def advance(self) -> None:
        """Press the control that the bubble points at, or mark the bubble as read."""
        bubble = self.bubble
        if bubble == "end":
            self.cancel()
            return
        if bubble is None:
            return
        controller = self._controller
        buttons: dict[Bubble, Callable[[], QAbstractButton]] = {
            "patient": lambda: controller.patients.screen.card.start_button,
            "camera": lambda: controller.camera.screen.primary_button,
            "record": lambda: controller.live.screen.controls.main_button,
            "stop": lambda: controller.live.screen.controls.main_button,
            "results": lambda: controller.review.screen.card.report_button,
            "report": lambda: controller.review.screen.card.report_button,
            "save": lambda: controller.report.screen.save_button,
        }
        button = buttons.get(bubble, lambda: controller.markers.screen.primary_button)()
        if bubble in ONLY_READ or not button.isEnabled():
            self._read_bubbles |= {bubble}
        else:
            button.click()
        self.refresh()

    def refresh(self) -> None:
        """Show the bubble of the present state, and no other."""
        if not self.is_on:
            return
        moment = self.tour_state()
        bubble = find_bubble(moment, self._read_bubbles)
        for place, view in self._views.items():
            view.show_bubble(bubble if place == moment.place else None)

    def tour_state(self) -> TourState:
        controller = self._controller
        place, made = controller.place, controller.navigator.flows
        is_busy: dict[str, Callable[[], bool]] = {
            "camera": lambda: controller.camera.screen.is_opening,
            "live": lambda: controller.live.screen.recording.is_storing,
            "review": lambda: not controller.review.screen.is_loaded,
        }
        return TourState(
            place,
            is_wanted=self._is_requested or place == "patients" or controller.current.is_practice,
            is_covered=controller.messages.is_busy or has_open_dialog(controller.patients.screen.window()),
            is_busy=place in is_busy and is_busy[place](),
            label_stage=controller.markers.screen.labelling.stage if "markers" in made else "aiming",
            is_recording="live" in made and controller.live.screen.recording.state != "off",
            is_saved=self._is_report_saved,
        )

    def _on_report_saved(self, _: str) -> None:
        self._is_report_saved = True
        self.refresh()

    def _on_screen_changed(self, place: str) -> None:
        if place != "report":
            self._is_report_saved = False
        self.refresh()

    def _start_from_help(self) -> None:
        self._controller.navigator.navigate_back()
        self.start(is_requested=True)

    def _handle_escape(self) -> bool:
        if self.bubble is None:
            return False
        self.cancel()
        return True


class WelcomeController(QObject):
    """Shows a panel below the empty patient list; it takes no key from the search."""

    def __init__(
        self,
        controller: MainController,
        theme: Theme,
        tour: TourController,
        preferences: PreferencesController,
        library: DataFolder,
    ) -> None:
        super().__init__(controller)
        self._controller, self._theme, self._tour = controller, theme, tour
        self._preferences, self._library = preferences, library
        self._background = Background()
        self._handle_escape_before = controller.handle_escape
        self.panel: WelcomePanel | None = None
        self._folder = library.folder
        controller.handle_escape = self._handle_escape
        tour.ended.connect(self._save_answered)
        controller.navigator.run_when_created(
            "settings", lambda: preferences.screen.changed.connect(self._update_folder)
        )

    def show_if_first_start(self) -> None:
        """Show the panel unless it was answered or there are patients."""
        is_answered = self._preferences.settings.first_start.answered
        if is_answered or self.panel is not None or self._library.store.is_server_away:
            return
        if self._library.patients.search(limit=1):
            return
        panel = self.panel = WelcomePanel(self._theme)
        panel.show_folder(str(self._folder), needs_restart=False)
        panel.tour_button.clicked.connect(self._start_tour)
        panel.later_button.clicked.connect(self._decline)
        panel.again_button.clicked.connect(self.run_checks)
        panel.folder_button.clicked.connect(lambda: self._preferences.screen.choose_folder())
        panel.close_button.clicked.connect(self._controller.patients.screen.window().close)
        panel.prints_names.chosen.connect(self._save_prints_names)
        self._controller.patients.screen.show_welcome(panel)
        self.run_checks()

    def _save_prints_names(self, prints_names: bool) -> None:
        form_store = self._controller.report.form_store
        form_store.save(replace(form_store.form, prints_names=prints_names))

    def stop(self) -> None:
        self._background.join()

    def run_checks(self) -> None:
        """Check the computer in the background."""
        panel = self.panel
        if panel is None:
            return
        panel.show_checking()
        # check screen size and fonts
        name = self.tr("Screen")
        room = QGuiApplication.primaryScreen().availableGeometry()
        found = self.tr("{width} × {height} usable").format(width=room.width(), height=room.height())
        small = room.width() < MIN_SIZE_PX[0] or room.height() < MIN_SIZE_PX[1]
        remedy = self.tr(
            "In the display settings, choose a higher resolution or a smaller scale: {width} × {height} or more."
        )
        checks = [
            Finding(name, "warning", found, remedy.format(width=MIN_SIZE_PX[0], height=MIN_SIZE_PX[1]))
            if small
            else Finding(name, "good", found)
        ]
        if not {TEXT_FAMILY, DISPLAY_FAMILY} <= set(load_fonts()):
            remedy = self.tr("Install Carpus again: part of it is missing or damaged.")
            checks.append(Finding(self.tr("Fonts"), "bad", self.tr("the fonts of Carpus cannot be loaded"), remedy))
        folder, here = self._folder, checks

        def show_findings(found: list[Finding]) -> None:
            if panel is self.panel:
                panel.show_checks([*(self._translate(finding) for finding in found), *here])

        def show_fault(fault: Exception) -> None:
            panel.show_checks(here)
            self._controller.messages.show_fault(fault)

        needs_camera = not self._controller.is_demo
        self._background.run(
            lambda: list(examine_at_start(folder, needs_camera=needs_camera)), show_findings, show_fault, panel
        )

    def _translate(self, finding: Finding) -> Finding:
        names = {
            "Camera": self.tr("Camera"), "Driver": self.tr("Camera driver"),
            "Camera permissions": self.tr("Camera permissions"),
            "Data folder": self.tr("Data folder"), "Disk": self.tr("Disk"), "Fonts": self.tr("Fonts"),
        }  # fmt: skip
        return Finding(
            names.get(finding.name) or translate_phrase(finding.name),
            finding.state,
            translate_phrase(finding.observation),
            translate_phrase(finding.remedy),
        )

    def _update_folder(self, chosen: Preferences) -> None:
        folder = Path(chosen.data_folder)
        if self.panel is not None and folder != self._folder:
            self._folder = folder
            self.panel.show_folder(str(folder), needs_restart=folder != self._library.folder)
            self.run_checks()

    def _start_tour(self) -> None:
        self._close()
        self._tour.start(is_requested=False)

    def _decline(self) -> None:
        self._close()
        self._save_answered()

    def _close(self) -> None:
        if self.panel is not None:
            self.panel = None
            self._controller.patients.screen.show_welcome(None)
            self._controller.patients.screen.search.setFocus(Qt.FocusReason.OtherFocusReason)

    def _save_answered(self) -> None:
        self._preferences.save(first_start=WelcomeSettings(answered=True))

    def _handle_escape(self) -> bool:
        if self._handle_escape_before():
            return True
        if self.panel is None or self._controller.place != "patients":
            return False
        if self._controller.patients.screen.findChildren(NoticeStrip):
            return False  # what stands above the list is answered first
        self._decline()
        return True

"""The very first start: a look at the computer, where the data will lie, and the offer of a guided first session, which
is led from bubble to bubble by where the person is."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QAbstractButton

from carpus.app.desktop.journey import Journey
from carpus.app.desktop.preferences import PreferenceKeeper
from carpus.app.settings import FirstStartSettings
from carpus.core.capture.doctor import examine_at_start
from carpus.core.installing import Finding
from carpus.core.records.library import Library
from carpus.ui.background import Background
from carpus.ui.controls.sheet import is_covered
from carpus.ui.fonts import DISPLAY_FAMILY, TEXT_FAMILY, load_fonts
from carpus.ui.messages.messages import NoticeStrip
from carpus.ui.ports import Preferences
from carpus.ui.shell import LEAST_SIZE_PX
from carpus.ui.theme import Theme
from carpus.ui.tour.bubble import BubbleView
from carpus.ui.tour.order import ONLY_READ, Bubble, TourMoment, bubble_at
from carpus.ui.translate import say
from carpus.ui.welcome.panel import Check, WelcomePanel

LOOK_EVERY_MS = 150


class Tour(QObject):
    """``ended`` when it was left or finished. It looks at the screens, and presses what a person could press."""

    ended = Signal()

    def __init__(self, journey: Journey) -> None:
        super().__init__(journey)
        self._journey = journey
        self._asked_for = False
        self._read: frozenset[Bubble] = frozenset()
        self._saved = False
        self._views: dict[str, BubbleView] = {}
        views: dict[str, Callable[[], BubbleView]] = {
            "patients": lambda: journey.patients.screen.card.bubble,
            "camera": lambda: journey.camera.screen.bubble,
            "markers": lambda: journey.markers.screen.bubble,
            "live": lambda: journey.live.screen.bubble,
            "review": lambda: journey.review.screen.bubble,
            "report": lambda: journey.report.screen.bubble,
        }
        for place, view in views.items():
            journey.way.when_made(place, partial(self._take_view, place, view))
        self._clock = QTimer(self)
        self._clock.setInterval(LOOK_EVERY_MS)
        self._clock.timeout.connect(self.look)
        journey.way.when_made("report", lambda: journey.report.screen.saved.connect(self._report_saved))
        journey.way.arrived.connect(self._arrived)
        journey.way.when_made("help", lambda: journey.help.screen.tour_button.clicked.connect(self._show_around))
        journey.takes_escape = self._take_escape

    def _take_view(self, place: str, view: Callable[[], BubbleView]) -> None:
        shown = self._views[place] = view()
        shown.next_button.clicked.connect(self.next)
        shown.leave_button.clicked.connect(self.leave)

    @property
    def is_on(self) -> bool:
        return self._clock.isActive()

    @property
    def bubble(self) -> Bubble | None:
        return next((view.bubble for view in self._views.values() if view.bubble is not None), None)

    def begin(self, *, asked_for: bool) -> None:
        """From the beginning; only for the practice patient unless it was asked for."""
        self._asked_for = asked_for
        self._read = frozenset()
        self._saved = False
        self._clock.start()
        self.look()

    def leave(self) -> None:
        if self.is_on:
            self.end()
            self.ended.emit()

    def end(self) -> None:
        """The window closes, or it was left: nothing is looked at any more."""
        self._clock.stop()
        for view in self._views.values():
            view.show_bubble(None)

    def next(self) -> None:
        """What the bubble speaks of is done; where only a person can do it, the bubble has been read."""
        bubble = self.bubble
        if bubble == "end":
            self.leave()
            return
        if bubble is None:
            return
        button = self._button(bubble)
        if bubble in ONLY_READ or not button.isEnabled():
            self._read |= {bubble}
        else:
            button.click()
        self.look()

    def look(self) -> None:
        """Show the bubble of this moment, and no other."""
        if not self.is_on:
            return
        moment = self.moment()
        bubble = bubble_at(moment, self._read)
        for place, view in self._views.items():
            view.show_bubble(bubble if place == moment.place else None)

    def moment(self) -> TourMoment:
        journey = self._journey
        place, made = journey.place, journey.way.flows
        is_busy: dict[str, Callable[[], bool]] = {
            "camera": lambda: journey.camera.screen.is_opening,
            "live": lambda: journey.live.screen.recording.storing,
            "review": lambda: not journey.review.screen.shown,
        }
        return TourMoment(
            place,
            is_meant=self._asked_for or place == "patients" or journey.now.is_practice,
            is_covered=journey.messages.busy or is_covered(journey.patients.screen.window()),
            is_busy=place in is_busy and is_busy[place](),
            work=journey.markers.screen.naming.work if "markers" in made else "aiming",
            is_recording="live" in made and journey.live.screen.recording.state != "off",
            is_saved=self._saved,
        )

    def _button(self, bubble: Bubble) -> QAbstractButton:
        """The control that a bubble speaks of."""
        journey = self._journey
        buttons: dict[Bubble, Callable[[], QAbstractButton]] = {
            "patient": lambda: journey.patients.screen.card.start_button,
            "camera": lambda: journey.camera.screen.primary,
            "record": lambda: journey.live.screen.controls.main,
            "stop": lambda: journey.live.screen.controls.main,
            "results": lambda: journey.review.screen.card.report_button,
            "report": lambda: journey.review.screen.card.report_button,
            "save": lambda: journey.report.screen.save_button,
        }
        return buttons.get(bubble, lambda: journey.markers.screen.primary)()

    def _report_saved(self, _: str) -> None:
        self._saved = True
        self.look()

    def _arrived(self, place: str) -> None:
        if place != "report":
            self._saved = False
        self.look()

    def _show_around(self) -> None:
        self._journey.way.back()
        self.begin(asked_for=True)

    def _take_escape(self) -> bool:
        if self.bubble is None:
            return False
        self.leave()
        return True


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
        if self._keeper.first_start_answered or self.panel is not None or self._library.store.is_away:
            return
        if self._library.patients.listed(most=1):
            return
        panel = self.panel = WelcomePanel(self._theme)
        panel.show_folder(str(self._folder), counts_later=False)
        panel.tour_button.clicked.connect(self._lead)
        panel.later_button.clicked.connect(self._decline)
        panel.again_button.clicked.connect(self.look)
        panel.folder_button.clicked.connect(lambda: self._keeper.screen.ask_folder())
        panel.close_button.clicked.connect(self._journey.patients.screen.window().close)
        self._journey.patients.screen.show_welcome(panel)
        self.look()

    def end(self) -> None:
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

"""Leads through a first session: looks where the person is and has the bubble of that moment shown."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QAbstractButton

from carpus.app.desktop.journey import Journey
from carpus.ui.controls.sheet import is_covered
from carpus.ui.tour.bubble import BubbleView
from carpus.ui.tour.order import ONLY_READ, Bubble, TourMoment, bubble_at

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
        journey.way.when_made("help", lambda: journey.help.screen.tour.connect(self._show_around))
        journey.takes_escape = self._take_escape

    def _take_view(self, place: str, view: Callable[[], BubbleView]) -> None:
        shown = self._views[place] = view()
        shown.next.connect(self.next)
        shown.leave.connect(self.leave)

    @property
    def is_on(self) -> bool:
        """Whether somebody is being led."""
        return self._clock.isActive()

    @property
    def bubble(self) -> Bubble | None:
        """What is shown now."""
        return next((view.bubble for view in self._views.values() if view.bubble is not None), None)

    def begin(self, *, asked_for: bool) -> None:
        """From the beginning; only for the practice patient unless it was asked for."""
        self._asked_for = asked_for
        self._read = frozenset()
        self._saved = False
        self._clock.start()
        self.look()

    def leave(self) -> None:
        """No more of it."""
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
        """Where the person is."""
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

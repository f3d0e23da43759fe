"""The table of places, and the one that moves between them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from carpus.app.desktop.places import ASIDE, Place
from carpus.ui.controls.sheet import Sheet
from carpus.ui.shell import Shell


def _nothing() -> None: ...


@dataclass(frozen=True, slots=True)
class ScreenStop:
    """A place: its screen, the control that gets the keyboard, where Back leads, and what ends when it is left.

    ``while_aside``: whether it goes on behind help and settings.
    """

    screen: QWidget
    first: Callable[[], QWidget]
    up: Callable[[], None]
    leave: Callable[[], None] = _nothing
    while_aside: bool = False


class Navigator(QObject):
    """``leaving`` with the new place before it is shown, ``arrived`` after."""

    leaving = Signal(str)
    arrived = Signal(str)

    def __init__(self, shell: Shell, is_asked: Callable[[], bool], is_recording: Callable[[], bool]) -> None:
        super().__init__(shell)
        self._shell, self._is_asked, self._is_recording = shell, is_asked, is_recording
        self._stops: dict[Place, ScreenStop] = {}
        self._place: Place = "patients"
        self._before_aside: Place = "patients"
        self._came: dict[Place, Place] = {}

    @property
    def place(self) -> Place:
        """Where the person is."""
        return self._place

    @property
    def behind(self) -> Place:
        """Where the person is, or was before help or settings."""
        return self._before_aside if self._place in ASIDE else self._place

    def put(self, place: Place, stop: ScreenStop) -> None:
        """Enter a place into the table."""
        self._stops[place] = stop

    def go(self, place: Place) -> None:
        """Show a place."""
        old, new = self._stops.get(self._place), self._stops[place]
        if old is not None and place != self._place and not (old.while_aside and place in ASIDE):
            old.leave()
        if place != self._place and self._place not in ASIDE:
            self._came[place] = self._place
        self._place = place
        self.leaving.emit(place)
        self._shell.show_screen(new.screen, new.first())
        self.arrived.emit(place)

    def came_from(self, place: Place) -> Place:
        """From where a place was last gone to, help and settings aside."""
        return self._came.get(place, "patients")

    def may_aside(self) -> bool:
        """Whether help and settings can be opened now: not from each other, a recording, or a question."""
        return not (self._place in ASIDE or self._is_recording() or self._is_asked())

    def aside(self, place: Place) -> None:
        """Help or settings, from which one comes back; not over a running recording."""
        if not self.may_aside():
            return
        self._before_aside = self._place
        self.go(place)

    def back(self) -> None:
        """One step back; what covers the screen goes first, and nothing leaves a message or a running recording."""
        if self._is_asked():
            return
        sheets = [sheet for sheet in self._shell.findChildren(Sheet) if sheet.isVisible()]
        if sheets:
            sheets[-1].leave()
        elif self._place in ASIDE:
            self.go(self._before_aside)
        elif not (self._place == "live" and self._is_recording()):
            self._stops[self._place].up()

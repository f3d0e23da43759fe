"""What a screen declares and does (:class:`Flow`), what all share (:class:`ScreenContext`), and the one that moves
between them (:class:`Navigator`)."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any, TypeVar

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from carpus.core.records.library import Library
from carpus.core.records.values import Patient
from carpus.core.results.report_form import ReportSettings
from carpus.ui.background import Background
from carpus.ui.camera_state import Cameras, CameraState
from carpus.ui.controls.sheet import Sheet
from carpus.ui.last_places import Kind, LastPlaces
from carpus.ui.messages.messages import Messages, tell_written
from carpus.ui.now_open import NowOpen
from carpus.ui.opening import Opener
from carpus.ui.shell import Shell
from carpus.ui.theme import Theme

T = TypeVar("T")
STEPS = ("exercise", "camera", "markers", "live")
"""The set-up, in order; the top bar counts them."""
TABS = ("sessions", "review", "progress", "report")
"""The views of an open patient, in the order of the tabs."""
ASIDE = ("help", "settings")
"""Places beside the way: from them one comes back to where one was."""


@dataclass(slots=True, eq=False)
class ScreenContext:
    """What the screens share. A screen makes itself what it alone needs."""

    shell: Shell
    theme: Theme
    library: Library
    background: Background
    messages: Messages
    way: Navigator
    now: NowOpen
    opener: Opener
    camera: CameraState
    cameras: Cameras
    places: LastPlaces
    report: ReportSettings
    """As chosen now."""
    today: Callable[[], date]
    """The day now: the program may stand open for days."""
    """Of Carpus, for what is written."""
    is_demo: bool = False
    patient_sound: bool = False
    """Whether the patient's view beeps where a goal is reached."""
    keep_pictures: bool = False
    """Where nobody chose yet; they take ``mb_per_minute``."""
    mb_per_minute: float = math.nan


class Flow(QObject):
    """One screen: where it stands, and what is done on it. Made once, it enters itself into the table of places."""

    place: str
    """Its name for the others: ``context.way.show("progress")``."""
    guide: str = "session"
    """The page of the guide that F1 opens on it."""
    tab: str = ""
    """Where it lies under a tab of an open patient without being one: that tab's place."""
    while_aside: bool = False
    """Whether it goes on behind help and settings."""
    screen: QWidget

    def __init__(self, context: ScreenContext, screen: QWidget) -> None:
        super().__init__(context.shell)
        self.context, self.screen = context, screen
        context.way.put(self)

    def show(self, *_: Any, **__: Any) -> None:
        """Bring it up; a screen that shows something certain says here what it must be told."""
        self.context.way.go(self.place)

    def title(self) -> str:
        """What the top bar says; who is open, where a screen is of nobody else."""
        return self.context.now.name

    def first(self) -> QWidget:
        """What gets the keyboard: what the screen itself names, or all of it."""
        named: Callable[[], QWidget] | None = getattr(self.screen, "first", None)
        return named() if named is not None else self.screen

    def up(self) -> None:
        """One step back from here."""
        self.to_patient()

    def to_patient(self) -> None:
        """Back to the list, with who is open."""
        row = self.context.now.patient
        self.context.way.show("patients", row.patient_id if row is not None else "")

    def to_session(self) -> None:
        """Back to the session that was looked at."""
        if self.context.now.session_id:
            self.context.way.show("review", self.context.now.session_id)
        else:
            self.to_patient()

    def leave(self) -> None:
        """Another screen is shown: what must not go on ends."""

    def close(self) -> None:
        """The window closes: what runs ends, and is waited for."""

    def asks_before_closing(self) -> bool:
        """Ask the person where something would be lost or end with the window; False where nothing would."""
        return False

    def server_back(self) -> None:
        """The clinic's server answers again: what could not be read before is read now."""

    @property
    def is_at_work(self) -> bool:
        """Whether something is worked on here that would end with the window."""
        return False

    def sign_lines(self) -> list[str]:
        """What must not be forgotten of what is on the screen."""
        return []

    def show_research(self, *, on: bool) -> None:
        """Show what only research needs, or fold it away; no value changes by it."""

    def open_patient(self, patient_id: str) -> Patient:
        """From now on this patient is open."""
        now = self.context.now
        if now.patient is None or now.patient.patient_id != patient_id:
            now.patient = self.context.library.patients.one(patient_id)
        return now.patient

    def close_patient(self) -> None:
        """Whoever was open is not any more, and the camera is let go."""
        self.context.opener.close_source()
        self.context.now.close()

    def run(
        self,
        work: Callable[[], T],
        done: Callable[[T], None] = lambda _: None,
        failed: Callable[[Exception], None] | None = None,
    ) -> None:
        """Work beside the window; its fault is told, unless ``failed`` does something else."""
        self.context.background.run(work, done, failed or self.context.messages.fault, self)

    def note_made(self, paths: Sequence[Path | str], sessions: Sequence[str]) -> None:
        """Files were made from sessions: they are named on the day these are erased."""
        self.context.library.made([Path(path) for path in paths], "export", sessions)

    def tell_made(self, paths: Sequence[Path], sessions: Sequence[str]) -> None:
        """The same, and said on a card."""
        self.note_made(paths, sessions)
        tell_written(self.context.messages, str(paths[0].parent), [path.name for path in paths])

    def ask_where_to_save(self, kind: Kind, name: str, title: str, kinds: str) -> Path | None:
        """A file to write, None when the person changed their mind."""
        return self.context.places.ask_where_to_save(self.context.shell, kind, name, title, kinds)


class Navigator(QObject):
    """The table of places, and the way between them: ``leaving`` with the new place before it is shown, ``arrived``
    after. ``changed``: what is said over the screen that is shown is another. A screen is made when it is first gone
    to or asked for, which ``made`` tells: a start would wait for all of them."""

    leaving = Signal(str)
    arrived = Signal(str)
    changed = Signal()
    made = Signal()

    def __init__(self, shell: Shell, is_asked: Callable[[], bool], is_recording: Callable[[], bool]) -> None:
        super().__init__(shell)
        self._shell, self._is_asked, self.is_recording = shell, is_asked, is_recording
        self.makers: dict[str, Callable[[], Flow]] = {}
        """All screens that there are, by their places."""
        self.flows: dict[str, Flow] = {}
        """Those that are made."""
        self._then: dict[str, list[Callable[[], object]]] = {}
        self._research = True
        self._place = "patients"
        self._before_aside = "patients"
        self._came: dict[str, str] = {}
        self._stays_aside = False

    @property
    def place(self) -> str:
        """Where the person is."""
        return self._place

    @property
    def behind(self) -> str:
        """Where the person is, or was before help or settings."""
        return self._before_aside if self._place in ASIDE else self._place

    @property
    def here(self) -> Flow:
        """The screen that is shown."""
        return self.flows[self._place]

    def put(self, flow: Flow) -> None:
        """Enter a screen into the table."""
        self.flows[flow.place] = flow

    def flow(self, place: str) -> Flow:
        """A screen, which is made where it is not yet."""
        if place not in self.flows:
            self.makers[place]().show_research(on=self._research)
            for then in self._then.pop(place, []):
                then()
            self.made.emit()
        return self.flows[place]

    def when_made(self, place: str, then: Callable[[], object]) -> None:
        """What is to be done once a screen is there; now where it is."""
        if place in self.flows:
            then()
        else:
            self._then.setdefault(place, []).append(then)

    def show_research(self, *, on: bool) -> None:
        """Show what only research needs, or fold it away, on every screen; no value changes by it."""
        self._research = on
        for flow in self.flows.values():
            flow.show_research(on=on)

    def show(self, place: str, *given: object) -> None:
        """Bring up a screen as it does it itself, with what it must be told."""
        self.flow(place).show(*given)

    def show_behind(self, place: str, *given: object) -> None:
        """As :meth:`show`; help and settings stay where they are open, and are left for that screen."""
        self._stays_aside = self._place in ASIDE
        try:
            self.show(place, *given)
        finally:
            self._stays_aside = False

    def go(self, place: str) -> None:
        """Change to a screen as it is; for its own flow."""
        if self._stays_aside:
            self._before_aside = place
            return
        old, new = self.flows.get(self._place), self.flow(place)
        if old is not None and place != self._place and not (old.while_aside and place in ASIDE):
            old.leave()
        if place != self._place and self._place not in ASIDE:
            self._came[place] = self._place
        self._place = place
        self.leaving.emit(place)
        self._shell.show_screen(new.screen, new.first())
        self.arrived.emit(place)

    def came_from(self, place: str) -> str:
        """From where a place was last gone to, help and settings aside."""
        return self._came.get(place, "patients")

    def may_aside(self) -> bool:
        """Whether help and settings can be opened now: not from each other, a recording, or a question."""
        return not (self._place in ASIDE or self.is_recording() or self._is_asked())

    def aside(self, place: str) -> None:
        """Help or settings, from which one comes back; not over a running recording."""
        if not self.may_aside():
            return
        self._before_aside = self._place
        self.go(place)

    def back(self) -> None:
        """One step back; what covers the screen goes first, and nothing leaves a message. Of a running recording the
        screen asks whether it shall stop."""
        if self._is_asked():
            return
        sheets = [sheet for sheet in self._shell.findChildren(Sheet) if sheet.isVisible()]
        if sheets:
            sheets[-1].leave()
        elif self._place in ASIDE:
            self.go(self._before_aside)
        else:
            self.flows[self._place].up()

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
from carpus.ui.kit.background import Background
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.theme import Theme
from carpus.ui.shell.camera_state import CameraAccess, CameraState
from carpus.ui.shell.current_selection import CurrentSelection
from carpus.ui.shell.main_window import MainWindow
from carpus.ui.shell.messages import Messages, show_files_written
from carpus.ui.shell.recent_locations import FolderKind, RecentLocations
from carpus.ui.shell.source_opener import SourceOpener

T = TypeVar("T")
SETUP_STEPS = ("exercise", "camera", "markers", "live")
"""The set-up, in order; the top bar counts them."""
PATIENT_TABS = ("sessions", "review", "progress", "report")
"""The views of an open patient, in the order of the tabs."""
OVERLAYS = ("help", "settings")
"""Places beside the way: from them one comes back to where one was."""


@dataclass(slots=True, eq=False)
class ScreenContext:
    """What the screens share. A screen makes itself what it alone needs."""

    window: MainWindow
    theme: Theme
    library: Library
    background: Background
    messages: Messages
    navigator: Navigator
    current: CurrentSelection
    opener: SourceOpener
    camera: CameraState
    cameras: CameraAccess
    recent_locations: RecentLocations
    report_settings: ReportSettings
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

    screen_name: str
    """Its name for the others: ``context.navigator.show("progress")``."""
    guide_page: str = "session"
    """The page of the guide that F1 opens on it."""
    parent_tab: str = ""
    """Where it lies under a tab of an open patient without being one: that tab's place."""
    runs_behind_overlay: bool = False
    """Whether it goes on behind help and settings."""
    screen: QWidget

    def __init__(self, context: ScreenContext, screen: QWidget) -> None:
        super().__init__(context.window)
        self.context, self.screen = context, screen
        context.navigator.register(self)

    def open(self, *_: Any, **__: Any) -> None:
        """Bring it up; a screen that shows something certain says here what it must be told."""
        self.context.navigator.switch_screen(self.screen_name)

    def title(self) -> str:
        """What the top bar says; who is open, where a screen is of nobody else."""
        return self.context.current.patient_name

    def initial_focus(self) -> QWidget:
        """What gets the keyboard: what the screen itself names, or all of it."""
        named: Callable[[], QWidget] | None = getattr(self.screen, "initial_focus", None)
        return named() if named is not None else self.screen

    def navigate_back(self) -> None:
        """One step back from here."""
        self.return_to_patients()

    def return_to_patients(self) -> None:
        """Back to the list, with who is open."""
        row = self.context.current.patient
        self.context.navigator.open_screen("patients", row.patient_id if row is not None else "")

    def return_to_session(self) -> None:
        """Back to the session that was looked at."""
        if self.context.current.session_id:
            self.context.navigator.open_screen("review", self.context.current.session_id)
        else:
            self.return_to_patients()

    def on_leave(self) -> None:
        """Another screen is shown: what must not go on ends."""

    def close(self) -> None:
        """The window closes: what runs ends, and is waited for."""

    def prompt_before_close(self) -> bool:
        """Ask the person where something would be lost or end with the window; False where nothing would."""
        return False

    def on_server_reconnected(self) -> None:
        """The clinic's server answers again: what could not be read before is read now."""

    @property
    def is_busy(self) -> bool:
        """Whether something is worked on here that would end with the window."""
        return False

    def banner_lines(self) -> list[str]:
        """What must not be forgotten of what is on the screen."""
        return []

    def show_research(self, *, on: bool) -> None:
        """Show what only research needs, or fold it away; no value changes by it."""

    def open_patient(self, patient_id: str) -> Patient:
        """From now on this patient is open."""
        now = self.context.current
        if now.patient is None or now.patient.patient_id != patient_id:
            now.patient = self.context.library.patients.get(patient_id)
        return now.patient

    def close_patient(self) -> None:
        """Whoever was open is not any more, and the camera is let go."""
        self.context.opener.close_source()
        self.context.current.clear()

    def run(
        self,
        work: Callable[[], T],
        on_done: Callable[[T], None] = lambda _: None,
        on_failed: Callable[[Exception], None] | None = None,
    ) -> None:
        """Work beside the window; its fault is told, unless ``on_failed`` does something else."""
        self.context.background.run(work, on_done, on_failed or self.context.messages.show_fault, self)

    def register_exports(self, paths: Sequence[Path | str], sessions: Sequence[str]) -> None:
        """Files were made from sessions: they are named on the day these are erased."""
        self.context.library.register_output_files([Path(path) for path in paths], "export", sessions)

    def announce_exports(self, paths: Sequence[Path], sessions: Sequence[str]) -> None:
        """The same, and said on a card."""
        self.register_exports(paths, sessions)
        show_files_written(self.context.messages, str(paths[0].parent), [path.name for path in paths])

    def choose_save_path(self, kind: FolderKind, name: str, title: str, kinds: str) -> Path | None:
        """A file to write, None when the person changed their mind."""
        return self.context.recent_locations.choose_save_path(self.context.window, kind, name, title, kinds)


class Navigator(QObject):
    """The table of places, and the way between them: ``screen_changing`` with the new place before it is shown,
    ``screen_changed``
    after. ``banner_changed``: what is said over the screen that is shown is another. A screen is made when it is
    first gone
    to or asked for, which ``screen_created`` tells: a start would wait for all of them."""

    screen_changing = Signal(str)
    screen_changed = Signal(str)
    banner_changed = Signal()
    screen_created = Signal()

    def __init__(self, shell: MainWindow, is_asked: Callable[[], bool], is_recording: Callable[[], bool]) -> None:
        super().__init__(shell)
        self._shell, self._is_question_open, self.is_recording = shell, is_asked, is_recording
        self.factories: dict[str, Callable[[], Flow]] = {}
        """All screens that there are, by their places."""
        self.flows: dict[str, Flow] = {}
        """Those that are made."""
        self._on_created: dict[str, list[Callable[[], object]]] = {}
        self._shows_research = True
        self._screen_name = "patients"
        self._under_overlay = "patients"
        self._previous_screens: dict[str, str] = {}
        self._keeps_overlay = False

    @property
    def screen_name(self) -> str:
        """Where the person is."""
        return self._screen_name

    @property
    def underlying_screen(self) -> str:
        """Where the person is, or was before help or settings."""
        return self._under_overlay if self._screen_name in OVERLAYS else self._screen_name

    @property
    def current_flow(self) -> Flow:
        """The screen that is shown."""
        return self.flows[self._screen_name]

    def register(self, flow: Flow) -> None:
        """Enter a screen into the table."""
        self.flows[flow.screen_name] = flow

    def flow(self, screen_name: str) -> Flow:
        """A screen, which is made where it is not yet."""
        if screen_name not in self.flows:
            self.factories[screen_name]().show_research(on=self._shows_research)
            for then in self._on_created.pop(screen_name, []):
                then()
            self.screen_created.emit()
        return self.flows[screen_name]

    def run_when_created(self, screen_name: str, callback: Callable[[], object]) -> None:
        """What is to be done once a screen is there; now where it is."""
        if screen_name in self.flows:
            callback()
        else:
            self._on_created.setdefault(screen_name, []).append(callback)

    def show_research(self, *, on: bool) -> None:
        """Show what only research needs, or fold it away, on every screen; no value changes by it."""
        self._shows_research = on
        for flow in self.flows.values():
            flow.show_research(on=on)

    def open_screen(self, screen_name: str, *given: object) -> None:
        """Bring up a screen as it does it itself, with what it must be told."""
        self.flow(screen_name).open(*given)

    def open_under_overlay(self, screen_name: str, *given: object) -> None:
        """As :meth:`show`; help and settings stay where they are open, and are left for that screen."""
        self._keeps_overlay = self._screen_name in OVERLAYS
        try:
            self.open_screen(screen_name, *given)
        finally:
            self._keeps_overlay = False

    def switch_screen(self, screen_name: str) -> None:
        """Change to a screen as it is; for its own flow."""
        if self._keeps_overlay:
            self._under_overlay = screen_name
            return
        old, new = self.flows.get(self._screen_name), self.flow(screen_name)
        if (
            old is not None
            and screen_name != self._screen_name
            and not (old.runs_behind_overlay and screen_name in OVERLAYS)
        ):
            old.on_leave()
        if screen_name != self._screen_name and self._screen_name not in OVERLAYS:
            self._previous_screens[screen_name] = self._screen_name
        self._screen_name = screen_name
        self.screen_changing.emit(screen_name)
        self._shell.show_screen(new.screen, new.initial_focus())
        self.screen_changed.emit(screen_name)

    def previous_screen(self, screen_name: str) -> str:
        """From where a place was last gone to, help and settings aside."""
        return self._previous_screens.get(screen_name, "patients")

    def can_open_overlay(self) -> bool:
        """Whether help and settings can be opened now: not from each other, a recording, or a question."""
        return not (self._screen_name in OVERLAYS or self.is_recording() or self._is_question_open())

    def open_overlay(self, screen_name: str) -> None:
        """Help or settings, from which one comes back; not over a running recording."""
        if not self.can_open_overlay():
            return
        self._under_overlay = self._screen_name
        self.switch_screen(screen_name)

    def navigate_back(self) -> None:
        """One step back; what covers the screen goes first, and nothing leaves a message. Of a running recording the
        screen asks whether it shall stop."""
        if self._is_question_open():
            return
        sheets = [sheet for sheet in self._shell.findChildren(Dialog) if sheet.isVisible()]
        if sheets:
            sheets[-1].dismiss()
        elif self._screen_name in OVERLAYS:
            self.switch_screen(self._under_overlay)
        else:
            self.flows[self._screen_name].navigate_back()

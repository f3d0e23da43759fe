"""Base class of screen controllers (:class:`Flow`), their shared context, and the navigation between screens."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any, TypeVar

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from carpus.core.records.data_folder import DataFolder
from carpus.core.records.values import Patient
from carpus.core.results.report_form import ReportSettings
from carpus.ui.kit.background import Background
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.theme import Theme
from carpus.ui.shell.camera_state import CameraAccess, CameraState
from carpus.ui.shell.current_selection import CurrentSelection, NameDisplay
from carpus.ui.shell.main_window import MainWindow
from carpus.ui.shell.messages import Messages, show_files_written
from carpus.ui.shell.recent_locations import FolderKind, RecentLocations
from carpus.ui.shell.source_opener import SourceOpener

T = TypeVar("T")
SETUP_STEPS = ("exercise", "camera", "markers", "live")
"""Steps of the set-up, in the order of the top bar."""
PATIENT_TABS = ("sessions", "review", "progress", "report")
"""Tabs of an open patient, in order."""
OVERLAYS = ("help", "settings")
"""Screens from which the user returns to where he was."""


@dataclass(slots=True, eq=False)
class ScreenContext:
    """What all screens share."""

    window: MainWindow
    theme: Theme
    library: DataFolder
    background: Background
    messages: Messages
    navigator: Navigator
    current: CurrentSelection
    names: NameDisplay
    opener: SourceOpener
    camera: CameraState
    cameras: CameraAccess
    recent_locations: RecentLocations
    report_settings: ReportSettings
    """As chosen now."""
    today: Callable[[], date]
    """Returns the current day: the program may stay open for days."""
    is_demo: bool = False
    patient_sound: bool = False
    """Whether the patient's view beeps at the goal."""
    keep_pictures: bool = False
    """Whether video is saved by default, which takes ``mb_per_minute``."""
    mb_per_minute: float = math.nan

    def run(
        self,
        owner: QObject,
        work: Callable[[], T],
        on_done: Callable[[T], None] = lambda _: None,
        on_failed: Callable[[Exception], None] | None = None,
    ) -> None:
        """Run ``work`` in the background while ``owner`` exists; show its fault unless ``on_failed`` is given."""
        self.background.run(work, on_done, on_failed or self.messages.show_fault, owner)


class Flow(QObject):
    """Controller of one screen; registers itself with the navigator."""

    screen_name: str
    """Name for navigation: ``context.navigator.open_screen("progress")``."""
    guide_page: str = "session"
    """Page of the guide that F1 opens."""
    parent_tab: str = ""
    """Tab under which a screen lies that is none itself."""
    runs_behind_overlay: bool = False
    """Whether it keeps running behind help and settings."""
    screen: QWidget

    def __init__(self, context: ScreenContext, screen: QWidget) -> None:
        super().__init__(context.window)
        self.context, self.screen = context, screen
        context.navigator.register(self)

    def open(self, *_: Any, **__: Any) -> None:
        """Show the screen; subclasses take what to show on it."""
        self.context.navigator.switch_screen(self.screen_name)

    def title(self) -> str:
        """Return the title for the top bar, by default the patient's names."""
        return self.context.names.title(self.context.current.patient)

    def initial_focus(self) -> QWidget:
        """Return the widget that gets the focus: the screen's choice, else the screen."""
        named: Callable[[], QWidget] | None = getattr(self.screen, "initial_focus", None)
        return named() if named is not None else self.screen

    def navigate_back(self) -> None:
        """Go one step back from this screen."""
        self.return_to_patients()

    def return_to_patients(self) -> None:
        """Go back to the patient list with the open patient selected."""
        row = self.context.current.patient
        self.context.navigator.open_screen("patients", row.patient_id if row is not None else "")

    def return_to_session(self) -> None:
        """Go back to the review of the session viewed last."""
        if self.context.current.session_id:
            self.context.navigator.open_screen("review", self.context.current.session_id)
        else:
            self.return_to_patients()

    def on_leave(self) -> None:
        """Stop what must not continue while another screen is shown."""

    def close(self) -> None:
        """Stop and wait for what is running, as the window closes."""

    def prompt_before_close(self) -> bool:
        """Ask the user if closing would lose something; return whether he was asked."""
        return False

    def on_server_reconnected(self) -> None:
        """Read what could not be read while the clinic's server was away."""

    @property
    def is_busy(self) -> bool:
        """Whether work is running that closing the window would end."""
        return False

    def banner_lines(self) -> list[str]:
        """Return the warnings for the banner above the screen."""
        return []

    def show_research(self, *, on: bool) -> None:
        """Show or hide what only research needs; values do not change."""

    def open_patient(self, patient_id: str) -> Patient:
        """Make this patient the open one."""
        now = self.context.current
        if now.patient is None or now.patient.patient_id != patient_id:
            now.patient = self.context.library.patients.get(patient_id)
        return now.patient

    def close_patient(self) -> None:
        """Close patient and camera."""
        self.context.opener.close_source()
        self.context.current.clear()

    def run(
        self,
        work: Callable[[], T],
        on_done: Callable[[T], None] = lambda _: None,
        on_failed: Callable[[Exception], None] | None = None,
    ) -> None:
        """Run ``work`` in the background; show its fault unless ``on_failed`` is given."""
        self.context.run(self, work, on_done, on_failed)

    def register_exports(self, paths: Sequence[Path | str], sessions: Sequence[str]) -> None:
        """Note files made from sessions, so that they are listed when these are deleted."""
        self.context.library.register_output_files([Path(path) for path in paths], "export", sessions)

    def announce_exports(self, paths: Sequence[Path], sessions: Sequence[str]) -> None:
        """Register exported files and show a message."""
        self.register_exports(paths, sessions)
        show_files_written(self.context.messages, str(paths[0].parent), [path.name for path in paths])

    def choose_save_path(self, kind: FolderKind, name: str, title: str, kinds: str) -> Path | None:
        """Ask for a file to write; None if cancelled."""
        return self.context.recent_locations.choose_save_path(self.context.window, kind, name, title, kinds)


class Navigator(QObject):
    """Navigation between screens, which are created at first use.

    Signals: ``screen_changing`` with the next screen's name, ``screen_changed`` after it, ``banner_changed`` when the
    banner must be updated, ``screen_created``.
    """

    screen_changing = Signal(str)
    screen_changed = Signal(str)
    banner_changed = Signal()
    screen_created = Signal()

    def __init__(self, shell: MainWindow, is_asked: Callable[[], bool], is_recording: Callable[[], bool]) -> None:
        super().__init__(shell)
        self._shell, self._is_question_open, self.is_recording = shell, is_asked, is_recording
        self.factories: dict[str, Callable[[], Flow]] = {}
        """Factories of all flows, by screen name."""
        self.flows: dict[str, Flow] = {}
        """Flows that exist."""
        self._on_created: dict[str, list[Callable[[], object]]] = {}
        self._shows_research = True
        self._screen_name = "patients"
        self._under_overlay = "patients"
        self._previous_screens: dict[str, str] = {}
        self._keeps_overlay = False

    @property
    def screen_name(self) -> str:
        """Name of the screen that is shown."""
        return self._screen_name

    @property
    def underlying_screen(self) -> str:
        """Name of the screen that is shown, or lies behind help or settings."""
        return self._under_overlay if self._screen_name in OVERLAYS else self._screen_name

    @property
    def current_flow(self) -> Flow:
        """Flow of the screen that is shown."""
        return self.flows[self._screen_name]

    def register(self, flow: Flow) -> None:
        """Add a flow."""
        self.flows[flow.screen_name] = flow

    def flow(self, screen_name: str) -> Flow:
        """Return the flow of a screen, created if need be."""
        if screen_name not in self.flows:
            self.factories[screen_name]().show_research(on=self._shows_research)
            for then in self._on_created.pop(screen_name, []):
                then()
            self.screen_created.emit()
        return self.flows[screen_name]

    def run_when_created(self, screen_name: str, callback: Callable[[], object]) -> None:
        """Call ``callback`` once the screen exists, now if it does."""
        if screen_name in self.flows:
            callback()
        else:
            self._on_created.setdefault(screen_name, []).append(callback)

    def show_research(self, *, on: bool) -> None:
        """Show or hide what only research needs, on every screen."""
        self._shows_research = on
        for flow in self.flows.values():
            flow.show_research(on=on)

    def open_screen(self, screen_name: str, *given: object) -> None:
        """Open a screen by its own flow, with what it is to show."""
        self.flow(screen_name).open(*given)

    def open_under_overlay(self, screen_name: str, *given: object) -> None:
        """Open a screen like :meth:`open_screen`, but leave help or settings in front of it."""
        self._keeps_overlay = self._screen_name in OVERLAYS
        try:
            self.open_screen(screen_name, *given)
        finally:
            self._keeps_overlay = False

    def switch_screen(self, screen_name: str) -> None:
        """Show a screen as it is; called by its own flow."""
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
        """Return the screen from which this one was opened last, other than help and settings."""
        return self._previous_screens.get(screen_name, "patients")

    def can_open_overlay(self) -> bool:
        """Return whether help and settings can open: not during a recording or a question."""
        return not (self._screen_name in OVERLAYS or self.is_recording() or self._is_question_open())

    def open_overlay(self, screen_name: str) -> None:
        """Open help or settings, unless a recording is running."""
        if not self.can_open_overlay():
            return
        self._under_overlay = self._screen_name
        self.switch_screen(screen_name)

    def navigate_back(self) -> None:
        """Close the topmost dialog, leave help or settings, or go back one screen.

        During a recording the screen asks whether to stop. A question stays open.
        """
        if self._is_question_open():
            return
        sheets = [sheet for sheet in self._shell.findChildren(Dialog) if sheet.isVisible()]
        if sheets:
            sheets[-1].dismiss()
        elif self._screen_name in OVERLAYS:
            self.switch_screen(self._under_overlay)
        else:
            self.flows[self._screen_name].navigate_back()

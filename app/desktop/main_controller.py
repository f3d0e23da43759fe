"""Connects the screens: top bar, keys, shared services, and the end of the program.

Each screen has a flow of its own (:mod:`ui.shell.flow`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import date, datetime
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal

from carpus.app.desktop.maintenance_cameras import MaintenanceCameras
from carpus.app.desktop.screens import PLACES, Screens, load_flow_class
from carpus.app.desktop.top_bar import TopBarController
from carpus.app.settings import Settings
from carpus.core.capture.files.raw import MB_PER_MINUTE
from carpus.core.model.errors import CarpusFault, ServerUnavailable
from carpus.core.records.corrections import Corrections
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.new_sessions import RecoveredSession, recover_sessions
from carpus.core.records.values import Patient
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.shell.camera_state import CameraState
from carpus.ui.shell.current_selection import CurrentSelection, NameDisplay, SourceChoice
from carpus.ui.shell.flow import PATIENT_TABS, SETUP_STEPS, Flow, Navigator, ScreenContext
from carpus.ui.shell.main_window import MainWindow
from carpus.ui.shell.messages import Messages
from carpus.ui.shell.recent_locations import RecentLocations
from carpus.ui.shell.source_opener import OpenSourceFunction, SourceOpener

CHECK_EVERY_MS = 4_000

CatchUp = tuple[Sequence[RecoveredSession], Sequence[CarpusFault]]


class ServerMonitor(QObject):
    """Emits ``server_lost``, and ``server_restored`` with the result of :func:`recover_sessions`."""

    server_lost = Signal()
    server_restored = Signal(object)

    def __init__(self, library: DataFolder, parent: QObject) -> None:
        super().__init__(parent)
        self._library, self._background = library, Background()
        self._was_away = library.store.is_server_away
        self._clock = QTimer(self, interval=CHECK_EVERY_MS)
        self._clock.timeout.connect(self._check)
        if library.store.server is not None:
            self._clock.start()

    def stop(self) -> None:
        self._clock.stop()
        self._background.join()

    def _check(self) -> None:
        if not self._background.is_busy:
            self._background.run(
                lambda: _check_server(self._library, self._was_away), self._handle_catch_up, self._handle_fault, self
            )

    def _handle_catch_up(self, caught: CatchUp | None) -> None:
        if caught is not None:
            self._was_away = False
            self.server_restored.emit(caught)

    def _handle_fault(self, fault: Exception) -> None:
        if isinstance(fault, ServerUnavailable) and not self._was_away:
            self._was_away = True
            self.server_lost.emit()


def _check_server(library: DataFolder, was_away: bool) -> CatchUp | None:
    """Return what was recovered after an outage, None otherwise. Raises :class:`ServerUnavailable`."""
    assert library.store.server is not None
    library.store.server.ping()
    if not was_away:
        return None
    caught = recover_sessions(library)
    if library.store.is_server_away:  # once more
        raise next(fault for fault in caught[1] if isinstance(fault, ServerUnavailable))
    return caught


ALL_KEYS = ("help", "settings", "search", "new_patient", "back", "quit")


class MainController(Screens):
    """Owner of the screens' flows and of what they share."""

    def __init__(
        self,
        shell: MainWindow,
        theme: Theme,
        library: DataFolder,
        open_source: OpenSourceFunction,
        cameras: MaintenanceCameras,
        settings: Settings,
        today: Callable[[], date],
        *,
        is_demo: bool,
    ) -> None:
        """``today`` is called each time: the program may stay open for days."""
        super().__init__(shell)
        self._shell, self._library = shell, library
        self.handle_escape: Callable[[], bool] = lambda: False
        """Called first for Esc; returns True if it closed something, and the screen stays."""
        self.settings, self.is_demo = settings, is_demo
        self.current = CurrentSelection(source_choice=SourceChoice("practice" if is_demo else "camera"))
        self.background = Background()
        self.messages = messages = Messages(shell.screen_stack, theme)
        self.opener = SourceOpener(open_source, self.current, self.background, messages.show_fault, self)
        self.camera_state = CameraState(
            cameras, self.background, lambda: datetime.now().astimezone(), self, is_demo=is_demo
        )
        self.navigator = Navigator(
            shell, lambda: messages.is_busy, lambda: "live" in self.navigator.flows and self.live.is_recording
        )
        self.context = ScreenContext(
            shell,
            theme,
            library,
            self.background,
            messages,
            self.navigator,
            self.current,
            NameDisplay(self),
            self.opener,
            self.camera_state,
            cameras,
            RecentLocations(library.folder),
            settings.report,
            today,
            is_demo,
            settings.patient.sound,
            settings.recording.keep_pictures,
            MB_PER_MINUTE,
        )
        for place in PLACES:
            self.navigator.factories[place] = partial(self._create_flow, place)
        self.top_bar = TopBarController(self.context, lambda: self.review.screen)
        self._connect()
        self.camera_state.start()
        self._check_new_results()
        self.server_monitor = ServerMonitor(library, self)
        self.server_monitor.server_lost.connect(self._on_server_lost)
        self.server_monitor.server_restored.connect(self._on_server_restored)

    def _on_server_lost(self) -> None:
        self.top_bar.refresh()
        if self.place == "patients":
            self.patients.screen.refresh()

    def _on_server_restored(self) -> None:
        """Look up the open patient again, and let every screen read what it could not."""
        now, patients = self.current, self._library.patients
        row = now.patient
        if row is not None and row.patient_id and not patients.has(row.patient_id):
            known = patients.id_of_pseudonym(row.pseudonym)
            now.patient = patients.get(known) if known else row
            if now.set_up is not None:
                now.set_up = replace(now.set_up, patient_id=now.patient.patient_id)
        for flow in self.navigator.flows.values():
            flow.on_server_reconnected()
        self.top_bar.refresh()

    def _create_flow(self, place: str) -> Flow:
        return load_flow_class(place)(self.context)

    def _connect(self) -> None:
        shell, bar, navigator = self._shell, self._shell.top_bar, self.navigator
        shell.bind_keys(ALL_KEYS)
        shell.key_pressed.connect(self._handle_key)
        shell.prompt_before_close = lambda: any(flow.prompt_before_close() for flow in navigator.flows.values())
        bar.back_button.clicked.connect(navigator.navigate_back)
        bar.tab_selected.connect(self.open_tab)
        bar.step_selected.connect(lambda number: self._open_step(SETUP_STEPS[number]))
        bar.help_button.clicked.connect(lambda: navigator.open_screen("help"))
        bar.settings_button.clicked.connect(lambda: navigator.open_screen("settings"))
        bar.reanalysis_button.clicked.connect(lambda: self.correct.open_dialog(self.current.session_id))
        navigator.run_when_created("live", self._connect_live)
        navigator.run_when_created(
            "comparison", lambda: self.comparison.screen.sessions_shown.connect(navigator.banner_changed)
        )
        navigator.run_when_created("review", self._connect_review)
        navigator.run_when_created(
            "correct", lambda: self.correct.progress_changed.connect(self.top_bar.show_reanalysis)
        )
        navigator.run_when_created(
            "sessions", lambda: self.sessions.screen.sessions_changed.connect(self._check_new_results)
        )

    def _connect_live(self) -> None:
        self.live.screen.recording_changed.connect(self.top_bar.show_recording)
        self.live.screen.counters_changed.connect(self.top_bar.show_counters)

    def _connect_review(self) -> None:
        self.review.screen.session_shown.connect(self.navigator.banner_changed)

    def _check_new_results(self) -> None:
        """Show results of re-analysis that wait for a decision, also from an earlier start."""
        if "correct" in self.navigator.flows or Corrections(self._library).has_pending:
            self.correct.refresh_pending()

    @property
    def place(self) -> str:
        return self.navigator.screen_name

    # --- from one to the other ----------------------------------------------------------------------------
    def open_tab(self, number: int) -> None:
        place, patient = PATIENT_TABS[number], self.current.patient
        if patient is None or place == self.place or self.messages.is_busy:
            self.top_bar.refresh()
        elif place in ("sessions", "progress"):
            self.navigator.open_screen(place, patient.patient_id)
        elif self.current.session_id:
            self.navigator.open_screen(place, self.current.session_id)
        else:
            self.review.open("", patient.patient_id)

    def _open_step(self, place: str) -> None:
        if self.messages.is_busy:
            return
        if place == "exercise" and self.current.patient is not None:
            self.exercise.open(self.current.patient.patient_id)
        elif place == "camera":
            (self.markers.navigate_back if self.place == "markers" else self.camera.open)()

    def review_file(self, path: Path) -> None:
        """Open a session file from outside, unless something is measured or asked."""
        if self.messages.is_busy or self.navigator.is_recording() or self.current.source is not None:
            return
        try:
            header = self._library.open_file(path)
            owner_id = self._library.owner_id(header.session_id)
        except CarpusFault as fault:
            self.messages.show_fault(fault)
            return
        if not owner_id:  # of nobody here: shown under the name in its file
            self.current.patient = Patient(header.subject_id.strip() or "?", header.hand)
        self.review.open(header.session_id, owner_id)

    def _handle_key(self, name: str) -> None:
        actions: dict[str, Callable[[], object]] = {
            "back": self._on_escape,
            "help": lambda: self.navigator.open_screen("help"),
            "settings": lambda: self.navigator.open_screen("settings"),
            "quit": self._shell.close,
        }
        if name in actions:
            actions[name]()

    def _on_escape(self) -> None:
        taken = not self.messages.is_busy and (
            ("live" in self.navigator.flows and self.live.patient_view.close_if_covering())
            or self.handle_escape()
            or (self.place == "report" and self.report.screen.show_parent_report())
        )
        if not taken:
            self.navigator.navigate_back()

    @property
    def is_at_work(self) -> bool:
        """True while something is measured or runs that would end with the window."""
        measures = self.current.source is not None and self.navigator.underlying_screen in SETUP_STEPS
        works = any(flow.is_busy for flow in self.navigator.flows.values())
        return measures or works or self.background.is_busy

    def close(self) -> None:
        """End everything in order, and wait for it."""
        self.server_monitor.stop()
        self.camera_state.stop()
        for flow in self.navigator.flows.values():
            flow.close()
        self.opener.shut_down()
        self.background.join()
        if self.current.source is not None:
            self.live.finish()


class AccessLogger(QObject):
    """Logs openings when a screen is shown."""

    log_failed = Signal(object)
    """Emitted from any thread when the log cannot be written."""

    def __init__(self, controller: MainController, library: DataFolder) -> None:
        super().__init__(controller)
        self._controller, self._library = controller, library
        self._last_access = ("", "")
        self.log_failed.connect(controller.messages.show_fault)
        library.on_fault = self.log_failed.emit
        controller.navigator.screen_changed.connect(self._log_access)

    def _log_access(self, place: str) -> None:
        patient, session_ids = self._controller.current.patient, [self._controller.current.session_id]
        if place in ("review", "comparison"):
            if place == "comparison":
                session_ids = sorted(self._controller.comparison.screen.session_ids)
            if self._is_new_access(place, " ".join(session_ids)):
                for session_id in session_ids:
                    self._library.audit_log.log_session("opened", session_id)
        elif place == "progress" and patient is not None and self._is_new_access(place, patient.patient_id):
            self._library.audit_log.log_patient("opened", patient.patient_id)
        elif place == "patients":
            self._last_access = ("", "")

    def _is_new_access(self, place: str, identity: str) -> bool:
        """Return False on return from help or settings."""
        before, self._last_access = self._last_access, (place, identity)
        return before != self._last_access

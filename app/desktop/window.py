"""The assembled application: start, second instance, change of language, end."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from PySide6.QtCore import QMetaObject, QObject, Qt, QTimer
from PySide6.QtWidgets import QApplication

from carpus.app.command_line import handle_stop_signals
from carpus.app.desktop.first_start import TourController, WelcomeController
from carpus.app.desktop.main_controller import MainController
from carpus.app.desktop.practice_system import PracticeSystemController
from carpus.app.desktop.preferences import PreferencesController
from carpus.app.desktop.screens import load_core, load_screens
from carpus.core.records.data_folder import DataFolder
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.screens.records.backup import BackupController
from carpus.ui.screens.records.deletion import DeletionController
from carpus.ui.screens.records.lock import LockController
from carpus.ui.screens.records.record_lists import RecordListsController
from carpus.ui.shell.main_window import MainWindow
from carpus.ui.shell.recent_locations import RecentLocations, encode_geometry, restore_window

COLLECT_INTERVAL_MS = 100


class GarbageCollector(QObject):
    """Timer that replaces Python's collector, which runs in whichever thread has just allocated."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
        self._timer = QTimer(self, interval=COLLECT_INTERVAL_MS)
        self._timer.timeout.connect(self._collect_due)
        self._timer.start()

    def _collect_due(self) -> None:
        """Collect the oldest generation that is due, as Python's own collector would."""
        for generation in (2, 1, 0):
            if gc.get_count()[generation] > gc.get_threshold()[generation]:
                gc.collect(generation)
                return


PRELOAD_DELAY_MS = 200
"""Preloading starts after the first paint."""


def start_garbage_collection(application: QApplication) -> None:
    """Start collecting garbage; all objects of the start are exempt, to save time per frame."""
    gc.collect()
    gc.freeze()
    if application.findChild(GarbageCollector) is None:  # another language opens the window again
        GarbageCollector(application)


@dataclass(eq=False)
class DataProtection:
    """Dialogs for backup, lock, records and erasure."""

    erasing: DeletionController
    lists: RecordListsController
    backing_up: BackupController
    locking: LockController


@dataclass(eq=False)
class Desktop:
    """The assembled application; :meth:`close` ends all its threads."""

    application: QApplication
    shell: MainWindow
    theme: Theme
    controller: MainController
    library: DataFolder
    data_protection: DataProtection
    welcome: WelcomeController
    tour: TourController
    preferences: PreferencesController
    practice_system: PracticeSystemController
    system_connections: tuple[QMetaObject.Connection, ...] = ()
    """Signals of the system, disconnected at the end."""
    must_reopen: bool = False
    """True if a new window with the present settings must be opened after this one."""
    is_closed: bool = False
    _preloading: Background = field(default_factory=Background)

    def show(self, *, is_reopened: bool = False, patient_id: str = "") -> None:
        """Show the first screen with a patient selected; after a change of language the settings, without the PIN."""
        # The newest session is on top, but for simulated ones, which count nowhere.
        demo_patient = self.library.session_list.last_patient_id() if self.controller.is_demo else ""
        self.controller.patients.open(patient_id or demo_patient)
        restore_window(self.shell, RecentLocations(self.library.folder).load("window"))
        self.shell.create()  # what hides the names must be there before anything is seen
        if is_reopened:
            self.data_protection.locking.refresh()
        else:
            self.data_protection.locking.lock_at_start()
        self.shell.show()
        self.welcome.show_if_first_start()
        if is_reopened:
            self.controller.navigator.open_screen("settings")
        QTimer.singleShot(PRELOAD_DELAY_MS, self._preload)
        self.controller.navigator.screen_created.connect(
            lambda: QTimer.singleShot(PRELOAD_DELAY_MS, lambda: start_garbage_collection(self.application))
        )

    def _preload(self) -> None:
        """Import what the other screens need while the window is idle."""

        def work() -> None:
            for _ in load_core():
                if self.is_closed:
                    break

        self._preloading.run(work, lambda _: self._preload_next(load_screens()), self.controller.messages.show_fault)

    def _preload_next(self, loaded: Iterator[str]) -> None:
        """Import the next module when the window is idle again."""
        if self.is_closed:
            return
        if next(loaded, ""):
            QTimer.singleShot(0, lambda: self._preload_next(loaded))
        else:
            start_garbage_collection(self.application)

    def reopen(self) -> None:
        """Close the window for a new one in another language."""
        self.must_reopen = True
        self.shell.close_without_prompt()

    def find_language_obstacle(self) -> str:
        """Return why the language cannot be changed now, empty if it can."""
        controller, safe = self.controller, self.data_protection
        busy = controller.is_at_work or safe.backing_up.is_busy or self.tour.is_on or controller.messages.is_busy
        return tr("The language can be changed once no measurement or analysis is running.") if busy else ""

    def on_second_instance(self, file: Path | None) -> None:
        """Come to the front and open the file of a second instance."""
        self.shell.setWindowState(self.shell.windowState() & ~Qt.WindowState.WindowMinimized)
        self.shell.raise_()
        self.shell.activateWindow()
        if file is not None:
            self.open_file(file)

    def open_file(self, path: Path) -> None:
        """Show a session file, or the patient of a GDT file, after unlocking if the window is locked."""
        show = (
            self.controller.review_file if path.suffix.lower() in (".h5", ".hdf5") else self.practice_system.open_file
        )
        locking = self.data_protection.locking
        if locking.is_locked:
            once = Qt.ConnectionType.SingleShotConnection
            locking.lock_screen.closed.connect(lambda: show(path), once)
        else:
            show(path)

    def close(self) -> None:
        """End everything; may be called twice."""
        if not self.is_closed:
            self.is_closed = True
            for connection in self.system_connections:
                QObject.disconnect(connection)
            self._preloading.join()
            self.tour.stop()
            self.welcome.stop()
            self.practice_system.stop()
            self.data_protection.locking.shut_down()
            self.data_protection.backing_up.shut_down()
            RecentLocations(self.library.folder).save("window", encode_geometry(self.shell))
            self.controller.close()
            self.shell.hide()
            self.library.close()


def close_on_signals(desktop: Desktop) -> None:
    """Close the window on Ctrl+C, the end of the terminal, log-out or shutdown; recordings are finished.

    Python handles a signal when it next runs, at the latest at the next check for a camera.
    """
    handle_stop_signals(lambda: desktop.shell.close_without_prompt())

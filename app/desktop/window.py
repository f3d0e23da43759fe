"""The application put together: what it shows first, how it is called to the front, and how all of it ends."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from PySide6.QtCore import QMetaObject, QObject, Qt, QTimer
from PySide6.QtWidgets import QApplication

from carpus.app.command_line import on_stop
from carpus.app.desktop.journey import Journey
from carpus.app.desktop.preferences import PreferenceKeeper
from carpus.app.desktop.screens import load_core, load_screens
from carpus.app.desktop.welcoming import Tour, Welcome
from carpus.core.records.library import Library
from carpus.ui.background import Background
from carpus.ui.collector import Collector
from carpus.ui.last_places import LastPlaces, place_of, put_in_place
from carpus.ui.records.backing_up import BackingUp
from carpus.ui.records.erasing import Erasing
from carpus.ui.records.lists import RecordLists
from carpus.ui.records.locking import Locking
from carpus.ui.shell import Shell
from carpus.ui.theme import Theme
from carpus.ui.translate import tr

SETTLED_MS = 200
"""After the first picture, which need not wait for it."""


def settle(application: QApplication) -> None:
    """Begin to collect garbage; all that was built by now stays, and is not looked through again while frames come."""
    gc.collect()
    gc.freeze()
    if application.findChild(Collector) is None:  # another language opens the window again
        Collector(application)


@dataclass(eq=False)
class Safe:
    """What keeps, hides and erases."""

    erasing: Erasing
    lists: RecordLists
    backing_up: BackingUp
    locking: Locking


@dataclass(eq=False)
class Desktop:
    """The application put together; :meth:`close` ends every thread of it."""

    application: QApplication
    shell: Shell
    theme: Theme
    journey: Journey
    library: Library
    safe: Safe
    welcome: Welcome
    tour: Tour
    keeper: PreferenceKeeper
    from_system: tuple[QMetaObject.Connection, ...] = ()
    """What the system tells, until this is closed."""
    is_to_reopen: bool = False
    """Whether another window, with the settings as they are now, is to be opened once this one is closed."""
    _closed: bool = False
    _loading: Background = field(default_factory=Background)

    def show(self, *, is_reopened: bool = False) -> None:
        """Bring up the first screen and tell of what was recovered; once reopened, the settings, from where that came,
        without the PIN that was typed before."""
        # The newest session is on top, but for simulated ones, which count nowhere.
        self.journey.patients.show(self.library.index.last_owner() if self.journey.is_demo else "")
        put_in_place(self.shell, LastPlaces(self.library.folder).window())
        self.shell.create()  # what hides the names must be there before anything is seen
        if is_reopened:
            self.safe.locking.look_again()
        else:
            self.safe.locking.lock_at_start()
        self.shell.show()
        self.welcome.begin()
        if is_reopened:
            self.journey.way.show("settings")
        QTimer.singleShot(SETTLED_MS, self._load)
        self.journey.way.made.connect(lambda: QTimer.singleShot(SETTLED_MS, lambda: settle(self.application)))

    def _load(self) -> None:
        """While the window waits for the person: what the other screens are made of, as far as it may be in a thread of
        its own."""

        def work() -> None:
            for _ in load_core():
                if self._closed:
                    break

        self._loading.run(work, lambda _: self._load_on(load_screens()), self.journey.messages.fault)

    def _load_on(self, loaded: Iterator[str]) -> None:
        """The next module, when the window has done what came meanwhile."""
        if self._closed:
            return
        if next(loaded, ""):
            QTimer.singleShot(0, lambda: self._load_on(loaded))
        else:
            settle(self.application)

    def reopen(self) -> None:
        """The language was changed: this window closes, and who opened it opens another one."""
        self.is_to_reopen = True
        self.shell.close_surely()

    def why_no_other_language(self) -> str:
        """One sentence where the window cannot be put together again now, else nothing."""
        journey, safe = self.journey, self.safe
        busy = journey.is_at_work or safe.backing_up.is_at_work or self.tour.is_on or journey.messages.busy
        return tr("The language can be changed when nothing is measured or worked on any more.") if busy else ""

    def come_to_front(self) -> None:
        """Another start on the same data folder: this window is what was wanted."""
        self.shell.setWindowState(self.shell.windowState() & ~Qt.WindowState.WindowMinimized)
        self.shell.raise_()
        self.shell.activateWindow()

    def called(self, session: Path | None) -> None:
        """Another start on the same data folder, with the session file that it was to open."""
        self.come_to_front()
        if session is not None:
            self.open_session(session)

    def open_session(self, session: Path) -> None:
        """Show a session by its file; where the window is locked, once somebody has opened it."""
        locking = self.safe.locking
        if locking.locked:
            once = Qt.ConnectionType.SingleShotConnection
            locking.sheet.closed.connect(lambda: self.journey.review_file(session), once)
        else:
            self.journey.review_file(session)

    @property
    def closed(self) -> bool:
        """Whether everything was let go of."""
        return self._closed

    def close(self) -> None:
        """Finish what runs and let go of everything; may be called twice."""
        if not self._closed:
            self._closed = True
            for connection in self.from_system:
                QObject.disconnect(connection)
            self._loading.wait()
            self.tour.end()
            self.welcome.end()
            self.safe.locking.end()
            self.safe.backing_up.end()
            LastPlaces(self.library.folder).keep_window(place_of(self.shell))
            self.journey.close()
            self.shell.hide()
            self.library.close()


def end_on_signals(desktop: Desktop) -> None:
    """Ctrl+C in the terminal, its closing, a log-out or a shutdown close the window as a person would.

    Recordings are finished. Python hears of a signal when it next runs, at the latest when the journey looks for a
    camera.
    """
    on_stop(lambda: desktop.shell.close_surely())

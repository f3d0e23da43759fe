"""The one composition root: settings to concrete objects to a window."""

from __future__ import annotations

import contextlib
import gc
import logging
import os
import signal
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import date
from logging.handlers import RotatingFileHandler
from pathlib import Path
from types import TracebackType

import platformdirs
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from app import __version__
from app.desktop.journey import Journey, Parts
from app.desktop.library import Library
from app.desktop.no_folder import NoFolder
from app.desktop.patients import PatientShelf
from app.desktop.phrases import WordTable
from app.desktop.practice import practice_take
from app.desktop.preferences import PreferenceKeeper
from app.desktop.sources import Sources
from app.settings import DATA_VARIABLE, Settings, keep_preferences
from core.capture.source import FrameSource
from core.errors import CarpusFault
from ui.fonts import load_fonts
from ui.keys import Keys
from ui.ports import SetUp, Words
from ui.shell import Shell
from ui.style import apply_style
from ui.theme import Theme, ThemeName

Take = Callable[[SetUp, Callable[[int, int], None]], tuple[FrameSource, float]]
SWITCH_S = 0.001
LOG_FILE, LOG_BYTES = "carpus.log", 1_000_000


@dataclass(eq=False)
class Desktop:
    """The application put together; :meth:`close` ends every thread of it."""

    application: QApplication
    shell: Shell
    theme: Theme
    journey: Journey
    library: Library
    _closed: bool = False

    def show(self) -> None:
        """Bring up the first screen and tell of what was recovered."""
        self.journey.show_patients()
        self.shell.show()
        # All that was built by now stays: the collector need not look through it again while frames come.
        gc.collect()
        gc.freeze()

    def come_to_front(self) -> None:
        """Another start on the same data folder: this window is what was wanted."""
        self.shell.setWindowState(self.shell.windowState() & ~Qt.WindowState.WindowMinimized)
        self.shell.raise_()
        self.shell.activateWindow()

    def close(self) -> None:
        """Finish what runs and let go of everything; may be called twice."""
        if not self._closed:
            self._closed = True
            self.journey.close()
            self.shell.hide()
            self.library.close()


def application(arguments: list[str]) -> QApplication:
    """The Qt application, with the bundled typeface and the plain style under the design."""
    running = QApplication.instance()
    qt = running if isinstance(running, QApplication) else QApplication(arguments)
    qt.setApplicationName("Carpus")
    qt.setDesktopFileName("carpus")
    qt.setApplicationVersion(__version__)
    qt.setStyle("Fusion")
    load_fonts()
    return qt


def compose(
    qt: QApplication,
    settings: Settings,
    *,
    is_demo: bool = False,
    take: Take = practice_take,
    speed: float = 1.0,
    settings_folder: Path | None = None,
    today: date | None = None,
) -> Desktop:
    """Put the application together. Raises what the data folder raises (:class:`RegisterUnreadable` and others).

    ``take`` renders the practice patient; ``speed`` plays what is stored faster than it was.
    """
    # Tracking must not wait 5 ms, Python's usual turn, while the window paints, nor the window for tracking.
    sys.setswitchinterval(SWITCH_S)
    theme = Theme(theme_name(qt, settings), settings.screen.text_scale)
    apply_style(qt, theme)
    library = Library(settings.data_folder)
    recovered, faults = library.recover()
    sources = Sources(settings, library, take, speed)
    parts = Parts(library, PatientShelf(library), sources, WordTable(), settings, is_demo, today or date.today())
    shell = Shell(theme)
    journey = Journey(shell, theme, Keys(settings.screen.keys), parts)
    keeper = PreferenceKeeper(journey, theme, settings, settings_folder, lambda chosen: theme_name(qt, chosen))
    qt.styleHints().colorSchemeChanged.connect(lambda _: keeper.follow_system())
    desktop = Desktop(qt, shell, theme, journey, library)
    shell.closing.connect(desktop.close)
    qt.commitDataRequest.connect(lambda _: shell.close_surely())
    for found in recovered:
        words = journey.teller.recovered_words(found)
        place = journey.patients.notice_place
        journey.teller.strip(place, words, shell.tr("Re&view it"), lambda found=found: journey.review_recovered(found))
    for fault in faults:
        said = WordTable().fault(fault)
        journey.teller.strip(
            journey.patients.notice_place,
            Words(said.what, said.safe, said.todo),
            shell.tr("I have read it"),
            lambda: None,
            icon="hard-drive",
        )
    return desktop


def ask_for_folder(qt: QApplication, settings: Settings, fault: CarpusFault) -> Path | None:
    """Tell why the data folder cannot be used; the folder the person chose instead, None to end."""
    theme = Theme(theme_name(qt, settings), settings.screen.text_scale)
    apply_style(qt, theme)
    return NoFolder(theme, WordTable().fault(fault), Path.home()).ask()


def with_kept_folder(settings: Settings, folder: Path, settings_folder: Path | None = None) -> Settings:
    """The settings with another data folder, also from the next start on."""
    os.environ.pop(DATA_VARIABLE, None)  # it would go over what was just chosen
    chosen = replace(settings, recording=replace(settings.recording, folder=str(folder)))
    with contextlib.suppress(CarpusFault):
        keep_preferences(chosen, settings_folder)
    return chosen


def theme_name(qt: QApplication, settings: Settings) -> ThemeName:
    """The theme chosen, or the system's."""
    if settings.screen.theme != "system":
        return settings.screen.theme
    return "dark" if qt.styleHints().colorScheme() == Qt.ColorScheme.Dark else "light"


def speak_in_the_window(desktop: Desktop) -> None:
    """From now on what nobody caught becomes a message and a line in the log, never a traceback."""

    def hook(kind: type[BaseException], value: BaseException, trace: TracebackType | None) -> None:
        logging.getLogger("carpus").error("uncaught", exc_info=(kind, value, trace))
        if isinstance(value, Exception):
            desktop.journey.teller.fault(value)

    sys.excepthook = hook


def end_on_signals(desktop: Desktop) -> None:
    """Ctrl+C in the terminal, a log-out or a shutdown close the window as a person would: recordings are finished.

    Python hears of a signal when it next runs, at the latest when the journey looks for a camera.
    """
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: desktop.shell.close_surely())


def write_log() -> None:
    """Log into the user's own folder; where that cannot be written there is no log."""
    folder = Path(platformdirs.user_log_dir("carpus", appauthor=False))
    handler: logging.Handler
    try:
        folder.mkdir(parents=True, exist_ok=True)
        handler = RotatingFileHandler(folder / LOG_FILE, maxBytes=LOG_BYTES, backupCount=2, encoding="utf-8")
    except OSError:
        handler = logging.NullHandler()
    logging.basicConfig(level=logging.INFO, handlers=[handler], format="%(asctime)s %(name)s %(levelname)s %(message)s")


def with_data_folder(settings: Settings, folder: Path | None) -> Settings:
    """The settings with the data folder named on the command line."""
    if folder is None:
        return settings
    return replace(settings, recording=replace(settings.recording, folder=str(folder)))

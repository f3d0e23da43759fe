"""The one composition root: settings to concrete objects to a window."""

from __future__ import annotations

import contextlib
import gc
import logging
import os
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from functools import cache, partial
from logging.handlers import RotatingFileHandler
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

import platformdirs
from PySide6.QtCore import QEvent, QEventLoop, QMetaObject, QObject, QPoint, Qt, QTimer, Signal
from PySide6.QtGui import QPixmap
from PySide6.QtWidgets import QApplication, QFileDialog, QSplashScreen

from carpus import __version__
from carpus.app.command_line import on_stop
from carpus.app.desktop.care_cameras import CareCameras
from carpus.app.desktop.journey import CORE, SCREENS, Journey, Parts, load
from carpus.app.desktop.preferences import PreferenceKeeper
from carpus.app.desktop.welcoming import Tour, Welcome
from carpus.app.settings import DATA_VARIABLE, LockSettings, Settings, keep_preferences, sessions_folder
from carpus.app.settings import settings_folder as own_settings_folder
from carpus.core.capture.source import FrameSource
from carpus.core.durable import make_private
from carpus.core.errors import CarpusFault, OutputNotWritable
from carpus.core.records.keeping import Records
from carpus.core.records.library import Library
from carpus.core.records.new_sessions import Recovered, recover
from carpus.core.records.set_up import SetUp
from carpus.core.words import Words
from carpus.ui import language
from carpus.ui.background import Background
from carpus.ui.fault_words import fault_words
from carpus.ui.fonts import load_fonts
from carpus.ui.icons import program_icon
from carpus.ui.keys import Keys
from carpus.ui.last_places import LastPlaces, place_of, put_in_place
from carpus.ui.messages.messages import Answer, StopCard
from carpus.ui.records.backing_up import BackingUp
from carpus.ui.records.erasing import Erasing
from carpus.ui.records.lists import RecordLists
from carpus.ui.records.locking import Locking
from carpus.ui.shell import Shell
from carpus.ui.style import apply_style
from carpus.ui.theme import Theme, ThemeName
from carpus.ui.translate import tr
from carpus.ui.words.camera_check import camera_words

if TYPE_CHECKING:
    from carpus.app.desktop.sources import Sources
    from carpus.ui.settings.screen import SettingsScreen


def answer_words() -> tuple[str, str]:
    """End, or go on elsewhere."""
    return tr("Close Carpus"), tr("Choose another folder")


def folder_title() -> str:
    """Over the choice of a folder."""
    return tr("Folder of patients and sessions")


class NoFolder:
    """A card in an empty window. ``chosen`` is the folder that the person named, None when they closed the window."""

    def __init__(self, theme: Theme, words: Words, start: Path) -> None:
        self.chosen: Path | None = None
        self._start = start
        self.shell = Shell(theme)
        self.shell.bar.help_button.hide()
        self.shell.bar.settings_button.hide()
        self.card = StopCard(self.shell.stage, theme)
        self._words = words
        self._loop = QEventLoop()
        self.shell.closing.connect(self._loop.quit)

    def ask(self) -> Path | None:
        """Show it and wait for the answer."""
        self.shell.show()
        self._show()
        self._loop.exec()
        self.shell.hide()
        self.shell.deleteLater()
        return self.chosen

    def _show(self) -> None:
        end, other = answer_words()
        self.card.show_words(self._words, (Answer(end, self.shell.close), Answer(other, self._choose)))

    def _choose(self) -> None:
        named = QFileDialog.getExistingDirectory(self.shell, folder_title(), str(self._start))
        if not named:
            self._show()
            return
        self.chosen = Path(named)
        self._loop.quit()


Take = Callable[[SetUp, Callable[[int, int], None]], tuple[FrameSource, float]]
SWITCH_S = 0.001
SESSION_PATH = re.compile(r"\S*(?:sessions[\\/]|_\d{4}-\d\d-\d\d_\d{6}_)\S*")
"""A path or a file's name with a pseudonym in it."""
LOG_FILE, LOG_BYTES = "carpus.log", 1_000_000
SETTLED_MS = 200
"""After the first picture, which need not wait for it."""


def settle() -> None:
    """All that was built by now stays: the collector, which a start leaves aside, need not look through it again while
    frames come."""
    gc.enable()
    gc.collect()
    gc.freeze()


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
    anew: Callable[..., Desktop]
    """Puts the application together again, with other settings, as this one (``of``)."""
    from_system: tuple[QMetaObject.Connection, ...] = ()
    """What the system tells, until this is closed."""
    _closed: bool = False
    _loading: Background = field(default_factory=Background)

    def show(self) -> None:
        """Bring up the first screen and tell of what was recovered."""
        # The newest session is on top, but for simulated ones, which count nowhere.
        self.journey.patients.show(self.library.index.last_owner() if self.journey.is_demo else "")
        put_in_place(self.shell, LastPlaces(self.library.store).window())
        self.shell.create()  # what hides the names must be there before anything is seen
        self.safe.locking.lock_at_start()
        self.shell.show()
        self.welcome.begin()
        QTimer.singleShot(SETTLED_MS, self._load)
        self.journey.way.made.connect(lambda: QTimer.singleShot(SETTLED_MS, settle))

    def _load(self) -> None:
        """While the window waits for the person: what the other screens are made of, as far as it may be in a thread of
        its own."""

        def work() -> None:
            for _ in load(CORE):
                if self._closed:
                    break

        self._loading.run(work, lambda _: self._load_on(load(SCREENS)), self.journey.messages.fault)

    def _load_on(self, loaded: Iterator[str]) -> None:
        """The next module, when the window has done what came meanwhile."""
        if self._closed:
            return
        if next(loaded, ""):
            QTimer.singleShot(0, lambda: self._load_on(loaded))  # also once another window is this one
        else:
            settle()

    def speak_anew(self) -> None:
        """The language was changed: everything is put together again, at the same place, and this becomes it."""
        picture = QSplashScreen(self.shell.grab())  # of the old window, until the new one stands there
        picture.move(self.shell.mapToGlobal(QPoint()))
        picture.show()
        try:
            self._put_together_again(picture)
        except BaseException:
            self.application.exit(1)  # no window is left by which a person could end it
            raise
        finally:
            picture.close()

    def _put_together_again(self, picture: QSplashScreen) -> None:
        application, settings, anew = self.application, self.keeper.settings, self.anew
        place, now = self.journey.way.behind, self.journey.now
        quits = application.quitOnLastWindowClosed()
        application.setQuitOnLastWindowClosed(False)
        self.close()
        gc.unfreeze()
        for widget in application.topLevelWidgets():  # screens never shown too: they would be styled with the new ones
            if widget is not picture:
                widget.deleteLater()
        application.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)
        gc.collect()
        try:
            anew(settings, of=self)
        except CarpusFault as fault:  # the folder went away just now: told as at a start, and the next one meets it
            picture.close()
            chosen = ask_for_folder(application, settings, fault)
            if chosen is not None:
                with_kept_folder(settings, chosen)
            application.exit(1)
            return
        self.journey.now.choice = now.choice
        self.journey.patients.show()
        self.journey.show_again_at(place, now)
        put_in_place(self.shell, LastPlaces(self.library.store).window())
        self.shell.create()
        self.safe.locking.look_again()
        self.shell.show()
        self.journey.way.show("settings")
        picture.finish(self.shell)
        application.setQuitOnLastWindowClosed(quits)
        gc.freeze()

    def become(self, other: Desktop) -> Desktop:
        """This with the parts of another one."""
        self.__dict__ |= other.__dict__
        return self

    def why_no_other_language(self) -> str:
        """One sentence where the window cannot be put together again now, else nothing."""
        journey, safe = self.journey, self.safe
        busy = journey.is_at_work or safe.backing_up.is_at_work or self.tour.is_on or journey.messages.busy
        return not_now_words() if busy else ""

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
            LastPlaces(self.library.store).keep_window(place_of(self.shell))
            self.journey.close()
            self.shell.hide()
            self.library.close()


def not_now_words() -> str:
    """Why the language stays."""
    return tr("The language can be changed when nothing is measured or worked on any more.")


def application(arguments: list[str]) -> QApplication:
    """The Qt application, with the bundled typeface and the plain style under the design."""
    running = QApplication.instance()
    qt = running if isinstance(running, QApplication) else QApplication(arguments)
    qt.setApplicationName("Carpus")
    qt.setDesktopFileName("carpus")
    qt.setApplicationVersion(__version__)
    qt.setWindowIcon(QPixmap.fromImage(program_icon(256)))
    qt.setStyle("Fusion")
    load_fonts()
    return qt


def compose(
    qt: QApplication,
    settings: Settings,
    *,
    is_demo: bool = False,
    take: Take | None = None,
    speed: float = 1.0,
    settings_folder: Path | None = None,
    today: date | None = None,
    told: Sequence[CarpusFault] = (),
    of: Desktop | None = None,
) -> Desktop:
    """Put the application together. Raises what the data folder raises (:class:`RegisterUnreadable` and others).

    ``take`` renders the practice patient in another way; ``speed`` plays what is stored faster than it was; ``told`` is
    told on the first screen; ``of`` is a closed one that becomes what is put together.
    """
    # Tracking must not wait 5 ms, Python's usual turn, while the window paints, nor the window for tracking.
    sys.setswitchinterval(SWITCH_S)
    theme = _dressed(qt, settings)
    library = Library(settings.data_folder, url=settings.records.url, sessions=sessions_folder(settings))
    library.who = lambda: settings.report.therapist
    library.angle_order = lambda: settings.report.angle_order
    LINES.names = library.pseudonyms
    recovered, faults = recover(library)

    @cache
    def sources() -> Sources:
        from carpus.app.desktop.sources import Sources, practice_beginning, practice_take
        from carpus.core.records.new_sessions import NewSessions

        beginning = practice_beginning if take is None else lambda _: None
        made = Sources(settings, NewSessions(library), take or practice_take, speed, beginning)
        made.streams = lambda: journey.settings.stream.on
        return made

    day = date.today if today is None else lambda: today
    parts = Parts(library, lambda *given: sources().open(*given), CareCameras(settings, speed), settings, is_demo, day)
    shell = Shell(theme)
    journey = Journey(shell, theme, Keys(settings.screen.keys), parts)
    keeper = PreferenceKeeper(
        journey, theme, settings, settings_folder, lambda chosen: theme_name(qt, chosen), is_demo=is_demo
    )
    follows = qt.styleHints().colorSchemeChanged.connect(lambda _: keeper.follow_system())
    library.who = lambda: journey.settings.report.therapist
    library.angle_order = lambda: journey.settings.report.angle_order
    OpeningsLogged(journey, library)
    safe = _safekeeping(journey, keeper, settings, settings_folder)
    journey.way.when_made("settings", lambda: _connect_settings(keeper.screen, journey, theme))
    journey.way.when_made(
        "retest", lambda: journey.retest.in_force.connect(lambda: keeper.screen.show_limits(library.error_limits))
    )
    tour = Tour(journey)
    welcome = Welcome(journey, theme, tour, keeper, library)
    again = partial(compose, qt, is_demo=is_demo, take=take, speed=speed, settings_folder=settings_folder, today=today)
    ends = qt.commitDataRequest.connect(lambda _: shell.close_surely())
    made = Desktop(qt, shell, theme, journey, library, safe, welcome, tour, keeper, again, (follows, ends))
    desktop = made if of is None else of.become(made)
    shell.closing.connect(desktop.close)
    keeper.language_chosen.connect(lambda: QTimer.singleShot(0, desktop.speak_anew))
    keeper.keeps_language = desktop.why_no_other_language
    _tell(journey, recovered, (*told, *faults))
    return desktop


def _tell(journey: Journey, recovered: Sequence[Recovered], faults: Sequence[CarpusFault]) -> None:
    """On the first screen: which sessions were finished, and what went wrong."""
    place, messages = journey.patients.screen.notice_place, journey.messages
    for found in recovered:
        look = partial(journey.way.show, "review", found.session_id, found.patient_id)
        messages.strip(place, messages.recovered_words(found), tr("Re&view it"), look)
    for fault in faults:
        messages.strip(place, fault_words(fault), tr("I have read it"), lambda: None, icon="hard-drive")


def _connect_settings(screen: SettingsScreen, journey: Journey, theme: Theme) -> None:
    """What the settings lead to, and cards that others have."""
    from carpus.ui.settings.camera_card import CameraCard

    way, camera = journey.way, journey.camera_state
    screen.retest.clicked.connect(lambda: way.show("retest"))
    card = CameraCard(theme)
    card.calibrate_button.clicked.connect(lambda: way.show("board"))
    card.check_button.clicked.connect(lambda: way.show("card"))
    camera.changed.connect(lambda: card.show_status(*camera_words(camera.status)))
    card.show_status(*camera_words(camera.status))
    screen.add_cards("camera", card)
    screen.add_cards("report", journey.report.forms.card)


def _safekeeping(journey: Journey, keeper: PreferenceKeeper, settings: Settings, folder: Path | None) -> Safe:
    """The flows about records, back-up and lock, and their cards among the settings."""
    context, patients = journey.context, journey.patients.screen
    records = Records(context.library)
    backing_up = BackingUp(
        context, settings.backup, folder or own_settings_folder(), keep=lambda chosen: keeper.keep(backup=chosen)
    )
    erasing = Erasing(
        context, records, lambda: journey.sessions.screen, patients,
        years=lambda: lists.years, last_backup=lambda: backing_up.last.made if backing_up.last else None,
    )  # fmt: skip
    lists = RecordLists(
        context, records, erasing, lambda: journey.sessions.screen, patients, years=settings.records.retention_years,
        keep_years=lambda years: keeper.keep(records=replace(settings.records, retention_years=years)),
    )  # fmt: skip
    locking = Locking(
        context, key=context.keys["lock"], minutes=settings.lock.after_min,
        keep_minutes=lambda minutes: keeper.keep(lock=LockSettings(minutes)),
    )  # fmt: skip

    def connect_live() -> None:
        view = journey.live.patient_view
        locking.hides.connect(lambda hides: view.hide_all() if hides else view.show_again())
        if locking.locked:
            view.hide_all()

    journey.way.when_made("live", connect_live)
    journey.way.when_made(
        "settings", lambda: keeper.screen.add_cards("safety", backing_up.card, locking.card, lists.card)
    )
    backing_up.remind(patients.notice_place)
    return Safe(erasing, lists, backing_up, locking)


def _dressed(qt: QApplication, settings: Settings) -> Theme:
    """Language, theme and style as chosen."""
    language.speak(settings.screen.language)
    theme = Theme(theme_name(qt, settings), settings.screen.text_scale)
    apply_style(qt, theme)
    return theme


def ask_for_folder(qt: QApplication, settings: Settings, fault: CarpusFault) -> Path | None:
    """Tell why the data folder cannot be used; the folder the person chose instead, None to end."""
    theme = _dressed(qt, settings)
    return NoFolder(theme, fault_words(fault), Path.home()).ask()


def with_kept_folder(settings: Settings, folder: Path) -> Settings:
    """The settings with another data folder; also from the next start on, unless this run had a folder of its own."""
    if settings.run_folder is not None:
        return replace(settings, run_folder=folder)
    os.environ.pop(DATA_VARIABLE, None)  # it would go over what was just chosen
    chosen = replace(settings, recording=replace(settings.recording, folder=str(folder)))
    with contextlib.suppress(CarpusFault):
        keep_preferences(settings, chosen)
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
            desktop.journey.messages.fault(value)

    sys.excepthook = hook


def end_on_signals(desktop: Desktop) -> None:
    """Ctrl+C in the terminal, its closing, a log-out or a shutdown close the window as a person would.

    Recordings are finished. Python hears of a signal when it next runs, at the latest when the journey looks for a
    camera.
    """
    on_stop(lambda: desktop.shell.close_surely())


class NobodysLines(logging.Formatter):
    """Lines of the log without pseudonyms: the names of patients' folders and files are cut out of every path."""

    def __init__(self) -> None:
        super().__init__("%(asctime)s %(name)s %(levelname)s %(message)s")
        self.names: Callable[[], Sequence[str]] = lambda: ()
        """What else must not be in the log: asked for each line, of which there are few."""

    def format(self, record: logging.LogRecord) -> str:
        text = SESSION_PATH.sub("…", super().format(record))
        for name in self.names():
            text = re.sub(rf"(?<!\w){re.escape(name)}(?!\w)", "…", text, flags=re.IGNORECASE)
        return text


LINES = NobodysLines()


def write_log() -> None:
    """Log into the user's own folder; where that cannot be written there is no log."""
    folder = Path(platformdirs.user_log_dir("carpus", appauthor=False))
    handler: logging.Handler
    try:
        make_private(folder)
        for old in folder.glob(f"{LOG_FILE}*"):
            old.chmod(0o600)
        handler = RotatingFileHandler(folder / LOG_FILE, maxBytes=LOG_BYTES, backupCount=2, encoding="utf-8")
    except (OSError, OutputNotWritable):
        handler = logging.NullHandler()
    handler.setFormatter(LINES)
    logging.basicConfig(level=logging.INFO, handlers=[handler])
    logging.getLogger("alembic").setLevel(logging.WARNING)  # how the store is set up says nothing to a person


def with_data_folder(settings: Settings, folder: Path | None) -> Settings:
    """The settings with the data folder named on the command line: without the clinic's server, shared folder and daily
    backup, which are those of its own data folder."""
    if folder is None or folder.absolute() == settings.data_folder.absolute():
        return settings
    records, backup = replace(settings.records, url="", sessions=""), replace(settings.backup, hour=-1)
    return replace(settings, run_folder=folder, records=records, backup=backup)


class OpeningsLogged(QObject):
    """Watches the journey; changes nothing of it."""

    log_lost = Signal(object)
    """Something could not be written into the log, from whatever thread."""

    def __init__(self, journey: Journey, library: Library) -> None:
        super().__init__(journey)
        self._now_beside: Callable[[], Sequence[str]] = lambda: sorted(journey.beside.screen.ids)
        self._now, self._library = journey.now, library
        self._seen = ("", "")
        self.log_lost.connect(journey.messages.fault)
        library.log_fault = self.log_lost.emit
        journey.way.arrived.connect(self._arrived)

    def _arrived(self, place: str) -> None:
        patient = self._now.patient
        if place == "review" and self._is_new(place, self._now.session_id):
            self._library.notes.session("opened", self._now.session_id)
        elif place == "beside":
            for session_id in self._now_beside() if self._is_new(place, " ".join(self._now_beside())) else ():
                self._library.notes.session("opened", session_id)
        elif place == "progress" and patient is not None and self._is_new(place, patient.patient_id):
            self._library.notes.patient("opened", patient.patient_id)
        elif place == "patients":
            self._seen = ("", "")

    def _is_new(self, place: str, identity: str) -> bool:
        """Not only back from the help."""
        before, self._seen = self._seen, (place, identity)
        return before != self._seen

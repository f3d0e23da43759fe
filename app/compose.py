"""The one composition root: settings to concrete objects to a window."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import date
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication

from carpus.app.desktop.care_cameras import CareCameras
from carpus.app.desktop.journey import Journey, Parts
from carpus.app.desktop.log import LINES
from carpus.app.desktop.looks import dressed, theme_name
from carpus.app.desktop.openings import OpeningsLogged
from carpus.app.desktop.preferences import PreferenceKeeper
from carpus.app.desktop.welcoming import Tour, Welcome
from carpus.app.desktop.window import Desktop, Safe
from carpus.app.settings import LockSettings, Settings, sessions_folder
from carpus.app.settings import settings_folder as own_settings_folder
from carpus.core.capture.source import FrameSource
from carpus.core.errors import CarpusFault, ServerGone
from carpus.core.records.keeping import Records
from carpus.core.records.library import Library
from carpus.core.records.new_sessions import Recovered, recover
from carpus.core.records.set_up import SetUp
from carpus.ui.fault_words import fault_words
from carpus.ui.records.backing_up import BackingUp
from carpus.ui.records.erasing import Erasing
from carpus.ui.records.lists import RecordLists
from carpus.ui.records.locking import Locking
from carpus.ui.shell import Shell
from carpus.ui.theme import Theme
from carpus.ui.translate import tr
from carpus.ui.words.camera_check import camera_words

if TYPE_CHECKING:
    from carpus.app.desktop.sources import Sources
    from carpus.ui.settings.screen import SettingsScreen


Take = Callable[[SetUp, Callable[[int, int], None]], tuple[FrameSource, float]]
SWITCH_S = 0.001


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
) -> Desktop:
    """Put the application together. Raises what the data folder raises (:class:`RegisterUnreadable` and others).

    ``take`` renders the practice patient in another way; ``speed`` plays what is stored faster than it was; ``told`` is
    told on the first screen.
    """
    # Tracking must not wait 5 ms, Python's usual turn, while the window paints, nor the window for tracking.
    sys.setswitchinterval(SWITCH_S)
    theme = dressed(qt, settings)
    library = Library(settings.data_folder, url=settings.records.url, sessions=sessions_folder(settings))
    library.who = lambda: settings.report.therapist
    library.angle_order = lambda: settings.report.angle_order
    LINES.names = library.pseudonyms
    recovered, faults = recover(library)

    @cache
    def sources() -> Sources:
        from carpus.app.desktop.practice import practice_beginning, practice_take
        from carpus.app.desktop.sources import Sources
        from carpus.core.records.new_sessions import NewSessions

        beginning = practice_beginning if take is None else lambda _: None
        made = Sources(settings, NewSessions(library), take or practice_take, speed, beginning)
        made.streams = lambda: journey.settings.stream.on
        return made

    day = date.today if today is None else lambda: today
    parts = Parts(library, lambda *given: sources().open(*given), CareCameras(settings), settings, is_demo, day)
    shell = Shell(theme)
    journey = Journey(shell, theme, parts)
    keeper = PreferenceKeeper(
        journey, theme, settings, settings_folder, lambda chosen: theme_name(qt, chosen), is_demo=is_demo
    )
    follows = qt.styleHints().colorSchemeChanged.connect(lambda _: keeper.follow_system())
    library.who = lambda: journey.settings.report.therapist
    library.angle_order = lambda: journey.settings.report.angle_order
    OpeningsLogged(journey, library)
    safe = _safekeeping(journey, keeper, settings, settings_folder)
    journey.way.when_made("settings", lambda: _connect_settings(keeper.screen, journey, theme))
    tour = Tour(journey)
    welcome = Welcome(journey, theme, tour, keeper, library)
    ends = qt.commitDataRequest.connect(lambda _: shell.close_surely())
    desktop = Desktop(qt, shell, theme, journey, library, safe, welcome, tour, keeper, (follows, ends))
    shell.closing.connect(desktop.close)
    keeper.language_chosen.connect(lambda: QTimer.singleShot(0, desktop.reopen))
    keeper.keeps_language = desktop.why_no_other_language
    _tell(journey, recovered, (*told, *faults))
    journey.server.back.connect(lambda caught: _tell(journey, *caught))
    return desktop


def _tell(journey: Journey, recovered: Sequence[Recovered], faults: Sequence[CarpusFault]) -> None:
    """On the first screen: which sessions were finished, and what went wrong."""
    place, messages = journey.patients.screen.notice_place, journey.messages
    for found in recovered:
        look = partial(journey.way.show, "review", found.session_id, found.patient_id)
        messages.strip(place, messages.recovered_words(found), tr("Re&view it"), look)
    for fault in faults:
        if isinstance(fault, ServerGone):
            continue  # every screen says so as long as it is
        messages.strip(place, fault_words(fault), tr("I have read it"), lambda: None, icon="hard-drive")


def _connect_settings(screen: SettingsScreen, journey: Journey, theme: Theme) -> None:
    """What the settings lead to, and cards that others have."""
    from carpus.ui.settings.camera_card import CameraCard

    way, camera = journey.way, journey.camera_state
    card = CameraCard(theme)
    if journey.is_demo:
        card.show_demo()
    else:
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
        context, minutes=settings.lock.after_min,
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

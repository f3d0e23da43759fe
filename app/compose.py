"""The composition root: builds the desktop application from its settings."""

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

from carpus.app.desktop.access_log import AccessLogger
from carpus.app.desktop.appearance import apply_appearance, theme_name
from carpus.app.desktop.first_start import TourController, WelcomeController
from carpus.app.desktop.log import LOG_FORMATTER
from carpus.app.desktop.main_controller import AppServices, MainController
from carpus.app.desktop.maintenance_cameras import MaintenanceCameras
from carpus.app.desktop.preferences import PreferencesController
from carpus.app.desktop.window import DataProtection, Desktop
from carpus.app.settings import LockSettings, Settings, sessions_folder
from carpus.app.settings import settings_folder as own_settings_folder
from carpus.core.capture.source import FrameSource
from carpus.core.model.errors import CarpusFault, ServerUnavailable
from carpus.core.records.library import Library
from carpus.core.records.new_sessions import RecoveredSession, recover_sessions
from carpus.core.records.retention import RecordRetention
from carpus.core.records.session_setup import SessionSetup
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.screens.records.backup import BackupController
from carpus.ui.screens.records.deletion import DeletionController
from carpus.ui.screens.records.lock import LockController
from carpus.ui.screens.records.record_lists import RecordListsController
from carpus.ui.shell.main_window import MainWindow
from carpus.ui.words.camera_check import camera_words
from carpus.ui.words.fault_words import fault_words

if TYPE_CHECKING:
    from carpus.app.desktop.source_factory import SourceFactory
    from carpus.ui.screens.settings.screen import SettingsScreen


RenderPractice = Callable[[SessionSetup, Callable[[int, int], None]], tuple[FrameSource, float]]
THREAD_SWITCH_S = 0.001


def compose(
    qt: QApplication,
    settings: Settings,
    *,
    is_demo: bool = False,
    practice_renderer: RenderPractice | None = None,
    speed: float = 1.0,
    settings_folder: Path | None = None,
    today: date | None = None,
    startup_faults: Sequence[CarpusFault] = (),
) -> Desktop:
    """Build the desktop application.

    ``practice_renderer`` renders the practice patient in another way; ``speed`` plays stored recordings faster than
    they were; ``startup_faults`` are shown on the first screen.

    Raises
    ------
    PatientListUnreadable
        And the other faults of opening a data folder.
    """
    # Tracking must not wait 5 ms, Python's usual turn, while the window paints, nor the window for tracking.
    sys.setswitchinterval(THREAD_SWITCH_S)
    theme = apply_appearance(qt, settings)
    library = Library(settings.data_folder, url=settings.records.url, sessions_folder=sessions_folder(settings))
    library.get_initials = lambda: settings.report.therapist
    library.get_angle_order = lambda: settings.report.angle_order
    LOG_FORMATTER.find_pseudonyms = library.pseudonyms
    recovered, faults = recover_sessions(library)

    @cache
    def sources() -> SourceFactory:
        from carpus.app.desktop.practice import render_practice, render_practice_start
        from carpus.app.desktop.source_factory import SourceFactory
        from carpus.core.records.new_sessions import SessionIntake

        beginning = render_practice_start if practice_renderer is None else lambda _: None
        made = SourceFactory(settings, SessionIntake(library), practice_renderer or render_practice, speed, beginning)
        made.is_streaming = lambda: journey.settings.stream.on
        return made

    day = date.today if today is None else lambda: today
    parts = AppServices(
        library, lambda *given: sources().open(*given), MaintenanceCameras(settings), settings, is_demo, day
    )
    shell = MainWindow(theme)
    journey = MainController(shell, theme, parts)
    keeper = PreferencesController(
        journey, theme, settings, settings_folder, lambda chosen: theme_name(qt, chosen), is_demo=is_demo
    )
    follows = qt.styleHints().colorSchemeChanged.connect(lambda _: keeper.follow_system())
    library.get_initials = lambda: journey.settings.report.therapist
    library.get_angle_order = lambda: journey.settings.report.angle_order
    AccessLogger(journey, library)
    safe = _build_data_protection(journey, keeper, settings, settings_folder)
    journey.navigator.run_when_created("settings", lambda: _connect_settings(keeper.screen, journey, theme))
    tour = TourController(journey)
    welcome = WelcomeController(journey, theme, tour, keeper, library)
    ends = qt.commitDataRequest.connect(lambda _: shell.close_without_prompt())
    desktop = Desktop(qt, shell, theme, journey, library, safe, welcome, tour, keeper, (follows, ends))
    shell.closing.connect(desktop.close)
    keeper.language_chosen.connect(lambda: QTimer.singleShot(0, desktop.reopen))
    keeper.find_language_obstacle = desktop.find_language_obstacle
    _show_startup_notices(journey, recovered, (*startup_faults, *faults))
    journey.server_monitor.server_restored.connect(lambda caught: _show_startup_notices(journey, *caught))
    return desktop


def _show_startup_notices(
    journey: MainController, recovered: Sequence[RecoveredSession], faults: Sequence[CarpusFault]
) -> None:
    """Show recovered sessions and faults above the patient list."""
    place, messages = journey.patients.screen.notice_layout, journey.messages
    for found in recovered:
        look = partial(journey.navigator.open_screen, "review", found.session_id, found.patient_id)
        messages.show_notice(place, messages.recovery_words(found), tr("Re&view it"), look)
    for fault in faults:
        if isinstance(fault, ServerUnavailable):
            continue  # every screen says so as long as it is
        messages.show_notice(place, fault_words(fault), tr("I have read it"), lambda: None, icon="hard-drive")


def _connect_settings(screen: SettingsScreen, journey: MainController, theme: Theme) -> None:
    from carpus.ui.screens.settings.camera_card import CameraCard

    way, camera = journey.navigator, journey.camera_state
    card = CameraCard(theme)
    if journey.is_demo:
        card.show_demo()
    else:
        card.calibrate_button.clicked.connect(lambda: way.open_screen("board"))
        card.check_button.clicked.connect(lambda: way.open_screen("card"))
        camera.status_changed.connect(lambda: card.show_status(*camera_words(camera.status)))
        card.show_status(*camera_words(camera.status))
    screen.add_cards("camera", card)
    screen.add_cards("report", journey.report.form_store.card)


def _build_data_protection(
    journey: MainController, keeper: PreferencesController, settings: Settings, folder: Path | None
) -> DataProtection:
    """Build the dialogs for backup, lock, records and erasure, and their cards in the settings."""
    context, patients = journey.context, journey.patients.screen
    records = RecordRetention(context.library)
    backing_up = BackupController(
        context,
        settings.backup,
        folder or own_settings_folder(),
        save_settings=lambda chosen: keeper.save(backup=chosen),
    )
    erasing = DeletionController(
        context,
        records,
        lambda: journey.sessions.screen,
        patients,
        retention_years=lambda: lists.retention_years,
        last_backup=lambda: backing_up.last_backup.made if backing_up.last_backup else None,
    )
    lists = RecordListsController(
        context,
        records,
        erasing,
        lambda: journey.sessions.screen,
        patients,
        retention_years=settings.records.retention_years,
        save_years=lambda years: keeper.save(records=replace(settings.records, retention_years=years)),
    )
    locking = LockController(
        context, minutes=settings.lock.after_min,
        save_minutes=lambda minutes: keeper.save(lock=LockSettings(minutes)),
    )  # fmt: skip

    def connect_live() -> None:
        view = journey.live.patient_view
        locking.privacy_changed.connect(lambda hides: view.hide_content() if hides else view.show_content())
        if locking.is_locked:
            view.hide_content()

    journey.navigator.run_when_created("live", connect_live)
    journey.navigator.run_when_created(
        "settings", lambda: keeper.screen.add_cards("safety", backing_up.card, locking.card, lists.card)
    )
    backing_up.show_reminder(patients.notice_layout)
    return DataProtection(erasing, lists, backing_up, locking)

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

from carpus.app.desktop.appearance import apply_appearance, theme_name
from carpus.app.desktop.first_start import TourController, WelcomeController
from carpus.app.desktop.log import LOG_FORMATTER
from carpus.app.desktop.main_controller import AccessLogger, MainController
from carpus.app.desktop.maintenance_cameras import MaintenanceCameras
from carpus.app.desktop.practice_system import PracticeSystemController
from carpus.app.desktop.preferences import PreferencesController
from carpus.app.desktop.window import DataProtection, Desktop
from carpus.app.settings import LockSettings, Settings, sessions_folder
from carpus.app.settings import settings_folder as default_settings_folder
from carpus.core.capture.source import FrameSource
from carpus.core.model.errors import CarpusFault, ServerUnavailable
from carpus.core.records.data_folder import DataFolder
from carpus.core.records.new_sessions import RecoveredSession, recover_sessions
from carpus.core.records.retention import RecordRetention
from carpus.core.records.session_setup import SessionSetup
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.screens.records.backup import BackupController
from carpus.ui.screens.records.deletion import DeletionController
from carpus.ui.screens.records.lock import LockController
from carpus.ui.screens.records.record_lists import RecordListsController
from carpus.ui.screens.settings.therapists import TherapistController
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
    library = DataFolder(settings.data_folder, url=settings.records.url, sessions_folder=sessions_folder(settings))
    library.get_initials = lambda: settings.report.therapist
    library.get_angle_order = lambda: settings.report.angle_order
    LOG_FORMATTER.find_names = library.identifying_texts
    recovered, faults = recover_sessions(library)

    @cache
    def sources() -> SourceFactory:
        from carpus.app.desktop.practice import render_practice, render_practice_start
        from carpus.app.desktop.source_factory import SourceFactory
        from carpus.core.records.new_sessions import SessionIntake

        beginning = render_practice_start if practice_renderer is None else lambda _: None
        renderer = practice_renderer or render_practice
        factory = SourceFactory(settings, SessionIntake(library), renderer, speed, beginning)
        factory.is_streaming = lambda: controller.settings.stream.on
        return factory

    day = date.today if today is None else lambda: today
    shell = MainWindow(theme)
    cameras = MaintenanceCameras(settings)
    controller = MainController(
        shell, theme, library, lambda *given: sources().open(*given), cameras, settings, day, is_demo=is_demo
    )
    preferences = PreferencesController(
        controller, theme, settings, settings_folder, lambda chosen: theme_name(qt, chosen), is_demo=is_demo
    )
    follows = qt.styleHints().colorSchemeChanged.connect(lambda _: preferences.follow_system())
    library.get_initials = lambda: controller.settings.report.therapist
    library.get_angle_order = lambda: controller.settings.report.angle_order
    AccessLogger(controller, library)
    therapists = TherapistController(
        controller.context, lambda: preferences.settings.report.therapist, preferences.choose_therapist
    )
    data_protection = _build_data_protection(controller, preferences, therapists, settings, settings_folder)
    practice_system = PracticeSystemController(controller, preferences, is_demo=is_demo)
    controller.navigator.run_when_created(
        "settings", lambda: _connect_settings(preferences.screen, controller, therapists, theme)
    )
    tour = TourController(controller)
    welcome = WelcomeController(controller, theme, tour, preferences, library)
    ends = qt.commitDataRequest.connect(lambda _: shell.close_without_prompt())
    practice_system.can_open = lambda: not data_protection.locking.is_locked and not shell.isHidden()
    desktop = Desktop(
        qt, shell, theme, controller, library, data_protection, welcome, tour, preferences, practice_system,
        (follows, ends),
    )  # fmt: skip
    shell.closing.connect(desktop.close)
    preferences.language_chosen.connect(lambda: QTimer.singleShot(0, desktop.reopen))
    preferences.find_language_obstacle = desktop.find_language_obstacle
    _show_startup_notices(controller, recovered, (*startup_faults, *faults))
    controller.server_monitor.server_restored.connect(lambda caught: _show_startup_notices(controller, *caught))
    return desktop


def _show_startup_notices(
    controller: MainController, recovered: Sequence[RecoveredSession], faults: Sequence[CarpusFault]
) -> None:
    """Show recovered sessions and faults above the patient list."""
    place, messages = controller.patients.screen.notice_layout, controller.messages
    for found in recovered:
        look = partial(controller.navigator.open_screen, "review", found.session_id, found.patient_id)
        messages.show_notice(place, messages.recovery_words(found), tr("Re&view it"), look)
    for fault in faults:
        if isinstance(fault, ServerUnavailable):
            continue  # every screen says so as long as it is
        messages.show_notice(place, fault_words(fault), tr("I have read it"), lambda: None, icon="hard-drive")


def _connect_settings(
    screen: SettingsScreen, controller: MainController, therapists: TherapistController, theme: Theme
) -> None:
    from carpus.ui.screens.settings.screen import CameraCard

    navigator, camera = controller.navigator, controller.camera_state
    card = CameraCard(theme)
    if controller.is_demo:
        card.show_demo()
    else:
        card.calibrate_button.clicked.connect(lambda: navigator.open_screen("board"))
        card.check_button.clicked.connect(lambda: navigator.open_screen("card"))
        camera.status_changed.connect(lambda: card.show_status(*camera_words(camera.status)))
        card.show_status(*camera_words(camera.status))
    screen.add_cards("camera", card)
    screen.add_cards("report", therapists.card, controller.report.form_store.card)


def _build_data_protection(
    controller: MainController,
    preferences: PreferencesController,
    therapists: TherapistController,
    settings: Settings,
    folder: Path | None,
) -> DataProtection:
    """Build the dialogs for backup, lock, records and erasure, and their cards in the settings."""
    context, patients = controller.context, controller.patients.screen
    records = RecordRetention(context.library)
    backing_up = BackupController(
        context,
        settings.backup,
        folder or default_settings_folder(),
        save_settings=lambda chosen: preferences.save(backup=chosen),
    )
    erasing = DeletionController(
        context,
        records,
        lambda: controller.sessions.screen,
        patients,
        retention_years=lambda: lists.retention_years,
        last_backup=lambda: backing_up.last_backup.made if backing_up.last_backup else None,
    )
    lists = RecordListsController(
        context,
        records,
        erasing,
        lambda: controller.sessions.screen,
        patients,
        retention_years=settings.records.retention_years,
        save_years=lambda years: preferences.save(records=replace(settings.records, retention_years=years)),
    )
    locking = LockController(
        context, therapists, minutes=settings.lock.after_min,
        save_minutes=lambda minutes: preferences.save(lock=LockSettings(minutes)),
    )  # fmt: skip

    def connect_live() -> None:
        view = controller.live.patient_view
        locking.privacy_changed.connect(lambda hides: view.hide_content() if hides else view.show_content())
        if locking.is_locked:
            view.hide_content()

    controller.navigator.run_when_created("live", connect_live)
    controller.navigator.run_when_created(
        "settings", lambda: preferences.screen.add_cards("safety", backing_up.card, locking.card, lists.card)
    )
    backing_up.show_reminder(patients.notice_layout)
    return DataProtection(erasing, lists, backing_up, locking)

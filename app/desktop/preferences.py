"""The settings screen: shows the preferences, applies them at once where possible, saves them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, cast

from PySide6.QtCore import QObject, Signal

from carpus.app.desktop.main_controller import MainController
from carpus.app.session_commands import read_results
from carpus.app.settings import (
    LockSettings,
    PracticeSystemSettings,
    RecordsSettings,
    Settings,
    WelcomeSettings,
    save_preferences,
)
from carpus.core.model.errors import CarpusFault
from carpus.core.records.values import BackupSettings
from carpus.core.results.report_form import ReportSettings
from carpus.ui.kit.theme import Theme, ThemeName

if TYPE_CHECKING:
    from carpus.ui.screens.settings.flow import SettingsFlow
    from carpus.ui.screens.settings.screen import Preferences, SettingsScreen


SETTING_PATHS = {
    "theme": ("screen", "theme"), "text_scale": ("screen", "text_scale"), "language": ("screen", "language"),
    "research": ("screen", "research"), "angle_order": ("report", "angle_order"),
    "stream": ("stream", "on"), "patient_sound": ("patient", "sound"), "start": ("recording", "start"),
}  # fmt: skip
"""Section and field of each preference in the settings."""


class PreferencesController(QObject):
    """Applies and saves preferences; a new data folder is used from the next start on.

    ``language_chosen``: the window must be built again in another language.
    """

    language_chosen = Signal()

    def __init__(
        self,
        controller: MainController,
        theme: Theme,
        settings: Settings,
        folder: Path | None,
        resolve_theme: Callable[[Settings], ThemeName],
        *,
        is_demo: bool = False,
    ) -> None:
        """Connect to the settings screen; a demo saves nothing."""
        super().__init__(controller)
        self._is_demo = is_demo
        self._controller, self._theme, self.settings = controller, theme, settings
        self._folder, self._resolve_theme = folder, resolve_theme
        self.find_language_obstacle: Callable[[], str] = str
        """Returns why the language cannot change now; empty if it can."""
        self._shown_folder = str(settings.data_folder)
        navigator = controller.navigator
        navigator.factories["settings"] = self._create_flow
        navigator.run_when_created("settings", lambda: self.screen.changed.connect(self.apply))
        navigator.run_when_created("live", self._apply_start_mode)
        navigator.show_research(on=settings.screen.research)

    @property
    def screen(self) -> SettingsScreen:
        return cast("SettingsFlow", self._controller.navigator.flow("settings")).screen

    def _create_flow(self) -> SettingsFlow:
        from carpus.ui.screens.settings.flow import SettingsFlow
        from carpus.ui.screens.settings.screen import Preferences

        settings, context = self.settings, self._controller.context
        now = {name: getattr(getattr(settings, part), of) for name, (part, of) in SETTING_PATHS.items()}
        chosen = Preferences(data_folder=self._shown_folder, **now)
        return SettingsFlow(context, chosen, read_results)

    def _apply_start_mode(self) -> None:
        self._controller.live.screen.recording.start_mode = self.settings.recording.start

    def apply(self, chosen: Preferences) -> None:
        other_language = chosen.language != self.settings.screen.language
        if other_language and (why := self.find_language_obstacle()):
            self.screen.revert_language(self.settings.screen.language, why)
            return
        before = settings = self.settings
        for name, (part, of) in SETTING_PATHS.items():
            changed = replace(getattr(settings, part), **{of: getattr(chosen, name)})
            settings = replace(settings, **{part: changed})
        if chosen.data_folder != self._shown_folder:
            self._shown_folder = chosen.data_folder
            settings = replace(settings, recording=replace(settings.recording, folder=chosen.data_folder))
        self.settings = settings
        self._theme.choose(self._resolve_theme(self.settings), chosen.text_scale)
        self._controller.navigator.show_research(on=chosen.research)
        if "live" in self._controller.navigator.flows:
            self._apply_start_mode()
        self._share_settings()
        self._controller.context.patient_sound = chosen.patient_sound
        self._save_changes(before)
        if other_language:
            self.language_chosen.emit()

    def _share_settings(self) -> None:
        settings, controller = self.settings, self._controller
        controller.settings = replace(controller.settings, report=settings.report, stream=settings.stream)
        controller.context.report_settings = settings.report

    def choose_therapist(self, initials: str) -> None:
        """Apply and save who works now."""
        self.save(report=replace(self.settings.report, therapist=initials))
        self._share_settings()

    def _save_changes(self, before: Settings) -> None:
        if self._is_demo:
            return
        try:
            save_preferences(before, self.settings, self._folder)
        except CarpusFault as fault:
            self._controller.messages.show_fault(fault)

    def save(
        self,
        **changed: BackupSettings
        | RecordsSettings
        | LockSettings
        | ReportSettings
        | WelcomeSettings
        | PracticeSystemSettings,
    ) -> None:
        """Save sections of the settings that a card of its own has changed."""
        before, self.settings = self.settings, replace(self.settings, **changed)  # type: ignore[arg-type]
        self._save_changes(before)

    def follow_system(self) -> None:
        """Follow a change between light and dark."""
        self._theme.choose(self._resolve_theme(self.settings))

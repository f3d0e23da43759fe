"""The settings screen: shows what is chosen, acts at once where it can, and stores it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject

from app import __version__
from app.desktop.journey import Journey
from app.settings import ReportSettings, ScreenSettings, Settings, keep_preferences
from core.errors import CarpusFault
from ui.ports import Preferences
from ui.settings.screen import SettingsScreen
from ui.theme import Theme, ThemeName


class PreferenceKeeper(QObject):
    """Keeps the window's choices; keys and data folder count from the next start on."""

    def __init__(
        self,
        journey: Journey,
        theme: Theme,
        settings: Settings,
        folder: Path | None,
        theme_of: Callable[[Settings], ThemeName],
    ) -> None:
        super().__init__(journey)
        self._journey, self._theme, self._settings = journey, theme, settings
        self._folder, self._theme_of = folder, theme_of
        chosen = Preferences(
            settings.screen.theme,
            settings.screen.text_scale,
            str(settings.data_folder),
            settings.report.therapist,
            settings.screen.keys,
        )
        self.screen = SettingsScreen(theme, chosen, __version__)
        self._shown_folder = chosen.data_folder
        self.screen.changed.connect(self.take)
        self.screen.done.connect(journey.back)
        journey.settings_wanted.connect(lambda: journey.aside("settings", self.screen))

    def take(self, chosen: Preferences) -> None:
        """Something was changed."""
        recording = self._settings.recording
        if chosen.data_folder != self._shown_folder:
            recording = replace(recording, folder=chosen.data_folder)
        self._settings = replace(
            self._settings,
            screen=ScreenSettings(chosen.theme, chosen.text_scale, chosen.keys),
            recording=recording,
            report=ReportSettings(chosen.therapist),
        )
        self._theme.choose(self._theme_of(self._settings), chosen.text_scale)
        self._journey.settings = replace(self._journey.settings, report=self._settings.report)
        try:
            keep_preferences(self._settings, self._folder)
        except CarpusFault as fault:
            self._journey.teller.fault(fault)

    def follow_system(self) -> None:
        """The system changed between light and dark."""
        self._theme.choose(self._theme_of(self._settings))

"""The settings screen: shows what is chosen, acts at once where it can, and stores it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, cast

from PySide6.QtCore import QObject, Signal

from carpus.app.desktop.journey import Journey
from carpus.app.of_file import read_figures
from carpus.app.settings import (
    FirstStartSettings,
    LockSettings,
    RecordsSettings,
    Settings,
    keep_preferences,
)
from carpus.core.errors import CarpusFault
from carpus.core.records.values import BackupSettings
from carpus.ui.ports import Preferences
from carpus.ui.theme import Theme, ThemeName

if TYPE_CHECKING:
    from carpus.ui.settings.flow import SettingsFlow
    from carpus.ui.settings.screen import SettingsScreen


PLACES = {
    "theme": ("screen", "theme"), "text_scale": ("screen", "text_scale"), "language": ("screen", "language"),
    "research": ("screen", "research"), "therapist": ("report", "therapist"), "angle_order": ("report", "angle_order"),
    "stream": ("stream", "on"), "patient_sound": ("patient", "sound"), "start": ("recording", "start"),
}  # fmt: skip
"""Where in the settings each preference stands: the part, and its field."""


class PreferenceKeeper(QObject):
    """Keeps the window's choices; the data folder counts from the next start on. ``language_chosen``: the window
    is to be put together again in another language."""

    language_chosen = Signal()

    def __init__(
        self,
        journey: Journey,
        theme: Theme,
        settings: Settings,
        folder: Path | None,
        theme_of: Callable[[Settings], ThemeName],
        *,
        is_demo: bool = False,
    ) -> None:
        """Of a demo nothing is stored: its settings are not those of the clinic."""
        super().__init__(journey)
        self._is_demo = is_demo
        self._journey, self._theme, self._settings = journey, theme, settings
        self._folder, self._theme_of = folder, theme_of
        self.keeps_language: Callable[[], str] = str
        """Asked before the language changes: why it cannot now; empty where it can."""
        self._shown_folder = str(settings.data_folder)
        way = journey.way
        way.makers["settings"] = self._make_flow
        way.when_made("settings", lambda: self.screen.changed.connect(self.take))
        way.when_made("live", self._tell_start)
        way.show_research(on=settings.screen.research)

    @property
    def screen(self) -> SettingsScreen:
        return cast("SettingsFlow", self._journey.way.flow("settings")).screen

    def _make_flow(self) -> SettingsFlow:
        from carpus.ui.settings.flow import SettingsFlow

        settings, context = self._settings, self._journey.context
        now = {name: getattr(getattr(settings, part), of) for name, (part, of) in PLACES.items()}
        chosen = Preferences(data_folder=self._shown_folder, **now)
        return SettingsFlow(context, chosen, settings.updates.folder, read_figures)

    def _tell_start(self) -> None:
        self._journey.live.screen.recording.start_mode = self._settings.recording.start

    def take(self, chosen: Preferences) -> None:
        other_language = chosen.language != self._settings.screen.language
        if other_language and (why := self.keeps_language()):
            self.screen.keep_language(self._settings.screen.language, why)
            return
        before = settings = self._settings
        for name, (part, of) in PLACES.items():
            changed = replace(getattr(settings, part), **{of: getattr(chosen, name)})
            settings = replace(settings, **{part: changed})
        if chosen.data_folder != self._shown_folder:
            self._shown_folder = chosen.data_folder
            settings = replace(settings, recording=replace(settings.recording, folder=chosen.data_folder))
        self._settings = settings
        self._theme.choose(self._theme_of(self._settings), chosen.text_scale)
        self._journey.way.show_research(on=chosen.research)
        if "live" in self._journey.way.flows:
            self._tell_start()
        self._journey.settings = replace(
            self._journey.settings,
            report=self._settings.report,
            stream=self._settings.stream,
        )
        self._journey.context.report = self._settings.report
        self._journey.context.patient_sound = chosen.patient_sound
        self._store(before)
        if other_language:
            self.language_chosen.emit()

    @property
    def settings(self) -> Settings:
        return self._settings

    @property
    def first_start_answered(self) -> bool:
        """Whether what the first start offers was answered before."""
        return self._settings.first_start.answered

    def _store(self, before: Settings) -> None:
        if self._is_demo:
            return
        try:
            keep_preferences(before, self._settings, self._folder)
        except CarpusFault as fault:
            self._journey.messages.fault(fault)

    def keep(self, **changed: BackupSettings | RecordsSettings | LockSettings | FirstStartSettings) -> None:
        """Store the parts of the settings that a card of its own has changed."""
        before, self._settings = self._settings, replace(self._settings, **changed)  # type: ignore[arg-type]
        self._store(before)

    def follow_system(self) -> None:
        """The system changed between light and dark."""
        self._theme.choose(self._theme_of(self._settings))

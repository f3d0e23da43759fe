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
    PatientSettings,
    RecordsSettings,
    ScreenSettings,
    Settings,
    StreamSettings,
    keep_preferences,
)
from carpus.core.errors import CarpusFault
from carpus.core.records.values import BackupSettings
from carpus.ui.ports import Preferences
from carpus.ui.theme import Theme, ThemeName

if TYPE_CHECKING:
    from carpus.ui.settings.flow import SettingsFlow
    from carpus.ui.settings.screen import SettingsScreen


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
        chosen = Preferences(
            settings.screen.theme,
            settings.screen.text_scale,
            self._shown_folder,
            settings.report.therapist,
            settings.report.angle_order,
            settings.stream.on,
            settings.patient.sound,
            settings.screen.language,
            settings.screen.research,
            settings.recording.start,
        )
        return SettingsFlow(context, chosen, settings.updates.folder, read_figures)

    def _tell_start(self) -> None:
        self._journey.live.screen.recording.start_mode = self._settings.recording.start

    def take(self, chosen: Preferences) -> None:
        other_language = chosen.language != self._settings.screen.language
        if other_language and (why := self.keeps_language()):
            self.screen.keep_language(self._settings.screen.language, why)
            return
        before = self._settings
        recording = replace(before.recording, start=chosen.start)
        if chosen.data_folder != self._shown_folder:
            self._shown_folder = chosen.data_folder
            recording = replace(recording, folder=chosen.data_folder)
        self._settings = replace(
            self._settings,
            screen=ScreenSettings(chosen.theme, chosen.text_scale, chosen.language, chosen.research),
            recording=recording,
            report=replace(
                self._settings.report,
                therapist=chosen.therapist,
                angle_order=chosen.angle_order,
            ),
            stream=StreamSettings(chosen.stream),
            patient=PatientSettings(chosen.patient_sound),
        )
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

    def keep(
        self,
        *,
        backup: BackupSettings | None = None,
        records: RecordsSettings | None = None,
        lock: LockSettings | None = None,
        first_start: FirstStartSettings | None = None,
    ) -> None:
        """Store what a card of its own has changed."""
        now = self._settings
        self._settings = replace(
            now, backup=backup or now.backup, records=records or now.records, lock=lock or now.lock,
            first_start=first_start or now.first_start,
        )  # fmt: skip
        self._store(now)

    def follow_system(self) -> None:
        """The system changed between light and dark."""
        self._theme.choose(self._theme_of(self._settings))

"""The flow of the settings: shown beside the way, at the part that is asked for."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import QDialog, QPlainTextEdit, QWidget

from carpus.core.about import licence_texts, newest_version
from carpus.core.measures.change import ErrorLimits
from carpus.ui.background import Background
from carpus.ui.controls.layouts import in_column
from carpus.ui.controls.text import Text
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.ports import Preferences
from carpus.ui.settings.screen import PartName, SettingsScreen
from carpus.ui.theme import MARGIN_PX, Theme


class SettingsFlow(Flow):
    """What a person chooses for the program. ``updates`` is the clinic's folder of packages, empty for none."""

    place, guide = "settings", "data"
    screen: SettingsScreen

    def __init__(self, context: ScreenContext, chosen: Preferences, measured: ErrorLimits, updates: str) -> None:
        super().__init__(context, SettingsScreen(context.theme, chosen, context.version, measured))
        self._updates, self._background = updates, Background()
        self.screen.back.clicked.connect(context.way.back)
        self.screen.licences.clicked.connect(lambda: LicencesWindow(self.screen, context.theme, licence_texts()).exec())

    def show(self, part: PartName | None = None) -> None:
        """Where help and settings can be opened now; as it was left, or at a part."""
        if part is not None:
            self.screen.choose(part)
        self.context.way.aside("settings")
        self._look_for_newer()

    def _look_for_newer(self) -> None:
        """Where the clinic named a folder of packages, and nowhere else."""
        folder, screen = self._updates, self.screen
        if folder:
            self._background.run(
                lambda: newest_version(Path(folder).expanduser()),
                lambda newest: screen.show_newest(folder, newest),
                lambda _: screen.show_newest(folder, None),
                screen,
            )


class LicencesWindow(QDialog):
    """A window of its own with a long text; Esc closes it."""

    def __init__(self, parent: QWidget, theme: Theme, text: str) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Parts and their licences"))
        self.text = QPlainTextEdit(text)
        self.text.setReadOnly(True)
        self.text.setAccessibleName(self.windowTitle())
        words = self.tr("The licences are legal texts, and stay in the language that they were written in.")
        margins = (MARGIN_PX, MARGIN_PX, MARGIN_PX, MARGIN_PX)
        in_column(Text(theme, words, 14, wrap=True), (self.text, 1), margins=margins, within=self)
        self.resize(theme.px(860), theme.px(600))

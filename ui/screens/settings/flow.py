"""Controller of the settings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtWidgets import QDialog, QFileDialog, QPlainTextEdit, QWidget

from carpus.core.measures.change_limits import RetestStudy
from carpus.core.model.errors import CarpusFault, StudyUnsuited
from carpus.core.platform.about import licence_texts
from carpus.core.records.clinic_records import save_limits
from carpus.core.research.agreement.retest import RetestAnalysis, analyse_retests
from carpus.core.results.session_results import SessionResults
from carpus.ui.kit.background import Background
from carpus.ui.kit.layouts import column_layout
from carpus.ui.kit.text import Text
from carpus.ui.kit.theme import MARGIN_PX, Theme
from carpus.ui.screens.settings.retest_dialog import RetestDialog
from carpus.ui.screens.settings.screen import Preferences, SettingsPage, SettingsScreen
from carpus.ui.shell.flow import Flow, ScreenContext

ReadResultsFunction = Callable[[Sequence[Path], Callable[[CarpusFault], object]], list[tuple[Path, SessionResults]]]
"""Reads sessions of files and folders, and reports those that cannot be read."""


class SettingsFlow(Flow):
    """Controller of the settings."""

    screen_name, guide_page = "settings", "data"
    screen: SettingsScreen

    def __init__(self, context: ScreenContext, chosen: Preferences, read_results: ReadResultsFunction) -> None:
        measured = context.library.error_limits
        super().__init__(context, SettingsScreen(context.theme, chosen, measured))
        self.screen.demo_notice.setVisible(context.is_demo)
        self._background, self._read_results = Background(), read_results
        self.retest_dialog = RetestDialog(context.window, context.theme)
        self.retest_dialog.accepted.connect(self._apply_limits)
        self.screen.retest_button.clicked.connect(self._compute_limits)
        self.screen.done_button.clicked.connect(context.navigator.navigate_back)
        self.screen.licences_button.clicked.connect(
            lambda: LicencesWindow(self.screen, context.theme, licence_texts()).exec()
        )

    def open(self, part: SettingsPage | None = None) -> None:
        """Show the settings as left, or at a page."""
        if part is not None:
            self.screen.show_page(part)
        self.context.navigator.open_overlay("settings")

    def _compute_limits(self) -> None:
        """Compute MDC95 from the sessions of a folder, in the background."""
        places, shell = self.context.recent_locations, self.context.window
        title = self.tr("Folder with the test–retest sessions")
        folder = QFileDialog.getExistingDirectory(shell, title, places.folder("exports"))
        if not folder:
            return
        self.screen.show_computing(on=True)
        unreadable: list[CarpusFault] = []

        def work() -> list[RetestAnalysis]:
            found = self._read_results([Path(folder)], unreadable.append)
            if not found:
                raise StudyUnsuited(folder, "no session can be read")
            return analyse_retests([one for _, one in found])

        def on_done(found: list[RetestAnalysis]) -> None:
            self.screen.show_computing(on=False)
            self.retest_dialog.show_studies(found, len(unreadable), self.context.today())

        def on_failed(fault: Exception) -> None:
            self.screen.show_computing(on=False)
            self.context.messages.show_fault(fault)

        self._background.run(work, on_done, on_failed, self.screen)

    def _apply_limits(self, studies: Sequence[RetestStudy]) -> None:
        library = self.context.library

        def work() -> None:
            save_limits(library.folder, studies)
            library.reload_error_limits()

        self.run(work, lambda _: self.screen.show_limits(library.error_limits))


class LicencesWindow(QDialog):
    """Window with a long text; Esc closes it."""

    def __init__(self, parent: QWidget, theme: Theme, text: str) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Components and licences"))
        self.text = QPlainTextEdit(text)
        self.text.setReadOnly(True)
        self.text.setAccessibleName(self.windowTitle())
        words = self.tr("The licences are legal texts and are shown in their original language.")
        margins = (MARGIN_PX, MARGIN_PX, MARGIN_PX, MARGIN_PX)
        column_layout(Text(theme, words, 14, wrap=True), (self.text, 1), margins=margins, parent=self)
        self.resize(theme.px(860), theme.px(600))

"""The flow of the settings: shown beside the way, at the part that is asked for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtWidgets import QDialog, QFileDialog, QPlainTextEdit, QWidget

from carpus.core.about import licence_texts, newest_version
from carpus.core.agreement.limits_file import store_limits
from carpus.core.agreement.retest import StudyFigures, studies
from carpus.core.errors import CarpusFault
from carpus.core.measures.change import RetestStudy
from carpus.core.results.figures import SessionFigures
from carpus.ui.background import Background
from carpus.ui.controls.layouts import in_column
from carpus.ui.controls.text import Text
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.ports import Preferences
from carpus.ui.settings.retest import RetestSheet
from carpus.ui.settings.screen import PartName, SettingsScreen
from carpus.ui.theme import MARGIN_PX, Theme

ReadFigures = Callable[[Sequence[Path], Callable[[CarpusFault], object]], tuple[list[SessionFigures], dict[str, str]]]
"""Reads sessions of files and folders; hears of those that cannot be read."""


class SettingsFlow(Flow):
    """What a person chooses for the program. ``updates`` is the clinic's folder of packages, empty for none."""

    place, guide = "settings", "data"
    screen: SettingsScreen

    def __init__(self, context: ScreenContext, chosen: Preferences, updates: str, read_figures: ReadFigures) -> None:
        measured = context.library.error_limits
        super().__init__(context, SettingsScreen(context.theme, chosen, measured))
        self.screen.of_demo.setVisible(context.is_demo)
        self._updates, self._background, self._read_figures = updates, Background(), read_figures
        self.retest = RetestSheet(context.shell, context.theme)
        self.retest.accepted.connect(self._use_limits)
        self.screen.retest.clicked.connect(self._ask_sessions)
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

    def _ask_sessions(self) -> None:
        """Compute error limits from the sessions of a folder, beside the window."""
        places, shell = self.context.places, self.context.shell
        title = self.tr("Folder of the test-retest sessions")
        folder = QFileDialog.getExistingDirectory(shell, title, places.folder("exports"))
        if not folder:
            return
        self.screen.show_computing(on=True)
        unreadable: list[CarpusFault] = []

        def work() -> list[StudyFigures]:
            return studies(*self._read_figures([Path(folder)], unreadable.append))

        def done(found: list[StudyFigures]) -> None:
            self.screen.show_computing(on=False)
            self.retest.begin(found, len(unreadable), self.context.today())

        def failed(fault: Exception) -> None:
            self.screen.show_computing(on=False)
            self.context.messages.fault(fault)

        self._background.run(work, done, failed, self.screen)

    def _use_limits(self, studies: Sequence[RetestStudy]) -> None:
        library = self.context.library

        def work() -> None:
            store_limits(library.folder, studies)
            library.limits_changed()

        self.run(work, lambda _: self.screen.show_limits(library.error_limits))


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

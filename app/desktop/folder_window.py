"""A window for a data folder that cannot be used: the reason, and the choice of another one."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QEventLoop
from PySide6.QtWidgets import QApplication, QFileDialog

from carpus.app.desktop.appearance import apply_appearance
from carpus.app.settings import Settings
from carpus.core.model.errors import CarpusFault
from carpus.core.model.fault_text import MessageText
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.shell.main_window import MainWindow
from carpus.ui.shell.messages import Answer, MessageDialog
from carpus.ui.words.fault_words import fault_words


def choose_data_folder(qt: QApplication, settings: Settings, fault: CarpusFault) -> Path | None:
    """Show why the data folder cannot be used; return another one, None to quit."""
    theme = apply_appearance(qt, settings)
    return FolderWindow(theme, fault_words(fault), Path.home()).run()


class FolderWindow:
    """A card in an empty window; ``chosen_folder`` is None if it was closed."""

    def __init__(self, theme: Theme, words: MessageText, start: Path) -> None:
        self.chosen_folder: Path | None = None
        self._start = start
        self.shell = MainWindow(theme)
        self.shell.top_bar.help_button.hide()
        self.shell.top_bar.settings_button.hide()
        self.card = MessageDialog(self.shell.screen_stack, theme)
        self._words = words
        self._loop = QEventLoop()
        self.shell.closing.connect(self._loop.quit)

    def run(self) -> Path | None:
        """Show the window and wait for the answer."""
        self.shell.show()
        self._show_card()
        self._loop.exec()
        self.shell.hide()
        self.shell.deleteLater()
        return self.chosen_folder

    def _show_card(self) -> None:
        answers = Answer(tr("Close Carpus"), self.shell.close), Answer(tr("Choose another folder"), self._choose_folder)
        self.card.show_words(self._words, answers)

    def _choose_folder(self) -> None:
        named = QFileDialog.getExistingDirectory(self.shell, tr("Folder of patients and sessions"), str(self._start))
        if not named:
            self._show_card()
            return
        self.chosen_folder = Path(named)
        self._loop.quit()

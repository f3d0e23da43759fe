"""A window of its own where the data folder cannot be used: why, and which other one is to be."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QEventLoop
from PySide6.QtWidgets import QApplication, QFileDialog

from carpus.app.desktop.looks import dressed
from carpus.app.settings import Settings
from carpus.core.errors import CarpusFault
from carpus.core.words import Words
from carpus.ui.fault_words import fault_words
from carpus.ui.messages.messages import Answer, StopCard
from carpus.ui.shell import Shell
from carpus.ui.theme import Theme
from carpus.ui.translate import tr


def ask_for_folder(qt: QApplication, settings: Settings, fault: CarpusFault) -> Path | None:
    """Tell why the data folder cannot be used; the folder the person chose instead, None to end."""
    theme = dressed(qt, settings)
    return NoFolder(theme, fault_words(fault), Path.home()).ask()


class NoFolder:
    """A card in an empty window. ``chosen`` is the folder that the person named, None when they closed the window."""

    def __init__(self, theme: Theme, words: Words, start: Path) -> None:
        self.chosen: Path | None = None
        self._start = start
        self.shell = Shell(theme)
        self.shell.bar.help_button.hide()
        self.shell.bar.settings_button.hide()
        self.card = StopCard(self.shell.stage, theme)
        self._words = words
        self._loop = QEventLoop()
        self.shell.closing.connect(self._loop.quit)

    def ask(self) -> Path | None:
        """Show it and wait for the answer."""
        self.shell.show()
        self._show()
        self._loop.exec()
        self.shell.hide()
        self.shell.deleteLater()
        return self.chosen

    def _show(self) -> None:
        answers = Answer(tr("Close Carpus"), self.shell.close), Answer(tr("Choose another folder"), self._choose)
        self.card.show_words(self._words, answers)

    def _choose(self) -> None:
        named = QFileDialog.getExistingDirectory(self.shell, tr("Folder of patients and sessions"), str(self._start))
        if not named:
            self._show()
            return
        self.chosen = Path(named)
        self._loop.quit()

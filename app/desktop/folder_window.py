"""A window for a data folder that cannot be used: the reason, and the choice of another one."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QEventLoop
from PySide6.QtWidgets import QApplication, QFileDialog

from carpus.app.desktop.appearance import apply_appearance
from carpus.app.settings import Settings
from carpus.core.model.errors import CarpusFault
from carpus.ui.kit.translate import tr
from carpus.ui.shell.main_window import MainWindow
from carpus.ui.shell.messages import Answer, MessageDialog
from carpus.ui.words.fault_words import fault_words


def choose_data_folder(qt: QApplication, settings: Settings, fault: CarpusFault) -> Path | None:
    """Show why the data folder cannot be used; return another one, None to quit."""
    theme = apply_appearance(qt, settings)
    shell, loop, chosen = MainWindow(theme), QEventLoop(), list[Path]()
    shell.top_bar.help_button.hide()
    shell.top_bar.settings_button.hide()
    shell.closing.connect(loop.quit)
    card = MessageDialog(shell.screen_stack, theme)

    def show_card() -> None:
        answers = Answer(tr("Close Carpus"), shell.close), Answer(tr("Choose another folder"), choose_folder)
        card.show_words(fault_words(fault), answers)

    def choose_folder() -> None:
        named = QFileDialog.getExistingDirectory(shell, tr("Folder of patients and sessions"), str(Path.home()))
        if not named:
            show_card()
            return
        chosen.append(Path(named))
        loop.quit()

    shell.show()
    show_card()
    loop.exec()
    shell.hide()
    shell.deleteLater()
    return chosen[0] if chosen else None

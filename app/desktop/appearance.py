"""Typeface, style, language and theme of the window."""

from __future__ import annotations

import os
import sys

from PySide6.QtCore import Qt
from PySide6.QtGui import QPixmap
from PySide6.QtWidgets import QApplication, QSplashScreen

from carpus.app.settings import Settings
from carpus.core.platform.version import __version__
from carpus.ui.kit import language
from carpus.ui.kit.fonts import load_fonts
from carpus.ui.kit.icons import program_icon_image
from carpus.ui.kit.style import apply_style
from carpus.ui.kit.theme import Theme, ThemeName


def create_application(arguments: list[str]) -> QApplication:
    """Return the Qt application with the bundled typeface and Qt's plain style."""
    if sys.platform == "linux" and os.environ.get("QT_QPA_PLATFORM") != "offscreen":
        # The desktop's own file dialog, on GNOME as on KDE; where no portal answers, Qt shows its own.
        os.environ.setdefault("QT_QPA_PLATFORMTHEME", "xdgdesktopportal")
    running = QApplication.instance()
    qt = running if isinstance(running, QApplication) else QApplication(arguments)
    qt.setApplicationName("Carpus")
    qt.setDesktopFileName("carpus")
    qt.setApplicationVersion(__version__)
    qt.setWindowIcon(QPixmap.fromImage(program_icon_image(256)))
    qt.setStyle("Fusion")
    load_fonts()
    return qt


def show_splash(qt: QApplication) -> QSplashScreen:
    """Show the program's icon until its window is there."""
    splash = QSplashScreen(qt.windowIcon().pixmap(160))
    splash.show()
    qt.processEvents()
    return splash


def apply_appearance(qt: QApplication, settings: Settings) -> Theme:
    """Apply language, theme and style of the settings."""
    language.set_window_language(settings.screen.language)
    theme = Theme(theme_name(qt, settings), settings.screen.text_scale)
    apply_style(qt, theme)
    return theme


def theme_name(qt: QApplication, settings: Settings) -> ThemeName:
    """Return the chosen theme, or that of the system."""
    if settings.screen.theme != "system":
        return settings.screen.theme
    return "dark" if qt.styleHints().colorScheme() == Qt.ColorScheme.Dark else "light"

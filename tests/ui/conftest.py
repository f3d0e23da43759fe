"""Every test here runs without a display and with the bundled fonts only."""

from __future__ import annotations

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import pytest
from PySide6.QtCore import QLocale
from PySide6.QtWidgets import QApplication

from carpus.ui.fonts import load_fonts
from carpus.ui.style import apply_style
from carpus.ui.theme import Theme


@pytest.fixture(autouse=True)
def _bundled_fonts(qapp: QApplication) -> None:
    qapp.setStyle("Fusion")
    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    load_fonts()


@pytest.fixture
def theme(qapp: QApplication) -> Theme:
    """The light theme at 100 %, applied."""
    chosen = Theme("light")
    apply_style(qapp, chosen)
    return chosen

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
from tests.ui.fakes import figures_once


@pytest.fixture(autouse=True)
def _bundled_fonts(qapp: QApplication) -> None:
    qapp.setStyle("Fusion")
    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    load_fonts()


@pytest.fixture(autouse=True)
def _figures_made_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every screen and page of a session works out its figures anew, as each is shown once; here the same few are shown
    hundreds of times."""
    for place in ("report.pdf", "review.reviewed", "correct.screen", "correct.flow"):
        monkeypatch.setattr(f"carpus.ui.{place}.session_figures", figures_once)


@pytest.fixture
def theme(qapp: QApplication) -> Theme:
    """The light theme at 100 %, applied."""
    chosen = Theme("light")
    apply_style(qapp, chosen)
    return chosen

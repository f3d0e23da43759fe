"""The clinic's own error limits, wherever limits are named."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtWidgets import QWidget

from carpus.core.agreement.limits_file import LIMITS_FILE, store_limits
from carpus.core.errors import SettingsInvalid
from carpus.core.measures.change import ErrorLimits, MeasuredLimit, RetestStudy
from carpus.core.records.library import Library
from carpus.core.records.new_sessions import recover
from carpus.ui.controls.text import Text
from carpus.ui.ports import Preferences
from carpus.ui.report.words import method
from carpus.ui.settings.screen import SettingsScreen
from carpus.ui.theme import Theme
from carpus.ui.verdicts import limit_words
from tests.ui.fakes import figures_once, session

ARC = MeasuredLimit("flexion", "arc", 12, 2.4, (1.7, 3.9), 6.6, (4.7, 10.8))
STUDY = RetestStudy("wrist6", "WRIST_FE", "zyx", "2026-11-27", 12, 24, 2, (ARC, replace(ARC, movement="extension")))


def said(widget: QWidget) -> str:
    return " ".join(text.text() for text in widget.findChildren(Text))


def test_they_are_named_with_their_date_and_people(theme: Theme) -> None:
    words = limit_words(STUDY)
    assert "measured by this clinic on 27 Nov 2026 with 12 people" in words
    assert words in method(figures_once(session(), None, ErrorLimits((STUDY,))), 6, compared=True)
    few = replace(STUDY, limits=(replace(ARC, people=9),))
    assert limit_words() in method(figures_once(session(), None, ErrorLimits((few,))), 6, compared=True)
    shown = said(SettingsScreen(theme, Preferences(), "1", ErrorLimits((STUDY,))))
    for piece in (
        "On 27 Nov 2026 with 12 people in 24 sessions",
        "In force",
        "SEM 2.4°",
        "7° (4.7° – 10.8°)",
        "Extension",
    ):
        assert piece in shown
    assert "Not in force: 10 people" in said(SettingsScreen(theme, Preferences(), "1", ErrorLimits((few,))))
    assert "Measured by this clinic" not in said(SettingsScreen(theme, Preferences()))


def test_the_window_reads_them_from_the_data_folder(tmp_path: Path) -> None:
    store_limits(tmp_path, [STUDY])
    library = Library(tmp_path)
    assert library.error_limits.study("wrist6", "WRIST_FE", "zyx") == STUDY
    library.close()


@pytest.mark.parametrize("text", ["", "{}"])
def test_a_damaged_file_is_told_and_the_default_limits_hold(tmp_path: Path, text: str) -> None:
    (tmp_path / LIMITS_FILE).write_text(text, encoding="utf-8")
    library = Library(tmp_path)
    assert library.error_limits == ErrorLimits()
    _, faults = recover(library)
    assert [type(fault) for fault in faults] == [SettingsInvalid]
    library.close()

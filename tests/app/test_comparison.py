"""In the real window: two sessions are ticked, shown side by side and played."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, date, datetime, timedelta
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.app.desktop.window import Desktop
from carpus.core.records.log import read_log
from tests.records.samples import LINDEN, store_patient
from tests.research.agreement.test_retest import write_session

NOW = datetime(2026, 11, 20, 9, 0, tzinfo=UTC)
EARLIER = NOW - timedelta(days=7)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Flexion to and fro by 45 degrees, and a week before by 30."""
    folder = tmp_path_factory.mktemp("sessions")
    return write_session(folder, 1, 1, NOW, 45.0), write_session(folder, 1, 2, EARLIER, 30.0)


@pytest.fixture
def desktop(open_desktop: Callable[..., Desktop], recorded: tuple[Path, Path], tmp_path: Path) -> Desktop:
    patient = store_patient(tmp_path / "data", LINDEN, (recorded[0], NOW, ""), (recorded[1], EARLIER, ""))
    opened = open_desktop(today=date(2026, 11, 20))
    opened.controller.sessions.open(patient)
    return opened


def test_side_by_side_opens_from_two_ticks_and_returns(qtbot: QtBot, desktop: Desktop) -> None:
    journey, screen = desktop.controller, desktop.controller.comparison.screen
    shown_list = journey.sessions.screen.list
    qtbot.waitUntil(lambda: all(line.main_value for line in shown_list.session_model.lines))
    assert not journey.sessions.screen.pair_button.isEnabled()
    qtbot.keyClick(shown_list, Qt.Key.Key_Space)
    qtbot.keyClick(shown_list, Qt.Key.Key_Down)
    qtbot.keyClick(shown_list, Qt.Key.Key_Space)
    assert "Compare the 2 ticked sessions" in journey.sessions.screen.pair_button.text()
    qtbot.keyClick(shown_list, Qt.Key.Key_C)
    assert journey.place == "comparison"
    qtbot.waitUntil(lambda: screen.comparison is not None)
    assert screen.answer.text() == "The total arc has improved by 30° since 13 Nov."
    differences = [row[-1].text for row in screen.table.rows][:3]
    assert all("more, beyond MDC" in words for words in differences), differences

    start, starts = screen.playing.time_s, screen.timeline.starts_s
    assert start == starts[0]
    for key, expected in ((Qt.Key.Key_BracketRight, starts[1]), (Qt.Key.Key_BracketLeft, start)):
        qtbot.keyClick(screen, key)
        assert screen.playing.time_s == pytest.approx(expected)
    qtbot.keyClick(screen, Qt.Key.Key_Right)
    assert screen.playing.time_s > start
    qtbot.keyClick(screen, Qt.Key.Key_Space)
    playing_from = screen.playing.time_s
    qtbot.waitUntil(lambda: screen.playing.time_s > playing_from)
    qtbot.keyClick(screen, Qt.Key.Key_Space)
    journey.navigator.navigate_back()
    assert journey.place == "sessions"
    assert len(journey.sessions.screen.list.session_model.ticked) == 2, "they stay ticked"
    deeds = [entry.action for entry in read_log(desktop.library.store)]
    assert [deeds.count(did) for did in ("opened", "exported", "reported")] == [2, 0, 0]

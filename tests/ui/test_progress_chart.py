"""The chart of the sessions by mouse and keys: a point says what it is and opens its session."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest
from PySide6.QtCore import QPointF, Qt
from pytestqt.qtbot import QtBot

from carpus.core.results.progress import Progress, ProgressPoint, compute_progress
from carpus.ui.charts.progress import ProgressChart, panel_keys
from carpus.ui.kit.theme import Theme
from tests.ui.fakes import FakeSessions, figures_once, session
from tests.ui.test_plots import move


@pytest.fixture(scope="module")
def store() -> FakeSessions:
    return FakeSessions()


@pytest.fixture
def chart(qtbot: QtBot, theme: Theme, store: FakeSessions) -> Iterator[ProgressChart]:
    alike = [figures for figures in store.history("linden") if figures.side == "right"]
    chart = ProgressChart(theme)
    qtbot.addWidget(chart)
    chart.resize(864, 560)
    chart.show()
    chart.show_progress(compute_progress(sorted(alike, key=lambda figures: figures.when)))
    return chart


def place(chart: ProgressChart, number: int) -> QPointF:
    key = chart.plots[0].key
    return next(at for one, of, at in chart.points() if (one, of) == (number, key))


def test_progress_chart_point_has_date_value_and_remarks(chart: ProgressChart) -> None:
    for number in range(7):
        move(chart.mouse_target, QPointF(place(chart, number).toPoint()))
        assert chart.current_session == number
        assert chart.mouse_target.cursor().shape() == Qt.CursorShape.PointingHandCursor
    key = chart.plots[0].key
    newest = " · ".join(chart.describe_point(6, key))
    for word in ("20 Nov 2026", "Total arc", "±", "repetitions", "Camera 66 cm away", "stopped for pain"):
        assert word in newest, word
    far = " · ".join(chart.describe_point(3, key))
    assert "Camera 84 cm away" in far
    assert "further away" in far
    move(chart.mouse_target, QPointF(5.0, 300.0))
    assert chart.current_session == -1


def test_progress_chart_panels_include_older_ranges() -> None:
    older, newest = figures_once(session(session_id="older")), figures_once(session(session_id="newest"))
    fewer = replace(newest, measures=tuple(row for row in newest.measures if row.quantity != "extension"))
    progress = Progress((ProgressPoint(older, ()), ProgressPoint(fewer, ())), (), None)
    assert [key[1] for key in panel_keys(progress)] == ["arc", "flexion", "extension"]


def test_progress_chart_arrows_choose_and_enter_opens(qtbot: QtBot, chart: ProgressChart) -> None:
    chart.step(1)
    assert chart.current_session == 0
    for _ in range(9):
        chart.step(1)
    assert chart.current_session == 6
    chart.step(-1)
    with qtbot.waitSignal(chart.session_chosen) as opened:
        chart.choose_current()
    assert opened.args == ["session-6"]

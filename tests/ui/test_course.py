"""The chart of the sessions by mouse and keys: a point says what it is and opens its session."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from datetime import timedelta

import pytest
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QImage, QPainter
from pytestqt.qtbot import QtBot

from carpus.core.measures.manual_measurements import ManualValue
from carpus.core.results.progress import compute_progress
from carpus.ui.charts import progress
from carpus.ui.charts.progress import ProgressChart
from carpus.ui.charts.style import paper_style
from carpus.ui.kit.theme import Theme
from tests.ui.fakes import FakeSessions
from tests.ui.test_plots import drag, move


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
    key = chart.panels()[0][1]
    at_s = chart._progress.points[number].results.when.timestamp()
    plot = chart.plots[0]
    row = progress.find_session_measure(chart._progress, number, key)
    assert row is not None
    return QPointF(plot.scene_x(at_s), float(plot.panel.y(row.mean)))


def test_click_on_point_opens_its_session_and_one_next_to_it_nothing(qtbot: QtBot, chart: ProgressChart) -> None:
    opened: list[str] = []
    chart.session_chosen.connect(opened.append)
    at = place(chart, 2).toPoint()
    qtbot.mouseClick(chart.mouse_target, Qt.MouseButton.LeftButton, pos=at)
    assert opened == ["session-3"]
    at.setY(at.y() + 60)
    qtbot.mouseClick(chart.mouse_target, Qt.MouseButton.LeftButton, pos=at)
    assert opened == ["session-3"]


def test_point_under_mouse_says_date_value_set_up_and_remarks(chart: ProgressChart) -> None:
    for number in range(7):
        move(chart.mouse_target, QPointF(place(chart, number).toPoint()))
        assert chart.current_session == number
        assert chart.mouse_target.cursor().shape() == Qt.CursorShape.PointingHandCursor
    key = chart.panels()[0][1]
    newest = " · ".join(chart.describe_point(6, key))
    for word in ("20 Nov 2026", "Total arc", "±", "repetitions", "Camera 66 cm away", "stopped for pain"):
        assert word in newest, word
    far = " · ".join(chart.describe_point(3, key))
    assert "Camera 84 cm away" in far
    assert "further away" in far
    move(chart.mouse_target, QPointF(5.0, 300.0))
    assert chart.current_session == -1


def test_arrows_point_at_one_session_after_the_other_and_enter_opens_it(qtbot: QtBot, chart: ProgressChart) -> None:
    chart.step(1)
    assert chart.current_session == 0
    for _ in range(9):
        chart.step(1)
    assert chart.current_session == 6
    chart.step(-1)
    with qtbot.waitSignal(chart.session_chosen) as opened:
        chart.choose_current()
    assert opened.args == ["session-6"]


def test_time_is_to_scale_and_can_be_looked_into(qtbot: QtBot, chart: ProgressChart) -> None:
    times = [point.results.when for point in chart._progress.points]
    places = [place(chart, number).x() for number in range(7)]
    share = (places[1] - places[0]) / (places[6] - places[0])
    assert share == pytest.approx((times[1] - times[0]) / (times[6] - times[0]), abs=1e-6)
    chart.step(1)
    for _ in range(3):
        chart.zoom_in()
    start, end = chart.x_range()
    whole = chart.extent()
    assert end - start == pytest.approx((whole[1] - whole[0]) / 1.25**3)
    assert place(chart, 6).x() > chart.panels()[0][0].box.right()
    drag(qtbot, chart.mouse_target, QPointF(chart.panels()[0][0].box.center().toPoint()), -2000)
    assert chart.x_range()[1] == pytest.approx(whole[1])
    chart.show_all()
    assert chart.x_range() == whole
    for _ in range(60):
        chart.zoom_in()
    assert timedelta(seconds=chart.x_range()[1] - chart.x_range()[0]) >= timedelta(hours=23)


def test_table_has_row_for_each_point_that_is_shown(chart: ProgressChart) -> None:
    head, rows = chart.table()
    rows = list(rows)
    assert head[:3] == ["session", "when", "what"]
    assert len(rows) == 7 * len(chart.panels())
    assert [row[-1] for row in rows[:7]].count("no") == 1
    chart.step(1)
    for _ in range(6):
        chart.zoom_in()
    assert 0 < len(list(chart.table()[1])) < len(rows)


@pytest.mark.parametrize(("apart", "said"), [(timedelta(minutes=5), 1), (timedelta(days=20), 2)])
def test_figures_of_two_sessions_never_stand_on_each_other(
    chart: ProgressChart, store: FakeSessions, monkeypatch: pytest.MonkeyPatch, apart: timedelta, said: int
) -> None:
    alike = [figures for figures in store.history("linden") if figures.side == "right"]
    first, second = sorted(alike, key=lambda figures: figures.when)[:2]
    by_hand = ManualValue("FLEXION", "active", "right", first.when.date() + timedelta(days=30), (45.0,))
    two = compute_progress([first, replace(second, when=first.when + apart)])
    said_at: list[float] = []
    monkeypatch.setattr(chart, "_add_value", lambda *given: said_at.append(given[2]))
    chart.show_progress(replace(two, manual_measurements=(by_hand,)))
    chart.grab()
    panels = len(chart.panels())
    assert panels
    assert len(set(said_at)) == said
    assert len(said_at) % (said * panels) == 0


@pytest.mark.usefixtures("qapp")
def test_course_on_paper_has_a_square_for_each_value_by_hand(
    store: FakeSessions, monkeypatch: pytest.MonkeyPatch
) -> None:
    alike = [figures for figures in store.history("linden") if figures.side == "right"]
    days = sorted(figures.when.date() for figures in alike)
    by_hand = tuple(ManualValue("FLEXION", "active", "right", day, (45.0,)) for day in (days[0], days[-1]))
    squares: list[int] = []
    add_symbols = ProgressChart.add_symbols

    def count(chart: ProgressChart, symbol: str = "o", *given: object, **named: object) -> object:
        item = add_symbols(chart, symbol, *given, **named)
        squares.append(len(item.points()) if symbol == "s" else 0)
        return item

    monkeypatch.setattr(ProgressChart, "add_symbols", count)
    picture = QImage(800, 500, QImage.Format.Format_RGB32)
    with QPainter(picture) as painter:
        progress.paint_progress_chart(
            painter,
            paper_style(1.0),
            QRectF(picture.rect()),
            replace(compute_progress(alike), manual_measurements=by_hand),
        )
    assert sum(squares) == len(by_hand) + 1  # and one that says what they mean

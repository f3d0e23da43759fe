"""What a person does with a plot: zoom, move along, read off, copy and save; and that paper shows the same."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QGuiApplication, QImage, QMouseEvent, QPainter, QWheelEvent
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from carpus.core.model.errors import OutputNotWritable
from carpus.core.model.hand.exercises import get_exercise
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import ByteImage, FloatArray
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.session_results import compute_session_results
from carpus.core.results.valid_data import WristCurves, joint_curves, wrist_curves
from carpus.ui.charts.history import History
from carpus.ui.charts.live_curves import LiveCurves
from carpus.ui.charts.panel import Panel, Scale, screen_style
from carpus.ui.charts.series import Curve, Series, decimate, draw_curves
from carpus.ui.charts.session import SessionChart, SessionPlot
from carpus.ui.kit.numbers import format_with_sd
from carpus.ui.kit.theme import Theme
from tests.ui.fakes import FakeFeed, figures_once, session
from tests.ui.hand_fakes import hand_session

MINUTES_20_S = 1200.0


@pytest.fixture
def view(qtbot: QtBot, theme: Theme) -> Iterator[SessionChart]:
    stored = session()
    figures = figures_once(stored)
    view = SessionChart(theme)
    qtbot.addWidget(view)
    view.resize(900, 420)
    view.show()
    plot = SessionPlot(wrist_curves(stored), figures.exercise, figures.repetitions, 2, 40.0)
    view.show_plot(plot)
    return view


def center(view: SessionChart) -> QPointF:
    return QPointF(view.plots[0].panel.box.center().toPoint())


def move(face: QWidget, at: QPointF, button: Qt.MouseButton = Qt.MouseButton.NoButton) -> None:
    event = QMouseEvent(
        QEvent.Type.MouseMove, at, face.mapToGlobal(at), Qt.MouseButton.NoButton, button,
        Qt.KeyboardModifier.NoModifier,
    )  # fmt: skip
    QApplication.sendEvent(face, event)


def drag(qtbot: QtBot, face: QWidget, start: QPointF, by_px: int) -> None:
    qtbot.mousePress(face, Qt.MouseButton.LeftButton, pos=start.toPoint())
    for share in (0.5, 1.0):
        move(face, start + QPointF(share * by_px, 0.0), Qt.MouseButton.LeftButton)
    qtbot.mouseRelease(face, Qt.MouseButton.LeftButton, pos=start.toPoint() + QPoint(by_px, 0))


def wheel(
    face: QWidget, at: QPointF, turn: int, modifiers: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier
) -> bool:
    """Whether it was taken."""
    event = QWheelEvent(
        at, face.mapToGlobal(at), QPoint(), QPoint(0, turn), Qt.MouseButton.NoButton, modifiers,
        Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(face, event)
    return event.isAccepted()


def test_chart_drag_when_zoomed_moves_all_panels(qtbot: QtBot, view: SessionChart) -> None:
    view.show_window((20.0, 30.0))
    view.set_time(28.0)
    box = view.plots[0].panel.box
    drag(qtbot, view.mouse_target, center(view), -round(box.width() / 5))
    assert view._window == pytest.approx((22.0, 32.0), abs=0.1)
    drag(qtbot, view.mouse_target, center(view), 10 * round(box.width()))
    assert view._window == pytest.approx((0.0, 10.0), abs=1e-6), "no further than the beginning"
    assert [tuple(own.viewRange()[0]) for own in view.plots] == [pytest.approx(view._window)] * 3


def test_frame_is_of_print_size_drawing_of_lines_and_folder_that_is_not_there_is_reported(
    qtbot: QtBot, view: SessionChart, tmp_path: Path
) -> None:
    view.menu.save(tmp_path / "curves.png")
    image = QImage(str(tmp_path / "curves.png"))
    assert image.width() == round(170.0 / 25.4 * 300.0)
    assert image.dotsPerMeterX() == pytest.approx(300.0 / 0.0254, abs=1.0)
    assert pixels(image).std() > 5.0, "something is drawn"
    view.menu.save(tmp_path / "curves.svg")
    root = ElementTree.parse(tmp_path / "curves.svg").getroot()
    assert float(str(root.get("width")).removesuffix("mm")) == pytest.approx(170.0, abs=0.01)
    kinds = {element.tag.rpartition("}")[2] for element in root.iter()}
    assert {"polyline", "text"} <= kinds
    assert "image" not in kinds
    fixed = {
        group.get("stroke") for group in root.iter() for one in group if one.get("vector-effect", "none") != "none"
    }
    assert fixed <= {"none"}, "no line is as wide at any size"
    view.menu.copy_picture()
    assert QGuiApplication.clipboard().image().size() == image.size()
    with qtbot.waitSignal(view.menu.fault_raised) as told:
        view.menu.save(tmp_path / "none" / "curves.png")
    assert isinstance(told.args[0], OutputNotWritable)


def pixels(image: QImage) -> ByteImage:
    plain = image.convertToFormat(QImage.Format.Format_RGB32)
    raw = np.frombuffer(plain.constBits(), np.uint8).reshape(plain.height(), plain.bytesPerLine())
    return raw[:, : 4 * plain.width()].reshape(plain.height(), plain.width(), 4)[..., :3].copy()


def test_twenty_minutes_are_drawn_with_few_points_and_every_peak() -> None:
    time_s = np.arange(0.0, MINUTES_20_S, 1.0 / 30.0)
    angles = np.stack([40.0 * np.sin(time_s * (k + 1)) for k in range(3)], axis=1)
    angles[17_000, 1] = 83.0
    curves = WristCurves(time_s, angles, np.ones_like(angles), np.zeros(len(time_s), dtype=int))
    plot = SessionPlot(curves, get_exercise("WRIST_FE"), ())
    for window in ((0.0, MINUTES_20_S), (500.0, 900.0), (560.0, 570.0)):
        drawn = plot.visible_curves(1, 600, window)[0].series
        assert len(drawn.time_s) <= 3 * 600
        assert drawn.value.max() == 83.0
        assert not drawn.gaps_s()


def drawn_series(theme: Theme, series: Series, start_s: float, end_s: float, ratio: float) -> FloatArray:
    image = QImage(round(600 * ratio), round(200 * ratio), QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(ratio)
    image.fill(QColor("white"))
    painter = QPainter(image)
    panel = Panel(QRectF(0, 0, 600, 200), Scale(-90.0, 90.0, (), ()), start_s, end_s)
    draw_curves(painter, screen_style(theme), panel, [Curve(series, "flexion")])
    painter.end()
    return pixels(image)[..., :3].astype(np.float64)


@pytest.mark.parametrize("on_pixels", [True, False])
@pytest.mark.parametrize("seen", [range(100), range(7, 8), range(0)])
def test_chart_curve_points_lie_on_data(
    qapp: QApplication, theme: Theme, monkeypatch: pytest.MonkeyPatch, seen: range, on_pixels: bool
) -> None:
    """As pieces on pixels and as lines on paper, half of it dashed, all but one piece, or all."""
    monkeypatch.setattr("carpus.ui.charts.series._is_raster", lambda painter: on_pixels)
    time_s = np.arange(0.0, 30.0, 0.15)
    predicted = ~np.isin(np.arange(len(time_s)), seen)
    ink = drawn_series(theme, Series(time_s, 3.0 * time_s - 45.0, None, predicted), 0.0, 30.0, 1.0).min(axis=2) < 200
    down, across = np.nonzero(ink)
    expected = 100.0 - (0.05 * 3.0 * across - 45.0) * 200.0 / 180.0
    assert np.abs(down - expected).max() < 4.0
    reached = np.histogram(across, bins=20, range=(0, 600))[0]
    assert (reached > 20).all(), "no stretch of it is left out"


def test_chart_ignores_mouse_during_recording(qtbot: QtBot, theme: Theme) -> None:
    feed, history = FakeFeed(), History(WRIST6)
    curves = LiveCurves(theme, history)
    qtbot.addWidget(curves)
    curves.resize(696, 396)
    curves.show()
    history.append(feed.frames[:300])
    curves.draw()
    before = [box.viewRange() for box in curves.plots]
    at = QPointF(curves.plots[0].panel.box.center().toPoint())
    for turn in (120, -120):
        wheel(curves.mouse_target, at, turn)
    drag(qtbot, curves.mouse_target, at, 80)
    qtbot.mouseClick(curves.mouse_target, Qt.MouseButton.RightButton, pos=at.toPoint())
    assert [box.viewRange() for box in curves.plots] == before
    assert QApplication.activePopupWidget() is None


def test_angle_that_no_joint_can_have_is_gap_in_review_and_values() -> None:
    session = hand_session()
    angles = session.motion.joint_angles_rad.copy()
    angles[600:602] = np.radians(-3627.0)  # as after pictures were missing for twelve seconds
    broken = replace(session, motion=replace(session.motion, joint_angles_rad=angles))
    curves = joint_curves(broken)
    assert np.isnan(curves.angles_deg[600:602]).all()
    assert not curves.is_valid[600:602].any()
    assert np.nanmin(curves.angles_deg) > -60.0
    figures = compute_session_results(broken, RepetitionChoices({}))
    for row in (*figures.wrist_ranges, *figures.joint_ranges):
        for value in (row.mean, row.sd, row.best):
            assert not abs(value) > 400.0, row.key


def test_thinning_keeps_extremes_gaps_and_ends() -> None:
    rng = np.random.default_rng(2)
    value = rng.normal(0, 1, 20_000).cumsum()
    value[5_000:5_040] = math.nan
    value[12_345] = 9_999.0
    whole = Series(np.arange(20_000) / 30.0, value, np.abs(value) * 0.01, np.zeros(20_000, bool))
    thin = decimate(whole, 400)
    assert len(thin.time_s) <= 3 * 400
    assert np.nanmax(thin.value) == 9_999.0
    assert np.nanmin(thin.value) == np.nanmin(value)
    assert np.isnan(thin.value).any()
    assert thin.sd is not None
    assert np.all(np.diff(thin.time_s) > 0)
    assert decimate(thin, 4_000) is thin
    for seconds in (130.0, 400.0):  # frames that lack are the only gap
        time_s = np.arange(0.0, seconds, 1 / 30)
        time_s = time_s[(time_s < 50.0) | (time_s > 62.6)]
        value = 40.0 * np.sin(time_s)
        (gap,) = decimate(Series(time_s, value, np.ones_like(value), np.zeros(len(value), dtype=bool)), 500).gaps_s()
        assert gap == pytest.approx((50.0, 62.6), abs=1.0)


def test_chart_wheel_scrolls_pans_or_zooms(view: SessionChart) -> None:
    assert not wheel(view.mouse_target, center(view), 120), "the page that it lies on scrolls"
    assert view._window is None
    assert wheel(view.mouse_target, center(view), 120, Qt.KeyboardModifier.ControlModifier)
    assert view._window is not None
    view.show_window((20.0, 30.0))
    wheel(view.mouse_target, center(view), -120, Qt.KeyboardModifier.ShiftModifier)
    assert view._window == pytest.approx((21.0, 31.0))


def test_keys_zoom_about_the_cursor_and_show_all(view: SessionChart) -> None:
    view.set_time(10.0)
    view.zoom_in()
    start_s, end_s = view.x_range()
    whole = view.extent()
    assert end_s - start_s == pytest.approx(whole[1] / 1.25)
    assert (10.0 - start_s) / (end_s - start_s) == pytest.approx(10.0 / whole[1])
    for _ in range(40):
        view.zoom_in()
    assert np.ptp(view.x_range()) == pytest.approx(2.0)
    view.show_all()
    assert view._window is None


def test_session_chart_zoomed_to_repetitions_greys_what_lies_before_and_after(view: SessionChart) -> None:
    plot = view._plot
    some = plot.repetitions[2:5]
    view.show_plot(replace(plot, repetitions=some, current=1))
    view.show_repetitions()
    assert view._window == pytest.approx((some[0].start_s - 1.0, some[-1].end_s + 1.0))
    for window in (view._window, None):
        view.show_window(window)
        before, after, during = view._plot.visible_curves(1, 600, view.x_range())
        assert (before.token, after.token, during.token) == ("border", "border", "flexion")
        step_s = during.series.max_step_s
        assert during.series.time_s[[0, -1]] == pytest.approx([some[0].start_s, some[-1].end_s], abs=step_s)
        assert before.series.time_s[-1] == pytest.approx(some[0].start_s, abs=step_s)
        assert after.series.time_s[0] == pytest.approx(some[-1].end_s, abs=step_s)
    view.show_window((some[0].start_s, some[-1].end_s))
    assert [one.token for one in view._plot.visible_curves(1, 600, view.x_range())] == ["flexion"]


def test_chart_cursor_can_be_dragged(qtbot: QtBot, view: SessionChart) -> None:
    panel = view.plots[0].visible_panel
    view.set_time(8.0)
    moved: list[float] = []
    view.cursor_moved.connect(moved.append)
    drag(qtbot, view.mouse_target, QPointF(round(float(panel.x(8.0))), panel.box.center().toPoint().y()), 60)
    assert moved[-1] == pytest.approx(view.plots[0].visible_panel.to_time(float(panel.x(8.0)) + 60), abs=0.2)
    assert view._window is None
    view.show_window((5.0, 15.0))
    moved.clear()
    panel = view.plots[0].visible_panel
    assert view._dots.getData()[0] == pytest.approx([float(panel.x(8.0))] * 3), "those of all panels lie on it"
    drag(qtbot, view.mouse_target, QPointF(round(float(panel.x(8.0))), panel.box.center().toPoint().y()), 60)
    assert moved
    assert view._window == (5.0, 15.0)


def test_chart_point_shows_time_value_and_spread(view: SessionChart) -> None:
    panel, column = view.plots[0].visible_panel, view.plots[0].key
    plot = view._plot
    at = QPointF(round(float(panel.x(15.0))), round(panel.box.center().y()))
    time_s, *values = view.describe_values(at)
    shown = plot.read_values(column, view.plots[0].visible_panel.to_time(at.x()))[0]
    assert time_s.startswith("00:1")
    assert values == [f"{shown.name} {format_with_sd(shown.value_deg, shown.sd_deg)}"]
    assert "±" in values[0]
    move(view.mouse_target, at)
    assert view._hover_label.isVisible()
    QApplication.sendEvent(view.mouse_target, QEvent(QEvent.Type.Leave))
    assert not view._hover_label.isVisible()

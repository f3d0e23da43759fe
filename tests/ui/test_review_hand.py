"""Review of the whole hand: curves by finger, hidden stretches, skeleton in step, the table of the fingers."""

from __future__ import annotations

import math
import threading
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRect, Qt
from PySide6.QtGui import QColor, QImage, QPainter, qGray
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from carpus.core.model.hand.protocols import HAND21, SITE_CHAINS, SITES, joint_angle_names
from carpus.core.results.session_results import compute_session_results
from carpus.core.results.valid_data import joint_curves, wrist_curves
from carpus.core.session.values import Session
from carpus.ui.charts.chart import ChartText
from carpus.ui.charts.session import HandPlot, SessionChart, read_joint_angle
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.picture.session_frames import BLANK_GREY, paint_trails, project_markers
from carpus.ui.picture.view import FrameView
from carpus.ui.screens.review.screen import ReviewScreen
from carpus.ui.words.finger_angles import FingerAngle
from carpus.ui.words.fingers import COLUMNS, limitation_words
from tests.ui.conftest import Reviewing, Show
from tests.ui.hand_fakes import FakeHandSessions, hand_session
from tests.ui.test_plots import wheel


@pytest.fixture(scope="module")
def store() -> FakeHandSessions:
    return FakeHandSessions(pictures=False)


@pytest.fixture
def screen(review: Reviewing, store: FakeHandSessions) -> ReviewScreen:
    return review(store, "hand-7")


def plot_of(screen: ReviewScreen) -> HandPlot:
    plot = screen.charts.curves._plot
    assert isinstance(plot, HandPlot)
    return plot


def test_review_hand_panels_per_finger_and_wrist(screen: ReviewScreen) -> None:
    curves, buttons = screen.charts.curves, screen.charts.finger.buttons()
    assert len(curves.panels()) == 5
    buttons[4].click()
    bending, spreading = curves.panels()
    assert {figure.joint for figure in plot_of(screen).panel_angles(1)} == {"MCP4_abduction"}
    assert bending[0].box.height() == pytest.approx(2 * spreading[0].box.height(), abs=1.0)
    buttons[-1].click()
    assert not isinstance(curves._plot, HandPlot)
    assert [column for _, column in curves.panels()] == [1, 0, 2]
    buttons[0].click()
    assert len(curves.panels()) == 5


def test_curve_is_dashed_where_its_markers_were_hidden_and_open_where_hand_was_lost(
    screen: ReviewScreen, store: FakeHandSessions
) -> None:
    session, plot = store.session("hand-7"), plot_of(screen)
    series = plot.joint_series(FingerAngle(3, "middle"))
    at = SITES.index("PIP3")
    known = np.isfinite(session.markers.measured_px[:, [at, at + 1], 0]).all(axis=1)
    value = np.isfinite(series.value)
    assert (~known & value).any()
    assert np.array_equal(series.predicted[value], ~known[value])
    series = plot.joint_series(FingerAngle(2, "knuckle"))
    assert any(start < 31.5 < end for start, end in series.gaps_s())
    assert math.isnan(read_joint_angle(plot, FingerAngle(2, "knuckle"), 31.5)[0])
    value_deg, _, hidden = read_joint_angle(plot, FingerAngle(3, "end"), 1.0)
    assert hidden, "an end joint without measurement of its own is never seen"
    assert value_deg == pytest.approx(2.0 / 3.0 * read_joint_angle(plot, FingerAngle(3, "middle"), 1.0)[0])


def test_table_says_what_is_at_least_and_why(screen: ReviewScreen) -> None:
    tables, at_least = screen.card.tables, []
    assert len(tables.hand_table.rows) == 5
    for finger, row in enumerate(tables.hand_table.rows, 1):
        for column, cell in zip(COLUMNS, row[1 : 1 + len(COLUMNS)], strict=True):
            found = screen.results.find(FingerAngle(finger, column).joint, "arc")
            at_least.append("≥" in cell.text)
            assert at_least[-1] == (found is not None and found.is_lower_bound and found.count > 0)
    assert ("Partly occluded" in limitation_words(screen.results)) == any(at_least)
    assert "DIP not measured" in tables.limitations.text()
    assert tables.task_table.rows
    tops = [
        part.y() for part in (tables.hand_table, tables.limitations, tables.notes, tables.task_table.parentWidget())
    ]
    assert tops == sorted(tops), "what explains the table stands right under it"


def test_space_plays_with_a_finger_chosen_and_curves_and_number_keep_step(qtbot: QtBot, screen: ReviewScreen) -> None:
    qtbot.mouseClick(screen.charts.finger.buttons()[2], Qt.MouseButton.LeftButton)
    screen.playing.set_time(4.0)
    qtbot.keyClick(screen, Qt.Key.Key_Space)
    qtbot.waitUntil(lambda: screen.playing.time_s > 4.1)
    assert screen.charts.curves._time_s == screen.playing.time_s
    qtbot.keyClick(screen, Qt.Key.Key_Space)
    first, *_, last = repetitions = screen.reviewed.results.repetitions
    assert len(repetitions) >= 7, "of the eight that were made, one may end with the recording"
    for time_s, words in ((first.start_s + 0.5, f"Repetition 1 of {len(repetitions)} · "), (last.end_s + 0.3, "")):
        screen.playing.set_time(time_s)
        said = screen.frame_view._clock_words(screen.reviewed)
        assert said.startswith(words) if words else "Repetition" not in said


def test_skeleton_goes_from_wrist_to_each_tip(store: FakeHandSessions) -> None:
    for finger in (1, 2, 3, 4, 5):
        assert SITES[SITE_CHAINS[finger - 1][0]] == "WRIST"
        assert SITES[SITE_CHAINS[finger - 1][-1]] == f"TIP{finger}"
    session = store.session("hand-7")
    places = project_markers(session.camera, session.markers.position_cam_m)
    seen = np.isfinite(session.markers.measured_px)
    assert np.abs(places - session.markers.measured_px)[seen].max() < 2.0
    assert np.isnan(places[session.status == 2]).all()


def test_places_are_final_before_session_is_read(
    qtbot: QtBot, theme: Theme, show: Show[ReviewScreen], store: FakeHandSessions, background: Background,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    may_read, session = threading.Event(), store.session

    def read(session_id: str) -> Session:
        assert may_read.wait(60.0)
        return session(session_id)

    monkeypatch.setattr(store, "session", read)
    screen = show(ReviewScreen(theme, background, store))

    def places() -> list[QRect]:
        QApplication.processEvents()
        parts = (screen.frame_view, screen.charts.curves, screen.card.tables, screen.charts.finger, screen.player)
        return [QRect(part.mapTo(screen, part.rect().topLeft()), part.size()) for part in parts]

    screen.load_session("linden", "hand-7", whole_hand=True)
    before = places()
    assert not screen.is_loaded
    may_read.set()
    qtbot.waitUntil(lambda: screen.is_loaded and not background.is_busy)
    assert places() == before
    screen.playing.stop()


def double_click(qtbot: QtBot, on: QWidget, at: QPointF) -> None:
    """All four events of it, as a mouse sends them."""
    qtbot.mouseClick(on, Qt.MouseButton.LeftButton, pos=at.toPoint())
    qtbot.mouseDClick(on, Qt.MouseButton.LeftButton, pos=at.toPoint())
    qtbot.mouseRelease(on, Qt.MouseButton.LeftButton, pos=at.toPoint())


def test_wheel_shows_less_time_about_mouse_and_double_click_repetitions(qtbot: QtBot, screen: ReviewScreen) -> None:
    curves = screen.charts.curves
    whole = plot_of(screen).visible_s
    assert whole == (0.0, plot_of(screen).end_s)
    box = curves.panels()[0][0].box
    at = QPointF(round(box.left() + 0.25 * box.width()), round(box.center().y()))
    time_s = curves.to_time(at.x())
    for _ in range(4):
        wheel(curves.mouse_target, at, 120, Qt.KeyboardModifier.ControlModifier)
    start_s, end_s = plot_of(screen).visible_s
    assert end_s - start_s == pytest.approx((whole[1] - whole[0]) / 1.25**4)
    assert curves.to_time(at.x()) == pytest.approx(time_s)
    screen.playing.set_time(whole[1] - 0.5)  # what is shown follows the cursor
    assert plot_of(screen).visible_s[1] == pytest.approx(whole[1])
    for _ in range(30):
        wheel(curves.mouse_target, at, -120, Qt.KeyboardModifier.ControlModifier)
    assert plot_of(screen).window_s is None
    double_click(qtbot, curves.mouse_target, at)
    repetitions = plot_of(screen).repetitions
    start_s, end_s = plot_of(screen).visible_s
    assert 0.0 <= start_s <= repetitions[0].start_s
    assert repetitions[-1].end_s <= end_s <= whole[1]
    assert plot_of(screen).visible_s == plot_of(screen).repetition_span_s
    double_click(qtbot, curves.mouse_target, at)
    assert plot_of(screen).visible_s == whole


def test_numbers_beside_the_curves_never_overlap_also_with_end_joints_of_their_own(qtbot: QtBot, theme: Theme) -> None:
    session = free_ends(hand_session())
    figures = compute_session_results(session)
    plot = HandPlot(wrist_curves(session), figures.exercise, figures.repetitions, joints=joint_curves(session))
    chart = SessionChart(theme)
    qtbot.addWidget(chart)
    chart.show_plot(plot)
    chart.set_time(3.0)
    chart.show()
    for height in (250, 680):
        chart.resize(800, height)
        said = [item for item in chart.scene().items() if isinstance(item, ChartText) and "°" in item.toPlainText()]
        assert sum(item.toPlainText().count("°") // (2 if "±" in item.toPlainText() else 1) for item in said) == 15
        boxes = [item.sceneBoundingRect() for item in said]
        for i, one in enumerate(boxes):
            assert not any(one.intersects(other) for other in boxes[i + 1 :])


def free_ends(session: Session) -> Session:
    """The same with end joints that were measured by themselves."""
    names, free = joint_angle_names(), joint_angle_names(True)
    source = [names.index(name) if name in names else names.index(f"PIP{name[3]}_flexion") for name in free]
    motion = replace(
        session.motion,
        joint_angles_rad=session.motion.joint_angles_rad[:, source],
        joint_angles_sd_rad=session.motion.joint_angles_sd_rad[:, source],
    )
    return replace(session, motion=motion, header=replace(session.header, joint_names=free))


@pytest.mark.parametrize("ground", [BLANK_GREY, 255])
def test_way_of_fingertip_is_no_bone_but_dots_that_fade(ground: int) -> None:
    ways = np.full((30, len(HAND21.markers), 2), np.nan)
    ways[:, HAND21.chains[3][-1]] = np.stack((np.arange(30) * 10.0 + 5.0, np.full(30, 10.0)), axis=1)
    seen = np.ones(ways.shape[:2], dtype=bool)
    seen[20:] = False
    drawn = QImage(300, 20, QImage.Format.Format_RGB32)
    drawn.fill(QColor(ground, ground, ground))
    painter = QPainter(drawn)
    paint_trails(painter, cast("FrameView", SimpleNamespace(to_screen=QPointF)), HAND21, ways, seen, 3)
    painter.end()
    grey = np.array([[[qGray(drawn.pixel(10 * n + x, y)) for x in range(10)] for y in range(20)] for n in range(30)])
    contrast = np.ptp(grey, axis=(1, 2))
    assert (np.diff(contrast[:20]) >= 0).all()
    assert contrast[0] < 20 < 80 < contrast[19]
    assert (grey[20:] == ground).all(), "nothing is known of a tip that was not seen"
    assert (grey[:, :, 0] == ground).all(), "no line from one to the next"

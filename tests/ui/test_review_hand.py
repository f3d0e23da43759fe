"""Review of the whole hand: curves by finger, hidden stretches, skeleton in step, the table of the fingers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.model.hand.protocols import SITE_CHAINS, SITES
from carpus.ui.charts.session import HandPlot, read_joint_angle
from carpus.ui.picture.session_frames import project_markers
from carpus.ui.screens.review.screen import ReviewScreen
from carpus.ui.words.finger_angles import FingerAngle
from carpus.ui.words.fingers import COLUMNS, limitation_words
from tests.ui.conftest import Reviewing
from tests.ui.hand_fakes import FakeHandSessions


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


def test_skeleton_goes_from_wrist_to_each_tip(store: FakeHandSessions) -> None:
    for finger in (1, 2, 3, 4, 5):
        assert SITES[SITE_CHAINS[finger - 1][0]] == "WRIST"
        assert SITES[SITE_CHAINS[finger - 1][-1]] == f"TIP{finger}"
    session = store.session("hand-7")
    places = project_markers(session.camera, session.markers.position_cam_m)
    seen = np.isfinite(session.markers.measured_px)
    assert np.abs(places - session.markers.measured_px)[seen].max() < 2.0
    assert np.isnan(places[session.status == 2]).all()

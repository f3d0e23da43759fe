"""Review of the whole hand: curves by finger, hidden stretches, skeleton in step, the table of the fingers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.model.hand.protocols import SITES
from carpus.ui.charts.session import HandPlot
from carpus.ui.screens.review.screen import ReviewScreen
from carpus.ui.words.finger_angles import FingerAngle
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
    assert math.isnan(series.read_value(31.5)[0])
    value_deg, _, hidden = plot.joint_series(FingerAngle(3, "end")).read_value(1.0)
    assert hidden, "an end joint without measurement of its own is never seen"
    assert value_deg == pytest.approx(2.0 / 3.0 * plot.joint_series(FingerAngle(3, "middle")).read_value(1.0)[0])

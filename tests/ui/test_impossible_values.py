"""Values no hand can have, and pictures that are missing: neither is ever drawn, printed or measured."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage, QPainter
from PySide6.QtWidgets import QApplication

from carpus.core.hand.protocols import HAND21, joint_angle_names
from carpus.core.results.figures import session_figures
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.seen import joint_curves
from carpus.ui.figures import FIGURES, Figure
from carpus.ui.joint_figures import figures_of
from carpus.ui.plot.axes import Panel, Scale
from carpus.ui.plot.series import Curve, Series, paint_curves
from carpus.ui.plot.session import thinned
from carpus.ui.plot.style import screen_style
from carpus.ui.theme import Theme
from tests.moments import with_moment
from tests.ui.fakes import FakeFeed
from tests.ui.hand_fakes import hand_session

NAMES = joint_angle_names()
COLUMN = NAMES.index("PIP4_flexion")


def test_an_angle_that_no_joint_can_have_is_a_gap_in_review_and_figures() -> None:
    session = hand_session()
    angles = session.motion.joint_angles_rad.copy()
    angles[600:602] = np.radians(-3627.0)  # as after pictures were missing for twelve seconds
    broken = replace(session, motion=replace(session.motion, joint_angles_rad=angles))
    curves = joint_curves(broken)
    assert curves is not None
    assert np.isnan(curves.angles_deg[600:602]).all()
    assert not curves.seen[600:602].any()
    assert np.nanmin(curves.angles_deg) > -60.0
    for row in session_figures(broken, RepetitionChoices({})).rows:
        for value in (row.mean_deg, row.sd_deg, row.best_deg):
            assert not abs(value) > 400.0, row.key


def test_an_angle_that_no_joint_can_have_takes_only_its_own_figures_live() -> None:
    frame = FakeFeed("fist", 3.0, protocol="hand21").frames[10]
    angles = frame.moment.joint_angles_rad.copy()
    angles[COLUMN] = np.radians(-3627.0)
    _, value, _, measured, _ = figures_of(HAND21, [with_moment(frame, joint_angles_rad=angles)])
    gone = {FIGURES[k] for k in np.flatnonzero(np.isnan(value[0]))}
    assert gone == {Figure(4, "middle"), Figure(4, "end"), Figure(4, "tam")}
    assert not measured[0, [FIGURES.index(figure) for figure in gone]].any()


@pytest.mark.parametrize("seconds", [130.0, 400.0])
def test_a_long_session_has_no_gaps_but_its_own(seconds: float) -> None:
    time_s = np.arange(0.0, seconds, 1 / 30)
    time_s = time_s[(time_s < 50.0) | (time_s > 62.6)]
    value = 40.0 * np.sin(time_s)
    gaps = thinned(Series(time_s, value, np.ones_like(value), np.zeros(len(value), dtype=bool)), 500).gaps_s()
    assert len(gaps) == 1
    assert gaps[0] == pytest.approx((50.0, 62.6), abs=1.0)


def drawn(theme: Theme, many: list[Series]) -> list[QRectF]:
    picture = QImage(600, 120, QImage.Format.Format_RGB32)
    panel = Panel(QRectF(0, 0, 600, 120), Scale(-15.0, 115.0, (90.0, 0.0), ()), 0.0, 20.0)
    painter = QPainter(picture)
    numbers = paint_curves(painter, screen_style(theme), panel, [Curve(series, "curve_a") for series in many])
    painter.end()
    return numbers


def test_numbers_of_values_beyond_the_scale_never_cover_each_other(qapp: QApplication, theme: Theme) -> None:
    time_s = np.arange(0.0, 20.0, 1 / 30)
    value = 60.0 + 62.0 * np.sin(6.0 * time_s)
    sure = np.zeros(len(time_s), dtype=bool)
    numbered = drawn(theme, [Series(time_s, value + off, None, sure) for off in (0.0, 3.0, 1.0)])
    assert len(numbered) > 2
    for i, one in enumerate(numbered):
        assert one.right() <= 600.0
        assert not any(one.intersects(other) for other in numbered[i + 1 :])


def test_a_hidden_stretch_beyond_the_scale_has_no_number(qapp: QApplication, theme: Theme) -> None:
    time_s = np.arange(0.0, 20.0, 1 / 30)
    value = 60.0 + 62.0 * np.sin(time_s)
    assert drawn(theme, [Series(time_s, value, None, value > 80.0)]) == []

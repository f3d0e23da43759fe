"""Curves painted bit by bit are the curves painted at once."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QImage, QPainter
from PySide6.QtWidgets import QApplication

from carpus.core.types import ByteImage
from carpus.ui.plot.axes import Panel, Scale
from carpus.ui.plot.history import Block
from carpus.ui.plot.series import Pens, pens_of
from carpus.ui.plot.strips import CurveStrips, PanelCurves

SCALE = Scale(-10.0, 110.0, (0.0,), ())
BOXES = (QRectF(20.3, 10.6, 180.4, 120.2), QRectF(220.7, 10.6, 180.4, 120.2))
SHOWN_S, STEP_S = 10.0, 0.1
TIMES_S = 5.0 + STEP_S * np.arange(260)


def block(first: int, end: int) -> Block:
    """Two curves: one measured throughout, one predicted in its upper half."""
    time_s = TIMES_S[first:end]
    swing = np.sin(2.0 * np.pi * 0.4 * time_s)
    value = np.stack((50.0 + 40.0 * swing, 50.0 - 30.0 * swing), axis=1)
    predicted = np.stack((np.zeros(len(time_s), dtype=bool), swing < 0.0), axis=1)
    return Block(time_s, value, np.full_like(value, 6.0), predicted)


def pens(color: str) -> Pens:
    return pens_of(QColor(color), 2.0)


def painted(strips: CurveStrips, end: int, late_s: float = 0.0, ratio: float = 1.0) -> ByteImage:
    """The window's picture when the sample before ``end`` is the newest one."""
    now_s = float(TIMES_S[end - 1]) + late_s
    image = QImage(round(430 * ratio), round(150 * ratio), QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(ratio)
    image.fill(QColor("white"))
    painter = QPainter(image)
    curves = ((0, pens("blue")), (1, pens("red")))
    panels = [PanelCurves(Panel(box, SCALE, now_s - SHOWN_S, now_s), curves) for box in BOXES]
    strips.paint(painter, panels, block(max(0, end - 100), end), now_s)
    painter.end()
    pixels = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return pixels[:, : 4 * image.width()].reshape(image.height(), image.width(), 4)[..., :3].copy()


@pytest.mark.parametrize("ratio", [1.0, 1.25, 2.0])
def test_many_steps_paint_what_one_does(qapp: QApplication, ratio: float) -> None:
    small, large = CurveStrips(), CurveStrips()
    painted(small, 101, ratio=ratio)
    painted(large, 101, ratio=ratio)
    for end in range(102, 181):
        step_by_step = painted(small, end, ratio=ratio)
    at_once = painted(large, 180, ratio=ratio)
    assert (at_once < 200).any(axis=-1).mean() > 0.05, "curves are there"
    differing = np.abs(step_by_step.astype(int) - at_once).max(axis=-1) > 24
    assert differing.mean() < 2e-4


def test_the_curve_is_where_the_panel_has_its_values(qapp: QApplication) -> None:
    strips = CurveStrips()
    for end in range(101, 240, 2):
        picture = painted(strips, end)
    now_s = float(TIMES_S[238])
    panel = Panel(BOXES[0], SCALE, now_s - SHOWN_S, now_s)
    shown = block(150, 235)
    blue = (picture[..., 0].astype(int) - picture[..., 2] > 150) & (picture[..., 0] > 200)  # stored as BGR
    for time_s, value in zip(shown.time_s[::7], shown.value_deg[::7, 0], strict=True):
        x, y = float(panel.x(time_s)), float(panel.y(value))
        near = blue[round(y) - 4 : round(y) + 5, round(x) - 1 : round(x) + 2]
        assert near.any(), (time_s, value)
    assert not blue[:, : round(panel.box.left()) - 2].any()
    assert not blue[:, round(panel.box.right()) + 3 : round(BOXES[1].left()) - 3].any()


def test_between_samples_the_curve_only_moves(qapp: QApplication) -> None:
    strips = CurveStrips()
    before = painted(strips, 150)
    later = painted(strips, 150, late_s=3.0 * SHOWN_S / BOXES[0].width())
    left, right = 30, 190
    np.testing.assert_array_equal(later[:, left : right - 3], before[:, left + 3 : right])


def test_another_beginning_paints_all_anew(qapp: QApplication) -> None:
    used, fresh = CurveStrips(), CurveStrips()
    painted(used, 240)
    np.testing.assert_array_equal(painted(used, 120), painted(fresh, 120))

"""From a calibration to the geometry that the filter tracks and the shape it goes on measuring."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core.calibration.result import Calibration
from core.hand.protocols import WRIST6
from core.tracking.measurement import RigidPalm
from core.types import FloatArray

_FLOOR_M = 1e-5
"""Keeps the covariance of a perfectly measured disc positive definite."""


def palm_of(calibration: Calibration) -> Calibration:
    """The calibration of the discs that move with the palm, whatever else is on the hand."""
    clicks = calibration.clicks
    if not clicks.protocol.has_fingers:
        return calibration
    rows = np.array(clicks.protocol.palm)
    return replace(
        calibration,
        clicks=replace(clicks, protocol=WRIST6, pixel=clicks.pixel[rows]),
        marker_position_w0_m=calibration.marker_position_w0_m[rows],
        marker_covariance_w0_m2=calibration.marker_covariance_w0_m2[rows],
    )


def geometry_for(calibration: Calibration, refine: bool) -> tuple[RigidPalm, FloatArray]:
    """Rigid palm and the covariance (S, S) of its shape: 3 numbers a disc, or none when not refined."""
    palm = RigidPalm(calibration.marker_position_w0_m)
    if not refine:
        return palm, np.empty((0, 0))
    count = palm.marker_position_w0_m.shape[0]
    covariance = np.zeros((3 * count, 3 * count))
    for i in range(count):
        block = slice(3 * i, 3 * i + 3)
        covariance[block, block] = calibration.marker_covariance_w0_m2[i] + _FLOOR_M**2 * np.eye(3)
    return palm, covariance

"""From a calibration to the geometry that the filter tracks and the shape it goes on measuring."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core.calibration.result import Calibration
from core.hand.protocols import WRIST6
from core.tracking.measurement import RigidPalm
from core.tracking.shape_learning import along_rays
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


def geometry_for(calibration: Calibration, refine: bool, depth_stays_m: float) -> tuple[RigidPalm, FloatArray]:
    """Rigid palm and the covariance (S, S) of its shape: 3 numbers a disc, or none when not refined.

    ``depth_stays_m``: what the scatter of a still hand's depths does not show of their error.
    """
    palm = RigidPalm(calibration.marker_position_w0_m)
    if not refine:
        return palm, np.empty((0, 0))
    count = palm.marker_position_w0_m.shape[0]
    own = calibration.marker_covariance_w0_m2 + along_rays(calibration, depth_stays_m) + _FLOOR_M**2 * np.eye(3)
    covariance = np.zeros((count, 3, count, 3))
    covariance[np.arange(count), :, np.arange(count), :] = own
    return palm, covariance.reshape(3 * count, -1)

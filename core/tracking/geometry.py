"""The palm of a calibration, whatever else is on the hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.hand.protocols import MarkerProtocol
from carpus.core.hand.sites import PALM_MARKERS

_PALM = MarkerProtocol("palm", PALM_MARKERS)


def palm_of(calibration: Calibration) -> Calibration:
    """The calibration of the discs that move with the palm, whatever else is on the hand."""
    clicks = calibration.clicks
    if not clicks.protocol.has_fingers:
        return calibration
    rows = np.array(clicks.protocol.palm)
    return replace(
        calibration,
        clicks=replace(clicks, protocol=_PALM, pixel=clicks.pixel[rows]),
        marker_position_w0_m=calibration.marker_position_w0_m[rows],
        marker_covariance_w0_m2=calibration.marker_covariance_w0_m2[rows],
    )

"""A hand calibrated and tracked on simulated measurements, as the tests of the fingers want it."""

from __future__ import annotations

from carpus.core.calibration.calibrate import CalibrationSettings
from carpus.core.calibration.result import Calibration
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from tests.accuracy.carpus import measure_still_hand
from tests.simulation.measurements import MeasurementSequence


def calibrate_sequence(seen: MeasurementSequence) -> Calibration:
    """What the calibration knows of the hand."""
    hand, _ = measure_still_hand(seen, CalibrationSettings())
    assert hand.calibration is not None
    return hand.calibration


def build_tracker(seen: MeasurementSequence) -> Tracker:
    """A tracker of that hand, with the settings as they are."""
    return Tracker(calibrate_sequence(seen), seen.truth.camera, TrackerSettings())

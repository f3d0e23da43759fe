"""A hand calibrated and tracked on simulated measurements, as the tests of the fingers want it."""

from __future__ import annotations

from carpus.core.calibration.result import Calibration
from carpus.core.calibration.settings import CalibrationSettings
from carpus.core.pipeline.track import learnt_from
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.tracker import Tracker
from tests.accuracy.carpus import measured_hand
from tests.simulation.measurements import MeasurementSequence


def calibrated(seen: MeasurementSequence) -> Calibration:
    """What the calibration knows of the hand."""
    hand, _ = measured_hand(seen, CalibrationSettings())
    assert hand.calibration is not None
    return hand.calibration


def tracker_of(seen: MeasurementSequence) -> Tracker:
    """A tracker of that hand, with the settings as they are."""
    return Tracker(calibrated(seen), seen.truth.camera, TrackerSettings())


def learnt_tracker(seen: MeasurementSequence) -> tuple[Tracker, float]:
    """A tracker that has learnt from the still frames how much the measurements scatter, and when those end."""
    hand, neutral_ends_s = measured_hand(seen, CalibrationSettings())
    assert hand.calibration is not None
    settings = learnt_from(hand.noise, neutral_ends_s, TrackerSettings()).applied(TrackerSettings())
    return Tracker(hand.calibration, seen.truth.camera, settings), neutral_ends_s

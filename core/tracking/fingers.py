"""Thumb and fingers of one hand, tracked on the palm that the tracker has just corrected."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.tracking.digit_filter import DIGIT_SIZE, RATES, SEEN
from carpus.core.tracking.digit_naming import PATIENCE_FRAMES, DigitMemory, DigitNaming, FingerTrial
from carpus.core.tracking.digit_search import in_reach
from carpus.core.tracking.finger_depth import FLEXION
from carpus.core.tracking.finger_model import RANGE_AFTER_S, FingerModel
from carpus.core.tracking.finger_smoother import FingerStart, FingerStep
from carpus.core.tracking.hand_geometry import CHAINS, DISCS, SLOTS, JointMoment
from carpus.core.tracking.kernel import ModeMixture
from carpus.core.tracking.predicted_measurement import PredictedDigits
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.soft_tissue import DigitSpeeds
from carpus.core.types import FloatArray

_RATE, _THUMB_BASE = np.arange(DIGIT_SIZE)[RATES], slice(0, 2)


SEEN_ANEW = 0.5
"""The chance that a disc of a digit begun anew is to be seen."""


class Fingers:
    """Remembers the digits' estimates from frame to frame."""

    def __init__(self, calibration: Calibration, camera: Camera, settings: TrackerSettings) -> None:
        self.model = FingerModel(calibration, camera, settings)
        self._settings = settings
        self.begin_at_neutral()

    def begin_at_neutral(self) -> None:
        """Start (again) from the neutral pose, at rest."""
        self.memory = DigitMemory.at_neutral(self.model.calibrated_palm)
        self.naming = DigitNaming(self.model, self.memory, self._settings)
        self._begins = True
        neutral = self.model.at_neutral()
        self._take(neutral, neutral.merged())

    def reach(self, point_m: FloatArray) -> NDArray[np.bool_]:
        """Whether points (..., 3) in the tracked body may be discs of these fingers."""
        palm = self.memory.palm
        on_palm = (point_m - palm.origin_m) @ palm.axes
        return in_reach(on_palm, palm.disc_m[1:], self._mean[:, SEEN])

    def begin_anywhere(self) -> None:
        """Start again after the hand was lost: the anatomy is known, the joints may be anywhere."""
        self.memory.visible = np.full((CHAINS, DISCS), SEEN_ANEW)
        self.memory.missing = np.full(CHAINS, PATIENCE_FRAMES)
        self.memory.unseen_s = np.full((CHAINS, SLOTS), RANGE_AFTER_S)
        anywhere = self.model.anywhere(self._mean, self._covariance)
        self._take(anywhere, anywhere.merged())

    def look_anew(self, chain: int) -> None:
        """A person shows a disc of a digit where it was not believed: its joints may be anywhere."""
        estimates = self.model.begun_anew(self._estimates, np.arange(CHAINS) == chain, self._estimates)
        self.memory.visible[chain] = SEEN_ANEW
        self.memory.missing[chain] = PATIENCE_FRAMES
        self.memory.unseen_s[chain] = RANGE_AFTER_S
        self._take(estimates, estimates.merged())

    def _take(self, estimates: ModeMixture, merged: tuple[FloatArray, FloatArray]) -> None:
        self._estimates, (self._mean, self._covariance) = estimates, merged
        self._speeds: DigitSpeeds | None = None

    @property
    def speeds(self) -> DigitSpeeds:
        """How fast the thumb turns at its base and the fingers at their knuckles, root mean square; a joint that
        nothing shows may turn as fast as its rate is unsure."""
        if self._speeds is None:
            unsure = np.where(self.memory.unseen_s > 0.0, self._covariance[:, _RATE, _RATE], 0.0)
            square = self._mean[:, _RATE] ** 2 + unsure
            thumb, fingers = (
                float(np.add.reduce(of)) / of.size for of in (square[0, _THUMB_BASE], square[1:, FLEXION])
            )
            fastest = self._settings.tissue.fastest_rad_s
            self._speeds = DigitSpeeds(min(math.sqrt(thumb), fastest), min(math.sqrt(fingers), fastest))
        return self._speeds

    @property
    def known(self) -> ModeMixture:
        """What is believed of the digits; another object whenever anything of them has changed."""
        return self._estimates

    def ahead(self, dt_s: float) -> PredictedDigits:
        """The digits ``dt_s`` later, and their discs on the palm as it was known last."""
        estimates, points = self.model.ahead(self._estimates, self.memory.unseen_s, dt_s, self.memory.palm.disc_m[1:])
        return PredictedDigits(estimates, points, self.memory.palm)

    def start(self, timestamp_s: float, is_lost: bool) -> FingerStart:
        """What is believed now, for smoothing over the frames to come."""
        return FingerStart(self._estimates, self.memory.unseen_s, timestamp_s, is_lost)

    def accept(self, trial: FingerTrial, timestamp_s: float, dt_s: float) -> FingerStep:
        """Go on from a trial; what the smoother needs of it."""
        named = trial.named
        self.memory.remember(trial, dt_s, self._settings)
        kept, merged, misread = self.model.within_reach(named.update.mixture, self._estimates)
        self.memory.missing[misread] = PATIENCE_FRAMES
        self._take(kept, merged)
        begins, self._begins = self._begins, False
        return FingerStep(
            timestamp_s, named.measured, named.variance, trial.blob >= 0, trial.postures, begins, trial.bends
        )

    def read(self, trial: FingerTrial) -> JointMoment:
        """The joints after that trial was accepted."""
        return self.model.readout.read(self._mean, self._covariance, trial.seat, trial.scene.linearised)

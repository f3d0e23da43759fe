"""State estimate of thumb and fingers of one hand, on the palm that was just updated."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.types import FloatArray
from carpus.core.tracking.digits.digit_search import is_in_reach
from carpus.core.tracking.digits.digit_update import MAX_MISSING_FRAMES, DigitHistory, DigitPosterior, DigitUpdater
from carpus.core.tracking.digits.finger_model import DIFFUSION_S, FingerModel
from carpus.core.tracking.digits.knuckle_flexion import FLEXION_SLOT
from carpus.core.tracking.filter.digit_filter import DIGIT_SIZE, OBSERVED, RATES, draw_sigma_points
from carpus.core.tracking.filter.hand_geometry import N_DIGITS, N_DISCS, N_SLOTS, JointState
from carpus.core.tracking.filter.mixture_filter import ModeMixture
from carpus.core.tracking.filter.predicted_measurement import PredictedDigits
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.filter.soft_tissue import DigitSpeeds
from carpus.core.tracking.smoother.finger_smoother import FingerStep

_RATE, _THUMB_BASE = np.arange(DIGIT_SIZE)[RATES], slice(0, 2)

RESTART_VISIBLE_PROBABILITY = 0.5  # of a disc of a digit that is restarted


class FingerFilter:
    """The digits' estimates from frame to frame.

    ``estimates`` is another object whenever any of them has changed.
    """

    def __init__(self, calibration: Calibration, camera: Camera, settings: TrackerSettings) -> None:
        self.model = FingerModel(calibration, camera, settings)
        self._settings = settings
        self.begin_at_neutral()

    def begin_at_neutral(self) -> None:
        """Start (again) from the neutral pose, at rest."""
        self.history = DigitHistory.from_neutral_palm(self.model.calibrated_palm)
        self.updater = DigitUpdater(self.model, self.history, self._settings)
        self._is_at_start = True
        neutral = self.model.neutral_mixture()
        self._set_estimates(neutral, neutral.merge())

    def is_in_reach(self, point_m: FloatArray) -> NDArray[np.bool_]:
        """Return whether points (..., 3) in the tracked body may be discs of these fingers."""
        palm = self.history.palm
        on_palm = (point_m - palm.origin_m) @ palm.axes
        return is_in_reach(on_palm, palm.disc_m[1:], self._mean[:, OBSERVED])

    def reset_joints(self) -> None:
        """Start again after the hand was lost: the anatomy is known, the joints may be anywhere."""
        self.history.visible_probability = np.full((N_DIGITS, N_DISCS), RESTART_VISIBLE_PROBABILITY)
        self.history.missing_frames = np.full(N_DIGITS, MAX_MISSING_FRAMES)
        self.history.unseen_s = np.full((N_DIGITS, N_SLOTS), DIFFUSION_S)
        anywhere = self.model.diffuse_mixture(self._mean, self._covariance)
        self._set_estimates(anywhere, anywhere.merge())

    def restart_digit(self, chain: int) -> None:
        """Restart a digit anywhere, of which a person shows a disc where it was not predicted."""
        estimates = self.model.restart_digits(self.estimates, np.arange(N_DIGITS) == chain, self.estimates)
        self.history.visible_probability[chain] = RESTART_VISIBLE_PROBABILITY
        self.history.missing_frames[chain] = MAX_MISSING_FRAMES
        self.history.unseen_s[chain] = DIFFUSION_S
        self._set_estimates(estimates, estimates.merge())

    def _set_estimates(self, estimates: ModeMixture, merged: tuple[FloatArray, FloatArray]) -> None:
        self.estimates, (self._mean, self._covariance) = estimates, merged
        self._speeds: DigitSpeeds | None = None

    @property
    def joint_speeds(self) -> DigitSpeeds:
        """Root mean square rates of the thumb at its base and of the fingers at MCP.

        A joint that nothing shows may turn as fast as its rate is unsure.
        """
        if self._speeds is None:
            unsure = np.where(self.history.unseen_s > 0.0, self._covariance[:, _RATE, _RATE], 0.0)
            square = self._mean[:, _RATE] ** 2 + unsure
            thumb, fingers = (
                float(np.add.reduce(of)) / of.size for of in (square[0, _THUMB_BASE], square[1:, FLEXION_SLOT])
            )
            fastest = self._settings.tissue.fastest_rad_s
            self._speeds = DigitSpeeds(min(math.sqrt(thumb), fastest), min(math.sqrt(fingers), fastest))
        return self._speeds

    def predict(self, dt_s: float) -> PredictedDigits:
        """Predict the digits ``dt_s`` ahead, and their discs on the palm as it was known last."""
        history = self.history
        estimates = self.model.predict(self.estimates, history.unseen_s, dt_s)
        points = draw_sigma_points(*estimates.merge(), history.palm.disc_m[1:], self._settings.scaling)
        return PredictedDigits(estimates, points, history.palm)

    def accept(self, posterior: DigitPosterior, timestamp_s: float, dt_s: float) -> FingerStep:
        """Accept an update; return what the smoother needs of it."""
        self.history.update(posterior, dt_s, self._settings)
        updated = posterior.update
        estimates, merged, is_misread = self.model.apply_joint_limits(updated.update.mixture, self.estimates)
        self.history.missing_frames[is_misread] = MAX_MISSING_FRAMES
        self._set_estimates(estimates, merged)
        is_at_start, self._is_at_start = self._is_at_start, False
        return FingerStep(
            timestamp_s, updated.measured, updated.variance, posterior.blob >= 0, posterior.postures, is_at_start,
            posterior.knuckle_flexion,
        )  # fmt: skip

    def read_joints(self, posterior: DigitPosterior) -> JointState:
        """Return the joints after an update was accepted."""
        return self.model.readout.read_joints(self._mean, self._covariance, posterior.base, posterior.scene.linearised)

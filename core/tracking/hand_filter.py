"""The filter's cycle on one hand: predict, associate, update.

The palm is associated and updated by its discs, then by the surface of the back of the hand; thumb and fingers follow
on the palm as updated, by the blobs that are left. An update is a trial: nothing is stored until it is accepted.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.model import so3
from carpus.core.model.camera import Camera
from carpus.core.model.types import Detections, FloatArray
from carpus.core.tracking.association.association import associate_and_update, is_jointly_compatible
from carpus.core.tracking.association.reacquire import (
    RATE_SD_RAD_S,
    VELOCITY_SD_M_S,
    FoundPalm,
    TurnLimits,
    find_palm,
    is_other_hand,
)
from carpus.core.tracking.association.track_manager import MIN_PALM_MARKERS
from carpus.core.tracking.filter.hand_geometry import N_DIGITS, JointState, palm_calibration
from carpus.core.tracking.filter.mixture_filter import ModeMixture
from carpus.core.tracking.filter.motion import (
    RATE_MEMORY_S,
    PalmMotion,
    fading_factors,
    fading_matrix,
    find_unobserved_turns,
)
from carpus.core.tracking.filter.palm_state import (
    CALIBRATION_ERROR,
    POSE,
    RELIEF,
    SHAPE,
    SIZE,
    SKIN,
    TURN,
    InitialSd,
    PalmEstimate,
    PalmView,
    initial_estimate,
    reset_error,
)
from carpus.core.tracking.filter.predicted_measurement import (
    MarkerOrder,
    Measurements,
    PredictedMeasurement,
    UpdatedPalm,
    adapt_noise_factor,
    depth_bias_matrix,
    measurements_from_blobs,
    predict_measurement_ahead,
    shape_covariance,
    update_palm,
)
from carpus.core.tracking.filter.readout import Readout
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.filter.soft_tissue import (
    ZERO_SPEEDS,
    DigitSpeeds,
    joint_driven_modes,
    resting_and_moving_modes,
    single_moving_mode,
    stationary_covariance,
)
from carpus.core.tracking.filter.surface_fit import SurfaceMeasurement, fit_surface, surface_calibration_covariance
from carpus.core.tracking.finger_filter import DigitFrame, DigitPosterior, FingerFilter
from carpus.core.tracking.smoother.finger_smoother import FingerStart, FingerStep
from carpus.core.tracking.smoother.palm_smoother import FilterStep

# predicted less surely, the hand is turned by its markers before the surface is fitted
JOINT_SD_RAD = 0.05
_MIN_DEPTH_M = 0.1  # no camera sees a hand nearer: keeps the size of a disc finite


@dataclass(frozen=True, slots=True)
class Scan:
    """The measurements of one frame: its time, undistorted blobs, and these as measurements."""

    timestamp_s: float
    dt_s: float
    ideal: Detections
    blobs: Measurements

    def without_blobs(self) -> Scan:
        """Return the scan without blobs."""
        none = np.zeros(len(self.ideal), dtype=bool)
        blobs = Measurements(self.blobs.value[none], self.blobs.variance[none])
        return replace(self, ideal=self.ideal.subset(none), blobs=blobs)


def undistort_detections(detections: Detections, camera: Camera) -> Detections:
    """Return blobs and readings where a camera without distortion would see them."""
    if not camera.is_distorted:
        return detections
    surface, fingers = (
        None if some is None else replace(some, pixel=camera.undistort(some.pixel))
        for some in (detections.surface, detections.fingers)
    )
    return replace(detections, pixel=camera.undistort(detections.pixel), surface=surface, fingers=fingers)


@dataclass(frozen=True, slots=True)
class Posterior:
    """The hand updated by one scan from the ``predicted`` state.

    The ``palm`` as associated, its modes as errors from ``estimate``, and the fingers on it. ``seen_count`` discs of
    the palm; ``unassigned`` (D,) blobs that are neither's, ``is_finger`` (D,) blobs that are the fingers'.
    """

    predicted: PredictedMeasurement
    palm: UpdatedPalm
    estimate: PalmEstimate
    mixture: ModeMixture
    seen_count: int
    fingers: DigitPosterior | None
    unassigned: NDArray[np.bool_]
    is_finger: NDArray[np.bool_]


class HandFilter:
    """The state estimate of one calibrated hand, and what was learnt of it that outlives a lost track."""

    def __init__(self, calibration: Calibration, camera: Camera, settings: TrackerSettings) -> None:
        self._settings = settings
        self.fingers = FingerFilter(calibration, camera, settings) if calibration.clicks.protocol.has_fingers else None
        protocol = calibration.clicks.protocol
        rows = np.array(protocol.palm)
        if self.fingers is None:
            self.order = MarkerOrder(rows, np.empty((0, 3), dtype=np.int64), np.zeros(N_DIGITS, dtype=bool))
        else:
            self.order = MarkerOrder(rows, self.fingers.model.markers, self.fingers.model.has_discs)
        self._surface = calibration.surface if settings.use_surface and settings.use_depth else None
        calibration = palm_calibration(calibration)
        self.view = PalmView(
            camera,
            calibration.rotation_w0_cam,
            calibration.translation_w0_cam_m,
            calibration.marker_position_w0_m,
            depth_bias_matrix(calibration, settings.shape_bias_share),
        )
        self.readout = Readout(calibration, camera, settings.marker_radius_m)
        # Blobs alone do not tell tissue that rests from a hand that moves; joints that are seen tell when it moves.
        modes = joint_driven_modes if self.fingers is not None else resting_and_moving_modes
        tissue = (single_moving_mode if self._surface is None else modes)(settings.tissue)
        self.motion = PalmMotion(settings.motion_noise, tissue, np.array(settings.mode_scales))
        self._calibrated_covariance = self._calibration_covariance(calibration)
        self._stationary = stationary_covariance(settings.tissue)
        self._resolution_px2 = float(camera.width_px * camera.height_px)
        self._noise_factor = np.ones((rows.size, 3))
        self._prediction: tuple[object, object, float, PredictedMeasurement] | None = None
        self.begin_at_neutral()

    def begin_at_neutral(self) -> None:
        self._learnt_error = np.zeros(CALIBRATION_ERROR.stop - CALIBRATION_ERROR.start)
        self._learnt_covariance = self._calibrated_covariance
        start = initial_estimate(self._settings.initial, self._learnt_covariance)
        self.start(start, self.motion.initial_probability)
        if self.fingers is not None:
            self.fingers.begin_at_neutral()

    def _calibration_covariance(self, calibration: Calibration) -> FloatArray:
        """Return the covariance (21, 21) of the calibrated discs and the back of the hand."""
        settings, shapes = self._settings, SHAPE.stop - SHAPE.start
        out = np.zeros((CALIBRATION_ERROR.stop - CALIBRATION_ERROR.start,) * 2)
        out[:shapes, :shapes] = shape_covariance(calibration, self.view.camera.sensor, settings.noise)
        out[shapes:, shapes:] = np.eye(3)
        if self._surface is not None:
            out[shapes:, shapes:] = surface_calibration_covariance(self._surface, self.view, settings.surface)
        return out

    def start(self, estimate: PalmEstimate, probability: FloatArray | None = None) -> None:
        """Start from an estimate of the palm, its modes of a ``probability`` (K,), or all alike."""
        mixture = self._resting_mixture(estimate)
        mixture = mixture if probability is None else replace(mixture, probability=probability[None])
        self._palm: tuple[PalmEstimate, ModeMixture] | None = (estimate, mixture)
        self._unobserved_turns: NDArray[np.float64] | None = None

    def _resting_mixture(self, estimate: PalmEstimate) -> ModeMixture:
        return ModeMixture.from_gaussian(np.zeros((1, SIZE)), estimate.covariance[None], self.motion.modes)

    def drop_track(self) -> None:
        """Drop the track; the hand's anatomy stays known."""
        self._palm = None
        if self.fingers is not None:
            self.fingers.reset_joints()

    def predict(self, dt_s: float) -> PredictedMeasurement:
        """Predict the state ``dt_s`` after the last frame and its measurement; computed once."""
        assert self._palm is not None
        fingers = None if self.fingers is None else self.fingers.estimates
        if self._prediction is None or not (
            self._prediction[0] is self._palm and self._prediction[1] is fingers and self._prediction[2] == dt_s
        ):
            digits = None if self.fingers is None else self.fingers.predict(dt_s)
            predicted = predict_measurement_ahead(
                *self._palm, self.view, self.motion, dt_s, self._unobserved_turns, self._digit_speeds, self._settings,
                digits, self.order,
            )  # fmt: skip
            self._prediction = self._palm, fingers, dt_s, predicted
        return self._prediction[3]

    def build_scan(self, predicted: PredictedMeasurement, ideal: Detections, timestamp_s: float, dt_s: float) -> Scan:
        """Return the blobs as measurements at the distance at which the hand was predicted."""
        depth_m, camera = max(float(predicted.mean[0, 2]), _MIN_DEPTH_M), self.view.camera
        radius_px = camera.fx_px * self._settings.marker_radius_m / depth_m
        return Scan(timestamp_s, dt_s, ideal, measurements_from_blobs(ideal, radius_px, self._settings, camera.sensor))

    def update(self, predicted: PredictedMeasurement, scan: Scan) -> Posterior:
        """Associate the blobs with the predicted discs and update by them, and by the surface."""
        blobs, is_sure = scan.blobs, predicted.turn_sd_rad < JOINT_SD_RAD
        if is_sure:
            blobs = Measurements(blobs.value, blobs.variance, self._fit_surface(predicted.nominal, scan))
        palm = associate_and_update(
            predicted, blobs, MIN_PALM_MARKERS + 1, self._resolution_px2, self._noise_factor, self._settings
        )
        estimate, mixture = reset_error(predicted.nominal, palm.mixture)
        surface = None if is_sure else self._fit_surface(estimate, scan)
        if surface is not None:
            after_discs = replace(predicted, nominal=estimate, mixture=mixture)
            surface_alone = Measurements(np.empty((0, 3)), np.empty((0, 3)), surface)
            none: NDArray[np.int64] = np.full(palm.assigned.size, -1)
            update = update_palm(after_discs, surface_alone, none, none >= 0, self._noise_factor)
            if update.by_surface:
                estimate, mixture = reset_error(estimate, update.mixture)
                palm = replace(palm, by_surface=True)
        unassigned, is_finger = np.ones(len(blobs), dtype=bool), np.zeros(len(blobs), dtype=bool)
        is_assigned = palm.assigned >= 0
        unassigned[palm.assigned[is_assigned]] = False
        fingers = None
        if self.fingers is not None and predicted.digits is not None:
            frame = DigitFrame(
                scan.dt_s, self.readout.compute_base(estimate, self.view), blobs, scan.ideal.area_px, unassigned
            )
            fingers = self.fingers.update(predicted.digits, frame, scan.ideal.fingers)
            is_finger[fingers.blob[fingers.blob >= 0]] = True
        seen_count = int(np.count_nonzero(is_assigned))
        return Posterior(predicted, palm, estimate, mixture, seen_count, fingers, unassigned & ~is_finger, is_finger)

    def _fit_surface(self, estimate: PalmEstimate, scan: Scan) -> SurfaceMeasurement | None:
        samples = scan.ideal.surface
        if self._surface is None or samples is None:
            return None
        return fit_surface(estimate, samples, self._surface, self.view, self._settings.surface)

    def is_consistent(self, posterior: Posterior) -> bool:
        """Return whether the discs lie where the updated pose puts them."""
        return bool((np.abs(posterior.palm.raw_residual) <= self._settings.noise.outlier_sd).all())

    @property
    def is_rotation_observed(self) -> bool:
        """Whether the last frame showed every turn of the hand."""
        return self._unobserved_turns is None

    def is_rotation_measured(self, posterior: Posterior) -> bool:
        """Return whether the measurements show every turn of the hand."""
        return posterior.palm.by_surface or self._find_unobserved_turns(posterior) is None

    def _find_unobserved_turns(self, posterior: Posterior) -> NDArray[np.float64] | None:
        return find_unobserved_turns(self.view.palm_m[posterior.palm.assigned >= 0])

    def learn(self, posterior: Posterior, dt_s: float) -> None:
        """Store what outlives a lost track: each disc's noise, and the palm's shape."""
        palm, noise = posterior.palm, self._settings.noise
        self._noise_factor = adapt_noise_factor(self._noise_factor, palm.raw_residual, palm.is_measured, dt_s, noise)
        self._learnt_error = posterior.estimate.value[CALIBRATION_ERROR]
        self._learnt_covariance = posterior.estimate.covariance[CALIBRATION_ERROR, CALIBRATION_ERROR]

    def accept(
        self, posterior: Posterior, scan: Scan, *, is_seen: bool, is_linked: bool
    ) -> tuple[FilterStep, FingerStep | None]:
        """Accept an update; return what the smoother needs of it.

        ``is_seen``: enough discs determine the palm's pose; ``is_linked``: the step follows from the one before.
        """
        turns_before, self._unobserved_turns = self._unobserved_turns, None
        kept = float(np.exp(-scan.dt_s / RATE_MEMORY_S))
        estimate, mixture = posterior.estimate, posterior.mixture
        if not posterior.palm.by_surface:
            self._unobserved_turns = self._find_unobserved_turns(posterior)
        if not is_seen:
            # An unseen hand is not taken to go on for ever: its velocity fades, its uncertainty grows.
            estimate, mixture = _fade_velocity(estimate, mixture, np.diag(fading_factors(kept)))
        elif self._unobserved_turns is not None:
            estimate, mixture = _fade_velocity(estimate, mixture, fading_matrix(kept, self._unobserved_turns))
        self._palm = estimate, mixture
        fingers = None
        if self.fingers is not None and posterior.fingers is not None:
            fingers = self.fingers.accept(posterior.fingers, scan.timestamp_s, scan.dt_s)
        probability, speeds = posterior.mixture.probability[0], self._digit_speeds
        return FilterStep(scan.timestamp_s, estimate, probability, is_linked, turns_before, speeds), fingers

    @property
    def _digit_speeds(self) -> DigitSpeeds:
        """Rates of the digits, where the tissue goes by them."""
        if self.fingers is None or not self.motion.tissue.is_joint_driven:
            return ZERO_SPEEDS
        return self.fingers.joint_speeds

    def finger_start(self, timestamp_s: float) -> FingerStart | None:
        """Return the estimate of the fingers now, for smoothing over the frames to come."""
        fingers = self.fingers
        if fingers is None:
            return None
        return FingerStart(fingers.estimates, fingers.history.unseen_s, timestamp_s, self._palm is None)

    def find_palm(self, ideal: Detections, turn_limits: TurnLimits) -> FoundPalm | None:
        """Find the palm among the blobs without a prediction."""
        shapes = SHAPE.stop - SHAPE.start
        disc_covariance = self._stationary[SKIN, SKIN] + self._learnt_covariance[:shapes, :shapes]
        is_in_reach = None if self.fingers is None else self.fingers.is_in_reach
        return find_palm(ideal, self.view, disc_covariance, turn_limits, is_in_reach)

    def estimate_from_found(self, found: FoundPalm) -> PalmEstimate:
        """Return the state estimate of a palm found without a prediction."""
        initial = InitialSd(velocity_m_s=VELOCITY_SD_M_S, rate_rad_s=RATE_SD_RAD_S)
        estimate = initial_estimate(initial, self._learnt_covariance)
        estimate.covariance[POSE[:, None], POSE] = found.pose_covariance(self.view.palm_m)
        estimate.covariance[SKIN, SKIN] = self._stationary[SKIN, SKIN]
        estimate.covariance[RELIEF, RELIEF] = self._stationary[RELIEF, RELIEF]
        estimate.value[CALIBRATION_ERROR], estimate.value[:3] = self._learnt_error, found.position_m
        return replace(estimate, rotation_w2_w0=found.rotation_w2_w0)

    def is_contradicted(self, found: FoundPalm, posterior: Posterior) -> bool:
        """Return whether a palm found is turned further than a well measured prediction allows."""
        palm, settings, nominal = posterior.palm, self._settings.association, posterior.predicted.nominal
        if posterior.seen_count < MIN_PALM_MARKERS or not is_jointly_compatible(palm.nis, palm.dof, settings):
            return False
        turn = so3.log(nominal.rotation_w2_w0.T @ found.rotation_w2_w0)
        covariance = nominal.covariance[TURN, TURN] + found.pose_covariance(self.view.palm_m)[3:, 3:]
        return bool(turn @ np.linalg.solve(covariance, turn) > settings.gate_sd**2)

    def is_other_hand(self, posterior: Posterior, scan: Scan) -> bool:
        """Return whether discs of the other hand were associated with this palm."""
        assigned, rest = posterior.palm.assigned, ~posterior.is_finger
        is_assigned = np.zeros(rest.size, dtype=bool)
        is_assigned[assigned[assigned >= 0]] = True
        return is_other_hand(scan.ideal.subset(rest), is_assigned[rest], self.view)

    def predict_from_found(self, found: FoundPalm, predicted: PredictedMeasurement) -> PredictedMeasurement:
        """Return the predicted measurement of a palm where it was found."""
        estimate = self.estimate_from_found(found)
        return predicted.with_estimate(estimate, self._resting_mixture(estimate))

    def restart_labelled_digit(self, marker: int) -> None:
        """Restart the digit of which a person has labelled a disc."""
        digits = np.flatnonzero(self.order.has_discs)[(self.order.digits == marker).any(axis=1)]
        if self.fingers is not None and digits.size:
            self.fingers.restart_digit(int(digits[0]))

    def read_joints(self, posterior: Posterior) -> JointState | None:
        """Return thumb and fingers after an update was accepted."""
        if self.fingers is None or posterior.fingers is None:
            return None
        return self.fingers.read_joints(posterior.fingers)


def _fade_velocity(
    estimate: PalmEstimate, mixture: ModeMixture, kept: NDArray[np.float64]
) -> tuple[PalmEstimate, ModeMixture]:
    """Fade the velocities: the estimate times ``kept`` (n, n)."""
    estimate = PalmEstimate(estimate.rotation_w2_w0, kept @ estimate.value, kept @ estimate.covariance @ kept.T)
    return estimate, ModeMixture(mixture.mean @ kept.T, kept @ mixture.covariance @ kept.T, mixture.probability)

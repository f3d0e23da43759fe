"""The filter's cycle on one hand: predict, associate, update.

The palm is associated and updated by its discs, then by the surface of the back of the hand; thumb and fingers follow
on the palm as updated, by the blobs that are left. An update is a trial: nothing is remembered until it is accepted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.model import so3
from carpus.core.model.camera import Camera
from carpus.core.model.types import BoolArray, Detections, FloatArray
from carpus.core.tracking.association.association import is_jointly_compatible
from carpus.core.tracking.association.operator_labels import LabelledBlob
from carpus.core.tracking.association.palm_association import (
    Measurements,
    UpdatedPalm,
    associate_and_update,
    measurements_from_blobs,
    update_palm,
)
from carpus.core.tracking.association.reacquire import (
    RATE_SD_RAD_S,
    VELOCITY_SD_M_S,
    FoundPalm,
    TurnLimits,
    find_palm,
    is_other_hand,
)
from carpus.core.tracking.association.track_manager import COLLINEAR_RMS_M, MIN_PALM_MARKERS
from carpus.core.tracking.digits.digit_readout import base_from_estimate
from carpus.core.tracking.digits.digit_update import DigitFrame, DigitPosterior
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
    PredictedMeasurement,
    adapt_noise_factor,
    depth_bias_matrix,
    predict_measurement,
    predict_measurement_ahead,
    shape_covariance,
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
from carpus.core.tracking.finger_filter import FingerFilter
from carpus.core.tracking.smoother.finger_smoother import FingerStart, FingerStep
from carpus.core.tracking.smoother.palm_smoother import FilterStep

_REREAD_NOISE_FACTOR = 2.0
"""The picture is read once more right after: half of its weight now, half then."""


def reinitialise_disc(
    predicted: PredictedMeasurement,
    view: PalmView,
    disc: int,
    blob: int,
    blobs: Measurements,
    settings: TrackerSettings,
) -> tuple[PalmEstimate, ModeMixture, PalmView]:
    """Estimate and mixture with the palm's ``disc`` (its row of 6) at a blob, and the view to go on with."""
    u_px, v_px, depth_m = blobs.value[blob]
    depth_m = depth_m if np.isfinite(depth_m) else float(predicted.mean[disc, 2])
    estimate = predicted.nominal
    in_camera = view.camera.backproject(np.array([[u_px, v_px]]), np.array([depth_m]))[0]
    in_w0 = view.rotation_w0_cam.T @ (in_camera - view.translation_w0_cam_m)
    on_palm_m = estimate.rotation_w2_w0.T @ (in_w0 - estimate.position_m)

    shape, skin = (np.arange(part.start + 3 * disc, part.start + 3 * disc + 3) for part in (SHAPE, SKIN))
    own = np.concatenate((shape, skin))
    fresh = np.zeros((6, 6))
    fresh[:3, :3] = PLACED_DISC_SD_M**2 * np.eye(3)
    fresh[3:, 3:] = stationary_covariance(settings.tissue)[skin[:, None], skin]
    value = estimate.value.copy()
    value[shape], value[skin] = on_palm_m - view.palm_m[disc], 0.0
    estimate = PalmEstimate(estimate.rotation_w2_w0, value, _with_block(estimate.covariance, own, fresh))
    mean = predicted.mixture.mean.copy()
    mean[..., own] = 0.0
    mixture = ModeMixture(mean, _with_block(predicted.mixture.covariance, own, fresh), predicted.mixture.probability)

    # How wrong its depth was at the calibration says nothing of it any more.
    hidden = view.hidden.copy()
    hidden[disc, 3 * disc : 3 * disc + 3] = 0.0
    view = replace(view, hidden=hidden)
    assigned: NDArray[np.int64] = np.full(len(predicted.mean), -1, dtype=np.int64)
    assigned[disc] = blob
    with_depth: BoolArray = (assigned >= 0) & np.isfinite(blobs.value[blob, 2])
    whole = predict_measurement(estimate, mixture, view, settings.spread)
    measured = update_palm(whole, blobs, assigned, with_depth, np.full((assigned.size, 3), _REREAD_NOISE_FACTOR))
    return *reset_error(estimate, measured.mixture), view


def with_placed_discs(view: PalmView, shape: FloatArray, is_placed: BoolArray) -> PalmView:
    """The view in which to look for the hand anew: the discs that a person ``named`` (6,) where they are by now, by the
    shape (18,)."""
    if not is_placed.any():
        return view
    return replace(view, palm_m=view.palm_m + np.where(is_placed[:, None], shape.reshape(-1, 3), 0.0))


def _with_block(covariance: FloatArray, rows: NDArray[np.int64], block: FloatArray) -> FloatArray:
    """A covariance (..., n, n) in which those rows go with nothing else, and with each other as in ``block``."""
    out = covariance.copy()
    out[..., rows, :] = 0.0
    out[..., :, rows] = 0.0
    out[..., rows[:, None], rows] = block
    return out


_TURN_VARIANCES = tuple((SIZE + 1) * row for row in range(TURN.start, TURN.stop))
"""Where they stand in the covariance, counted row by row."""
JOINT_SD_RAD = 0.05
"""Predicted less surely, the hand is turned by its markers before the surface is fitted."""
PLACED_DISC_SD_M = 0.02
"""So far from where the one picture shows it a disc shown elsewhere may be: more than any depth errs."""
_MIN_DEPTH_M = 0.1
"""No camera sees a hand nearer: keeps the size of a disc finite."""


@dataclass(frozen=True, slots=True)
class Scan:
    """What one frame brings: its time and the time since the last, the blobs where an ideal camera would see them, and
    these as measurements."""

    timestamp_s: float
    dt_s: float
    ideal: Detections
    blobs: Measurements

    def without_blobs(self) -> Scan:
        """The scan as if no blob were in it."""
        none = np.zeros(len(self.ideal), dtype=bool)
        blobs = Measurements(self.blobs.value[none], self.blobs.variance[none])
        return replace(self, ideal=self.ideal.subset(none), blobs=blobs)


def undistort_detections(detections: Detections, camera: Camera) -> Detections:
    """Blobs and readings where a camera without distortion would see them."""
    if not camera.is_distorted:
        return detections
    surface, fingers = (
        None if some is None else replace(some, pixel=camera.undistort(some.pixel))
        for some in (detections.surface, detections.fingers)
    )
    return replace(detections, pixel=camera.undistort(detections.pixel), surface=surface, fingers=fingers)


def _turn_sd_rad(predicted: PredictedMeasurement) -> float:
    return math.sqrt(sum(map(predicted.nominal.covariance.item, _TURN_VARIANCES)))


@dataclass(frozen=True, slots=True)
class Posterior:
    """The hand updated by one scan from what was ``predicted``: the ``palm`` as associated, its modes as errors from
    ``estimate``, and the fingers on it.

    ``seen_count`` discs of the palm; ``unassigned`` (D,) blobs that are neither's, ``is_finger`` (D,) blobs that are
    the fingers'.
    """

    predicted: PredictedMeasurement
    palm: UpdatedPalm
    estimate: PalmEstimate
    mixture: ModeMixture
    seen_count: int
    fingers: DigitPosterior | None
    unassigned: NDArray[np.bool_]
    is_finger: NDArray[np.bool_]

    @property
    def turn_sd_rad(self) -> float:
        """How surely the hand's turn was predicted, all axes and modes together."""
        return _turn_sd_rad(self.predicted)


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
            depth_bias_matrix(calibration, settings.shape_hidden),
        )
        self.readout = Readout(calibration, camera, settings.marker_radius_m)
        # Blobs alone do not tell tissue that rests from a hand that moves; joints that are seen tell when it moves.
        seen = joint_driven_modes if self.fingers is not None else resting_and_moving_modes
        tissue = (single_moving_mode if self._surface is None else seen)(settings.tissue)
        self.motion = PalmMotion(settings.motion_noise, tissue, np.array(settings.mode_scales))
        self._calibrated_covariance = self._calibration_covariance(calibration)
        self._stationary = stationary_covariance(settings.tissue)
        self._resolution_px2 = float(camera.width_px * camera.height_px)
        self._noise_factor = np.ones((rows.size, 3))
        self._is_reinitialised = np.zeros(rows.size, dtype=bool)
        self._prediction: tuple[object, object, float, PredictedMeasurement] | None = None
        self.begin_at_neutral()

    def begin_at_neutral(self) -> None:
        self._learnt_error, self._learnt_covariance = (
            np.zeros(CALIBRATION_ERROR.stop - CALIBRATION_ERROR.start),
            self._calibrated_covariance,
        )
        start = initial_estimate(self._settings.initial, self._learnt_covariance)
        self.start(start, self.motion.initial_probability)
        self._is_reinitialised[:] = False
        if self.fingers is not None:
            self.fingers.begin_at_neutral()

    def _calibration_covariance(self, calibration: Calibration) -> FloatArray:
        """Covariance (21, 21) of what the calibration says of the discs' places and of the back of the hand."""
        settings, shapes = self._settings, SHAPE.stop - SHAPE.start
        out = np.zeros((CALIBRATION_ERROR.stop - CALIBRATION_ERROR.start,) * 2)
        out[:shapes, :shapes] = shape_covariance(calibration, self.view.camera.sensor, settings.noise)
        out[shapes:, shapes:] = np.eye(3)
        if self._surface is not None:
            out[shapes:, shapes:] = surface_calibration_covariance(self._surface, self.view, settings.surface)
        return out

    def start(self, estimate: PalmEstimate, probability: FloatArray | None = None) -> None:
        """Start from a state estimate of the palm, its modes of a ``probability`` (K,), or all alike."""
        mixture = self._resting_mixture(estimate)
        mixture = mixture if probability is None else replace(mixture, probability=probability[None])
        self._palm: tuple[PalmEstimate, ModeMixture] | None = (estimate, mixture)
        self._unobserved_turns: NDArray[np.float64] | None = None

    def _resting_mixture(self, estimate: PalmEstimate) -> ModeMixture:
        return ModeMixture.from_gaussian(np.zeros((1, SIZE)), estimate.covariance[None], self.motion.modes)

    def drop_track(self) -> None:
        """Nothing is known any more but the hand's anatomy."""
        self._palm = None
        if self.fingers is not None:
            self.fingers.reset_joints()

    def predict(self, dt_s: float) -> PredictedMeasurement:
        """The state ``dt_s`` after the last frame, and what the camera should see of it; worked out once."""
        assert self._palm is not None
        fingers = None if self.fingers is None else self.fingers.estimates
        if self._prediction is None or not (
            self._prediction[0] is self._palm and self._prediction[1] is fingers and self._prediction[2] == dt_s
        ):
            digits = None if self.fingers is None else self.fingers.predict(dt_s)
            ahead = predict_measurement_ahead(
                *self._palm,
                self.view,
                self.motion,
                dt_s,
                self._unobserved_turns,
                self._digit_speeds,
                self._settings,
                digits,
                self.order,
            )
            self._prediction = self._palm, fingers, dt_s, ahead
        return self._prediction[3]

    def build_scan(self, predicted: PredictedMeasurement, ideal: Detections, timestamp_s: float, dt_s: float) -> Scan:
        """The blobs as measurements at the distance at which the hand was predicted."""
        depth_m, camera = max(float(predicted.mean[0, 2]), _MIN_DEPTH_M), self.view.camera
        radius_px = camera.fx_px * self._settings.marker_radius_m / depth_m
        return Scan(timestamp_s, dt_s, ideal, measurements_from_blobs(ideal, radius_px, self._settings, camera.sensor))

    def update(self, predicted: PredictedMeasurement, scan: Scan) -> Posterior:
        """Associate the blobs with the discs that were predicted and update by them."""
        blobs, enough, is_sure = scan.blobs, MIN_PALM_MARKERS + 1, _turn_sd_rad(predicted) < JOINT_SD_RAD
        if is_sure:
            blobs = replace(blobs, surface=self._fit_surface(predicted.nominal, scan))
        palm = associate_and_update(predicted, blobs, enough, self._resolution_px2, self._noise_factor, self._settings)
        estimate, mixture = reset_error(predicted.nominal, palm.mixture)
        surface = None if is_sure else self._fit_surface(estimate, scan)
        if surface is not None:
            there = replace(predicted, nominal=estimate, mixture=mixture)
            alone = Measurements(np.empty((0, 3)), np.empty((0, 3)), surface)
            none: NDArray[np.int64] = np.full(palm.assigned.size, -1)
            update = update_palm(there, alone, none, none >= 0, self._noise_factor)
            if update.by_surface:
                estimate, mixture = reset_error(estimate, update.mixture)
                palm = replace(palm, by_surface=True)
        unassigned, is_finger = np.ones(len(blobs), dtype=bool), np.zeros(len(blobs), dtype=bool)
        is_named = palm.assigned >= 0
        unassigned[palm.assigned[is_named]] = False
        fingers = None
        if self.fingers is not None and predicted.digits is not None:
            seat = base_from_estimate(estimate, self.view, self.readout)
            picture = DigitFrame(scan.dt_s, seat, blobs, scan.ideal.area_px, unassigned)
            fingers = self.fingers.updater.update(predicted.digits, picture, scan.ideal.fingers)
            is_finger[fingers.blob[fingers.blob >= 0]] = True
        seen = int(np.count_nonzero(is_named))
        return Posterior(predicted, palm, estimate, mixture, seen, fingers, unassigned & ~is_finger, is_finger)

    def _fit_surface(self, estimate: PalmEstimate, scan: Scan) -> SurfaceMeasurement | None:
        samples = scan.ideal.surface
        if self._surface is None or samples is None:
            return None
        return fit_surface(estimate, samples, self._surface, self.view, self._settings.surface)

    def is_consistent(self, posterior: Posterior) -> bool:
        """Whether the discs lie where the updated pose puts them."""
        return bool((np.abs(posterior.palm.raw_residual) <= self._settings.noise.outlier_sd).all())

    @property
    def is_rotation_observed(self) -> bool:
        """Whether the last picture showed every turn of the hand."""
        return self._unobserved_turns is None

    def is_rotation_measured(self, posterior: Posterior) -> bool:
        """Whether what was measured shows every turn of the hand."""
        return posterior.palm.by_surface or self._find_unobserved_turns(posterior) is None

    def _find_unobserved_turns(self, posterior: Posterior) -> NDArray[np.float64] | None:
        return find_unobserved_turns(self.view.palm_m[posterior.palm.assigned >= 0], COLLINEAR_RMS_M)

    def learn(self, posterior: Posterior, dt_s: float) -> None:
        """Take what outlives a lost track: each disc's noise, and the palm's shape."""
        palm, noise = posterior.palm, self._settings.noise
        self._noise_factor = adapt_noise_factor(self._noise_factor, palm.raw_residual, palm.is_measured, dt_s, noise)
        self._learnt_error = posterior.estimate.value[CALIBRATION_ERROR]
        self._learnt_covariance = posterior.estimate.covariance[CALIBRATION_ERROR, CALIBRATION_ERROR]

    def accept(
        self, posterior: Posterior, scan: Scan, *, is_seen: bool, is_linked: bool
    ) -> tuple[FilterStep, FingerStep | None]:
        """Go on from an update; what the smoother needs of it. ``is_seen``: enough discs tell the palm's pose;
        ``is_linked``: the step follows from the one before."""
        unseen, self._unobserved_turns = self._unobserved_turns, None
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
        return FilterStep(scan.timestamp_s, estimate, probability, is_linked, unseen, speeds), fingers

    @property
    def _digit_speeds(self) -> DigitSpeeds:
        """How fast the digits move now, where the tissue goes by it."""
        return (
            ZERO_SPEEDS if self.fingers is None or not self.motion.tissue.follows_joints else self.fingers.joint_speeds
        )

    def finger_start(self, timestamp_s: float) -> FingerStart | None:
        """What is believed of the fingers now, for smoothing over the frames to come."""
        return None if self.fingers is None else self.fingers.smoother_start(timestamp_s, self._palm is None)

    def find_palm(self, ideal: Detections, facing: TurnLimits) -> FoundPalm | None:
        """The palm as the blobs show it without any prediction."""
        shapes = SHAPE.stop - SHAPE.start
        strays = self._stationary[SKIN, SKIN] + self._learnt_covariance[:shapes, :shapes]
        reach = None if self.fingers is None else self.fingers.is_in_reach
        return find_palm(ideal, self._current_view, strays, facing, reach)

    @property
    def _current_view(self) -> PalmView:
        """The palm as calibrated, but for discs that a person showed elsewhere."""
        return with_placed_discs(self.view, self._learnt_error[: SHAPE.stop - SHAPE.start], self._is_reinitialised)

    def estimate_from_found(self, found: FoundPalm) -> PalmEstimate:
        """The state estimate of a palm found without any prediction."""
        initial = InitialSd(velocity_m_s=VELOCITY_SD_M_S, rate_rad_s=RATE_SD_RAD_S)
        estimate = initial_estimate(initial, self._learnt_covariance)
        estimate.covariance[POSE[:, None], POSE] = found.pose_covariance(self.view.palm_m)
        estimate.covariance[SKIN, SKIN] = self._stationary[SKIN, SKIN]
        estimate.covariance[RELIEF, RELIEF] = self._stationary[RELIEF, RELIEF]
        estimate.value[CALIBRATION_ERROR], estimate.value[:3] = self._learnt_error, found.position_m
        return replace(estimate, rotation_w2_w0=found.rotation_w2_w0)

    def is_contradicted(self, found: FoundPalm, posterior: Posterior) -> bool:
        """Whether a palm was found turned further than a prediction leaves open that enough discs bear out."""
        palm, own, nominal = posterior.palm, self._settings, posterior.predicted.nominal
        if posterior.seen_count < MIN_PALM_MARKERS or not is_jointly_compatible(palm.nis, palm.dof, own.association):
            return False
        off = so3.log(nominal.rotation_w2_w0.T @ found.rotation_w2_w0)
        either = nominal.covariance[TURN, TURN] + found.pose_covariance(self.view.palm_m)[3:, 3:]
        return bool(off @ np.linalg.solve(either, off) > own.association.gate_sd**2)

    def is_other_hand(self, posterior: Posterior, scan: Scan) -> bool:
        """Whether discs of the other hand were taken for some of this palm."""
        assigned, rest = posterior.palm.assigned, ~posterior.is_finger
        is_named = np.zeros(rest.size, dtype=bool)
        is_named[assigned[assigned >= 0]] = True
        return is_other_hand(scan.ideal.subset(rest), is_named[rest], self._current_view)

    def predict_from_found(self, found: FoundPalm, predicted: PredictedMeasurement) -> PredictedMeasurement:
        """What was predicted, should the palm be where it was found."""
        estimate = self.estimate_from_found(found)
        return predicted.with_estimate(estimate, self._resting_mixture(estimate))

    def place_marker(
        self, label: LabelledBlob, predicted: PredictedMeasurement, scan: Scan
    ) -> PredictedMeasurement | None:
        """The prediction with a disc of the palm begun anew where a person says that it is; None for another disc."""
        if label.marker not in self.order.palm:
            return None
        disc = int(np.flatnonzero(self.order.palm == label.marker)[0])
        estimate, mixture, self.view = reinitialise_disc(
            predicted, self.view, disc, label.blob, scan.blobs, self._settings
        )
        self._noise_factor[disc] = 1.0
        self._is_reinitialised[disc] = True
        self._palm = estimate, mixture
        return predicted.with_estimate(estimate, mixture, self.view)

    def restart_labelled_digit(self, label: LabelledBlob) -> None:
        """Look for the digit anew of which a person has said which spot a disc is."""
        digits = np.flatnonzero(self.order.has_discs)[(self.order.digits == label.marker).any(axis=1)]
        if self.fingers is not None and digits.size:
            self.fingers.restart_digit(int(digits[0]))

    def read_joints(self, posterior: Posterior) -> JointState | None:
        """Thumb and fingers after that update was accepted."""
        if self.fingers is None or posterior.fingers is None:
            return None
        return self.fingers.read_joints(posterior.fingers)


def _fade_velocity(
    estimate: PalmEstimate, mixture: ModeMixture, kept: NDArray[np.float64]
) -> tuple[PalmEstimate, ModeMixture]:
    """Velocities faded: the estimate times ``kept`` (n, n)."""
    estimate = PalmEstimate(estimate.rotation_w2_w0, kept @ estimate.value, kept @ estimate.covariance @ kept.T)
    return estimate, ModeMixture(mixture.mean @ kept.T, kept @ mixture.covariance @ kept.T, mixture.probability)

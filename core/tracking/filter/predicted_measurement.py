"""Measurement of the hand: as predicted for a moment, h linearised there; as blobs give it; and the palm's update."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.neutral_pose import marker_positions_cam_m
from carpus.core.calibration.result import Calibration
from carpus.core.compiled.palm import predict_palm_measurement
from carpus.core.model.camera import Camera
from carpus.core.model.depth_sensor import DepthSensor
from carpus.core.model.types import BoolArray, Detections, FloatArray
from carpus.core.tracking.filter.digit_filter import DigitSigmaPoints, DigitView, digit_sigma_weights
from carpus.core.tracking.filter.hand_geometry import N_DIGITS, N_DISCS, PalmGeometry
from carpus.core.tracking.filter.mixture_filter import (
    Linearisation,
    ModeMixture,
    UnscentedParameters,
    compute_weights,
    partial_update_shares,
    update_mixture,
)
from carpus.core.tracking.filter.motion import PalmMotion, predict_palm
from carpus.core.tracking.filter.palm_state import (
    CALIBRATION_ERROR,
    POSE,
    SIZE,
    TURN,
    ZERO_ERROR,
    PalmEstimate,
    PalmView,
)
from carpus.core.tracking.filter.settings import MeasurementNoise, TrackerSettings
from carpus.core.tracking.filter.soft_tissue import DigitSpeeds
from carpus.core.tracking.filter.surface_fit import SurfaceMeasurement

_MIN_SD_M = 1e-5  # keeps the covariance of a perfectly measured disc positive definite

LOCKED_DEPTH_SHARE = 0.6  # of a reading's error that stays while the hand is still, where depths are rounded to steps
NOISE_ADAPTATION_S = 0.5  # over which each marker's own noise is judged by its residuals

# Share of a frame's information on the shape taken for new, of a hand that moves; and what is left of that while it is
# still.
SHAPE_LEARNING_SHARE, SHAPE_STILL_SHARE = 0.2, 0.02


def ray_covariances(calibration: Calibration, sd_m: FloatArray) -> FloatArray:
    """Return covariances (M, 3, 3) in W0 of errors along the camera's rays, ``sd_m`` (M,) in depth."""
    place = marker_positions_cam_m(calibration)
    ray = (place / place[:, 2:]) @ calibration.rotation_w0_cam
    return np.asarray(np.broadcast_to(sd_m, len(ray))[:, None, None] ** 2 * ray[:, :, None] * ray[:, None, :])


def depth_bias_matrix(calibration: Calibration, share: float) -> FloatArray:
    """Return the matrix (M, 3M) by which a shape (3M,) is missing in the depths (M,) of every pose.

    Its effect on the calibration's depths times the ``share`` of it that is their error: by that much the discs lie
    elsewhere without ever being measured there.
    """
    count = len(calibration.marker_position_w0_m)
    disc = np.arange(count)
    out = np.zeros((count, count, 3))
    out[disc, disc] = share * calibration.rotation_w0_cam[2]
    return out.reshape(count, -1)


def compute_fresh_share(before_m: FloatArray, after_m: FloatArray, camera: Camera) -> float:
    """Return how far the depths' errors differ from those of the last frame, 0 to 1.

    By how much the discs (M, 3), in camera axes, have moved meanwhile: across by so much of a matching window, along by
    so much of a reading's error.
    """
    across_m, down_m, along_m = (np.add.reduce(np.abs(after_m - before_m)) / len(after_m)).tolist()
    depth_m = float(np.add.reduce(after_m[:, 2])) / len(after_m)
    windows = math.hypot(across_m, down_m) * camera.fx_px / depth_m / camera.sensor.patch_px
    return 1.0 - math.exp(-2.0 * windows - along_m / float(camera.sensor.reading_sd_m(np.array(depth_m))))


def shape_partial_update(new_share: float) -> FloatArray:
    """Return shares (n,) of an update that the mean takes; ``new_share`` (0 to 1) of the information is new.

    The calibration error takes only as much as is new; everything else takes the whole update.
    """
    return partial_update_shares(SIZE, CALIBRATION_ERROR, 1.0 - math.sqrt(1.0 - new_share))


def shape_covariance(calibration: Calibration, sensor: DepthSensor, noise: MeasurementNoise) -> FloatArray:
    """Return the covariance (18, 18) of the markers' calibrated positions.

    Includes what the scatter of a still hand's depths does not show of their error: ``depth_bias_sd_m``, and the step
    to which a depth remains rounded while the hand is still.
    """
    depth_m = marker_positions_cam_m(calibration)[:, 2]
    rounded_m = 0.0 if sensor.averages else LOCKED_DEPTH_SHARE * sensor.reading_sd_m(depth_m)
    own = calibration.marker_covariance_w0_m2 + ray_covariances(calibration, np.hypot(noise.depth_bias_sd_m, rounded_m))
    own = own + _MIN_SD_M**2 * np.eye(3)
    count = len(own)
    covariance = np.zeros((count, 3, count, 3))
    covariance[np.arange(count), :, np.arange(count), :] = own
    return covariance.reshape(3 * count, -1)


# WRIST, CMC1, MCP2, MCP3, which span the surface of the fixed unit; the knuckles.
DORSAL_DISCS, KNUCKLES = np.arange(4), slice(2, 6)


@dataclass(frozen=True, slots=True)
class MarkerOrder:
    """Rows of the protocol: ``palm`` (6,) of the palm's discs, ``digits`` (R, 3) of those that move.

    ``has_discs`` (5,) digits that carry discs. ``source``: row of each marker among the palm's and, after them, those
    of all digits.
    """

    palm: NDArray[np.int64]
    digits: NDArray[np.int64]
    has_discs: NDArray[np.bool_]

    source: NDArray[np.int64] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        source = np.empty(self.palm.size + self.digits.size, dtype=np.int64)
        source[self.palm] = np.arange(self.palm.size)
        source[self.digits] = self.palm.size + np.arange(N_DIGITS * N_DISCS).reshape(N_DIGITS, N_DISCS)[self.has_discs]
        object.__setattr__(self, "source", source)

    def to_protocol_order(self, palm: NDArray[Any], digits: NDArray[Any] | None) -> NDArray[Any]:
        """Return rows (M, ...) of the protocol from those of the palm (6, ...) and the digits (5, 3, ...)."""
        if digits is None:
            return palm
        every = digits.reshape(N_DIGITS * N_DISCS, *palm.shape[1:])
        return np.asarray(np.concatenate((palm, every)).take(self.source, 0))


@dataclass(frozen=True, slots=True)
class PredictedDigits:
    """Thumb and fingers as predicted, and sigma points of them on the ``palm`` as it was known last."""

    estimates: ModeMixture
    points: DigitSigmaPoints
    palm: PalmGeometry

    def project(
        self, estimate: PalmEstimate, view: PalmView, scaling: UnscentedParameters
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return pixels (5, 3, 2) with covariance (5, 3, 2, 2) given the palm, and depths (5, 3)."""
        own_view = DigitView(*view.to_camera(estimate, self.palm.axes, self.palm.origin_m), view.camera)
        disc_m = self.points.disc_m
        count, image = disc_m.shape[1] // 2, own_view.observe(disc_m.reshape(-1, 3)).reshape(disc_m.shape)
        by_column = (image[:, 1 : count + 1, :, :2] - image[:, count + 1 :, :, :2]) * (
            0.5 / digit_sigma_weights(scaling).scale
        )
        covariance = np.add.reduce(by_column[..., None] * by_column[..., None, :], axis=1)
        return image[:, 0, :, :2], covariance, image[:, 0, :, 2]


@dataclass(frozen=True)
class PredictedMeasurement:
    """The predicted state of the palm, all modes as errors from ``nominal``, and its measurement.

    ``mixture`` (1, K, n), ``linearised`` h; ``mean`` (6, 3) and ``covariance`` (6, 3, 3) of u, v and z of each of the
    palm's discs over all modes; the ``partial`` update that the numbers take; ``digits`` where there are any. As
    properties, for the detection, all markers in the protocol's ``order``.
    """

    nominal: PalmEstimate
    mixture: ModeMixture
    linearised: Linearisation
    mean: FloatArray
    covariance: FloatArray
    view: PalmView
    scaling: UnscentedParameters
    partial: FloatArray | None = None
    digits: PredictedDigits | None = None
    order: MarkerOrder | None = None

    def with_estimate(self, nominal: PalmEstimate, mixture: ModeMixture) -> PredictedMeasurement:
        """Return the predicted measurement at the same moment for another state."""
        return predict_measurement(nominal, mixture, self.view, self.scaling, self.partial, self.digits, self.order)

    def mode_predictions(self) -> tuple[FloatArray, FloatArray]:
        """Return mean (K, 18), eq. (10), and covariance (K, 18, 18), eq. (11), in every mode.

        Of all the palm's discs together, without the measurement noise.
        """
        slope = self.linearised.slope[0]
        return self.linearised.value + self.mixture.mean[0] @ slope.T, slope @ self.mixture.covariance[
            0
        ] @ slope.T + self.linearised.error

    @cached_property
    def turn_sd_rad(self) -> float:
        """Standard deviation of the palm's turn, all axes and modes together."""
        return math.sqrt(sum(self.nominal.covariance.diagonal()[TURN].tolist()))

    @cached_property
    def _digit_image(self) -> tuple[FloatArray, FloatArray, FloatArray] | None:
        return None if self.digits is None else self.digits.project(self.nominal, self.view, self.scaling)

    def _to_protocol_order(self, palm: FloatArray, digits: FloatArray | None) -> FloatArray:
        return palm if self.order is None else self.order.to_protocol_order(palm, digits)

    @property
    def pixel(self) -> FloatArray:
        """Predicted pixels (M, 2)."""
        image = self._digit_image
        return self._to_protocol_order(self.mean[:, :2], None if image is None else image[0])

    @property
    def covariance_px2(self) -> FloatArray:
        """Covariance (M, 2, 2) of the pixels; a digit's includes the palm's."""
        own, image = self.covariance[:, :2, :2], self._digit_image
        return self._to_protocol_order(own, None if image is None else image[1] + own.max(axis=0))

    @property
    def depth_m(self) -> FloatArray:
        """Predicted depths (M,)."""
        image = self._digit_image
        return self._to_protocol_order(self.mean[:, 2], None if image is None else image[2])

    @property
    def dorsal_px(self) -> FloatArray:
        """Discs (4, 2) that span the surface of the back of the hand."""
        return self.mean[DORSAL_DISCS, :2]

    @property
    def finger_px(self) -> FloatArray:
        """Discs (F, 2) on long fingers and their knuckles."""
        image = self._digit_image
        if image is None or self.order is None:
            return self.mean[:0, :2]
        return np.concatenate((self.mean[KNUCKLES, :2], image[0][1:][self.order.has_discs[1:]].reshape(-1, 2)))


def predict_measurement(
    nominal: PalmEstimate,
    mixture: ModeMixture,
    view: PalmView,
    scaling: UnscentedParameters,
    partial: FloatArray | None = None,
    digits: PredictedDigits | None = None,
    order: MarkerOrder | None = None,
) -> PredictedMeasurement:
    """Return the predicted measurement of a mixture of errors about ``nominal``."""
    value, slope, error, mean, own = predict_palm_measurement(
        nominal, mixture, view, compute_weights(POSE.size, scaling)
    )
    linearised = Linearisation(value, slope, error, ZERO_ERROR)
    return PredictedMeasurement(nominal, mixture, linearised, mean, own, view, scaling, partial, digits, order)


def predict_measurement_ahead(
    estimate: PalmEstimate,
    mixture: ModeMixture,
    view: PalmView,
    motion: PalmMotion,
    dt_s: float,
    unobserved_turns: FloatArray | None,
    speeds: DigitSpeeds,
    settings: TrackerSettings,
    digits: PredictedDigits | None = None,
    order: MarkerOrder | None = None,
) -> PredictedMeasurement:
    """Predict the palm ``dt_s`` ahead and its measurement, and how much of its shape that may tell."""
    fresh = 0.0
    if dt_s > 0.0:
        before = estimate
        estimate, mixture = predict_palm(estimate, mixture, motion, dt_s, unobserved_turns, speeds)
        fresh = compute_fresh_share(view.discs_cam_m(before), view.discs_cam_m(estimate), view.camera)
    partial = shape_partial_update(SHAPE_LEARNING_SHARE * max(fresh, SHAPE_STILL_SHARE))
    return predict_measurement(estimate, mixture, view, settings.scaling, partial, digits, order)


# The centre of a partly covered disc may shift by this share of its radius times what is missing of its area below
# MIN_WHOLE_AREA_SHARE.
CENTRE_SHIFT_SHARE, MIN_WHOLE_AREA_SHARE = 0.7, 0.6


@dataclass(frozen=True, slots=True)
class Measurements:
    """Blobs as measurements (D, 3) of pixel u, v and depth (NaN when unknown), with variances (D, 3).

    ``surface`` is what the back of the hand tells beside them, None where it tells nothing.
    """

    value: FloatArray
    variance: FloatArray
    surface: SurfaceMeasurement | None = None

    def __len__(self) -> int:
        return int(self.value.shape[0])


@dataclass(frozen=True, slots=True)
class UpdatedPalm:
    """All modes updated by the associated blobs.

    ``assigned`` (M,) blob of every marker or -1; ``nis`` over all modes with ``dof``; ``is_measured`` (M, 3)
    components, and their ``residual`` (M, 3) in standard deviations, ``raw_residual`` (M, 3) before the worst were
    given more noise; both 0 where nothing was measured. ``by_surface`` whether the surface took part.
    """

    mixture: ModeMixture
    assigned: NDArray[np.int64]
    nis: float
    dof: int
    is_measured: NDArray[np.bool_]
    residual: FloatArray
    raw_residual: FloatArray
    by_surface: bool = False


def measurements_from_blobs(
    blobs: Detections, radius_px: float, settings: TrackerSettings, sensor: DepthSensor
) -> Measurements:
    """Return the blobs with the noise of their pixels and depths.

    ``radius_px`` of a disc at the hand's distance: a blob much smaller than it is half hidden, and its centre not the
    disc's.
    """
    noise = settings.noise
    depth = blobs.depth_m if settings.use_depth else np.full_like(blobs.depth_m, np.nan)
    shown = blobs.area_px / (np.pi * radius_px**2)
    occlusion_sd_px = CENTRE_SHIFT_SHARE * radius_px * np.maximum(MIN_WHOLE_AREA_SHARE - shown, 0.0)
    value = np.empty((len(blobs), 3))
    value[:, :2], value[:, 2] = blobs.pixel, depth
    known = np.isfinite(depth)
    at_m, sd_m = depth, blobs.depth_sd_m
    if not known.all():
        at_m, sd_m = np.where(known, depth, 1.0), np.where(known, sd_m, 1.0)
    model_variance = sensor.disc_sd_m(at_m, blobs.area_px) ** 2
    excess_variance = np.maximum(sd_m**2 - model_variance, 0.0)
    variance = np.empty((len(blobs), 3))
    variance[:, :2] = (noise.pixel_sd_px**2 + occlusion_sd_px**2)[:, None]
    variance[:, 2] = noise.depth_noise_ratio**2 * model_variance + excess_variance + sensor.bias_sd_m(at_m) ** 2
    return Measurements(value, variance)


def update_palm(
    predicted: PredictedMeasurement,
    blobs: Measurements,
    assigned: NDArray[np.int64],
    with_depth: NDArray[np.bool_],
    noise_factor: FloatArray,
) -> UpdatedPalm:
    """Update every mode by the associated blobs and the surface; ``noise_factor`` (M, 3) multiplies the variances.

    A surface that is not this one, given the blobs, is left out.
    """
    used = np.empty((assigned.size, 3), dtype=bool)
    used[:] = (assigned >= 0)[:, None]
    used[:, 2] &= with_depth
    surface = blobs.surface
    if used.any():
        value = np.where(used, blobs.value.take(assigned, 0), np.nan).reshape(1, -1)
        variance = (blobs.variance.take(assigned, 0) * noise_factor).reshape(1, -1)
    elif surface is None:
        nothing = np.zeros(used.shape)
        return UpdatedPalm(predicted.mixture, assigned, float("nan"), 0, used, nothing, nothing)
    else:
        value = variance = np.full((1, used.size), np.nan)
    measurement = predicted.linearised, value, variance
    if surface is not None:
        measurement = surface.extend_measurement(*measurement)
    update = update_mixture(predicted.mixture, *measurement, partial=predicted.partial, tested=used.size)
    if surface is not None and update.rest_nis[0] > surface.max_nis:
        return update_palm(predicted, replace(blobs, surface=None), assigned, with_depth, noise_factor)
    residual, dof = update.residual.reshape(used.shape), int(update.dof[0])
    nis = float(update.nis[0]) if dof else float("nan")
    return UpdatedPalm(update.mixture, assigned, nis, dof, used, residual, residual, surface is not None)


def adapt_noise_factor(
    factor: FloatArray, residual: FloatArray, is_measured: BoolArray, dt_s: float, noise: MeasurementNoise
) -> FloatArray:
    """Return the variance factors (..., 3) of u, v and depth after one more frame.

    Squared residuals should average one; the factor moves towards what makes them so over ``NOISE_ADAPTATION_S``.
    Pixels u, v of a marker share theirs. ``residual`` (..., 3) in standard deviations.
    """
    if dt_s <= 0.0:
        return factor
    weight = 1.0 - math.exp(-dt_s / NOISE_ADAPTATION_S)
    excess = np.where(is_measured, np.minimum(residual * residual, noise.max_variance_factor), 1.0)
    excess[..., :2] = 0.5 * (excess[..., :1] + excess[..., 1:2])
    excess -= 1.0
    grown = factor + weight * factor * excess
    return np.where(
        is_measured, np.minimum(np.maximum(grown, noise.min_variance_factor), noise.max_variance_factor), factor
    )

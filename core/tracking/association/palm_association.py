"""Association of blobs with the discs of the palm, and the update by them.

The separate association first; the joint one where that is not jointly compatible.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.model.depth_sensor import DepthSensor
from carpus.core.model.types import Detections, FloatArray
from carpus.core.tracking.association.association import (
    JointAssociation,
    assign_blobs,
    associate_jointly,
    is_jointly_compatible,
    log_odds,
)
from carpus.core.tracking.filter.mixture_filter import ModeMixture, update_mixture
from carpus.core.tracking.filter.predicted_measurement import PredictedMeasurement
from carpus.core.tracking.filter.settings import AssociationSettings, MeasurementNoise, TrackerSettings
from carpus.core.tracking.filter.surface_fit import SurfaceMeasurement

# The centre of a partly covered disc may shift by this share of its radius times what is missing of its area below
# MIN_WHOLE_AREA_SHARE.
CENTRE_SHIFT_SHARE, MIN_WHOLE_AREA_SHARE = 0.7, 0.6
MAX_OUTLIERS = 3  # measurements in a frame that are given the noise they show


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


def associate_and_update(
    predicted: PredictedMeasurement,
    blobs: Measurements,
    min_assigned: int,
    resolution_px2: float,
    noise_factor: FloatArray,
    settings: TrackerSettings,
) -> UpdatedPalm:
    """Associate by (12), each marker by itself; where not jointly compatible, all jointly.

    Compatible: the joint NIS is within its bound, and ``min_assigned`` markers have a blob unless no blob is left.
    """
    mean, covariance = predicted.mean, predicted.covariance
    markers = len(mean)
    if not len(blobs):
        nothing = np.full(markers, -1, dtype=np.int64)
        return update_palm(predicted, blobs, nothing, nothing > 0, noise_factor)
    odds, uses_depth = log_odds(mean, covariance, blobs.value, blobs.variance, resolution_px2, settings.association)
    assigned = assign_blobs(odds)
    with_depth = uses_depth[np.arange(markers), assigned]
    assigned = _reject_wrong_depths(assigned, with_depth, blobs, mean[:, 2], settings.association)
    simple = update_palm(predicted, blobs, assigned, with_depth, noise_factor)
    count = np.count_nonzero(assigned >= 0)
    if (count >= min_assigned or count == len(blobs)) and is_jointly_compatible(
        simple.nis, simple.dof, settings.association
    ):
        return _inflate_outlier_noise(simple, predicted, blobs, with_depth, noise_factor, settings.noise)
    joint = _associate_by_mode(predicted, blobs, resolution_px2, settings)
    assigned = _reject_wrong_depths(joint.assigned, joint.with_depth, blobs, mean[:, 2], settings.association)
    updated = update_palm(predicted, blobs, assigned, joint.with_depth, noise_factor)
    return _inflate_outlier_noise(updated, predicted, blobs, joint.with_depth, noise_factor, settings.noise)


def _reject_wrong_depths(
    assigned: NDArray[np.int64],
    with_depth: NDArray[np.bool_],
    blobs: Measurements,
    depth_m: FloatArray,
    settings: AssociationSettings,
) -> NDArray[np.int64]:
    """Drop blobs at another depth than ``depth_m`` (M,), unless enough markers bear them out.

    What covers the hand may have blue on it: alone, a blob before or behind a disc's place is not that disc, and far
    before or behind it none is: the depths of a disc's rim and of what is beside it mix only where these lie near.
    """
    is_off_depth = (assigned >= 0) & ~with_depth
    if not is_off_depth.any():
        return assigned
    off_m = np.abs(blobs.value[assigned, 2] - depth_m)
    is_off_depth &= np.isfinite(off_m)
    if np.count_nonzero((assigned >= 0) & ~is_off_depth) >= settings.min_markers_at_depth:
        is_off_depth &= off_m > settings.max_depth_error_m
    return np.where(is_off_depth, -1, assigned)


def _associate_by_mode(
    predicted: PredictedMeasurement, blobs: Measurements, resolution_px2: float, settings: TrackerSettings
) -> JointAssociation:
    """Find the most probable joint association over all motion modes.

    While the hand rests the mixture of the modes is as narrow as the calm one; a start is seen by the lively one.
    """
    every = [
        associate_jointly(mean, covariance, blobs.value, blobs.variance, resolution_px2, settings.association)
        for mean, covariance in zip(*predicted.mode_predictions(), strict=True)
    ]
    score = [one.log_posterior for one in every] + np.log(predicted.mixture.probability[0])
    return every[int(np.argmax(score))]


def _inflate_outlier_noise(
    updated: UpdatedPalm,
    predicted: PredictedMeasurement,
    blobs: Measurements,
    with_depth: NDArray[np.bool_],
    noise_factor: FloatArray,
    noise: MeasurementNoise,
) -> UpdatedPalm:
    """Update again, the worst measurements given the noise that their residuals show, one by one.

    A disc half behind the rim is still that disc, but its centre is not where it seems.
    """
    factor = noise_factor
    for _ in range(MAX_OUTLIERS):
        marker, axis = divmod(int(np.abs(updated.residual).argmax()), 3)
        size = abs(float(updated.residual[marker, axis]))
        if size <= noise.outlier_sd:
            break
        factor = factor.copy()
        factor[marker, 2:] *= size**2 if axis == 2 else 1.0
        factor[marker, :2] *= 1.0 if axis == 2 else size**2
        updated = replace(
            update_palm(predicted, blobs, updated.assigned, with_depth, factor), raw_residual=updated.raw_residual
        )
    return updated

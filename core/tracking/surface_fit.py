"""The pose of the fixed unit from the surface of the back of the hand: point to plane, a few Gauss-Newton steps.

Thousands of depth readings lie on the back of the hand, and six discs. The surface over capitate, second and third
metacarpal turns with the bones while skin glides over them; so it tells how the hand is tilted where the discs, which
ride on the skin, mislead. It tells the turns about X and Y and the height; the rest the discs know better.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from carpus.core import so3
from carpus.core.hand.back_surface import BackSurface
from carpus.core.kernels.choice import NOTHING, in_c
from carpus.core.tracking.kernel import Linearisation, ModeMixture, corrected, like
from carpus.core.tracking.palm_state import BACK, POSITION, RELIEF, SIZE, TURN, PalmEstimate, View, error_reset
from carpus.core.types import FloatArray, SurfaceSamples

_KEPT = np.array([0, 1, 5])
"""Turn about X and Y and shift along Z among turn and shift."""
_NO_NOISE = np.full((1, 3), 1e-12)


@dataclass(frozen=True, slots=True)
class SurfaceSettings:
    """``steps`` of Gauss-Newton; residuals beyond ``huber_m`` count less, beyond ``most_m`` not at all; with less than
    ``least`` readings the surface is not asked. Readings nearer to each other than the sensor's patch share the
    part ``shared`` of their variance, which is not of rounding to steps of disparity (clinical reference 7.2: a step is
    two standard deviations), or all of it where the sensor has no such steps; ``reading_per_m`` is a reading's at
    least, over the depth squared.
    ``turn_sd_rad`` and ``up_sd_m`` that no number of readings takes away from one picture. Beyond ``most_nis`` it is
    not this surface. ``goes_on``: by how much more the error of one picture counts since the next has a part of it
    again; ``stays``: share of it that comes again as long as the hand is still."""

    steps: int = 3
    huber_m: float = 0.003
    most_m: float = 0.010
    least: int = 24
    shared: float = 2.0 / 3.0
    reading_per_m: float = 1.5e-3
    turn_sd_rad: float = 0.004
    up_sd_m: float = 0.0002
    most_nis: float = 40.0
    stays: float = 0.6
    goes_on: float = 1.5


@dataclass(frozen=True, slots=True)
class SurfaceMeasurement:
    """What the surface says of an estimate's error: ``value`` (3,) turn about X and Y and height at the surface's
    middle, its ``covariance`` (3, 3), as a ``slope`` (3, n) of the palm's error vector; ``count`` readings used."""

    value: FloatArray
    covariance: FloatArray
    slope: FloatArray
    count: int

    def linearised(self) -> Linearisation:
        """Linear about the estimate's mean."""
        return Linearisation(np.zeros((1, 3)), self.slope[None], self.covariance[None], np.zeros((1, SIZE)))


def surface_measurement(
    estimate: PalmEstimate, samples: SurfaceSamples, surface: BackSurface, view: View, settings: SurfaceSettings
) -> SurfaceMeasurement | None:
    """Fit the surface to the readings, from the estimate's pose on; None where too few lie on it."""
    in_camera = view.camera.back_project(samples.pixel, samples.depth_m)
    in_w0 = np.ones((len(in_camera), 4))
    in_w0[:, :3] = (in_camera - view.translation_w0_cam_m) @ view.rotation_w0_cam
    rotation, position = estimate.rotation_w2_w0, estimate.position_m
    middle = surface.middle_m
    middle_x, middle_y, middle_z = middle.tolist()
    to_body = np.eye(4)
    shifted, turned = np.zeros(3), np.zeros(3)
    own, weighed, inverse, weight, over = (np.empty(0),) * 5
    near, count = np.empty(0, dtype=bool), 0
    for _ in range(settings.steps):
        to_body[:3, :3], to_body[3, :3] = rotation, -position @ rotation - middle
        place, plane = surface.under(in_w0, to_body)
        over = np.vecdot(place, plane)
        size = np.abs(over)
        near = size < settings.most_m
        count = int(np.count_nonzero(near))
        if count < settings.least:
            return None
        own = _turns_and_shifts(place, plane)
        weight = settings.huber_m / np.maximum(size, settings.huber_m)
        weight *= near
        # Turns about the middle of the surface, and the shift along Z.
        about = own[_KEPT]
        weighed = about * weight
        inverse = np.linalg.inv(weighed @ about.T)
        about_x, about_y, up = (inverse @ (weighed @ over)).tolist()
        # The turn is about the middle of the surface; the estimate's error is a turn about its origin.
        turn = np.array((about_x, about_y, 0.0))
        shift = np.array((-about_y * middle_z, about_x * middle_z, up - about_x * middle_y + about_y * middle_x))
        shifted += shift
        turned += turn
        position = position + rotation @ shift
        rotation = rotation @ so3.exp(turn)
    spread2 = float(weight @ over**2 / weight.sum())
    sensor, depth_m = view.camera.sensor, _median(samples.depth_m)
    reading_m = max(settings.reading_per_m * depth_m**2, float(sensor.reading_sd_m(np.array(depth_m))))
    scatter2 = max(spread2, reading_m**2)
    shared = 1.0 if sensor.averages else settings.shared
    together = _as_errors_go(weighed[:, near], samples.pixel[near], sensor.patch_px, shared)
    covariance = settings.goes_on * scatter2 * (inverse @ together @ inverse)
    # What stays and changes slowly over the picture tilts and lifts the surface as a whole.
    up_m = float(sensor.stays_sd_m(np.array(depth_m))) if sensor.stays_px else 0.0
    turn_rad = up_m * view.camera.fx_px / (max(sensor.stays_px, 1.0) * depth_m)
    covariance[0, 0] += settings.turn_sd_rad**2 + turn_rad**2
    covariance[1, 1] += settings.turn_sd_rad**2 + turn_rad**2
    covariance[2, 2] += settings.up_sd_m**2 + up_m**2
    # Of the whole pose: a shift along the surface and a turn about its normal also move what is read.
    by_pose = inverse @ (weighed @ own.T)
    by_shift = by_pose[:, 3:]
    by_turn = by_pose[:, :3] + by_shift @ so3.skew(middle).T
    out = np.zeros((3, SIZE))
    out[:, TURN] = by_turn
    out[:, POSITION] = by_shift @ estimate.rotation_w2_w0.T
    out[:, RELIEF] = out[:, BACK] = np.eye(3)
    # What the estimate's own relief explains of it is no error.
    value = by_shift @ shifted + by_turn @ turned - estimate.value[RELIEF] - estimate.value[BACK]
    return SurfaceMeasurement(value, np.asarray(covariance, dtype=np.float64), out, count)


def calibrated_covariance(surface: BackSurface, view: View, settings: SurfaceSettings) -> FloatArray:
    """Covariance (3, 3) of the calibrated surface's own turn about X and Y and height: the share ``stays`` of one
    picture's errors, since these come again in every picture of a still hand and no averaging removes them."""
    node = surface.places_m()
    in_camera = node @ view.rotation_w0_cam.T + view.translation_w0_cam_m
    samples = SurfaceSamples(view.camera.project(in_camera), in_camera[:, 2])
    neutral = PalmEstimate(np.eye(3), np.zeros(SIZE), np.eye(SIZE))
    bare = replace(settings, turn_sd_rad=0.0, up_sd_m=0.0, goes_on=1.0)
    found = surface_measurement(neutral, samples, surface, view, bare)
    return np.eye(3) if found is None else settings.stays**2 * found.covariance


def levelled_mixture(
    mixture: ModeMixture, found: SurfaceMeasurement, partial: FloatArray | None, settings: SurfaceSettings
) -> ModeMixture | None:
    """The palm's modes corrected by what the surface says, numbers taking their ``partial``; None where it is so far
    from what was believed that it is another surface."""
    # Its noise has no scale of its own: the covariance is all there is.
    update = corrected(mixture, found.linearised(), found.value[None], _NO_NOISE, partial=partial)
    return None if float(update.nis[0]) > settings.most_nis else update.mixture


def reset_and_levelled(
    nominal: PalmEstimate,
    mixture: ModeMixture,
    samples: SurfaceSamples | None,
    surface: BackSurface | None,
    view: View,
    partial: FloatArray | None,
    settings: SurfaceSettings,
) -> tuple[PalmEstimate, ModeMixture, bool]:
    """The palm after an update by its discs: :func:`error_reset`, then corrected by the surface of the back of the hand
    and reset once more; and whether the surface said anything."""
    if (kernels := in_c()) is not None:
        out, estimate = like(mixture), PalmEstimate(np.empty((3, 3)), np.empty(SIZE), np.empty((SIZE, SIZE)))
        levelled, fitted = np.empty(1, dtype=np.bool_), (0, *(NOTHING,) * 3, 0, 0, *(NOTHING,) * 3)
        if surface is not None and samples is not None:
            fitted = (
                len(samples.depth_m), samples.pixel, samples.depth_m, view.numbers, *surface.height_m.shape,
                surface._plane, surface._to_node, surface.middle_m,
            )  # fmt: skip
        kernels.palm_reset(
            mixture.mean.shape[1], mixture.mean, mixture.covariance, mixture.probability, nominal.value,
            nominal.rotation_w2_w0, *fitted, settings.steps, settings.huber_m, settings.most_m, settings.least,
            settings.shared, settings.reading_per_m, settings.turn_sd_rad, settings.up_sd_m, settings.goes_on,
            settings.most_nis, NOTHING if partial is None else partial, out.mean, out.covariance, out.probability,
            estimate.covariance, estimate.value, estimate.rotation_w2_w0, levelled,
        )  # fmt: skip
        if levelled.item():
            return estimate, out, True
        return estimate, ModeMixture(out.mean, mixture.covariance, mixture.probability), False
    estimate, mixture = error_reset(nominal, mixture)
    if surface is None or samples is None:
        return estimate, mixture, False
    found = surface_measurement(estimate, samples, surface, view, settings)
    after = None if found is None else levelled_mixture(mixture, found, partial, settings)
    return (estimate, mixture, False) if after is None else (*error_reset(estimate, after), True)


def _turns_and_shifts(place: FloatArray, plane: FloatArray) -> FloatArray:
    """By how much turns about the axes and shifts along them (6, s) bring places (s, 3 or more) off their planes."""
    x, y, z = place[:, 0], place[:, 1], place[:, 2]
    along = plane.T[:3]
    out = np.empty((6, len(place)))
    out[0] = y * along[2] - z * along[1]
    out[1] = z * along[0] - x * along[2]
    out[2] = x * along[1] - y * along[0]
    out[3:] = along
    return out


def _as_errors_go(weighed: FloatArray, pixel: FloatArray, patch_px: float, shared: float) -> FloatArray:
    """Covariance (3, 3) of sums ``weighed`` (3, s) over readings of unit variance at ``pixel`` (s, 2), of which two
    share as much of the part ``shared`` of their errors as their patches overlap."""
    overlap = np.abs(pixel[:, None] - pixel)
    overlap *= -1.0 / patch_px
    overlap += 1.0
    np.maximum(overlap, 0.0, out=overlap)
    together = weighed @ (overlap[..., 0] * overlap[..., 1]) @ weighed.T
    return np.asarray(shared * together + (1.0 - shared) * (weighed @ weighed.T))


def _median(value: FloatArray) -> float:
    """As ``numpy.median`` of finite numbers, which takes ten times as long."""
    ordered = np.sort(value)
    return float(0.5 * (ordered[(ordered.size - 1) // 2] + ordered[ordered.size // 2]))

"""What the camera should see of the palm's discs: h linearised statistically, through sigma points.

Measured for a marker are its pixel u, v (eq. (2), (3) of the wrist paper) and the depth z of its disc along the
camera's axis, as in the initialisation (13). The pose bends the pictures, so h is linearised through sigma points of
the pose (10), (11); in the discs' places it is all but straight, and its slope is the derivative.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from carpus.core import so3
from carpus.core.camera import Camera
from carpus.core.kernels.choice import in_c
from carpus.core.tracking.kernel import Linearisation, ModeMixture
from carpus.core.tracking.palm_state import PALM_DISCS, POSE, SHAPE, SIZE, SKIN, TURN, PalmEstimate
from carpus.core.tracking.unscented import Spread, make_roots, weights_for
from carpus.core.types import FloatArray

_DISC = np.arange(PALM_DISCS)
_FLOOR = 1e-14
_ABOUT = np.zeros((1, SIZE))
_COMPONENTS = 3 * PALM_DISCS
_AXIS = np.arange(3)
_OF_DISC = 3 * _DISC[:, None, None] + _AXIS[:, None]  # (6, 3, 1): each disc's own u, v, z
_BY_SHAPE, _BY_SKIN = (part.start + 3 * _DISC[:, None, None] + _AXIS for part in (SHAPE, SKIN))  # (6, 1, 3)


@dataclass(frozen=True, slots=True)
class View:
    """A palm of known geometry before a camera of known pose (g_w0c of the wrist paper).

    ``palm_m`` (6, 3) calibrated places of the discs on the fixed unit. ``hidden`` (6, 18): by how much each number of
    the shape moves the depths less than the discs' places say, because those of the calibration were as wrong.
    """

    camera: Camera
    rotation_w0_cam: FloatArray
    translation_w0_cam_m: FloatArray
    palm_m: FloatArray
    hidden: FloatArray

    _w0_image: tuple[FloatArray, FloatArray] = field(init=False, repr=False, compare=False)
    """Worked out once: from w0, in metres, to u z, v z, z; applied to rows."""

    def __post_init__(self) -> None:
        camera = self.camera.matrix
        image = (camera @ self.rotation_w0_cam).T.copy(), camera @ self.translation_w0_cam_m
        object.__setattr__(self, "_w0_image", image)

    def discs_cam_m(self, estimate: PalmEstimate) -> FloatArray:
        """Disc centres (6, 3) in camera axes, where the skin has carried them."""
        if (kernels := in_c()) is not None:
            out = np.empty((PALM_DISCS, 3))
            kernels.discs_in_camera(
                estimate.value, estimate.rotation_w2_w0, self.palm_m, self.rotation_w0_cam, self.translation_w0_cam_m,
                out,
            )  # fmt: skip
            return out
        place = self.palm_m + estimate.shape_m + estimate.skin_m
        in_w0 = place @ estimate.rotation_w2_w0.T + estimate.position_m
        return np.asarray(in_w0 @ self.rotation_w0_cam.T + self.translation_w0_cam_m)

    def observe(self, position_m: FloatArray, rotation_w2_w0: FloatArray, place_m: FloatArray) -> FloatArray:
        """Pixel u, v and depth z (..., 6, 3) of discs at ``place_m`` (6, 3) on the fixed unit at poses (...)."""
        about_wrist = place_m @ rotation_w2_w0.swapaxes(-1, -2)
        turned, shifted = self._w0_image
        out: FloatArray = (about_wrist.reshape(-1, 3) @ turned).reshape(about_wrist.shape)
        out += (position_m @ turned + shifted)[..., None, :]
        out[..., :2] /= out[..., 2:]
        return out


def palm_linearised(estimate: PalmEstimate, view: View, spread: Spread) -> Linearisation:
    """H linearised about an estimate of the palm: ``value`` (1, 18), ``slope`` (1, 18, n) about its own mean."""
    weights = weights_for(POSE.size, spread)
    if (kernels := in_c()) is not None:
        linearised = Linearisation(
            np.empty((1, _COMPONENTS)),
            np.empty((1, _COMPONENTS, SIZE)),
            np.empty((1, _COMPONENTS, _COMPONENTS)),
            _ABOUT,
        )
        camera = view.camera
        kernels.palm_linearised(
            estimate.value, estimate.covariance, estimate.rotation_w2_w0, view.palm_m, view.hidden, *view._w0_image,
            view.rotation_w0_cam, camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px, _FLOOR, *weights.numbers,
            linearised.value, linearised.slope, linearised.error,
        )  # fmt: skip
        return linearised
    root = estimate.covariance[POSE[:, None], POSE]
    root.reshape(-1)[:: POSE.size + 1] += _FLOOR
    make_roots(root[None])
    count = POSE.size
    offset = np.zeros((2 * count + 1, count))
    offset[1 : count + 1], offset[count + 1 :] = weights.scale * root.T, -weights.scale * root.T
    place = view.palm_m + estimate.shape_m + estimate.skin_m
    turned = np.empty((2 * count + 1, 3, 3))
    turned[0] = np.eye(3)
    turned[1 : count + 1] = so3.exp(offset[1 : count + 1, 3:])
    turned[count + 1 :] = turned[1 : count + 1].swapaxes(1, 2)
    image = view.observe(estimate.position_m + offset[:, :3], estimate.rotation_w2_w0 @ turned, place)
    centre = image[0]
    flat = image.reshape(len(image), _COMPONENTS)
    value = weights.mean @ flat
    half = (flat[1 : count + 1] - flat[count + 1 :]) * (0.5 / weights.scale)
    # The even part of the spread is what nothing linear can follow.
    bend = 0.5 * (flat[1 : count + 1] + flat[count + 1 :]) - value
    error = (2.0 * weights.covariance[1]) * (bend.T @ bend)
    middle = flat[0] - value
    error += (weights.covariance[0] * middle)[:, None] * middle
    slope = np.zeros((_COMPONENTS, SIZE))
    from scipy.linalg.lapack import dtrtrs  # a fifth of a second to load, and the kernels in C do without

    slope[:, POSE] = dtrtrs(root.T, half)[0].T
    slope[_OF_DISC, _BY_SHAPE] = slope[_OF_DISC, _BY_SKIN] = _by_camera_place(view.camera, centre) @ (
        view.rotation_w0_cam @ estimate.rotation_w2_w0
    )
    slope[2::3, SHAPE] -= view.hidden
    value[2::3] -= view.hidden @ estimate.value[SHAPE]
    return Linearisation(value[None], slope[None], error[None], _ABOUT)


def _by_camera_place(camera: Camera, image: FloatArray) -> FloatArray:
    """Derivative (6, 3, 3) of u, v, z by the place in camera axes, at u, v, z (6, 3)."""
    z = image[:, 2]
    out = np.zeros((len(image), 3, 3))
    out[:, 0, 0], out[:, 1, 1] = camera.fx_px / z, camera.fy_px / z
    out[:, 0, 2] = (camera.cx_px - image[:, 0]) / z
    out[:, 1, 2] = (camera.cy_px - image[:, 1]) / z
    out[:, 2, 2] = 1.0
    return out


def error_reset(nominal: PalmEstimate, mixture: ModeMixture) -> tuple[PalmEstimate, ModeMixture]:
    """The nominal estimate moved to the mixture's mean and given its covariance; the mixture as errors from there."""
    if (kernels := in_c()) is not None:
        error, covariance, value, rotation = (
            np.empty(mixture.mean.shape),
            np.empty((SIZE, SIZE)),
            np.empty(SIZE),
            np.empty((3, 3)),
        )
        kernels.error_reset(
            mixture.mean.shape[1], mixture.mean, mixture.covariance, mixture.probability, nominal.value,
            nominal.rotation_w2_w0, error, covariance, value, rotation,
        )  # fmt: skip
        return PalmEstimate(rotation, value, covariance), ModeMixture(error, mixture.covariance, mixture.probability)
    mean, covariance = mixture.merged()
    apart = mixture.mean - mean[:, None]
    # The turns are measured from another rotation now: log(Exp(-m) Exp(e)) to second order.
    apart[..., TURN] += 0.5 * (mixture.mean[..., TURN] @ so3.skew(mean[0, TURN]))
    return nominal.moved(mean[0], covariance[0]), ModeMixture(apart, mixture.covariance, mixture.probability)

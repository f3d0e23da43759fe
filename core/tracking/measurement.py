"""What the camera should see of a belief, and the correction by what it saw.

Measured for a marker are its pixel u, v (eq. (2), (3) of the wrist paper) and the depth z of its disc
along the camera's axis, as in the initialisation (13).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from core import so3
from core.camera import Camera
from core.tracking.motion import MotionNoise, advance, predict
from core.tracking.state import Belief, StateLayout
from core.tracking.unscented import Spread, deviations, weights_for
from core.types import FloatArray


class MarkerGeometry(Protocol):
    """Where the discs are on the hand."""

    @property
    def palm_m(self) -> FloatArray:
        """Calibrated places (6, 3) of the discs that move with the palm."""
        ...

    def positions_w2_m(self, joints_rad: FloatArray, shape: FloatArray) -> FloatArray:
        """Disc centres (..., M, 3) in the moving frame for joint angles (..., J) and shape (..., S)."""
        ...


@dataclass(frozen=True, slots=True)
class RigidPalm:
    """Discs that move as one body: the palm of the wrist protocol, its arch kept.

    The shape is a correction (..., 3 M) in metres to every disc's calibrated place, or nothing.
    """

    marker_position_w0_m: FloatArray

    @property
    def palm_m(self) -> FloatArray:
        return self.marker_position_w0_m

    def positions_w2_m(self, joints_rad: FloatArray, shape: FloatArray) -> FloatArray:
        if shape.shape[-1] == 0:
            return self.marker_position_w0_m
        return self.marker_position_w0_m + shape.reshape(*shape.shape[:-1], -1, 3)


@dataclass(frozen=True, slots=True)
class View:
    """A hand of known geometry before a camera of known pose (g_w0c of the wrist paper)."""

    camera: Camera
    rotation_w0_cam: FloatArray
    translation_w0_cam_m: FloatArray
    geometry: MarkerGeometry

    def markers_cam_m(
        self, position_m: FloatArray, rotation_w2_w0: FloatArray, joints_rad: FloatArray, shape: FloatArray
    ) -> FloatArray:
        """Disc centres (..., M, 3) in camera axes."""
        local = self.geometry.positions_w2_m(joints_rad, shape)
        rotation = self.rotation_w0_cam @ rotation_w2_w0
        origin = position_m @ self.rotation_w0_cam.T + self.translation_w0_cam_m
        return np.asarray(local @ np.swapaxes(rotation, -1, -2) + origin[..., None, :])

    def observe(
        self, position_m: FloatArray, rotation_w2_w0: FloatArray, joints_rad: FloatArray, shape: FloatArray
    ) -> FloatArray:
        """Pixel u, v and depth z (..., M, 3) of every disc, hidden or not."""
        cam = self.markers_cam_m(position_m, rotation_w2_w0, joints_rad, shape)
        z = cam[..., 2]
        out = np.empty_like(cam)
        out[..., 0] = self.camera.fx_px * cam[..., 0] / z + self.camera.cx_px
        out[..., 1] = self.camera.fy_px * cam[..., 1] / z + self.camera.cy_px
        out[..., 2] = z
        return out


@dataclass(frozen=True, slots=True)
class Forecast:
    """A predicted belief with the sigma points that tie it to the predicted measurements.

    ``marker_mean`` (..., M, 3) is (10), ``marker_covariance`` (..., M, 3, 3) is (11) without the
    measurement noise; ``state_deviation`` (..., S, n), ``marker_deviation`` (..., S, M, 3), ``weight`` (S,).
    """

    belief: Belief
    marker_mean: FloatArray
    marker_covariance: FloatArray
    state_deviation: FloatArray
    marker_deviation: FloatArray
    weight: FloatArray


def _forecast(
    belief: Belief, state_deviation: FloatArray, marker: FloatArray, mean_weight: FloatArray, weight: FloatArray
) -> Forecast:
    mean = (
        np.tensordot(mean_weight, marker, axes=(0, -3))
        if marker.ndim == 3
        else np.einsum("s,...sij->...ij", mean_weight, marker)
    )
    deviation = marker - mean[..., None, :, :]
    by_marker = np.moveaxis(deviation, -3, -1)  # (..., M, 3, S)
    covariance = (by_marker * weight) @ np.swapaxes(by_marker, -1, -2)
    return Forecast(belief, mean, covariance, state_deviation, deviation, weight)


def forecast_reduced(
    belief: Belief,
    noise: MotionNoise,
    scales: FloatArray | None,
    dt_s: float,
    layout: StateLayout,
    view: View,
    spread: Spread,
) -> Forecast:
    """Linear prediction, then sigma points for the measurement only, over the states that it sees.

    ``scales`` (K,) multiplies the noise of each alternative on the belief's leading axis. The states that
    the camera does not see directly follow by linear regression, exact for a Gaussian.
    """
    predicted = predict(belief, noise, dt_s, layout, scales)
    return forecast_of(predicted, layout, view, spread)


def forecast_of(predicted: Belief, layout: StateLayout, view: View, spread: Spread) -> Forecast:
    """Sigma points of a belief as it stands and what the camera would see of them."""
    seen = layout.seen
    lead = predicted.position_m.shape[:-1]
    p_seen = predicted.covariance[..., seen[:, None], seen]
    weights = weights_for(seen.size, spread)
    offset = deviations(p_seen, weights.scale)
    rotation = predicted.rotation_w2_w0[..., None, :, :] @ so3.exp(offset[..., 3:6])
    marker = view.observe(
        predicted.position_m[..., None, :] + offset[..., 0:3],
        rotation,
        predicted.joints_rad[..., None, :] + offset[..., 6 : 6 + layout.joint_count],
        predicted.shape[..., None, :] + offset[..., 6 + layout.joint_count :],
    )
    marker = np.broadcast_to(marker, (*lead, offset.shape[-2], *marker.shape[-2:]))
    regression = np.linalg.solve(p_seen, predicted.covariance[..., seen, :])
    return _forecast(predicted, offset @ regression, marker, weights.mean, weights.covariance)


def forecast_augmented(
    belief: Belief, noise: MotionNoise, scale: float, dt_s: float, layout: StateLayout, view: View, spread: Spread
) -> Forecast:
    """The papers' augmented filter: one set of sigma points over state and noise, through f and then h.

    For a single belief. The mean orientation is taken on the manifold.
    """
    n = layout.size
    sd = noise.per_step(layout, dt_s) * scale
    weights = weights_for(n + sd.size, spread)
    joint = np.zeros((n + sd.size, n + sd.size))
    joint[:n, :n] = belief.covariance
    joint[n:, n:] = np.diag(sd**2)
    offset = deviations(joint, weights.scale)
    spread_out = _repeat(belief, offset.shape[0]).moved(offset[:, :n], layout)
    after = advance(spread_out, offset[:, n:], dt_s, layout)
    mean = Belief(
        weights.mean @ after.position_m,
        weights.mean @ after.velocity_m_s,
        so3.mean_rotation(after.rotation_w2_w0, weights.mean),
        weights.mean @ after.rate_rad_s,
        weights.mean @ after.joints_rad,
        weights.mean @ after.joint_rates_rad_s,
        weights.mean @ after.shape,
        belief.covariance,
    )
    deviation = _repeat(mean, offset.shape[0]).error_to(after, layout)
    covariance = (deviation.T * weights.covariance) @ deviation
    marker = view.observe(after.position_m, after.rotation_w2_w0, after.joints_rad, after.shape)
    predicted = replace(mean, covariance=0.5 * (covariance + covariance.T))
    return _forecast(predicted, deviation, marker, weights.mean, weights.covariance)


def _repeat(belief: Belief, count: int) -> Belief:
    def rows(a: FloatArray) -> FloatArray:
        return np.broadcast_to(a, (count, *a.shape))

    return Belief(
        rows(belief.position_m),
        rows(belief.velocity_m_s),
        rows(belief.rotation_w2_w0),
        rows(belief.rate_rad_s),
        rows(belief.joints_rad),
        rows(belief.joint_rates_rad_s),
        rows(belief.shape),
        rows(belief.covariance),
    )


@dataclass(frozen=True, slots=True)
class Innovation:
    """Surprise of an update: ``nis`` (...) innovation' S^-1 innovation with ``dof`` components,
    ``log_likelihood`` (...), and ``residual`` (..., m): how far each component lies from the corrected belief,
    in its own standard deviations, N(0, 1) when noise and model are right."""

    nis: FloatArray
    log_likelihood: FloatArray
    dof: int
    residual: FloatArray


def update(
    forecast: Forecast, rows: NDArray[np.int64], measured: FloatArray, noise_variance: FloatArray, layout: StateLayout
) -> tuple[Belief, Innovation]:
    """Kalman correction by ``measured`` (m,), the components ``rows`` (m,) of the flattened (M, 3) markers.

    ``noise_variance`` (m,) px^2 for pixels, m^2 for depths. Works on all leading alternatives at once.
    """
    lead = forecast.marker_mean.shape[:-2]
    if rows.size == 0:
        zero = np.zeros(lead)
        return forecast.belief, Innovation(zero, zero, 0, np.zeros((*lead, 0)))
    flat_deviation = forecast.marker_deviation.reshape(*forecast.marker_deviation.shape[:-2], -1)[..., rows]
    value = measured - forecast.marker_mean.reshape(*lead, -1)[..., rows]
    weighted = flat_deviation * forecast.weight[:, None]
    swapped = np.swapaxes(weighted, -1, -2)
    s = swapped @ flat_deviation
    index = np.arange(rows.size)
    s[..., index, index] += noise_variance
    # Pixels and metres differ by orders of magnitude; solve in units of the noise.
    unit = 1.0 / np.sqrt(noise_variance)
    s_unit = s * unit * unit[:, None]
    cross = swapped @ forecast.state_deviation  # (..., m, n) = P_yx
    inverse = np.linalg.inv(s_unit)
    gain_t = (inverse @ (cross * unit[:, None])) * unit[:, None]  # (..., m, n) = K'
    s_inv_value_unit = (inverse @ (value * unit)[..., None])[..., 0]
    s_inv_value = s_inv_value_unit * unit
    correction = (value[..., None, :] @ gain_t)[..., 0, :]
    covariance = forecast.belief.covariance - np.swapaxes(gain_t, -1, -2) @ cross
    covariance = 0.5 * (covariance + np.swapaxes(covariance, -1, -2))
    belief = forecast.belief.moved(correction, layout, covariance)
    nis = np.sum(value * s_inv_value, axis=-1)
    log_det = np.linalg.slogdet(s_unit)[1] - 2.0 * np.sum(np.log(unit))
    log_likelihood = -0.5 * (nis + log_det + rows.size * np.log(2.0 * np.pi))
    residual = s_inv_value_unit / np.sqrt(inverse[..., index, index])
    return belief, Innovation(nis, log_likelihood, int(rows.size), residual)

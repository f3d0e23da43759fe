"""What the camera should see of a belief, and the correction by what it saw.

Measured for a marker are its pixel u, v (eq. (2), (3) of the wrist paper) and the depth z of its disc
along the camera's axis, as in the initialisation (13).
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from functools import lru_cache
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dtrtri

from core import so3
from core.camera import Camera
from core.tracking.modes import ModeBank, predicted
from core.tracking.motion import MotionNoise, advance
from core.tracking.state import Belief, StateLayout
from core.tracking.unscented import Spread, deviations, make_roots, weights_for
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
    """A hand of known geometry before a camera of known pose (g_w0c of the wrist paper).

    ``hidden`` (M, S): by how much each number of the shape moves the depths less than the discs' places say, because
    those of the calibration were as wrong; None for not at all.
    """

    camera: Camera
    rotation_w0_cam: FloatArray
    translation_w0_cam_m: FloatArray
    geometry: MarkerGeometry
    hidden: FloatArray | None = None

    _w0_image: tuple[FloatArray, FloatArray] = field(init=False, repr=False, compare=False)
    """Worked out once: from w0, in metres, to u z, v z, z; applied to rows."""

    def __post_init__(self) -> None:
        camera = self.camera.matrix
        image = (camera @ self.rotation_w0_cam).T.copy(), camera @ self.translation_w0_cam_m
        object.__setattr__(self, "_w0_image", image)

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
        about_wrist = self.geometry.positions_w2_m(joints_rad, shape) @ rotation_w2_w0.swapaxes(-1, -2)
        turned, shifted = self._w0_image
        out: FloatArray = (about_wrist.reshape(-1, 3) @ turned).reshape(about_wrist.shape)
        out += (position_m @ turned + shifted)[..., None, :]
        z = out[..., 2]
        per_z = 1.0 / z
        out[..., 0] *= per_z
        out[..., 1] *= per_z
        if self.hidden is not None:
            z -= shape @ self.hidden.T
        return out


@dataclass(frozen=True, slots=True)
class Forecast:
    """All modes as predicted, and what the camera should see of each; 3M components u, v, z of M markers.

    ``marker_mean`` (K, 3M) is (10), ``marker_covariance`` (K, 3M, 3M) is (11) for all markers together and
    without the measurement noise, ``cross`` (K, 3M, n) the covariance of measurements and state. Over all modes,
    ``own_mean`` (M, 3) and ``own_covariance`` (M, 3, 3) of each marker's own measurement.
    """

    bank: ModeBank
    marker_mean: FloatArray
    marker_covariance: FloatArray
    cross: FloatArray
    own_mean: FloatArray
    own_covariance: FloatArray

    @staticmethod
    def of(bank: ModeBank, marker_mean: FloatArray, marker_covariance: FloatArray, cross: FloatArray) -> Forecast:
        """The forecast with the mixture over its modes worked out."""
        probability = bank.probability
        mean = probability @ marker_mean
        apart = marker_mean - mean
        covariance = (probability @ marker_covariance.reshape(probability.size, -1)).reshape(mean.size, mean.size)
        covariance += (apart.T * probability) @ apart
        count = mean.size // 3
        own = covariance.reshape(count, 3, count, 3).diagonal(axis1=0, axis2=2).transpose(2, 0, 1)
        return Forecast(bank, marker_mean, marker_covariance, cross, mean.reshape(count, 3), own)

    def by_marker(self) -> tuple[FloatArray, FloatArray]:
        """Mean (M, 3) and covariance (M, 3, 3) of each marker's own measurement over all modes; views."""
        return self.own_mean, self.own_covariance


@dataclass(frozen=True, slots=True)
class _Order:
    """``seen`` (s,) states; ``seen_first`` (n n,) where in a covariance, flat, that of all states stands with those
    first; ``back`` (n,) from that order to the layout's."""

    seen: NDArray[np.int64]
    seen_first: NDArray[np.int64]
    back: NDArray[np.int64]


@lru_cache(maxsize=8)
def _order(layout: StateLayout) -> _Order:
    seen = layout.seen
    seen_first = np.concatenate((seen, np.setdiff1d(np.arange(layout.size), seen)))
    return _Order(seen, (seen_first[:, None] * layout.size + seen_first).ravel(), np.argsort(seen_first))


_POSED = 13
"""Sigma points that stand anywhere but where the first does: that one and two for each state of the pose."""


def forecast(bank: ModeBank, layout: StateLayout, view: View, spread: Spread) -> Forecast:
    """Sigma points of predicted modes over the states that the camera sees, pushed through the measurement.

    The states that it does not see follow by linear regression on those, exact for a Gaussian: the points
    need not spread over them.
    """
    order, count = _order(layout), bank.probability.size
    size = order.seen.size
    weights = weights_for(size, spread)
    # With the seen states first, the root's first columns hold the points and, below, what they say of the others.
    root = bank.covariance.reshape(count, -1).take(order.seen_first, 1).reshape(bank.covariance.shape)
    make_roots(root)
    columns = weights.scale * root[:, :, :size].transpose(0, 2, 1)
    # The centre, then two for each column in turn.
    offset = np.empty((count, 2 * size + 1, size))
    offset[:] = bank.error.take(order.seen, 1)[:, None]
    offset[:, 1::2] += columns[..., :size]
    offset[:, 2::2] -= columns[..., :size]
    nominal, joints = bank.nominal, 6 + layout.joint_count
    # The root is lower triangular: from the seventh on its columns leave the pose alone.
    rotation = np.empty((*offset.shape[:2], 3, 3))
    rotation[:, :_POSED] = nominal.rotation_w2_w0 @ so3.exp(offset[:, :_POSED, 3:6])
    rotation[:, _POSED:] = rotation[:, :1]
    marker = view.observe(
        nominal.position_m + offset[..., 0:3],
        rotation,
        nominal.joints_rad + offset[..., 6:joints],
        nominal.shape + offset[..., joints:],
    ).reshape(count, 2 * size + 1, -1)
    mean = weights.mean @ marker
    deviation = marker - mean[:, None, :]
    covariance = (deviation * weights.covariance[:, None]).transpose(0, 2, 1) @ deviation
    pairs = marker[:, 1::2] - marker[:, 2::2]
    cross = weights.covariance[1] * (pairs.transpose(0, 2, 1) @ columns)
    return Forecast.of(bank, mean, covariance, cross.take(order.back, 2))


def forecast_reduced(
    bank: ModeBank,
    noise: MotionNoise,
    scales: FloatArray,
    dt_s: float,
    layout: StateLayout,
    view: View,
    spread: Spread,
) -> Forecast:
    """Linear prediction, then sigma points for the measurement only."""
    return forecast(predicted(bank, noise, scales, dt_s, layout), layout, view, spread)


def forecast_augmented(
    bank: ModeBank,
    noise: MotionNoise,
    scales: FloatArray,
    dt_s: float,
    layout: StateLayout,
    view: View,
    spread: Spread,
) -> Forecast:
    """The papers' augmented filter: one set of sigma points over state and noise, through f and then h.

    Mode by mode; the mean orientation is taken on the manifold. The points of all modes are told as errors from
    one belief, as the bank keeps them.
    """
    n = layout.size
    sd_per_step = noise.per_step(layout, dt_s)
    weights = weights_for(n + sd_per_step.size, spread)
    means: list[Belief] = []
    afters: list[Belief] = []
    markers = []
    for error, covariance, scale in zip(bank.error, bank.covariance, scales, strict=True):
        sd = sd_per_step * scale
        joint = np.zeros((n + sd.size, n + sd.size))
        joint[:n, :n] = covariance
        joint[n:, n:] = np.diag(sd**2)
        offset = deviations(joint, weights.scale)
        spread_out = _repeat(bank.nominal, offset.shape[0]).moved(error + offset[:, :n], layout)
        after = advance(spread_out, offset[:, n:], dt_s, layout)
        means.append(_mean(after, weights.mean, covariance))
        afters.append(after)
        marker = view.observe(after.position_m, after.rotation_w2_w0, after.joints_rad, after.shape)
        markers.append(marker.reshape(offset.shape[0], -1))
    apart = np.stack([means[0].error_to(mean, layout) for mean in means])
    nominal = means[0].moved(bank.probability @ apart, layout)
    errors = np.stack([nominal.error_to(mean, layout) for mean in means])
    covariances, marker_means, marker_covariances, crosses = [], [], [], []
    for error, after, marker in zip(errors, afters, markers, strict=True):
        deviation = _repeat(nominal, marker.shape[0]).error_to(after, layout) - error
        marker_mean = weights.mean @ marker
        weighted = (marker - marker_mean) * weights.covariance[:, None]
        new_covariance = (deviation.T * weights.covariance) @ deviation
        covariances.append(0.5 * (new_covariance + new_covariance.T))
        marker_means.append(marker_mean)
        marker_covariances.append(weighted.T @ (marker - marker_mean))
        crosses.append(weighted.T @ deviation)
    after_bank = ModeBank(nominal, errors, np.stack(covariances), bank.probability)
    return Forecast.of(after_bank, np.stack(marker_means), np.stack(marker_covariances), np.stack(crosses))


def _mean(after: Belief, weight: FloatArray, covariance: FloatArray) -> Belief:
    return Belief(
        weight @ after.position_m,
        weight @ after.velocity_m_s,
        so3.mean_rotation(after.rotation_w2_w0, weight),
        weight @ after.rate_rad_s,
        weight @ after.joints_rad,
        weight @ after.joint_rates_rad_s,
        weight @ after.shape,
        covariance,
    )


def _repeat(belief: Belief, count: int) -> Belief:
    return Belief(*(np.broadcast_to(a, (count, *a.shape)) for a in (getattr(belief, f.name) for f in fields(Belief))))


@dataclass(frozen=True, slots=True)
class Innovation:
    """Surprise of an update: ``nis`` (K,) innovation' S^-1 innovation with ``dof`` components,
    ``log_likelihood`` (K,), and ``residual`` (K, m): how far each component lies from the corrected belief,
    in its own standard deviations, N(0, 1) when noise and model are right."""

    nis: FloatArray
    log_likelihood: FloatArray
    dof: int
    residual: FloatArray


def update(
    forecast: Forecast, rows: NDArray[np.int64], measured: FloatArray, noise_variance: FloatArray
) -> tuple[ModeBank, Innovation]:
    """Kalman correction of every mode by ``measured`` (m,), the components ``rows`` (m,) of the 3M.

    ``noise_variance`` (m,) px^2 for pixels, m^2 for depths. The modes' probabilities are left as they are.
    """
    bank = forecast.bank
    if rows.size == 0:
        zero = np.zeros(bank.probability.size)
        return bank, Innovation(zero, zero, 0, np.zeros((zero.size, 0)))
    # Pixels and metres differ by orders of magnitude: everything is taken in units of the noise.
    unit = 1.0 / np.sqrt(noise_variance)
    value, s, cross = forecast.marker_mean, forecast.marker_covariance, forecast.cross
    if rows.size < value.shape[1]:
        value, s, cross = value.take(rows, 1), s.take(rows, 1).take(rows, 2), cross.take(rows, 1)
    white: FloatArray = s * (unit * unit[:, None])
    white.reshape(len(s), -1)[:, :: rows.size + 1] += 1.0  # the diagonals
    make_roots(white)
    log_det = 2.0 * np.log(white.reshape(len(s), -1)[:, :: rows.size + 1] / unit).sum(axis=1)
    _invert_lower(white)
    surprise = white @ ((measured - value) * unit)[..., None]  # (K, m, 1), N(0, 1) when all is right
    gain = white @ (cross * unit[:, None])
    error = bank.error + (surprise.transpose(0, 2, 1) @ gain)[:, 0]
    covariance = bank.covariance - gain.transpose(0, 2, 1) @ gain
    covariance = 0.5 * (covariance + covariance.transpose(0, 2, 1))
    nis = np.vecdot(surprise[..., 0], surprise[..., 0])
    log_likelihood = -0.5 * (nis + log_det + rows.size * _LOG_2_PI)
    residual = (surprise.transpose(0, 2, 1) @ white)[:, 0] / np.sqrt((white * white).sum(axis=1))
    bank = ModeBank(bank.nominal, error, covariance, bank.probability)
    return bank, Innovation(nis, log_likelihood, int(rows.size), residual)


def _invert_lower(root: FloatArray) -> None:
    """Make lower triangular matrices (K, m, m) their inverses."""
    for one in root:
        # LAPACK counts by columns: what it is told of, and changes in place, is the transpose.
        dtrtri(one.T, lower=0, overwrite_c=1)


_LOG_2_PI = float(np.log(2.0 * np.pi))

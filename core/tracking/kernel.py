"""The filter, written once: Gaussians of several chains in several motion modes, predicted, mixed, corrected, merged.

Arrays lead with the chain (C: the palm is one, thumb and fingers are five) and the mode (K). What a chain's numbers
mean, how they move and what the camera sees of them are arguments: a transition and its noise, and h as the model
linearised it by sigma points. The modes form an interacting multiple model (Blom and
Bar-Shalom 1988): the same filter with other process noise, weighed by how well each foresaw the measurements.
Where a chain lives on a manifold its numbers are small errors from a nominal estimate that the model keeps.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.compiled.mixture import merged
from carpus.core.kernels.choice import NOTHING, in_c
from carpus.core.types import FloatArray

_LEAST_PROBABILITY = 1e-6


@dataclass(frozen=True, slots=True)
class ModeMixture:
    """Gaussians: ``mean`` (C, K, n), ``covariance`` (C, K, n, n), ``probability`` (C, K) of each mode."""

    mean: FloatArray
    covariance: FloatArray
    probability: FloatArray

    @staticmethod
    def alike(mean: FloatArray, covariance: FloatArray, modes: int) -> ModeMixture:
        """All modes alike and as probable, of means (C, n) and covariances (C, n, n)."""
        return ModeMixture(
            np.repeat(mean[:, None], modes, axis=1),
            np.repeat(covariance[:, None], modes, axis=1),
            np.full((len(mean), modes), 1.0 / modes),
        )

    def merged(self) -> tuple[FloatArray, FloatArray]:
        """Mean (C, n) and covariance (C, n, n) over the modes."""
        if self.probability.shape[1] == 1:
            return self.mean[:, 0], self.covariance[:, 0]
        return merged(self)


def switching(modes: int, dwell_s: float, dt_s: float) -> FloatArray:
    """Probability (K, K) to go from row to column mode in ``dt_s``, staying ``dwell_s`` on average."""
    if modes == 1:
        return np.ones((1, 1))
    leave = 1.0 - math.exp(-dt_s / dwell_s)
    out = np.full((modes, modes), leave / (modes - 1))
    out.reshape(-1)[:: modes + 1] = 1.0 - leave
    return out


def mixed(mixture: ModeMixture, switch: FloatArray) -> ModeMixture:
    """Each mode's start from all that may have switched to it; ``switch`` (K, K) from row to column."""
    if switch.shape[0] == 1:
        return mixture
    joint = switch * mixture.probability[:, :, None]
    predicted = joint.sum(axis=1)
    share = np.swapaxes(joint / predicted[:, None, :], 1, 2)  # (C, to, from)
    mean = share @ mixture.mean
    apart = mixture.mean[:, None, :, :] - mean[:, :, None, :]  # (C, to, from, n)
    chains, n = len(mean), mean.shape[-1]
    covariance = (share @ mixture.covariance.reshape(chains, -1, n * n)).reshape(*mean.shape, n)
    covariance += _turned(apart) @ (apart * share[..., None])
    return ModeMixture(mean, covariance, predicted)


def predicted(
    mixture: ModeMixture, forward: FloatArray, noise: FloatArray, switch: FloatArray | None = None
) -> ModeMixture:
    """P <- F P F' + Q with ``forward`` (C, n, n) and ``noise`` (C, K, n, n), the modes :func:`mixed` before
    where there is a ``switch``."""
    mixture = mixture if switch is None else mixed(mixture, switch)
    forward = forward[:, None]
    mean = (forward @ mixture.mean[..., None])[..., 0]
    covariance = forward @ mixture.covariance @ np.swapaxes(forward, -1, -2)
    covariance += noise
    return ModeMixture(mean, covariance, mixture.probability)


@dataclass(frozen=True, slots=True)
class Transition:
    """A step of a chain of which only the first m numbers mix: ``moving`` (m, m) of these with the ``driven`` noise
    (K, m, m); of every number the share ``kept`` (K, n) is left, one for the moving; the last r numbers are pushed by
    ``relaxing`` (K, r, r)."""

    moving: FloatArray
    driven: FloatArray
    kept: FloatArray
    relaxing: FloatArray


def transitioned(
    mixture: ModeMixture, step: Transition, nominal: FloatArray, switch: FloatArray | None = None
) -> ModeMixture:
    """The mixture after the step, of errors from a ``nominal`` (n,) that moves with its first m numbers and else stays:
    what of that a mode does not keep is an error of the mode. Its modes are :func:`mixed` before where there is a
    ``switch``."""
    mixture = mixture if switch is None else mixed(mixture, switch)
    mixing, first = len(step.moving), step.kept.shape[1] - step.relaxing.shape[1]
    mean = mixture.mean * step.kept + (step.kept - 1.0) * nominal
    mean[..., :mixing] = mixture.mean[..., :mixing] @ step.moving.T
    covariance = step.kept[:, :, None] * mixture.covariance
    covariance *= step.kept[:, None, :]
    rows = step.moving @ covariance[..., :mixing, :]
    covariance[..., :mixing, mixing:] = rows[..., mixing:]
    covariance[..., mixing:, :mixing] = np.swapaxes(rows[..., mixing:], -1, -2)
    covariance[..., :mixing, :mixing] = rows[..., :mixing] @ step.moving.T + step.driven
    covariance[..., first:, first:] += step.relaxing
    return ModeMixture(mean, covariance, mixture.probability)


def like(mixture: ModeMixture) -> ModeMixture:
    """A mixture of the same shape, to be filled."""
    return ModeMixture(
        np.empty(mixture.mean.shape), np.empty(mixture.covariance.shape), np.empty(mixture.probability.shape)
    )


@dataclass(frozen=True, slots=True)
class Linearisation:
    """A measurement linearised statistically: y = ``value`` + ``slope`` (x - ``about``) + error.

    ``value`` (C, m), ``slope`` (C, m, n), ``error`` (C, m, m) covariance of what that misses, ``about`` (C, n).
    """

    value: FloatArray
    slope: FloatArray
    error: FloatArray
    about: FloatArray


@dataclass(frozen=True, slots=True)
class Update:
    """Corrected ``mixture``; ``nis`` (C,) innovation' S^-1 innovation over all modes with ``dof`` (C,) components;
    ``residual`` (C, m) of each component in its own standard deviations, N(0, 1) when all is right, 0 where nothing
    was measured."""

    mixture: ModeMixture
    nis: FloatArray
    dof: NDArray[np.int64]
    residual: FloatArray


def partial_update(size: int, slow: slice, learning: float) -> FloatArray:
    """Shares (n,) of a correction that the mean takes: the numbers of ``slow`` only ``learning``.

    Partial-update Schmidt-Kalman filter (Brink 2017): errors that stay with a disc come again in every picture, and
    believed in full they would bend the hand's geometry until it explains them.
    """
    mean = np.ones(size)
    mean[slow] = learning
    return mean


def corrected(
    mixture: ModeMixture,
    linearised: Linearisation,
    measured: FloatArray,
    variance: FloatArray,
    shared: FloatArray | None = None,
    partial: FloatArray | None = None,
) -> Update:
    """Kalman correction of every chain and mode by ``measured`` (C, m), NaN where there is nothing.

    ``variance`` (C, m) of the measurements' own errors, ``shared`` (C, m, m) a covariance common to several of them;
    ``partial`` of :func:`partial_update`. Everything is taken in units of the noise, since pixels and metres differ by
    orders of magnitude.
    """
    if (kernels := in_c()) is not None:
        out, nis, dof = like(mixture), np.empty(len(mixture.mean)), np.empty(len(mixture.mean), dtype=np.int64)
        residual = np.empty(measured.shape)
        kernels.corrected(
            *mixture.mean.shape, measured.shape[1], mixture.mean, mixture.covariance, mixture.probability,
            linearised.value, linearised.slope, linearised.error, linearised.about, measured, variance,
            NOTHING if shared is None else shared, NOTHING if partial is None else partial,
            out.mean, out.covariance, out.probability, nis, dof, residual,
        )  # fmt: skip
        return Update(out, nis, dof, residual)
    used = np.isfinite(measured)
    unit = np.where(used, 1.0 / np.sqrt(np.where(used, variance, 1.0)), 0.0)
    slope = linearised.slope * unit[..., None]
    own = linearised.error if shared is None else linearised.error + shared
    own = own * (unit[:, :, None] * unit[:, None, :])
    diagonal = np.arange(measured.shape[1])
    own[:, diagonal, diagonal] += 1.0
    guess = (slope[:, None] @ (mixture.mean - linearised.about[:, None])[..., None])[..., 0]
    value = (np.where(used, measured - linearised.value, 0.0) * unit)[:, None] - guess
    cross = slope[:, None] @ mixture.covariance  # (C, K, m, n)
    s = cross @ np.swapaxes(slope, 1, 2)[:, None] + own[:, None]
    # S = L L': with all taken through L^-1 the correction is a square, and its root tells the determinant too.
    whitening = _inverse_roots(s)
    white = whitening @ cross
    apart = (whitening @ value[..., None])[..., 0]
    step = (apart[..., None, :] @ white)[..., 0, :]
    covariance = _turned(white) @ white
    if partial is not None:
        step *= partial
        covariance *= partial[:, None] + partial - partial[:, None] * partial
    np.subtract(mixture.covariance, covariance, out=covariance)
    covariance += np.swapaxes(covariance, -1, -2).copy()
    covariance *= 0.5
    nis = np.vecdot(apart, apart)
    log_root = -np.log(whitening.diagonal(axis1=-2, axis2=-1)).sum(axis=-1)
    probability = reweighed(mixture.probability, -0.5 * nis - log_root)
    surprise = (apart[..., None, :] @ whitening)[..., 0, :]
    residual = surprise / np.sqrt((whitening * whitening).sum(axis=-2))
    return Update(
        ModeMixture(mixture.mean + step, covariance, probability),
        np.sum(probability * nis, axis=1),
        used.sum(axis=1),
        np.where(used, np.sum(probability[..., None] * residual, axis=1), 0.0),
    )


def _turned(matrix: FloatArray) -> FloatArray:
    """A' (..., n, m) laid out anew: numpy multiplies a stack of these twice as fast as a stack of views."""
    return np.ascontiguousarray(np.swapaxes(matrix, -1, -2))


def _inverse_roots(matrix: FloatArray) -> FloatArray:
    """L^-1 (..., m, m), lower triangular, of positive definite matrices L L'; as ``numpy.linalg`` would, which takes
    four times as long for a few small ones."""
    from scipy.linalg.lapack import dpotrf, dtrtri  # a fifth of a second to load, and the kernels in C do without

    size = matrix.shape[-1]
    out = matrix.reshape(-1, size, size).copy()
    for one in out:
        # LAPACK counts by columns: what it is told of, and changes in place, is the transpose; the rest it leaves.
        if dpotrf(one.T, lower=0, clean=1, overwrite_a=1)[1] or dtrtri(one.T, lower=0, overwrite_c=1)[1]:
            raise np.linalg.LinAlgError("Matrix is not positive definite")
    return out.reshape(matrix.shape)


def reweighed(probability: FloatArray, log_likelihood: FloatArray) -> FloatArray:
    """Probabilities (C, K) after the measurement; none ever falls to zero."""
    log_weight = np.log(probability) + log_likelihood
    weight = np.exp(log_weight - log_weight.max(axis=-1, keepdims=True))
    weight = np.maximum(weight / weight.sum(axis=-1, keepdims=True), _LEAST_PROBABILITY)
    return np.asarray(weight / weight.sum(axis=-1, keepdims=True))


def rts_step(
    covariance: FloatArray,
    forward: FloatArray,
    noise: FloatArray,
    later_less_predicted: FloatArray,
    later_covariance: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """One step of Rauch, Tung and Striebel's recursion: the correction (C, n) of a filtered mean and the smoothed
    covariance (C, n, n), from the filtered ``covariance``, the step's ``forward`` and ``noise`` (C, n, n), how far the
    later smoothed mean lies from the predicted one (C, n), and the later smoothed covariance."""
    across = forward @ covariance
    ahead = across @ np.swapaxes(forward, -1, -2) + noise
    gain = np.swapaxes(np.linalg.solve(ahead, across), -1, -2)
    smoothed = covariance + gain @ (later_covariance - ahead) @ np.swapaxes(gain, -1, -2)
    correction = (gain @ later_less_predicted[..., None])[..., 0]
    return correction, 0.5 * (smoothed + np.swapaxes(smoothed, -1, -2))

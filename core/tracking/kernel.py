"""The filter, written once: Gaussians of several chains in several motion modes, predicted, mixed, corrected, merged.

Arrays lead with the chain (C: the palm is one, thumb and fingers are five) and the mode (K). What a chain's numbers
mean, how they move and what the camera sees of them are arguments: a transition and its noise, and a line through
the measurement that the model drew by sigma points. The modes form an interacting multiple model (Blom and
Bar-Shalom 1988): the same filter with other process noise, weighed by how well each foresaw the measurements.
Where a chain lives on a manifold its numbers are small errors from a nominal belief that the model keeps.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dpotrf, dtrtri

from carpus.core.kernels.choice import NOTHING, in_c
from carpus.core.types import FloatArray

_LEAST_PROBABILITY = 1e-6


@dataclass(frozen=True, slots=True)
class Bank:
    """Gaussians: ``mean`` (C, K, n), ``covariance`` (C, K, n, n), ``probability`` (C, K) of each mode."""

    mean: FloatArray
    covariance: FloatArray
    probability: FloatArray

    @staticmethod
    def alike(mean: FloatArray, covariance: FloatArray, modes: int) -> Bank:
        """All modes alike and as probable, of means (C, n) and covariances (C, n, n)."""
        return Bank(
            np.repeat(mean[:, None], modes, axis=1),
            np.repeat(covariance[:, None], modes, axis=1),
            np.full((len(mean), modes), 1.0 / modes),
        )

    def merged(self) -> tuple[FloatArray, FloatArray]:
        """Mean (C, n) and covariance (C, n, n) over the modes."""
        if self.probability.shape[1] == 1:
            return self.mean[:, 0], self.covariance[:, 0]
        if (kernels := in_c()) is not None:
            chains, modes, n = self.mean.shape
            out = np.empty((chains, n)), np.empty((chains, n, n))
            kernels.merged(chains, modes, n, self.mean, self.covariance, self.probability, *out)
            return out
        share = self.probability[:, None]
        mean = (share @ self.mean)[:, 0]
        apart = self.mean - mean[:, None]
        chains, n = mean.shape
        covariance = (share @ self.covariance.reshape(chains, -1, n * n)).reshape(chains, n, n)
        covariance += np.swapaxes(apart, 1, 2) @ (apart * self.probability[..., None])
        return mean, covariance


def switching(modes: int, dwell_s: float, dt_s: float) -> FloatArray:
    """Probability (K, K) to go from row to column mode in ``dt_s``, staying ``dwell_s`` on average."""
    if modes == 1:
        return np.ones((1, 1))
    leave = 1.0 - math.exp(-dt_s / dwell_s)
    out = np.full((modes, modes), leave / (modes - 1))
    out.reshape(-1)[:: modes + 1] = 1.0 - leave
    return out


def mixed(bank: Bank, switch: FloatArray) -> Bank:
    """Each mode's start from all that may have switched to it; ``switch`` (K, K) from row to column."""
    if switch.shape[0] == 1:
        return bank
    joint = switch * bank.probability[:, :, None]
    predicted = joint.sum(axis=1)
    share = np.swapaxes(joint / predicted[:, None, :], 1, 2)  # (C, to, from)
    mean = share @ bank.mean
    apart = bank.mean[:, None, :, :] - mean[:, :, None, :]  # (C, to, from, n)
    chains, n = len(mean), mean.shape[-1]
    covariance = (share @ bank.covariance.reshape(chains, -1, n * n)).reshape(*mean.shape, n)
    covariance += _turned(apart) @ (apart * share[..., None])
    return Bank(mean, covariance, predicted)


def predicted(bank: Bank, forward: FloatArray, noise: FloatArray, switch: FloatArray | None = None) -> Bank:
    """P <- F P F' + Q with ``forward`` (C, n, n) and ``noise`` (C, K, n, n), the modes :func:`mixed` before
    where there is a ``switch``."""
    if (kernels := in_c()) is not None:
        out = _like(bank)
        kernels.predicted(
            *bank.mean.shape, NOTHING if switch is None else switch, bank.mean, bank.covariance, bank.probability,
            forward, noise, out.mean, out.covariance, out.probability,
        )  # fmt: skip
        return out
    bank = bank if switch is None else mixed(bank, switch)
    forward = forward[:, None]
    mean = (forward @ bank.mean[..., None])[..., 0]
    covariance = forward @ bank.covariance @ np.swapaxes(forward, -1, -2)
    covariance += noise
    return Bank(mean, covariance, bank.probability)


@dataclass(frozen=True, slots=True)
class Carrying:
    """A step of a chain of which only the first m numbers mix: ``moving`` (m, m) of these with the ``driven`` noise
    (K, m, m); of every number the share ``kept`` (K, n) is left, one for the moving; the last r numbers are pushed by
    ``settling`` (K, r, r)."""

    moving: FloatArray
    driven: FloatArray
    kept: FloatArray
    settling: FloatArray


def carried(bank: Bank, step: Carrying, nominal: FloatArray, switch: FloatArray | None = None) -> Bank:
    """The bank after the step, of errors from a ``nominal`` (n,) that moves with its first m numbers and else stays:
    what of that a mode does not keep is an error of the mode. Its modes are :func:`mixed` before where there is a
    ``switch``."""
    if (kernels := in_c()) is not None:
        out, (_, modes, n) = _like(bank), bank.mean.shape
        kernels.carried(
            modes, n, len(step.moving), step.settling.shape[1], NOTHING if switch is None else switch,
            bank.mean, bank.covariance, bank.probability, step.moving, step.driven, step.kept, step.settling, nominal,
            out.mean, out.covariance, out.probability,
        )  # fmt: skip
        return out
    bank = bank if switch is None else mixed(bank, switch)
    mixing, first = len(step.moving), step.kept.shape[1] - step.settling.shape[1]
    mean = bank.mean * step.kept + (step.kept - 1.0) * nominal
    mean[..., :mixing] = bank.mean[..., :mixing] @ step.moving.T
    covariance = step.kept[:, :, None] * bank.covariance
    covariance *= step.kept[:, None, :]
    rows = step.moving @ covariance[..., :mixing, :]
    covariance[..., :mixing, mixing:] = rows[..., mixing:]
    covariance[..., mixing:, :mixing] = np.swapaxes(rows[..., mixing:], -1, -2)
    covariance[..., :mixing, :mixing] = rows[..., :mixing] @ step.moving.T + step.driven
    covariance[..., first:, first:] += step.settling
    return Bank(mean, covariance, bank.probability)


def _like(bank: Bank) -> Bank:
    """A bank of the same shape, to be filled."""
    return Bank(np.empty(bank.mean.shape), np.empty(bank.covariance.shape), np.empty(bank.probability.shape))


@dataclass(frozen=True, slots=True)
class Line:
    """A measurement linearised statistically: y = ``value`` + ``slope`` (x - ``about``) + error.

    ``value`` (C, m), ``slope`` (C, m, n), ``error`` (C, m, m) covariance of what the line misses, ``about`` (C, n).
    """

    value: FloatArray
    slope: FloatArray
    error: FloatArray
    about: FloatArray


@dataclass(frozen=True, slots=True)
class Update:
    """Corrected ``bank``; ``nis`` (C,) innovation' S^-1 innovation over all modes with ``dof`` (C,) components;
    ``residual`` (C, m) of each component in its own standard deviations, N(0, 1) when all is right, 0 where nothing
    was measured."""

    bank: Bank
    nis: FloatArray
    dof: NDArray[np.int64]
    residual: FloatArray


def learning_shares(size: int, slow: slice, learning: float) -> tuple[FloatArray, FloatArray]:
    """Shares of a correction that mean (n,) and covariance (n, n) take: the numbers of ``slow`` only ``learning``.

    Partial-update Schmidt-Kalman filter (Brink 2017): errors that stay with a disc come again in every picture, and
    believed in full they would bend the hand's geometry until it explains them.
    """
    mean = np.ones(size)
    mean[slow] = learning
    return mean, mean[:, None] + mean - mean[:, None] * mean


def corrected(
    bank: Bank,
    line: Line,
    measured: FloatArray,
    variance: FloatArray,
    shared: FloatArray | None = None,
    shares: tuple[FloatArray, FloatArray] | None = None,
) -> Update:
    """Kalman correction of every chain and mode by ``measured`` (C, m), NaN where there is nothing.

    ``variance`` (C, m) of the measurements' own errors, ``shared`` (C, m, m) a covariance common to several of them;
    ``shares`` of :func:`learning_shares`. Everything is taken in units of the noise, since pixels and metres differ by
    orders of magnitude.
    """
    if (kernels := in_c()) is not None:
        out, nis, dof = _like(bank), np.empty(len(bank.mean)), np.empty(len(bank.mean), dtype=np.int64)
        residual = np.empty(measured.shape)
        kernels.corrected(
            *bank.mean.shape, measured.shape[1], bank.mean, bank.covariance, bank.probability,
            line.value, line.slope, line.error, line.about, measured, variance, NOTHING if shared is None else shared,
            *((NOTHING, NOTHING) if shares is None else shares),
            out.mean, out.covariance, out.probability, nis, dof, residual,
        )  # fmt: skip
        return Update(out, nis, dof, residual)
    used = np.isfinite(measured)
    unit = np.where(used, 1.0 / np.sqrt(np.where(used, variance, 1.0)), 0.0)
    slope = line.slope * unit[..., None]
    own = line.error if shared is None else line.error + shared
    own = own * (unit[:, :, None] * unit[:, None, :])
    diagonal = np.arange(measured.shape[1])
    own[:, diagonal, diagonal] += 1.0
    guess = (slope[:, None] @ (bank.mean - line.about[:, None])[..., None])[..., 0]
    value = (np.where(used, measured - line.value, 0.0) * unit)[:, None] - guess
    cross = slope[:, None] @ bank.covariance  # (C, K, m, n)
    s = cross @ np.swapaxes(slope, 1, 2)[:, None] + own[:, None]
    # S = L L': with all taken through L^-1 the correction is a square, and its root tells the determinant too.
    whitening = _inverse_roots(s)
    white = whitening @ cross
    apart = (whitening @ value[..., None])[..., 0]
    step = (apart[..., None, :] @ white)[..., 0, :]
    covariance = _turned(white) @ white
    if shares is not None:
        step *= shares[0]
        covariance *= shares[1]
    np.subtract(bank.covariance, covariance, out=covariance)
    covariance += np.swapaxes(covariance, -1, -2).copy()
    covariance *= 0.5
    nis = np.vecdot(apart, apart)
    log_root = -np.log(whitening.diagonal(axis1=-2, axis2=-1)).sum(axis=-1)
    probability = reweighed(bank.probability, -0.5 * nis - log_root)
    surprise = (apart[..., None, :] @ whitening)[..., 0, :]
    residual = surprise / np.sqrt((whitening * whitening).sum(axis=-2))
    return Update(
        Bank(bank.mean + step, covariance, probability),
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


def looked_back(
    covariance: FloatArray,
    forward: FloatArray,
    noise: FloatArray,
    later_less_predicted: FloatArray,
    later_covariance: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """One step of Rauch, Tung and Striebel's recursion: the correction (C, n) of a filtered mean and the smoothed
    covariance (C, n, n), from the filtered ``covariance``, the step's ``forward`` and ``noise`` (C, n, n), how far the
    later smoothed mean lies from the predicted one (C, n), and the later smoothed covariance."""
    carried = forward @ covariance
    ahead = carried @ np.swapaxes(forward, -1, -2) + noise
    gain = np.swapaxes(np.linalg.solve(ahead, carried), -1, -2)
    smoothed = covariance + gain @ (later_covariance - ahead) @ np.swapaxes(gain, -1, -2)
    correction = (gain @ later_less_predicted[..., None])[..., 0]
    return correction, 0.5 * (smoothed + np.swapaxes(smoothed, -1, -2))

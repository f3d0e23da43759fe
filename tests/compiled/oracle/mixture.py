"""Mixtures of Gaussians in NumPy, as the formulas stand in the books."""

from __future__ import annotations

import numpy as np
from scipy.linalg.lapack import dpotrf, dtrtri

from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.mixture_filter import Linearisation, ModeMixture, Transition, Update

LEAST_PROBABILITY = 1e-6


def merged(mixture: ModeMixture) -> tuple[FloatArray, FloatArray]:
    """Mean (C, n) and covariance (C, n, n) over the modes."""
    share = mixture.probability[:, None]
    mean = (share @ mixture.mean)[:, 0]
    apart = mixture.mean - mean[:, None]
    chains, n = mean.shape
    covariance = (share @ mixture.covariance.reshape(chains, -1, n * n)).reshape(chains, n, n)
    covariance += np.swapaxes(apart, 1, 2) @ (apart * mixture.probability[..., None])
    return mean, covariance


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


def transitioned(
    mixture: ModeMixture, step: Transition, nominal: FloatArray, switch: FloatArray | None = None
) -> ModeMixture:
    """The mixture after the step, of errors from a ``nominal`` (n,) that moves with its first m numbers and else stays:
    what of that a mode does not keep is an error of the mode. Its modes are :func:`mixed` before where there is a
    ``switch``."""
    mixture = mixture if switch is None else mixed(mixture, switch)
    mixing, first = len(step.moving), step.decay.shape[1] - step.relaxing.shape[1]
    mean = mixture.mean * step.decay + (step.decay - 1.0) * nominal
    mean[..., :mixing] = mixture.mean[..., :mixing] @ step.moving.T
    covariance = step.decay[:, :, None] * mixture.covariance
    covariance *= step.decay[:, None, :]
    rows = step.moving @ covariance[..., :mixing, :]
    covariance[..., :mixing, mixing:] = rows[..., mixing:]
    covariance[..., mixing:, :mixing] = np.swapaxes(rows[..., mixing:], -1, -2)
    covariance[..., :mixing, :mixing] = rows[..., :mixing] @ step.moving.T + step.driven
    covariance[..., first:, first:] += step.relaxing
    return ModeMixture(mean, covariance, mixture.probability)


def corrected(
    mixture: ModeMixture,
    linearised: Linearisation,
    measured: FloatArray,
    variance: FloatArray,
    shared: FloatArray | None = None,
    partial: FloatArray | None = None,
    tested: int | None = None,
) -> Update:
    """Kalman correction of every chain and mode by ``measured`` (C, m), NaN where there is nothing.

    ``variance`` (C, m) of the measurements' own errors, ``shared`` (C, m, m) a covariance common to several of them;
    ``partial`` of :func:`partial_update_shares`. Everything is taken in units of the noise, since pixels and metres
    differ by
    orders of magnitude.
    """
    used = np.isfinite(measured)
    unit = np.where(used, 1.0 / np.sqrt(np.where(used, variance, 1.0)), 0.0)
    slope = linearised.slope * unit[..., None]
    own = linearised.error if shared is None else linearised.error + shared
    own = own * (unit[:, :, None] * unit[:, None, :])
    diagonal = np.arange(measured.shape[1])
    own[:, diagonal, diagonal] += 1.0
    guess = (slope[:, None] @ (mixture.mean - linearised.point[:, None])[..., None])[..., 0]
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
    tested = measured.shape[1] if tested is None else tested
    first, rest = (np.vecdot(part, part) for part in (apart[..., :tested], apart[..., tested:]))
    log_root = -np.log(whitening.diagonal(axis1=-2, axis2=-1))
    weight = reweighed(mixture.probability, -0.5 * first - log_root[..., :tested].sum(axis=-1))
    probability = reweighed(mixture.probability, -0.5 * (first + rest) - log_root.sum(axis=-1))
    own_whitening, own_apart = whitening[..., :tested, :tested], apart[..., :tested]
    surprise = (own_apart[..., None, :] @ own_whitening)[..., 0, :]
    residual = surprise / np.sqrt((own_whitening * own_whitening).sum(axis=-2))
    used = used[:, :tested]
    return Update(
        ModeMixture(mixture.mean + step, covariance, probability),
        np.sum(weight * first, axis=1),
        used.sum(axis=1),
        np.where(used, np.sum(weight[..., None] * residual, axis=1), 0.0),
        np.sum(probability * rest, axis=1),
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
    weight = np.maximum(weight / weight.sum(axis=-1, keepdims=True), LEAST_PROBABILITY)
    return np.asarray(weight / weight.sum(axis=-1, keepdims=True))

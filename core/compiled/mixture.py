"""Mixtures of Gaussians, one of each mode of motion: what the filter asks of them in every frame.

Arrays lead with the chain (C) and the mode (K); each Gaussian has n numbers. A mixture is a ``ModeMixture`` of the
filter, whose arrays each function takes and returns as mean (C, K, n), covariance (C, K, n, n), probability (C, K).
Covariances are symmetric; of what comes in the lower half is read.
"""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython import Py_ssize_t, double
from cython.cimports.carpus.core.compiled.small_matrices import (
    add_product,
    inverse_root,
    zero_times,
)
from cython.cimports.libc.math import INFINITY, exp, isfinite, log, sqrt
from numpy.typing import NDArray

MIN_PROBABILITY = cython.declare(double, 1e-6)
"""No mode ever falls to zero."""

Array = NDArray[np.float64]


def as_arrays(mixture: Any) -> tuple[Array, Array, Array]:
    """Return the arrays of a mixture, row by row; ``ValueError`` where they are not of one size."""
    mean, covariance = np.ascontiguousarray(mixture.mean), np.ascontiguousarray(mixture.covariance)
    probability = np.ascontiguousarray(mixture.probability)
    if mean.ndim != 3 or covariance.shape != (*mean.shape, mean.shape[2]) or probability.shape != mean.shape[:2]:
        raise ValueError("mean, covariance and probability of a mixture are not of one size")
    return mean, covariance, probability


def merge_modes(mixture: Any) -> tuple[Array, Array]:
    """Merge the modes to mean (C, n) and covariance (C, n, n): the sum of w (P + a a'), a from the mean."""
    arrays = as_arrays(mixture)
    mean: cython.const[double][:, :, ::1] = arrays[0]
    covariance: cython.const[double][:, :, :, ::1] = arrays[1]
    weight: cython.const[double][:, ::1] = arrays[2]
    chains, modes, n = mean.shape[0], mean.shape[1], mean.shape[2]
    out_mean, out_covariance = np.zeros((chains, n)), np.zeros((chains, n, n))
    middle: double[:, ::1] = out_mean
    spread: double[:, :, ::1] = out_covariance
    for c in range(chains):
        for k in range(modes):
            for i in range(n):
                middle[c, i] += weight[c, k] * mean[c, k, i]
        for i in range(n):
            for k in range(modes):
                w = weight[c, k]
                apart = w * (mean[c, k, i] - middle[c, i])
                for j in range(i + 1):
                    spread[c, i, j] += w * covariance[c, k, i, j] + apart * (mean[c, k, j] - middle[c, j])
        mirror(spread[c])
    return out_mean, out_covariance


def predict_modes(mixture: Any, forward: Array, noise: Array, switch: Array | None) -> tuple[Array, Array, Array]:
    """Predict F m and F P F' + Q, with ``forward`` F (C, n, n) and ``noise`` Q (C, K, n, n), the modes mixed before.

    ``switch`` (K, K) holds the probabilities to go over from row to column; None leaves the modes as they are.
    """
    arrays = as_arrays(mixture)
    mean: cython.const[double][:, :, ::1] = arrays[0]
    covariance: cython.const[double][:, :, :, ::1] = arrays[1]
    chains, modes, n = mean.shape[0], mean.shape[1], mean.shape[2]
    if forward.shape != (chains, n, n) or noise.shape != (chains, modes, n, n):
        raise ValueError("a step is not of the mixture's size")
    ahead: cython.const[double][:, :, ::1] = np.ascontiguousarray(forward)
    share, probability = compute_shares(arrays[2], switch)
    mixed, out = np.empty_like(arrays[0]), noise.copy()
    to: double[:, :, ::1] = mixed
    spread: double[:, :, :, ::1] = out
    own: double[:, ::1] = np.empty((modes, n))
    before: double[:, :, ::1] = np.empty((modes, n, n))
    room: double[:, :, ::1] = np.empty((2, n, n))
    half: double[:, ::1] = room[0]
    turned: double[:, ::1] = room[1]
    for c in range(chains):
        mix(share[c], mean[c], covariance[c], to[c], before, own)
        for k in range(modes):
            mirror(before[k])
            half[:] = zero_times(before[k])
            add_product(ahead[c], before[k], half)
            transpose(half, turned)
            add_product(ahead[c], turned, spread[c, k])  # F (F P)'
    return (forward[:, None] @ mixed[..., None])[..., 0], out, probability


def predict_palm_modes(mixture: Any, step: Any, nominal: Array, switch: Array | None) -> tuple[Array, Array, Array]:
    """Predict the errors from a ``nominal`` (n,) after a ``Transition``, mixed before as in :func:`predict_modes`.

    The covariance becomes F P F' + Q, where F is ``moving`` (m, m) for the first m numbers and ``kept`` (K, n) of all
    others, Q is ``driven`` (K, m, m) of the first and ``relaxing`` (K, r, r) of the last r.
    """
    arrays = as_arrays(mixture)
    moving: cython.const[double][:, ::1] = np.ascontiguousarray(step.moving)
    driven: cython.const[double][:, :, ::1] = np.ascontiguousarray(step.driven)
    kept: cython.const[double][:, ::1] = np.ascontiguousarray(step.decay)
    relaxing: cython.const[double][:, :, ::1] = np.ascontiguousarray(step.relaxing)
    mean: cython.const[double][:, :, ::1] = arrays[0]
    covariance: cython.const[double][:, :, :, ::1] = arrays[1]
    chains, modes, n = mean.shape[0], mean.shape[1], mean.shape[2]
    m: Py_ssize_t = moving.shape[0]
    first: Py_ssize_t = n - relaxing.shape[1]
    sizes = [x.shape for x in (step.moving, step.driven, step.decay, step.relaxing)]
    if sizes != [(m, m), (modes, m, m), (modes, n), (modes, n - first, n - first)] or m > n or first < 0:
        raise ValueError("a step is not of the mixture's size")
    share, probability = compute_shares(arrays[2], switch)
    mixed, out = np.empty_like(arrays[0]), np.empty_like(arrays[1])
    to: double[:, :, ::1] = mixed
    spread: double[:, :, :, ::1] = out
    room: double[:, ::1] = np.empty((modes + 2 * m, n))
    before: double[:, ::1] = room[modes : modes + m]
    rows: double[:, ::1] = room[modes + m :]
    squares: double[:, :, ::1] = np.empty((2, m, m))
    corner: double[:, ::1] = squares[0]
    square: double[:, ::1] = squares[1]
    for c in range(chains):
        mix(share[c], mean[c], covariance[c], to[c], spread[c], room[:modes])
        for k in range(modes):
            p: double[:, ::1] = spread[c, k]
            # The covariance of those that move with all, F P, then of those among themselves, F (F P)' + Q.
            for i in range(n):
                for j in range(min(i + 1, m)):
                    before[j, i] = kept[k, i] * kept[k, j] * p[i, j]
                    if i < m:
                        before[i, j] = before[j, i]
            rows[:] = zero_times(p)
            add_product(moving, before, rows)
            for i in range(m):
                for j in range(m):
                    corner[j, i] = rows[i, j]
            square[:] = driven[k]
            add_product(moving, corner, square)
            for i in range(n):
                w = kept[k, i]
                for j in range(min(i + 1, m)):
                    p[i, j] = square[i, j] if i < m else rows[j, i]
                for j in range(m, i + 1):
                    p[i, j] *= w * kept[k, j]
                for j in range(first, i + 1):
                    p[i, j] += relaxing[k, i - first, j - first]
            mirror(p)
    moved = mixed * step.decay + (step.decay - 1.0) * nominal
    moved[..., :m] = mixed[..., :m] @ step.moving.T
    return moved, out, probability


@cython.cfunc
def compute_shares(probability: Array, switch: Array | None) -> tuple[Array, Array]:
    """Compute the share (C, to, from) of each mode in what becomes of them by the ``switch``, and that probability.

    It is the interaction of an interacting multiple model (Blom and Bar-Shalom 1988).
    """
    before: cython.const[double][:, ::1] = probability
    modes: Py_ssize_t = before.shape[1]
    if switch is not None and switch.shape != (modes, modes):
        raise ValueError("a switch has a row and a column for each mode")
    change: cython.const[double][:, ::1] = np.eye(modes) if switch is None else np.ascontiguousarray(switch)
    shares, after = np.empty((before.shape[0], modes, modes)), np.zeros((before.shape[0], modes))
    share: double[:, :, ::1] = shares
    total: double[:, ::1] = after
    for c in range(before.shape[0]):
        for to in range(modes):
            for k in range(modes):
                share[c, to, k] = before[c, k] * change[k, to]
                total[c, to] += share[c, to, k]
            for k in range(modes):
                share[c, to, k] /= total[c, to]
    return shares, after


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def mix(
    share: cython.const[double][:, ::1],
    mean: cython.const[double][:, ::1],
    covariance: cython.const[double][:, :, ::1],
    to_mean: double[:, ::1],
    spread: double[:, :, ::1],
    own: double[:, ::1],
) -> cython.void:
    """Fill in mean and lower half of the covariance of each mode mixed of all, with room ``own`` (K, n) to work in."""
    modes, n = mean.shape[0], mean.shape[1]
    last = modes - modes % 4
    for to in range(modes):
        for i in range(n):
            shift: double = 0.0
            for k in range(modes):
                shift += share[to, k] * (mean[k, i] - mean[0, i])
            to_mean[to, i] = shift
    # The scatter of the means about the first of them: the sum of s (P + a a') less the square of the sum of s a.
    for i in range(n):
        for k in range(modes):
            apart = mean[k, i] - mean[0, i]
            for j in range(i + 1):
                own[k, j] = covariance[k, i, j] + apart * (mean[k, j] - mean[0, j])
        for to in range(0, modes, 2):  # two modes at a time, or the last alone: what both need is fetched once
            other = min(to + 1, modes - 1)
            is_two: double = other - to
            for j in range(i + 1):
                spread[to, i, j] = -to_mean[to, i] * to_mean[to, j]
                spread[other, i, j] = -to_mean[other, i] * to_mean[other, j]
            for k in range(0, last, 4):
                w, x, y, z = share[to, k], share[to, k + 1], share[to, k + 2], share[to, k + 3]
                w2, x2, y2, z2 = share[other, k], share[other, k + 1], share[other, k + 2], share[other, k + 3]
                for j in range(i + 1):
                    p, q, r, s = own[k, j], own[k + 1, j], own[k + 2, j], own[k + 3, j]
                    spread[to, i, j] += w * p + x * q + y * r + z * s
                    spread[other, i, j] += is_two * (w2 * p + x2 * q + y2 * r + z2 * s)
            for k in range(last, modes):
                w, x = share[to, k], is_two * share[other, k]
                for j in range(i + 1):
                    spread[to, i, j] += w * own[k, j]
                    spread[other, i, j] += x * own[k, j]
    for to in range(modes):
        for i in range(n):
            to_mean[to, i] += mean[0, i]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def mirror(square: double[:, ::1]) -> cython.void:
    """Fill in the upper half by the lower."""
    for i in range(square.shape[0]):
        for j in range(i):
            square[j, i] = square[i, j]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def transpose(matrix: double[:, ::1], out: double[:, ::1]) -> cython.void:
    """Fill in the columns by the rows."""
    for i in range(matrix.shape[0]):
        for j in range(matrix.shape[1]):
            out[j, i] = matrix[i, j]


@cython.final
@cython.cclass
class InnovationWorkspace:
    """What was measured of one chain at a time, in units of its noise, and what a correction works out of it.

    y = H (x - point) + e with the covariance ``own`` of e. A number that was not measured has no slope and the noise
    alone.
    """

    value: cython.const[double][:, ::1]
    slope: cython.const[double][:, :, ::1]
    error: cython.const[double][:, :, ::1]
    point: cython.const[double][:, ::1]
    measured: cython.const[double][:, ::1]
    variance: cython.const[double][:, ::1]
    line: double[:, ::1]
    cross: double[:, ::1]
    white: double[:, ::1]
    row: double[::1]
    below: double[::1]
    turned: double[:, ::1]
    own: double[:, ::1]
    scatter: double[:, ::1]
    whitening: double[:, ::1]
    off: double[::1]
    unit: double[::1]
    apart: double[::1]

    def __init__(
        self, linearised: Any, shared: Array | None, measured: Array, variance: Array, chains: Py_ssize_t, n: Py_ssize_t
    ) -> None:
        m: Py_ssize_t = measured.shape[1]
        if shared is not None and shared.shape != linearised.error.shape:
            raise ValueError("a shared covariance is not of the size of what was measured")
        error = linearised.error if shared is None else linearised.error + shared
        arrays = linearised.value, linearised.slope, error, linearised.point, measured, variance
        sizes = [(chains, m), (chains, m, n), (chains, m, m), (chains, n), (chains, m), (chains, m)]
        if [x.shape for x in arrays] != sizes:
            raise ValueError("what was measured is not of one size, or not of the mixture's")
        self.value, self.slope, self.error, self.point, self.measured, self.variance = map(np.ascontiguousarray, arrays)
        # Room to work in, two arrays cut up: to make one costs as much as to fill it.
        wide: double[:, ::1] = np.empty((3 * m + 2, n))
        self.line, self.cross, self.white = wide[:m], wide[m : 2 * m], wide[2 * m : 3 * m]
        self.row, self.below = wide[3 * m], wide[3 * m + 1]
        high: double[:, ::1] = np.empty((n + 3 * m + 3, m))
        self.turned, self.own, self.scatter = high[:n], high[n : n + m], high[n + m : n + 2 * m]
        self.whitening = high[n + 2 * m : n + 3 * m]
        self.off, self.unit, self.apart = high[n + 3 * m], high[n + 3 * m + 1], high[n + 3 * m + 2]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def select_chain(self, c: Py_ssize_t, tested: Py_ssize_t) -> Py_ssize_t:
        """Fill in what was measured of a chain, and return how many of the ``tested`` numbers were."""
        used: Py_ssize_t = 0
        m, n = self.line.shape[0], self.line.shape[1]
        for i in range(m):
            known: cython.bint = isfinite(self.measured[c, i])
            used += known and i < tested
            self.unit[i] = 1.0 / sqrt(self.variance[c, i]) if known else 0.0
            self.off[i] = (self.measured[c, i] - self.value[c, i]) * self.unit[i] if known else 0.0
            for j in range(n):
                self.line[i, j] = self.slope[c, i, j] * self.unit[i]
                self.off[i] += self.line[i, j] * self.point[c, j]
            for j in range(i + 1):
                self.own[i, j] = self.own[j, i] = self.error[c, i, j] * (self.unit[i] * self.unit[j])
            self.own[i, i] += 1.0
        return used

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def whiten(self, mean: cython.const[double][::1], covariance: cython.const[double][:, ::1]) -> cython.bint:
        """Work out S = H P H' + own = L L', ``white`` = L^-1 H P and the innovation ``apart`` = L^-1 (y - H m).

        False where S has no root.
        """
        m, n = self.line.shape[0], self.line.shape[1]
        self.cross[:] = zero_times(covariance)
        self.scatter[:] = self.own
        self.white[:] = 0.0
        add_product(self.line, covariance, self.cross)
        transpose(self.cross, self.turned)
        add_product(self.line, self.turned, self.scatter)
        unknown = zero_times(self.scatter)
        if not inverse_root(self.scatter, self.whitening):
            if unknown == 0.0:
                return False
            self.whitening[:] = unknown  # and so is all that follows
        add_product(self.whitening, self.cross, self.white)
        for a in range(m):
            innovation: double = self.off[a]
            for j in range(n):
                innovation -= self.line[a, j] * mean[j]
            self.scatter[0, a] = innovation  # the scatter is not needed any more
            apart: double = 0.0
            for b in range(a + 1):
                apart += self.whitening[a, b] * self.scatter[0, b]
            self.apart[a] = apart
        return True

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def compute_log_likelihood(self, first: Py_ssize_t, last: Py_ssize_t) -> double:
        """Compute it but for a constant, of the numbers from ``first`` on given those before."""
        out: double = 0.0
        for a in range(first, last):
            out += log(self.whitening[a, a]) - 0.5 * self.apart[a] * self.apart[a]
        return out

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def fill_residuals(self, out: double[::1]) -> double:
        """Fill in each first number's residual given the others of them, in its own standard deviations.

        Return innovation' S^-1 innovation of them.
        """
        nis: double = 0.0
        for i in range(out.shape[0]):
            nis += self.apart[i] * self.apart[i]
            off: double = 0.0  # S^-1 innovation
            length2: double = 0.0
            for a in range(i, out.shape[0]):
                off += self.apart[a] * self.whitening[a, i]
                length2 += self.whitening[a, i] * self.whitening[a, i]
            out[i] = off / sqrt(length2) if self.unit[i] > 0.0 else 0.0
        return nis

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def correct(
        self,
        share: cython.const[double][::1],
        mean: cython.const[double][::1],
        covariance: cython.const[double][:, ::1],
        to: double[::1],
        spread: double[:, ::1],
    ) -> cython.void:
        """Fill in a Gaussian moved by what was gained, of which each number of the mean takes its ``share``."""
        white: double[:, ::1] = self.white
        row: double[::1] = self.row
        below: double[::1] = self.below
        m, n = white.shape[0], white.shape[1]
        row[:] = 0.0
        for a in range(m):
            x = self.apart[a]
            for j in range(n):
                row[j] += x * white[a, j]
        for j in range(n):
            to[j] = mean[j] + share[j] * row[j]
        for i in range(0, n, 2):  # two rows at a time, or the last twice: what both need is fetched once
            last = min(i + 1, n - 1)
            row[:] = 0.0
            below[:] = 0.0
            for a in range(0, m - m % 4, 4):
                w, x, y, z = white[a, i], white[a + 1, i], white[a + 2, i], white[a + 3, i]
                w2, x2, y2, z2 = white[a, last], white[a + 1, last], white[a + 2, last], white[a + 3, last]
                for j in range(last + 1):
                    p, q, r, s = white[a, j], white[a + 1, j], white[a + 2, j], white[a + 3, j]
                    row[j] += w * p + x * q + y * r + z * s
                    below[j] += w2 * p + x2 * q + y2 * r + z2 * s
            for a in range(m - m % 4, m):
                w, x = white[a, i], white[a, last]
                for j in range(last + 1):
                    row[j] += w * white[a, j]
                    below[j] += x * white[a, j]
            w, x = share[i], share[last]
            for j in range(last + 1):
                spread[i, j] = covariance[i, j] - (w + share[j] - w * share[j]) * row[j]
                spread[last, j] = covariance[last, j] - (x + share[j] - x * share[j]) * below[j]
            for j in range(last):
                spread[j, i], spread[j, last] = spread[i, j], spread[last, j]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def reweigh(
    before: cython.const[double][::1], log_likelihood: cython.const[double][::1], out: double[::1]
) -> cython.void:
    """Fill in the probabilities (K,) after the measurement; none ever falls to zero."""
    modes = before.shape[0]
    most: double = -INFINITY
    total: double = 0.0
    again: double = 0.0
    for k in range(modes):
        out[k] = log(before[k]) + log_likelihood[k]
        if not out[k] <= most:  # NaN goes on
            most = out[k]
    for k in range(modes):
        out[k] = exp(out[k] - most)
        total += out[k]
    for k in range(modes):
        out[k] /= total
        if out[k] < MIN_PROBABILITY:
            out[k] = MIN_PROBABILITY
        again += out[k]
    for k in range(modes):
        out[k] /= again


def correct_mixture(
    mixture: Any,
    linearised: Any,
    measured: Array,
    variance: Array,
    shared: Array | None,
    partial: Array | None,
    tested: int,
) -> tuple[Array, Array, Array, Array, NDArray[np.int64], Array, Array]:
    """
    Correct every chain and mode by what was measured (Kalman).

    Parameters
    ----------
    mixture : ModeMixture
        Before.
    linearised : Linearisation
        Of the measurement.
    measured, variance : numpy.ndarray
        Measured numbers (C, m), NaN where there is nothing, and the variances of their own errors.
    shared : numpy.ndarray or None
        Covariance (C, m, m) common to several of them.
    partial : numpy.ndarray or None
        Share (n,) of a correction that each number of the mean takes (a Schmidt filter; Brink 2017: the covariance then
        loses s_i + s_j - s_i s_j of what it would).
    tested : int
        How many of the numbers, from the first on, are tested by themselves; the others are given those.

    Returns
    -------
    tuple of numpy.ndarray
        The corrected mixture; normalised innovation squared (C,) over all modes of the tested numbers and its degrees
        of freedom (C,); their residuals (C, tested) in their own standard deviations; the normalised innovation
        squared (C,) of the other numbers, given the tested.

    Raises
    ------
    numpy.linalg.LinAlgError
        When a covariance of the innovation is not positive definite.
    """
    arrays = as_arrays(mixture)
    out = np.empty_like(arrays[0]), np.empty_like(arrays[1]), np.empty_like(arrays[2])
    mean: cython.const[double][:, :, ::1] = arrays[0]
    covariance: cython.const[double][:, :, :, ::1] = arrays[1]
    before: cython.const[double][:, ::1] = arrays[2]
    to: double[:, :, ::1] = out[0]
    spread: double[:, :, :, ::1] = out[1]
    after: double[:, ::1] = out[2]
    chains, modes, n = mean.shape[0], mean.shape[1], mean.shape[2]
    m: Py_ssize_t = measured.shape[1]
    first: Py_ssize_t = tested
    share: cython.const[double][::1] = np.ones(n) if partial is None else np.ascontiguousarray(partial)
    if share.shape[0] != n or not 0 <= first <= m:
        raise ValueError("the shares, or what is tested, are not of the mixture's size")
    one: InnovationWorkspace = InnovationWorkspace(linearised, shared, measured, variance, chains, n)
    tests, dof, residuals = np.zeros((2, chains)), np.empty(chains, dtype=np.int64), np.zeros((chains, first))
    nis: double[:, ::1] = tests
    residual: double[:, ::1] = residuals
    own: double[:, ::1] = np.empty((modes, first))
    of_mode: double[:, ::1] = np.zeros((5, modes))
    for c in range(chains):
        dof[c] = one.select_chain(c, first)
        for k in range(modes):
            if not one.whiten(mean[c, k], covariance[c, k]):
                raise np.linalg.LinAlgError("Matrix is not positive definite")
            of_mode[0, k] = one.fill_residuals(own[k])
            of_mode[1, k] = 0.0
            for a in range(first, m):
                of_mode[1, k] += one.apart[a] * one.apart[a]
            of_mode[2, k] = one.compute_log_likelihood(0, first)
            of_mode[3, k] = of_mode[2, k] + one.compute_log_likelihood(first, m)
            one.correct(share, mean[c, k], covariance[c, k], to[c, k], spread[c, k])
        reweigh(before[c], of_mode[2], of_mode[4])
        reweigh(before[c], of_mode[3], after[c])
        for k in range(modes):
            nis[0, c] += of_mode[4, k] * of_mode[0, k]
            nis[1, c] += after[c, k] * of_mode[1, k]
            for a in range(first):
                residual[c, a] += of_mode[4, k] * own[k, a]
    return (*out, tests[0], dof, residuals, tests[1])

"""Mixtures of Gaussians, one of each mode of motion: what the filter asks of them in every frame.

Arrays lead with the chain (C) and the mode (K); each Gaussian has n numbers. A mixture is a ``ModeMixture`` of the
filter, whose arrays each function takes and returns as mean (C, K, n), covariance (C, K, n, n), probability (C, K).
Covariances are symmetric; of what comes in the lower half is read.
"""

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython.cimports.carpus.core.compiled.small_matrices import (
    add_product,
    add_sparse_product,
    inverse_root,
    zero_times,
)
from cython.cimports.libc.math import INFINITY, exp, isfinite, log, sqrt
from numpy.typing import NDArray

MIN_PROBABILITY = cython.declare(cython.double, 1e-6)
"""No mode ever falls to zero."""

Array = NDArray[np.float64]


def require_mixture(mixture: Any) -> tuple[Array, Array, Array]:
    """The arrays of a mixture, row by row. Raises ``ValueError`` where they are not of one size."""
    mean, covariance = np.ascontiguousarray(mixture.mean), np.ascontiguousarray(mixture.covariance)
    probability = np.ascontiguousarray(mixture.probability)
    if mean.ndim != 3 or covariance.shape != (*mean.shape, mean.shape[2]) or probability.shape != mean.shape[:2]:
        raise ValueError("mean, covariance and probability of a mixture are not of one size")
    return mean, covariance, probability


def merge_modes(mixture: Any) -> tuple[Array, Array]:
    """Mean (C, n) and covariance (C, n, n) over the modes: the sum of w (P + a a'), a from the mean."""
    arrays = require_mixture(mixture)
    mean: cython.const[cython.double][:, :, ::1] = arrays[0]
    covariance: cython.const[cython.double][:, :, :, ::1] = arrays[1]
    weight: cython.const[cython.double][:, ::1] = arrays[2]
    chains, modes, n = mean.shape[0], mean.shape[1], mean.shape[2]
    out_mean, out_covariance = np.zeros((chains, n)), np.zeros((chains, n, n))
    middle: cython.double[:, ::1] = out_mean
    spread: cython.double[:, :, ::1] = out_covariance
    c: cython.Py_ssize_t
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
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
            for j in range(i):
                spread[c, j, i] = spread[c, i, j]
    return out_mean, out_covariance


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def fill_shares(
    probability: cython.const[cython.double][:, ::1],
    switch: cython.const[cython.double][:, ::1],
    after: cython.double[:, ::1],
    share: cython.double[:, :, ::1],
) -> cython.void:
    """Fill in how probable each mode is after the ``switch``, and the share (C, to, from) of it from each before."""
    for c in range(share.shape[0]):
        for to in range(share.shape[1]):
            after[c, to] = 0.0
            for k in range(share.shape[2]):
                share[c, to, k] = probability[c, k] * switch[k, to]
                after[c, to] += share[c, to, k]
            for k in range(share.shape[2]):
                share[c, to, k] /= after[c, to]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def mix(
    share: cython.const[cython.double][:, ::1],
    mean: cython.const[cython.double][:, ::1],
    covariance: cython.const[cython.double][:, :, ::1],
    to_mean: cython.double[:, ::1],
    spread: cython.double[:, :, ::1],
    own: cython.double[:, ::1],
) -> cython.void:
    """Fill in mean and lower half of the covariance of each mode mixed of all, with room ``own`` (K, n) to work in."""
    modes, n = mean.shape[0], mean.shape[1]
    last = modes - modes % 4
    for to in range(modes):
        for i in range(n):
            shift: cython.double = 0.0
            for k in range(modes):
                shift += share[to, k] * (mean[k, i] - mean[0, i])
            to_mean[to, i] = shift
    # The scatter of the means about the first of them: the sum of s (P + a a') less the square of the sum of s a.
    for i in range(n):
        for k in range(modes):
            apart = mean[k, i] - mean[0, i]
            for j in range(i + 1):
                own[k, j] = covariance[k, i, j] + apart * (mean[k, j] - mean[0, j])
        for to in range(0, modes, 2):  # two modes at a time: what both need is fetched once
            other = min(to + 1, modes - 1)
            is_two: cython.double = other - to
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
def mirror(square: cython.double[:, ::1]) -> cython.void:
    """Fill in the upper half by the lower."""
    for i in range(square.shape[0]):
        for j in range(i):
            square[j, i] = square[i, j]


def mix_modes(mixture: Any, switch: Array) -> tuple[Array, Array, Array]:
    """Each mode's start from all that may have switched to it, ``switch`` (K, K) from row to column: the interaction of
    an interacting multiple model (Blom and Bar-Shalom 1988)."""
    arrays = require_mixture(mixture)
    mean: cython.const[cython.double][:, :, ::1] = arrays[0]
    covariance: cython.const[cython.double][:, :, :, ::1] = arrays[1]
    chains, modes, n = mean.shape[0], mean.shape[1], mean.shape[2]
    if switch.shape != (modes, modes):
        raise ValueError("a switch has a row and a column for each mode")
    out = np.empty_like(arrays[0]), np.empty_like(arrays[1]), np.empty_like(arrays[2])
    to: cython.double[:, :, ::1] = out[0]
    spread: cython.double[:, :, :, ::1] = out[1]
    share: cython.double[:, :, ::1] = np.empty((chains, modes, modes))
    own: cython.double[:, ::1] = np.empty((modes, n))
    fill_shares(arrays[2], np.ascontiguousarray(switch), out[2], share)
    for c in range(chains):
        mix(share[c], mean[c], covariance[c], to[c], spread[c], own)
        for k in range(modes):
            mirror(spread[c, k])
    return out


def predict_modes(mixture: Any, forward: Array, noise: Array) -> tuple[Array, Array]:
    """Mean F m and covariance F P F' + Q, ``forward`` F (C, n, n) and ``noise`` Q (C, K, n, n)."""
    arrays = require_mixture(mixture)
    covariance: cython.const[cython.double][:, :, :, ::1] = arrays[1]
    chains, modes, n = covariance.shape[0], covariance.shape[1], covariance.shape[2]
    if forward.shape != (chains, n, n) or noise.shape != (chains, modes, n, n):
        raise ValueError("a step is not of the mixture's size")
    ahead: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(forward)
    out = noise.copy()
    spread: cython.double[:, :, :, ::1] = out
    half: cython.double[:, ::1] = np.empty((n, n))
    turned: cython.double[:, ::1] = np.empty((n, n))
    for c in range(chains):
        for k in range(modes):
            half[:] = zero_times(covariance[c, k])
            add_sparse_product(ahead[c], covariance[c, k], half)
            for i in range(n):
                for j in range(n):
                    turned[j, i] = half[i, j]
            add_sparse_product(ahead[c], turned, spread[c, k])  # F (F P)'
    return (forward[:, None] @ arrays[0][..., None])[..., 0], out


def predict_palm_modes(
    mixture: Any, step: Any, nominal: Array, switch: Array | None = None
) -> tuple[Array, Array, Array]:
    """
    Predict the errors from a ``nominal`` (n,) after a ``Transition``, mixed before by the ``switch`` (K, K) if any.

    The covariance becomes F P F' + Q, where F is ``moving`` (m, m) for the first m numbers and ``kept`` (K, n) of all
    others, Q is ``driven`` (K, m, m) of the first and ``relaxing`` (K, r, r) of the last r.
    """
    arrays = require_mixture(mixture)
    moving: cython.const[cython.double][:, ::1] = np.ascontiguousarray(step.moving)
    driven: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(step.driven)
    kept: cython.const[cython.double][:, ::1] = np.ascontiguousarray(step.kept)
    relaxing: cython.const[cython.double][:, :, ::1] = np.ascontiguousarray(step.relaxing)
    mean: cython.const[cython.double][:, :, ::1] = arrays[0]
    covariance: cython.const[cython.double][:, :, :, ::1] = arrays[1]
    chains, modes, n = mean.shape[0], mean.shape[1], mean.shape[2]
    m: cython.Py_ssize_t = moving.shape[0]
    first: cython.Py_ssize_t = n - relaxing.shape[1]
    sizes = [x.shape for x in (step.moving, step.driven, step.kept, step.relaxing)]
    if sizes != [(m, m), (modes, m, m), (modes, n), (modes, n - first, n - first)] or m > n or first < 0:
        raise ValueError("a step is not of the mixture's size")
    out = np.empty_like(arrays[0]), np.empty_like(arrays[1]), np.empty_like(arrays[2])
    to: cython.double[:, :, ::1] = out[0]
    spread: cython.double[:, :, :, ::1] = out[1]
    share: cython.double[:, :, ::1] = np.empty((chains, modes, modes))
    room: cython.double[:, ::1] = np.empty((modes + 2 * m, n))
    before: cython.double[:, ::1] = room[modes : modes + m]
    rows: cython.double[:, ::1] = room[modes + m :]
    squares: cython.double[:, :, ::1] = np.empty((2, m, m))
    corner: cython.double[:, ::1] = squares[0]
    square: cython.double[:, ::1] = squares[1]
    fill_shares(arrays[2], np.eye(modes) if switch is None else np.ascontiguousarray(switch), out[2], share)
    for c in range(chains):
        mix(share[c], mean[c], covariance[c], to[c], spread[c], room[:modes])
        for k in range(modes):
            # Those that move, with all, before and after: F P.
            for i in range(m):
                w = kept[k, i]
                for j in range(n):
                    before[i, j] = w * kept[k, j] * (spread[c, k, j, i] if j > i else spread[c, k, i, j])
            rows[:] = zero_times(spread[c, k])
            add_sparse_product(moving, before, rows)
            for i in range(m):
                for j in range(m):
                    corner[j, i] = rows[i, j]
            square[:] = driven[k]
            add_sparse_product(moving, corner, square)
            for i in range(m, n):
                w = kept[k, i]
                for j in range(m):
                    spread[c, k, i, j] = rows[j, i]
                for j in range(m, i + 1):
                    spread[c, k, i, j] *= w * kept[k, j]
            for i in range(m):
                for j in range(i + 1):
                    spread[c, k, i, j] = square[i, j]
            for i in range(first, n):
                for j in range(first, i + 1):
                    spread[c, k, i, j] += relaxing[k, i - first, j - first]
            mirror(spread[c, k])
    mixed_mean = out[0]
    moved = mixed_mean * step.kept + (step.kept - 1.0) * nominal
    moved[..., :m] = mixed_mean[..., :m] @ step.moving.T
    return moved, out[1], out[2]


@cython.final
@cython.cclass
class InnovationWorkspace:
    """What was measured, of one chain at a time in units of its noise: y = H (x - about) + e with the covariance
    ``own`` of e, and what a correction works out of it. A number that was not measured has no slope and the noise
    alone."""

    value: cython.const[cython.double][:, ::1]
    slope: cython.const[cython.double][:, :, ::1]
    error: cython.const[cython.double][:, :, ::1]
    about: cython.const[cython.double][:, ::1]
    measured: cython.const[cython.double][:, ::1]
    variance: cython.const[cython.double][:, ::1]
    line: cython.double[:, ::1]
    cross: cython.double[:, ::1]
    white: cython.double[:, ::1]
    rows: cython.double[:, ::1]
    turned: cython.double[:, ::1]
    own: cython.double[:, ::1]
    scatter: cython.double[:, ::1]
    whitening: cython.double[:, ::1]
    off: cython.double[::1]
    unit: cython.double[::1]
    apart: cython.double[::1]

    def __init__(self, linearised: Any, shared: Array | None, measured: Array, variance: Array, n: int) -> None:
        chains, m = measured.shape
        if shared is not None and shared.shape != linearised.error.shape:
            raise ValueError("a shared covariance is not of the size of what was measured")
        error = linearised.error if shared is None else linearised.error + shared
        self.value, self.slope = np.ascontiguousarray(linearised.value), np.ascontiguousarray(linearised.slope)
        self.error, self.about = np.ascontiguousarray(error), np.ascontiguousarray(linearised.about)
        self.measured, self.variance = np.ascontiguousarray(measured), np.ascontiguousarray(variance)
        given = linearised.value, linearised.slope, error, linearised.about, variance
        if [x.shape for x in given] != [(chains, m), (chains, m, n), (chains, m, m), (chains, n), (chains, m)]:
            raise ValueError("what was measured is not of one size, or not of the mixture's")
        # Room to work in, two arrays cut up: to make one costs as much as to fill it.
        wide: cython.double[:, ::1] = np.empty((3 * m + 2, n))
        self.line, self.cross, self.white, self.rows = wide[:m], wide[m : 2 * m], wide[2 * m : 3 * m], wide[3 * m :]
        square: cython.double[:, ::1] = np.empty((n + 3 * m + 3, m))
        self.turned, self.own, self.scatter = square[:n], square[n : n + m], square[n + m : n + 2 * m]
        self.whitening = square[n + 2 * m : n + 3 * m]
        self.off, self.unit, self.apart = square[n + 3 * m], square[n + 3 * m + 1], square[n + 3 * m + 2]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def select_chain(self, c: cython.Py_ssize_t) -> cython.Py_ssize_t:
        """What was measured of a chain; of how many numbers."""
        used: cython.Py_ssize_t = 0
        i: cython.Py_ssize_t
        for i in range(self.off.shape[0]):
            known: cython.bint = isfinite(self.measured[c, i])
            used += known
            self.unit[i] = 1.0 / sqrt(self.variance[c, i]) if known else 0.0
            self.off[i] = (self.measured[c, i] - self.value[c, i]) * self.unit[i] if known else 0.0
            for j in range(self.line.shape[1]):
                self.line[i, j] = self.slope[c, i, j] * self.unit[i]
                self.off[i] += self.line[i, j] * self.about[c, j]
            for j in range(i + 1):
                self.own[i, j] = self.own[j, i] = self.error[c, i, j] * (self.unit[i] * self.unit[j])
            self.own[i, i] += 1.0
        return used

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def whiten(
        self,
        mean: cython.const[cython.double][::1],
        covariance: cython.const[cython.double][:, ::1],
    ) -> cython.bint:
        """The scatter S = H P H' + own as L L', then ``white`` = L^-1 H P and ``apart`` = L^-1 (y - H (m - about)).
        False where S has no root."""
        m, n = self.line.shape[0], self.line.shape[1]
        self.cross[:] = zero_times(covariance)
        self.scatter[:] = self.own
        self.white[:] = 0.0
        add_sparse_product(self.line, covariance, self.cross)
        for a in range(m):
            for j in range(n):
                self.turned[j, a] = self.cross[a, j]
        add_sparse_product(self.line, self.turned, self.scatter)
        unknown = zero_times(self.scatter)
        if not inverse_root(self.scatter, self.whitening):
            if unknown == 0.0:
                return False
            self.whitening[:] = unknown  # and so is all that follows
        add_product(self.whitening, self.cross, self.white)
        # The scatter is not needed any more: its first row is the innovation.
        for a in range(m):
            innovation: cython.double = self.off[a]
            for j in range(n):
                innovation -= self.line[a, j] * mean[j]
            self.scatter[0, a] = innovation
            apart: cython.double = 0.0
            for b in range(a + 1):
                apart += self.whitening[a, b] * self.scatter[0, b]
            self.apart[a] = apart
        return True

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def nis(self) -> cython.double:
        """Innovation' S^-1 innovation."""
        out: cython.double = 0.0
        for a in range(self.apart.shape[0]):
            out += self.apart[a] * self.apart[a]
        return out

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def log_likelihood(self) -> cython.double:
        """Of the mode, but for a constant."""
        out: cython.double = -0.5 * self.nis()
        for a in range(self.apart.shape[0]):
            out += log(self.whitening[a, a])
        return out

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def fill_residuals(self, out: cython.double[::1]) -> cython.void:
        """Each measured number's residual given all others, in its own standard deviations: of S^-1 innovation."""
        for i in range(out.shape[0]):
            off: cython.double = 0.0
            length2: cython.double = 0.0
            for a in range(i, out.shape[0]):
                off += self.apart[a] * self.whitening[a, i]
                length2 += self.whitening[a, i] * self.whitening[a, i]
            out[i] = off / sqrt(length2) if self.unit[i] > 0.0 else 0.0

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def correct(
        self,
        share: cython.const[cython.double][::1],
        mean: cython.const[cython.double][::1],
        covariance: cython.const[cython.double][:, ::1],
        to: cython.double[::1],
        spread: cython.double[:, ::1],
    ) -> cython.void:
        """Move a Gaussian by what was gained, of which each number of the mean takes its ``share``."""
        white: cython.double[:, ::1] = self.white
        row: cython.double[::1] = self.rows[0]
        below: cython.double[::1] = self.rows[1]
        m: cython.Py_ssize_t = white.shape[0]
        n: cython.Py_ssize_t = white.shape[1]
        row[:] = 0.0
        for a in range(m):
            x = self.apart[a]
            for j in range(n):
                row[j] += x * white[a, j]
        for j in range(n):
            to[j] = mean[j] + share[j] * row[j]
        for i in range(0, n, 2):  # two rows at a time: what both need is fetched once
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
    before: cython.const[cython.double][::1], log_likelihood: cython.const[cython.double][::1], out: cython.double[::1]
) -> cython.void:
    """Probabilities (K,) after the measurement; none ever falls to zero."""
    k: cython.Py_ssize_t
    modes: cython.Py_ssize_t = before.shape[0]
    most: cython.double = -INFINITY
    total: cython.double = 0.0
    again: cython.double = 0.0
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
) -> tuple[Array, Array, Array, Array, NDArray[np.int64], Array]:
    """Kalman correction of every chain and mode by ``measured`` (C, m), NaN where there is nothing.

    ``variance`` (C, m) of the measurements' own errors, ``shared`` (C, m, m) covariance common to several of them,
    ``partial`` (n,) share of a correction that each number of the mean takes (a Schmidt filter; Brink 2017: the
    covariance then loses s_i + s_j - s_i s_j of what it would).

    The corrected mixture, NIS (C,) over all modes with its degrees of freedom (C,), residuals (C, m) in their own
    standard deviations. Raises ``numpy.linalg.LinAlgError`` where a scatter is not positive definite.
    """
    arrays = require_mixture(mixture)
    out = np.empty_like(arrays[0]), np.empty_like(arrays[1]), np.empty_like(arrays[2])
    mean: cython.const[cython.double][:, :, ::1] = arrays[0]
    covariance: cython.const[cython.double][:, :, :, ::1] = arrays[1]
    before: cython.const[cython.double][:, ::1] = arrays[2]
    to: cython.double[:, :, ::1] = out[0]
    spread: cython.double[:, :, :, ::1] = out[1]
    after: cython.double[:, ::1] = out[2]
    chains, modes, n, m = mean.shape[0], mean.shape[1], mean.shape[2], measured.shape[1]
    share: cython.const[cython.double][::1] = np.ones(n) if partial is None else np.ascontiguousarray(partial)
    if share.shape[0] != n or measured.shape[0] != chains:
        raise ValueError("what was measured, or the shares, are not of the mixture's size")
    one: InnovationWorkspace = InnovationWorkspace(linearised, shared, measured, variance, n)
    tests, dof, residuals = np.zeros(chains), np.empty(chains, dtype=np.int64), np.zeros((chains, m))
    nis: cython.double[::1] = tests
    residual: cython.double[:, ::1] = residuals
    log_likelihood: cython.double[::1] = np.empty(modes)
    square: cython.double[::1] = np.empty(modes)
    surprise: cython.double[:, ::1] = np.empty((modes, m))
    c: cython.Py_ssize_t
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    for c in range(chains):
        dof[c] = one.select_chain(c)
        for k in range(modes):
            if not one.whiten(mean[c, k], covariance[c, k]):
                raise np.linalg.LinAlgError("Matrix is not positive definite")
            log_likelihood[k], square[k] = one.log_likelihood(), one.nis()
            one.fill_residuals(surprise[k])
            one.correct(share, mean[c, k], covariance[c, k], to[c, k], spread[c, k])
        reweigh(before[c], log_likelihood, after[c])
        for k in range(modes):
            nis[c] += after[c, k] * square[k]
            for i in range(m):
                residual[c, i] += after[c, k] * surprise[k, i]
    return (*out, tests, dof, residuals)

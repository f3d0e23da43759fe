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

from carpus.core.compiled import mixture as compiled
from carpus.core.model.types import FloatArray


@dataclass(frozen=True, slots=True)
class ModeMixture:
    """Gaussians: ``mean`` (C, K, n), ``covariance`` (C, K, n, n), ``probability`` (C, K) of each mode."""

    mean: FloatArray
    covariance: FloatArray
    probability: FloatArray

    @staticmethod
    def from_gaussian(mean: FloatArray, covariance: FloatArray, modes: int) -> ModeMixture:
        """All modes alike and as probable, of means (C, n) and covariances (C, n, n)."""
        return ModeMixture(
            np.repeat(mean[:, None], modes, axis=1),
            np.repeat(covariance[:, None], modes, axis=1),
            np.full((len(mean), modes), 1.0 / modes),
        )

    def merge(self) -> tuple[FloatArray, FloatArray]:
        """Mean (C, n) and covariance (C, n, n) over the modes."""
        if self.probability.shape[1] == 1:
            return self.mean[:, 0], self.covariance[:, 0]
        return compiled.merge_modes(self)


def mode_transition_matrix(modes: int, dwell_s: float, dt_s: float) -> FloatArray:
    """Probability (K, K) to go from row to column mode in ``dt_s``, staying ``dwell_s`` on average."""
    if modes == 1:
        return np.ones((1, 1))
    leave = 1.0 - math.exp(-dt_s / dwell_s)
    out = np.full((modes, modes), leave / (modes - 1))
    out.reshape(-1)[:: modes + 1] = 1.0 - leave
    return out


def predict_mixture(
    mixture: ModeMixture, forward: FloatArray, noise: FloatArray, switch: FloatArray | None = None
) -> ModeMixture:
    """Predict F m and F P F' + Q, ``forward`` F (C, n, n) and ``noise`` Q (C, K, n, n).

    Each mode is mixed before of all that may have gone over to it by the ``switch`` (K, K) from row to column.
    """
    return ModeMixture(*compiled.predict_modes(mixture, forward, noise, switch))


@dataclass(frozen=True, slots=True)
class Transition:
    """A step of a chain of which only the first m numbers mix: ``moving`` (m, m) of these with the ``driven`` noise
    (K, m, m); of every number the share ``kept`` (K, n) is left, one for the moving; the last r numbers are pushed by
    ``relaxing`` (K, r, r)."""

    moving: FloatArray
    driven: FloatArray
    kept: FloatArray
    relaxing: FloatArray


def propagate_mixture(
    mixture: ModeMixture, step: Transition, nominal: FloatArray, switch: FloatArray | None = None
) -> ModeMixture:
    """The mixture after the step, of errors from a ``nominal`` (n,) that moves with its first m numbers and else stays:
    what of that a mode does not keep is an error of the mode. Its modes are mixed before by the ``switch``."""
    return ModeMixture(*compiled.predict_palm_modes(mixture, step, nominal, switch))


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
    """Corrected ``mixture``, and how well what was measured had been foreseen.

    Of the tested numbers ``nis`` (C,), innovation' S^-1 innovation over all modes, with its degrees of freedom ``dof``
    (C,) and the ``residual`` (C, m) of each number in its own standard deviations, N(0, 1) when all is right, 0 where
    nothing was measured. ``rest_nis`` (C,) that of the other numbers, given those.
    """

    mixture: ModeMixture
    nis: FloatArray
    dof: NDArray[np.int64]
    residual: FloatArray
    rest_nis: FloatArray


def partial_update_shares(size: int, rows: slice, share: float) -> FloatArray:
    """Shares (n,) of a correction that the mean takes: the numbers of ``rows`` only ``share``.

    Partial-update Schmidt-Kalman filter (Brink 2017): errors that stay with a disc come again in every picture, and
    believed in full they would bend the hand's geometry until it explains them.
    """
    mean = np.ones(size)
    mean[rows] = share
    return mean


def update_mixture(
    mixture: ModeMixture,
    linearised: Linearisation,
    measured: FloatArray,
    variance: FloatArray,
    shared: FloatArray | None = None,
    partial: FloatArray | None = None,
    tested: int | None = None,
) -> Update:
    """Correct every chain and mode by ``measured`` (C, m), NaN where there is nothing (Kalman).

    ``variance`` (C, m) of the measurements' own errors, ``shared`` (C, m, m) a covariance common to several of them;
    ``partial`` of :func:`partial_update_shares`; the first ``tested`` numbers, or all, are tested by themselves.
    Everything is taken in units of the noise, since pixels and metres differ by orders of magnitude.
    """
    tested = measured.shape[1] if tested is None else tested
    found = compiled.correct_mixture(mixture, linearised, measured, variance, shared, partial, tested)
    return Update(ModeMixture(*found[:3]), *found[3:])


def rts_step(
    covariance: FloatArray,
    forward: FloatArray,
    noise: FloatArray,
    difference: FloatArray,
    later_covariance: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """One step of Rauch, Tung and Striebel's recursion: the correction (C, n) of a filtered mean and the smoothed
    covariance (C, n, n), from the filtered ``covariance``, the step's ``forward`` and ``noise`` (C, n, n), how far the
    later smoothed mean lies from the predicted one (C, n), and the later smoothed covariance."""
    across = forward @ covariance
    ahead = across @ np.swapaxes(forward, -1, -2) + noise
    gain = np.swapaxes(np.linalg.solve(ahead, across), -1, -2)
    smoothed = covariance + gain @ (later_covariance - ahead) @ np.swapaxes(gain, -1, -2)
    correction = (gain @ difference[..., None])[..., 0]
    return correction, 0.5 * (smoothed + np.swapaxes(smoothed, -1, -2))

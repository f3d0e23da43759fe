"""The filter of all chains: Gaussians in several motion modes, predicted, mixed, updated, merged.

Arrays lead with the chain (C: the palm is one, thumb and fingers are five) and the mode (K). A chain's model gives the
transition, its noise, and h as linearised by sigma points. The modes form an interacting multiple model (Blom and
Bar-Shalom 1988): the same filter with other process noise, weighed by how well each predicted the measurements. Where a
chain lives on a manifold its numbers are small errors from a nominal estimate that the model stores.

The sigma points (Wan and van der Merwe 2000; Kandepu et al. 2008) of the palm are made in ``predict_palm_measurement``
of :mod:`core.compiled.palm`, those of the digits in ``compute_digit_sigma_points`` of :mod:`core.compiled.digits`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

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
        """Return equally probable, equal modes of means (C, n) and covariances (C, n, n)."""
        return ModeMixture(
            np.repeat(mean[:, None], modes, axis=1),
            np.repeat(covariance[:, None], modes, axis=1),
            np.full((len(mean), modes), 1.0 / modes),
        )

    def merge(self) -> tuple[FloatArray, FloatArray]:
        """Return mean (C, n) and covariance (C, n, n) over the modes."""
        if self.probability.shape[1] == 1:
            return self.mean[:, 0], self.covariance[:, 0]
        return compiled.merge_modes(self)


def mode_transition_matrix(modes: int, dwell_s: float, dt_s: float) -> FloatArray:
    """Return the probability (K, K) to go from row to column mode in ``dt_s``.

    ``dwell_s`` is the mean time in a mode.
    """
    if modes == 1:
        return np.ones((1, 1))
    leave = 1.0 - math.exp(-dt_s / dwell_s)
    out = np.full((modes, modes), leave / (modes - 1))
    out.reshape(-1)[:: modes + 1] = 1.0 - leave
    return out


@dataclass(frozen=True, slots=True)
class Transition:
    """A step of a chain of which only the first m numbers mix.

    ``moving`` (m, m) is F of these with the noise ``driven`` (K, m, m); every number decays by the factor ``decay``
    (K, n), one for the moving; the last r numbers are driven by ``relaxing`` (K, r, r).
    """

    moving: FloatArray
    driven: FloatArray
    decay: FloatArray
    relaxing: FloatArray


@dataclass(frozen=True, slots=True)
class UnscentedParameters:
    """Scaling of the sigma points; with kappa 0 and alpha 1 they stand at sqrt(n) sigma."""

    alpha: float = 0.25
    beta: float = 2.0
    kappa: float = 0.0


@dataclass(frozen=True, slots=True)
class SigmaWeights:
    """``mean`` and ``covariance`` (2n+1,), the centre first; ``scale`` sqrt(n + lambda)."""

    mean: FloatArray
    covariance: FloatArray
    scale: float


@lru_cache(maxsize=64)
def compute_weights(dimension: int, scaling: UnscentedParameters) -> SigmaWeights:
    """Return the weights of the 2n+1 points of an n-dimensional Gaussian."""
    lam = scaling.alpha**2 * (dimension + scaling.kappa) - dimension
    total = dimension + lam
    mean = np.full(2 * dimension + 1, 0.5 / total)
    covariance = mean.copy()
    mean[0] = lam / total
    covariance[0] = mean[0] + 1.0 - scaling.alpha**2 + scaling.beta
    mean.setflags(write=False)
    covariance.setflags(write=False)
    return SigmaWeights(mean, covariance, float(np.sqrt(total)))


@dataclass(frozen=True, slots=True)
class Linearisation:
    """A measurement linearised statistically: y = ``value`` + ``slope`` (x - ``point``) + error.

    ``value`` (C, m), ``slope`` (C, m, n), ``error`` (C, m, m) covariance of what that misses, ``point`` (C, n).
    """

    value: FloatArray
    slope: FloatArray
    error: FloatArray
    point: FloatArray


@dataclass(frozen=True, slots=True)
class Update:
    """The updated ``mixture``, and its consistency with the measurements.

    Of the tested components ``nis`` (C,), innovation' S^-1 innovation over all modes, with its degrees of freedom
    ``dof`` (C,) and the ``residual`` (C, m) of each component in its own standard deviations, N(0, 1) when all is
    right, 0 where nothing was measured. ``rest_nis`` (C,) that of the other components, given those.
    """

    mixture: ModeMixture
    nis: FloatArray
    dof: NDArray[np.int64]
    residual: FloatArray
    rest_nis: FloatArray


def partial_update_shares(size: int, rows: slice, share: float) -> FloatArray:
    """Return the shares (n,) of an update that the mean takes: ``rows`` only ``share``.

    Partial-update Schmidt-Kalman filter (Brink 2017): errors that stay with a disc come again in every frame, and
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
    """Update every chain and mode by measurements (Kalman), as :func:`core.compiled.mixture.correct_mixture` says.

    Computed in units of the noise, since pixels and metres differ by orders of magnitude. ``partial`` are the shares of
    :func:`partial_update_shares`; all components are ``tested`` by themselves, or the first so many.
    """
    tested = measured.shape[1] if tested is None else tested
    found = compiled.correct_mixture(mixture, linearised, measured, variance, shared, partial, tested)
    return Update(ModeMixture(*found[:3]), *found[3:])

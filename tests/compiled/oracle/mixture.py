"""Mixtures of Gaussians in NumPy, as the formulas stand in the books."""

from __future__ import annotations

import numpy as np

from carpus.core.tracking.kernel import ModeMixture
from carpus.core.types import FloatArray


def merged(mixture: ModeMixture) -> tuple[FloatArray, FloatArray]:
    """Mean (C, n) and covariance (C, n, n) over the modes."""
    share = mixture.probability[:, None]
    mean = (share @ mixture.mean)[:, 0]
    apart = mixture.mean - mean[:, None]
    chains, n = mean.shape
    covariance = (share @ mixture.covariance.reshape(chains, -1, n * n)).reshape(chains, n, n)
    covariance += np.swapaxes(apart, 1, 2) @ (apart * mixture.probability[..., None])
    return mean, covariance

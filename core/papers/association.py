"""Which blob is which marker, as the papers decide it: eq. (6) to (12) of the wrist paper, (3) to (10) of the other's.

Every blob goes to the marker, or to clutter, of largest posterior (12), whatever the other blobs do. Where several go
to one marker, the one of them that (12) gives most keeps it; the papers leave that to a thesis.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from carpus.core.types import FloatArray


def log_posteriors(
    pixel: FloatArray, predicted_px: FloatArray, covariance_px2: FloatArray, clutter_prior: float, resolution_px2: float
) -> FloatArray:
    """Logarithm of (12), not normalised, for blobs ``pixel`` (D, 2): (D, 1 + M), column 0 clutter.

    ``predicted_px`` (M, 2) and ``covariance_px2`` (M, 2, 2): (10) and (11) of every marker, noise included.
    """
    count = len(predicted_px)
    apart = pixel[:, None] - predicted_px
    root = np.linalg.cholesky(covariance_px2)
    u = apart[..., 0] / root[:, 0, 0]
    v = (apart[..., 1] - root[:, 1, 0] * u) / root[:, 1, 1]
    log_size = np.log(root[:, 0, 0] * root[:, 1, 1])
    out = np.empty((len(pixel), 1 + count))
    out[:, 0] = math.log(clutter_prior) - math.log(resolution_px2)
    out[:, 1:] = math.log((1.0 - clutter_prior) / count) - 0.5 * (u * u + v * v) - math.log(2.0 * math.pi) - log_size
    return out


def blobs_of_markers(posterior: FloatArray) -> NDArray[np.int64]:
    """Blob of every marker (M,), -1 for none, from the logarithms (D, 1 + M) of (12)."""
    taken = np.full(posterior.shape[1] - 1, -1, dtype=np.int64)
    best = np.full(taken.size, -np.inf)
    for blob, choice in enumerate(posterior.argmax(axis=1).tolist()):
        if choice and posterior[blob, choice] > best[choice - 1]:
            best[choice - 1], taken[choice - 1] = posterior[blob, choice], blob
    return taken

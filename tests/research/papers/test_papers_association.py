"""Equation (12) by brute force, with SciPy's normal distribution."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import multivariate_normal

from carpus.core.research.papers.tracker import assign_blobs, log_posteriors

RESOLUTION = 640.0 * 480.0


@given(st.integers(0, 10_000), st.integers(0, 12), st.integers(1, 8), st.floats(0.01, 0.9))
def test_association_takes_largest_posterior_per_blob(seed: int, blobs: int, markers: int, clutter: float) -> None:
    rng = np.random.default_rng(seed)
    predicted = rng.uniform(200, 260, (markers, 2))
    root = rng.normal(size=(markers, 2, 2)) * 4.0
    covariance = root @ np.swapaxes(root, 1, 2) + np.eye(2)
    pixel = rng.uniform(190, 270, (blobs, 2))

    wanted: dict[int, tuple[float, int]] = {}
    for blob in range(blobs):
        density = [multivariate_normal.pdf(pixel[blob] - predicted[j], cov=covariance[j]) for j in range(markers)]
        weight = [clutter / RESOLUTION] + [each * (1.0 - clutter) / markers for each in density]
        choice = int(np.argmax(weight))
        if choice and weight[choice] > wanted.get(choice - 1, (0.0, -1))[0]:
            wanted[choice - 1] = (weight[choice], blob)

    found = log_posteriors(pixel, predicted, covariance, clutter, RESOLUTION)
    assert found.shape == (blobs, 1 + markers)
    assert assign_blobs(found).tolist() == [wanted.get(j, (0.0, -1))[1] for j in range(markers)]

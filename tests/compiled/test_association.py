"""Odds of names, compiled, against NumPy."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.compiled import association as compiled
from carpus.core.tracking.association.association import (
    DEPTH_OUTLIER_PROBABILITY,
    LOG_IMPOSSIBLE,
    log_densities,
)
from carpus.core.tracking.filter.settings import AssociationSettings
from tests.compiled.comparing import LAYOUTS, assert_same
from tests.compiled.oracle import association as oracle
from tests.compiled.test_mixture import covariances

SETTINGS = AssociationSettings()
REST = log_densities(3e5, DEPTH_OUTLIER_PROBABILITY, SETTINGS), SETTINGS.gate_sd**2, LOG_IMPOSSIBLE


def asked(blobs: int) -> tuple[np.ndarray, ...]:
    """Six markers and so many blobs near them, some without a depth, some with another's."""
    rng = np.random.default_rng(4)
    scale = np.array([1.0, 1.0, 0.003])
    covariance = covariances(rng, 6, 3) * scale[:, None] * scale
    expected = rng.normal(size=(6, 3)) * [20.0, 20.0, 0.01] + [320.0, 240.0, 0.7]
    measured = expected[rng.integers(0, 6, blobs)] + rng.normal(size=(blobs, 3)) * 3.0 * scale
    measured[1::4, 2] = np.nan
    measured[2::4, 2] += 0.2
    return expected, covariance, measured, np.broadcast_to([0.04, 0.04, 1e-6], (blobs, 3)).copy()


@pytest.mark.parametrize("blobs", [0, 1, 25])
def test_odds_of_names_are_the_oracles(blobs: int) -> None:
    found = compiled.compute_log_odds(*asked(blobs), *REST)
    assert_same(found, oracle.compute_log_odds(*asked(blobs), *REST))
    assert blobs < 25 or (found[1].any() and not found[1].all())


def test_unknown_marker_or_blob_has_oracles_odds() -> None:
    expected, covariance, measured, variance = asked(25)
    expected[1, 0] = expected[2, 2] = measured[3, 1] = np.nan
    found = compiled.compute_log_odds(expected, covariance, measured, variance, *REST)
    assert np.isnan(found[0][1]).all()
    assert_same(found, oracle.compute_log_odds(expected, covariance, measured, variance, *REST))


def test_arrays_stored_otherwise_give_the_same_and_wrong_sizes_are_refused() -> None:
    of = asked(25)
    for layout in LAYOUTS:
        assert_same(compiled.compute_log_odds(*map(layout, of), *REST), compiled.compute_log_odds(*of, *REST), 0.0)
    for k, wrong in enumerate((of[0][:5], of[1][:, :2], of[2][:, :2], of[3][:9])):
        with pytest.raises(ValueError, match="is read"):
            compiled.compute_log_odds(*of[:k], wrong, *of[k + 1 :], *REST)

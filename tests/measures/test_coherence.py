"""A hidden thumb whose pose holds together, and one whose does not."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carpus.core.measures.coordination import Coherence, digit_coherence
from carpus.core.model.types import FloatArray

NAMES = ("CMC1_extension", "CMC1_abduction", "MCP1_flexion", "MCP1_abduction", "IP1_flexion")
COUNT = 90
TIME_S = np.arange(COUNT) / 30.0
HIDDEN = (TIME_S >= 1.0) & (TIME_S < 2.0)


def moving_angles() -> FloatArray:
    """Angles (N, 5) of a thumb that goes across the palm and back in three seconds."""
    swing = 0.5 - 0.5 * np.cos(2.0 * math.pi * TIME_S / 3.0)
    return np.radians(np.outer(swing, [-20.0, 35.0, 30.0, 2.0, 25.0]) + 5.0)


def compute_coherence(
    angles_rad: FloatArray, sd_deg: float = 4.0, off_m: float = 0.0, hidden: FloatArray = HIDDEN, known: bool = True
) -> Coherence:
    """Of a thumb whose tip goes with its first two angles, and lies so far off while it is hidden."""
    tip_m = np.column_stack((0.1 * angles_rad[:, 0], 0.1 * angles_rad[:, 1], 0.0 * angles_rad[:, 0]))
    tip_m[hidden, 0] += off_m
    sds = np.radians(np.full(angles_rad.shape, sd_deg))
    return digit_coherence(TIME_S, NAMES, angles_rad, sds, tip_m, hidden, np.full(COUNT, known))


def test_coherence_of_a_thumb_that_moves_while_occluded_is_full() -> None:
    found = compute_coherence(moving_angles())
    assert found.occluded_share == pytest.approx(1.0 / 3.0, abs=0.02)
    assert (found.coherent_share, found.known_share) == (1.0, 1.0)
    assert len(found.jumps_m) == 1
    assert found.jumps_m[0] < 0.005
    lost = compute_coherence(moving_angles(), off_m=0.03)
    assert lost.jumps_m[0] == pytest.approx(0.03, abs=0.005), "told when it is seen again"


def test_coherence_without_occlusion_or_tracking_is_unknown() -> None:
    seen = compute_coherence(moving_angles(), hidden=np.zeros(COUNT, dtype=bool))
    assert seen.occluded_share == 0.0
    assert math.isnan(seen.coherent_share)
    assert math.isnan(compute_coherence(moving_angles(), known=False).occluded_share)

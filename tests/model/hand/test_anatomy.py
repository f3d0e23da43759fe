"""The average hand, its frame and its limits."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from carpus.core.model.hand.anatomy import anatomy_from_size
from carpus.core.model.hand.clinical_angles import wrist_axes
from carpus.core.model.hand.protocols import HAND21, PALM_MARKERS


@pytest.mark.parametrize("length_m", [0.130, 0.200])
def test_offsets_grow_with_the_hand(length_m: float) -> None:
    offset_mm = anatomy_from_size(length_m).skin_offset_m * 1e3 * 180.0 / (length_m * 1e3)
    expected = {"WRIST": 15, "CMC1": 10, "MCP1": 9, "IP1": 7, "TIP1": 5, "MCP3": 11, "PIP2": 7.5, "DIP5": 5.5}
    for marker, height in expected.items():
        assert offset_mm[HAND21.markers.index(marker)] == pytest.approx(height)


@pytest.mark.parametrize("arch", [0.0, 2.0])
def test_palm_discs_define_the_wrist_frame_they_are_given_in(arch: float) -> None:
    discs = anatomy_from_size(0.175, arch=arch).palm_disc_m
    assert np.allclose(wrist_axes(discs, np.array([0.0, 0.0, 1.0])), np.eye(3), atol=1e-12)
    assert np.allclose(discs[PALM_MARKERS.index("WRIST")], 0.0)
    assert np.allclose(discs[PALM_MARKERS.index("MCP3"), 1:], 0.0, atol=1e-12)


def test_arrays_are_checked_copied_and_read_only() -> None:
    lengths = np.full((4, 3), 0.02)
    hand = dataclasses.replace(anatomy_from_size(0.18), finger_length_m=lengths)
    lengths[:] = 1.0
    assert hand.finger_length_m[0, 0] == 0.02
    with pytest.raises(ValueError, match="read-only"):
        hand.finger_length_m[0, 0] = 1.0
    with pytest.raises(ValueError, match="finger_length_m"):
        dataclasses.replace(hand, finger_length_m=np.zeros((3, 3)))


def test_nail_discs_shorten_only_the_last_segment() -> None:
    whole, nail = anatomy_from_size(0.18), anatomy_from_size(0.18, nail_discs=True)
    assert np.allclose(nail.finger_length_m / whole.finger_length_m, [[1.0, 1.0, 0.7]] * 4)
    assert np.allclose(nail.thumb_length_m / whole.thumb_length_m, [1.0, 1.0, 0.8])

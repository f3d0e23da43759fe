"""Histograms against OpenCV's own comparison, and against counting by hand."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from carpus.core.detection import appearance as ch
from carpus.core.model.types import ByteImage


def random_hsv(seed: int, hue: tuple[int, int] = (0, 180)) -> ByteImage:
    rng = np.random.default_rng(seed)
    hsv = rng.integers(0, 256, (20, 30, 3))
    hsv[..., 0] = rng.integers(*hue, (20, 30))
    return hsv.astype(np.uint8)


def test_histogram_smoothing_keeps_the_sum_and_wraps_hue() -> None:
    """Red lies at both ends of the hue circle: smoothed, one end reaches the other."""
    hsv = np.full((4, 4, 3), 128, dtype=np.uint8)
    hsv[..., 0] = 179
    found = ch.compute_histogram(hsv, np.ones((4, 4), dtype=bool), smooth_bins=1.2)
    assert found.sum() == pytest.approx(1.0)
    assert found[0].sum() > 0.15
    assert found[0].sum() == pytest.approx(found[-2].sum(), rel=0.01)


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 1000), st.integers(0, 1000))
def test_bhattacharyya_is_opencvs(a: int, b: int) -> None:
    mask = np.ones((20, 30), dtype=bool)
    one, other = ch.compute_histogram(random_hsv(a, (0, 60)), mask), ch.compute_histogram(random_hsv(b, (20, 90)), mask)
    distance = cv2.compareHist(one.astype(np.float32), other.astype(np.float32), cv2.HISTCMP_BHATTACHARYYA)
    assert float(ch.compute_bhattacharyya(one.ravel(), other.ravel())) == pytest.approx(1.0 - distance**2, abs=1e-4)


def test_backprojection_is_a_table_lookup() -> None:
    hsv = random_hsv(2)
    table = np.random.default_rng(3).integers(0, 256, (ch.BINS, ch.BINS)).astype(np.float32)
    found = ch.backproject_histogram(hsv, table)
    at_hue = np.minimum((hsv[..., 0] / (180 / ch.BINS)).astype(int), ch.BINS - 1)
    assert np.array_equal(found, table[at_hue, hsv[..., 1].astype(int) * ch.BINS // 256].astype(np.uint8))


def test_histogram_ignores_brightness() -> None:
    color = np.full((8, 8, 3), (40, 90, 180), dtype=np.uint8)
    mask = np.ones((8, 8), dtype=bool)
    bright, dim = (
        ch.compute_histogram(ch.to_hsv(color), mask, 1.2),
        ch.compute_histogram(ch.to_hsv(color // 2), mask, 1.2),
    )
    assert float(ch.compute_bhattacharyya(bright.ravel(), dim.ravel())) > 0.97

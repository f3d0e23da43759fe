"""Blobs measured in C against NumPy, whose sums are of single precision."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from carpus.core.depth_sensor import D435, PRIMESENSE, DepthSensor
from carpus.core.detection.detector import Detector, Region
from carpus.core.kernels import choice
from carpus.core.types import Detections, Frame
from tests.detection.pictures import CAMERA, PALM_PX, Extra, Look, depth_picture, frame, picture
from tests.detection.test_detector import SETTINGS, learnt
from tests.kernels.pairs import LEVELS


def alike(detector: Detector, seen: Frame, region: Region | None = None) -> Detections:
    with choice.forced(choice.NUMPY):
        expected = detector.detect(seen, region)
    for level in LEVELS:
        with choice.forced(level):
            found = detector.detect(seen, region)
        np.testing.assert_allclose(found.pixel, expected.pixel, rtol=0.0, atol=1e-5)
        np.testing.assert_allclose(found.area_px, expected.area_px, rtol=1e-5)
        np.testing.assert_allclose(found.similarity, expected.similarity, rtol=1e-9)
        np.testing.assert_allclose(found.depth_m, expected.depth_m, rtol=1e-12)
        np.testing.assert_allclose(found.depth_sd_m, expected.depth_sd_m, rtol=1e-9, atol=2e-4)
    return expected


@pytest.mark.parametrize("sensor", [PRIMESENSE, D435], ids=lambda sensor: sensor.name)
def test_discs_in_the_picture_at_its_edge_and_without_depth(sensor: DepthSensor) -> None:
    rng, look = np.random.default_rng(5), Look()
    looks, _ = learnt(look, rng)
    detector = Detector(looks, replace(CAMERA, sensor=sensor), SETTINGS)
    extras = [Extra((3.0, 100.0), 5.0, look.paper), Extra((316.0, 236.0), 5.0, look.paper)]
    seen = frame(picture([*PALM_PX, *[np.array(extra.pixel) for extra in extras]], look, rng), depth_picture(rng))
    assert len(alike(detector, seen)) >= 6
    assert len(alike(detector, seen, Region(0, 0, 320, 240))) >= 6
    assert len(alike(detector, seen, Region(101, 71, 203, 207))) >= 6
    assert np.isnan(alike(detector, replace(seen, depth_raw=None)).depth_m).all()
    assert seen.depth_raw is not None
    holed = seen.depth_raw * (rng.uniform(size=seen.depth_raw.shape) < 0.3)
    alike(detector, replace(seen, depth_raw=holed.astype(np.uint16)))


def test_nothing_in_the_picture() -> None:
    rng = np.random.default_rng(6)
    looks, _ = learnt(Look(), rng)
    dark = frame(np.zeros((240, 320, 3), dtype=np.uint8), depth_picture(rng))
    assert len(alike(Detector(looks, CAMERA, SETTINGS), dark, Region(10, 10, 200, 200))) == 0

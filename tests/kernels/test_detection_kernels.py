"""Blobs measured in C against NumPy, whose sums are of single precision."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from carpus.core.depth_sensor import D435, PRIMESENSE, DepthSensor
from carpus.core.detection.detector import Detector, Region
from carpus.core.detection.surface_samples import SamplingSettings, surface_samples
from carpus.core.kernels import choice
from carpus.core.types import Detections, Frame
from tests.detection.pictures import CAMERA, DISTANCE_M, PALM_PX, Extra, Look, depth_picture, frame, picture
from tests.detection.test_detector import SETTINGS, learnt
from tests.kernels.pairs import LEVELS, both


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


def test_a_reading_far_from_a_discs_others_is_no_part_of_its_depth() -> None:
    rng, look = np.random.default_rng(5), Look()
    looks, _ = learnt(look, rng)
    seen = frame(picture(PALM_PX, look, rng), depth_picture())
    assert seen.depth_raw is not None
    for u, v in np.rint(PALM_PX).astype(int):
        seen.depth_raw[v + 1, u] += 2000  # not the middle, where the disc's size is looked up
    found = alike(Detector(looks, CAMERA, SETTINGS), seen)
    assert len(found) == len(PALM_PX)
    np.testing.assert_allclose(found.depth_m, DISTANCE_M, rtol=1e-9)


def test_nothing_in_the_picture() -> None:
    rng = np.random.default_rng(6)
    looks, _ = learnt(Look(), rng)
    dark = frame(np.zeros((240, 320, 3), dtype=np.uint8), depth_picture(rng))
    assert len(alike(Detector(looks, CAMERA, SETTINGS), dark, Region(10, 10, 200, 200))) == 0


def test_readings_on_the_back_of_the_hand() -> None:
    rng = np.random.default_rng(7)
    raw = (3500 * (rng.uniform(size=(240, 320)) < 0.8)).astype(np.uint16)
    raw += (raw > 0).astype(np.uint16) * rng.integers(0, 50, raw.shape, dtype=np.uint16)
    seen = frame(np.zeros((240, 320, 3), dtype=np.uint8), raw)
    corners = np.array([[160.3, 190.2], [128.6, 172.8], [124.1, 100.7], [146.8, 92.4]])
    for shift_px in (0.0, -135.5, 140.0, 1e4, -1e4):
        for most in (3, 40, 5000):
            own = replace(SamplingSettings(), most=most)
            found = both(lambda shift_px=shift_px, own=own: surface_samples(seen, corners + shift_px, own), 1e-15)
            assert (found is None) == (abs(shift_px) > 1e3)
    assert both(lambda: surface_samples(seen, np.full((4, 2), np.nan), SamplingSettings())) is None
    empty = replace(seen, depth_raw=np.zeros((240, 320), dtype=np.uint16))
    assert not len(both(lambda: surface_samples(empty, corners, SamplingSettings())).depth_m)


@pytest.mark.parametrize("level", LEVELS)
def test_a_depth_picture_of_another_size_is_refused(level: str) -> None:
    """Its readings lie elsewhere: as many pixels on or beyond its end they would be another place's, or nobody's."""
    rng, look = np.random.default_rng(5), Look()
    looks, _ = learnt(look, rng)
    seen = frame(picture(PALM_PX, look, rng), depth_picture(rng))
    assert seen.depth_raw is not None
    wider = replace(seen, depth_raw=np.pad(seen.depth_raw, ((0, 0), (0, 16))))
    with choice.forced(level), pytest.raises(ValueError):
        Detector(looks, CAMERA, SETTINGS).detect(wider)

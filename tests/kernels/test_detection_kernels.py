"""Blobs measured in C against NumPy, whose sums are of single precision."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

from carpus.core.depth_sensor import D435, PRIMESENSE, DepthSensor
from carpus.core.detection import surface_samples as samples
from carpus.core.detection.detector import Detector
from carpus.core.detection.surface_samples import finger_samples, surface_samples
from carpus.core.kernels import choice
from carpus.core.types import Detections, Frame, Region
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


@pytest.mark.parametrize("level", LEVELS)
def test_every_colour_looks_as_to_opencv(level: str) -> None:
    """Hue and saturation of all 16 777 216 colours, bit for bit, and which are as bright as asked for."""
    lit = np.ones(1 << 16, dtype=np.uint8)
    with choice.forced(level) as kernels:
        assert kernels is not None
        for first in range(0, 256, 16):
            number = np.arange(first << 16, (first + 16) << 16).reshape(1024, 1024)
            color = np.stack((number >> 16, number >> 8 & 255, number & 255), axis=-1).astype(np.uint8)
            labels, look = np.empty(number.shape, dtype=np.int32), np.empty(number.shape, dtype=np.uint16)
            kernels.blobs_found(
                1024, 1024, color, choice.NOTHING, False, 1.0, 0, 0, 1024, 1024, lit, 99, 1.0, 1.0, 0.2, 1e9, 1.0, 0.5,
                6, 4, 0.0, 0.0, 1, labels, look, np.empty(1, np.int32), np.empty((1, 2)), np.empty(1),
                np.empty(1, np.int32),
            )  # fmt: skip
            hsv = cv2.cvtColor(color, cv2.COLOR_RGB2HSV)
            np.testing.assert_array_equal(look, hsv[..., 0] | hsv[..., 1].astype(np.uint16) << 8)
            bright = cv2.morphologyEx((hsv[..., 2] > 99).astype(np.uint8), cv2.MORPH_OPEN, CROSS)
            np.testing.assert_array_equal(labels > 0, bright > 0)


CROSS = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))


@pytest.mark.parametrize("shapes", ["specks", "discs", "bars"])
def test_blobs_of_any_shape_come_in_the_same_order_and_apart_alike(shapes: str) -> None:
    """Everything is kept, however large or unlike a disc: spirals of specks that join late, discs on and beside each
    other, mirrored to the pixel, so that some pixels lie just between two parts."""
    rng, look = np.random.default_rng(8), Look(noise=0.0)
    looks, _ = learnt(look, rng)
    settings = replace(SETTINGS, least_area=0.0, most_area=1e9, skin_share=0.0, most_blobs=2000)
    detector = Detector(replace(looks, least_similarity=0.0), CAMERA, settings)
    seen = frame(np.full((240, 320, 3), look.skin, dtype=np.uint8), np.full((240, 320), 3500, dtype=np.uint16))
    found = 0
    for density in (0.05, 0.35, 0.5):
        mask = np.zeros((240, 320), dtype=np.uint8)
        if shapes == "specks":
            mask = (rng.uniform(size=mask.shape) < density).astype(np.uint8)
            mask = cv2.dilate(mask, CROSS) if density < 0.3 else mask
        for _ in range(0 if shapes == "specks" else int(160 * density)):
            u, v, radius = rng.integers(0, 320), rng.integers(0, 240), rng.integers(3, 7)
            for _ in range(rng.integers(1, 5)):
                if shapes == "discs":
                    cv2.circle(mask, (int(u), int(v)), int(radius), 1, -1)
                else:
                    cv2.rectangle(mask, (int(u), int(v)), (int(u + 2 * radius), int(v + radius)), 1, -1)
                u, v = u + rng.integers(-8, 9), v + rng.integers(-8, 9)
        seen.color_rgb[:] = np.where(mask[..., None] > 0, look.paper, look.skin)
        for region in (Region(0, 0, 320, 240), Region(31, 17, 300, 222)):
            found += len(alike(detector, seen, region))
        few = Detector(replace(looks, least_similarity=0.0), CAMERA, replace(settings, most_blobs=5))
        assert len(alike(few, seen, Region(0, 0, 320, 240))) == 5
    assert found > 100


@pytest.mark.parametrize("level", LEVELS)
def test_a_region_outside_the_picture_is_refused(level: str) -> None:
    rng, look = np.random.default_rng(5), Look()
    detector = Detector(learnt(look, rng)[0], CAMERA, SETTINGS)
    seen = frame(picture(PALM_PX, look, rng), depth_picture(rng))
    with choice.forced(level) as kernels:
        assert kernels is not None
        for region in (Region(-1, 0, 90, 90), Region(0, 200, 90, 241), Region(300, 0, 321, 90)):
            with pytest.raises(ValueError, match="outside"):
                detector._detected(kernels, seen, region)


def test_nothing_in_the_picture() -> None:
    rng = np.random.default_rng(6)
    looks, _ = learnt(Look(), rng)
    dark = frame(np.zeros((240, 320, 3), dtype=np.uint8), depth_picture(rng))
    assert len(alike(Detector(looks, CAMERA, SETTINGS), dark, Region(10, 10, 200, 200))) == 0


def test_readings_on_the_back_of_the_hand(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(7)
    raw = (3500 * (rng.uniform(size=(240, 320)) < 0.8)).astype(np.uint16)
    raw += (raw > 0).astype(np.uint16) * rng.integers(0, 50, raw.shape, dtype=np.uint16)
    seen = frame(np.zeros((240, 320, 3), dtype=np.uint8), raw)
    corners = np.array([[160.3, 190.2], [128.6, 172.8], [124.1, 100.7], [146.8, 92.4]])
    for shift_px in (0.0, -135.5, 140.0, 1e4, -1e4):
        for most in (3, 40, 5000):
            monkeypatch.setattr(samples, "MAX_READINGS", most)
            found = both(lambda shift_px=shift_px: surface_samples(seen, corners + shift_px), 1e-15)
            assert (found is None) == (abs(shift_px) > 1e3)
    assert both(lambda: surface_samples(seen, np.full((4, 2), np.nan))) is None
    empty = replace(seen, depth_raw=np.zeros((240, 320), dtype=np.uint16))
    assert not len(both(lambda: surface_samples(empty, corners)).depth_m)


def test_readings_about_the_fingers(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(8)
    raw = rng.integers(600, 700, (240, 320)) * (rng.uniform(size=(240, 320)) < 0.9)
    seen = Frame(0, 0.0, np.zeros((240, 320, 3), np.uint8), raw.astype(np.uint16), 1e-3)
    discs = np.column_stack((rng.uniform(120.0, 220.0, 15), rng.uniform(80.0, 190.0, 15)))
    for shift_px in (0.0, -90.25, 130.0, 1e12, -1e4):
        for most in (1, 40, 5000):
            monkeypatch.setattr(samples, "MAX_FINGER_READINGS", most)
            found = both(lambda shift_px=shift_px: finger_samples(seen, discs + shift_px), 1e-15)
            assert (found is None) == (abs(shift_px) > 1e3)
    alike = np.full((4, 2), 160.0)  # as far from a disc as others
    monkeypatch.setattr(samples, "MAX_FINGER_READINGS", 10)
    both(lambda: finger_samples(seen, alike), 1e-15)
    empty = replace(seen, depth_raw=np.zeros((240, 320), dtype=np.uint16))
    assert both(lambda: finger_samples(empty, discs)) is None


def test_where_expected_discs_may_lie() -> None:
    rng = np.random.default_rng(17)
    detector = Detector(learnt(Look(), rng)[0], CAMERA, SETTINGS)
    for discs in (1, 6, 21):
        pixel, depth = rng.uniform(20.0, 220.0, size=(discs, 2)), rng.uniform(0.1, 1.0, size=discs)
        covariance = np.abs(rng.normal(size=(discs, 3, 3))) * 10.0 ** rng.uniform(-1.0, 5.0, size=(discs, 1, 1))
        both(lambda p=pixel, c=covariance, d=depth: detector.region_about(p, c[:, :2, :2], d))
    pixel[-1, 0] = np.nan
    for how in (choice.NUMPY, *LEVELS):
        with choice.forced(how), pytest.raises(ValueError):
            detector.region_about(pixel, covariance[:, :2, :2], depth)


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

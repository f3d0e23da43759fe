"""Discs in small pictures: found all, found nothing else, to a tenth of a pixel, whatever the colour; depth, too."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from carpus.core.detection import appearance as ch
from carpus.core.detection import surface_samples as surface_samples_module
from carpus.core.detection.appearance import (
    DetectionSettings,
    MarkerAppearance,
    build_paper_mask,
    classify_paper_colors,
    learn_appearance,
    to_hsv,
)
from carpus.core.detection.blobs import find_components
from carpus.core.detection.detector import MAX_SEARCH_RADIUS_PX, Detector
from carpus.core.detection.surface_samples import SURFACE_SAMPLE_STEP_PX, sample_fingers, sample_surface
from carpus.core.model.camera import Camera
from carpus.core.model.types import FINGER_SAMPLE_STEP_PX, ByteImage, Detections, FloatArray, Frame, Region
from tests.detection.pictures import (
    CAMERA,
    DARK_SKIN,
    DISTANCE_M,
    PALM_PX,
    PAPERS,
    RADIUS_PX,
    SKIN,
    Extra,
    Look,
    depth_picture,
    frame,
    match_blobs,
    picture,
)

SETTINGS = DetectionSettings()
BLUE = Look()


WHOLE = Region(0, 0, 320, 240)


def learn(look: Look, rng: np.random.Generator, click_error_px: float = 2.0) -> tuple[MarkerAppearance, FloatArray]:
    clicks = PALM_PX + rng.uniform(-click_error_px, click_error_px, PALM_PX.shape)
    return learn_appearance(frame(picture(PALM_PX, look, rng), depth_picture(rng)), clicks, CAMERA, SETTINGS)


@cache
def build_detector(look: Look = BLUE) -> Detector:
    """Taught once for all tests: it keeps no memory of what it sees, which one of them shows."""
    return Detector(learn(look, np.random.default_rng(1))[0], CAMERA, SETTINGS)


def seen(seed: int, discs_px: FloatArray = PALM_PX, look: Look = BLUE, **how: Any) -> Frame:
    """A picture with its depth, as a camera has them."""
    rng = np.random.default_rng(seed)
    return frame(picture(discs_px, look, rng, **how), depth_picture(rng))


def all_found(found: Detections, true_px: FloatArray, within_px: float = 0.5) -> bool:
    return len(found) == len(true_px) and bool(np.abs(match_blobs(found.pixel, true_px)).max() < within_px)


@pytest.mark.parametrize("paper", PAPERS)
def test_detector_centres_are_accurate_to_a_tenth_of_a_pixel(paper: str) -> None:
    """Any paper, any skin, dim and bright, with colour halved across as the camera does."""
    rng, is_dim = np.random.default_rng(1), paper in ("blue", "red", "yellow")
    look = Look(PAPERS[paper], DARK_SKIN if is_dim else SKIN, light=0.4 if is_dim else 1.25)
    detector = Detector(learn(look, rng)[0], CAMERA, SETTINGS)
    errors = []
    for _ in range(4):
        true = PALM_PX + rng.uniform(-3.0, 3.0, PALM_PX.shape)
        found = detector.detect(frame(picture(true, look, rng), depth_picture(rng)))
        assert all_found(found, true)
        errors.append(match_blobs(found.pixel, true))
    assert np.sqrt(np.mean(np.square(errors), axis=(0, 1))).max() < 0.1


def test_detector_shading_does_not_shift_centres() -> None:
    """Half the light gone across the hand; without noise, so that only the pull is left."""
    look = Look(shading=0.5, noise=0.0, chroma=False)
    detector = build_detector(look)
    errors = []
    for shift in np.linspace(0.0, 0.9, 10):
        true = PALM_PX + [shift, 0.37 + 0.5 * shift]
        found = detector.detect(frame(picture(true, look), depth_picture()))
        errors.append(match_blobs(found.pixel, true))
    assert np.abs(np.mean(errors, axis=(0, 1))).max() < 0.03
    assert np.sqrt(np.mean(np.square(errors), axis=(0, 1))).max() < 0.05


def test_detector_without_depth_gives_nan_depths() -> None:
    found = build_detector().detect(replace(seen(17, look=Look(light=0.5)), depth_raw=None))
    assert all_found(found, PALM_PX), "in other light than was learnt, too"
    assert np.isnan(found.depth_m).all()
    assert np.isnan(found.depth_sd_m).all()


@pytest.mark.parametrize(("gap_px", "direction_deg"), [(-0.5, 35.0), (-0.5, 90.0), (0.8, 0.0)])
def test_detector_touching_discs_are_separated(gap_px: float, direction_deg: float) -> None:
    away = (2.0 * RADIUS_PX + gap_px) * np.array([np.cos(np.radians(direction_deg)), np.sin(np.radians(direction_deg))])
    true = PALM_PX.copy()
    true[1] = [150.2, 145.6]
    true[0] = true[1] + away
    found = build_detector().detect(seen(5, true))
    assert len(found) == 6
    error = match_blobs(found.pixel, true)
    assert np.linalg.norm(error[:2], axis=1).max() < 0.6
    assert np.linalg.norm(error[2:], axis=1).max() < 0.3


NO_MARKERS = {
    "a sleeve at the wrist": ("blue", [((156.0, 232.0), 28.0, "blue")]),
    "a bag on the table": ("blue", [((250.0, 120.0), 28.0, "blue")]),
    "specks": ("blue", [((120.0, 140.0), 1.0, "blue"), ((140.0, 140.0), 1.0, "blue"), ((200.0, 140.0), 1.0, "blue")]),
    "discs on the table": ("blue", [((30.0, 60.0), RADIUS_PX, "blue"), ((290.0, 200.0), RADIUS_PX, "blue")]),
    "a green disc": ("blue", [((150.0, 140.0), RADIUS_PX, "green")]),
    "blue ones where green were clicked": (
        "green", [((150.0, 140.0), RADIUS_PX, "blue"), ((190.0, 150.0), RADIUS_PX, "blue")],
    ),
}  # fmt: skip
"""The paper of the discs, and what else is in the picture."""


@pytest.mark.parametrize("case", NO_MARKERS)
def test_detector_other_objects_are_no_markers(case: str) -> None:
    paper, others = NO_MARKERS[case]
    look = Look(paper=PAPERS[paper])
    extras = [Extra(pixel, radius_px, PAPERS[color]) for pixel, radius_px, color in others]
    shown = seen(7, look=look, extras=extras)
    for region in (None, WHOLE):
        assert all_found(build_detector(look).detect(shown, region), PALM_PX)


def test_detector_searches_the_region_only() -> None:
    detector, shown = build_detector(), seen(12)
    upper = Region(100, 80, 215, 130)
    found = detector.detect(shown, upper)
    assert all_found(found, PALM_PX[2:])
    whole = detector.detect(shown)
    same = match_blobs(found.pixel, whole.pixel[whole.pixel[:, 1] < 130.0])
    assert np.abs(same).max() < 0.05, "pixels are told in the whole picture"
    assert len(detector.detect(shown, Region(0, 0, 4, 240))) == 0
    assert len(detector.detect(shown, Region(-50, -50, 1000, 1000))) == 6


def test_search_region_holds_every_disc_and_little_more() -> None:
    detector = build_detector()
    covariance = np.broadcast_to(4.0 * np.eye(2), (6, 2, 2))
    region = detector.compute_search_region(PALM_PX, covariance, np.full(6, DISTANCE_M))
    low, high = PALM_PX.min(axis=0), PALM_PX.max(axis=0)
    for side, room in ((low - [region.left, region.top], "low"), ([region.right, region.bottom] - high, "high")):
        assert (side > 2.0 * 3.0 + RADIUS_PX).all(), room
        assert (side < 40.0).all(), room
    wider = detector.compute_search_region(PALM_PX, 16.0 * covariance, np.full(6, DISTANCE_M))
    assert wider.left < region.left
    assert wider.bottom > region.bottom
    disc_px = CAMERA.fx_px * SETTINGS.marker_radius_m / DISTANCE_M
    lost = detector.compute_search_region(np.array([[160.0, 120.0]]), 1e8 * np.eye(2)[None], np.array([DISTANCE_M]))
    assert lost.right - lost.left == pytest.approx(2.0 * (MAX_SEARCH_RADIUS_PX + 2.2 * disc_px + 3.0), abs=2.5)


def test_detector_depth_of_another_size_is_an_error() -> None:
    """Its readings lie elsewhere: as many pixels on they would be another place's."""
    shown = seen(4)
    assert shown.depth_raw is not None
    for raw in (np.pad(shown.depth_raw, ((0, 0), (0, 16))), shown.depth_raw[:-1]):
        with pytest.raises(ValueError, match="not of the size"):
            build_detector().detect(replace(shown, depth_raw=raw))


def test_detector_too_many_blobs_keeps_the_largest() -> None:
    detector = Detector(build_detector()._appearance, CAMERA, replace(SETTINGS, max_blobs=4))
    extras = [Extra((float(u), float(v)), 3.2, PAPERS["blue"]) for u, v in ((140, 140), (160, 140), (180, 140))]
    found = detector.detect(seen(5, extras=extras), WHOLE)
    assert len(found) == 4
    assert found.area_px.min() > 45.0


def test_paper_mask_is_opencvs_backprojection() -> None:
    looks, hsv = build_detector()._appearance, to_hsv(seen(6).color_rgb)
    likely = cv2.calcBackProject([hsv], [0, 1], looks.paper_lookup, [0.0, 180.0, 0.0, 256.0], 1.0)
    expected = ((likely > 127.5) & (hsv[..., 2] > looks.min_brightness)).astype(np.uint8)
    expected = cv2.morphologyEx(expected, cv2.MORPH_OPEN, cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3)))
    assert expected.any()
    np.testing.assert_array_equal(
        build_paper_mask(hsv, classify_paper_colors(looks), looks.min_brightness), 255 * expected
    )


def separate_blobs(is_blob: NDArray[np.bool_], radius_px: float) -> FloatArray:
    """Centres (P, 2) of the discs that are found of one blob."""
    return find_components(is_blob.astype(np.uint8), lambda at: np.full(len(at), radius_px)).centre_px


@pytest.mark.parametrize(
    ("apart_radii", "bar_radii", "parts"), [(0.7, 0.0, 1), (1.3, 0.0, 2), (0.0, 2.65, 1), (0.0, 3.0, 2)]
)
def test_detector_long_blob_is_separated(apart_radii: float, bar_radii: float, parts: int) -> None:
    """Two discs over each other by their scatter, a bar by its length: beyond 2.8 radii it is more than one disc."""
    radius_px = 20.0
    v, u = np.mgrid[:120, :160]
    if bar_radii:
        is_blob = (np.abs(u - 70) <= 0.5 * bar_radii * radius_px) & (np.abs(v - 60) <= 3)
    else:
        is_blob = np.hypot(u - 60, v - 60) <= radius_px
        is_blob |= np.hypot(u - 60 - apart_radii * radius_px, v - 60) <= radius_px
    assert len(separate_blobs(is_blob, radius_px)) == parts


def test_detector_empty_image_gives_no_blobs() -> None:
    depth = depth_picture(np.random.default_rng(14))
    assert len(build_detector().detect(seen(14, np.empty((0, 2))))) == 0
    assert len(build_detector().detect(frame(np.zeros((240, 320, 3), dtype=np.uint8), depth))) == 0
    assert len(build_detector().detect(frame(np.full((240, 320, 3), 255, dtype=np.uint8), None))) == 0


def test_detector_scales_with_resolution_and_distance() -> None:
    """Discs wider than the sensor's own window, as in 1280 x 1024 pictures or with a hand nearer than 0.34 m."""
    times, size = 3, (CAMERA.width_px * 3, CAMERA.height_px * 3)
    camera = Camera(525.0 * times, 525.0 * times, 159.5 * times, 119.5 * times, *size)
    small = frame(picture(PALM_PX, BLUE, np.random.default_rng(21)), depth_picture())
    assert small.depth_raw is not None
    color = cv2.resize(small.color_rgb, size, interpolation=cv2.INTER_LINEAR)
    depth = cv2.resize(small.depth_raw, size, interpolation=cv2.INTER_NEAREST)
    large = replace(small, color_rgb=np.asarray(color, dtype=np.uint8), depth_raw=np.asarray(depth, dtype=np.uint16))
    true = (PALM_PX + 0.5) * times - 0.5
    looks, _ = learn_appearance(large, true, camera, SETTINGS)
    found = Detector(looks, camera, SETTINGS).detect(large)
    assert all_found(found, true, within_px=0.3 * times)
    assert np.abs(found.depth_m - DISTANCE_M).max() < 0.002


def test_detector_small_discs_are_found_when_clicked() -> None:
    """A child's 8 mm discs: what a disc measures is learnt, too."""
    radius = RADIUS_PX * 8.0 / 12.0
    looks, _ = learn_appearance(seen(19, radius_px=radius), PALM_PX + 0.5, CAMERA, SETTINGS)
    found = Detector(looks, CAMERA, SETTINGS).detect(seen(20, PALM_PX + 0.3, radius_px=radius))
    assert all_found(found, PALM_PX + 0.3, within_px=0.3)


@pytest.mark.parametrize("click_error_px", [0.0, 3.5])
def test_learn_appearance_tolerates_clicks_beside_discs(click_error_px: float) -> None:
    rng = np.random.default_rng(20)
    angle = rng.uniform(0.0, 2.0 * np.pi, 6)
    clicks = PALM_PX + click_error_px * np.stack((np.cos(angle), np.sin(angle)), axis=1)
    first = seen(20)
    looks, centres = learn_appearance(first, clicks, CAMERA, SETTINGS)
    assert np.linalg.norm(centres - PALM_PX, axis=1).max() < 0.6
    assert all_found(Detector(looks, CAMERA, SETTINGS).detect(first), PALM_PX)


def test_detection_settings_skin_share_limits_blobs() -> None:
    """With no skin asked for, the disc on the table counts; the rule is the setting's, not hidden."""
    looks, _ = learn(BLUE, np.random.default_rng(23))
    on_table = seen(23, extras=[Extra((30.0, 60.0), RADIUS_PX, PAPERS["blue"])])
    assert len(Detector(looks, CAMERA, replace(SETTINGS, min_skin_share=0.0)).detect(on_table, WHOLE)) == 7


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


FULL = Frame(0, 0.0, np.zeros((480, 640, 3), np.uint8), np.full((480, 640), 700, np.uint16), 1e-3)


@pytest.mark.parametrize("shift_px", [0.0, 0.7])
def test_surface_lattice_is_fixed_in_the_image(shift_px: float) -> None:
    corners = np.array([[300.0, 200.0], [340.0, 205.0], [345.0, 260.0], [298.0, 255.0]]) + shift_px
    found = sample_surface(FULL, corners)
    assert found is not None
    assert not np.any(found.pixel % SURFACE_SAMPLE_STEP_PX)


def test_finger_samples_too_many_keeps_the_nearest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    discs = np.array([[300.0, 200.0], [360.0, 210.0]])
    every = sample_fingers(FULL, discs)
    monkeypatch.setattr(surface_samples_module, "MAX_FINGER_READINGS", 20)
    some = sample_fingers(FULL, discs)
    assert every is not None
    assert some is not None
    assert not np.any(every.pixel % FINGER_SAMPLE_STEP_PX)
    assert len(every.pixel) > 40
    assert len(some.pixel) == 20

    def away_px(pixel: np.ndarray) -> np.ndarray:
        return np.asarray(np.abs(pixel[:, None] - discs).sum(axis=-1).min(axis=1))

    assert away_px(some.pixel).max() <= np.sort(away_px(every.pixel))[19]

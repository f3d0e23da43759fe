"""Blobs found and measured, compiled, against NumPy and OpenCV."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from carpus.core.compiled import blobs as compiled
from carpus.core.compiled.blobs import BlobWindows
from carpus.core.detection.components import Components, find_components
from carpus.core.detection.detector import ColorTable
from carpus.core.detection.stencil import Stencil, get_stencil
from carpus.core.model.depth_sensor import AZURE_KINECT, D435, PRIMESENSE, DepthSensor
from carpus.core.model.types import ByteImage, DepthImage
from tests.compiled.comparing import LAYOUTS, assert_same
from tests.compiled.oracle import blobs as oracle

RADIUS_PX = 4.5
CROSS = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))
UNIT_M = 2e-4


def mask_of(shapes: str, density: float, rng: np.random.Generator) -> ByteImage:
    """Spirals of specks that join late, discs on and beside each other, bars mirrored to the pixel."""
    mask = np.zeros((150, 200), dtype=np.uint8)
    if shapes == "specks":
        mask = (rng.uniform(size=mask.shape) < density).astype(np.uint8)
        return np.asarray(cv2.dilate(mask, CROSS) if density < 0.3 else mask)
    for _ in range(int(100 * density)):
        u, v, radius = rng.integers(0, 200), rng.integers(0, 150), rng.integers(3, 7)
        for _ in range(rng.integers(1, 5)):
            if shapes == "discs":
                cv2.circle(mask, (int(u), int(v)), int(radius), 1, -1)
            else:
                cv2.rectangle(mask, (int(u), int(v)), (int(u + 2 * radius), int(v + radius)), 1, -1)
            u, v = u + rng.integers(-8, 9), v + rng.integers(-8, 9)
    return mask


def radius_at(place: np.ndarray) -> np.ndarray:
    """Larger to the right."""
    return np.asarray(RADIUS_PX * (0.7 + 0.003 * place[:, 0]))


def found_alike(mask: ByteImage, min_share: float = 0.0, max_share: float = np.inf) -> Components:
    """The blobs of a mask, after the oracle's were found to be the same to the last bit, pixel by pixel."""
    found = compiled.find_blobs(mask, radius_at, min_share, max_share)
    for one, other in zip(found, oracle.find_blobs(mask, radius_at, min_share, max_share), strict=True):
        assert one.dtype == other.dtype
        np.testing.assert_array_equal(one, other)
    return Components(*found)


@pytest.mark.parametrize("density", [0.05, 0.35, 0.5])
@pytest.mark.parametrize("shapes", ["specks", "discs", "bars"])
def test_blobs_of_any_shape_come_in_the_same_order_and_apart_alike(shapes: str, density: float) -> None:
    mask = mask_of(shapes, density, np.random.default_rng(8))
    found = found_alike(mask)
    assert found.labels.max() == found.label.size
    assert 0 < found_alike(mask, 0.9, 1.4).label.size < found.label.size


@given(st.integers(0, 10**6), st.integers(1, 40), st.integers(1, 40))
def test_blobs_of_small_pictures_are_the_oracles(seed: int, height: int, width: int) -> None:
    rng = np.random.default_rng(seed)
    found_alike((rng.uniform(size=(height, width)) < rng.uniform()).astype(np.uint8))


def test_whole_blobs_are_those_of_opencv() -> None:
    mask = mask_of("discs", 0.5, np.random.default_rng(9))
    _, labels, stats, middle = cv2.connectedComponentsWithStats(mask, connectivity=8)
    found = find_components(mask, lambda place: np.full(len(place), 1e3))
    row, column = np.nonzero(mask)
    same = labels[row, column] - 1
    of = found.labels[row, column] - 1
    assert len(stats) - 1 == found.label.size == np.unique(of).size
    np.testing.assert_array_equal(found.area_px[of], stats[1:, cv2.CC_STAT_AREA][same])
    np.testing.assert_array_equal(found.centre_px[of], middle[1:][same])


def test_blobs_beyond_16_bit_count_are_found() -> None:
    mask = np.zeros((600, 1000), dtype=np.uint8)
    mask[::2, ::2] = 1
    assert find_components(mask, radius_at).label.size == 150_000


def test_frame_of_nothing_has_no_blobs() -> None:
    assert found_alike(np.zeros((20, 30), dtype=np.uint8)).label.size == 0


def test_marker_of_no_size_takes_nothing_apart() -> None:
    mask = mask_of("discs", 0.5, np.random.default_rng(9))
    for radius_px in (0.0, -1.0, np.nan):
        assert not find_components(mask, lambda place, r=radius_px: np.full(len(place), r), 0.1, 2.0).label.size


@pytest.mark.parametrize("layout", LAYOUTS)
def test_masks_stored_otherwise_have_the_same_blobs(layout: Callable[[Any], Any]) -> None:
    mask = mask_of("bars", 0.35, np.random.default_rng(9))
    found = compiled.find_blobs(layout(mask), radius_at, 0.0, 9.0)
    assert_same(found, oracle.find_blobs(mask, radius_at, 0.0, 9.0))


def test_masks_and_radii_that_do_not_fit_are_refused() -> None:
    mask = np.ones((20, 30), dtype=np.uint8)
    for wrong in (mask.astype(np.int64), mask[0]):
        with pytest.raises(ValueError, match=r"dtype|dimensions"):
            compiled.find_blobs(wrong, radius_at, 0.0, 1.0)
    with pytest.raises(ValueError, match="broadcast"):
        compiled.find_blobs(mask, lambda _: np.ones(3), 0.0, 1.0)


def test_mask_of_paper_is_the_oracles_and_wrong_sizes_are_refused() -> None:
    rng = np.random.default_rng(3)
    hsv = rng.integers(0, 256, (40, 50, 3)).astype(np.uint8)
    is_paper = (255 * rng.integers(0, 2, 1 << 16)).astype(np.uint8)
    for darkest in (0.0, 99.5, 255.0, np.nan):
        assert_same(compiled.mask_paper(hsv, is_paper, darkest), oracle.mask_paper(hsv, is_paper, darkest))
    for picture, table in ((hsv[..., :2].copy(), is_paper), (hsv, is_paper[:-1]), (hsv.astype(float), is_paper)):
        with pytest.raises(ValueError, match=r"channels|dtype"):
            compiled.mask_paper(picture, table, 0.0)


class Scene:
    """A picture with discs: at the border, beside each other, at an edge of the hand; with noise and holes in depth."""

    def __init__(self, seed: int = 5) -> None:
        rng = np.random.default_rng(seed)
        v, u = np.mgrid[:120, :160]
        place = np.array(
            [[30.2, 40.7], [80.0, 60.4], [89.0, 62.0], [2.0, 100.0], [157.0, 3.0], [120.3, 90.8], [60, 20]]
        )
        away = np.hypot(u[..., None] - place[:, 0], v[..., None] - place[:, 1]).min(axis=-1)
        share = np.clip(RADIUS_PX + 0.5 - away, 0.0, 1.0)[..., None]
        ground = np.where((u < 100)[..., None], (205, 155, 130), (95, 92, 88))
        noise = rng.normal(0.0, 4.0, (120, 160, 3))
        color = np.clip(ground + share * (np.array((35, 80, 165)) - ground) + noise, 0, 255)
        self.color: ByteImage = color.astype(np.uint8)
        self.hsv: ByteImage = np.asarray(cv2.cvtColor(self.color, cv2.COLOR_RGB2HSV))
        raw = 3500 + np.rint(8.0 * rng.normal(size=u.shape)) + 250.0 * (u > 125) + 12.0 * (u - 60) * (v < 35)
        raw[(rng.uniform(size=u.shape) < 0.2) | ((u > 84) & (u < 95))] = 0
        self.raw: DepthImage = raw.astype(np.uint16)
        self.blobs = find_components((share[..., 0] > 0.5).astype(np.uint8), radius_at)
        self.stencil = get_stencil(RADIUS_PX)
        self.table = ColorTable(
            rng.integers(0, 256, 1 << 16).astype(np.uint8),
            rng.uniform(size=1 << 16) < 0.5,
            np.sqrt(rng.dirichlet(np.ones(256))),
        )

    def measured(self, sensor: DepthSensor, layout: Callable[[Any], Any] = lambda array: array) -> Any:
        """All that is measured, compiled."""
        seen = BlobWindows(replace(self.blobs, labels=layout(self.blobs.labels)), self.stencil)
        return (
            *seen.compare_colors(layout(self.hsv), self.table),
            *seen.locate_centres(layout(self.color)),
            *seen.read_depths(layout(self.raw), UNIT_M, sensor),
        )

    def expected(self, sensor: DepthSensor) -> Any:
        """The oracle's."""
        return (
            *oracle.compare_colors(self.hsv, self.blobs, self.stencil, self.table),
            *oracle.locate_centres(self.color, self.blobs, self.stencil),
            *oracle.read_depths(self.raw, UNIT_M, self.blobs, self.stencil, sensor),
        )


@pytest.mark.parametrize("sensor", [PRIMESENSE, D435, AZURE_KINECT], ids=lambda sensor: sensor.name)
def test_measured_blobs_are_the_oracles(sensor: DepthSensor) -> None:
    scene = Scene()
    assert_same(scene.measured(sensor), scene.expected(sensor))
    known = np.isfinite(scene.measured(sensor)[4])
    assert known.any()
    assert not known.all()
    assert scene.blobs.label.size > 6


@pytest.mark.parametrize("radius_px", [1.0, 9.3, 40.0])
def test_windows_of_any_size_measure_as_the_oracles(radius_px: float) -> None:
    """The largest is wider than the picture."""
    scene = Scene()
    scene.stencil = get_stencil(radius_px, 2)
    assert_same(scene.measured(D435), scene.expected(D435))


@pytest.mark.parametrize("shapes", ["specks", "bars"])
def test_blobs_of_any_shape_measure_as_the_oracles(shapes: str) -> None:
    """Of random colours: windows without a core or a rim, and cores with a single reading."""
    rng, scene = np.random.default_rng(4), Scene()
    scene.blobs = find_components(mask_of(shapes, 0.35, rng), radius_at)
    scene.color = rng.integers(0, 256, (150, 200, 3)).astype(np.uint8)
    scene.hsv = rng.integers(0, 256, (150, 200, 3)).astype(np.uint8)
    scene.raw = (rng.integers(3500, 3530, (150, 200)) * rng.integers(0, 2, (150, 200))).astype(np.uint16)
    assert_same(scene.measured(PRIMESENSE), scene.expected(PRIMESENSE))


@pytest.mark.parametrize("layout", LAYOUTS)
def test_pictures_stored_otherwise_measure_the_same(layout: Callable[[Any], Any]) -> None:
    scene = Scene()
    assert_same(scene.measured(PRIMESENSE, layout), scene.expected(PRIMESENSE))


def test_blobs_empty_give_empty_measurement() -> None:
    scene = Scene()
    scene.blobs = scene.blobs.subset(np.empty(0, dtype=np.int64))
    assert [len(numbers) for numbers in scene.measured(PRIMESENSE)] == [0] * 6


def test_blobs_and_stencils_that_do_not_fit_are_refused() -> None:
    scene = Scene()
    blobs, stencil = scene.blobs, scene.stencil
    beyond = slice(0, len(stencil.offset) + 1)
    wrong: list[tuple[Components, Stencil]] = [
        (replace(blobs, centre_px=blobs.centre_px[1:]), stencil),
        (replace(blobs, centre_px=np.full_like(blobs.centre_px, np.nan)), stencil),
        (replace(blobs, centre_px=blobs.centre_px + 1e12), stencil),
        (replace(blobs, centre_px=blobs.centre_px.astype(np.float32)), stencil),
        (replace(blobs, labels=blobs.labels[0]), stencil),
        (replace(blobs, labels=blobs.labels[:20]), stencil),
        (replace(blobs, label=blobs.label.astype(np.int64)), stencil),
        (blobs, replace(stencil, rim=beyond)),
        (blobs, replace(stencil, core=beyond)),
        (blobs, replace(stencil, offset=stencil.offset[:, :1])),
    ]
    for one, other in wrong:
        with pytest.raises(ValueError, match=r"size|within|off its picture|dtype|dimensions|contiguous"):
            BlobWindows(one, other)


def test_pictures_and_tables_that_do_not_fit_are_refused() -> None:
    scene = Scene()
    seen, table = BlobWindows(scene.blobs, scene.stencil), scene.table
    wrong: list[Callable[[], Any]] = [
        lambda: seen.compare_colors(scene.hsv[:-1], table),
        lambda: seen.compare_colors(scene.hsv[..., :2], table),
        lambda: seen.compare_colors(scene.hsv, replace(table, cell=table.cell[:-1])),
        lambda: seen.compare_colors(scene.hsv, replace(table, is_skin=table.is_skin[1:])),
        lambda: seen.compare_colors(scene.hsv, replace(table, root_of_share=table.root_of_share[:99])),
        lambda: seen.locate_centres(scene.color[:, :-1]),
        lambda: seen.locate_centres(scene.color.astype(np.float64)),
        lambda: BlobWindows(scene.blobs, replace(scene.stencil, reach=scene.stencil.reach[1:])).locate_centres(
            scene.color
        ),
        lambda: BlobWindows(
            scene.blobs, replace(scene.stencil, direction=np.full_like(scene.stencil.direction, 255))
        ).locate_centres(scene.color),
        lambda: seen.read_depths(np.pad(scene.raw, ((0, 0), (0, 16))), UNIT_M, D435),
        lambda: seen.read_depths(scene.raw.astype(np.int32), UNIT_M, D435),
        lambda: BlobWindows(scene.blobs, replace(scene.stencil, near=slice(0, 9999))).read_depths(scene.raw, 1.0, D435),
    ]
    for ask in wrong:
        with pytest.raises(ValueError, match=r"size|channels|dtype|within|dimensions"):
            ask()

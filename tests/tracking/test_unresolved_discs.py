"""Two discs of a finger that the picture shows as one blob: what it says of each, and that it says no more."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from carpus.core.model.types import FloatArray
from carpus.core.tracking.digits.digit_association import DigitAssignment, DigitScene, measurements_from_assignment
from carpus.core.tracking.filter.settings import TrackerSettings
from tests.tracking.test_fingers import update_digits_once

CHAIN, PIP, DIP, TIP = 2, 0, 1, 2
RADIUS_PX, SETTINGS = 4.5, TrackerSettings()


def shared_px2(gap_px: float) -> float:
    """What two discs have in common."""
    half = 0.5 * gap_px
    return float(2.0 * RADIUS_PX**2 * np.arccos(half / RADIUS_PX) - 2.0 * half * np.sqrt(RADIUS_PX**2 - half**2))


def build_scene(gap_px: float, blob_of: int) -> tuple[DigitScene, DigitAssignment, FloatArray]:
    """A finger whose last two discs lie so near that one blob, named ``blob_of``, is both; and where they are (2, 2).
    They are expected a little further on."""
    trial, _ = update_digits_once(1e-4, (0.0, 0.0))
    scene, names = trial.scene, trial.update.assignment
    value = scene.linearised.value.reshape(5, 3, 3).copy()
    along = value[CHAIN, TIP, :2] - value[CHAIN, DIP, :2]
    value[CHAIN, TIP, :2] = value[CHAIN, DIP, :2] + gap_px * along / np.linalg.norm(along)
    place = value[CHAIN, DIP:, :2].copy()
    value[CHAIN, DIP:, :2] += [0.4, -0.3]
    assigned, with_depth = names.assigned.copy(), names.with_depth.copy()
    blob = assigned[CHAIN, blob_of]
    assigned[CHAIN, DIP + TIP - blob_of], with_depth[CHAIN, DIP + TIP - blob_of] = -1, False
    blobs, area_px = scene.blobs.value.copy(), np.full(len(scene.blobs), np.pi * RADIUS_PX**2)
    blobs[blob, :2] = place.mean(axis=0)
    area_px[blob] = 2.0 * np.pi * RADIUS_PX**2 - shared_px2(gap_px)
    whole_px = np.full((5, 3), np.pi * RADIUS_PX**2)
    near = replace(
        scene,
        linearised=replace(scene.linearised, value=value.reshape(5, 9)),
        blobs=replace(scene.blobs, value=blobs),
        area_px=area_px,
        whole_px=whole_px,
        disc_m2=whole_px * (value[..., 2] / scene.view.camera.fx_px) ** 2,
        visible=np.full((5, 3), 0.98),
    )
    return near, DigitAssignment(assigned, with_depth), place


def measure_scene(scene: DigitScene, names: DigitAssignment) -> tuple[FloatArray, FloatArray]:
    """What is measured of the discs (5, 3, 3), and how surely."""
    measured, variance = measurements_from_assignment(scene, names, SETTINGS)
    return measured.reshape(5, 3, 3), np.sqrt(variance.reshape(5, 3, 3))


@pytest.mark.parametrize("gap_px", [4.0, 6.0, 8.0])
@pytest.mark.parametrize("blob_of", [DIP, TIP])
def test_merged_blob_measures_both_discs(gap_px: float, blob_of: int) -> None:
    scene, names, place = build_scene(gap_px, blob_of)
    measured, sd = measure_scene(scene, names)
    off, stated = np.abs(measured[CHAIN, DIP:, :2] - place), sd[CHAIN, DIP:, :2]
    assert (off < 0.4 * gap_px).all(), "nearer than the blob's own centre"
    assert (off < 2.0 * stated).all()
    assert (stated > 0.2 * gap_px).all(), "a blob of two discs is as sure of neither as of one"
    assert sd[CHAIN, blob_of, 2] > 4e-3, "its depth may be the other's"
    assert np.isnan(measured[CHAIN, DIP + TIP - blob_of, 2])


def test_single_blob_measures_its_disc_alone() -> None:
    scene, names, _ = build_scene(6.0, DIP)
    blob = names.assigned[CHAIN, DIP]
    just_large = scene.area_px.copy()
    just_large[blob] = 1.2 * scene.whole_px[CHAIN, DIP]
    for one in (replace(scene, area_px=just_large), replace(scene, visible=np.full((5, 3), 0.3))):
        measured, sd = measure_scene(one, names)
        assert measured[CHAIN, DIP, :2] == pytest.approx(scene.blobs.value[blob, :2])
        assert (sd[CHAIN, DIP, :2] < 1.0).all()
        assert np.isnan(measured[CHAIN, TIP]).all()

"""The simulated skin traced in C against NumPy, both in single precision."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.kernels import choice
from carpus.core.simulation.recording import RecordingSpec
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.skin import Cones
from carpus.core.simulation.trace import TracedSurface, trace
from tests.kernels.pairs import LEVELS


def fist(time_s: float) -> tuple[Scene, Cones]:
    scene = Scene(RecordingSpec(seed=7, motion="fist", protocol="hand21"))
    return scene, scene.cones_cam(scene.pose(np.array([time_s])), 0)


def assert_same(found: TracedSurface | None, expected: TracedSurface | None) -> None:
    assert found is not None
    assert expected is not None
    assert found.box == expected.box
    # A ray that grazes the skin may end a little elsewhere: a rounding decides how far its steps are lengthened.
    is_skin = expected.coverage > 0.5
    away_m = np.abs(found.depth_m - expected.depth_m)[is_skin]
    assert np.quantile(away_m, 0.999) < 1e-5
    assert away_m.max() < 1e-3
    assert np.abs(found.coverage - expected.coverage).max() < 1e-3
    turned = np.vecdot(found.normal, expected.normal)[is_skin]
    assert np.quantile(turned, 0.001) > 1.0 - 1e-6
    assert (found.part != expected.part)[is_skin].mean() < 1e-3


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize(
    "shift_m", [(0.0, 0.0, 0.0), (0.22, 0.05, 0.0), (0.0, 0.0, -0.45)], ids=["whole", "leaving", "near"]
)
def test_skin_is_traced_alike(level: str, shift_m: tuple[float, float, float]) -> None:
    scene, cones = fist(1.0)
    cones = cones.moved(np.eye(3), np.array(shift_m))
    with choice.forced(choice.NUMPY):
        expected = trace(scene.camera, cones)
    with choice.forced(level) as kernels:
        assert kernels is not None
        assert_same(trace(scene.camera, cones), expected)


@pytest.mark.parametrize("level", [choice.NUMPY, *LEVELS])
def test_skin_outside_the_picture_is_none(level: str) -> None:
    scene, cones = fist(0.0)
    with choice.forced(level):
        assert trace(scene.camera, cones.moved(np.eye(3), np.array([3.0, 0.0, 0.0]))) is None


def test_a_place_outside_the_picture_is_refused() -> None:
    with choice.forced("plain") as kernels:
        assert kernels is not None
        out = [np.empty((2, 2), dtype=np.float32) for _ in range(2)]
        with pytest.raises(ValueError, match="outside"):
            kernels.skin_traced(
                1, np.zeros(18), np.array([0, 2, 0, 3], dtype=np.int32), np.zeros(1, dtype=np.int32), np.ones(7),
                0, 0, 2, 2, np.zeros(2, dtype=np.float32), np.zeros(2, dtype=np.float32), 0.5, 500.0, *out,
                np.empty((2, 2, 3), dtype=np.float32), np.empty((2, 2), dtype=np.uint8),
            )  # fmt: skip

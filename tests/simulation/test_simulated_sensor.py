"""The simulated sensor has the reference's depth noise, its steps, its edges, and the colour camera's chroma."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.simulation.recording import SimulatedPictures
from carpus.core.simulation.sensor import DepthSensor
from carpus.core.simulation.spec import RecordingSpec

SHAPE = (480, 640)
UNIT_M = 1.0 / 5000.0


def slope(z_m: float) -> np.ndarray:
    """A nearly flat wall: slightly tilted, so that all parts of a step occur."""
    rows, columns = np.mgrid[0 : SHAPE[0], 0 : SHAPE[1]]
    return (z_m * (1.0 + 3e-5 * (columns - 320) + 2e-5 * (rows - 240))).astype(np.float32)


@pytest.mark.parametrize("z_m", [0.6, 0.7, 0.9])
def test_depth_noise_is_that_of_the_reference(z_m: float) -> None:
    sensor, wall = DepthSensor(RecordingSpec(seed=1, depth_scale_error=0.0), SHAPE), slope(z_m)
    stack = np.stack([sensor.measure(wall, i) * UNIT_M for i in range(12)])
    error = np.where(stack > 0.0, stack - wall, np.nan)
    sigma = 1.425e-3 * z_m**2
    assert np.nanstd(error) == pytest.approx(sigma, rel=0.15)
    assert abs(np.nanmean(error)) < 0.2 * sigma
    assert np.isnan(error).mean() < 0.005
    # Noise of one frame is shared over the matching window, and not beyond it.
    one = np.nan_to_num(error[0] - error[1])
    variance = (one * one).mean()
    assert (one[:, :-2] * one[:, 2:]).mean() > 0.4 * variance
    assert abs((one[:, :-16] * one[:, 16:]).mean()) < 0.1 * variance
    # A part of the error stays from frame to frame.
    fixed = np.nanmean(error, axis=0)
    assert np.nanstd(fixed) > 1.3 * sigma / np.sqrt(12)


def test_depth_comes_in_steps_of_an_eighth_of_a_pixel() -> None:
    wall = slope(0.8)
    raw = DepthSensor(RecordingSpec(seed=2, depth_scale_error=0.0), SHAPE).measure(wall, 0) * UNIT_M
    values = np.unique(raw[raw > 0.0])
    step = 2.85e-3 * 0.8**2
    assert np.median(np.diff(values)) == pytest.approx(step, abs=6e-4)
    disparity = 8.0 * 575.0 * 0.075 / values
    # Whole eighths, but for the rounding to millimetres.
    assert np.abs(disparity - np.round(disparity)).max() < 0.5e-3 / step + 0.05


def test_edges_have_holes_and_a_shadow_on_one_side() -> None:
    depth = np.full(SHAPE, 0.80, dtype=np.float32)
    depth[100:380, 200:400] = 0.70
    raw = DepthSensor(RecordingSpec(seed=3), SHAPE).measure(depth, 0)[150:330] > 0
    holes = 1.0 - raw.mean(axis=0)
    assert holes[206:394].max() < 0.1
    assert holes[:180].max() < 0.1
    assert holes[420:].max() < 0.1
    left, right = holes[185:205].sum(), holes[395:415].sum()
    narrow, wide = min(left, right), max(left, right)
    assert 0.5 < narrow < 4.0
    assert 5.0 < wide < 14.0  # 43.1 (1 / 0.70 - 1 / 0.80) = 7.7 px of shadow


def test_scale_error_is_one_number_of_the_unit_and_bounded() -> None:
    wall = slope(0.7)
    scales = []
    for seed in range(8):
        sensor = DepthSensor(RecordingSpec(seed=seed, depth_scale_error=0.01), SHAPE)
        means = [float((sensor.measure(wall, i) * UNIT_M / wall).mean()) for i in range(2)]
        assert means[0] == pytest.approx(means[1], abs=5e-4)
        scales.append(means[0] - 1.0)
    assert 0.004 < max(np.abs(scales)) < 0.0105
    assert min(scales) < 0.0 < max(scales)


def test_noise_depends_on_seed_and_frame_alone() -> None:
    wall = slope(0.7)
    spec = RecordingSpec(seed=4)
    first, again = DepthSensor(spec, SHAPE), DepthSensor(spec, SHAPE)
    first.measure(wall, 0)
    np.testing.assert_array_equal(first.measure(wall, 5), again.measure(wall, 5))
    assert np.any(first.measure(wall, 5) != first.measure(wall, 6))


def test_two_neighbours_share_their_chroma() -> None:
    pictures = SimulatedPictures(RecordingSpec(seed=2, light="normal", motion="rest"))
    color, _ = pictures.sensed(0, pictures.clean(0))
    difference = color.astype(int)[..., 0] - color.astype(int)[..., 2]
    pairs = np.abs(difference[:, 0::2] - difference[:, 1::2])
    between = np.abs(difference[:, 1:-1:2] - difference[:, 2::2])
    assert np.percentile(pairs, 99) <= 3
    assert between.mean() > 3 * pairs.mean()


def test_dim_light_is_noisier() -> None:
    def noise(light: str) -> float:
        pictures = SimulatedPictures(RecordingSpec(seed=2, light=light, motion="rest"))  # type: ignore[arg-type]
        clean = pictures.clean(0)
        stack = np.stack([pictures.sensed(i, clean)[0][200:260, 20:120].astype(float) for i in range(6)])
        return float(stack.std(axis=0).mean())

    assert 0.5 < noise("bright") < 3.0
    assert noise("dim") > 1.5 * noise("bright")

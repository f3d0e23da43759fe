"""The simulated sensor has the reference's depth noise, its steps, its edges, and the colour camera's chroma."""

from __future__ import annotations

import numpy as np
import pytest

from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.simulation.scene import Scene
from carpus.core.simulation.sensor import SimulatedDepthSensor, StructuredLightSensor, create_depth_sensor
from carpus.core.simulation.spec import RecordingSpec
from tests.suites import few

SHAPE = (480, 640)
UNIT_M = 1.0 / 5000.0
WHOLE_MM_M = 1e-3 / np.sqrt(12.0)


def slope(z_m: float) -> np.ndarray:
    """A nearly flat wall: slightly tilted, so that all parts of a step occur."""
    rows, columns = np.mgrid[0 : SHAPE[0], 0 : SHAPE[1]]
    return (z_m * (1.0 + 3e-5 * (columns - 320) + 2e-5 * (rows - 240))).astype(np.float32)


def measure_errors(wall: np.ndarray, sensor: SimulatedDepthSensor, count: int) -> np.ndarray:
    """Of so many pictures of a wall, NaN where a picture has a hole."""
    stack = np.stack([sensor.measure(wall, i) * UNIT_M for i in range(count)])
    return np.where(stack > 0.0, stack - wall, np.nan)


def correlation(one: np.ndarray, apart: int) -> float:
    """The share of its variance that a picture's error has in common with that so many pixels further on."""
    return float((one[:, :-apart] * one[:, apart:]).mean() / (one * one).mean())


def block() -> np.ndarray:
    """A block before a wall."""
    depth = np.full(SHAPE, 0.80, dtype=np.float32)
    depth[100:380, 200:400] = 0.70
    return depth


@pytest.mark.parametrize("z_m", few([0.7, 0.6, 0.9]))
def test_depth_noise_matches_the_reference(z_m: float) -> None:
    sensor, wall = StructuredLightSensor(RecordingSpec(seed=1, depth_scale_error=0.0), DEFAULT_CAMERA), slope(z_m)
    error = measure_errors(wall, sensor, 12)
    sigma = 1.425e-3 * z_m**2
    assert np.nanstd(error) == pytest.approx(sigma, rel=0.15)
    assert abs(np.nanmean(error)) < 0.2 * sigma
    assert np.isnan(error).mean() < 0.005
    # Noise of one frame is shared over the matching window, and not beyond it.
    one = np.nan_to_num(error[0] - error[1])
    assert correlation(one, 2) > 0.4
    assert abs(correlation(one, 16)) < 0.1
    # A part of the error stays from frame to frame.
    fixed = np.nanmean(error, axis=0)
    assert np.nanstd(fixed) > 1.3 * sigma / np.sqrt(12)


@pytest.mark.parametrize("name", ["d435", "azure"])
@pytest.mark.parametrize("z_m", few([0.6, 1.0]))
def test_depth_noise_of_other_sensors_follows_their_law(name: str, z_m: float) -> None:
    """On a wall: what changes from picture to picture, what stays, and how far neighbours are one reading."""
    spec = RecordingSpec(seed=1, depth_scale_error=0.0, sensor=name)
    camera = Scene(spec).camera
    sensor, wall, count = create_depth_sensor(spec, camera), slope(z_m), 8
    error = measure_errors(wall, sensor, count)
    stays = np.nanmean(error, axis=0)
    passing = error - stays
    passing_m = float(np.nanstd(passing)) * np.sqrt(count / (count - 1))
    said_m, said_stays_m = (float(of(np.array(z_m))) for of in (camera.sensor.reading_sd_m, camera.sensor.bias_sd_m))
    is_stereo = camera.sensor.kind == "active stereo"
    said_stays_m -= camera.sensor.stays.fixed_m if is_stereo else 0.0  # a wall has no knuckles
    in_one = said_stays_m**2 if is_stereo else 0.0
    assert passing_m == pytest.approx(np.sqrt(said_m**2 - in_one + WHOLE_MM_M**2), rel=0.1)
    assert np.sqrt(np.nanvar(stays) - passing_m**2 / count) == pytest.approx(said_stays_m, rel=0.15)
    assert np.isnan(error).mean() < 0.002
    one, apart = np.nan_to_num(passing[0]), round(camera.sensor.patch_px)
    assert correlation(one, -(-apart // 2)) > 0.2
    assert abs(correlation(one, 3 * apart)) < 0.1


def test_depth_edges_are_thick_in_stereo_and_fly_in_time_of_flight() -> None:
    found = {}
    for name in ("d435", "azure"):
        spec = RecordingSpec(seed=3, depth_scale_error=0.0, sensor=name)
        raw = create_depth_sensor(spec, Scene(spec).camera).measure(block(), 0)[150:330] * UNIT_M
        found[name] = raw
        holes = (raw == 0.0).mean(axis=0)
        assert holes[212:388].max() < 0.1
        assert holes[:180].max() < 0.1
        assert holes[420:].max() < 0.1
        left, right = holes[185:205].sum(), holes[395:415].sum()
        assert max(left, right) > max(1.0, 2.0 * min(left, right))  # one side is seen by one eye alone
    beside = np.c_[found["d435"][:, 198:200], found["d435"][:, 400:402]]
    assert ((beside > 0.68) & (beside < 0.72)).mean() > 0.2  # the front's depth on what lies behind
    assert (np.abs(found["azure"] - 0.75) < 0.03).any(axis=1).mean() > 0.5  # between both surfaces
    assert not (np.abs(found["d435"] - 0.75) < 0.03).any(axis=1).mean() > 0.5


def test_time_of_flight_dark_surfaces_are_noisier() -> None:
    spec = RecordingSpec(seed=5, depth_scale_error=0.0, sensor="azure")
    sensor, wall = create_depth_sensor(spec, Scene(spec).camera), slope(0.7)
    light = np.full((*SHAPE, 3), 0.4, dtype=np.float32)
    light[:, :320] = 0.1
    for brightness in (1.0, 0.2):  # of the room, which does not count
        noise = np.abs(sensor.measure(wall, 0, light * np.float32(brightness)) - 1.0 * sensor.measure(wall, 1))
        assert noise[:, :320].clip(max=50.0).mean() > 1.3 * noise[:, 320:].clip(max=50.0).mean()


def test_depth_edges_have_holes_and_a_shadow() -> None:
    raw = StructuredLightSensor(RecordingSpec(seed=3), DEFAULT_CAMERA).measure(block(), 0)[150:330] > 0
    holes = 1.0 - raw.mean(axis=0)
    assert holes[206:394].max() < 0.1
    assert holes[:180].max() < 0.1
    assert holes[420:].max() < 0.1
    left, right = holes[185:205].sum(), holes[395:415].sum()
    narrow, wide = min(left, right), max(left, right)
    assert 0.5 < narrow < 4.0
    assert 5.0 < wide < 14.0  # 43.1 (1 / 0.70 - 1 / 0.80) = 7.7 px of shadow


def test_sensor_noise_depends_on_seed_and_frame_only() -> None:
    wall = slope(0.7)
    spec = RecordingSpec(seed=4)
    first, again = StructuredLightSensor(spec, DEFAULT_CAMERA), StructuredLightSensor(spec, DEFAULT_CAMERA)
    first.measure(wall, 0)
    np.testing.assert_array_equal(first.measure(wall, 5), again.measure(wall, 5))
    assert np.any(first.measure(wall, 5) != first.measure(wall, 6))

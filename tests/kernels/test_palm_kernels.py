"""What the camera should see of the palm, its names' odds and the surface of its back, in C against NumPy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from carpus.core import so3
from carpus.core.depth_sensor import AZURE_KINECT, D435, PRIMESENSE, DepthSensor
from carpus.core.hand.back_surface import BackSurface
from carpus.core.kernels import choice
from carpus.core.tracking import palm_association
from carpus.core.tracking.kernel import ModeMixture
from carpus.core.tracking.motion import MotionNoise, PalmMotion
from carpus.core.tracking.palm_association import Measurements, associate_and_update, measurements_of
from carpus.core.tracking.palm_state import BACK, RELIEF, SIZE, PalmEstimate, View
from carpus.core.tracking.predicted_measurement import (
    PredictedMeasurement,
    adapted_factor,
    predicted_ahead,
    predicted_measurement,
    shape_partial_update,
)
from carpus.core.tracking.readout import Readout
from carpus.core.tracking.settings import MeasurementNoise, TrackerSettings
from carpus.core.tracking.soft_tissue import (
    DigitSpeeds,
    SoftTissue,
    TissueModes,
    always_pushed,
    moved_by_joints,
    resting_or_moving,
)
from carpus.core.tracking.surface_fit import SurfaceSettings, reset_and_levelled
from carpus.core.tracking.unscented import Spread
from carpus.core.types import Detections, FloatArray, Side, SurfaceSamples
from tests.kernels.pairs import LEVELS, both
from tests.tracking.hands import CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M, calibration
from tests.tracking.test_palm_filter import moving
from tests.tracking.test_surface_fit import place_on
from tests.tracking.test_surface_fit import surface as surface_of_a_hand

surface = surface_of_a_hand
SPEEDS = DigitSpeeds(0.7, 1.3)


def view_of(rng: np.random.Generator, sensor: DepthSensor = PRIMESENSE) -> View:
    turned = FROM_ABOVE @ so3.exp(0.2 * rng.normal(size=3))
    return View(replace(CAMERA, sensor=sensor), turned, MIDDLE_M, RIGHT_PALM_M, 0.3 * rng.normal(size=(6, 18)))


def mixture_about(estimate: PalmEstimate, rng: np.random.Generator, modes: int) -> ModeMixture:
    probability = rng.uniform(0.1, 1.0, size=(1, modes))
    return ModeMixture(
        0.01 * rng.normal(size=(1, modes, SIZE)),
        estimate.covariance * rng.uniform(0.5, 2.0, size=(1, modes, 1, 1)),
        probability / probability.sum(),
    )


def told(of: PredictedMeasurement) -> tuple[object, ...]:
    """What a kernel tells of it."""
    return of.nominal, of.mixture, of.linearised, of.mean, of.covariance, of.partial


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("modes", [1, 8])
def test_sight_and_what_is_expected(seed: int, modes: int) -> None:
    rng = np.random.default_rng(seed)
    estimate, view = moving(seed), view_of(rng)
    both(lambda: view.discs_cam_m(estimate))
    mixture = mixture_about(estimate, rng, modes)
    both(lambda: told(predicted_measurement(estimate, mixture, view, Spread())))
    both(lambda: reset_and_levelled(estimate, mixture, None, None, view, None, SurfaceSettings()))


@pytest.mark.parametrize("level", [choice.NUMPY, *LEVELS])
def test_a_palm_that_is_not_known_at_all_is_no_covariance(level: str) -> None:
    rng, estimate = np.random.default_rng(0), moving()
    broken = replace(estimate, covariance=-estimate.covariance)
    with choice.forced(level), pytest.raises(np.linalg.LinAlgError):
        predicted_measurement(broken, mixture_about(broken, rng, 2), view_of(rng), Spread())


@pytest.mark.parametrize("sensor", [PRIMESENSE, D435, AZURE_KINECT], ids=lambda sensor: sensor.name)
@pytest.mark.parametrize("seed", range(2))
def test_surface(surface: BackSurface, sensor: DepthSensor, seed: int) -> None:
    rng = np.random.default_rng(seed)
    rotation, position = so3.exp(rng.normal(0.0, 0.1, 3)), rng.normal(0.0, 0.005, 3)
    estimate = moving(seed)
    estimate.value[RELIEF], estimate.value[BACK] = 0.01 * rng.normal(size=(2, 3))
    estimate.value[:3] = position
    estimate = replace(estimate, rotation_w2_w0=rotation @ so3.exp(0.01 * rng.normal(size=3)))
    view = View(replace(CAMERA, sensor=sensor), FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M, np.zeros((6, 18)))
    samples = place_on(rotation, position)
    mixture, partial = mixture_about(estimate, rng, 3), shape_partial_update(0.2)
    off = mixture.mean + np.where(np.arange(SIZE) == RELIEF.start, 0.5, 0.0)
    far = replace(mixture, mean=off, covariance=1e-6 * mixture.covariance)
    broken = replace(mixture, covariance=np.full(mixture.covariance.shape, np.nan))

    def after(some: SurfaceSamples | None, of: ModeMixture = mixture, partial: FloatArray | None = partial) -> Any:
        return both(lambda: reset_and_levelled(estimate, of, some, surface, view, partial, SurfaceSettings()))

    for every in (7, 8, 900):  # an odd and an even number of readings, and too few
        some = SurfaceSamples(samples.pixel[::every], samples.depth_m[::every] + 1e-3 * rng.normal(size=1))
        assert after(some)[2] == (every != 900)
    assert after(some, partial=None)[2] is False
    thinned = SurfaceSamples(samples.pixel[::9], samples.depth_m[::9])
    assert after(thinned, partial=None)[2]
    assert not after(thinned, far)[2]
    with np.errstate(invalid="ignore"):
        after(thinned, broken)
    assert not after(SurfaceSamples(samples.pixel[::9] + 1e4, samples.depth_m[::9]))[2]
    assert not after(SurfaceSamples(np.empty((0, 2)), np.empty(0)))[2]
    assert not after(None)[2]


@pytest.mark.parametrize("modes", [1, 8])
@pytest.mark.parametrize("learns", [False, True])
def test_names_and_update_in_the_ordinary_case(modes: int, learns: bool) -> None:
    rng, settings = np.random.default_rng(20), TrackerSettings()
    estimate, view, as_it_is = moving(1), view_of(rng), np.ones((6, 3))
    estimate = replace(estimate, covariance=1e-3 * estimate.covariance)
    partial = shape_partial_update(0.2) if learns else None
    mixture = mixture_about(estimate, rng, modes)
    mixture.mean[:] *= 1e-2
    expected = predicted_measurement(estimate, mixture, view, Spread(), partial)
    noise = np.broadcast_to([0.04, 0.04, 1e-6], (6, 3))
    seen = expected.mean + rng.normal(size=(6, 3)) * np.sqrt(noise)
    no_depth, covered, outlier, twice = (seen.copy() for _ in range(4))
    no_depth[::2, 2] = np.nan
    covered[3, 2] -= 0.3
    outlier[2, 0] += 3.0
    outlier[4, 2] += 0.01
    twice[1] = twice[0]
    cases = [seen[::-1], seen[:5], seen[:2], seen[:0], no_depth, covered, outlier, twice, np.full((3, 3), np.nan)]
    cases += [
        np.concatenate((seen, seen + 40.0)),
        seen + [6.0, -6.0, 0.02],
        np.where(np.arange(3) == 2, seen - 0.3, seen),
    ]
    ordinary = []
    for blobs in cases:
        measured = Measurements(blobs, noise[:1].repeat(len(blobs), axis=0))
        both(lambda of=measured: associate_and_update(expected, of, 4, 3e5, as_it_is, settings))
        ordinary.append(palm_association._in_ordinary_case(expected, measured, 4, 3e5, as_it_is, settings) is not None)
    assert ordinary[0]
    assert not any((ordinary[3], ordinary[8]))


@pytest.mark.parametrize("tissue", [always_pushed, resting_or_moving, moved_by_joints])
@pytest.mark.parametrize("scales", [(1.0,), (0.5, 4.0)])
@pytest.mark.parametrize("dt_s", [0.0, 0.033, 3.0])
def test_what_is_expected_ahead(
    tissue: Callable[[SoftTissue], TissueModes], scales: tuple[float, ...], dt_s: float
) -> None:
    rng = np.random.default_rng(13)
    motion, along = PalmMotion(MotionNoise(), tissue(SoftTissue()), np.array(scales)), rng.normal(size=3)
    unseen = np.outer(along, along) / (along @ along)
    still = replace(moving(3), value=np.zeros(SIZE))
    for estimate, some in ((moving(1), None), (moving(2), unseen), (still, None)):
        mixture, view = mixture_about(estimate, rng, motion.modes), view_of(rng)
        both(
            lambda estimate=estimate, mixture=mixture, view=view, some=some: told(
                predicted_ahead(estimate, mixture, view, motion, dt_s, some, SPEEDS, TrackerSettings())
            )
        )


@pytest.mark.parametrize("side", ["right", "left"])
@pytest.mark.parametrize("start_rad", [(0.0, 0.0, 0.0), (0.1, 0.9, -0.2)])
@pytest.mark.parametrize("sensor", [PRIMESENSE, D435], ids=lambda sensor: sensor.name)
def test_the_wrist_as_it_is_read(side: Side, start_rad: tuple[float, ...], sensor: DepthSensor) -> None:
    known = calibration(side, start_angles_rad=np.array(start_rad))
    camera = replace(CAMERA, sensor=replace(sensor, averages=sensor is D435, stays_px=0.0))
    for seed in range(3):
        estimate = moving(seed)
        if seed == 2:
            estimate = replace(estimate, rotation_w2_w0=np.eye(3))  # where ZYZ angles are not defined
        both(lambda estimate=estimate: Readout(known, camera, 6e-3).moment(estimate))


def test_adapted_noise() -> None:
    rng, noise = np.random.default_rng(14), MeasurementNoise()
    for shape in ((6, 3), (5, 3, 3)):
        factor, residual = rng.uniform(0.6, 3.0, size=shape), 6.0 * rng.normal(size=shape)
        seen = rng.uniform(size=shape) < 0.6
        both(lambda f=factor, r=residual, s=seen: adapted_factor(f, r, s, 0.03, noise))
        both(lambda f=factor, r=residual: adapted_factor(f, r, np.zeros(r.shape, dtype=bool), 0.03, noise))


@pytest.mark.parametrize("sensor", [PRIMESENSE, D435, AZURE_KINECT], ids=lambda sensor: sensor.name)
@pytest.mark.parametrize("use_depth", [True, False])
def test_what_blobs_are_worth(sensor: DepthSensor, use_depth: bool) -> None:
    rng = np.random.default_rng(16)
    for count in (0, 1, 30):
        depth = rng.uniform(0.4, 1.2, size=count)
        depth[1::4] = np.nan
        blobs = Detections(
            rng.uniform(0.0, 640.0, size=(count, 2)), depth, rng.uniform(1e-4, 0.01, size=count),
            rng.uniform(5.0, 200.0, size=count), np.ones(count),
        )  # fmt: skip
        both(lambda blobs=blobs: measurements_of(blobs, 7.0, TrackerSettings(use_depth=use_depth), sensor))

"""What the camera should see of the palm, its names' odds and the surface of its back, in C against NumPy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from carpus.core import so3
from carpus.core.depth_sensor import AZURE_KINECT, D435, PRIMESENSE, DepthSensor
from carpus.core.hand.back_surface import BackSurface
from carpus.core.tracking.adaptive_noise import adapted_factor
from carpus.core.tracking.association import AssociationSettings, log_odds
from carpus.core.tracking.kernel import ModeMixture
from carpus.core.tracking.motion import MotionNoise, PalmMotion, palm_ahead
from carpus.core.tracking.palm_association import measurements_of
from carpus.core.tracking.palm_state import BACK, RELIEF, SIZE, TURN, PalmEstimate
from carpus.core.tracking.palm_view import View, error_reset, palm_linearised
from carpus.core.tracking.predicted_measurement import predicted_measurement
from carpus.core.tracking.readout import Readout, ReadoutSettings
from carpus.core.tracking.settings import MeasurementNoise, TrackerSettings
from carpus.core.tracking.soft_tissue import (
    DigitSpeeds,
    SoftTissue,
    TissueModes,
    always_pushed,
    moved_by_joints,
    resting_or_moving,
)
from carpus.core.tracking.surface_fit import SurfaceSettings, surface_measurement
from carpus.core.tracking.unscented import Spread
from carpus.core.types import Detections, FloatArray, Side, SurfaceSamples
from tests.kernels.pairs import both
from tests.kernels.test_filter_kernels import covariances
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


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("modes", [1, 8])
def test_sight_and_what_is_expected(seed: int, modes: int) -> None:
    rng = np.random.default_rng(seed)
    estimate, view = moving(seed), view_of(rng)
    both(lambda: palm_linearised(estimate, view, Spread()))
    both(lambda: view.discs_cam_m(estimate))
    mixture = mixture_about(estimate, rng, modes)

    def expected() -> tuple[FloatArray, FloatArray]:
        predicted = predicted_measurement(estimate, mixture, view, Spread())
        return predicted.mean, predicted.covariance

    both(expected)
    both(lambda: error_reset(estimate, mixture))


def test_a_palm_that_is_not_known_at_all_is_no_covariance() -> None:
    estimate = moving()
    broken = replace(estimate, covariance=-estimate.covariance)
    for level in ("numpy", "plain", "wide"):
        with pytest.raises(np.linalg.LinAlgError):
            _sight_by(level, broken)


def _sight_by(level: str, estimate: PalmEstimate) -> None:
    from carpus.core.kernels import choice

    with choice.forced(level):
        palm_linearised(estimate, view_of(np.random.default_rng(0)), Spread())


@pytest.mark.parametrize("blobs", [0, 1, 25])
def test_odds_of_names(blobs: int) -> None:
    rng = np.random.default_rng(4)
    scale = np.array([1.0, 1.0, 0.003])
    covariance = covariances(rng, 6, 3) * scale[:, None] * scale
    expected = rng.normal(size=(6, 3)) * [20.0, 20.0, 0.01] + [320.0, 240.0, 0.7]
    measured = expected[rng.integers(0, 6, blobs)] + rng.normal(size=(blobs, 3)) * 3.0 * scale
    measured[1::4, 2] = np.nan
    measured[2::4, 2] += 0.2
    variance = np.broadcast_to([0.04, 0.04, 1e-6], (blobs, 3)).copy()
    found = both(lambda: log_odds(expected, covariance, measured, variance, 3e5, 1e-4, AssociationSettings()))
    assert blobs < 25 or (found.with_depth.any() and not found.with_depth.all())


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
    for every in (7, 8, 900):  # an odd and an even number of readings, and too few
        some = SurfaceSamples(samples.pixel[::every], samples.depth_m[::every] + 1e-3 * rng.normal(size=1))
        found = both(lambda some=some: surface_measurement(estimate, some, surface, view, SurfaceSettings()))
        assert (found is None) == (every == 900)
    assert estimate.value[TURN].any() == False  # noqa: E712
    away = SurfaceSamples(samples.pixel[::9] + 1e4, samples.depth_m[::9])
    assert both(lambda: surface_measurement(estimate, away, surface, view, SurfaceSettings())) is None
    none = SurfaceSamples(np.empty((0, 2)), np.empty(0))
    assert both(lambda: surface_measurement(estimate, none, surface, view, SurfaceSettings())) is None


@pytest.mark.parametrize("tissue", [always_pushed, resting_or_moving, moved_by_joints])
@pytest.mark.parametrize("scales", [(1.0,), (0.5, 4.0)])
@pytest.mark.parametrize("dt_s", [0.033, 3.0])
def test_the_palm_ahead(tissue: Callable[[SoftTissue], TissueModes], scales: tuple[float, ...], dt_s: float) -> None:
    rng = np.random.default_rng(13)
    motion, along = PalmMotion(MotionNoise(), tissue(SoftTissue()), np.array(scales)), rng.normal(size=3)
    unseen = np.outer(along, along) / (along @ along)
    for seed, some in ((1, None), (2, unseen)):
        estimate = moving(seed)
        mixture = mixture_about(estimate, rng, motion.modes)
        both(
            lambda estimate=estimate, mixture=mixture, some=some: palm_ahead(
                estimate, mixture, motion, dt_s, some, SPEEDS
            )
        )
    still = replace(moving(3), value=np.zeros(SIZE))
    both(lambda: palm_ahead(still, mixture_about(still, np.random.default_rng(1), motion.modes), motion, dt_s))


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
        both(lambda estimate=estimate: Readout(known, ReadoutSettings(), camera, 6e-3).moment(estimate))


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

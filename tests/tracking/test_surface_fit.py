"""The back of the hand as a measurement: what the surface says of the hand's tilt, and when it is not asked."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

from carpus.core.model import so3
from carpus.core.model.hand.dorsal_surface import DorsalSurface, fit_dorsal_surface
from carpus.core.model.types import FloatArray, SurfaceSamples
from carpus.core.tracking.filter.mixture_filter import (
    Linearisation,
    ModeMixture,
    UnscentedParameters,
    Update,
    update_mixture,
)
from carpus.core.tracking.filter.palm_state import (
    POSITION,
    RELIEF,
    SIZE,
    SURFACE,
    TURN,
    PalmEstimate,
    PalmView,
    reset_error,
)
from carpus.core.tracking.filter.predicted_measurement import (
    Measurements,
    predict_measurement,
    shape_partial_update,
    update_palm,
)
from carpus.core.tracking.filter.surface_fit import (
    NO_NOISE,
    SurfaceMeasurement,
    SurfaceSettings,
    fit_surface,
    surface_calibration_covariance,
)
from tests.suites import few
from tests.tracking.hands import CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M

VIEW = PalmView(CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M, np.zeros((6, 18)))


def height_m(x: FloatArray, y: FloatArray) -> FloatArray:
    """A back of a hand: arched across, falling towards the wrist."""
    x, y = np.clip(x, -0.05, 0.15), np.clip(y, -0.05, 0.05)
    return 0.02 * x - 6.0 * y**2 - 0.5 * (x - 0.04) ** 2


def get_surface_point(rotation: FloatArray, position: FloatArray) -> SurfaceSamples:
    """Readings of that surface at a pose, on a lattice of pixels: each ray meets it once."""
    u, v = np.meshgrid(np.arange(250.0, 400.0, 2.0), np.arange(150.0, 330.0, 2.0))
    pixel = np.stack((u.ravel(), v.ravel()), axis=1)
    ray = CAMERA.backproject(pixel, np.ones(len(pixel)))
    depth = np.full(len(pixel), MIDDLE_M[2])
    for _ in range(30):
        in_w0 = (ray * depth[:, None] - MIDDLE_M) @ FROM_ABOVE
        local = (in_w0 - position) @ rotation
        over = local[:, 2] - height_m(local[:, 0], local[:, 1])
        depth += 0.9 * over  # W's Z looks at the camera: what floats above is too near
    return SurfaceSamples(pixel, depth)


def build_surface() -> DorsalSurface:
    x, y = np.meshgrid(np.arange(-0.02, 0.11, 0.0013), np.arange(-0.03, 0.04, 0.0013))
    points = np.stack((x.ravel(), y.ravel(), height_m(x, y).ravel()), axis=1)
    corner = RIGHT_PALM_M[:4].copy()
    corner[:, 2] = height_m(corner[:, 0], corner[:, 1])
    found = fit_dorsal_surface(points, corner)
    assert found is not None
    return found


@pytest.fixture(scope="module")
def surface() -> DorsalSurface:
    return build_surface()


def build_estimate(rotation: FloatArray, position: FloatArray) -> PalmEstimate:
    value = np.zeros(SIZE)
    value[POSITION] = position
    return PalmEstimate(rotation, value, np.eye(SIZE))


def thin_readings(samples: SurfaceSamples, most: int = 800) -> SurfaceSamples:
    """As many readings as a picture gives, from all over the surface."""
    kept = np.random.default_rng(0).permutation(len(samples.depth_m))[:most]
    return SurfaceSamples(samples.pixel[kept], samples.depth_m[kept])


HERE = build_estimate(np.eye(3), np.zeros(3))
ALL_READINGS = get_surface_point(np.eye(3), np.zeros(3))
READINGS = thin_readings(ALL_READINGS)
"""Of the surface where it is believed to be."""


def measure_readings(
    surface: DorsalSurface,
    samples: SurfaceSamples = READINGS,
    settings: SurfaceSettings | None = None,
    believed: PalmEstimate = HERE,
    view: PalmView = VIEW,
) -> SurfaceMeasurement:
    found = fit_surface(believed, samples, surface, view, settings or SurfaceSettings())
    assert found is not None
    return found


@pytest.mark.parametrize("seed", few(range(5), 2))
def test_surface_fit_wrong_pose_measures_its_error(surface: DorsalSurface, seed: int) -> None:
    rng = np.random.default_rng(seed)
    rotation, position = so3.exp(rng.normal(0.0, 0.15, 3)), rng.normal(0.0, 0.01, 3)
    turn, shift = rng.normal(0.0, 0.03, 3) * [1.0, 1.0, 0.3], rng.normal(0.0, 0.001, 3)
    believed = build_estimate(rotation @ so3.exp(turn), position + shift)
    found = measure_readings(surface, get_surface_point(rotation, position), believed=believed)
    for part in (SURFACE, RELIEF):
        assert np.array_equal(found.slope[:, part], np.eye(3)), "what calibration was wrong by, or relief has changed"
    error = believed.compute_error(build_estimate(rotation, position))
    assert found.value == pytest.approx(found.slope @ error, abs=6e-4)
    assert abs(found.value[0]) > 1e-3 or abs(turn[0]) < 2e-3


def update_by_surface(mixture: ModeMixture, found: SurfaceMeasurement) -> Update:
    """The palm's modes corrected by the surface alone."""
    partial = shape_partial_update(0.1)
    line = Linearisation(np.zeros((1, 3)), found.slope[None], found.covariance[None], np.zeros((1, SIZE)))
    return update_mixture(mixture, line, found.value[None], NO_NOISE, partial=partial)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_surface_fit_lasting_deformation_does_not_keep_turning_the_hand(surface: DorsalSurface, sign: float) -> None:
    """Ten seconds of a back of the hand 1.2 degrees off its calibrated shape: pose and relief share what was seen as
    their prior uncertainties say, once."""
    off_rad, turn_sd, relief_sd = sign * np.radians(1.2), 0.004, 0.012
    seen = thin_readings(get_surface_point(so3.exp(np.array([0.0, off_rad, 0.0])), np.zeros(3)))
    estimate = build_estimate(np.eye(3), np.zeros(3))
    covariance = 1e-10 * np.eye(SIZE)
    covariance[TURN, TURN], covariance[RELIEF, RELIEF] = turn_sd**2 * np.eye(3), relief_sd**2 * np.eye(3)
    mixture = ModeMixture.from_gaussian(np.zeros((1, SIZE)), covariance[None], 2)
    for _ in range(300):
        found = measure_readings(surface, seen, believed=estimate)
        estimate, mixture = reset_error(estimate, update_by_surface(mixture, found).mixture)
    turned, relief = so3.log(estimate.rotation_w2_w0)[1], estimate.value[RELIEF][1]
    assert turned + relief == pytest.approx(off_rad, rel=0.02)
    assert turned / (turned + relief) == pytest.approx(turn_sd**2 / (turn_sd**2 + relief_sd**2), abs=0.02)


@pytest.mark.parametrize("shared", [0.0, 1.0])
def test_surface_fit_depth_noise_scatters_as_stated(surface: DorsalSurface, shared: float) -> None:
    """With errors that are each pixel's own, or shared by those of one matching window, the stated covariance is that
    of the scatter."""
    settings = SurfaceSettings(
        shared_variance_share=shared,
        turn_sd_rad=0.0,
        height_sd_m=0.0,
        persistence_factor=1.0,
        min_reading_sd_per_m=0.0014,
    )
    rng, sd_m = np.random.default_rng(0), 0.0014 * float(np.median(READINGS.depth_m)) ** 2
    found, stated = [], []
    for _ in range(120):
        noise = rng.standard_normal((480, 640))
        if shared:
            noise = cv2.blur(noise, (9, 9)) * 9.0
        column, row = np.round(READINGS.pixel).astype(int).T
        noisy = SurfaceSamples(READINGS.pixel, READINGS.depth_m + sd_m * noise[row, column])
        one = measure_readings(surface, noisy, settings)
        found.append(one.value)
        stated.append(np.sqrt(np.diag(one.covariance)))
    assert np.std(found, axis=0) == pytest.approx(np.mean(stated, axis=0), rel=0.25)


def test_surface_fit_covered_hand_gives_none(surface: DorsalSurface) -> None:
    covered = SurfaceSamples(ALL_READINGS.pixel, ALL_READINGS.depth_m - 0.05)
    for samples in (covered, SurfaceSamples(np.empty((0, 2)), np.empty(0))):
        assert fit_surface(HERE, samples, surface, VIEW, SurfaceSettings()) is None


def test_dorsal_surface_too_few_points_gives_none() -> None:
    assert fit_dorsal_surface(np.empty((0, 3)), RIGHT_PALM_M[:4]) is None
    lonely = np.column_stack((np.linspace(0.0, 0.08, 40), np.zeros(40), np.zeros(40)))
    assert fit_dorsal_surface(lonely, RIGHT_PALM_M[:4]) is None


def test_update_palm_is_corrected_only_by_a_surface_that_can_be_this_one(surface: DorsalSurface) -> None:
    estimate, samples = build_estimate(np.eye(3), np.zeros(3)), get_surface_point(np.eye(3), np.zeros(3))
    mixture, partial = (
        ModeMixture.from_gaussian(np.zeros((1, SIZE)), 1e-6 * np.eye(SIZE)[None], 2),
        shape_partial_update(0.2),
    )
    far = replace(mixture, mean=mixture.mean + np.where(np.arange(SIZE) == RELIEF.start, 0.5, 0.0))

    def is_used(samples: SurfaceSamples, of: ModeMixture = mixture, partial: FloatArray | None = partial) -> bool:
        predicted = predict_measurement(estimate, of, VIEW, UnscentedParameters(), partial)
        found = fit_surface(estimate, samples, surface, VIEW, SurfaceSettings())
        blobs = Measurements(np.empty((0, 3)), np.empty((0, 3)), found)
        return update_palm(predicted, blobs, np.full(6, -1), np.zeros(6, dtype=bool), np.ones((6, 3))).by_surface

    assert is_used(samples)
    assert is_used(samples, partial=None)
    assert not is_used(samples, far)
    assert not is_used(replace(samples, pixel=samples.pixel + 1e4))


def fit_readings(surface: DorsalSurface, samples: SurfaceSamples, settings: SurfaceSettings) -> SurfaceMeasurement:
    """From a pose 3 degrees and a millimetre off."""
    off = build_estimate(so3.exp(np.radians([2.0, -2.0, 0.0])), np.array([0.0, 0.0, 0.001]))
    return measure_readings(surface, samples, settings, off)


def test_surface_calibration_covariance_is_a_share_of_one_frames(surface: DorsalSurface) -> None:
    settings = SurfaceSettings()
    found = surface_calibration_covariance(surface, VIEW, settings)
    one = fit_readings(surface, READINGS, replace(settings, turn_sd_rad=0.0, height_sd_m=0.0))
    ratio = np.diag(found) / (np.diag(one.covariance) / settings.persistence_factor)
    assert (ratio < 2.0 * settings.persistent_share**2).all()
    assert (ratio > 0.5 * settings.persistent_share**2).all()
    further = replace(VIEW, translation_w0_cam_m=1.3 * MIDDLE_M)
    assert (np.diag(surface_calibration_covariance(surface, further, settings)) > 2.0 * np.diag(found)).all()

"""The fit to the back of the hand, compiled, against NumPy; and what a correction makes of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from carpus.core.compiled import surface as compiled
from carpus.core.model import so3
from carpus.core.model.depth_sensor import AZURE_KINECT, D435, PRIMESENSE, DepthSensor
from carpus.core.model.hand.dorsal_surface import DorsalSurface
from carpus.core.model.types import FloatArray, SurfaceSamples
from carpus.core.tracking.association.palm_association import Measurements, update_palm
from carpus.core.tracking.filter.mixture_filter import ModeMixture
from carpus.core.tracking.filter.palm_state import RELIEF, SIZE, SURFACE, PalmEstimate, PalmView
from carpus.core.tracking.filter.predicted_measurement import predict_measurement, shape_partial_update
from carpus.core.tracking.filter.surface_fit import SurfaceSettings, fit_surface
from carpus.core.tracking.filter.unscented import UnscentedParameters
from tests.compiled.comparing import LAYOUTS, assert_same, laid_out
from tests.compiled.oracle import surface as oracle
from tests.compiled.test_palm import mixture_about
from tests.tracking.hands import CAMERA, FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M
from tests.tracking.test_palm_filter import moving
from tests.tracking.test_surface_fit import get_surface_point
from tests.tracking.test_surface_fit import surface as surface_of_a_hand

surface, SETTINGS = surface_of_a_hand, SurfaceSettings()


def seen_of(seed: int, every: int = 9) -> tuple[PalmEstimate, SurfaceSamples]:
    """A palm a little off, and readings of its back."""
    rng = np.random.default_rng(seed)
    rotation, position = so3.exp(rng.normal(0.0, 0.1, 3)), rng.normal(0.0, 0.005, 3)
    estimate = moving(seed)
    estimate.value[RELIEF], estimate.value[SURFACE] = 0.01 * rng.normal(size=(2, 3))
    estimate.value[:3] = position
    samples = get_surface_point(rotation, position)
    some = SurfaceSamples(samples.pixel[::every].copy(), samples.depth_m[::every] + 1e-3 * rng.normal(size=1))
    return replace(estimate, rotation_w2_w0=rotation @ so3.exp(0.01 * rng.normal(size=3))), some


def view_by(sensor: DepthSensor = PRIMESENSE) -> PalmView:
    return PalmView(replace(CAMERA, sensor=sensor), FROM_ABOVE, MIDDLE_M, RIGHT_PALM_M, np.zeros((6, 18)))


@pytest.mark.parametrize("sensor", [PRIMESENSE, D435, AZURE_KINECT], ids=lambda sensor: sensor.name)
@pytest.mark.parametrize("seed", range(2))
def test_fit_of_any_readings_is_the_oracles(surface: DorsalSurface, sensor: DepthSensor, seed: int) -> None:
    for every in (7, 8, 900):  # an odd and an even number of readings, and too few
        estimate, samples = seen_of(seed, every)
        found = compiled.measure_surface(estimate, samples, surface, view_by(sensor), SETTINGS)
        assert (found is None) == (every == 900)
        assert_same(found, oracle.measure_surface(estimate, samples, surface, view_by(sensor), SETTINGS))


def test_readings_of_something_else_are_no_surface(surface: DorsalSurface) -> None:
    estimate, samples = seen_of(0)
    elsewhere, none = replace(samples, pixel=samples.pixel + 1e4), SurfaceSamples(np.empty((0, 2)), np.empty(0))
    unknown = replace(samples, depth_m=np.full(len(samples.depth_m), np.nan))
    for some in (elsewhere, none, unknown):
        assert compiled.measure_surface(estimate, some, surface, view_by(), SETTINGS) is None
        assert compiled.measure_surface(estimate, some, surface, view_by(), replace(SETTINGS, steps=1)) is None


def test_unknown_reading_leaves_all_unknown_as_oracles_does(surface: DorsalSurface) -> None:
    estimate, samples = seen_of(1)
    samples.depth_m[3] = np.nan
    settings = replace(SETTINGS, steps=1)
    with np.errstate(invalid="ignore"):
        expected = oracle.measure_surface(estimate, samples, surface, view_by(), settings)
    found = compiled.measure_surface(estimate, samples, surface, view_by(), settings)
    assert found is not None
    assert np.isnan(found[0]).all()
    assert_same(found[:2], expected[:2])


@pytest.mark.parametrize("layout", LAYOUTS)
def test_arrays_stored_otherwise_are_read_as_they_are(
    surface: DorsalSurface, layout: Callable[[np.ndarray], np.ndarray]
) -> None:
    estimate, samples = seen_of(2)
    expected = oracle.measure_surface(estimate, samples, surface, view_by(), SETTINGS)
    view = replace(view_by(), rotation_w0_cam=layout(FROM_ABOVE), translation_w0_cam_m=layout(MIDDLE_M))
    found = compiled.measure_surface(laid_out(estimate, layout), laid_out(samples, layout), surface, view, SETTINGS)
    assert_same(found, expected)


def test_sizes_and_types_that_do_not_fit_are_refused(surface: DorsalSurface) -> None:
    estimate, samples = seen_of(0)
    for palm, some in (
        (estimate, replace(samples, pixel=samples.pixel[1:])),
        (estimate, replace(samples, depth_m=samples.depth_m.astype(np.float32))),
        (replace(estimate, rotation_w2_w0=np.eye(2)), samples),
        (replace(estimate, value=estimate.value[:-1]), samples),
    ):
        with pytest.raises(ValueError, match=r"where|dtype"):
            compiled.measure_surface(palm, some, surface, view_by(), SETTINGS)


def test_surface_corrects_palm_only_where_it_can_be_this_one(surface: DorsalSurface) -> None:
    estimate, samples = seen_of(0)
    mixture, partial = mixture_about(estimate, np.random.default_rng(0), 3), shape_partial_update(0.2)
    off = mixture.mean + np.where(np.arange(SIZE) == RELIEF.start, 0.5, 0.0)
    far = replace(mixture, mean=off, covariance=1e-6 * mixture.covariance)

    def is_used(samples: SurfaceSamples, of: ModeMixture = mixture, partial: FloatArray | None = partial) -> bool:
        predicted = predict_measurement(estimate, of, view_by(), UnscentedParameters(), partial)
        found = fit_surface(estimate, samples, surface, view_by(), SETTINGS)
        blobs = Measurements(np.empty((0, 3)), np.empty((0, 3)), found)
        return update_palm(predicted, blobs, np.full(6, -1), np.zeros(6, dtype=bool), np.ones((6, 3))).by_surface

    assert is_used(samples)
    assert is_used(samples, partial=None)
    assert not is_used(samples, far)
    assert not is_used(replace(samples, pixel=samples.pixel + 1e4))

"""The pose of the fixed unit from the surface of the back of the hand: point to plane, Gauss-Newton.

Thousands of depth readings lie on the back of the hand, and six discs. The surface over capitate, second and third
metacarpal turns with the bones while skin glides over them; so it tells how the hand is tilted where the discs, which
ride on the skin, mislead. It tells the turns about X and Y and the height; the rest the discs know better.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from carpus.core.compiled.surface import measure_surface
from carpus.core.model.hand.dorsal_surface import DorsalSurface
from carpus.core.model.types import FloatArray, SurfaceSamples
from carpus.core.tracking.filter.mixture_filter import Linearisation
from carpus.core.tracking.filter.palm_state import SIZE, PalmEstimate, PalmView

NO_NOISE = np.full((1, 3), 1e-12)  # variances of a measurement whose covariance is all there is


@dataclass(frozen=True, slots=True)
class SurfaceSettings:
    """Settings of the surface fit.

    ``steps`` of Gauss-Newton; residuals beyond ``huber_m`` have less weight, beyond ``most_m`` none; with less than
    ``least`` readings the surface is not fitted. Readings nearer to each other than the sensor's patch share the part
    ``shared`` of their variance, which is not of rounding to steps of disparity (clinical reference 7.2: a step is two
    standard deviations), or all of it where the sensor has no such steps; ``reading_per_m`` is a reading's at least,
    over the depth squared. ``turn_sd_rad`` and ``up_sd_m`` that no number of readings takes away from one frame. Beyond
    ``most_nis`` it is not this surface. ``goes_on``: by how much more the error of one frame counts since the next has
    a part of it again; ``stays``: share of it that comes again as long as the hand is still.
    """

    steps: int = 3
    huber_m: float = 0.003
    most_m: float = 0.010
    least: int = 24
    shared: float = 2.0 / 3.0
    reading_per_m: float = 1.5e-3
    turn_sd_rad: float = 0.004
    up_sd_m: float = 0.0002
    most_nis: float = 40.0
    stays: float = 0.6
    goes_on: float = 1.5


@dataclass(frozen=True, slots=True)
class SurfaceMeasurement:
    """Measurement of an estimate's error by the surface: turn about X and Y and height at the surface's middle.

    ``value`` (3,) with ``covariance`` (3, 3), as a ``slope`` (3, n) of the palm's error vector; ``count`` readings were
    used. Beyond a normalised innovation squared of ``max_nis`` it is another surface.
    """

    value: FloatArray
    covariance: FloatArray
    slope: FloatArray
    count: int
    max_nis: float

    def to_linearisation(self) -> Linearisation:
        """Return the measurement, linear about the estimate's mean."""
        return Linearisation(np.zeros((1, 3)), self.slope[None], self.covariance[None], np.zeros((1, SIZE)))

    def extend_measurement(
        self, discs: Linearisation, measured: FloatArray, variance: FloatArray
    ) -> tuple[Linearisation, FloatArray, FloatArray]:
        """Append the three components to a measurement (1, m) about the same mean, for one update by both."""
        own, count = self.to_linearisation(), measured.shape[1]
        error = np.zeros((1, count + 3, count + 3))
        error[:, :count, :count], error[:, count:, count:] = discs.error, own.error
        return (
            Linearisation(
                np.concatenate((discs.value, own.value), axis=1),
                np.concatenate((discs.slope, own.slope), axis=1),
                error,
                discs.point,
            ),
            np.concatenate((measured, self.value[None]), axis=1),
            np.concatenate((variance, NO_NOISE), axis=1),
        )


def fit_surface(
    estimate: PalmEstimate, samples: SurfaceSamples, surface: DorsalSurface, view: PalmView, settings: SurfaceSettings
) -> SurfaceMeasurement | None:
    """Fit the surface to the readings, from the estimate's pose on; None where too few lie on it."""
    found = measure_surface(estimate, samples, surface, view, settings)
    if found is None:
        return None
    value, covariance, slope, count = found
    return SurfaceMeasurement(value, covariance, slope, count, settings.most_nis)


def surface_calibration_covariance(surface: DorsalSurface, view: PalmView, settings: SurfaceSettings) -> FloatArray:
    """Return the covariance (3, 3) of the calibrated surface's own turn about X and Y and height.

    The share ``stays`` of one frame's errors, since these come again in every frame of a still hand and no averaging
    removes them.
    """
    node = surface.node_positions_m()
    in_camera = node @ view.rotation_w0_cam.T + view.translation_w0_cam_m
    samples = SurfaceSamples(view.camera.project(in_camera), in_camera[:, 2])
    neutral = PalmEstimate(np.eye(3), np.zeros(SIZE), np.eye(SIZE))
    bare = replace(settings, turn_sd_rad=0.0, up_sd_m=0.0, goes_on=1.0)
    found = fit_surface(neutral, samples, surface, view, bare)
    return np.eye(3) if found is None else settings.stays**2 * found.covariance

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

    Attributes
    ----------
    iterations : int
        Gauss-Newton iterations.
    huber_m, max_residual_m : float
        Residuals beyond the first have less weight (Huber), beyond the second none.
    min_readings : int
        With fewer depth readings the surface is not fitted.
    shared_variance_share : float
        Share of the variance that readings within the sensor's matching window have in common: all that is not rounding
        to steps of disparity (clinical reference 7.2: a step is two standard deviations). 1 for a sensor without steps.
    min_reading_sd_per_m : float
        Lower limit of a reading's standard deviation over its depth squared.
    turn_sd_rad, height_sd_m : float
        Standard deviations that no number of readings reduces within one frame.
    max_nis : float
        Beyond this normalised innovation squared it is another surface.
    persistent_share, persistence_factor : float
        Share of the error that comes again in each frame of a still hand, and the factor by which a frame's error
        counts more for it.
    """

    iterations: int = 3
    huber_m: float = 0.003
    max_residual_m: float = 0.010
    min_readings: int = 24
    shared_variance_share: float = 2.0 / 3.0
    min_reading_sd_per_m: float = 1.5e-3
    turn_sd_rad: float = 0.004
    height_sd_m: float = 0.0002
    max_nis: float = 40.0
    persistent_share: float = 0.6
    persistence_factor: float = 1.5


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

    def extend_measurement(
        self, discs: Linearisation, measured: FloatArray, variance: FloatArray
    ) -> tuple[Linearisation, FloatArray, FloatArray]:
        """Append the three components to a measurement (1, m) about the same mean, for one update by both."""
        count = measured.shape[1]
        error = np.zeros((1, count + 3, count + 3))
        error[:, :count, :count], error[:, count:, count:] = discs.error, self.covariance
        return (
            Linearisation(
                np.concatenate((discs.value, np.zeros((1, 3))), axis=1),
                np.concatenate((discs.slope, self.slope[None]), axis=1),
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
    return SurfaceMeasurement(value, covariance, slope, count, settings.max_nis)


def surface_calibration_covariance(surface: DorsalSurface, view: PalmView, settings: SurfaceSettings) -> FloatArray:
    """Return the covariance (3, 3) of the calibrated surface's own turn about X and Y and height.

    It is ``persistent_share`` of one frame's error: that comes again in every frame of a still hand, and no averaging
    removes it.
    """
    node = surface.node_positions_m()
    in_camera = node @ view.rotation_w0_cam.T + view.translation_w0_cam_m
    samples = SurfaceSamples(view.camera.project(in_camera), in_camera[:, 2])
    neutral = PalmEstimate(np.eye(3), np.zeros(SIZE), np.eye(SIZE))
    bare = replace(settings, turn_sd_rad=0.0, height_sd_m=0.0, persistence_factor=1.0)
    found = fit_surface(neutral, samples, surface, view, bare)
    return np.eye(3) if found is None else settings.persistent_share**2 * found.covariance

"""The tracker: the only part of the walk that remembers.

For every frame it forecasts where the discs are, lets the association name the blobs, corrects the belief
and states the angles with their standard deviations. It reads no picture and writes no file.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from core.calibration.result import Calibration
from core.camera import Camera
from core.tracking import association, modes
from core.tracking.geometry import geometry_for
from core.tracking.measurement import Forecast, View, forecast_augmented, forecast_of, forecast_reduced, update
from core.tracking.reacquire import find_palm
from core.tracking.readout import Readout, lost_readout
from core.tracking.settings import TrackerSettings
from core.tracking.state import Belief, StateLayout, resting_belief, stack
from core.types import Detections, FloatArray, TrackedFrame, TrackStatus

SHARE_WINDOW_S = 1.0
LEAST_PALM_MARKERS = 3


@dataclass(frozen=True, slots=True)
class Expectation:
    """Where the discs should be in the next frame: pixels (M, 2) with covariance (M, 2, 2), depths (M,)."""

    pixel: FloatArray
    covariance_px2: FloatArray
    depth_m: FloatArray


@dataclass(frozen=True, slots=True)
class FilterStep:
    """One step of the filter for the smoother: the corrected belief, how it was predicted, when.

    ``noise_scale`` of the process noise that led to it; ``linked`` False where the track began anew.
    """

    timestamp_s: float
    belief: Belief | None
    noise_scale: float
    linked: bool


class Tracker:
    """Tracks one calibrated hand through frames in order of time."""

    def __init__(self, calibration: Calibration, camera: Camera, settings: TrackerSettings) -> None:
        self.settings = settings
        self._calibration = calibration
        self._protocol = calibration.clicks.protocol
        self._palm = np.array(self._protocol.palm)
        geometry, shape_covariance = geometry_for(calibration, settings.refine_shape)
        self.layout = StateLayout(0, settings.motion == "constant_rate", shape_covariance.shape[0])
        self.view = View(camera, calibration.rotation_w0_cam, calibration.translation_w0_cam_m, geometry)
        self._shape = np.zeros(shape_covariance.shape[0])
        self._shape_covariance = shape_covariance
        self._scales = np.array(settings.mode_scales if settings.motion == "constant_rate" else (1.0,))
        self._resolution_px2 = float(camera.width_px * camera.height_px)
        self._readout = Readout(calibration, self.layout)
        self._recent: deque[tuple[float, float]] = deque()
        self._beliefs: Belief | None = None
        self._probability = np.ones(self._scales.size) / self._scales.size
        self._time_s: float | None = None
        self._seen_s = 0.0
        self._unsure_frames = 0
        self._forecast: tuple[float, Forecast, FloatArray] | None = None
        self.history: list[FilterStep] = []
        self.begin_at_neutral()

    def begin_at_neutral(self) -> None:
        """Start (again) from the calibrated pose, the hand at rest."""
        _, self._shape_covariance = geometry_for(self._calibration, self.settings.refine_shape)
        self._shape = np.zeros(self._shape_covariance.shape[0])
        start = resting_belief(self.layout, self.settings.initial, shape_covariance=self._shape_covariance)
        self._begin(start)

    def _begin(self, belief: Belief) -> None:
        count = self._scales.size
        self._beliefs = stack([belief] * count)
        self._probability = np.ones(count) / count
        self._forecast = None

    @property
    def is_lost(self) -> bool:
        return self._beliefs is None

    def expect(self, timestamp_s: float) -> Expectation | None:
        """Where to look at that time; None when the hand is lost."""
        if self._beliefs is None:
            return None
        forecast, predicted = self._forecast_at(timestamp_s)
        mean, covariance = _merged_markers(forecast, predicted)
        return Expectation(mean[:, :2], covariance[:, :2, :2], mean[:, 2])

    def _forecast_at(self, timestamp_s: float) -> tuple[Forecast, FloatArray]:
        if self._forecast is not None and self._forecast[0] == timestamp_s:
            return self._forecast[1], self._forecast[2]
        assert self._beliefs is not None
        settings, layout = self.settings, self.layout
        noise = settings.motion_noise
        dt_s = 0.0 if self._time_s is None else timestamp_s - self._time_s
        if dt_s <= 0.0:
            # The first frame: the belief already is of this moment.
            forecast, predicted = forecast_of(self._beliefs, layout, self.view, settings.spread), self._probability
        else:
            switch = modes.switching(self._scales.size, settings.mode_dwell_s, dt_s)
            mixed, predicted = modes.mix(self._beliefs, self._probability, switch, layout)
            if settings.form == "reduced":
                forecast = forecast_reduced(mixed, noise, self._scales, dt_s, layout, self.view, settings.spread)
            else:
                forecast = _stack_forecasts(
                    [
                        forecast_augmented(mixed.pick(k), noise, float(s), dt_s, layout, self.view, settings.spread)
                        for k, s in enumerate(self._scales)
                    ]
                )
        self._forecast = (timestamp_s, forecast, predicted)
        return forecast, predicted

    def step(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int = 0) -> TrackedFrame:
        """Associate the blobs of one frame and correct the belief; the frame's result."""
        marker_count = len(self._protocol.markers)
        measured_px = np.full((marker_count, 2), np.nan)
        measured_depth_m = np.full(marker_count, np.nan)
        ideal = replace(detections, pixel=self.view.camera.undistort(detections.pixel))
        linked = True
        if self._beliefs is None:
            found = find_palm(ideal, self.view, self.settings)
            if found is not None:
                self._begin(self._belief_found(*found[:2]))
                self._seen_s, linked, self._time_s = timestamp_s, False, timestamp_s
        if self._beliefs is None:
            self._remember(timestamp_s, 0.0)
            self.history.append(FilterStep(timestamp_s, None, 1.0, False))
            self._time_s = timestamp_s
            return lost_readout(index, timestamp_s, detections, dropped_before, marker_count, self._share())
        forecast, predicted = self._forecast_at(timestamp_s)
        marker_mean, marker_covariance = _merged_markers(forecast, predicted)
        rows, values, variances, taken = self._choose(marker_mean, marker_covariance, ideal)
        beliefs, innovation = update(forecast, rows, values, variances, self.layout)
        probability = modes.reweigh(predicted, innovation.log_likelihood) if rows.size else predicted
        self._beliefs, self._probability = beliefs, probability
        self._forecast = None
        merged = modes.merge(beliefs, probability, self.layout)
        self._shape, self._shape_covariance = merged.shape, merged.covariance[self.layout.shape, self.layout.shape]
        used = np.flatnonzero(taken >= 0)
        measured_px[used] = detections.pixel[taken[used]]
        measured_depth_m[used] = detections.depth_m[taken[used]]
        palm_seen = int(np.count_nonzero(taken[self._palm] >= 0))
        status = TrackStatus.TRACKED if palm_seen >= LEAST_PALM_MARKERS else TrackStatus.PREDICTED
        dt_s = 0.0 if self._time_s is None else timestamp_s - self._time_s
        self._time_s = timestamp_s
        if status is TrackStatus.TRACKED:
            self._seen_s = timestamp_s
        else:
            self._fade(dt_s)
        self._remember(timestamp_s, palm_seen / self._palm.size)
        scale = float(np.sqrt(probability @ self._scales**2))
        self.history.append(FilterStep(timestamp_s, merged, scale, linked))
        noise_px = np.eye(2) * self.settings.noise.pixel_sd_px**2
        tracked = self._readout.frame(
            index,
            timestamp_s,
            status,
            merged,
            self.view,
            predicted_px=self.view.camera.distort(marker_mean[:, :2]),
            predicted_cov_px2=marker_covariance[:, :2, :2] + noise_px,
            measured_px=measured_px,
            measured_depth_m=measured_depth_m,
            detections=detections,
            dropped_before=dropped_before,
            measured_share=self._share(),
            nis=float(probability @ innovation.nis) if rows.size else float("nan"),
            nis_dof=innovation.dof,
        )
        self._look_out(timestamp_s, status, ideal, palm_seen)
        if self._beliefs is None and status is TrackStatus.PREDICTED:
            self.history[-1] = FilterStep(timestamp_s, None, 1.0, False)
            return lost_readout(index, timestamp_s, detections, dropped_before, marker_count, self._share())
        return tracked

    def _choose(
        self, marker_mean: FloatArray, marker_covariance: FloatArray, ideal: Detections
    ) -> tuple[NDArray[np.int64], FloatArray, FloatArray, NDArray[np.int64]]:
        """Rows, values and variances of the measurements taken, and the blob of every marker."""
        settings = self.settings
        noise, use_depth = settings.noise, settings.use_depth
        depth = ideal.depth_m if use_depth else np.full_like(ideal.depth_m, np.nan)
        radius_px = self.view.camera.fx_px * settings.marker_radius_m / np.maximum(marker_mean[:, 2], 0.1)
        shown = np.clip(ideal.area_px / (np.pi * float(np.median(radius_px)) ** 2), 0.0, 1.0)
        wander_px = noise.shade_share * float(np.median(radius_px)) * np.clip(0.6 - shown, 0.0, None)
        pixel_variance = noise.pixel_sd_px**2 + wander_px**2
        depth_variance = np.where(np.isfinite(depth), ideal.depth_sd_m, 1.0) ** 2 + noise.depth_sd_m**2
        variance = np.stack((pixel_variance, pixel_variance, depth_variance), axis=1)
        measured = np.column_stack((ideal.pixel, depth))
        odds = association.log_odds(
            marker_mean, marker_covariance, measured, variance, self._resolution_px2, settings.association
        )
        without_depth = np.column_stack((ideal.pixel, np.full(len(ideal), np.nan)))
        rows: list[int] = []
        values: list[float] = []
        variances: list[float] = []
        odds_flat = association.log_odds(
            marker_mean, marker_covariance, without_depth, variance, self._resolution_px2, settings.association
        )
        # A disc whose depth is of something before or behind it is still that disc, if rarely.
        astray = np.where(odds_flat > association.IMPOSSIBLE, odds_flat + np.log(noise.depth_outlier), odds_flat)
        taken = association.resolve(np.maximum(odds, astray))
        for marker, blob in enumerate(taken):
            if blob < 0:
                continue
            with_depth = bool(np.isfinite(depth[blob])) and odds[marker, blob] >= astray[marker, blob]
            for axis in range(3 if with_depth else 2):
                rows.append(3 * marker + axis)
                values.append(measured[blob, axis])
                variances.append(variance[blob, axis])
        return np.array(rows, dtype=np.int64), np.array(values), np.array(variances), taken

    def _fade(self, dt_s: float) -> None:
        """An unseen hand is not taken to go on for ever: its velocity fades, its uncertainty grows."""
        assert self._beliefs is not None
        keep = float(np.exp(-dt_s / self.settings.rate_memory_s))
        self._beliefs = replace(
            self._beliefs,
            velocity_m_s=self._beliefs.velocity_m_s * keep,
            rate_rad_s=self._beliefs.rate_rad_s * keep,
        )

    def _look_out(self, timestamp_s: float, status: TrackStatus, ideal: Detections, palm_seen: int) -> None:
        """Give up a track that no picture supports, and take up a better one where the palm plainly is."""
        if status is TrackStatus.TRACKED and palm_seen >= LEAST_PALM_MARKERS + 1:
            self._unsure_frames = 0
            return
        self._unsure_frames += 1
        if timestamp_s - self._seen_s > self.settings.lost_after_s:
            self._beliefs = None
            return
        if self._unsure_frames >= 3 and len(ideal) > palm_seen + 1:
            found = find_palm(ideal, self.view, self.settings)
            if found is not None and found[2] > max(palm_seen, LEAST_PALM_MARKERS):
                self._begin(self._belief_found(*found[:2]))
                self._unsure_frames = 0

    def _belief_found(self, position_m: FloatArray, rotation_w2_w0: FloatArray) -> Belief:
        initial = replace(self.settings.initial, position_m=0.004, turn_rad=0.08, velocity_m_s=0.5, rate_rad_s=2.0)
        belief = resting_belief(
            self.layout,
            initial,
            position_m=position_m,
            rotation_w2_w0=rotation_w2_w0,
            shape_covariance=self._shape_covariance,
        )
        return replace(belief, shape=self._shape)

    def _remember(self, timestamp_s: float, share: float) -> None:
        self._recent.append((timestamp_s, share))
        while self._recent and self._recent[0][0] < timestamp_s - SHARE_WINDOW_S:
            self._recent.popleft()

    def _share(self) -> FloatArray:
        return np.full(3, float(np.mean([share for _, share in self._recent])) if self._recent else 0.0)


def _merged_markers(forecast: Forecast, probability: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Predicted measurements (M, 3) and covariance (M, 3, 3) over all modes: (10) and (11) of a mixture."""
    mean = np.tensordot(probability, forecast.marker_mean, axes=1)
    apart = forecast.marker_mean - mean
    between = np.einsum("k,kmi,kmj->mij", probability, apart, apart)
    return mean, np.tensordot(probability, forecast.marker_covariance, axes=1) + between


def _stack_forecasts(forecasts: list[Forecast]) -> Forecast:
    return Forecast(
        stack([f.belief for f in forecasts]),
        np.stack([f.marker_mean for f in forecasts]),
        np.stack([f.marker_covariance for f in forecasts]),
        np.stack([f.state_deviation for f in forecasts]),
        np.stack([f.marker_deviation for f in forecasts]),
        forecasts[0].weight,
    )

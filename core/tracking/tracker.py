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
from core.depth_noise import pattern_sd_m, reading_sd_m
from core.tracking import association, modes
from core.tracking.geometry import geometry_for
from core.tracking.joint_association import associate_jointly, holds_together
from core.tracking.measurement import Forecast, View, forecast_augmented, forecast_of, forecast_reduced, update
from core.tracking.reacquire import find_palm
from core.tracking.readout import Readout, lost_moment, lost_readout
from core.tracking.settings import TrackerSettings
from core.tracking.smoother import FilterStep, smooth
from core.tracking.state import Belief, StateLayout, resting_belief, stack
from core.types import Detections, FloatArray, Moment, TrackedFrame, TrackStatus

SHARE_WINDOW_S = 1.0
_AXES = np.arange(3)
LEAST_PALM_MARKERS = 3


@dataclass(frozen=True, slots=True)
class Expectation:
    """Where the discs should be in the next frame: pixels (M, 2) with covariance (M, 2, 2), depths (M,)."""

    pixel: FloatArray
    covariance_px2: FloatArray
    depth_m: FloatArray


@dataclass(frozen=True, slots=True)
class _Measurable:
    value: FloatArray
    variance: FloatArray


@dataclass(frozen=True, slots=True)
class _Names:
    taken: NDArray[np.int64]
    with_depth: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class _Corrected:
    beliefs: Belief
    probability: FloatArray
    names: _Names
    nis: float
    nis_dof: int
    rows: NDArray[np.int64]
    residual: FloatArray


class Tracker:
    """Tracks one calibrated hand through frames in order of time."""

    def __init__(
        self, calibration: Calibration, camera: Camera, settings: TrackerSettings, *, keep_history: bool = True
    ) -> None:
        self.settings = settings
        self._keep_history = keep_history
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
        self._noise_factor = np.ones((len(self._protocol.markers), 3))
        self._recent: deque[tuple[float, float]] = deque()
        self._beliefs: Belief | None = None
        self._probability = np.ones(self._scales.size) / self._scales.size
        self._time_s: float | None = None
        self._seen_s = -np.inf
        self._begun_s = -np.inf
        self._anew = True
        self._forecast: tuple[float, Forecast, FloatArray] | None = None
        self.history: list[FilterStep] = []
        self.begin_at_neutral()

    def begin_at_neutral(self) -> None:
        """Start (again) from the calibrated pose, the hand at rest."""
        _, self._shape_covariance = geometry_for(self._calibration, self.settings.refine_shape)
        self._shape = np.zeros(self._shape_covariance.shape[0])
        start = resting_belief(self.layout, self.settings.initial, shape_covariance=self._shape_covariance)
        self._begin(start)
        self._anew = True

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
        linked, self._anew = not self._anew, False
        if not linked:
            self._begun_s = timestamp_s
        if self._beliefs is None:
            found = find_palm(ideal, self.view, self.settings)
            if found is not None:
                self._begin(self._belief_found(*found[:2]))
                self._seen_s, linked, self._time_s = timestamp_s, False, timestamp_s
        if self._beliefs is None:
            self._remember(timestamp_s, 0.0)
            self._keep(FilterStep(timestamp_s, None, 1.0, False))
            self._time_s = timestamp_s
            return lost_readout(index, timestamp_s, detections, dropped_before, marker_count, self._share())
        forecast, predicted = self._forecast_at(timestamp_s)
        marker_mean, marker_covariance = _merged_markers(forecast, predicted)
        blobs = self._measurable(marker_mean, ideal)
        corrected = self._associate(forecast, predicted, marker_mean, marker_covariance, blobs)
        seen = self._palm_seen(corrected)
        if seen <= LEAST_PALM_MARKERS and len(ideal) > seen:
            # Too little of the palm is where it was expected: perhaps it is plainly elsewhere.
            found = find_palm(ideal, self.view, self.settings)
            if found is not None and found[2] > seen:
                self._begin(self._belief_found(*found[:2]))
                forecast = forecast_of(self._beliefs, self.layout, self.view, self.settings.spread)
                predicted, linked = self._probability, False
                marker_mean, marker_covariance = _merged_markers(forecast, predicted)
                corrected = self._associate(forecast, predicted, marker_mean, marker_covariance, blobs)
        taken, probability = corrected.names.taken, corrected.probability
        self._beliefs, self._probability = corrected.beliefs, probability
        self._forecast = None
        self._judge_noise(corrected, timestamp_s)
        merged = modes.merge(corrected.beliefs, probability, self.layout)
        self._shape, self._shape_covariance = merged.shape, merged.covariance[self.layout.shape, self.layout.shape]
        used = np.flatnonzero(taken >= 0)
        measured_px[used] = detections.pixel[taken[used]]
        measured_depth_m[used] = detections.depth_m[taken[used]]
        palm_seen = self._palm_seen(corrected)
        status = TrackStatus.TRACKED if palm_seen >= LEAST_PALM_MARKERS else TrackStatus.PREDICTED
        dt_s = 0.0 if self._time_s is None else timestamp_s - self._time_s
        self._time_s = timestamp_s
        if status is TrackStatus.TRACKED:
            self._seen_s = timestamp_s
        else:
            self._fade(dt_s)
        self._remember(timestamp_s, palm_seen / self._palm.size)
        scale = float(np.sqrt(probability @ self._scales**2))
        self._keep(FilterStep(timestamp_s, merged, scale, linked))
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
            nis=corrected.nis,
            nis_dof=corrected.nis_dof,
        )
        if timestamp_s - max(self._seen_s, self._begun_s) > self.settings.lost_after_s:
            self._beliefs = None
            if self.history:
                self.history[-1] = FilterStep(timestamp_s, None, 1.0, False)
            return lost_readout(index, timestamp_s, detections, dropped_before, marker_count, self._share())
        return tracked

    def _measurable(self, marker_mean: FloatArray, ideal: Detections) -> _Measurable:
        """Blobs as measurements (D, 3) with their noise variances (D, 3)."""
        noise = self.settings.noise
        depth = ideal.depth_m if self.settings.use_depth else np.full_like(ideal.depth_m, np.nan)
        radius_px = self.view.camera.fx_px * self.settings.marker_radius_m / max(float(marker_mean[0, 2]), 0.1)
        shown = ideal.area_px / (np.pi * radius_px**2)
        wander_px = noise.shade_share * radius_px * np.maximum(0.6 - shown, 0.0)
        pixel_variance = noise.pixel_sd_px**2 + wander_px**2
        known = np.isfinite(depth)
        at_m = np.where(known, depth, 1.0)
        book2 = reading_sd_m(at_m) ** 2
        beyond2 = np.maximum(np.where(known, ideal.depth_sd_m, 1.0) ** 2 - book2, 0.0)
        depth_variance = noise.depth_ratio**2 * book2 + beyond2 + pattern_sd_m(at_m) ** 2
        variance = np.stack((pixel_variance, pixel_variance, depth_variance), axis=1)
        return _Measurable(np.column_stack((ideal.pixel, depth)), variance)

    def _corrected(self, forecast: Forecast, predicted: FloatArray, blobs: _Measurable, names: _Names) -> _Corrected:
        """All modes corrected by the blobs as named, and how well the whole hangs together."""
        marker = np.flatnonzero(names.taken >= 0)
        used = (_AXES < 2) | names.with_depth[marker, None]
        rows = (3 * marker[:, None] + _AXES)[used]
        blob = names.taken[marker]
        variance = (blobs.variance[blob] * self._noise_factor[marker])[used]
        beliefs, innovation = update(forecast, rows, blobs.value[blob][used], variance, self.layout)
        if rows.size == 0:
            return _Corrected(beliefs, predicted, names, float("nan"), 0, rows, np.empty(0))
        probability = modes.reweigh(predicted, innovation.log_likelihood)
        nis = float(probability @ innovation.nis)
        return _Corrected(beliefs, probability, names, nis, innovation.dof, rows, probability @ innovation.residual)

    def _associate(
        self, forecast: Forecast, predicted: FloatArray, mean: FloatArray, covariance: FloatArray, blobs: _Measurable
    ) -> _Corrected:
        """Names by (12); where they do not hold together, the most probable names of all blobs jointly."""
        settings = self.settings
        odds = association.log_odds(
            mean,
            covariance,
            blobs.value,
            blobs.variance,
            self._resolution_px2,
            settings.noise.depth_outlier,
            settings.association,
        )
        taken = association.resolve(odds.value)
        with_depth = odds.with_depth[np.arange(taken.size), taken] if len(blobs.value) else np.zeros(taken.size, bool)
        simple = self._corrected(forecast, predicted, blobs, _Names(taken, with_depth & (taken >= 0)))
        missing = np.count_nonzero(taken < 0)
        free = len(blobs.value) - (taken.size - missing)
        enough = np.count_nonzero(taken[self._palm] >= 0) > LEAST_PALM_MARKERS or free == 0
        if holds_together(simple.nis, simple.nis_dof) and enough:
            return simple
        all_mean, all_covariance = _joint_markers(forecast, predicted)
        found = associate_jointly(
            all_mean,
            all_covariance,
            blobs.value,
            blobs.variance,
            self._resolution_px2,
            settings.noise.depth_outlier,
            settings.association,
        )
        return self._corrected(forecast, predicted, blobs, _Names(found.taken, found.with_depth))

    def _judge_noise(self, corrected: _Corrected, timestamp_s: float) -> None:
        """Let each marker's noise follow its residuals: a disc half behind the rim, a blurred picture."""
        if corrected.rows.size == 0 or self._time_s is None:
            return
        noise = self.settings.noise
        weight = 1.0 - np.exp(-max(timestamp_s - self._time_s, 0.0) / noise.adapt_s)
        marker, axis = np.divmod(corrected.rows, 3)
        squared = np.minimum(corrected.residual**2, noise.most_adapted)
        for axes in ((0, 1), (2,)):
            mine = np.isin(axis, axes)
            if not mine.any():
                continue
            total = np.bincount(marker[mine], squared[mine], len(self._noise_factor))
            count = np.bincount(marker[mine], minlength=len(self._noise_factor))
            seen = count > 0
            grown = 1.0 + weight * (total[seen] / count[seen] - 1.0)
            for column in axes:
                factor = self._noise_factor[seen, column] * grown
                self._noise_factor[seen, column] = np.clip(factor, 1.0, noise.most_adapted)

    def _fade(self, dt_s: float) -> None:
        """An unseen hand is not taken to go on for ever: its velocity fades, its uncertainty grows."""
        assert self._beliefs is not None
        keep = float(np.exp(-dt_s / self.settings.rate_memory_s))
        self._beliefs = replace(
            self._beliefs,
            velocity_m_s=self._beliefs.velocity_m_s * keep,
            rate_rad_s=self._beliefs.rate_rad_s * keep,
        )

    def would_miss(self, blobs: Detections) -> bool:
        """Whether blobs of a narrowed search are too few to hold the palm, so that the rest is worth a look."""
        return len(blobs) <= LEAST_PALM_MARKERS

    def _keep(self, step: FilterStep) -> None:
        if self._keep_history:
            self.history.append(step)

    def smoothed(self) -> list[Moment]:
        """Every frame so far in the light of all the others; needs the history kept."""
        beliefs = smooth(self.history, self.settings.motion_noise, self.layout)
        return [lost_moment() if belief is None else self._readout.moment(belief) for belief in beliefs]

    def _palm_seen(self, corrected: _Corrected) -> int:
        return int(np.count_nonzero(corrected.names.taken[self._palm] >= 0))

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


def _joint_markers(forecast: Forecast, probability: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean (3M,) and covariance (3M, 3M) of all markers' measurements together."""
    flat = forecast.marker_deviation.reshape(*forecast.marker_deviation.shape[:-2], -1)
    covariance = np.swapaxes(flat * forecast.weight[:, None], -1, -2) @ flat
    means = forecast.marker_mean.reshape(probability.size, -1)
    mean = probability @ means
    apart = means - mean
    return mean, np.tensordot(probability, covariance, axes=1) + (apart.T * probability) @ apart


def _stack_forecasts(forecasts: list[Forecast]) -> Forecast:
    return Forecast(
        stack([f.belief for f in forecasts]),
        np.stack([f.marker_mean for f in forecasts]),
        np.stack([f.marker_covariance for f in forecasts]),
        np.stack([f.state_deviation for f in forecasts]),
        np.stack([f.marker_deviation for f in forecasts]),
        forecasts[0].weight,
    )

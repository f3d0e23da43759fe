"""The tracker: the only part of the walk that remembers.

For every frame it forecasts where the discs are, lets the association name the blobs, corrects the belief
and states the angles with their standard deviations. It reads no picture and writes no file.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace

import numpy as np

from core.calibration.result import Calibration
from core.camera import Camera
from core.tracking import modes
from core.tracking.geometry import geometry_for
from core.tracking.measurement import Forecast, View, forecast, forecast_augmented, forecast_reduced
from core.tracking.modes import ModeBank
from core.tracking.naming import Corrected, measurable, name_and_correct
from core.tracking.noise_watch import watched
from core.tracking.reacquire import find_palm
from core.tracking.readout import Readout, lost_moment, lost_readout
from core.tracking.settings import TrackerSettings
from core.tracking.smoother import FilterStep, smooth
from core.tracking.state import Belief, StateLayout, resting_belief
from core.types import Detections, FloatArray, Moment, TrackedFrame, TrackStatus

SHARE_WINDOW_S = 1.0
_UV = np.arange(2)
LEAST_PALM_MARKERS = 3


@dataclass(frozen=True, slots=True)
class Expectation:
    """Where the discs should be in the next frame: pixels (M, 2) with covariance (M, 2, 2), depths (M,)."""

    pixel: FloatArray
    covariance_px2: FloatArray
    depth_m: FloatArray


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
        self._scales = np.array(settings.mode_scales if settings.motion == "constant_rate" else (1.0,))
        self._resolution_px2 = float(camera.width_px * camera.height_px)
        self._readout = Readout(calibration, self.layout)
        self._noise_factor = np.ones((len(self._protocol.markers), 3))
        self._recent: deque[tuple[float, float]] = deque()
        self._bank: ModeBank | None = None
        self._shape = np.zeros(shape_covariance.shape[0])
        self._shape_covariance = shape_covariance
        self._time_s: float | None = None
        self._seen_s = -np.inf
        self._begun_s = -np.inf
        self._anew = True
        self._forecast: tuple[float, Forecast] | None = None
        self.history: list[FilterStep] = []
        self.begin_at_neutral()

    def begin_at_neutral(self) -> None:
        """Start (again) from the calibrated pose, the hand at rest."""
        _, self._shape_covariance = geometry_for(self._calibration, self.settings.refine_shape)
        self._shape = np.zeros(self._shape_covariance.shape[0])
        start = resting_belief(self.layout, self.settings.initial, shape_covariance=self._shape_covariance)
        self._begin(start)
        self._anew = True

    def _begin(self, belief: Belief) -> ModeBank:
        self._bank = ModeBank.of(belief, self._scales.size)
        self._forecast = None
        return self._bank

    @property
    def is_lost(self) -> bool:
        return self._bank is None

    def expect(self, timestamp_s: float) -> Expectation | None:
        """Where to look at that time; None when the hand is lost."""
        if self._bank is None:
            return None
        mean, covariance = self._forecast_at(timestamp_s, self._bank).mixture()
        place = 3 * np.arange(mean.size // 3)[:, None] + _UV
        return Expectation(mean[place], covariance[place[:, :, None], place[:, None, :]], mean[2::3])

    def _forecast_at(self, timestamp_s: float, bank: ModeBank) -> Forecast:
        if self._forecast is not None and self._forecast[0] == timestamp_s:
            return self._forecast[1]
        settings, layout = self.settings, self.layout
        dt_s = 0.0 if self._time_s is None else timestamp_s - self._time_s
        if dt_s <= 0.0:
            # The first frame: the belief already is of this moment.
            found = forecast(bank, layout, self.view, settings.spread)
        else:
            switch = modes.switching(self._scales.size, settings.mode_dwell_s, dt_s)
            form = forecast_reduced if settings.form == "reduced" else forecast_augmented
            found = form(
                modes.mixed(bank, switch), settings.motion_noise, self._scales, dt_s, layout, self.view, settings.spread
            )
        self._forecast = (timestamp_s, found)
        return found

    def step(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int = 0) -> TrackedFrame:
        """Associate the blobs of one frame and correct the belief; the frame's result."""
        ideal = detections
        if self.view.camera.is_distorted:
            ideal = replace(detections, pixel=self.view.camera.undistort(detections.pixel))
        linked, self._anew = not self._anew, False
        if not linked:
            self._begun_s = timestamp_s
        if self._bank is None:
            found = find_palm(ideal, self.view, self.settings)
            if found is None:
                return self._lost(index, timestamp_s, detections, dropped_before)
            self._begin(self._belief_found(*found[:2]))
            self._seen_s, linked, self._time_s = timestamp_s, False, timestamp_s
        assert self._bank is not None
        ahead = self._forecast_at(timestamp_s, self._bank)
        corrected = self._named(ahead, ideal)
        seen = self._palm_seen(corrected)
        if seen <= LEAST_PALM_MARKERS and len(ideal) > seen:
            # Too little of the palm is where it was expected: perhaps it is plainly elsewhere.
            found = find_palm(ideal, self.view, self.settings)
            if found is not None and found[2] > seen:
                bank = self._begin(self._belief_found(*found[:2]))
                ahead, linked = forecast(bank, self.layout, self.view, self.settings.spread), False
                corrected = self._named(ahead, ideal)
                seen = self._palm_seen(corrected)
        dt_s = 0.0 if self._time_s is None else timestamp_s - self._time_s
        self._time_s, self._forecast = timestamp_s, None
        self._noise_factor = watched(self._noise_factor, corrected, dt_s, self.settings.noise)
        bank = modes.merged(corrected.bank, self.layout)
        belief = bank.nominal
        self._shape, self._shape_covariance = belief.shape, belief.covariance[self.layout.shape, self.layout.shape]
        self._remember(timestamp_s, seen / self._palm.size)
        if seen >= LEAST_PALM_MARKERS:
            status, self._bank, self._seen_s = TrackStatus.TRACKED, bank, timestamp_s
        elif timestamp_s - max(self._seen_s, self._begun_s) > self.settings.lost_after_s:
            return self._lost(index, timestamp_s, detections, dropped_before)
        else:
            # An unseen hand is not taken to go on for ever: its velocity fades, its uncertainty grows.
            keep = float(np.exp(-dt_s / self.settings.rate_memory_s))
            status, self._bank = TrackStatus.PREDICTED, modes.slowed(bank, keep, self.layout)
        if self._keep_history:
            scale = float(np.sqrt(bank.probability @ self._scales**2))
            self.history.append(FilterStep(timestamp_s, belief, scale, linked))
        return self._shown(index, timestamp_s, status, belief, ahead, corrected, detections, dropped_before)

    def _named(self, ahead: Forecast, ideal: Detections) -> Corrected:
        depth_m = max(float(ahead.marker_mean[0, 2]), 0.1)
        radius_px = self.view.camera.fx_px * self.settings.marker_radius_m / depth_m
        return name_and_correct(
            ahead,
            measurable(ideal, radius_px, self.settings),
            self._palm,
            LEAST_PALM_MARKERS + 1,
            self._resolution_px2,
            self._noise_factor,
            self.settings,
        )

    def _shown(
        self,
        index: int,
        timestamp_s: float,
        status: TrackStatus,
        belief: Belief,
        ahead: Forecast,
        corrected: Corrected,
        detections: Detections,
        dropped_before: int,
    ) -> TrackedFrame:
        """The row of a tracked or predicted frame."""
        taken = corrected.taken
        used = np.flatnonzero(taken >= 0)
        measured_px = np.full((taken.size, 2), np.nan)
        measured_depth_m = np.full(taken.size, np.nan)
        measured_px[used] = detections.pixel[taken[used]]
        measured_depth_m[used] = detections.depth_m[taken[used]]
        mean, covariance = ahead.mixture()
        place = 3 * np.arange(taken.size)[:, None] + _UV
        predicted_cov_px2 = covariance[place[:, :, None], place[:, None, :]]
        predicted_cov_px2[:, _UV, _UV] += self.settings.noise.pixel_sd_px**2
        return self._readout.frame(
            index,
            timestamp_s,
            status,
            belief,
            self.view,
            predicted_px=self.view.camera.distort(mean[place]),
            predicted_cov_px2=predicted_cov_px2,
            measured_px=measured_px,
            measured_depth_m=measured_depth_m,
            detections=detections,
            dropped_before=dropped_before,
            measured_share=self._share(),
            nis=corrected.nis,
            nis_dof=corrected.dof,
        )

    def _lost(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int) -> TrackedFrame:
        self._bank, self._forecast, self._time_s = None, None, timestamp_s
        self._remember(timestamp_s, 0.0)
        if self._keep_history:
            self.history.append(FilterStep(timestamp_s, None, 1.0, False))
        count = len(self._protocol.markers)
        return lost_readout(index, timestamp_s, detections, dropped_before, count, self._share())

    def would_miss(self, blobs: Detections) -> bool:
        """Whether blobs of a narrowed search are too few to hold the palm, so that the rest is worth a look."""
        return len(blobs) <= LEAST_PALM_MARKERS

    def smoothed(self) -> list[Moment]:
        """Every frame so far in the light of all the others; needs the history kept. Tracking may go on meanwhile."""
        beliefs = smooth(list(self.history), self.settings.motion_noise, self.layout)
        return [lost_moment() if belief is None else self._readout.moment(belief) for belief in beliefs]

    def _palm_seen(self, corrected: Corrected) -> int:
        return int(np.count_nonzero(corrected.taken[self._palm] >= 0))

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

"""The tracker: the only part of the walk that remembers.

For every frame it forecasts where the discs are, lets the association name the blobs, corrects the belief
and states the angles with their standard deviations. It reads no picture and writes no file.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core import so3
from core.calibration.result import Calibration
from core.camera import Camera
from core.tracking import modes
from core.tracking.finger_model import seat_of
from core.tracking.finger_smoother import FingersLookedBack, FingerStart, FingerStep, smooth_fingers
from core.tracking.fingers import Fingers, FingerTrial
from core.tracking.geometry import geometry_for, palm_of
from core.tracking.hand_geometry import RAY_MARKERS
from core.tracking.measurement import Forecast, View, forecast, forecast_augmented, forecast_reduced
from core.tracking.modes import ModeBank
from core.tracking.naming import Corrected, Measurable, measurable, name_and_correct
from core.tracking.noise_watch import watched
from core.tracking.reacquire import FoundPalm, Reach, find_palm
from core.tracking.readout import Readout, lost_frame, lost_moment, shown_frame
from core.tracking.settings import TrackerSettings
from core.tracking.shape_learning import hidden_by_calibration, slowly_learnt
from core.tracking.smoother import FilterStep, smooth
from core.tracking.state import Belief, StateLayout, resting_belief
from core.types import Detections, FloatArray, Moment, TrackedFrame, TrackStatus

SHARE_WINDOW_S = 1.0
_SAME_AXIS = np.eye(2)
LEAST_PALM_MARKERS = 3
PROBATION_S = 0.2
"""A hand found again out of nothing must keep showing for so long."""
VAGUE_TURN_RAD = 0.15
"""Expecting the hand's turn less surely than this, the filter may settle on wrong names or at a wrong pose."""
TOO_VAGUE_TURN_RAD = 0.5
"""Less surely than this, sigma points reach too far for a correction to be trusted, even by the right names."""
BLIND_TURN_RAD = (0.1, 0.1, 0.15, 0.35)
"""Expecting it less surely than this, any so many blobs would do for discs: none, one, two, three of them."""
BLIND_AMONG_FINGERS_RAD = (0.1, 0.06, 0.15, 0.25, 0.35)
"""Where there are discs on fingers, these can look like some of the palm, even like four of them."""

TURN_SLACK_RAD, MOST_TURN_RATE_RAD_S, MOST_TURN_RAD = 0.35, 12.0, 1.9
"""A hand gone from sight is not found turned further than it may have turned meanwhile, nor ever the other way."""


@dataclass(frozen=True, slots=True)
class Expectation:
    """Where the discs should be in the next frame: pixels (M, 2) with covariance (M, 2, 2), depths (M,)."""

    pixel: FloatArray
    covariance_px2: FloatArray
    depth_m: FloatArray


@dataclass(frozen=True, slots=True)
class KeptSteps:
    """What looking back needs of some frames in a row: the palm's and the fingers' steps, and what was believed of the
    fingers before the first (None at the neutral pose)."""

    steps: Sequence[FilterStep]
    fingers: Sequence[FingerStep | None]
    finger_start: FingerStart | None


@dataclass(frozen=True, slots=True)
class _Step:
    """One frame weighed: the palm as named, its modes merged, and the fingers on it.

    ``spare`` (D,) blobs that are neither's, ``is_finger`` (D,) blobs that are the fingers'.
    """

    palm: Corrected
    bank: ModeBank
    palm_seen: int
    fingers: FingerTrial | None
    spare: NDArray[np.bool_]
    is_finger: NDArray[np.bool_]


class Tracker:
    """Tracks one calibrated hand through frames in order of time."""

    def __init__(
        self, calibration: Calibration, camera: Camera, settings: TrackerSettings, *, keep_history: bool = True
    ) -> None:
        self.settings = settings
        self._keep_history = keep_history
        self._protocol = calibration.clicks.protocol
        self._rows = np.array(self._protocol.palm)
        self._fingers = Fingers(calibration, camera, settings) if self._protocol.has_fingers else None
        self._joint_count = 0 if self._fingers is None else self._fingers.model.reading.ray.size
        calibration = palm_of(calibration)
        self._calibration = calibration
        geometry, shape_covariance = geometry_for(calibration, settings.refine_shape, settings.noise.depth_stays_m)
        hidden = hidden_by_calibration(calibration, settings.shape_hidden) if settings.refine_shape else None
        self.layout = StateLayout(0, settings.motion == "constant_rate", shape_covariance.shape[0])
        self.view = View(camera, calibration.rotation_w0_cam, calibration.translation_w0_cam_m, geometry, hidden)
        self._scales = np.array(settings.mode_scales if settings.motion == "constant_rate" else (1.0,))
        self._resolution_px2 = float(camera.width_px * camera.height_px)
        self._readout = Readout(calibration, self.layout)
        self._noise_factor = np.ones((self._rows.size, 3))
        self._recent: deque[tuple[float, NDArray[np.int64]]] = deque()
        self._recently_measured = np.zeros(self._joint_count or 3, dtype=np.int64)
        self._bank: ModeBank | None = None
        self._shape = np.zeros(shape_covariance.shape[0])
        self._shape_covariance = self._calibrated_shape = shape_covariance
        self._time_s: float | None = None
        self._seen_s = -np.inf
        self._begun_s = -np.inf
        self._found_s = -np.inf
        self._anew = True
        self._forecast: tuple[float, Forecast] | None = None
        self.history: list[FilterStep] = []
        self._finger_history: list[FingerStep | None] = []
        self._finger_start: FingerStart | None = None
        self._looked_back: FingersLookedBack | None = None
        self.begin_at_neutral()

    def begin_at_neutral(self) -> None:
        """Start (again) from the calibrated pose, the hand at rest."""
        self._shape, self._shape_covariance = np.zeros_like(self._shape), self._calibrated_shape
        start = resting_belief(self.layout, self.settings.initial, shape_covariance=self._shape_covariance)
        self._begin(start)
        if self._fingers is not None:
            self._fingers.begin_at_neutral()
        self._anew = True

    def _begin(self, belief: Belief) -> None:
        self._bank = ModeBank.of(belief, self._scales.size)
        self._forecast = None

    @property
    def is_lost(self) -> bool:
        return self._bank is None

    def expect(self, timestamp_s: float) -> Expectation | None:
        """Where to look at that time; None when the hand is lost."""
        if self._bank is None or self._is_past(timestamp_s):
            return None
        mean, covariance = self._forecast_at(timestamp_s, self._bank).by_marker()
        palm = Expectation(mean[:, :2], covariance[:, :2, :2], mean[:, 2])
        return palm if self._fingers is None else self._with_fingers(palm, timestamp_s, self._fingers)

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
        if self._is_past(timestamp_s):
            self._give_up()
        if self._bank is None:
            found = find_palm(ideal, self.view, self._reach())
            if found is None:
                return self._lost(index, timestamp_s, detections, dropped_before)
            self._begin(self._belief_found(found))
            self._seen_s, linked, self._time_s = timestamp_s, False, timestamp_s
            self._found_s = timestamp_s
        assert self._bank is not None
        dt_s = 0.0 if self._time_s is None else timestamp_s - self._time_s
        ahead = self._forecast_at(timestamp_s, self._bank)
        blobs = self._measurable(ahead, ideal)
        step = self._weighed(timestamp_s, dt_s, ahead, blobs, ideal)
        turn_sd_rad = _turn_sd_rad(ahead.bank, self.layout)
        vague = turn_sd_rad > VAGUE_TURN_RAD
        few = step.palm_seen <= LEAST_PALM_MARKERS
        if (few or vague) and np.count_nonzero(step.spare) + step.palm_seen > LEAST_PALM_MARKERS:
            # Too little of the palm is where it was expected, or too little was expected: it may be anywhere.
            found = find_palm(ideal if vague else _only(ideal, ~step.is_finger), self.view, self._reach())
            if found is not None and (vague or found.count > step.palm_seen) and self._may_be_at(found, timestamp_s):
                bank = ModeBank.of(self._belief_found(found), self._scales.size)
                there = forecast(bank, self.layout, self.view, self.settings.spread)
                step_there = self._weighed(timestamp_s, dt_s, there, blobs, ideal)
                agreed = (
                    turn_sd_rad < TOO_VAGUE_TURN_RAD
                    and np.array_equal(step_there.palm.taken, step.palm.taken)
                    and self._fits(step.palm)
                )
                if not agreed and step_there.palm_seen >= max(LEAST_PALM_MARKERS + 1, step.palm_seen):
                    # A vague belief has nothing against the place found: the smoother may go on through it.
                    ahead, step, linked, turn_sd_rad = there, step_there, linked and vague, 0.0
        blind_rad = BLIND_TURN_RAD if self._fingers is None else BLIND_AMONG_FINGERS_RAD
        if step.palm_seen < len(blind_rad) and turn_sd_rad > blind_rad[step.palm_seen]:
            none = _only(ideal, np.zeros(len(ideal), dtype=bool))
            step = self._weighed(timestamp_s, dt_s, ahead, self._measurable(ahead, none), none)
        if step.palm_seen < self._least_seen(timestamp_s):
            # Found a moment ago, and the next pictures do not bear it out: it was no hand, or not there.
            return self._lost(index, timestamp_s, detections, dropped_before)
        self._time_s, self._forecast = timestamp_s, None
        self._noise_factor = watched(self._noise_factor, step.palm, dt_s, self.settings.noise)
        belief = step.bank.nominal
        self._shape, self._shape_covariance = belief.shape, belief.covariance[self.layout.shape, self.layout.shape]
        finger_step = None
        if self._fingers is not None and step.fingers is not None:
            finger_step = self._fingers.accept(step.fingers, timestamp_s, dt_s)
        self._remember(timestamp_s, self._measured(step))
        if step.palm_seen >= LEAST_PALM_MARKERS:
            status, self._bank, self._seen_s = TrackStatus.TRACKED, step.bank, timestamp_s
        elif timestamp_s - max(self._seen_s, self._begun_s) > self.settings.lost_after_s:
            return self._lost(index, timestamp_s, detections, dropped_before)
        else:
            # An unseen hand is not taken to go on for ever: its velocity fades, its uncertainty grows.
            keep = float(np.exp(-dt_s / self.settings.rate_memory_s))
            status, self._bank = TrackStatus.PREDICTED, modes.slowed(step.bank, keep, self.layout)
            belief = self._bank.nominal  # what the next frame is predicted from
        if self._keep_history:
            scale = float(np.sqrt(step.bank.probability @ self._scales**2))
            self._finger_history.append(finger_step)
            self.history.append(FilterStep(timestamp_s, belief, scale, linked))
        return self._shown(index, timestamp_s, status, ahead, step, detections, dropped_before)

    def _is_past(self, timestamp_s: float) -> bool:
        """Whether no picture came for so long that where the hand was says nothing of where it is."""
        return self._time_s is not None and timestamp_s - self._time_s > self.settings.lost_after_s

    def _give_up(self) -> None:
        self._bank, self._forecast = None, None
        if self._fingers is not None:
            self._fingers.begin_anywhere()

    def _least_seen(self, timestamp_s: float) -> int:
        """Discs of the palm without which a hand found again is given up."""
        if timestamp_s == self._found_s:
            return LEAST_PALM_MARKERS + 1
        return LEAST_PALM_MARKERS if timestamp_s - self._found_s < PROBATION_S else 0

    def _fits(self, palm: Corrected) -> bool:
        """Whether the discs lie where the corrected pose puts them."""
        return bool((np.abs(palm.raw_residual) <= self.settings.noise.outlier_sd).all())

    def _may_be_at(self, found: FoundPalm, timestamp_s: float) -> bool:
        """Whether a hand can have turned there since it was last seen."""
        assert self._bank is not None
        apart = so3.log(self._bank.nominal.rotation_w2_w0.T @ found.rotation_w2_w0)
        gone_s = timestamp_s - max(self._seen_s, self._begun_s)
        return float(np.linalg.norm(apart)) < min(TURN_SLACK_RAD + MOST_TURN_RATE_RAD_S * gone_s, MOST_TURN_RAD)

    def _measurable(self, ahead: Forecast, ideal: Detections) -> Measurable:
        depth_m = max(float(ahead.marker_mean[0, 2]), 0.1)
        return measurable(ideal, self.view.camera.fx_px * self.settings.marker_radius_m / depth_m, self.settings)

    def _weighed(self, timestamp_s: float, dt_s: float, ahead: Forecast, blobs: Measurable, ideal: Detections) -> _Step:
        """Palm and fingers named and corrected, the fingers by what the palm leaves; nothing is remembered."""
        corrected = name_and_correct(
            ahead, blobs, LEAST_PALM_MARKERS + 1, self._resolution_px2, self._noise_factor, self.settings
        )
        learnt = slowly_learnt(ahead.bank, corrected.bank, self.layout, self.settings.shape_news)
        bank = modes.merged(learnt, self.layout)
        spare = np.ones(len(blobs), dtype=bool)
        named = corrected.taken >= 0
        spare[corrected.taken[named]] = False
        palm_seen = int(np.count_nonzero(named))
        if self._fingers is None:
            return _Step(corrected, bank, palm_seen, None, spare, np.zeros(len(blobs), dtype=bool))
        seat = seat_of(bank.nominal, self.view, self._readout)
        fingers = self._fingers.weigh(timestamp_s, dt_s, seat, blobs, ideal.area_px, spare)
        is_finger = np.zeros_like(spare)
        is_finger[fingers.blob[fingers.blob >= 0]] = True
        return _Step(corrected, bank, palm_seen, fingers, spare & ~is_finger, is_finger)

    def _with_fingers(self, palm: Expectation, timestamp_s: float, fingers: Fingers) -> Expectation:
        assert self._bank is not None
        dt_s = 0.0 if self._time_s is None else timestamp_s - self._time_s
        ahead = self._forecast_at(timestamp_s, self._bank).bank
        pixel, covariance, depth = fingers.expected(timestamp_s, dt_s, ahead.nominal, self.view)
        covariance = covariance + palm.covariance_px2.max(axis=0)
        return Expectation(
            self._by_marker(palm.pixel, pixel),
            self._by_marker(palm.covariance_px2, covariance),
            self._by_marker(palm.depth_m, depth),
        )

    def _by_marker(self, palm: NDArray[Any], fingers: NDArray[Any] | None) -> NDArray[Any]:
        """Rows (M, ...) of the protocol from those of the palm (6, ...) and of the rays' discs (5, 3, ...)."""
        if fingers is None:
            return palm
        out = np.empty((len(self._protocol.markers), *palm.shape[1:]), dtype=palm.dtype)
        out[self._rows], out[RAY_MARKERS] = palm, fingers
        return out

    def _shown(
        self,
        index: int,
        timestamp_s: float,
        status: TrackStatus,
        ahead: Forecast,
        step: _Step,
        detections: Detections,
        dropped_before: int,
    ) -> TrackedFrame:
        """The row of a tracked or predicted frame."""
        belief, fingers = step.bank.nominal, step.fingers
        taken = self._by_marker(step.palm.taken, None if fingers is None else fingers.blob)
        used = np.flatnonzero(taken >= 0)
        blob = taken[used]
        measured_px = np.full((taken.size, 2), np.nan)
        measured_depth_m = np.full(taken.size, np.nan)
        measured_px[used] = detections.pixel[blob]
        measured_depth_m[used] = detections.depth_m[blob]
        mean, covariance = ahead.by_marker()
        predicted_px, predicted_cov_px2 = mean[:, :2], covariance[:, :2, :2]
        discs = self.view.markers_cam_m(belief.position_m, belief.rotation_w2_w0, belief.joints_rad, belief.shape)
        moment, nis, dof = self._readout.moment(belief), step.palm.nis, step.palm.dof
        if self._fingers is not None and fingers is not None:
            joints = self._fingers.read(fingers)
            moment = self._readout.with_joints(moment, joints)
            discs = self._by_marker(discs, joints.disc_cam_m)
            predicted_px = self._by_marker(predicted_px, fingers.predicted_px)
            predicted_cov_px2 = self._by_marker(predicted_cov_px2, fingers.predicted_cov_px2)
            nis, dof = np.nansum([nis, fingers.nis]), dof + fingers.dof
        return shown_frame(
            index,
            timestamp_s,
            status,
            moment,
            marker_position_cam_m=discs,
            predicted_px=self.view.camera.distort(predicted_px),
            predicted_cov_px2=predicted_cov_px2 + self.settings.noise.pixel_sd_px**2 * _SAME_AXIS,
            measured_px=measured_px,
            measured_depth_m=measured_depth_m,
            detections=detections,
            dropped_before=dropped_before,
            measured_share=self._share(),
            nis=float(nis) if dof else math.nan,
            nis_dof=dof,
        )

    def _lost(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int) -> TrackedFrame:
        self._give_up()
        self._time_s = timestamp_s
        self._remember(timestamp_s, np.zeros(self._joint_count or 3, dtype=np.int64))
        if self._keep_history:
            self._finger_history.append(None)
            self.history.append(FilterStep(timestamp_s, None, 1.0, False))
        count = len(self._protocol.markers)
        moment = lost_moment(self._joint_count, count)
        return lost_frame(index, timestamp_s, moment, count, detections, dropped_before, self._share())

    def would_miss(self, blobs: Detections) -> bool:
        """Whether blobs of a narrowed search are too few to hold the palm, so that the rest is worth a look."""
        return len(blobs) <= LEAST_PALM_MARKERS

    def smoothed(self) -> list[Moment]:
        """Every frame so far in the light of all the others; needs the history kept. Tracking may go on meanwhile."""
        beliefs = smooth(list(self.history), self.settings.motion_noise, self.layout)
        readout = Readout(self._calibration, self.layout)
        lost = lost_moment(self._joint_count, len(self._protocol.markers))
        moments = [lost if belief is None else readout.moment(belief) for belief in beliefs]
        if self._fingers is None:
            return moments
        seats = [None if belief is None else seat_of(belief, self.view, readout) for belief in beliefs]
        self._looked_back = smooth_fingers(
            self._fingers.model, self._finger_history[: len(beliefs)], seats, self._finger_start
        )
        return [
            lost if joints is None else readout.with_joints(moment, joints)
            for moment, joints in zip(moments, self._looked_back.moments, strict=True)
        ]

    def forget(self, before_s: float = math.inf) -> None:
        """Give up what :meth:`smoothed` needs of frames before that time, all of them or some just looked back at."""
        count = sum(step.timestamp_s < before_s for step in self.history)
        if not count:
            return
        if self._fingers is not None:
            if count == len(self.history):
                self._finger_start = self._fingers.start(self.history[-1].timestamp_s, self._bank is None)
            elif self._looked_back is not None:
                self._finger_start = self._looked_back.start_after(count, self._fingers.model)
            self._looked_back = None
        del self._finger_history[:count]
        del self.history[:count]

    def hand_over(self) -> KeptSteps:
        """Give up what :meth:`smoothed` needs of the frames so far, for another tracker of the same hand."""
        kept = KeptSteps(list(self.history), list(self._finger_history), self._finger_start)
        self.forget()
        return kept

    def take_over(self, kept: KeptSteps) -> None:
        """Take what another tracker of the same hand handed over, to look back at it; it goes on from what was taken
        before."""
        if not self.history:
            self._finger_start = kept.finger_start
        self._finger_history += kept.fingers
        self.history += kept.steps

    def _measured(self, step: _Step) -> NDArray[np.int64]:
        """Discs of the palm (3,), or whether each joint (J,), that were measured directly."""
        if self._fingers is None or step.fingers is None:
            return np.full(3, step.palm_seen)
        seen = self._by_marker(step.palm.taken, step.fingers.blob) >= 0
        return np.asarray(seen[self._fingers.model.direct_markers].all(axis=-1), dtype=np.int64)

    def _reach(self) -> Reach | None:
        """Where the fingers' discs can be, as seen from the palm."""
        return None if self._fingers is None else self._fingers.reach

    def _belief_found(self, found: FoundPalm) -> Belief:
        initial = replace(self.settings.initial, velocity_m_s=0.5, rate_rad_s=2.0)
        belief = resting_belief(
            self.layout,
            initial,
            position_m=found.position_m,
            rotation_w2_w0=found.rotation_w2_w0,
            shape_covariance=self._shape_covariance,
        )
        pose = np.r_[self.layout.position, self.layout.turn]
        belief.covariance[np.ix_(pose, pose)] = found.pose_covariance(self.view.geometry.palm_m)
        return replace(belief, shape=self._shape)

    def _remember(self, timestamp_s: float, measured: NDArray[np.int64]) -> None:
        self._recent.append((timestamp_s, measured))
        self._recently_measured = self._recently_measured + measured
        while self._recent[0][0] < timestamp_s - SHARE_WINDOW_S:
            self._recently_measured = self._recently_measured - self._recent.popleft()[1]

    def _share(self) -> FloatArray:
        """Share of direct measurement of the palm (3,) or of each joint (J,) lately."""
        possible = self._rows.size if self._fingers is None else 1
        return np.asarray(self._recently_measured / (possible * len(self._recent)))


def _only(blobs: Detections, kept: NDArray[np.bool_]) -> Detections:
    if kept.all():
        return blobs
    return Detections(*(getattr(blobs, field.name)[kept] for field in fields(Detections)))


def _turn_sd_rad(bank: ModeBank, layout: StateLayout) -> float:
    """How surely the hand's turn is known, all axes and modes together."""
    variance = bank.covariance.diagonal(axis1=1, axis2=2)[:, layout.turn]
    return math.sqrt((bank.probability @ variance).sum())

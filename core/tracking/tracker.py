"""The tracker: the only part of the pipeline with a memory.

A frame's blobs are screened by a person's labels and associated with the predicted discs; they update the state
estimate, or the prediction is kept; the track is confirmed, coasted or deleted; lost, or where too few discs were where
they should be, the hand is acquired again. It reads no image and writes no file.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import (
    Detections,
    FloatArray,
    KinematicState,
    LossReason,
    TrackedFrame,
    TrackStatus,
)
from carpus.core.tracking.association.consistency import ConsistencyTest, find_unused_markers
from carpus.core.tracking.association.operator_labels import LabelledDetections, OperatorLabels
from carpus.core.tracking.association.reacquire import MIN_FOUND_MARKERS
from carpus.core.tracking.association.track_manager import (
    DIRECT_SHARE_WINDOW_S,
    MAX_TRUSTED_SD_RAD,
    MIN_PALM_MARKERS,
    TURN_SLACK_RAD,
    TrackManager,
    angle_between_rad,
)
from carpus.core.tracking.digits.finger_model import FingerModel
from carpus.core.tracking.filter.hand_geometry import JointState, palm_calibration
from carpus.core.tracking.filter.predicted_measurement import MarkerOrder, PredictedMeasurement
from carpus.core.tracking.filter.readout import Readout, build_lost_frame, nan_kinematics
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.hand_filter import HandFilter, Posterior, Scan, undistort_detections
from carpus.core.tracking.smoother.finger_smoother import FingerStart, FingerStep, SmoothedFingers, smooth_fingers
from carpus.core.tracking.smoother.palm_smoother import FilterStep, smooth_palm


class TrackedFrameBuilder:
    """Builds each frame's result.

    Stores the share of direct measurements over the last second and the consistency test.
    """

    def __init__(
        self,
        protocol: MarkerProtocol,
        order: MarkerOrder,
        model: FingerModel | None,
        readout: Readout,
    ) -> None:
        self._order, self._model, self._readout = order, model, readout
        self._markers = len(protocol.markers)
        joint_count = 0 if model is None else model.readout.angle_map.chain.size
        self.lost_state: KinematicState = nan_kinematics(joint_count, self._markers)
        self._consistency = ConsistencyTest(self._markers)
        self._recent: deque[tuple[float, NDArray[np.int64]]] = deque()
        self._zero_counts = np.zeros(joint_count or 3, dtype=np.int64)
        self._direct_counts = self._zero_counts

    def reset_consistency(self) -> None:
        self._consistency.reset()

    def build_frame(
        self,
        index: int,
        status: TrackStatus,
        posterior: Posterior,
        scan: Scan,
        joints: JointState | None,
        detections: Detections,
        dropped_before: int,
    ) -> TrackedFrame:
        """Return the result of a tracked or predicted frame."""
        predicted, palm, fingers, order = posterior.predicted, posterior.palm, posterior.fingers, self._order
        camera = predicted.view.camera
        # Rows of the markers: the palm's as predicted before the update, the fingers' on the palm as updated.
        blob = order.to_protocol_order(palm.assigned, None if fingers is None else fingers.blob)
        if len(detections):
            measured_px = np.where((blob >= 0)[:, None], detections.pixel.take(blob, 0), np.nan)
            measured_depth_m = np.where(blob >= 0, detections.depth_m.take(blob), np.nan)
        else:
            measured_px, measured_depth_m = np.full((blob.size, 2), np.nan), np.full(blob.size, np.nan)
        pixel = predicted.mean[:, :2]
        disc_cam_m = predicted.view.discs_cam_m(posterior.estimate)
        residual_norm2 = np.vecdot(palm.raw_residual, palm.raw_residual)
        nis, dof = palm.nis, palm.dof
        if fingers is not None:
            nis, dof = sum(part for part in (nis, fingers.nis) if not math.isnan(part)), dof + fingers.dof
        kinematics = self._readout.read_kinematics(posterior.estimate)
        if fingers is not None and joints is not None:
            pixel = order.to_protocol_order(pixel, fingers.prediction_px)
            disc_cam_m = order.to_protocol_order(disc_cam_m, joints.disc_cam_m)
            residual_norm2 = order.to_protocol_order(residual_norm2, fingers.residual_norm2)
        if joints is not None:
            kinematics = self._readout.with_joints(kinematics, joints, posterior.estimate)

        if self._model is None:
            direct = np.full(3, posterior.seen_count)
        else:
            direct = np.asarray((blob >= 0)[self._model.readout.direct_markers].all(axis=-1), dtype=np.int64)
        self._update_share(scan.timestamp_s, direct)
        is_unused = find_unused_markers(disc_cam_m, blob, scan.ideal, camera)
        doubt = self._consistency.update(scan.dt_s, is_unused, nis, dof, int(residual_norm2.argmax()))
        if doubt.is_any and status is TrackStatus.TRACKED:
            status = TrackStatus.DOUBTFUL
            kinematics = replace(
                kinematics,
                angles_sd_rad=kinematics.angles_sd_rad * doubt.sd_factor,
                joint_angles_sd_rad=kinematics.joint_angles_sd_rad * doubt.sd_factor,
            )
        return TrackedFrame(
            index=index,
            timestamp_s=scan.timestamp_s,
            status=status,
            kinematics=kinematics,
            marker_position_cam_m=disc_cam_m,
            marker_predicted_px=camera.distort(pixel),
            marker_measured_px=measured_px,
            marker_measured_depth_m=measured_depth_m,
            detections=detections,
            dropped_before=dropped_before,
            measured_share=self._direct_share(),
            nis=nis if dof else math.nan,
            nis_dof=dof,
            doubted=doubt.doubted,
        )

    def build_lost_frame(
        self, index: int, timestamp_s: float, detections: Detections, dropped_before: int
    ) -> TrackedFrame:
        """Return the result of a frame in which the hand is lost."""
        self.reset_consistency()
        self._update_share(timestamp_s, self._zero_counts)
        return build_lost_frame(
            index, timestamp_s, self.lost_state, self._markers, detections, dropped_before, self._direct_share()
        )

    def _update_share(self, timestamp_s: float, measured: NDArray[np.int64]) -> None:
        self._recent.append((timestamp_s, measured))
        self._direct_counts = self._direct_counts + measured
        while self._recent[0][0] < timestamp_s - DIRECT_SHARE_WINDOW_S:
            self._direct_counts = self._direct_counts - self._recent.popleft()[1]

    def _direct_share(self) -> FloatArray:
        """Return the share of direct measurement of the palm (3,) or of each joint (J,) lately."""
        possible = self._order.palm.size if self._model is None else 1
        return np.asarray(self._direct_counts / (possible * len(self._recent)))


@dataclass(frozen=True, slots=True)
class FilterSteps:
    """Some frames in a row: steps of palm and fingers, and the fingers before the first.

    ``finger_start`` is None at the neutral pose.
    """

    steps: Sequence[FilterStep]
    fingers: Sequence[FingerStep | None]
    finger_start: FingerStart | None


class SmootherRecord:
    """Grows by a step a frame; smooths what it holds, discards it, and hands it over.

    ``make_readout`` returns a fresh readout; ``lost_state`` is the state of which nothing is known.
    """

    def __init__(self, palm: HandFilter, make_readout: Callable[[], Readout], lost_state: KinematicState) -> None:
        self._motion, self._view = palm.motion, palm.view
        self._model = None if palm.fingers is None else palm.fingers.model
        self._make_readout, self._lost_state = make_readout, lost_state
        self.history: list[FilterStep] = []
        self.finger_history: list[FingerStep | None] = []
        self.smoothed_digits: SmoothedFingers | None = None
        self._finger_start: FingerStart | None = None

    def append(self, step: FilterStep, fingers: FingerStep | None) -> None:
        """Add one frame."""
        self.history.append(step)
        self.finger_history.append(fingers)

    def smooth(self) -> list[KinematicState]:
        """Return every frame so far smoothed by all the others. Tracking may go on meanwhile."""
        readout, lost = self._make_readout(), self._lost_state
        estimates = smooth_palm(list(self.history), self._motion)
        moments = [lost if estimate is None else readout.read_kinematics(estimate) for estimate in estimates]
        if self._model is None:
            return moments
        bases = [None if estimate is None else readout.compute_base(estimate, self._view) for estimate in estimates]
        self.smoothed_digits = smooth_fingers(
            self._model, self.finger_history[: len(estimates)], bases, self._finger_start
        )
        return [
            lost if joints is None or estimate is None else readout.with_joints(moment, joints, estimate)
            for moment, joints, estimate in zip(moments, self.smoothed_digits.joint_states, estimates, strict=True)
        ]

    def discard_before(self, time_s: float) -> None:
        """Discard the frames before that time, which were just smoothed."""
        count = sum(step.timestamp_s < time_s for step in self.history)
        if self.smoothed_digits is not None and self._model is not None and count:
            self._finger_start = self.smoothed_digits.start_for_next(count, self._model)
        self._drop(count)

    def pop_steps(self, finger_start: FingerStart | None) -> FilterSteps:
        """Remove and return all frames, for the record of another tracker of the same hand.

        ``finger_start`` is the estimate of the fingers now, for the frames to come.
        """
        kept = FilterSteps(list(self.history), list(self.finger_history), self._finger_start)
        if self.history:
            self._finger_start = finger_start
        self._drop(len(self.history))
        return kept

    def append_steps(self, steps: FilterSteps) -> None:
        """Add the steps of another record; it goes on from those added before."""
        if not self.history:
            self._finger_start = steps.finger_start
        self.finger_history += steps.fingers
        self.history += steps.steps

    def _drop(self, count: int) -> None:
        if not count:
            return
        self.smoothed_digits = None
        del self.finger_history[:count]
        del self.history[:count]


class Tracker:
    """Tracks one calibrated hand through frames in order of time.

    ``markers`` are the names of the markers, in the order of every row.
    """

    def __init__(
        self, calibration: Calibration, camera: Camera, settings: TrackerSettings, *, keep_history: bool = True
    ) -> None:
        self.settings = settings
        self._keep_history = keep_history
        protocol = calibration.clicks.protocol
        self.markers = protocol.markers
        self._filter = HandFilter(calibration, camera, settings)
        self._manager = TrackManager(MIN_FOUND_MARKERS, settings.lost_after_s, has_digits=protocol.has_fingers)
        self.labels = OperatorLabels(len(self.markers))
        model = None if self._filter.fingers is None else self._filter.fingers.model
        self._frame_builder = TrackedFrameBuilder(protocol, self._filter.order, model, self._filter.readout)
        palm = palm_calibration(calibration)
        self.record = SmootherRecord(
            self._filter, lambda: Readout(palm, camera, settings.marker_radius_m), self._frame_builder.lost_state
        )

    def begin_at_neutral(self, at_s: float | None = None) -> None:
        """Start (again) from the calibrated pose, the hand at rest, at that time or the next frame."""
        self._filter.begin_at_neutral()
        self._manager.begin_at_neutral(at_s)
        self._frame_builder.reset_consistency()

    def drop_track(self, after_s: float) -> None:
        """Drop the track after a wrong association; learnt anatomy is kept."""
        self._drop_track(after_s, LossReason.MARKERS_CORRECTED)
        self._frame_builder.reset_consistency()

    @property
    def is_lost(self) -> bool:
        return self._manager.is_lost

    def predict_measurement(self, timestamp_s: float) -> PredictedMeasurement | None:
        """Return the predicted measurement at that time; None when the hand is lost."""
        if self.is_lost or self._manager.is_timed_out(timestamp_s):
            return None
        return self._filter.predict(self._manager.time_step_s(timestamp_s))

    def is_search_incomplete(self, blobs: Detections) -> bool:
        """Return whether the blobs of a narrowed search are too few.

        Too few to be the palm, or not all of it where the last frame did not show every turn of it.
        """
        too_few = MIN_PALM_MARKERS if self._filter.is_rotation_observed else self._filter.order.palm.size - 1
        return len(blobs) <= too_few

    def step(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int = 0) -> TrackedFrame:
        """Associate the blobs of one frame and update by them; return the frame's result."""
        labelled = self.labels.apply_labels(timestamp_s, detections, lambda: self._predict_pixels(timestamp_s))
        frame = self._track(index, timestamp_s, labelled, dropped_before)
        self.labels.follow(frame.marker_measured_px)
        if labelled.detections is not detections:
            frame = replace(frame, detections=detections, is_rejected=labelled.is_rejected)
        return frame

    def _track(self, index: int, timestamp_s: float, labelled: LabelledDetections, dropped_before: int) -> TrackedFrame:
        """Return the frame's result of the blobs that may be markers."""
        detections = labelled.detections
        ideal = undistort_detections(detections, self._filter.view.camera)
        is_linked = self._manager.start_frame(timestamp_s)
        if self._manager.is_timed_out(timestamp_s):
            self._drop_track(timestamp_s, LossReason.NO_FRAMES)
        if self.is_lost:  # initiate a track where the blobs show a palm, wherever it was
            is_linked = False
            found = self._filter.find_palm(ideal, self._manager.widest_turn_limits())
            if found is None or not self._manager.try_initiate(found, timestamp_s):
                return self._build_lost_frame(index, timestamp_s, detections, dropped_before)
            self._filter.start(self._filter.estimate_from_found(found))

        dt_s = self._manager.time_step_s(timestamp_s)
        if labelled.marker is not None:
            self._filter.restart_labelled_digit(labelled.marker)
            self._frame_builder.reset_consistency()
        predicted = self._filter.predict(dt_s)
        scan = self._filter.build_scan(predicted, ideal, timestamp_s, dt_s)
        posterior, turn_sd_rad = self._filter.update(predicted, scan), predicted.turn_sd_rad
        reacquired = self._reacquire(posterior, scan)
        if reacquired is not None:
            # A vague prediction has nothing against the place found: the smoother may go on through it.
            is_linked = is_linked and self._manager.is_turn_uncertain(turn_sd_rad)
            posterior = reacquired
        elif self._manager.is_chance_match(posterior.seen_count, turn_sd_rad) or (
            self._manager.is_weakly_supported(posterior.seen_count, turn_sd_rad)
            and self._filter.is_other_hand(posterior, scan)
        ):
            posterior = self._filter.update(predicted, scan.without_blobs())

        loss_reason = self._manager.find_loss_reason(posterior.seen_count, timestamp_s)
        if loss_reason is not LossReason.UNCONFIRMED_POSE:
            self._filter.learn(posterior, dt_s)
        if loss_reason is not None:
            return self._build_lost_frame(index, timestamp_s, detections, dropped_before, loss_reason)
        is_consistent = self._filter.is_consistent(posterior)
        status = self._manager.update_status(timestamp_s, posterior.seen_count, is_consistent=is_consistent)
        steps = self._filter.accept(posterior, scan, is_seen=status is TrackStatus.TRACKED, is_linked=is_linked)
        if self._keep_history:
            self.record.append(*steps)
        joints = self._filter.read_joints(posterior)
        return self._frame_builder.build_frame(index, status, posterior, scan, joints, detections, dropped_before)

    def _reacquire(self, posterior: Posterior, scan: Scan) -> Posterior | None:
        """Return the update from a palm found without a prediction; None where that is no better.

        Tried where too few discs are where they were predicted or the prediction was vague.
        """
        manager, turn_sd_rad, seen = self._manager, posterior.predicted.turn_sd_rad, posterior.seen_count
        unassigned = int(np.count_nonzero(posterior.unassigned))
        is_flipped = manager.can_be_flipped(seen, unassigned) and not self._filter.is_rotation_measured(posterior)
        if not (is_flipped or manager.is_reacquisition_due(seen, unassigned, turn_sd_rad)):
            return None
        is_turn_uncertain, rotation = manager.is_turn_uncertain(turn_sd_rad), posterior.predicted.nominal.rotation_w2_w0
        ideal = scan.ideal if is_turn_uncertain else scan.ideal.subset(~posterior.is_finger)
        found = self._filter.find_palm(ideal, manager.turn_limits(rotation, scan.timestamp_s))
        if found is None or not (is_turn_uncertain or found.count > seen):
            return None
        if found.count <= MIN_FOUND_MARKERS and self._filter.is_contradicted(found, posterior):
            return None
        is_predicted = angle_between_rad(rotation, found.rotation_w2_w0) < TURN_SLACK_RAD
        if is_turn_uncertain and not (is_predicted or manager.is_confirmed(found, scan.timestamp_s)):
            return None
        reacquired = self._filter.update(self._filter.predict_from_found(found, posterior.predicted), scan)
        is_agreed = (
            turn_sd_rad < MAX_TRUSTED_SD_RAD
            and np.array_equal(reacquired.palm.assigned, posterior.palm.assigned)
            and self._filter.is_consistent(posterior)
        )
        if is_agreed or reacquired.seen_count < max(MIN_PALM_MARKERS + 1, seen):
            return None
        manager.accept_found(found)
        return reacquired

    def _drop_track(self, timestamp_s: float, reason: LossReason | None) -> None:
        self._filter.drop_track()
        self._manager.drop_track(timestamp_s, reason)

    def _build_lost_frame(
        self,
        index: int,
        timestamp_s: float,
        detections: Detections,
        dropped_before: int,
        reason: LossReason | None = None,
    ) -> TrackedFrame:
        self._drop_track(timestamp_s, reason)
        if self._keep_history:
            self.record.append(FilterStep(timestamp_s, None, self._filter.motion.initial_probability, False), None)
        frame = self._frame_builder.build_lost_frame(index, timestamp_s, detections, dropped_before)
        return replace(frame, loss_reason=self._manager.loss_reason)

    def _predict_pixels(self, timestamp_s: float) -> FloatArray:
        """Return where the markers should be in the image (M, 2), NaN while the hand is lost."""
        predicted = self.predict_measurement(timestamp_s)
        if predicted is None:
            return np.full((len(self.markers), 2), np.nan)
        return self._filter.view.camera.distort(predicted.pixel)

    def smooth(self) -> list[KinematicState]:
        """Return every frame so far smoothed by all the others; needs the history kept."""
        return self.record.smooth()

    def pop_steps(self) -> FilterSteps:
        """Remove and return the steps so far, for another tracker of the same hand."""
        history = self.record.history
        return self.record.pop_steps(self._filter.finger_start(history[-1].timestamp_s) if history else None)

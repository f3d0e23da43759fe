"""The tracker: the only part of the pipeline that remembers.

A frame's blobs are screened by what a person said of them and associated with the discs that were predicted; they
update the state estimate, or the prediction is kept; the track is confirmed, coasted or given up; lost, or where too
little of it was where it should be, the hand is initiated anew. It reads no picture and writes no file.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import Detections, FloatArray, KinematicState, MarkerLabel, TrackedFrame, TrackStatus
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
from carpus.core.tracking.smoother.palm_smoother import FilterStep
from carpus.core.tracking.smoother.smoother_record import FilterSteps, SmootherModel, SmootherRecord

_SAME_AXIS = np.eye(2)


@dataclass(frozen=True, slots=True)
class _MarkerRows:
    """Of M markers the ``blob`` (M,) or -1, ``predicted_px`` and ``measured_px`` (M, 2), ``measured_depth_m`` (M,),
    ``predicted_cov_px2`` (M, 2, 2) and ``disc_cam_m`` (M, 3); the ``worst_marker`` of them contributes most to the
    NIS."""

    blob: NDArray[np.int64]
    predicted_px: FloatArray
    measured_px: FloatArray
    measured_depth_m: FloatArray
    predicted_cov_px2: FloatArray
    disc_cam_m: FloatArray
    worst_marker: int


class OutputRowBuilder:
    """Tells frame after frame; remembers what was measured lately, and what contradicts it."""

    def __init__(
        self,
        protocol: MarkerProtocol,
        order: MarkerOrder,
        model: FingerModel | None,
        readout: Readout,
        settings: TrackerSettings,
    ) -> None:
        self._order, self._model, self._readout, self._settings = order, model, readout, settings
        self._markers = len(protocol.markers)
        joint_count = 0 if model is None else model.readout.angle_map.chain.size
        self.lost_state: KinematicState = nan_kinematics(joint_count, self._markers)
        self._consistency = ConsistencyTest(self._markers)
        self._recent: deque[tuple[float, NDArray[np.int64]]] = deque()
        self._zero_counts = np.zeros(joint_count or 3, dtype=np.int64)
        self._direct_counts = self._zero_counts

    def reset_consistency(self) -> None:
        """The hand begins anew: nothing is contradicted."""
        self._consistency.reset()

    def build_row(
        self,
        index: int,
        status: TrackStatus,
        posterior: Posterior,
        scan: Scan,
        joints: JointState | None,
        detections: Detections,
        dropped_before: int,
    ) -> TrackedFrame:
        """The row of a tracked or predicted frame."""
        fingers, view = posterior.fingers, posterior.predicted.view
        row = self._collect_marker_rows(posterior, joints, detections)
        self._update_share(scan.timestamp_s, self._find_direct(posterior.seen_count, row.blob))
        moment = self._readout.read_kinematics(posterior.estimate)
        if joints is not None:
            moment = self._readout.with_joints(moment, joints, posterior.estimate)
        nis, dof = posterior.palm.nis, posterior.palm.dof
        if fingers is not None:
            nis, dof = sum(part for part in (nis, fingers.nis) if not math.isnan(part)), dof + fingers.dof
        over = find_unused_markers(row.disc_cam_m, row.blob, scan.ideal, view.camera)
        doubt = self._consistency.update(scan.dt_s, over, nis, dof, row.worst_marker)
        if doubt.is_any and status is TrackStatus.TRACKED:
            status, moment = TrackStatus.DOUBTFUL, _widen_sd(moment, doubt.sd_factor)
        return TrackedFrame(
            index=index,
            timestamp_s=scan.timestamp_s,
            status=status,
            kinematics=moment,
            marker_position_cam_m=row.disc_cam_m,
            marker_predicted_px=view.camera.distort(row.predicted_px),
            marker_predicted_cov_px2=row.predicted_cov_px2,
            marker_measured_px=row.measured_px,
            marker_measured_depth_m=row.measured_depth_m,
            detections=detections,
            dropped_before=dropped_before,
            measured_share=self._direct_share(),
            nis=nis if dof else math.nan,
            nis_dof=dof,
            doubted=doubt.doubted,
        )

    def build_lost_row(
        self, index: int, timestamp_s: float, detections: Detections, dropped_before: int
    ) -> TrackedFrame:
        """The row of a frame in which the hand is lost."""
        self.reset_consistency()
        self._update_share(timestamp_s, self._zero_counts)
        return build_lost_frame(
            index, timestamp_s, self.lost_state, self._markers, detections, dropped_before, self._direct_share()
        )

    def _collect_marker_rows(
        self, posterior: Posterior, joints: JointState | None, detections: Detections
    ) -> _MarkerRows:
        """Of each disc where it was predicted and how surely, the palm's before the update, the fingers' on the palm as
        updated; the blob taken for it, and where it is by now."""
        predicted, palm, fingers, order = posterior.predicted, posterior.palm, posterior.fingers, self._order
        noise = self._settings.noise
        blob = order.to_protocol_order(palm.assigned, None if fingers is None else fingers.blob)
        seen_px, seen_depth_m = np.full((blob.size, 2), np.nan), np.full(blob.size, np.nan)
        if len(detections):
            is_seen = blob >= 0
            seen_px = np.where(is_seen[:, None], detections.pixel.take(blob, 0), np.nan)
            seen_depth_m = np.where(is_seen, detections.depth_m.take(blob), np.nan)
        pixel, covariance = predicted.mean[:, :2], predicted.covariance[:, :2, :2]
        discs = predicted.view.discs_cam_m(posterior.estimate)
        surprise = np.vecdot(palm.raw_residual, palm.raw_residual)
        if fingers is not None and joints is not None:
            pixel = order.to_protocol_order(pixel, fingers.prediction_px)
            covariance = order.to_protocol_order(covariance, fingers.prediction_cov_px2)
            discs, surprise = (
                order.to_protocol_order(discs, joints.disc_cam_m),
                order.to_protocol_order(surprise, fingers.residual_norm2),
            )
        covariance = covariance + noise.pixel_sd_px**2 * _SAME_AXIS
        return _MarkerRows(blob, pixel, seen_px, seen_depth_m, covariance, discs, int(surprise.argmax()))

    def _find_direct(self, palm_seen: int, assigned: NDArray[np.int64]) -> NDArray[np.int64]:
        """Discs of the palm (3,), or whether each joint (J,), that were measured directly."""
        if self._model is None:
            return np.full(3, palm_seen)
        return np.asarray((assigned >= 0)[self._model.readout.direct_markers].all(axis=-1), dtype=np.int64)

    def _update_share(self, timestamp_s: float, measured: NDArray[np.int64]) -> None:
        self._recent.append((timestamp_s, measured))
        self._direct_counts = self._direct_counts + measured
        while self._recent[0][0] < timestamp_s - DIRECT_SHARE_WINDOW_S:
            self._direct_counts = self._direct_counts - self._recent.popleft()[1]

    def _direct_share(self) -> FloatArray:
        """Share of direct measurement of the palm (3,) or of each joint (J,) lately."""
        possible = self._order.palm.size if self._model is None else 1
        return np.asarray(self._direct_counts / (possible * len(self._recent)))


def _widen_sd(moment: KinematicState, by: float) -> KinematicState:
    return replace(moment, angles_sd_rad=moment.angles_sd_rad * by, joint_angles_sd_rad=moment.joint_angles_sd_rad * by)


class Tracker:
    """Tracks one calibrated hand through frames in order of time."""

    def __init__(
        self, calibration: Calibration, camera: Camera, settings: TrackerSettings, *, keep_history: bool = True
    ) -> None:
        self.settings = settings
        self._keep_history = keep_history
        protocol = calibration.clicks.protocol
        self.markers = protocol.markers
        """Names of the discs, in the order of every row."""
        self._filter = HandFilter(calibration, camera, settings)
        self._manager = TrackManager(MIN_FOUND_MARKERS, settings.lost_after_s, has_digits=protocol.has_fingers)
        self._labels = OperatorLabels(self.markers)
        model = None if self._filter.fingers is None else self._filter.fingers.model
        self._row_builder = OutputRowBuilder(protocol, self._filter.order, model, self._filter.readout, settings)
        palm = palm_calibration(calibration)
        self.record = SmootherRecord(
            SmootherModel(
                self._filter.motion,
                self._filter.view,
                model,
                lambda: Readout(palm, camera, settings.marker_radius_m),
                self._row_builder.lost_state,
            )
        )

    def begin_at_neutral(self, at_s: float | None = None) -> None:
        """Start (again) from the calibrated pose, the hand at rest; at that time, or else with the next frame."""
        self._filter.begin_at_neutral()
        self._manager.begin_at_neutral(at_s)
        self._row_builder.reset_consistency()

    def drop_track(self, after_s: float) -> None:
        """After that time look for the hand: what was believed of it came of a wrong name. Its anatomy stays known."""
        self._drop_track(after_s)
        self._row_builder.reset_consistency()

    @property
    def is_lost(self) -> bool:
        return self._manager.is_lost

    def add_operator_label(self, label: MarkerLabel, *, is_asked_again: bool = True) -> None:
        """What a person says of the blue spots of a picture shown a moment ago, from the next frame on. To be called
        between frames, where they are tracked."""
        self._labels.add(label, is_asked_again=is_asked_again)

    def pop_applied_labels(self) -> list[MarkerLabel]:
        """The answers that the frames since the last call have taken up, with the spots as they lay there."""
        return self._labels.pop_applied()

    def predict_measurement(self, timestamp_s: float) -> PredictedMeasurement | None:
        """Where to look at that time; None when the hand is lost."""
        if self.is_lost or self._manager.is_timed_out(timestamp_s):
            return None
        return self._filter.predict(self._manager.time_step_s(timestamp_s))

    def is_search_incomplete(self, blobs: Detections) -> bool:
        """Whether blobs of a narrowed search are too few to hold the palm, or all of it where the last did not show
        how it is turned, so that the rest is worth a look."""
        least = MIN_PALM_MARKERS if self._filter.is_rotation_observed else self._filter.order.palm.size - 1
        return len(blobs) <= least

    def step(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int = 0) -> TrackedFrame:
        """Associate the blobs of one frame and update by them; the frame's result."""
        hinted = self._labels.apply_labels(index, timestamp_s, detections, lambda: self._predict_pixels(timestamp_s))
        frame = self._track(index, timestamp_s, hinted, dropped_before)
        self._labels.follow(frame.marker_measured_px)
        if hinted.detections is not detections:
            frame = replace(frame, detections=detections, is_rejected=hinted.is_rejected)
        return frame

    def _track(self, index: int, timestamp_s: float, hinted: LabelledDetections, dropped_before: int) -> TrackedFrame:
        """The frame's result of the blobs that may be discs."""
        ideal = undistort_detections(hinted.detections, self._filter.view.camera)
        is_linked = self._manager.start_frame(timestamp_s)
        if self._manager.is_timed_out(timestamp_s):
            self._drop_track(timestamp_s)
        if self.is_lost:
            is_linked = False
            self._initiate(ideal, timestamp_s)
        if self.is_lost:
            return self._build_lost_frame(index, timestamp_s, hinted.detections, dropped_before)

        predicted, scan, said = self._predict_with_labels(hinted, ideal, timestamp_s)
        posterior = self._filter.update(predicted, scan)
        is_linked = is_linked and not said
        reacquired = self._reacquire(posterior, scan)
        if reacquired is not None:
            # A vague prediction has nothing against the place found: the smoother may go on through it.
            is_linked = is_linked and self._manager.is_vague(posterior.turn_sd_rad)
            posterior = reacquired
        elif self._manager.is_ambiguous(posterior.seen_count, posterior.turn_sd_rad) or (
            self._manager.is_uncertain(posterior.seen_count, posterior.turn_sd_rad)
            and self._filter.is_other_hand(posterior, scan)
        ):
            posterior = self._filter.update(predicted, scan.without_blobs())

        status = self._update_status(posterior, scan)
        if status is TrackStatus.LOST:
            return self._build_lost_frame(index, timestamp_s, hinted.detections, dropped_before)
        steps = self._filter.accept(posterior, scan, is_seen=status is TrackStatus.TRACKED, is_linked=is_linked)
        if self._keep_history:
            self.record.append(*steps)
        joints = self._filter.read_joints(posterior)
        return self._row_builder.build_row(index, status, posterior, scan, joints, hinted.detections, dropped_before)

    def _initiate(self, ideal: Detections, timestamp_s: float) -> None:
        """Begin a track where the blobs show a palm, wherever it was."""
        found = self._filter.find_palm(ideal, self._manager.widest_turn_limits())
        if found is not None and self._manager.try_initiate(found, timestamp_s):
            self._filter.start(self._filter.estimate_from_found(found))

    def _predict_with_labels(
        self, hinted: LabelledDetections, ideal: Detections, timestamp_s: float
    ) -> tuple[PredictedMeasurement, Scan, bool]:
        """The prediction, what the frame brings, and whether a disc of the palm begins anew where a person has just
        said that it is."""
        named, dt_s = hinted.labelled, self._manager.time_step_s(timestamp_s)
        if named is not None:
            self._filter.restart_labelled_digit(named)
        predicted = self._filter.predict(dt_s)
        scan = self._filter.build_scan(predicted, ideal, timestamp_s, dt_s)
        if named is None:
            return predicted, scan, False
        self._labels.mark_applied(named)
        self._row_builder.reset_consistency()
        placed = self._filter.place_marker(named, predicted, scan)
        return (predicted, scan, False) if placed is None else (placed, scan, True)

    def _reacquire(self, posterior: Posterior, scan: Scan) -> Posterior | None:
        """The update from a place found without prediction, where too little of the palm is where it was predicted or
        the prediction was vague; None where that explains the frame no better."""
        manager, turn_sd_rad, seen = self._manager, posterior.turn_sd_rad, posterior.seen_count
        left = int(np.count_nonzero(posterior.unassigned))
        is_over = manager.can_be_flipped(seen, left) and not self._filter.is_rotation_measured(posterior)
        if not (is_over or manager.is_reacquisition_due(seen, left, turn_sd_rad)):
            return None
        is_vague, rotation = manager.is_vague(turn_sd_rad), posterior.predicted.nominal.rotation_w2_w0
        ideal = scan.ideal if is_vague else scan.ideal.subset(~posterior.is_finger)
        found = self._filter.find_palm(ideal, manager.turn_limits(rotation, scan.timestamp_s))
        if found is None or not (is_vague or found.count > seen):
            return None
        if found.count <= MIN_FOUND_MARKERS and self._filter.is_contradicted(found, posterior):
            return None
        is_expected = angle_between_rad(rotation, found.rotation_w2_w0) < TURN_SLACK_RAD
        if is_vague and not (is_expected or manager.is_confirmed(found, scan.timestamp_s)):
            return None
        there = self._filter.update(self._filter.predict_from_found(found, posterior.predicted), scan)
        is_agreed = (
            turn_sd_rad < MAX_TRUSTED_SD_RAD
            and np.array_equal(there.palm.assigned, posterior.palm.assigned)
            and self._filter.is_consistent(posterior)
        )
        if is_agreed or there.seen_count < max(MIN_PALM_MARKERS + 1, seen):
            return None
        manager.accept_found(found)
        return there

    def _update_status(self, posterior: Posterior, scan: Scan) -> TrackStatus:
        if self._manager.is_refuted(posterior.seen_count, scan.timestamp_s):
            return TrackStatus.LOST
        self._filter.learn(posterior, scan.dt_s)
        fits = self._filter.is_consistent(posterior)
        return self._manager.update_status(scan.timestamp_s, posterior.seen_count, is_consistent=fits)

    def _drop_track(self, timestamp_s: float) -> None:
        self._filter.drop_track()
        self._manager.drop_track(timestamp_s)

    def _build_lost_frame(
        self, index: int, timestamp_s: float, detections: Detections, dropped_before: int
    ) -> TrackedFrame:
        self._drop_track(timestamp_s)
        if self._keep_history:
            self.record.append(FilterStep(timestamp_s, None, self._filter.motion.initial_probability, False), None)
        return self._row_builder.build_lost_row(index, timestamp_s, detections, dropped_before)

    def _predict_pixels(self, timestamp_s: float) -> FloatArray:
        """Where the markers should be in the picture (M, 2), NaN while the hand is lost."""
        expected = self.predict_measurement(timestamp_s)
        if expected is None:
            return np.full((len(self.markers), 2), np.nan)
        return self._filter.view.camera.distort(expected.pixel)

    def smooth(self) -> list[KinematicState]:
        """Every frame so far in the light of all the others; needs the history kept."""
        return self.record.smooth()

    def pop_steps(self) -> FilterSteps:
        """Give up what :meth:`smooth` needs of the frames so far, for another tracker of the same hand."""
        history = self.record.history
        return self.record.pop_steps(self._filter.finger_start(history[-1].timestamp_s) if history else None)

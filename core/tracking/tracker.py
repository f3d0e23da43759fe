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
from carpus.core.camera import Camera
from carpus.core.hand.protocols import MarkerProtocol
from carpus.core.tracking.consistency import ConsistencyTest, passed_over
from carpus.core.tracking.finger_model import FingerModel
from carpus.core.tracking.hand_filter import HandFilter, Posterior, Scan, as_ideal
from carpus.core.tracking.hand_geometry import JointMoment, palm_of
from carpus.core.tracking.operator_hints import Hinted, OperatorHints
from carpus.core.tracking.palm_smoother import FilterStep
from carpus.core.tracking.predicted_measurement import MarkerOrder, PredictedMeasurement
from carpus.core.tracking.reacquire import MIN_FOUND_DISCS
from carpus.core.tracking.readout import Readout, lost_frame, lost_moment
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.tracking.smoother_record import KeptSteps, SmoothedHand, SmootherRecord
from carpus.core.tracking.track_manager import (
    MIN_PALM_DISCS,
    SHARE_WINDOW_S,
    TOO_VAGUE_RAD,
    TURN_SLACK_RAD,
    TrackManager,
    turned_rad,
)
from carpus.core.types import Detections, FloatArray, Moment, SpotAnswer, TrackedFrame, TrackStatus

_SAME_AXIS = np.eye(2)


@dataclass(frozen=True, slots=True)
class _Rows:
    """Of M markers the ``blob`` (M,) or -1, ``expected_px`` and ``seen_px`` (M, 2), ``seen_depth_m`` (M,),
    ``expected_cov_px2`` (M, 2, 2) and ``disc_cam_m`` (M, 3); the ``worst`` of them contributes most to the NIS."""

    blob: NDArray[np.int64]
    expected_px: FloatArray
    seen_px: FloatArray
    seen_depth_m: FloatArray
    expected_cov_px2: FloatArray
    disc_cam_m: FloatArray
    worst: int


class FrameResults:
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
        joint_count = 0 if model is None else model.readout.reading.chain.size
        self.lost_moment: Moment = lost_moment(joint_count, self._markers)
        self._doubt = ConsistencyTest(self._markers)
        self._recent: deque[tuple[float, NDArray[np.int64]]] = deque()
        self._nothing = np.zeros(joint_count or 3, dtype=np.int64)
        self._recently_measured = self._nothing

    def forget_doubt(self) -> None:
        """The hand begins anew: nothing is contradicted."""
        self._doubt.forget()

    def told(
        self,
        index: int,
        status: TrackStatus,
        posterior: Posterior,
        scan: Scan,
        joints: JointMoment | None,
        detections: Detections,
        dropped_before: int,
    ) -> TrackedFrame:
        """The row of a tracked or predicted frame."""
        fingers, view = posterior.fingers, posterior.predicted.view
        row = self._by_marker(posterior, joints, detections)
        self._remember(scan.timestamp_s, self._directly(posterior.seen, row.blob))
        moment = self._readout.moment(posterior.estimate)
        if joints is not None:
            moment = self._readout.with_joints(moment, joints, posterior.estimate)
        nis, dof = posterior.palm.nis, posterior.palm.dof
        if fingers is not None:
            nis, dof = sum(part for part in (nis, fingers.nis) if not math.isnan(part)), dof + fingers.dof
        over = passed_over(row.disc_cam_m, row.blob, scan.ideal, view.camera)
        doubt = self._doubt.watch(scan.dt_s, over, nis, dof, row.worst)
        if doubt.is_any and status is TrackStatus.TRACKED:
            status, moment = TrackStatus.DOUBTFUL, _widened(moment, doubt.widens)
        return TrackedFrame(
            index=index,
            timestamp_s=scan.timestamp_s,
            status=status,
            moment=moment,
            marker_position_cam_m=row.disc_cam_m,
            marker_predicted_px=view.camera.distort(row.expected_px),
            marker_predicted_cov_px2=row.expected_cov_px2,
            marker_measured_px=row.seen_px,
            marker_measured_depth_m=row.seen_depth_m,
            detections=detections,
            dropped_before=dropped_before,
            measured_share=self._share(),
            nis=nis if dof else math.nan,
            nis_dof=dof,
            doubted=doubt.doubted,
        )

    def lost(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int) -> TrackedFrame:
        """The row of a frame in which the hand is lost."""
        self.forget_doubt()
        self._remember(timestamp_s, self._nothing)
        return lost_frame(
            index, timestamp_s, self.lost_moment, self._markers, detections, dropped_before, self._share()
        )

    def _by_marker(self, posterior: Posterior, joints: JointMoment | None, detections: Detections) -> _Rows:
        """Of each disc where it was predicted and how surely, the palm's before the update, the fingers' on the palm as
        updated; the blob taken for it, and where it is by now."""
        predicted, palm, fingers, order = posterior.predicted, posterior.palm, posterior.fingers, self._order
        noise = self._settings.noise
        blob = order.by_marker(palm.assigned, None if fingers is None else fingers.blob)
        seen_px, seen_depth_m = np.full((blob.size, 2), np.nan), np.full(blob.size, np.nan)
        if len(detections):
            is_seen = blob >= 0
            seen_px = np.where(is_seen[:, None], detections.pixel.take(blob, 0), np.nan)
            seen_depth_m = np.where(is_seen, detections.depth_m.take(blob), np.nan)
        pixel, covariance = predicted.mean[:, :2], predicted.covariance[:, :2, :2]
        discs = predicted.view.discs_cam_m(posterior.estimate)
        surprise = np.vecdot(palm.raw_residual, palm.raw_residual)
        if fingers is not None and joints is not None:
            pixel = order.by_marker(pixel, fingers.predicted_px)
            covariance = order.by_marker(covariance, fingers.predicted_cov_px2)
            discs, surprise = (order.by_marker(discs, joints.disc_cam_m), order.by_marker(surprise, fingers.surprise))
        covariance = covariance + noise.pixel_sd_px**2 * _SAME_AXIS
        return _Rows(blob, pixel, seen_px, seen_depth_m, covariance, discs, int(surprise.argmax()))

    def _directly(self, palm_seen: int, assigned: NDArray[np.int64]) -> NDArray[np.int64]:
        """Discs of the palm (3,), or whether each joint (J,), that were measured directly."""
        if self._model is None:
            return np.full(3, palm_seen)
        return np.asarray((assigned >= 0)[self._model.readout.direct_markers].all(axis=-1), dtype=np.int64)

    def _remember(self, timestamp_s: float, measured: NDArray[np.int64]) -> None:
        self._recent.append((timestamp_s, measured))
        self._recently_measured = self._recently_measured + measured
        while self._recent[0][0] < timestamp_s - SHARE_WINDOW_S:
            self._recently_measured = self._recently_measured - self._recent.popleft()[1]

    def _share(self) -> FloatArray:
        """Share of direct measurement of the palm (3,) or of each joint (J,) lately."""
        possible = self._order.palm.size if self._model is None else 1
        return np.asarray(self._recently_measured / (possible * len(self._recent)))


def _widened(moment: Moment, by: float) -> Moment:
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
        self._manager = TrackManager(MIN_FOUND_DISCS, settings.lost_after_s, amid_digits=protocol.has_fingers)
        self._hints = OperatorHints(self.markers)
        model = None if self._filter.fingers is None else self._filter.fingers.model
        self._results = FrameResults(protocol, self._filter.order, model, self._filter.readout, settings)
        palm = palm_of(calibration)
        self.record = SmootherRecord(
            SmoothedHand(
                self._filter.motion,
                self._filter.view,
                model,
                lambda: Readout(palm, camera, settings.marker_radius_m),
                self._results.lost_moment,
            )
        )

    def begin_at_neutral(self, at_s: float | None = None) -> None:
        """Start (again) from the calibrated pose, the hand at rest; at that time, or else with the next frame."""
        self._filter.begin_at_neutral()
        self._manager.begin_at_neutral(at_s)
        self._results.forget_doubt()

    def begin_anywhere(self, after_s: float) -> None:
        """After that time look for the hand: what was believed of it came of a wrong name. Its anatomy stays known."""
        self._lose(after_s)
        self._results.forget_doubt()

    @property
    def is_lost(self) -> bool:
        return self._manager.is_lost

    def hear(self, answer: SpotAnswer, *, is_asked_again: bool = True) -> None:
        """What a person says of the blue spots of a picture shown a moment ago, from the next frame on. To be called
        between frames, where they are tracked."""
        self._hints.hear(answer, is_asked_again=is_asked_again)

    def taken_up(self) -> list[SpotAnswer]:
        """The answers that the frames since the last call have taken up, with the spots as they lay there."""
        return self._hints.taken_up()

    def expect(self, timestamp_s: float) -> PredictedMeasurement | None:
        """Where to look at that time; None when the hand is lost."""
        if self.is_lost or self._manager.is_past(timestamp_s):
            return None
        return self._filter.predict(self._manager.since_last_s(timestamp_s))

    def would_miss(self, blobs: Detections) -> bool:
        """Whether blobs of a narrowed search are too few to hold the palm, or all of it where the last did not show
        how it is turned, so that the rest is worth a look."""
        least = MIN_PALM_DISCS if self._filter.showed_turn else self._filter.order.palm.size - 1
        return len(blobs) <= least

    def step(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int = 0) -> TrackedFrame:
        """Associate the blobs of one frame and update by them; the frame's result."""
        hinted = self._hints.screened(index, timestamp_s, detections, lambda: self._expected_px(timestamp_s))
        frame = self._tracked(index, timestamp_s, hinted, dropped_before)
        self._hints.hold(frame.marker_measured_px)
        if hinted.detections is not detections:
            frame = replace(frame, detections=detections, no_disc=hinted.no_disc)
        return frame

    def _tracked(self, index: int, timestamp_s: float, hinted: Hinted, dropped_before: int) -> TrackedFrame:
        """The frame's result of the blobs that may be discs."""
        ideal = as_ideal(hinted.detections, self._filter.view.camera)
        is_linked = self._manager.next_frame(timestamp_s)
        if self._manager.is_past(timestamp_s):
            self._lose(timestamp_s)
        if self.is_lost:
            is_linked = False
            self._initiate(ideal, timestamp_s)
        if self.is_lost:
            return self._lost(index, timestamp_s, hinted.detections, dropped_before)

        predicted, scan, said = self._predicted_as_hinted(hinted, ideal, timestamp_s)
        posterior = self._filter.update(predicted, scan)
        is_linked = is_linked and not said
        reacquired = self._reacquired(posterior, scan)
        if reacquired is not None:
            # A vague prediction has nothing against the place found: the smoother may go on through it.
            is_linked = is_linked and self._manager.is_vague(posterior.turn_sd_rad)
            posterior = reacquired
        elif self._manager.is_ambiguous(posterior.seen, posterior.turn_sd_rad) or (
            self._manager.is_unsure(posterior.seen, posterior.turn_sd_rad)
            and self._filter.is_other_hand(posterior, scan)
        ):
            posterior = self._filter.update(predicted, scan.without_blobs())

        status = self._status_after(posterior, scan)
        if status is TrackStatus.LOST:
            return self._lost(index, timestamp_s, hinted.detections, dropped_before)
        steps = self._filter.accept(posterior, scan, is_seen=status is TrackStatus.TRACKED, linked=is_linked)
        if self._keep_history:
            self.record.append(*steps)
        joints = self._filter.joints(posterior)
        return self._results.told(index, status, posterior, scan, joints, hinted.detections, dropped_before)

    def _initiate(self, ideal: Detections, timestamp_s: float) -> None:
        """Begin a track where the blobs show a palm, wherever it was."""
        found = self._filter.find(ideal, self._manager.anyhow())
        if found is not None and self._manager.initiates(found, timestamp_s):
            self._filter.begin(self._filter.estimate_at(found))

    def _predicted_as_hinted(
        self, hinted: Hinted, ideal: Detections, timestamp_s: float
    ) -> tuple[PredictedMeasurement, Scan, bool]:
        """The prediction, what the frame brings, and whether a disc of the palm begins anew where a person has just
        said that it is."""
        named, dt_s = hinted.named, self._manager.since_last_s(timestamp_s)
        if named is not None:
            self._filter.look_anew(named)
        predicted = self._filter.predict(dt_s)
        scan = self._filter.scan(predicted, ideal, timestamp_s, dt_s)
        if named is None:
            return predicted, scan, False
        self._hints.take_up(named)
        self._results.forget_doubt()
        placed = self._filter.place_disc(named, predicted, scan)
        return (predicted, scan, False) if placed is None else (placed, scan, True)

    def _reacquired(self, posterior: Posterior, scan: Scan) -> Posterior | None:
        """The update from a place found without prediction, where too little of the palm is where it was predicted or
        the prediction was vague; None where that explains the frame no better."""
        manager, turn_sd_rad, seen = self._manager, posterior.turn_sd_rad, posterior.seen
        left = int(np.count_nonzero(posterior.unassigned))
        is_over = manager.may_be_turned_over(seen, left) and not self._filter.shows_turn(posterior)
        if not (is_over or manager.looks_anew(seen, left, turn_sd_rad)):
            return None
        is_vague, rotation = manager.is_vague(turn_sd_rad), posterior.predicted.nominal.rotation_w2_w0
        ideal = scan.ideal if is_vague else scan.ideal.only(~posterior.is_finger)
        found = self._filter.find(ideal, manager.facing(rotation, scan.timestamp_s))
        if found is None or not (is_vague or found.count > seen):
            return None
        if found.count <= MIN_FOUND_DISCS and self._filter.is_against(found, posterior):
            return None
        is_expected = turned_rad(rotation, found.rotation_w2_w0) < TURN_SLACK_RAD
        if is_vague and not (is_expected or manager.is_borne_out(found, scan.timestamp_s)):
            return None
        there = self._filter.update(self._filter.predicted_at(found, posterior.predicted), scan)
        is_agreed = (
            turn_sd_rad < TOO_VAGUE_RAD
            and np.array_equal(there.palm.assigned, posterior.palm.assigned)
            and self._filter.fits(posterior)
        )
        if is_agreed or there.seen < max(MIN_PALM_DISCS + 1, seen):
            return None
        manager.take_for(found)
        return there

    def _status_after(self, posterior: Posterior, scan: Scan) -> TrackStatus:
        if self._manager.is_refuted(posterior.seen, scan.timestamp_s):
            return TrackStatus.LOST
        self._filter.learn(posterior, scan.dt_s)
        fits = self._filter.fits(posterior)
        return self._manager.status_after(scan.timestamp_s, posterior.seen, fits=fits)

    def _lose(self, timestamp_s: float) -> None:
        self._filter.lose()
        self._manager.lose(timestamp_s)

    def _lost(self, index: int, timestamp_s: float, detections: Detections, dropped_before: int) -> TrackedFrame:
        self._lose(timestamp_s)
        if self._keep_history:
            self.record.append(FilterStep(timestamp_s, None, self._filter.motion.at_rest, False), None)
        return self._results.lost(index, timestamp_s, detections, dropped_before)

    def _expected_px(self, timestamp_s: float) -> FloatArray:
        """Where the markers should be in the picture (M, 2), NaN while the hand is lost."""
        expected = self.expect(timestamp_s)
        if expected is None:
            return np.full((len(self.markers), 2), np.nan)
        return self._filter.view.camera.distort(expected.pixel)

    def smoothed(self) -> list[Moment]:
        """Every frame so far in the light of all the others; needs the history kept."""
        return self.record.smoothed()

    def hand_over(self) -> KeptSteps:
        """Give up what :meth:`smoothed` needs of the frames so far, for another tracker of the same hand."""
        history = self.record.history
        return self.record.hand_over(self._filter.finger_start(history[-1].timestamp_s) if history else None)

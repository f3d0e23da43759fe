"""The frame's result of an accepted update: angles and places, how sure they are, and how directly they were seen."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.hand.marker_protocol import MarkerProtocol
from carpus.core.tracking.consistency import ConsistencyTest, Inconsistency, passed_over
from carpus.core.tracking.finger_model import FingerModel
from carpus.core.tracking.hand_filter import Posterior, Scan
from carpus.core.tracking.hand_geometry import JointMoment
from carpus.core.tracking.predicted_measurement import MarkerOrder
from carpus.core.tracking.readout import Readout, lost_frame, lost_moment
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.types import Detections, FloatArray, Moment, TrackedFrame, TrackStatus

_SAME_AXIS = np.eye(2)


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
        joint_count = 0 if model is None else model.reading.chain.size
        self.lost_moment: Moment = lost_moment(joint_count, self._markers)
        self._doubt = ConsistencyTest(self._markers, settings.doubt)
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
        estimate, fingers, by_marker = posterior.estimate, posterior.fingers, self._order.by_marker
        assigned = by_marker(posterior.palm.assigned, None if fingers is None else fingers.blob)
        self._remember(scan.timestamp_s, self._directly(posterior.seen, assigned))
        used = np.flatnonzero(assigned >= 0)
        measured_px, measured_depth_m = np.full((assigned.size, 2), np.nan), np.full(assigned.size, np.nan)
        measured_px[used], measured_depth_m[used] = detections.pixel[assigned[used]], detections.depth_m[assigned[used]]
        predicted_px, predicted_cov_px2 = self._predicted_px(posterior)
        view = posterior.predicted.view
        discs, moment = view.discs_cam_m(estimate), self._readout.moment(estimate)
        if joints is not None:
            moment = self._readout.with_joints(moment, joints, estimate)
            discs = by_marker(discs, joints.disc_cam_m)
        nis, dof = posterior.palm.nis, posterior.palm.dof
        if fingers is not None:
            nis, dof = float(np.nansum([nis, fingers.nis])), dof + fingers.dof
        doubt = self._doubted(posterior, scan, assigned, discs, nis, dof)
        if doubt.is_any and status is TrackStatus.TRACKED:
            status, moment = TrackStatus.DOUBTFUL, _widened(moment, doubt.widens)
        return TrackedFrame(
            index=index,
            timestamp_s=scan.timestamp_s,
            status=status,
            moment=moment,
            marker_position_cam_m=discs,
            marker_predicted_px=view.camera.distort(predicted_px),
            marker_predicted_cov_px2=predicted_cov_px2 + self._settings.noise.pixel_sd_px**2 * _SAME_AXIS,
            marker_measured_px=measured_px,
            marker_measured_depth_m=measured_depth_m,
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

    def _predicted_px(self, posterior: Posterior) -> tuple[FloatArray, FloatArray]:
        """Where each disc was predicted (M, 2) and its covariance (M, 2, 2): the palm's before the update, the fingers'
        on the palm as updated."""
        predicted, fingers = posterior.predicted, posterior.fingers
        pixel, covariance = predicted.mean[:, :2], predicted.covariance[:, :2, :2]
        if fingers is None:
            return pixel, covariance
        by_marker = self._order.by_marker
        return by_marker(pixel, fingers.predicted_px), by_marker(covariance, fingers.predicted_cov_px2)

    def _doubted(
        self,
        posterior: Posterior,
        scan: Scan,
        assigned: NDArray[np.int64],
        discs_cam_m: FloatArray,
        nis: float,
        dof: int,
    ) -> Inconsistency:
        camera, fingers = posterior.predicted.view.camera, posterior.fingers
        surprise = (posterior.palm.raw_residual**2).sum(axis=-1)
        surprise = self._order.by_marker(surprise, None if fingers is None else fingers.surprise)
        over = passed_over(
            camera.project(discs_cam_m), discs_cam_m[:, 2], assigned, scan.ideal.pixel, scan.ideal.depth_m,
            camera.fx_px, self._settings.doubt,
        )  # fmt: skip
        return self._doubt.watch(scan.dt_s, over, nis, dof, int(surprise.argmax()))

    def _directly(self, palm_seen: int, assigned: NDArray[np.int64]) -> NDArray[np.int64]:
        """Discs of the palm (3,), or whether each joint (J,), that were measured directly."""
        if self._model is None:
            return np.full(3, palm_seen)
        return np.asarray((assigned >= 0)[self._model.direct_markers].all(axis=-1), dtype=np.int64)

    def _remember(self, timestamp_s: float, measured: NDArray[np.int64]) -> None:
        self._recent.append((timestamp_s, measured))
        self._recently_measured = self._recently_measured + measured
        while self._recent[0][0] < timestamp_s - self._settings.holding.share_window_s:
            self._recently_measured = self._recently_measured - self._recent.popleft()[1]

    def _share(self) -> FloatArray:
        """Share of direct measurement of the palm (3,) or of each joint (J,) lately."""
        possible = self._order.palm.size if self._model is None else 1
        return np.asarray(self._recently_measured / (possible * len(self._recent)))


def _widened(moment: Moment, by: float) -> Moment:
    return replace(
        moment,
        angles_sd_rad=moment.angles_sd_rad * by,
        joint_angles_sd_rad=moment.joint_angles_sd_rad * by,
    )

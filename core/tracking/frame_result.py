"""The frame's result of an accepted update: angles and places, how sure they are, and how directly they were seen."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carpus.core.hand.protocols import MarkerProtocol
from carpus.core.kernels.choice import NOTHING, in_c
from carpus.core.tracking.consistency import ConsistencyTest, passed_over
from carpus.core.tracking.finger_model import FingerModel
from carpus.core.tracking.hand_filter import Posterior, Scan
from carpus.core.tracking.hand_geometry import JointMoment
from carpus.core.tracking.predicted_measurement import MarkerOrder
from carpus.core.tracking.readout import Readout, lost_frame, lost_moment
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.types import Detections, FloatArray, Moment, TrackedFrame, TrackStatus

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
        fingers, view = posterior.fingers, posterior.predicted.view
        row = self._by_marker(posterior, joints, detections)
        self._remember(scan.timestamp_s, self._directly(posterior.seen, row.blob))
        moment = self._readout.moment(posterior.estimate)
        if joints is not None:
            moment = self._readout.with_joints(moment, joints, posterior.estimate)
        nis, dof = posterior.palm.nis, posterior.palm.dof
        if fingers is not None:
            nis, dof = sum(part for part in (nis, fingers.nis) if not math.isnan(part)), dof + fingers.dof
        over = passed_over(row.disc_cam_m, row.blob, scan.ideal, view.camera, self._settings.doubt)
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
        if (kernels := in_c()) is not None:
            count = order.source.size
            expected_px, seen_px = np.empty((2, count, 2))
            blob, covariance = np.empty(count, dtype=np.int64), np.empty((count, 2, 2))
            seen_depth_m, disc_cam_m = np.empty(count), np.empty((count, 3))
            worst, digits = np.empty(1, dtype=np.int64), (NOTHING,) * 5
            if fingers is not None and joints is not None:
                scene, update = fingers.scene, fingers.named.update
                digits = fingers.blob, scene.linearised.value, scene.spread, update.residual, joints.disc_cam_m
            kernels.markers_told(
                count, len(detections), order.source, palm.assigned, predicted.mean, predicted.covariance,
                palm.raw_residual, posterior.estimate.value, posterior.estimate.rotation_w2_w0, predicted.view.numbers,
                *digits, detections.pixel, detections.depth_m, noise.pixel_sd_px, blob, seen_px, seen_depth_m,
                expected_px, covariance, disc_cam_m, worst,
            )  # fmt: skip
            return _Rows(blob, expected_px, seen_px, seen_depth_m, covariance, disc_cam_m, worst.item())
        blob = order.by_marker(palm.assigned, None if fingers is None else fingers.blob)
        used = np.flatnonzero(blob >= 0)
        seen_px, seen_depth_m = np.full((blob.size, 2), np.nan), np.full(blob.size, np.nan)
        seen_px[used], seen_depth_m[used] = detections.pixel[blob[used]], detections.depth_m[blob[used]]
        pixel, covariance = predicted.mean[:, :2], predicted.covariance[:, :2, :2]
        discs, surprise = predicted.view.discs_cam_m(posterior.estimate), (palm.raw_residual**2).sum(axis=-1)
        if fingers is not None and joints is not None:
            pixel = order.by_marker(pixel, fingers.predicted_px)
            covariance = order.by_marker(covariance, fingers.predicted_cov_px2)
            discs, surprise = (
                order.by_marker(discs, joints.disc_cam_m),
                order.by_marker(surprise, fingers.surprise),
            )
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

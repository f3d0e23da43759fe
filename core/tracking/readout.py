"""From the filter's belief to what people read: wrist frame, clinical angles, standard deviations.

The filter tracks the discs as a body whose axes are those of W0 as calibrated. While the palm's shape is
refined, the true axes of W follow from the better known discs; the readout turns the result into them.
The covariance of an angle holds both the pose's and the calibration's part.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core import so3
from core.calibration.result import Calibration
from core.hand import clinical_angles
from core.hand.wrist_frame import wrist_axes_sensitivity
from core.tracking.hand_geometry import JointMoment, PalmInBody
from core.tracking.state import Belief, StateLayout
from core.types import Detections, FloatArray, Moment, TrackedFrame, TrackStatus

_NONE = np.empty(0)
_NOWHERE = np.empty((0, 3))
_IDENTITY = np.eye(3)
_AXES = np.arange(3)
_DORSAL = np.array([0.0, 0.0, 1.0])
_SHAPE_MOVED_M = 3e-4
"""The axes are computed anew when a disc's refined place has moved by this much; before, to first order."""


class Readout:
    """Reads beliefs of one calibrated palm; remembers only the axes of the last shape."""

    def __init__(self, calibration: Calibration, layout: StateLayout) -> None:
        self._layout = layout
        self._side = calibration.clicks.side
        self._disc_m = calibration.marker_position_w0_m
        self._start = clinical_angles.rotation_from_angles(calibration.start_angles_rad, self._side)
        self._has_start = bool(np.any(calibration.start_angles_rad))
        self._axes_shape = np.full(layout.shape_count, np.nan)
        self._axes = np.eye(3)
        self._sensitivity = np.zeros((3, 18))
        self._unrefined_turn = _neutral_turn_covariance(calibration)

    def _axes_of(self, shape: FloatArray) -> tuple[FloatArray, FloatArray]:
        moved_m = shape - self._axes_shape
        if not np.abs(moved_m).max() <= _SHAPE_MOVED_M:  # so too at first
            self._axes, self._sensitivity = wrist_axes_sensitivity(self._disc_m + shape.reshape(-1, 3), _DORSAL)
            self._axes_shape = shape.copy()
            return self._axes, self._sensitivity
        return self._axes @ so3.exp(self._sensitivity @ moved_m), self._sensitivity

    def palm(self, belief: Belief) -> tuple[PalmInBody, FloatArray]:
        """The palm as refined, for the fingers, and the covariance (3, 3) of its axes' turn, in the body."""
        layout, p = self._layout, belief.covariance
        discs = self._disc_m
        if layout.shape_count:
            axes, sensitivity = self._axes_of(belief.shape)
            discs = discs + belief.shape.reshape(-1, 3)
            error = np.zeros((3, layout.size))
            error[_AXES, layout.turn.start + _AXES] = 1.0
            error[:, layout.shape] = axes @ sensitivity
            covariance = error @ p @ error.T
        else:
            axes = np.eye(3)
            covariance = p[layout.turn, layout.turn] + self._unrefined_turn
        return PalmInBody.of(discs, axes, self._side), covariance

    def moment(self, belief: Belief) -> Moment:
        """Wrist pose, rates, angles and their standard deviations of a single belief."""
        layout, p = self._layout, belief.covariance
        if layout.shape_count:
            axes, sensitivity = self._axes_of(belief.shape)
            wrist_disc = self._disc_m[0] + belief.shape[:3]
            lever = belief.rotation_w2_w0 @ wrist_disc
            position = axes.T @ (belief.position_m + lever - wrist_disc)
            rotation = axes.T @ belief.rotation_w2_w0 @ axes
            error = np.zeros((3, layout.size))
            error[:, layout.turn] = axes.T
            # The turn of the axes enters before and after: R' = Exp(-a) R Exp(a).
            error[:, layout.shape] = (_IDENTITY - rotation.T) @ sensitivity
            turn_covariance = error @ p @ error.T
        else:
            axes, position, rotation = _IDENTITY, belief.position_m, belief.rotation_w2_w0
            turn_covariance = p[layout.turn, layout.turn] + rotation.T @ self._unrefined_turn @ rotation
        velocity = axes.T @ belief.velocity_m_s
        # In eq. (1) the angular velocity is white: there is none to report.
        rate = axes.T @ belief.rate_rad_s if layout.has_rates else np.full(3, np.nan)
        shown = self._start @ rotation if self._has_start else rotation
        angles, by_turn, zyz = clinical_angles.read_one(shown, self._side)
        variance = np.vecdot(by_turn @ turn_covariance, by_turn)
        return Moment(
            position,
            velocity,
            shown,
            rate,
            angles,
            np.sqrt(np.maximum(variance, 0.0)),
            zyz,
            belief.joints_rad,
            _NONE,
            _NONE,
            _NOWHERE,
        )

    def with_joints(self, moment: Moment, joints: JointMoment) -> Moment:
        """The moment with what is known of the fingers."""
        rotation = self._start.T @ moment.rotation_w2_w0
        return replace(
            moment,
            joint_angles_rad=joints.angles_rad,
            joint_angles_sd_rad=joints.sd_rad,
            joint_velocity_rad_s=joints.rate_rad_s,
            joint_position_m=moment.position_m + joints.joint_w2_m @ rotation.T,
        )


def _neutral_turn_covariance(calibration: Calibration) -> FloatArray:
    """Covariance (3, 3) of the turn that the discs' calibration errors give the whole palm."""
    palm = np.array(calibration.clicks.protocol.palm)
    discs = calibration.marker_position_w0_m[palm]
    centred = so3.skew(discs - discs.mean(axis=0))
    inverse = np.linalg.inv(np.einsum("mji,mjk->ik", centred, centred))
    by_disc = inverse @ centred  # (M, 3, 3)
    covariance = calibration.marker_covariance_w0_m2[palm]
    return np.asarray(np.einsum("mij,mjk,mlk->il", by_disc, covariance, by_disc))


def lost_moment(joint_count: int, marker_count: int) -> Moment:
    """Nothing is known of ``joint_count`` joint angles, nor of the ``marker_count`` joint centres that go with them."""
    three, joints = np.full(3, np.nan), np.full(joint_count, np.nan)
    places = np.full((marker_count if joint_count else 0, 3), np.nan)
    return Moment(three, three, np.full((3, 3), np.nan), *(three,) * 4, *(joints,) * 3, places)


def shown_frame(
    index: int,
    timestamp_s: float,
    status: TrackStatus,
    moment: Moment,
    *,
    marker_position_cam_m: FloatArray,
    predicted_px: FloatArray,
    predicted_cov_px2: FloatArray,
    measured_px: FloatArray,
    measured_depth_m: FloatArray,
    detections: Detections,
    dropped_before: int,
    measured_share: FloatArray,
    nis: float,
    nis_dof: int,
) -> TrackedFrame:
    """The whole row of one frame."""
    return TrackedFrame(
        index,
        timestamp_s,
        status,
        moment.position_m,
        moment.velocity_m_s,
        moment.rotation_w2_w0,
        moment.angular_velocity_rad_s,
        moment.angles_rad,
        moment.angles_sd_rad,
        moment.angles_zyz_rad,
        moment.joint_angles_rad,
        moment.joint_angles_sd_rad,
        moment.joint_velocity_rad_s,
        moment.joint_position_m,
        marker_position_cam_m,
        predicted_px,
        predicted_cov_px2,
        measured_px,
        measured_depth_m,
        detections,
        dropped_before,
        measured_share,
        nis,
        nis_dof,
    )


def lost_frame(
    index: int,
    timestamp_s: float,
    moment: Moment,
    marker_count: int,
    detections: Detections,
    dropped_before: int,
    measured_share: FloatArray,
) -> TrackedFrame:
    """The row of a frame in which the hand is lost: nothing is known but the blobs."""
    per_marker = np.full((marker_count, 2), np.nan)
    return shown_frame(
        index,
        timestamp_s,
        TrackStatus.LOST,
        moment,
        marker_position_cam_m=np.full((marker_count, 3), np.nan),
        predicted_px=per_marker,
        predicted_cov_px2=np.full((marker_count, 2, 2), np.nan),
        measured_px=per_marker,
        measured_depth_m=np.full(marker_count, np.nan),
        detections=detections,
        dropped_before=dropped_before,
        measured_share=measured_share,
        nis=float("nan"),
        nis_dof=0,
    )

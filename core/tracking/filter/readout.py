"""Readout of the estimate: wrist frame, clinical angles, joints, standard deviations.

The filter tracks the discs as a body whose axes are those of W0 as calibrated. While the palm's shape is refined, the
true axes of W follow from the better known discs; the readout turns the result into them. The covariance of an angle
holds both the pose's and the calibration's part, and of a sensor whose errors stay with the place the part that no
number of frames takes away: the filter counts each frame as new.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from carpus.core.calibration.result import Calibration, Clicks
from carpus.core.compiled.digit_images import compute_inherited
from carpus.core.compiled.digits import place_digits
from carpus.core.model import so3
from carpus.core.model.camera import Camera
from carpus.core.model.hand import clinical_angles
from carpus.core.model.hand.clinical_angles import wrist_axes_sensitivity
from carpus.core.model.hand.protocols import markers_at_joint
from carpus.core.model.types import Detections, FloatArray, KinematicState, TrackedFrame, TrackStatus
from carpus.core.tracking.filter.digit_filter import OBSERVED, RATES, DigitBase, DigitLinearisation, DigitView
from carpus.core.tracking.filter.hand_geometry import (
    FLEXION_SLOT,
    N_DIGITS,
    N_DISCS,
    N_SLOTS,
    JointAngleMap,
    JointState,
    PalmGeometry,
)
from carpus.core.tracking.filter.palm_state import POSE, SHAPE, SKIN, TURN, PalmEstimate, PalmView
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.filter.soft_tissue import CUPPING_DISCS

_NONE = np.empty(0)
_NOWHERE = np.empty((0, 3))
_STILL = np.eye(3)
_CUPPING = slice(int(CUPPING_DISCS[0]), int(CUPPING_DISCS[-1]) + 1)
_CUPPING_ROWS = SKIN.start + 3 * CUPPING_DISCS + 2
_DORSAL = np.array([0.0, 0.0, 1.0])
_TILT_RANK_TOLERANCE = 1e-3  # share of the best known direction below which depths say nothing of a turn

MAX_SHAPE_CHANGE_M = 3e-4  # of a disc; beyond, the axes are computed again, below, to first order
SKIN_SD_RAD = 0.022  # of a joint, by discs that ride on gliding skin, however long it is measured
_DIP_OFFSET = 3  # the slot of a finger's DIP flexion beyond what PIP flexion brings with it
METACARPAL_M = 0.055  # of ring and little finger, from the joint at its base to its head (clinical reference 3.3)


@dataclass(frozen=True, slots=True)
class WristAxes:
    """Axes of W (3, 3) as columns in the tracked body, for a shape (18,), and their sensitivity (3, 18)."""

    axes: FloatArray
    sensitivity: FloatArray
    shape_m: FloatArray


def _turn_covariance(by_turn: FloatArray, by_shape: FloatArray, estimate: PalmEstimate) -> FloatArray:
    """Return the covariance (3, 3) of a turn that is ``by_turn`` (3, 3) d + ``by_shape`` (3, 18) s."""
    error = np.zeros((3, SHAPE.stop - TURN.start))
    error[:, :3], error[:, SHAPE.start - TURN.start :] = by_turn, by_shape
    read = slice(TURN.start, SHAPE.stop)
    return np.asarray(error @ estimate.covariance[read, read] @ error.T)


class Readout:
    """Reads estimates of one calibrated palm; stores only the axes of the last shape."""

    def __init__(self, calibration: Calibration, camera: Camera, disc_radius_m: float) -> None:
        self._sensor = sensor = camera.sensor
        self._disc_px_m = disc_radius_m * camera.fx_px
        # Readings that do not average, and errors alike over the whole palm, are counted in full as they are.
        self._has_stays = sensor.averages and sensor.stays_px == 0.0
        self._calibration = calibration
        self._side = calibration.clicks.side
        self._disc_m = calibration.marker_position_w0_m
        self._start = clinical_angles.rotation_from_angles(calibration.start_angles_rad, self._side)
        self._has_start = bool(np.any(calibration.start_angles_rad))
        self._axes: WristAxes | None = None
        self._turned: tuple[PalmEstimate, FloatArray] | None = None

    def _wrist_axes(self, estimate: PalmEstimate) -> tuple[WristAxes, FloatArray]:
        """Return the axes near the estimate's, and as its shape has turned them since, to first order (3, 3)."""
        # axes of a shape so near to the estimate's that they follow it to first order
        shape = estimate.value[SHAPE]
        if self._axes is None or np.abs(shape - self._axes.shape_m).max() > MAX_SHAPE_CHANGE_M:
            axes, sensitivity = wrist_axes_sensitivity(self._disc_m + shape.reshape(-1, 3), _DORSAL)
            self._axes = WristAxes(axes, sensitivity, shape.copy())
        known = self._axes
        if self._turned is None or self._turned[0] is not estimate:
            turn = so3.exp(known.sensitivity @ (estimate.value[SHAPE] - known.shape_m))
            self._turned = estimate, np.asarray(known.axes @ turn)
        return known, self._turned[1]

    def compute_base(self, estimate: PalmEstimate, view: PalmView) -> DigitBase:
        """Compute where the fingers sit on the palm as refined, and how the camera sees it.

        Ring and little metacarpal flex and take their fingers along; what else a disc moves is skin.
        """
        known, axes = self._wrist_axes(estimate)
        disc_m = self._disc_m + estimate.shape_m
        disc_m[_CUPPING, 1:] += estimate.skin_m[_CUPPING, 1:]
        cup, cup_sd = np.zeros((2, N_DIGITS))
        cup[-2:] = -estimate.skin_m[_CUPPING, 2] / METACARPAL_M
        cup_sd[-2:] = np.sqrt(estimate.covariance[_CUPPING_ROWS, _CUPPING_ROWS]) / METACARPAL_M
        palm = PalmGeometry.from_discs(disc_m, axes, self._side, cup, cup_sd)
        body_cam = view.rotation_w0_cam @ estimate.rotation_w2_w0
        to_camera = np.zeros((6, 6))
        to_camera[:3, :3], to_camera[3:, 3:] = view.rotation_w0_cam, body_cam
        pose = to_camera @ estimate.covariance[POSE[:, None], POSE] @ to_camera.T
        turn = body_cam @ _turn_covariance(_STILL, axes @ known.sensitivity, estimate) @ body_cam.T
        return DigitBase(palm, DigitView(*view.to_camera(estimate, palm.axes, palm.origin_m), view.camera), pose, turn)

    def read_kinematics(self, estimate: PalmEstimate) -> KinematicState:
        """
        Read wrist pose, rates, angles and their standard deviations of a single estimate.

        In the axes A of the wrist the rotation is Q = A' R A. Errors d of the turn and s of the shape, by which the
        axes turn S s, make of it Q Exp(A' d + (1 - Q') S s). The origin of W2 is the WRIST disc where the skin has
        carried it; the axes are those of the fixed unit.
        """
        known, axes = self._wrist_axes(estimate)
        disc = self._disc_m[0] + estimate.shape_m[0] + estimate.skin_m[0]
        rotation = axes.T @ estimate.rotation_w2_w0 @ axes
        covariance = _turn_covariance(axes.T, known.sensitivity - rotation.T @ known.sensitivity, estimate)
        if self._has_stays:
            covariance = covariance + axes.T @ self._tilt_covariance(estimate) @ axes
        shown = self._start @ rotation if self._has_start else rotation
        angles, by_turn, zyz = clinical_angles.compute_wrist_angles(shown, self._side)
        sd = np.sqrt(np.maximum(np.vecdot(by_turn @ covariance, by_turn), 0.0))
        # Places keep the axes of W0 as calibrated and stored, whatever is learnt of the palm; turns are read in the
        # axes as they are known by now, and what lies between the two goes with them.
        return KinematicState(
            estimate.position_m + estimate.rotation_w2_w0 @ disc, estimate.velocity_m_s,
            so3.log(axes @ self._start.T), shown, axes.T @ estimate.rate_rad_s, angles, sd, zyz, _NONE, _NONE, _NONE,
            _NOWHERE,
        )  # fmt: skip

    def _tilt_covariance(self, estimate: PalmEstimate) -> FloatArray:
        """Return the covariance (3, 3) of the palm's turn, in the body, by constant errors of depth.

        Depths tell how the palm is tilted to the camera, by the discs' distances from the centre; pixels tell the rest.
        """
        calibration = self._calibration
        disc_w0_m = estimate.position_m + (self._disc_m + estimate.shape_m) @ estimate.rotation_w2_w0.T
        turned = calibration.rotation_w0_cam @ estimate.rotation_w2_w0
        disc_cam_m = disc_w0_m @ calibration.rotation_w0_cam.T + calibration.translation_w0_cam_m
        middle = disc_cam_m.mean(axis=0)
        arm_m = np.cross((disc_cam_m - middle) @ turned, (middle / np.linalg.norm(middle)) @ turned)
        solved = np.linalg.pinv(arm_m.T @ arm_m, rcond=_TILT_RANK_TOLERANCE, hermitian=True) @ arm_m.T
        depth_m = disc_cam_m[:, 2]
        sd_m = self._sensor.disc_bias_sd_m(depth_m, np.pi * (self._disc_px_m / depth_m) ** 2)
        return np.asarray((solved * sd_m**2) @ solved.T)

    def with_joints(self, kinematics: KinematicState, joints: JointState, estimate: PalmEstimate) -> KinematicState:
        """Add the joints to the kinematics; their bones stand on the fixed unit, not on the skin."""
        rotation = so3.exp(kinematics.w0_turn_rad) @ kinematics.rotation_w2_w0
        origin_m = kinematics.position_m - estimate.rotation_w2_w0 @ estimate.skin_m[0]
        return replace(
            kinematics,
            joint_angles_rad=joints.angles_rad,
            joint_angles_sd_rad=joints.sd_rad,
            joint_velocity_rad_s=joints.rate_rad_s,
            joint_position_m=origin_m + joints.joint_w2_m @ rotation.T,
        )


class DigitReadout:
    """Reads the digits of one hand; ``wrist_depth_m`` of the wrist's centre under its disc."""

    def __init__(self, clicks: Clicks, camera: Camera, settings: TrackerSettings, wrist_depth_m: float) -> None:
        protocol, self._side = clicks.protocol, clicks.side
        self._dip_free = settings.dip == "free"
        self._skin_rad2 = settings.fingers.skin_offsets * SKIN_SD_RAD**2 * np.eye(N_SLOTS)
        self.angle_map = JointAngleMap.from_digits(self._dip_free, protocol.digits)
        self.direct_markers = np.array(
            [protocol.rows(markers_at_joint(name)) for name in protocol.joint_names(self._dip_free)]
        )
        """Rows (J, 2) of the discs at each joint and next past it, which measure it directly."""
        self._sites = np.array(list(protocol.sites), dtype=np.int64)
        self._wrist_depth_m = wrist_depth_m

    def read_joints(
        self, mean: FloatArray, covariance: FloatArray, base: DigitBase, linearised: DigitLinearisation
    ) -> JointState:
        """Return the joints of digits (5, n) with covariance (5, n, n) on a palm.

        ``linearised`` as the camera saw them.
        """
        palm, state = base.palm, mean[:, OBSERVED]
        _, normal, joint_m, disc_m = place_digits(state, palm.disc_m[1:])
        if not self._dip_free:
            # As the angles have the end joints, at two thirds of the middle ones: by how much one strays is for the
            # discs alone, and is no measurement of the joint.
            state[1:, _DIP_OFFSET] = 0.0
            _, _, joint_m, _ = place_digits(state, palm.disc_m[1:])
        # A knuckle's flexion is against its own metacarpal.
        slots = mean[:, :N_SLOTS].copy()
        unsure = covariance[:, :N_SLOTS, :N_SLOTS] + compute_inherited(covariance, base, linearised, normal)
        slots[:, FLEXION_SLOT] -= palm.cup_rad
        unsure[:, FLEXION_SLOT, FLEXION_SLOT] += palm.cup_sd_rad**2
        unsure += self._skin_rad2
        centre = np.empty((1 + N_DIGITS * (N_DISCS + 1), 3))
        centre[0] = 0.0, 0.0, -self._wrist_depth_m
        centre[1:] = joint_m.reshape(-1, 3)
        if self._side == "left":
            centre[:, 1] *= -1.0
        return JointState(
            self.angle_map.compute_angles(slots),
            np.sqrt(np.maximum(self.angle_map.compute_variances(unsure), 0.0)),
            self.angle_map.compute_angles(mean[:, RATES]),
            centre[self._sites],
            disc_m @ base.view.rotation.T + base.view.translation_m,
        )


def nan_kinematics(joint_count: int, marker_count: int) -> KinematicState:
    """Return kinematics of which nothing is known."""
    three, joints = np.full(3, np.nan), np.full(joint_count, np.nan)
    places = np.full((marker_count if joint_count else 0, 3), np.nan)
    return KinematicState(three, three, three, np.full((3, 3), np.nan), *(three,) * 4, *(joints,) * 3, places)


def build_lost_frame(
    index: int,
    timestamp_s: float,
    kinematics: KinematicState,
    marker_count: int,
    detections: Detections,
    dropped_before: int,
    measured_share: FloatArray,
) -> TrackedFrame:
    """Return the result of a frame in which the hand is lost: nothing is known but the blobs."""
    per_marker = np.full((marker_count, 2), np.nan)
    return TrackedFrame(
        index=index,
        timestamp_s=timestamp_s,
        status=TrackStatus.LOST,
        kinematics=kinematics,
        marker_position_cam_m=np.full((marker_count, 3), np.nan),
        marker_predicted_px=per_marker,
        marker_measured_px=per_marker,
        marker_measured_depth_m=np.full(marker_count, np.nan),
        detections=detections,
        dropped_before=dropped_before,
        measured_share=measured_share,
        nis=float("nan"),
        nis_dof=0,
    )

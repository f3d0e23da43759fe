"""Readout of thumb and fingers: joints from their state on the palm that they sit on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from carpus.core.calibration.result import Clicks
from carpus.core.compiled.digit_images import compute_inherited
from carpus.core.compiled.digits import place_digits
from carpus.core.model import so3
from carpus.core.model.camera import Camera
from carpus.core.model.types import FloatArray
from carpus.core.tracking.digits.knuckle_flexion import FLEXION_SLOT
from carpus.core.tracking.filter.digit_filter import OBSERVED, RATES, DigitLinearisation, DigitView
from carpus.core.tracking.filter.hand_geometry import (
    N_DIGITS,
    N_DISCS,
    N_SLOTS,
    JointAngleMap,
    JointState,
    PalmGeometry,
    direct_marker_rows,
)
from carpus.core.tracking.filter.palm_state import PalmEstimate, PalmView
from carpus.core.tracking.filter.readout import Readout
from carpus.core.tracking.filter.settings import TrackerSettings

_DIP_OFFSET = 3  # the slot of a finger's DIP flexion beyond what PIP flexion brings with it

SKIN_SD_RAD = 0.022  # of a joint, by discs that ride on gliding skin, however long it is measured


@dataclass(frozen=True, slots=True)
class DigitBase:
    """The palm as just updated, on which the fingers sit.

    ``view`` from W2 of a right hand to the camera. In camera axes: ``pose_covariance`` (6, 6) of the tracked body's
    position and turn; ``turn_covariance`` (3, 3) of the axes of W2, calibration error included.
    """

    palm: PalmGeometry
    view: DigitView
    pose_covariance: FloatArray
    turn_covariance: FloatArray

    def compute_image_covariance(self, linearised: DigitLinearisation) -> FloatArray:
        """Return the covariance (5, 9, 9) of the discs' images by the palm's error alone."""
        by_pose = np.empty((N_DIGITS, N_DISCS, 3, 6))
        by_pose[..., :3] = linearised.by_place
        by_pose[..., 3:] = linearised.by_place @ so3.skew(self.view.translation_m - linearised.centre_m)
        flat = by_pose.reshape(N_DIGITS, 3 * N_DISCS, 6)
        return np.asarray(flat @ self.pose_covariance @ np.swapaxes(flat, 1, 2))


def base_from_estimate(estimate: PalmEstimate, view: PalmView, readout: Readout) -> DigitBase:
    """Return the base that an estimate of the palm gives to the fingers."""
    palm, rotation, translation_m, pose, turn = readout.compute_base(estimate, view)
    return DigitBase(palm, DigitView(rotation, translation_m, view.camera), pose, turn)


class DigitReadout:
    """Reads the digits of one hand; ``wrist_depth_m`` of the wrist's centre under its disc."""

    def __init__(self, clicks: Clicks, camera: Camera, settings: TrackerSettings, wrist_depth_m: float) -> None:
        protocol, self._side = clicks.protocol, clicks.side
        self._dip_free = settings.dip == "free"
        self._skin_rad2 = settings.fingers.skin_offsets * SKIN_SD_RAD**2 * np.eye(N_SLOTS)
        self.angle_map = JointAngleMap.from_digits(self._dip_free, protocol.digits)
        self.direct_markers = direct_marker_rows(protocol, self._dip_free)
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

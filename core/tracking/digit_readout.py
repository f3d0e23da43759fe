"""The joints of thumb and fingers as read from their state on the palm that they sit on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from carpus.core import so3
from carpus.core.calibration.result import Clicks
from carpus.core.camera import Camera
from carpus.core.kernels.choice import in_c
from carpus.core.tracking.digit_filter import RATES, SEEN, DigitsLinearisation, DigitView
from carpus.core.tracking.finger_depth import FLEXION
from carpus.core.tracking.hand_geometry import (
    CHAINS,
    DISCS,
    SLOTS,
    JointMoment,
    JointReading,
    PalmInBody,
    digit_frames,
    digit_joints_m,
    direct_markers,
)
from carpus.core.tracking.palm_state import PalmEstimate, View
from carpus.core.tracking.readout import Readout
from carpus.core.tracking.settings import TrackerSettings
from carpus.core.types import FloatArray

_SLOT, _DIP_OFF = np.arange(SLOTS), 3
_NARROW2 = 1e-10


DEPTH_STAYS_M = 0.0004
"""Error of a disc's depth that no averaging removes."""
ACROSS_M = 0.00015
"""So closely a disc holds its joints across the line of sight where errors stay."""
INHERITED = 0.25
"""Share of a joint's information that resists errors of its discs that stay."""
SKIN_SD_RAD = 0.022
"""So far discs that ride on gliding skin mislead about a joint, however long it is seen."""


@dataclass(frozen=True, slots=True)
class Seat:
    """The palm as just corrected, on which the fingers sit.

    ``view`` from W2 of a right hand to the camera. In camera axes: ``pose_covariance`` (6, 6) of the tracked body's
    place and turn; ``turn_covariance`` (3, 3) of the axes of W2, calibration error included.
    """

    palm: PalmInBody
    view: DigitView
    pose_covariance: FloatArray
    turn_covariance: FloatArray


def seat_of(estimate: PalmEstimate, view: View, readout: Readout) -> Seat:
    """The seat that an estimate about the palm gives to the fingers."""
    palm, rotation, translation_m, pose, turn = readout.seat(estimate, view)
    return Seat(palm, DigitView(rotation, translation_m, view.camera), pose, turn)


class DigitReadout:
    """Reads the digits of one hand; ``wrist_depth_m`` how far the wrist's centre lies under its disc."""

    def __init__(self, clicks: Clicks, camera: Camera, settings: TrackerSettings, wrist_depth_m: float) -> None:
        protocol, self._side = clicks.protocol, clicks.side
        self._skin_offsets, self._dip_free = settings.fingers.skin_offsets, settings.dip == "free"
        self.reading = JointReading.of(self._dip_free, protocol.digits)
        self.direct_markers = direct_markers(protocol, self._dip_free)
        self._sites = np.array(list(protocol.sites), dtype=np.int64)
        self._wrist_depth_m = wrist_depth_m
        self._focal_px = np.array([camera.fx_px, camera.fy_px])
        self._read_by = np.array(
            [camera.fx_px, camera.fy_px, ACROSS_M, DEPTH_STAYS_M, INHERITED, _NARROW2, not self._dip_free,
             wrist_depth_m, -1.0 if self._side == "left" else 1.0, self._skin_offsets * SKIN_SD_RAD**2]
        )  # fmt: skip

    def read(
        self, mean: FloatArray, covariance: FloatArray, seat: Seat, linearised: DigitsLinearisation
    ) -> JointMoment:
        """Joints of digits (5, n) with covariance (5, n, n) on that palm; ``linearised`` as the camera saw them."""
        palm, joints = seat.palm, covariance[:, :SLOTS, :SLOTS]
        if (kernels := in_c()) is not None:
            (angles, sd, rates), disc_cam = np.empty((3, self.reading.chain.size)), np.empty((CHAINS, DISCS, 3))
            place = np.empty((self._sites.size, 3))
            kernels.digits_read(
                mean, covariance, linearised.slope, linearised.centre_m, linearised.by_place, palm.disc_m,
                seat.view.rotation, seat.view.translation_m, seat.turn_covariance, palm.cup_rad, palm.cup_sd_rad,
                self._read_by, self.reading.chain.size, self.reading.chain, self.reading.weight,
                self._sites.size, self._sites, angles, sd, rates, place, disc_cam,
            )  # fmt: skip
            return JointMoment(angles, sd, rates, place, disc_cam)
        state = mean[:, SEEN]
        frames = digit_frames(state)
        joint_m = digit_joints_m(palm.disc_m[1:], state, frames)
        disc = joint_m[:, 1:] + state[:, SLOTS + 8 :, None] * frames.normal
        disc_cam = disc @ seat.view.rotation.T + seat.view.translation_m
        inherited = self._inherited(joints, seat, linearised, frames.normal)
        joint_m = joint_m if self._dip_free else self._coupled(palm, state)
        # A knuckle's flexion is against its own metacarpal.
        slots, unsure = mean[:, :SLOTS].copy(), joints + inherited
        slots[:, FLEXION] -= palm.cup_rad
        unsure[:, FLEXION, FLEXION] += palm.cup_sd_rad**2
        if self._skin_offsets:
            unsure[:, _SLOT, _SLOT] += SKIN_SD_RAD**2
        angles = self.reading.angles(slots)
        variance = self.reading.variances(unsure)
        rates = self.reading.angles(mean[:, RATES])
        centre = np.empty((1 + CHAINS * (DISCS + 1), 3))
        centre[0] = 0.0, 0.0, -self._wrist_depth_m
        centre[1:] = joint_m.reshape(-1, 3)
        if self._side == "left":
            centre[:, 1] *= -1.0
        return JointMoment(angles, np.sqrt(np.maximum(variance, 0.0)), rates, centre[self._sites], disc_cam)

    @staticmethod
    def _coupled(palm: PalmInBody, state: FloatArray) -> FloatArray:
        """Joint centres (5, 4, 3) with the end joints at two thirds of the middle ones, as the angles have them: by how
        much an end joint strays is for the discs alone, and is no measurement of the joint."""
        bound = state.copy()
        bound[1:, _DIP_OFF] = 0.0
        return digit_joints_m(palm.disc_m[1:], bound, digit_frames(bound))

    def _inherited(
        self, joints: FloatArray, seat: Seat, linearised: DigitsLinearisation, normal: FloatArray
    ) -> FloatArray:
        """Covariance (5, 5, 5) that the slots inherit from the turn of W2 and from depths that stay wrong.

        What such a depth moves a disc along its normal (5, 3, 3) is taken for height, at the neutral pose and after,
        and part of what is not known of the heights; what it moves it across, the joints take.
        """
        unit = np.empty((CHAINS, DISCS, 3, 1))
        unit[..., :2, 0] = linearised.centre_m[..., 2:] / (self._focal_px * ACROSS_M)
        unit[..., 2, 0] = 1.0 / DEPTH_STAYS_M
        slope = linearised.slope[..., :SLOTS] * unit.reshape(CHAINS, 9, 1)
        across = np.swapaxes(slope, 1, 2)
        doubt = INHERITED * np.linalg.inv(joints + _NARROW2 * np.eye(SLOTS))
        response = np.linalg.solve(across @ slope + doubt, across)
        root_m = seat.palm.disc_m[1:, None] @ seat.view.rotation.T + seat.view.translation_m
        turned = response @ (linearised.by_place @ so3.skew(root_m - linearised.centre_m) * unit).reshape(CHAINS, 9, 3)
        in_camera = normal @ seat.view.rotation.T
        moved = -in_camera[..., 2:] * in_camera
        moved[..., 2] += 1.0
        seen = linearised.by_place @ moved[..., None] * (DEPTH_STAYS_M * unit)
        by_disc = (response.reshape(CHAINS, SLOTS, DISCS, 1, 3) @ seen[:, None])[..., 0, 0]
        return np.asarray(
            turned @ seat.turn_covariance @ np.swapaxes(turned, 1, 2) + by_disc @ np.swapaxes(by_disc, 1, 2)
        )

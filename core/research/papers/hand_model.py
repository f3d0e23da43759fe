"""The hand as the papers model it, with the constants of their filter and its frame W0.

A palm of rigid links in one plane, fingers as chains through the discs' centres. The papers give no figures for their
filter, so each says where it is from. The lengths are measured on the clicked hand "by means of the depth information"
(hand paper, section 2). The palm's arch "is not considered" (wrist paper, II-B); the hand starts with fingers extended,
thumb adducted and wrist neutral (section 4), so that all angles are zero there. W0 before the camera by (13) to (20) of
the wrist paper.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Self

import numpy as np

from carpus.core.calibration.neutral_pose import (
    TOWARDS_CAMERA,
    estimate_neutral_pose,
    marker_positions_cam_m,
    with_w0_pose,
)
from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.errors import SettingsInvalid
from carpus.core.model.hand.anatomy import HandAnatomy, anatomy_from_size
from carpus.core.model.hand.clinical_angles import side_sign, wrist_axes
from carpus.core.model.hand.kinematics import joint_centres
from carpus.core.model.hand.protocols import SITE_CHAINS, joint_angle_names
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.mixture_filter import UnscentedParameters

# eta_v, eta_omega and eta_theta of a slow, a usual and a lively hand (reference 4.5; of joints its figures for
# abduction: with its larger ones for flexion the image alone holds no finger).
_MOTION = {"slow": (0.7, 0.75, 0.4), "standard": (2.0, 1.5, 1.0), "brisk": (6.0, 4.0, 2.0)}


@dataclass(frozen=True, slots=True)
class PaperSettings:
    """Noise, start and priors of the papers' filter; all of it is stored with a session.

    ``palm``: its discs laid into one plane, since the palm's arch "is not considered" (wrist paper, II-B), or taken as
    measured, to see what the rest of the method is worth. ``acceleration_m_s2``, ``turn_rate_rad_s`` and
    ``joint_rate_rad_s``: standard deviations of eta_v, eta_omega and eta_theta of (1) per sample at 30 frames a second.
    ``pixel_sd_px`` of nu_i in (2), the same for all markers (the reference says 0.8 for the palm, 1.2 for fingers).
    ``*_start_*``: standard deviations of the neutral pose. ``clutter_prior`` p(a = 0) of (12); what is left is shared
    alike by the markers. ``alpha``, ``beta``, ``kappa`` of the sigma points. ``lost_after_s``: without three markers of
    the palm for so long, the hand is lost.
    """

    acceleration_m_s2: float = 2.0
    turn_rate_rad_s: float = 1.5
    joint_rate_rad_s: float = 1.0
    pixel_sd_px: float = 1.0
    position_start_m: float = 0.003
    velocity_start_m_s: float = 0.02
    angle_start_rad: float = 0.03
    joint_start_rad: float = 0.15
    clutter_prior: float = 0.1
    alpha: float = 0.25
    beta: float = 2.0
    kappa: float = 0.0
    lost_after_s: float = 1.5
    palm: Literal["flat", "measured"] = "flat"

    @classmethod
    def from_profile(cls, name: str) -> Self:
        """Return the settings for a ``slow``, ``standard`` or ``brisk`` hand."""
        return cls(*_MOTION[name])

    @property
    def scaling(self) -> UnscentedParameters:
        return UnscentedParameters(self.alpha, self.beta, self.kappa)


PalmModel = Literal["flat", "measured"]
_MCP3 = 3
_HAND_OVER_PALM = 1.0 / 0.446  # hand length over the distance from WRIST to MCP3 (reference 3.3)


@dataclass(frozen=True, slots=True)
class PaperHand:
    """T_mi,w of (2): ``palm_m`` (6, 3) in W of the hand's own side; ``anatomy`` None for the palm alone."""

    palm_m: FloatArray
    anatomy: HandAnatomy | None

    @property
    def joint_count(self) -> int:
        return 0 if self.anatomy is None else len(joint_angle_names())

    def discs_m(self, joints_rad: FloatArray) -> FloatArray:
        """Return markers (..., M, 3) in W2 for joint angles (..., J)."""
        if self.anatomy is None:
            return np.broadcast_to(self.palm_m, (*joints_rad.shape[:-1], *self.palm_m.shape))
        return joint_centres(self.anatomy, joints_rad)


def measure_hand(calibration: Calibration, camera: Camera, palm: PalmModel) -> PaperHand:
    """Return the hand whose discs were measured at the neutral pose.

    The fingers keep the lengths between their discs, and point in the palm's plane where they point from root to tip. A
    disc of a finger whose depth is unknown is taken to be as far away as the one before it: "the camera focal axis is
    perpendicular to the plane where the hand lies".
    """
    protocol = calibration.clicks.protocol
    disc_cam_m, clicked_px = marker_positions_cam_m(calibration), camera.undistort(calibration.clicks.pixel)
    for marker in np.flatnonzero(~np.isfinite(disc_cam_m[:, 2])):
        disc_cam_m[marker] = camera.backproject(clicked_px[marker], disc_cam_m[marker - 1, 2])
    disc_m = (disc_cam_m - disc_cam_m[0]) @ calibration.rotation_w0_cam
    palm_m = model_palm(disc_m[list(protocol.palm)], palm)
    if not protocol.has_fingers:
        return PaperHand(palm_m, None)
    if not protocol.is_whole_hand:
        raise SettingsInvalid("filter", f"paper: the papers have the palm or the whole hand, not {protocol.name}")
    side = calibration.clicks.side
    mirror = np.array([1.0, side_sign(side), 1.0])
    chain_m = disc_m[np.array(SITE_CHAINS)[:, 1:]] * mirror  # (5, 4, 3), axes of a right hand
    length_m = np.linalg.norm(np.diff(chain_m, axis=1), axis=-1)
    along = chain_m[:, -1] - chain_m[:, 0]
    along[0] = chain_m[0, 1] - chain_m[0, 0]  # the thumb's first bone: the rest turns out of that plane
    usual = anatomy_from_size(_HAND_OVER_PALM * float(palm_m[_MCP3, 0]), side=side, skin_offsets=False)
    anatomy = HandAnatomy(
        hand_length_m=usual.hand_length_m,
        hand_breadth_m=usual.hand_breadth_m,
        palm_disc_m=palm_m * mirror,
        palm_joint_m=palm_m * mirror,
        fan_rad=np.arctan2(along[:, 1], along[:, 0]),
        thumb_roll_rad=usual.thumb_roll_rad,
        thumb_length_m=length_m[0],
        finger_length_m=length_m[1:],
        thumb_offset_m=np.zeros(3),
        finger_offset_m=np.zeros((4, 3)),
        side=side,
    )
    return PaperHand(palm_m, anatomy)


def model_palm(palm_m: FloatArray, palm: PalmModel) -> FloatArray:
    """Return palm discs (6, 3), WRIST at the origin, as they are or laid into the plane Z = 0.

    Laid with the lengths L_i and the angles theta_i of figure 1b of the wrist paper.
    """
    if palm == "measured":
        return palm_m
    length_m = np.linalg.norm(palm_m, axis=1)
    axis = palm_m[_MCP3] / length_m[_MCP3]
    theta = np.arccos(np.clip(palm_m @ axis / np.maximum(length_m, 1e-9), -1.0, 1.0)) * np.sign(palm_m[:, 1])
    theta[_MCP3] = 0.0
    return np.stack((length_m * np.cos(theta), length_m * np.sin(theta), np.zeros(len(palm_m))), axis=1)


def calibrate_as_written(calibration: Calibration, camera: Camera, palm: PalmModel) -> Calibration:
    """Return the calibration with g_w0c of the palm as modelled; the measured discs stay in space."""
    disc_cam_m = marker_positions_cam_m(calibration)
    palm_cam_m = disc_cam_m[list(calibration.clicks.protocol.palm)]
    axes = wrist_axes(palm_cam_m, TOWARDS_CAMERA)
    model_m = model_palm((palm_cam_m - palm_cam_m[0]) @ axes, palm)
    pixel, depth_m = camera.project(palm_cam_m), palm_cam_m[:, 2]
    rotation, translation = estimate_neutral_pose(camera, model_m, pixel, depth_m, axes, palm_cam_m[0])
    return with_w0_pose(calibration, disc_cam_m, rotation, translation)

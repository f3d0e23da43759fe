"""Thumb and fingers of one hand, tracked on the palm that the tracker has just corrected."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core import so3
from core.calibration.result import Calibration
from core.camera import Camera
from core.hand.protocols import HAND21
from core.tracking import modes
from core.tracking.anatomy_refinement import RayStart, ray_start
from core.tracking.finger_naming import FingerScene, NamedFingers, name_fingers, seen_chance
from core.tracking.hand_geometry import (
    DISCS,
    RAY_MARKERS,
    RAYS,
    SLOTS,
    JointMoment,
    JointReading,
    PalmInBody,
    direct_markers,
    ray_discs_m,
    ray_normals,
)
from core.tracking.joint_limits import MID_RANGE_RAD, RANGE_SD_RAD, constrained
from core.tracking.measurement import View
from core.tracking.naming import Measurable
from core.tracking.ray_filter import (
    RayBeliefs,
    RayLayout,
    RayNoise,
    RayPoints,
    RayView,
    forecast,
    mixed,
    predicted,
    spread_points,
)
from core.tracking.readout import Readout
from core.tracking.settings import TrackerSettings
from core.tracking.state import Belief
from core.tracking.unscented import weights_for
from core.types import FloatArray

_REFERENCE_FPS = 30.0

# Which discs move with a slot: 0 the first of the ray's three and those after it, and so on; 3 none.
_FIRST_DISC = np.array([[0, 0, 1, 1, 2], *([0, 0, 1, 2, 3],) * 4])
_SHOWS = np.arange(DISCS) >= _FIRST_DISC[..., None]
"""(5, 5, 3) whether a disc moves with a slot."""
_POSE = np.array([0, 1, 2, 6, 7, 8])
"""Position and turn in the palm's error vector."""
_SLOT = np.arange(SLOTS)
_UV = 3 * np.arange(DISCS)[:, None] + np.arange(2)
_DOWN = np.array([1.0, 1.0, -1.0])
_STEP_RAD = 1e-4
_NARROW2 = 1e-10
_BENDS = np.array([[0.0, 0.0, 1.0, 0.0, 1.0], *([0.0, 1.0, 1.0, 1.0, 0.0],) * 4])


@dataclass(frozen=True, slots=True)
class Seat:
    """The palm as just corrected, on which the fingers sit.

    ``view`` from W2 of a right hand to the camera; ``pose_covariance`` (6, 6) of its place and turn in camera axes;
    ``turn_covariance`` (3, 3) of its axes in W2, calibration error included; ``is_seen`` in this frame.
    """

    palm: PalmInBody
    view: RayView
    pose_covariance: FloatArray
    turn_covariance: FloatArray
    is_seen: bool


def seat_of(belief: Belief, view: View, readout: Readout, is_seen: bool) -> Seat:
    """The seat that a belief about the palm gives to the fingers."""
    palm, turn_covariance = readout.palm(belief)
    body_cam = view.rotation_w0_cam @ belief.rotation_w2_w0
    origin = body_cam @ palm.origin_m + view.rotation_w0_cam @ belief.position_m + view.translation_w0_cam_m
    to_camera = np.zeros((6, 6))
    to_camera[:3, :3], to_camera[3:, 3:] = view.rotation_w0_cam, body_cam
    pose = to_camera @ belief.covariance[_POSE[:, None], _POSE] @ to_camera.T
    return Seat(palm, RayView(body_cam @ palm.axes, origin, view.camera), pose, turn_covariance, is_seen)


@dataclass(frozen=True, slots=True)
class FingerTrial:
    """What one frame would tell of thumb and fingers.

    ``visible`` (5, 3) chance with which each disc was expected to be seen; ``predicted_px`` (5, 3, 2) and covariance
    (5, 3, 2, 2), given the palm.
    """

    named: NamedFingers
    visible: FloatArray
    predicted_px: FloatArray
    predicted_cov_px2: FloatArray

    @property
    def nis(self) -> float:
        return float(self.named.update.nis.sum())

    @property
    def dof(self) -> int:
        return int(self.named.update.dof.sum())

    @property
    def blob(self) -> NDArray[np.int64]:
        """Blob (5, 3) taken for every disc or -1."""
        return self.named.names.taken


@dataclass(frozen=True, slots=True)
class FingerStep:
    """What the smoother needs of one frame: time, what was measured on which palm; ``linked`` to the step before."""

    timestamp_s: float
    measured: FloatArray
    variance: FloatArray
    linked: bool


class Fingers:
    """Remembers the rays' beliefs from frame to frame."""

    def __init__(self, calibration: Calibration, camera: Camera, settings: TrackerSettings) -> None:
        self._settings = settings
        own = settings.fingers
        dip_free = settings.dip == "free"
        self.reading = JointReading.of(dip_free)
        self.layout = RayLayout(settings.motion == "constant_rate")
        self._side = calibration.clicks.side
        self.start: RayStart = ray_start(calibration, camera, dip_free=dip_free, skin_offsets=own.skin_offsets)
        self._wrist_depth_m = -float(self.start.fit.anatomy.palm_joint_m[0, 2])
        self._scales = np.array(settings.mode_scales if self.layout.has_rates else (1.0,))
        self._noise = _motion_noise(settings, self.layout, self._scales, self.start, dip_free)
        self._growth = np.where(_SHOWS.any(axis=-1), RANGE_SD_RAD**2, 0.0)
        if not dip_free:
            self._growth[1:, 3] = 0.0
        self.direct_markers = direct_markers(dip_free)
        self._resolution_px2 = float(camera.width_px * camera.height_px)
        self.begin_at_neutral()

    def begin_at_neutral(self) -> None:
        """Start (again) from the neutral pose, at rest."""
        layout = self.layout
        mean, covariance = np.zeros((RAYS, layout.size)), np.zeros((RAYS, layout.size, layout.size))
        seen = layout.seen
        mean[:, seen] = self.start.mean
        covariance[:, seen[:, None], seen] = self.start.covariance
        if layout.has_rates:
            rate = np.arange(layout.rates.start, layout.rates.stop)
            moves = self._noise.motion[0] > 0.0
            covariance[:, rate, rate] = np.where(moves, self._settings.initial.joint_rates_rad_s**2, 1e-12)
        self._take(mean, covariance)
        self._visible = np.full((RAYS, DISCS), 0.98)
        self._unseen_s = np.zeros((RAYS, SLOTS))
        self._noise_factor = np.ones((RAYS, 3 * DISCS))

    def begin_anywhere(self) -> None:
        """Start again after the hand was lost: the anatomy is known, the joints may be anywhere."""
        layout = self.layout
        mean, covariance = self._mean.copy(), self._covariance.copy()
        moving = np.r_[layout.joints, layout.rates]
        mean[:, moving] = 0.0
        mean[:, layout.joints] = MID_RANGE_RAD
        covariance[:, moving, :] = 0.0
        covariance[:, :, moving] = 0.0
        slot = np.arange(SLOTS)
        covariance[:, slot, slot] = np.maximum(self._growth, 1e-12)
        if layout.has_rates:
            rate = np.arange(layout.rates.start, layout.rates.stop)
            covariance[:, rate, rate] = np.where(self._noise.motion[0] > 0.0, 1.0, 1e-12)
        self._take(mean, covariance)
        self._visible = np.full((RAYS, DISCS), 0.5)
        self._unseen_s = np.full((RAYS, SLOTS), self._settings.fingers.range_after_s)

    def _take(self, mean: FloatArray, covariance: FloatArray) -> None:
        count = self._scales.size
        self._beliefs = RayBeliefs(
            np.repeat(mean[:, None], count, axis=1),
            np.repeat(covariance[:, None], count, axis=1),
            np.full((RAYS, count), 1.0 / count),
        )
        self._mean, self._covariance = mean, covariance
        self._ahead: tuple[float, RayBeliefs, RayPoints] | None = None

    def ahead(self, timestamp_s: float, dt_s: float, palm: PalmInBody) -> RayPoints:
        """Predict the rays; their discs in W2 as sigma points."""
        if self._ahead is not None and self._ahead[0] == timestamp_s:
            return self._ahead[2]
        beliefs = self._beliefs
        if dt_s > 0.0:
            own, layout = self._settings.fingers, self.layout
            is_unseen = self._unseen_s > 0.0
            fade = np.where(is_unseen, np.exp(-dt_s / self._settings.rate_memory_s), 1.0)
            before = np.minimum(self._unseen_s, own.range_after_s) / own.range_after_s
            after = np.minimum(self._unseen_s + dt_s, own.range_after_s) / own.range_after_s
            growth = np.where(is_unseen, self._growth * (after**2 - before**2), 0.0)
            switch = modes.switching(self._scales.size, self._settings.mode_dwell_s, dt_s)
            beliefs = predicted(mixed(beliefs, switch), self._noise, dt_s, layout, fade, growth)
        mean, covariance = beliefs.merged()
        points = spread_points(mean, covariance, palm.disc_m[1:], self.layout, self._settings.spread)
        self._ahead = (timestamp_s, beliefs, points)
        return points

    def expected(self, timestamp_s: float, dt_s: float, seat: Seat) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Where to look: pixels (5, 3, 2) with covariance (5, 3, 2, 2), and depths (5, 3)."""
        points = self.ahead(timestamp_s, dt_s, seat.palm)
        image = seat.view.observe(points.disc_m)
        count = points.root.shape[-1]
        half = image[:, 1 : count + 1, :, :2] - image[:, count + 1 :, :, :2]
        by_disc = half.transpose(0, 2, 3, 1) * (0.5 / weights_for(count, self._settings.spread).scale)
        covariance = by_disc @ np.swapaxes(by_disc, -1, -2) + _own_pixels(self._shift(points, seat))
        return image[:, 0, :, :2], covariance, image[:, 0, :, 2]

    def weigh(
        self, timestamp_s: float, dt_s: float, seat: Seat, blobs: Measurable, free: NDArray[np.bool_]
    ) -> FingerTrial:
        """Name the blobs that are ``free`` (D,), not the palm's, as if the palm were there; nothing is remembered."""
        points = self.ahead(timestamp_s, dt_s, seat.palm)
        assert self._ahead is not None
        beliefs = self._ahead[1]
        line = forecast(points, seat.view, self.layout, self._settings.spread)
        visible = self._chance_to_see(points, seat.view, dt_s)
        shift = self._shift(points, seat)
        scene = FingerScene(
            line,
            line.spread + shift,
            None if seat.is_seen else shift,
            visible,
            blobs,
            free,
            self._noise_factor,
            self._resolution_px2,
        )
        named = name_fingers(beliefs, scene, self._settings)
        predicted_px = line.value.reshape(RAYS, DISCS, 3)[..., :2]
        return FingerTrial(named, visible, predicted_px, _own_pixels(scene.spread))

    def _chance_to_see(self, points: RayPoints, view: RayView, dt_s: float) -> FloatArray:
        """Chance (5, 3) that each disc is to be seen, from its tilt to the camera and whether it was seen before."""
        normal = ray_normals(points.mean[:, self.layout.seen]) @ view.rotation.T
        centre = points.disc_m[:, 0] @ view.rotation.T + view.translation_m
        facing = -np.einsum("rdi,rdi->rd", normal, centre) / np.sqrt(np.einsum("rdi,rdi->rd", centre, centre))
        bend = np.cumsum(points.covariance[:, _SLOT, _SLOT] * _BENDS, axis=1)[:, 2:]
        tilt = np.arccos(np.clip(facing, -1.0, 1.0))
        return seen_chance(self._visible, tilt, np.sqrt(bend), dt_s, self._settings.fingers)

    @staticmethod
    def _shift(points: RayPoints, seat: Seat) -> FloatArray:
        """Covariance (5, 9, 9) of the discs' images from that of the palm's place and turn."""
        view = seat.view
        centre = points.disc_m[:, 0] @ view.rotation.T + view.translation_m
        by_point = view.slope(centre)
        by_pose = np.empty((RAYS, DISCS, 3, 6))
        by_pose[..., :3] = by_point
        by_pose[..., 3:] = by_point @ so3.skew(view.translation_m - centre)
        flat = by_pose.reshape(RAYS, 9, 6)
        return np.asarray(flat @ seat.pose_covariance @ np.swapaxes(flat, 1, 2))

    def accept(self, trial: FingerTrial, dt_s: float) -> None:
        """Go on from a trial."""
        named = trial.named
        is_named = named.names.taken >= 0
        self._visible = np.where(is_named, 0.98, trial.visible * 0.1 / (1.0 - 0.9 * trial.visible))
        shown = (_SHOWS & is_named[:, None, :]).any(axis=-1)
        self._unseen_s = np.where(shown, 0.0, self._unseen_s + dt_s)
        self._watch_noise(named, dt_s)
        after = named.update.beliefs
        merged, _ = after.merged()
        self._beliefs = constrained(after, merged[:, :SLOTS])
        self._mean, self._covariance = self._beliefs.merged()
        self._ahead = None

    def _watch_noise(self, named: NamedFingers, dt_s: float) -> None:
        """Let each disc's noise follow its residuals, as the palm's does."""
        noise = self._settings.noise
        used = np.isfinite(named.measured)
        weight = 1.0 - np.exp(-dt_s / noise.adapt_s)
        squared = np.where(used, np.minimum(named.update.residual**2, noise.most_adapted), 1.0)
        squared = squared.reshape(RAYS, DISCS, 3)
        squared[..., :2] = squared[..., :2].mean(axis=-1, keepdims=True)
        grown = self._noise_factor * (1.0 + weight * (squared.reshape(RAYS, 9) - 1.0))
        self._noise_factor = np.where(used, np.clip(grown, 1.0, noise.most_adapted), self._noise_factor)

    def read(self, seat: Seat) -> JointMoment:
        """The joints as they stand."""
        return self.reading_of(self._mean, self._covariance, seat)

    def reading_of(self, mean: FloatArray, covariance: FloatArray, seat: Seat) -> JointMoment:
        """Joints of rays (5, n) with covariance (5, n, n)."""
        palm, state = seat.palm, mean[:, self.layout.seen]
        moved = np.repeat(state[:, None], SLOTS + 2, axis=1)
        moved[:, 1 + _SLOT, _SLOT] += _STEP_RAD
        moved[:, -1, SLOTS + 8 :] = 0.0
        place = ray_discs_m(palm.disc_m[1:], moved)
        joints = covariance[:, :SLOTS, :SLOTS]
        slope = (place[:, 1:-1] - place[:, :1]).reshape(RAYS, SLOTS, 9) / _STEP_RAD
        lever = so3.skew(palm.disc_m[1:, None] - place[:, 0]).reshape(RAYS, 9, 3)
        variance = self.reading.variances(joints + self._systematic(slope, lever, joints, seat))
        angles = self.reading.angles(mean[:, :SLOTS])
        rates = np.full(angles.size, np.nan)
        if self.layout.has_rates:
            rates = self.reading.angles(mean[:, self.layout.rates])
        centre = np.empty((len(HAND21.markers), 3))
        centre[0] = 0.0, 0.0, -self._wrist_depth_m
        centre[1:].reshape(RAYS, 4, 3)[:, 0] = palm.disc_m[1:] + state[:, SLOTS + 5 : SLOTS + 8] * _DOWN
        centre[RAY_MARKERS] = place[:, -1]
        if self._side == "left":
            centre[:, 1] *= -1.0
        disc_cam = place[:, 0] @ seat.view.rotation.T + seat.view.translation_m
        return JointMoment(angles, np.sqrt(np.maximum(variance, 0.0)), rates, centre, disc_cam)

    def _systematic(self, slope: FloatArray, lever: FloatArray, joints: FloatArray, seat: Seat) -> FloatArray:
        """Covariance (5, 5, 5) that the slots inherit from the palm's turn and from errors that stay.

        ``slope`` (5, 5, 9) of the discs by the slots, ``lever`` (5, 9, 3) by a turn of the palm about the ray's root.
        """
        own = self._settings.fingers
        across = np.swapaxes(slope, 1, 2)
        doubt = (0.5 * own.depth_bias_m) ** 2 * np.linalg.inv(joints + _NARROW2 * np.eye(SLOTS))
        response = np.linalg.solve(slope @ across + doubt, slope)
        axis = seat.view.rotation[2]
        root = own.lateral_bias_m * np.eye(3)
        root += (math.hypot(own.lateral_bias_m, own.depth_bias_m) - own.lateral_bias_m) * np.outer(axis, axis)
        # Each disc errs by itself, and all three with the disc at the ray's root.
        each = np.empty((RAYS, SLOTS, DISCS + 1, 3))
        each[:, :, :DISCS] = response.reshape(RAYS, SLOTS, DISCS, 3)
        each[:, :, DISCS] = each[:, :, :DISCS].sum(axis=2)
        stays = (each @ root).reshape(RAYS, SLOTS, -1)
        turned = response @ lever
        return np.asarray(stays @ np.swapaxes(stays, 1, 2) + turned @ seat.turn_covariance @ np.swapaxes(turned, 1, 2))


def _own_pixels(covariance: FloatArray) -> FloatArray:
    """Covariance (5, 3, 2, 2) of each disc's own pixel out of that of a ray's images (5, 9, 9)."""
    return covariance[:, _UV[:, :, None], _UV[:, None, :]]


def _motion_noise(
    settings: TrackerSettings, layout: RayLayout, scales: FloatArray, start: RayStart, dip_free: bool
) -> RayNoise:
    motion, own = settings.motion_noise, settings.fingers
    sd = np.full((RAYS, SLOTS), motion.joint_acceleration_rad_s2 if layout.has_rates else motion.joint_rate_rad_s)
    sd[0, :2] *= own.abduction_share
    sd[0, 3] *= own.abduction_share
    sd[1:, 0] *= own.abduction_share
    sd[1:, 4] = 0.0
    if not dip_free:
        sd[1:, 3] = 0.0
    density = (scales[:, None, None] * sd) ** 2 / _REFERENCE_FPS
    drift = own.drift_per_s * np.diagonal(start.fit.rays.covariance, axis1=1, axis2=2)
    return RayNoise(density, drift)

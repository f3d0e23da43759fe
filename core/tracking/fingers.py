"""Thumb and fingers of one hand, tracked on the palm that the tracker has just corrected."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core import so3
from core.calibration.result import Calibration
from core.camera import Camera
from core.tracking import modes
from core.tracking.anatomy_refinement import RayStart, ray_start
from core.tracking.finger_naming import FingerScene, NamedFingers, name_fingers, seen_chance, tilt_to, tilt_variance
from core.tracking.geometry import palm_of
from core.tracking.hand_geometry import (
    DISCS,
    RAYS,
    SLOTS,
    JointMoment,
    JointReading,
    PalmInBody,
    direct_markers,
    ray_frames,
    ray_joints_m,
)
from core.tracking.joint_limits import MID_RANGE_RAD, RANGE_SD_RAD, constrained
from core.tracking.measurement import View
from core.tracking.motion import REFERENCE_DT_S
from core.tracking.naming import Measurable
from core.tracking.ray_filter import (
    RayBeliefs,
    RayForecast,
    RayLayout,
    RayMotion,
    RayPoints,
    RayView,
    forecast,
    mixed,
    spread_points,
)
from core.tracking.readout import Readout
from core.tracking.settings import TrackerSettings
from core.tracking.state import Belief
from core.tracking.unscented import weights_for
from core.types import FloatArray

# Which discs move with a slot: 0 the first of the ray's three and those after it, and so on; 3 none.
_FIRST_DISC = np.array([[0, 0, 1, 1, 2], *([0, 0, 1, 2, 3],) * 4])
_SHOWS = np.arange(DISCS) >= _FIRST_DISC[..., None]
"""(5, 5, 3) whether a disc moves with a slot."""
_POSE = np.array([0, 1, 2, 6, 7, 8])
"""Position and turn in the palm's error vector."""
_SLOT = np.arange(SLOTS)
_UV = 3 * np.arange(DISCS)[:, None] + np.arange(2)
_NARROW2 = 1e-10


@dataclass(frozen=True, slots=True)
class Seat:
    """The palm as just corrected, on which the fingers sit.

    ``view`` from W2 of a right hand to the camera. In camera axes: ``pose_covariance`` (6, 6) of the tracked body's
    place and turn; ``turn_covariance`` (3, 3) of the axes of W2, calibration error included. ``is_seen`` in this frame.
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
    to_camera = np.zeros((6, 6))
    to_camera[:3, :3], to_camera[3:, 3:] = view.rotation_w0_cam, body_cam
    pose = to_camera @ belief.covariance[_POSE[:, None], _POSE] @ to_camera.T
    return Seat(palm, ray_view(belief, view, palm), pose, body_cam @ turn_covariance @ body_cam.T, is_seen)


def ray_view(belief: Belief, view: View, palm: PalmInBody) -> RayView:
    """How the camera sees W2 of a right hand on that palm."""
    body_cam = view.rotation_w0_cam @ belief.rotation_w2_w0
    origin = body_cam @ palm.origin_m + view.rotation_w0_cam @ belief.position_m + view.translation_w0_cam_m
    return RayView(body_cam @ palm.axes, origin, view.camera)


@dataclass(frozen=True, slots=True)
class FingerTrial:
    """What one frame would tell of thumb and fingers.

    ``visible`` (5, 3) chance with which each disc was expected to be seen; ``spread`` (5, 9, 9) covariance of the
    predicted images, given the palm.
    """

    seat: Seat
    line: RayForecast
    named: NamedFingers
    visible: FloatArray
    spread: FloatArray

    @property
    def predicted_px(self) -> FloatArray:
        """Where each disc was expected, (5, 3, 2)."""
        return self.line.value.reshape(RAYS, DISCS, 3)[..., :2]

    @property
    def predicted_cov_px2(self) -> FloatArray:
        """Covariance (5, 3, 2, 2) of that."""
        return self.spread[:, _UV[:, :, None], _UV[:, None, :]]

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
        self._focal_px = np.array([camera.fx_px, camera.fy_px])
        self._palm = PalmInBody.of(palm_of(calibration).marker_position_w0_m, np.eye(3), self._side)
        self._wrist_depth_m = -float(self.start.fit.anatomy.palm_joint_m[0, 2])
        self._scales = np.array(settings.mode_scales if self.layout.has_rates else (1.0,))
        self._motion, self._moves = _motion_of(settings, self.layout, self._scales, self.start, dip_free)
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
            covariance[:, rate, rate] = np.where(self._moves, self._settings.initial.joint_rates_rad_s**2, 1e-12)
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
            covariance[:, rate, rate] = np.where(self._moves, 1.0, 1e-12)
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

    def _ahead_at(self, timestamp_s: float, dt_s: float) -> tuple[RayBeliefs, RayPoints]:
        """The rays predicted, and their discs on the palm as it was known last."""
        if self._ahead is not None and self._ahead[0] == timestamp_s:
            return self._ahead[1:]
        beliefs = self._beliefs
        if dt_s > 0.0:
            switch = modes.switching(self._scales.size, self._settings.mode_dwell_s, dt_s)
            beliefs = self._motion.predicted(mixed(beliefs, switch), dt_s, *self._forgetting(dt_s))
        mean, covariance = beliefs.merged()
        points = spread_points(mean, covariance, self._palm.disc_m[1:], self.layout, self._settings.spread)
        self._ahead = (timestamp_s, beliefs, points)
        return beliefs, points

    def _forgetting(self, dt_s: float) -> tuple[FloatArray | None, FloatArray | None]:
        """Share (5, 5) kept of each slot's rate and variance (5, 5) gained, where joints are not seen."""
        is_unseen = self._unseen_s > 0.0
        if not is_unseen.any():
            return None, None
        whole_s = self._settings.fingers.range_after_s
        before = np.minimum(self._unseen_s, whole_s) / whole_s
        after = np.minimum(self._unseen_s + dt_s, whole_s) / whole_s
        fade = np.where(is_unseen, math.exp(-dt_s / self._settings.rate_memory_s), 1.0)
        return fade, np.where(is_unseen, self._growth * (after**2 - before**2), 0.0)

    def expected(
        self, timestamp_s: float, dt_s: float, belief: Belief, view: View
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Where to look: pixels (5, 3, 2) with covariance (5, 3, 2, 2) given the palm, and depths (5, 3)."""
        _, points = self._ahead_at(timestamp_s, dt_s)
        image = ray_view(belief, view, self._palm).observe(points.disc_m)
        count = points.root.shape[-1]
        half = image[:, 1 : count + 1, :, :2] - image[:, count + 1 :, :, :2]
        by_disc = half.transpose(0, 2, 3, 1) * (0.5 / weights_for(count, self._settings.spread).scale)
        return image[:, 0, :, :2], by_disc @ np.swapaxes(by_disc, -1, -2), image[:, 0, :, 2]

    def weigh(
        self, timestamp_s: float, dt_s: float, seat: Seat, blobs: Measurable, free: NDArray[np.bool_]
    ) -> FingerTrial:
        """Name the blobs that are ``free`` (D,), not the palm's, as if the palm were there; nothing is remembered."""
        beliefs, points = self._ahead_at(timestamp_s, dt_s)
        line = forecast(points, seat.view, self.layout, self._settings.spread)
        visible = self._chance_to_see(points, line, seat.view, dt_s)
        by_pose = np.empty((RAYS, DISCS, 3, 6))
        by_pose[..., :3] = line.by_place
        by_pose[..., 3:] = line.by_place @ so3.skew(seat.view.translation_m - line.centre_m)
        flat = by_pose.reshape(RAYS, 9, 6)
        shift = flat @ seat.pose_covariance @ np.swapaxes(flat, 1, 2)
        scene = FingerScene(
            line,
            line.spread + shift,
            None if seat.is_seen else shift,
            visible,
            blobs,
            free,
            self._noise_factor,
            self._resolution_px2,
            seat.view,
            self.layout,
        )
        return FingerTrial(seat, line, name_fingers(beliefs, scene, self._settings), visible, scene.spread)

    def _chance_to_see(self, points: RayPoints, line: RayForecast, view: RayView, dt_s: float) -> FloatArray:
        """Chance (5, 3) that each disc is to be seen, from its tilt to the camera and whether it was seen before."""
        tilt = tilt_to(view, points.normal, line.centre_m)
        return seen_chance(self._visible, tilt, np.sqrt(tilt_variance(points.covariance)), dt_s, self._settings.fingers)

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
        self._palm, self._ahead = trial.seat.palm, None

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

    def read(self, trial: FingerTrial) -> JointMoment:
        """The joints after that trial was accepted."""
        return self.reading_of(self._mean, self._covariance, trial.seat, trial.line)

    def reading_of(self, mean: FloatArray, covariance: FloatArray, seat: Seat, line: RayForecast) -> JointMoment:
        """Joints of rays (5, n) with covariance (5, n, n) on that palm."""
        palm, state = seat.palm, mean[:, self.layout.seen]
        joints = covariance[:, :SLOTS, :SLOTS]
        variance = self.reading.variances(joints + self._systematic(joints, seat, line))
        angles = self.reading.angles(mean[:, :SLOTS])
        rates = np.full(angles.size, np.nan)
        if self.layout.has_rates:
            rates = self.reading.angles(mean[:, self.layout.rates])
        frames = ray_frames(state)
        chain = ray_joints_m(palm.disc_m[1:], state, frames)
        centre = np.empty((1 + RAYS * (DISCS + 1), 3))
        centre[0] = 0.0, 0.0, -self._wrist_depth_m
        centre[1:] = chain.reshape(-1, 3)
        if self._side == "left":
            centre[:, 1] *= -1.0
        disc = chain[:, 1:] + state[:, SLOTS + 8 :, None] * frames.normal
        disc_cam = disc @ seat.view.rotation.T + seat.view.translation_m
        return JointMoment(angles, np.sqrt(np.maximum(variance, 0.0)), rates, centre, disc_cam)

    def _systematic(self, joints: FloatArray, seat: Seat, line: RayForecast) -> FloatArray:
        """Covariance (5, 5, 5) that the slots inherit from the turn of W2 and from errors that stay with a disc.

        Everything measured in those errors, which no averaging removes, so that a disc's own have unit covariance.
        """
        own = self._settings.fingers
        unit = np.empty((RAYS, DISCS, 3, 1))
        unit[..., :2, 0] = line.centre_m[..., 2:] / (self._focal_px * own.lateral_bias_m)
        unit[..., 2, 0] = 1.0 / own.depth_bias_m
        slope = line.slope[..., :SLOTS] * unit.reshape(RAYS, 9, 1)
        across = np.swapaxes(slope, 1, 2)
        doubt = 0.25 * np.linalg.inv(joints + _NARROW2 * np.eye(SLOTS))
        response = np.linalg.solve(across @ slope + doubt, across)
        # The disc at the ray's root errs as well, and all three seem to go the other way.
        root = response.reshape(RAYS, SLOTS, DISCS, 3).sum(axis=2)
        root_m = seat.palm.disc_m[1:, None] @ seat.view.rotation.T + seat.view.translation_m
        by_turn = (line.by_place @ so3.skew(root_m - line.centre_m) * unit).reshape(RAYS, 9, 3)
        turned = response @ by_turn
        return np.asarray(
            response @ np.swapaxes(response, 1, 2)
            + root @ np.swapaxes(root, 1, 2)
            + turned @ seat.turn_covariance @ np.swapaxes(turned, 1, 2)
        )


def _motion_of(
    settings: TrackerSettings, layout: RayLayout, scales: FloatArray, start: RayStart, dip_free: bool
) -> tuple[RayMotion, NDArray[np.bool_]]:
    """The rays' motion model, and which slots (5, 5) move at all."""
    motion, own = settings.motion_noise, settings.fingers
    sd = np.full((RAYS, SLOTS), motion.joint_acceleration_rad_s2 if layout.has_rates else motion.joint_rate_rad_s)
    sd[0, [0, 1, 3]] *= own.abduction_share
    sd[1:, 0] *= own.abduction_share
    sd[1:, 4] = 0.0
    if not dip_free:
        sd[1:, 3] = 0.0
    density = (scales[:, None, None] * sd) ** 2 * REFERENCE_DT_S
    drift = own.drift_per_s * np.diagonal(start.fit.rays.covariance, axis1=1, axis2=2)
    return RayMotion(density, drift, layout), sd > 0.0

"""Model of one subject's thumb and fingers: the anatomy and its covariance, start, motion, view."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.model.camera import Camera
from carpus.core.model.hand.fitting import AnatomyFit, MeasuredDiscs, fit_anatomy
from carpus.core.model.hand.kinematics import DIP_PER_PIP
from carpus.core.model.hand.protocols import DIGITS, SITES, MarkerProtocol
from carpus.core.model.types import FloatArray
from carpus.core.tracking.filter.digit_filter import (
    DIGIT_SIZE,
    JOINTS,
    MID_RANGE_RAD,
    OBSERVED,
    RANGE_SD_RAD,
    RATES,
    DigitBase,
    DigitMotion,
    Forgetting,
    apply_soft_limits,
    compute_limit_excess,
)
from carpus.core.tracking.filter.hand_geometry import (
    CROWDED_PX,
    N_CONSTANTS,
    N_DIGITS,
    N_SLOTS,
    PalmGeometry,
    is_crowded,
    palm_calibration,
)
from carpus.core.tracking.filter.mixture_filter import ModeMixture, mode_transition_matrix
from carpus.core.tracking.filter.motion import MODE_DWELL_S, RATE_MEMORY_S, REFERENCE_DT_S
from carpus.core.tracking.filter.readout import DigitReadout
from carpus.core.tracking.filter.settings import TrackerSettings

_FIXED_SD_RAD = 1e-6  # of a slot that does not move: the fifth of a finger, the third with a coupled DIP joint


@dataclass(frozen=True, slots=True)
class DigitStart:
    """Slots and constants (5, 16) at the neutral pose, their covariance (5, 16, 16), and their fit."""

    mean: FloatArray
    covariance: FloatArray
    fit: AnatomyFit


ABDUCTION_SHARE = 0.5  # of the process noise of flexion, for abductions and the thumb's CMC (reference 4.5)
DIFFUSION_S = 0.5  # within this a joint that no disc shows is spread over its anatomical range
LEARNING_SHARE = 0.02  # of a frame's information on the anatomy: neighbouring ones show skin that strays alike
SURE_TURN_SD_RAD = math.radians(1.0)  # of the palm, all axes, at which half as much is learnt of the fingers
DRIFT_PER_S = 2e-3  # share of the anatomy's variance at the start that comes back each second: skin over bone
DIP_COUPLING_SD_RAD = math.radians(6.0)  # of a coupled DIP joint about two thirds of PIP,
THUMB_ABDUCTION_SD_RAD = math.radians(6.0)  # and of the thumb's MCP joint, which hardly moves sideways, about straight;
RETURN_TIME_S = 1.0  # both return within this
# Of a posture of the grid on which a digit is searched, and of its rates.
POSTURE_SD_RAD, POSTURE_RATE_SD_RAD_S = math.radians(12.0), 3.0
REACQUIRED_RATE_SD_RAD_S = 1.0  # of the rates of a hand found again
CLICK_SD_PX = 2.0  # of a disc with no depth
MIN_GAP_S = 0.12  # between frames, from which on limits are applied before a frame too
MAX_BEYOND_RAD = math.radians(30.0)  # a finger further past its limits was misread


def digit_start(calibration: Calibration, camera: Camera, settings: TrackerSettings) -> DigitStart:
    """Return the anatomy of a calibrated hand; of a digit without discs it is the average hand's."""
    fit = fit_anatomy(
        _discs_from_calibration(calibration, camera, settings.marker_radius_m),
        calibration.clicks.side,
        dip_free=settings.dip == "free",
        skin_offsets=settings.fingers.skin_offsets,
        prior=settings.fingers.anatomy,
        is_straight=calibration.clicks.straight_fingers,
    )
    mean = np.zeros((N_DIGITS, N_SLOTS + N_CONSTANTS))
    covariance = np.zeros((N_DIGITS, N_SLOTS + N_CONSTANTS, N_SLOTS + N_CONSTANTS))
    for chain in range(N_DIGITS):
        count = fit.neutral_digits[chain].mean.size
        to_slots = np.eye(count)
        if chain:
            to_slots[3, 2] = -DIP_PER_PIP
        cross = to_slots @ fit.neutral_cross[chain]
        mean[chain, :count] = to_slots @ fit.neutral_digits[chain].mean
        mean[chain, N_SLOTS:] = fit.digits.mean[chain]
        covariance[chain, :count, :count] = to_slots @ fit.neutral_digits[chain].covariance @ to_slots.T
        covariance[chain, :count, N_SLOTS:] = cross
        covariance[chain, N_SLOTS:, :count] = cross.T
        covariance[chain, N_SLOTS:, N_SLOTS:] = fit.digits.covariance[chain]
    index = np.arange(N_SLOTS)
    covariance[:, index, index] += _FIXED_SD_RAD**2
    return DigitStart(mean, covariance, fit)


def _discs_from_calibration(calibration: Calibration, camera: Camera, marker_radius_m: float) -> MeasuredDiscs:
    """Return the calibrated discs; without a depth, the line of sight through the click."""
    protocol, disc = calibration.clicks.protocol, calibration.marker_position_w0_m.copy()
    rotation, translation = calibration.rotation_w0_cam, calibration.translation_w0_cam_m
    clicked = camera.backproject(camera.undistort(calibration.clicks.pixel), np.full(len(disc), translation[2]))
    is_blind = np.asarray(np.isnan(disc).any(axis=-1))
    disc[is_blind] = (clicked[is_blind] - translation) @ rotation
    in_camera = disc @ rotation.T + translation
    view = in_camera / np.linalg.norm(in_camera, axis=-1, keepdims=True) @ rotation
    covariance = np.where(is_blind[:, None, None], 0.0, calibration.marker_covariance_w0_m2)
    along = np.sqrt(np.maximum(np.einsum("mi,mij,mj->m", view, covariance, view), 1e-12))
    across = np.sqrt(np.maximum(np.linalg.eigvalsh(covariance)[:, 0], 1e-10))
    pixel_m = in_camera[:, 2] / camera.fx_px
    crowded = np.zeros(len(disc), dtype=bool)
    rays = np.array([chain[2:] for chain in protocol.chains.values()])
    radius_px = (marker_radius_m / pixel_m)[rays]
    crowded[rays] = is_crowded(camera.project(in_camera)[rays], radius_px)
    across = np.where(crowded, np.hypot(across, CROWDED_PX * pixel_m), across)
    blind_m = CLICK_SD_PX * pixel_m
    return MeasuredDiscs(
        _to_sites(protocol, disc, np.nan),
        _to_sites(protocol, view, np.nan),
        _to_sites(protocol, np.where(is_blind, blind_m, across), 1.0),
        _to_sites(protocol, np.where(is_blind, np.inf, along), np.inf),
    )


def _to_sites(protocol: MarkerProtocol, values: FloatArray, nothing: float) -> FloatArray:
    """Return values (1, 21, ...) of the sites from those of the markers (M, ...)."""
    out = np.full((1, len(SITES), *values.shape[1:]), nothing)
    out[0, list(protocol.sites)] = values
    return out


_SLOT = np.arange(N_SLOTS)


class FingerModel:
    """Thumb and fingers of one calibrated hand, without anything that changes from frame to frame.

    ``has_discs`` (5,) digits that carry discs (the others may be anywhere and are not reported); ``markers`` (R, 3)
    rows of their moving discs.
    """

    def __init__(self, calibration: Calibration, camera: Camera, settings: TrackerSettings) -> None:
        self.settings = settings
        protocol = calibration.clicks.protocol
        self.has_discs = np.array([digit in protocol.digits for digit in DIGITS])
        self.markers = np.array(list(protocol.chains.values()))[:, 2:]
        self.resolution_px2 = float(camera.width_px * camera.height_px)
        self.calibrated_palm = PalmGeometry.from_discs(
            palm_calibration(calibration).marker_position_w0_m, np.eye(3), calibration.clicks.side
        )
        self.scales = np.array(settings.mode_scales)
        self._start = digit_start(calibration, camera, settings)
        wrist_depth_m = -float(self._start.fit.anatomy.palm_joint_m[0, 2])
        self.readout = DigitReadout(calibration.clicks, camera, settings, wrist_depth_m)
        motion = settings.motion_noise
        sd = np.full((N_DIGITS, N_SLOTS), motion.joint_acceleration_rad_s2)
        sd[0, [0, 1, 3]] *= ABDUCTION_SHARE
        sd[1:, 0] *= ABDUCTION_SHARE
        sd[1:, 4] = 0.0
        sd[0, 3] = 0.0
        stationary2 = np.zeros((N_DIGITS, N_SLOTS))
        stationary2[0, 3] = THUMB_ABDUCTION_SD_RAD**2
        if settings.dip == "coupled":
            sd[1:, 3] = 0.0
            stationary2[1:, 3] = DIP_COUPLING_SD_RAD**2
        self._is_moving = sd > 0.0
        self._stationary2 = np.maximum(stationary2, 1e-12)
        self._range2 = np.where(self._is_moving, RANGE_SD_RAD**2, self._stationary2)
        drift = DRIFT_PER_S * np.diagonal(self._start.fit.digits.covariance, axis1=1, axis2=2)
        self.motion = DigitMotion(sd**2 * REFERENCE_DT_S, self.scales, drift, stationary2, RETURN_TIME_S)

    def neutral_mixture(self) -> ModeMixture:
        """Return the digits at the neutral pose, at rest."""
        measured = OBSERVED
        mean, covariance = np.zeros((N_DIGITS, DIGIT_SIZE)), np.zeros((N_DIGITS, DIGIT_SIZE, DIGIT_SIZE))
        mean[:, measured] = self._start.mean
        covariance[:, measured[:, None], measured] = self._start.covariance
        rate = np.arange(RATES.start, RATES.stop)
        covariance[:, rate, rate] = np.where(self._is_moving, self.settings.initial.joint_rates_rad_s**2, 1e-12)
        return ModeMixture.from_gaussian(mean, covariance, self.scales.size)

    def diffuse_mixture(self, mean: FloatArray, covariance: FloatArray) -> ModeMixture:
        """Return the anatomy as known by now, (5, n) and (5, n, n), the joints anywhere in their range."""
        moving = np.arange(RATES.stop)
        mean, covariance = mean.copy(), covariance.copy()
        mean[:, moving] = 0.0
        mean[:, JOINTS] = np.where(self._is_moving, MID_RANGE_RAD, 0.0)
        covariance[:, moving, :] = 0.0
        covariance[:, :, moving] = 0.0
        covariance[:, _SLOT, _SLOT] = self._range2
        rate = np.arange(RATES.start, RATES.stop)
        covariance[:, rate, rate] = np.where(self._is_moving, REACQUIRED_RATE_SD_RAD_S**2, 1e-12)
        return ModeMixture.from_gaussian(mean, covariance, self.scales.size)

    def restart_at_postures(self, estimates: ModeMixture, postures: dict[int, FloatArray]) -> ModeMixture:
        """Restart some digits about postures, slots (5,) by digit, with the anatomy as known by now."""
        chains, slots = np.array(list(postures)), np.array(list(postures.values()))
        kept = self.restart_digits(estimates, np.isin(np.arange(N_DIGITS), chains), estimates)
        mean, covariance = kept.mean, kept.covariance
        mean[chains, :, :N_SLOTS] = slots[:, None]
        moving = np.where(self._is_moving[chains], POSTURE_SD_RAD**2, self._stationary2[chains])
        covariance[chains[:, None], :, _SLOT, _SLOT] = moving[..., None]
        rate = N_SLOTS + _SLOT
        moving = np.where(self._is_moving[chains], POSTURE_RATE_SD_RAD_S**2, 1e-12)
        covariance[chains[:, None], :, rate, rate] = moving[..., None]
        return kept

    def restart_digits(self, estimates: ModeMixture, chains: NDArray[np.bool_], anatomy: ModeMixture) -> ModeMixture:
        """Restart ``chains`` (5,) anywhere, with the anatomy of another estimate."""
        fresh, chosen = self.diffuse_mixture(*anatomy.merge()), chains[:, None]
        return ModeMixture(
            np.where(chosen[..., None], fresh.mean, estimates.mean),
            np.where(chosen[..., None, None], fresh.covariance, estimates.covariance),
            np.where(chosen, fresh.probability, estimates.probability),
        )

    def apply_joint_limits(
        self, estimates: ModeMixture, before: ModeMixture
    ) -> tuple[ModeMixture, tuple[FloatArray, FloatArray], NDArray[np.bool_]]:
        """Apply the limits; return estimates, merged mean and covariance, and misread digits (5,).

        A digit that a frame has bent as no finger bends was misread: its joints may be anywhere, with the anatomy as it
        was ``before``.
        """
        merged = estimates.merge()
        kept = apply_soft_limits(estimates, merged[0][:, :N_SLOTS])
        if kept is not estimates:
            merged = kept.merge()
        misread = np.asarray((np.abs(compute_limit_excess(merged[0][:, :N_SLOTS])) > MAX_BEYOND_RAD).any(axis=1))
        if misread.any():
            kept = self.restart_digits(kept, misread, before)
            merged = kept.merge()
        return kept, merged, misread

    def predict(self, estimates: ModeMixture, unseen_s: FloatArray, dt_s: float) -> ModeMixture:
        """Predict the digits ``dt_s`` ahead; ``unseen_s`` (5, 5) for how long nothing has shown each slot.

        After a gap between frames a rate has led anywhere, full turns of a joint among it, between which nothing linear
        tells: there the limits are applied before the frame as well, and a long gap leaves nothing of the joints.
        """
        if dt_s <= 0.0:
            return estimates
        switch = mode_transition_matrix(self.scales.size, MODE_DWELL_S, dt_s)
        mean = (estimates.probability[:, None] @ estimates.mean)[:, 0]
        if dt_s >= DIFFUSION_S:
            return self.diffuse_mixture(*estimates.merge())
        ahead = self.motion.predict(estimates, dt_s, self.compute_forgetting(mean, unseen_s, dt_s), switch)
        if dt_s < MIN_GAP_S:
            return ahead
        return apply_soft_limits(ahead, ahead.merge()[0][:, :N_SLOTS])

    def compute_forgetting(self, mean: FloatArray, unseen_s: FloatArray, dt_s: float) -> Forgetting | None:
        """Return the prediction of slots that nothing shows, of digits at ``mean`` (5, n); None for none.

        The angle is spread over the joint's range in ``DIFFUSION_S``, slowly at first. The rate fades, and as much of
        it as is given up becomes possible in either direction.
        """
        is_unseen = (unseen_s > 0.0) & self._is_moving
        if not is_unseen.any():
            return None
        whole_s = DIFFUSION_S
        before = np.minimum(unseen_s, whole_s) / whole_s
        after = np.minimum(unseen_s + dt_s, whole_s) / whole_s
        # Once it may be anywhere it goes on moving as it likes: else smoothing would carry what is seen at its
        # return far into the time it was hidden.
        goes_on = np.where(before >= 1.0, dt_s / whole_s, 0.0)
        angle2 = np.where(is_unseen, RANGE_SD_RAD**2 * (after**3 - before**3 + goes_on), 0.0)
        keep = math.exp(-dt_s / RATE_MEMORY_S)
        rate2 = np.where(is_unseen, (1.0 - keep**2) * mean[:, RATES] ** 2, 0.0)
        return Forgetting(np.where(is_unseen, keep, 1.0), angle2, rate2)

    def compute_learning_share(self, base: DigitBase) -> float:
        """Return the share of a frame's information on the anatomy that is used.

        Little while the palm is unsure, as its error stays for as long as its discs are hidden.
        """
        variance = float(sum(base.pose_covariance.diagonal()[3:].tolist()))
        return LEARNING_SHARE / (1.0 + (variance / SURE_TURN_SD_RAD**2) ** 2)

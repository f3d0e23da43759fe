"""Where the filter of the digits starts: the subject's anatomy from the neutral pose, and how well it is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.camera import Camera
from carpus.core.hand.fitting import AnatomyFit, SeenDiscs, fit_anatomy
from carpus.core.hand.kinematics import DIP_PER_PIP
from carpus.core.hand.protocols import MarkerProtocol
from carpus.core.hand.sites import SITES
from carpus.core.tracking.finger_settings import FingerSettings
from carpus.core.tracking.hand_geometry import CHAINS, CONSTANTS, SLOTS, is_crowded
from carpus.core.types import FloatArray

_NARROW_RAD = 1e-6
"""Of a slot that does not move: the fifth of a finger, the third while the end joint is coupled."""


@dataclass(frozen=True, slots=True)
class DigitStart:
    """Slots and constants (5, 16) at the neutral pose, their covariance (5, 16, 16), and the fit they come from."""

    mean: FloatArray
    covariance: FloatArray
    fit: AnatomyFit


def digit_start(
    calibration: Calibration,
    camera: Camera,
    *,
    dip_free: bool,
    skin_offsets: bool,
    marker_radius_m: float,
    own: FingerSettings,
) -> DigitStart:
    """The anatomy of a calibrated hand; of a digit without discs it is the average hand's."""
    seen = _seen(calibration, camera, marker_radius_m, own)
    fit = fit_anatomy(
        seen,
        calibration.clicks.side,
        dip_free=dip_free,
        skin_offsets=skin_offsets,
        prior=own.anatomy,
        straight=calibration.clicks.straight_fingers,
    )
    mean = np.zeros((CHAINS, SLOTS + CONSTANTS))
    covariance = np.zeros((CHAINS, SLOTS + CONSTANTS, SLOTS + CONSTANTS))
    for chain in range(CHAINS):
        count = fit.neutral_digits[chain].mean.size
        to_slots = np.eye(count)
        if chain:
            to_slots[3, 2] = -DIP_PER_PIP
        cross = to_slots @ fit.neutral_cross[chain]
        mean[chain, :count] = to_slots @ fit.neutral_digits[chain].mean
        mean[chain, SLOTS:] = fit.digits.mean[chain]
        covariance[chain, :count, :count] = to_slots @ fit.neutral_digits[chain].covariance @ to_slots.T
        covariance[chain, :count, SLOTS:] = cross
        covariance[chain, SLOTS:, :count] = cross.T
        covariance[chain, SLOTS:, SLOTS:] = fit.digits.covariance[chain]
    index = np.arange(SLOTS)
    covariance[:, index, index] += _NARROW_RAD**2
    return DigitStart(mean, covariance, fit)


def _seen(calibration: Calibration, camera: Camera, marker_radius_m: float, own: FingerSettings) -> SeenDiscs:
    """The calibrated discs; where one has no depth, the line of sight through its click."""
    protocol, disc = calibration.clicks.protocol, calibration.marker_position_w0_m.copy()
    rotation, translation = calibration.rotation_w0_cam, calibration.translation_w0_cam_m
    clicked = camera.back_project(camera.undistort(calibration.clicks.pixel), np.full(len(disc), translation[2]))
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
    crowded[rays] = is_crowded(camera.project(in_camera)[rays], radius_px, own.crowded_radii)
    across = np.where(crowded, np.hypot(across, own.crowded_px * pixel_m), across)
    blind_m = own.click_px * pixel_m
    return SeenDiscs(
        _at_sites(protocol, disc, np.nan),
        _at_sites(protocol, view, np.nan),
        _at_sites(protocol, np.where(is_blind, blind_m, across), 1.0),
        _at_sites(protocol, np.where(is_blind, np.inf, along), np.inf),
    )


def _at_sites(protocol: MarkerProtocol, values: FloatArray, nothing: float) -> FloatArray:
    """Values (1, 21, ...) of the sites from those of the markers (M, ...); ``nothing`` where there is no disc."""
    out = np.full((1, len(SITES), *values.shape[1:]), nothing)
    out[0, list(protocol.sites)] = values
    return out

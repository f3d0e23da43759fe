"""Pictures of a still, marked hand before the camera, painted disc by disc for the calibration's tests."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from scipy.spatial.transform import Rotation

from carpus.core.calibration.calibrate import CalibrationOutcome, CalibrationSettings, calibrate_hand
from carpus.core.calibration.result import Clicks
from carpus.core.detection.appearance import DetectionSettings, disc_mask
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import FloatArray, Frame, Side
from tests.detection.pictures import CAMERA, Extra, Look, depth_picture, frame, picture
from tests.tracking.hands import FROM_ABOVE, palm


@dataclass(frozen=True, slots=True)
class Scene:
    """How the hand lies. ``tilt_deg`` of the palm about the picture's horizontal; ``size`` scales the hand;
    ``noise`` 1 as the sensor's, 0 none."""

    side: Side = "right"
    distance_m: float = 0.7
    tilt_deg: float = 0.0
    size: float = 1.0
    noise: float = 1.0

    @property
    def rotation_w0_cam(self) -> FloatArray:
        return np.asarray(Rotation.from_euler("x", self.tilt_deg, degrees=True).as_matrix() @ FROM_ABOVE)

    @property
    def discs_cam_m(self) -> FloatArray:
        """Discs in the camera's axes, the palm in the middle of the picture."""
        discs = self.size * palm(self.side) @ self.rotation_w0_cam.T
        discs -= 0.5 * (discs.min(axis=0) + discs.max(axis=0))
        return np.asarray(discs + [0.0, 0.02, self.distance_m] - [0.0, 0.0, discs[0, 2]])

    @property
    def discs_px(self) -> FloatArray:
        return CAMERA.project(self.discs_cam_m)


def make_frames(
    scene: Scene,
    count: int = 17,
    seed: int = 0,
    shift_px: FloatArray | None = None,
    hole_at: int | None = None,
    extras: tuple[Extra, ...] = (),
) -> list[Frame]:
    """Pictures at 30 a second; ``shift_px`` (count, 2) moves all discs, ``hole_at`` takes a disc's depth away,
    ``extras`` are spots that are no discs."""
    rng = np.random.default_rng(seed)
    shift = np.zeros((count, 2)) if shift_px is None else shift_px
    look = Look(noise=3.0 * scene.noise)
    radius_px = CAMERA.fx_px * 0.006 / scene.distance_m
    out = []
    for k in range(count):
        pixel = scene.discs_px + shift[k]
        color = picture(pixel, look, rng if scene.noise else None, radius_px=radius_px, extras=extras)
        depth = depth_picture(None, scene.distance_m)
        for j, (point, z) in enumerate(zip(pixel, scene.discs_cam_m[:, 2], strict=True)):
            depth[disc_mask(depth.shape, point, 9.0)] = 0.0 if j == hole_at else z
        if scene.noise:
            there = depth > 0.0
            noisy = depth + scene.noise * 1.0e-3 * depth**2 * rng.normal(size=depth.shape)
            depth = np.where(there, noisy, 0.0)
        out.append(replace(frame(color, depth, k), timestamp_s=1.7e9 + k / 30.0))
    return out


def click_discs(scene: Scene) -> Clicks:
    return Clicks(scene.side, WRIST6, scene.discs_px)


@lru_cache(maxsize=8)
def _paint(scene: Scene) -> tuple[Frame, ...]:
    return tuple(make_frames(scene))


def render_still_hand(scene: Scene, count: int = 17) -> list[Frame]:
    """The hand lying still; painted once for all tests."""
    return list(_paint(scene)[:count])


def run_calibration(
    scene: Scene, clicks: Clicks | None = None, frames: list[Frame] | None = None
) -> CalibrationOutcome:
    """What is calibrated of a hand; of one that is clicked well and lies still, once for all tests."""
    if clicks is None and frames is None:
        return _calibrate_still(scene)
    frames = frames or render_still_hand(scene)
    return calibrate_hand(clicks or click_discs(scene), frames, CAMERA, CalibrationSettings(), DetectionSettings())


@lru_cache(maxsize=8)
def _calibrate_still(scene: Scene) -> CalibrationOutcome:
    return run_calibration(scene, click_discs(scene))

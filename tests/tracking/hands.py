"""A hand and its blobs for the tracker's tests, made without the program's own simulator, rotations or projection."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, fields, replace

import numpy as np
from scipy.spatial.transform import Rotation

from carpus.core.calibration.result import Calibration, Clicks, Verdict
from carpus.core.model.camera import Camera
from carpus.core.model.hand.protocols import WRIST6
from carpus.core.model.types import Detections, FloatArray, Side, TrackedFrame
from carpus.core.tracking.filter.settings import TrackerSettings
from carpus.core.tracking.filter.soft_tissue import SoftTissue
from carpus.core.tracking.tracker import Tracker

CAMERA = Camera(525.0, 525.0, 319.5, 239.5)
RIGHT_PALM_M = np.array(
    [
        [0.00000, 0.00000, 0.00000],  # WRIST
        [0.01300, 0.02097, -0.01202],  # CMC1
        [0.08000, 0.02181, -0.00306],  # MCP2
        [0.08200, 0.00000, 0.00000],  # MCP3
        [0.07500, -0.01711, -0.00040],  # MCP4
        [0.06600, -0.03342, -0.00288],  # MCP5
    ]
)
"""Discs of a right hand in the axes of its own W (to a hundredth of a degree), as a calibration gives them."""
WRIST, CMC1, MCP2, MCP3, MCP4, MCP5 = range(6)
FROM_ABOVE = np.array([[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
"""W0 seen by a camera that looks straight down, fingers to the top of the picture (clinical reference 1.1)."""
MIDDLE_M = np.array([0.01, 0.04, 0.7])
"""Where the WRIST disc lies before the camera at the neutral pose."""
DISC_AREA_PX = np.pi * (525.0 * 0.006 / 0.7) ** 2
DT_S = 1.0 / 30.0


_NONE_M = 1e-7
RIGID = replace(
    TrackerSettings(),
    tissue=SoftTissue(
        **dict.fromkeys(
            ("knuckle_along_m", "knuckle_across_m", "knuckle_up_m", "wrist_along_m", "wrist_across_m", "wrist_up_m",
             "thumb_m"), _NONE_M
        ),
        **dict.fromkeys(("cupping_m", "loose_along_m", "loose_across_m"), (_NONE_M, _NONE_M)),
        **dict.fromkeys(("relief_home", "relief_still", "relief_moving"), (_NONE_M, _NONE_M, _NONE_M)),
    ),
)  # fmt: skip
"""The discs of this file's hand move as one body; told so, the filter is to be as sure as that allows."""


def palm(side: Side) -> FloatArray:
    return RIGHT_PALM_M if side == "right" else RIGHT_PALM_M * [1.0, -1.0, 1.0]


def calibration(side: Side = "right", sd_m: float = 4e-4, start_angles_rad: FloatArray | None = None) -> Calibration:
    """A calibration that knows the palm as it is and claims to know it to ``sd_m``."""
    discs = palm(side)
    pixel = CAMERA.project(discs @ FROM_ABOVE.T + MIDDLE_M)
    verdict = Verdict(np.zeros(6), 180.0, 0.0, 0.7, 15, ())
    return Calibration(
        Clicks(side, WRIST6, pixel),
        discs,
        FROM_ABOVE,
        MIDDLE_M,
        np.broadcast_to(sd_m**2 * np.eye(3), (6, 3, 3)),
        np.zeros(3) if start_angles_rad is None else start_angles_rad,
        verdict,
    )


def build_rotation(deviation: float, flexion: float, supination: float, side: Side = "right") -> FloatArray:
    """R of W2 in W0 from clinical degrees, by SciPy; the left hand is the mirrored right one."""
    right = Rotation.from_euler("ZYX", [deviation, flexion, supination], degrees=True).as_matrix()
    mirror = np.diag([1.0, 1.0 if side == "right" else -1.0, 1.0])
    return np.asarray(mirror @ right @ mirror)


@dataclass(frozen=True, slots=True)
class Pose:
    """Where the palm is: clinical angles in degrees and the place of its WRIST disc in W0."""

    angles_deg: FloatArray = field(default_factory=lambda: np.zeros(3))
    position_m: FloatArray = field(default_factory=lambda: np.zeros(3))


def discs_cam_m(pose: Pose, side: Side = "right") -> FloatArray:
    rotation = build_rotation(*pose.angles_deg, side=side)
    return np.asarray((palm(side) @ rotation.T + pose.position_m) @ FROM_ABOVE.T + MIDDLE_M)


def blobs(
    pose: Pose,
    rng: np.random.Generator | None = None,
    *,
    side: Side = "right",
    hidden: Iterable[int] = (),
    false_px: Sequence[Sequence[float]] = (),
    false_depth_m: float = 0.71,
    with_depth: bool = True,
    pixel_sd_px: float = 0.1,
    depth_sd_m: float = 7e-4,
) -> Detections:
    """The blobs of one picture in a random order; without ``rng`` free of noise and in the protocol's order."""
    discs = discs_cam_m(pose, side)
    shown = np.setdiff1d(np.arange(6), np.array(list(hidden), dtype=int))
    pixel = np.stack((525.0 * discs[:, 0] / discs[:, 2] + 319.5, 525.0 * discs[:, 1] / discs[:, 2] + 239.5), axis=1)
    pixel = np.concatenate((pixel[shown], np.reshape(np.array(false_px, dtype=float), (-1, 2))))
    depth = np.concatenate((discs[shown, 2], np.full(len(false_px), false_depth_m)))
    if rng is not None:
        order = rng.permutation(len(pixel))
        pixel = pixel[order] + pixel_sd_px * rng.normal(size=pixel.shape)
        depth = depth[order] + depth_sd_m * rng.normal(size=depth.shape)
    if not with_depth:
        depth = np.full_like(depth, np.nan)
    count = len(pixel)
    return Detections(
        pixel,
        depth,
        np.where(np.isfinite(depth), depth_sd_m, np.nan),
        np.full(count, DISC_AREA_PX),
        np.full(count, 0.9),
    )


def combine_motions(*every: Detections) -> Detections:
    """The blobs of one picture with several hands."""
    fields = ("pixel", "depth_m", "depth_sd_m", "area_px", "similarity")
    return Detections(*(np.concatenate([getattr(one, field) for one in every]) for field in fields))


Motion = Callable[[float], Pose]


def swing(which: int, amplitude_deg: float, hz: float) -> Motion:
    """One clinical angle to and fro about neutral, at rest when it starts."""

    def at(time_s: float) -> Pose:
        angles = np.zeros(3)
        ramp = min(1.0, time_s / 0.3)
        angles[which] = ramp * amplitude_deg * np.sin(2.0 * np.pi * hz * time_s)
        return Pose(angles)

    return at


def track(
    frames: Iterable[tuple[float, Detections]],
    settings: TrackerSettings | None = None,
    side: Side = "right",
    tracker: Tracker | None = None,
) -> list[TrackedFrame]:
    """The frames through a tracker that starts at neutral."""
    if tracker is None:
        tracker = Tracker(calibration(side), CAMERA, settings or TrackerSettings())
    return [tracker.step(i, time_s, found) for i, (time_s, found) in enumerate(frames)]


def angles_deg(frames: Iterable[TrackedFrame]) -> FloatArray:
    return np.degrees(np.array([frame.kinematics.angles_rad for frame in frames]))


def is_unknown(frame: TrackedFrame) -> bool:
    """Whether nothing is told of the hand."""
    moment = [getattr(frame.kinematics, field.name) for field in fields(frame.kinematics)]
    return all(np.isnan(value).all() for value in (*moment, frame.marker_position_cam_m, frame.marker_measured_px))


def truth_deg(motion: Motion, times_s: Iterable[float]) -> FloatArray:
    return np.array([motion(float(t)).angles_deg for t in times_s])


def shift_pose(pose: Pose, shift_m: Sequence[float]) -> Pose:
    return replace(pose, position_m=pose.position_m + np.array(shift_m))

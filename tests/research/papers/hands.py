"""Hands and blobs for the tests of the papers' filter, by SciPy's rotations and a projection written here."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
from scipy.spatial.transform import Rotation

from carpus.core.calibration.result import Calibration, Clicks, Verdict
from carpus.core.model.hand.anatomy import HandAnatomy, anatomy_from_size
from carpus.core.model.hand.kinematics import joint_centres
from carpus.core.model.hand.protocols import HAND21, WRIST6, MarkerProtocol
from carpus.core.model.types import Detections, FloatArray, Side, TrackedFrame
from carpus.core.research.papers.hand_model import PaperSettings
from carpus.core.research.papers.tracker import PaperTracker
from tests.tracking.hands import FROM_ABOVE, build_rotation, palm

MIDDLE_M = np.array([0.01, 0.07, 0.68])

MEASURED = PaperSettings(palm="measured")


def project_discs(point_cam_m: FloatArray) -> FloatArray:
    return np.asarray(525.0 * point_cam_m[..., :2] / point_cam_m[..., 2:] + [319.5, 239.5])


def calibration(
    disc_m: FloatArray, protocol: MarkerProtocol = WRIST6, side: Side = "right", rotation: FloatArray = FROM_ABOVE
) -> Calibration:
    """A calibration that knows discs (M, 3) in W0."""
    count = len(protocol.markers)
    pixel = project_discs(disc_m @ rotation.T + MIDDLE_M)
    verdict = Verdict(np.zeros(count), 180.0, 0.0, 0.68, 15, ())
    covariance = np.broadcast_to(1e-8 * np.eye(3), (count, 3, 3))
    return Calibration(Clicks(side, protocol, pixel), disc_m, rotation, MIDDLE_M, covariance, np.zeros(3), verdict)


def straight_hand() -> tuple[HandAnatomy, FloatArray]:
    """A flat hand with its discs in the joints, and the discs (21, 3) at its neutral pose, the straight one."""
    anatomy = anatomy_from_size(0.18, arch=0.0, skin_offsets=False)
    return anatomy, joint_centres(anatomy, np.zeros(17))


def tilt_palm(degrees: float) -> FloatArray:
    """g_w0c of a hand whose fingers point away from, or towards, a camera above."""
    return np.asarray(FROM_ABOVE @ Rotation.from_euler("y", degrees, degrees=True).as_matrix())


def blobs(pixel: FloatArray, rng: np.random.Generator | None = None, sd_px: float = 0.1) -> Detections:
    """Blobs at pixels (D, 2), with noise and in any order if there is a generator; no depth, which nobody may need."""
    if rng is not None:
        pixel = rng.permutation(pixel + sd_px * rng.normal(size=pixel.shape))
    count = len(pixel)
    return Detections(pixel, np.full(count, np.nan), np.full(count, np.nan), np.full(count, 60.0), np.full(count, 0.9))


def track_poses(tracker: PaperTracker, seen: Iterable[Detections], fps: float = 30.0) -> list[TrackedFrame]:
    return [tracker.step(i, i / fps, found) for i, found in enumerate(seen)]


def palm_blobs(
    angles_deg: Callable[[float], FloatArray], count: int, seed: int = 1, side: Side = "right"
) -> list[Detections]:
    """An arched palm that turns about its WRIST disc."""
    rng = np.random.default_rng(seed)
    turns = [build_rotation(*angles_deg(i / 30.0), side=side) for i in range(count)]
    return [blobs(project_discs(palm(side) @ turn.T @ FROM_ABOVE.T + MIDDLE_M), rng) for turn in turns]


def finger_blobs(
    joints_rad: Callable[[float], FloatArray], count: int, rotation: FloatArray, seed: int = 1
) -> list[Detections]:
    anatomy, _ = straight_hand()
    rng = np.random.default_rng(seed)
    places = [joint_centres(anatomy, joints_rad(i / 30.0)) @ rotation.T + MIDDLE_M for i in range(count)]
    return [blobs(project_discs(place), rng) for place in places]


def hand_calibration(rotation: FloatArray) -> Calibration:
    return calibration(straight_hand()[1], HAND21, rotation=rotation)

"""Values that travel between the stages; frozen, arrays read-only.

Frames of reference: ``cam`` is the colour camera (x right, y down, z forward), ``w0`` the wrist frame at the neutral
pose (origin WRIST marker, X to MCP3, Z out of the back of the hand, Y = Z x X), ``w2`` the moving wrist frame.
``rotation_a_b`` maps vectors of a into b.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum, IntEnum
from typing import Literal

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ByteImage = NDArray[np.uint8]
DepthImage = NDArray[np.uint16]
BoolArray = NDArray[np.bool_]

Side = Literal["right", "left"]

SIMULATED = "simulated"  # The setting, "yes", of a source whose frames show a simulated hand; absent for every other.


class TrackStatus(IntEnum):
    """Status of the track in one frame, as stored in ``/frames/status``."""

    TRACKED = 0
    PREDICTED = 1
    LOST = 2
    DOUBTFUL = 3  # measured, but contradicted by what is seen; the standard deviations are widened


class LossReason(Enum):
    """Why the track was lost, as the log says it."""

    NO_FRAMES = "no frame arrived for too long"
    TOO_FEW_MARKERS = "too few markers of the palm were visible for too long"
    UNCONFIRMED_POSE = "the next frames did not confirm the pose that was found"
    MARKERS_CORRECTED = "its markers were corrected by hand"


@dataclass(frozen=True, slots=True)
class Region:
    """A rectangle of the image in pixels; ``right`` and ``bottom`` are just outside."""

    left: int
    top: int
    right: int
    bottom: int

    def clip(self, width: int, height: int) -> Region:
        return Region(max(self.left, 0), max(self.top, 0), min(self.right, width), min(self.bottom, height))

    @property
    def is_empty(self) -> bool:
        return self.right - self.left < 8 or self.bottom - self.top < 8


@dataclass(frozen=True, slots=True)
class Frame:
    """One colour image and the depth image that belongs to it.

    ``color_rgb`` (H, W, 3) uint8; ``depth_raw`` (H, W) uint16 registered to colour, 0 = no reading, None when no depth
    image was near enough in time; ``depth_unit_m`` metres per count; ``dropped_before`` frames missing between the
    previous one and this one.
    """

    index: int
    timestamp_s: float
    color_rgb: ByteImage
    depth_raw: DepthImage | None
    depth_unit_m: float
    dropped_before: int = 0

    def decode(self, _region: Region | None) -> Frame:
        """Return the frame with at least ``_region`` decoded (all of it if None)."""
        return self


# The most depth readings that a frame keeps on the back of the hand, and about the fingers.
MAX_SURFACE_READINGS, MAX_FINGER_READINGS = 224, 352
FINGER_SAMPLE_STEP_PX = 4  # between two readings about the fingers


@dataclass(frozen=True, slots=True)
class SurfaceSamples:
    """Depth readings: ``pixel`` (S, 2), u right, v down, and ``depth_m`` (S,)."""

    pixel: FloatArray
    depth_m: FloatArray


@dataclass(frozen=True, slots=True)
class Detections:
    """The D blobs of one frame, in no particular order.

    ``pixel`` (D, 2) centre, u right, v down; ``depth_m`` (D,) along the camera's z, NaN when unknown; ``depth_sd_m``
    (D,) its standard deviation; ``area_px`` (D,); ``similarity`` (D,) Bhattacharyya coefficient to the reference
    colour, 0 to 1. ``surface`` and ``fingers`` are depth readings on the back of the hand and about the fingers, None
    where none were taken.
    """

    pixel: FloatArray
    depth_m: FloatArray
    depth_sd_m: FloatArray
    area_px: FloatArray
    similarity: FloatArray
    surface: SurfaceSamples | None = None
    fingers: SurfaceSamples | None = None

    def subset(self, is_kept: NDArray[np.bool_]) -> Detections:
        """Return the blobs of the mask ``is_kept`` (D,)."""
        if is_kept.all():
            return self
        return Detections(
            self.pixel[is_kept],
            self.depth_m[is_kept],
            self.depth_sd_m[is_kept],
            self.area_px[is_kept],
            self.similarity[is_kept],
            self.surface,
            self.fingers,
        )

    def with_readings(self, surface: SurfaceSamples | None, fingers: SurfaceSamples | None) -> Detections:
        """Return the blobs with depth readings."""
        return Detections(self.pixel, self.depth_m, self.depth_sd_m, self.area_px, self.similarity, surface, fingers)

    def __len__(self) -> int:
        return int(self.pixel.shape[0])

    @staticmethod
    def none() -> Detections:
        """Return detections without a blob."""
        empty = np.empty(0)
        return Detections(np.empty((0, 2)), empty, empty, empty, empty)


@dataclass(frozen=True, slots=True)
class KinematicState:
    """Wrist and joints at one moment; NaN where not known.

    ``position_m`` and ``velocity_m_s`` (3,) of W2's origin, the WRIST marker, in W0 as calibrated; ``rotation_w2_w0``
    (3, 3) in W0 as refined by then, which the rotation vector ``w0_turn_rad`` (3,) turns into W0 as calibrated;
    ``angular_velocity_rad_s`` (3,) in W2; ``angles_rad`` and ``angles_sd_rad`` (3,) deviation, flexion, pronosupination
    with clinical signs; ``angles_zyz_rad`` (3,). ``joint_*`` (J,), J = 0 where the protocol has no fingers;
    ``joint_position_m`` (M, 3) in W0, else (0, 3). A field here is a line of the schema's ``MOTION_FIELDS``.
    """

    position_m: FloatArray
    velocity_m_s: FloatArray
    w0_turn_rad: FloatArray
    rotation_w2_w0: FloatArray
    angular_velocity_rad_s: FloatArray
    angles_rad: FloatArray
    angles_sd_rad: FloatArray
    angles_zyz_rad: FloatArray
    joint_angles_rad: FloatArray
    joint_angles_sd_rad: FloatArray
    joint_velocity_rad_s: FloatArray
    joint_position_m: FloatArray


@dataclass(frozen=True, slots=True)
class TrackedFrame:
    """The result of one frame; the row of every dataset of the session file.

    M markers of the protocol; unknown is NaN. ``marker_position_cam_m`` (M, 3); ``marker_predicted_px`` (M, 2) before
    the update; ``marker_measured_px`` (M, 2) and ``marker_measured_depth_m`` (M,) of the blob associated with the
    marker. ``measured_share`` (3,) or (J,) is the
    share of direct measurement in the last second; ``nis`` the normalised innovation squared with ``nis_dof`` degrees
    of freedom; ``loss_reason`` (not stored) while the track is lost. ``doubted`` (M,) markers whose measurements
    contradict the estimate; ``is_rejected`` (D,) detections that a person said are no marker (not used, not stored).
    Both default to none.
    """

    index: int
    timestamp_s: float
    status: TrackStatus
    kinematics: KinematicState
    marker_position_cam_m: FloatArray
    marker_predicted_px: FloatArray
    marker_measured_px: FloatArray
    marker_measured_depth_m: FloatArray
    detections: Detections
    dropped_before: int
    measured_share: FloatArray
    nis: float
    nis_dof: int
    loss_reason: LossReason | None = None
    doubted: BoolArray = field(default_factory=lambda: np.zeros(0, dtype=np.bool_))
    is_rejected: BoolArray = field(default_factory=lambda: np.zeros(0, dtype=np.bool_))

    def __post_init__(self) -> None:
        if not len(self.doubted):
            object.__setattr__(self, "doubted", np.zeros(len(self.marker_measured_px), dtype=np.bool_))
        if len(self.is_rejected) != len(self.detections):
            object.__setattr__(self, "is_rejected", np.zeros(len(self.detections), dtype=np.bool_))

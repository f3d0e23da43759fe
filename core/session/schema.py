"""The session file in one table, followed by writer, reader, recovery and the format page.

A change of meaning raises :data:`FORMAT_VERSION`; a field added later states its version in ``since`` and is optional.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from carpus.core.model.hand.dorsal_surface import TABLE_ROWS
from carpus.core.model.hand.protocols import WRIST_ANGLES, MarkerProtocol, protocol_names
from carpus.core.model.types import MAX_FINGER_READINGS, MAX_SURFACE_READINGS

FORMAT = "carpus-session"
FORMAT_VERSION = 2
LENS_VERSION = 3
"""Version of sessions whose lens an older Carpus would take for plumb_bob: it refuses them. Nothing else differs."""
NEWEST_VERSION = LENS_VERSION

ZYZ_ANGLES = ("alpha", "beta", "gamma")

ROOT_ATTRIBUTES = {
    "format": f"always {FORMAT}",
    "format_version": f"{FORMAT_VERSION}; {LENS_VERSION} with the distortion model inverse_brown_conrady",
    "session_id": "UUID of this session",
    "recording_id": "UUID of the recording, the same for every result of it; since version 2",
    "subject_id": "pseudonym of the patient",
    "recorded": "when the hand moved, ISO 8601 with zone, empty where nobody knows; since version 2",
    "created": "when this file was made, ISO 8601 with zone",
    "hand": "right or left",
    "protocol": " or ".join(protocol_names()),
    "exercise": "what was trained",
    "software_version": "of the Carpus that wrote the file",
    "parameters": "JSON of all settings; `set_up` has repetitions and targets (pronosupination from palm down) and, "
    "within a set of exercises, `set`: `run` (the same for all its sessions), `part`, `of`, `seconds`",
    "complete": "always true; false in a part file of Carpus 0.2.0",
    "origin": "session_id of the session this one was tracked again from, else empty",
}
RECOVERED = "recovered"
"""Root attribute of an interrupted session that was finished later: when, ISO 8601."""

CAMERA_ATTRIBUTES = {
    "fx": "px",
    "fy": "px",
    "cx": "px",
    "cy": "px",
    "width": "px",
    "height": "px",
    "distortion": "k1 k2 p1 p2 k3, of rational_polynomial also k4 k5 k6",
    "origin": "file, calibration, factory, driver or default",
    "depth_sensor": "JSON: the depth sensor whose noise was reckoned with, `origin` assumed where no source said; "
    "without this attribute PrimeSense",
    "distortion_model": "plumb_bob, rational_polynomial or inverse_brown_conrady (RealSense); without it plumb_bob",
}
VERDICT_ATTRIBUTES = {
    "hand_length_m": "estimated from the palm",
    "tilt_rad": "of the palm to the camera's axis",
    "distance_m": "of WRIST from the camera",
    "frames_used": "still frames averaged",
    "findings": "JSON, what was not as it should be",
    "straight_fingers": "thumb to little, 1 where a person said it lay straight at the neutral pose; empty: not said",
}

NAMED_AXES = {"M": "markers", "J": "joint angles", "A": "wrist angles", "Z": "ZYZ angles", "Q": "joint or wrist angles"}
"""Axes whose entries have names."""
GROWING_AXES = {"N": "frames", "D": "blobs of all frames", "E": "events", "C": "bytes of colour", "B": "bytes of depth"}
"""Axes that grow while a session runs; always the first of a dataset."""


TEXT_BYTES = 2048
"""Size of a text, within its chunk and its checksum; the writer splits longer ones over several rows."""


@dataclass(frozen=True, slots=True)
class Field:
    """Dataset of the session file.

    Attributes
    ----------
    attribute : str
        Name of the value in the object it is written from (frame, detections, event, calibration).
    dtype : str
        f4, f8, u1, u2, i4, i8, text or rows (of a table with named columns).
    shape : tuple
        Sizes and axis letters.
    fill : float
        Value where nothing was written; never a possible measurement.
    """

    path: str
    attribute: str
    dtype: str
    shape: tuple[str | int, ...]
    unit: str
    description: str
    optional: bool = False
    fingers_only: bool = False
    fill: float = float("nan")
    since: int = 1

    @property
    def h5_dtype(self) -> Any:
        if self.dtype == "rows":
            return REPETITION_DTYPE
        # Not marked as UTF-8, which they are: Octave loads no file with such a mark.
        return np.dtype(f"S{TEXT_BYTES}") if self.dtype == "text" else np.dtype(self.dtype)

    @property
    def label_axis(self) -> str:
        """Letter of the axis whose entries have names, or empty."""
        return next((str(axis) for axis in self.shape if axis in NAMED_AXES), "")


@dataclass(frozen=True, slots=True)
class Column:
    """Column of a table; ``attribute`` is the name of the value in the object of a row."""

    name: str
    attribute: str
    dtype: str
    unit: str
    description: str


@dataclass(frozen=True, slots=True)
class TableLayout:
    """Meaning of the axis letters in one file."""

    protocol: MarkerProtocol
    joint_names: tuple[str, ...]

    def names(self, axis: str) -> tuple[str, ...]:
        """Return the names along an axis."""
        by_axis = {
            "M": self.protocol.markers,
            "J": self.joint_names,
            "A": WRIST_ANGLES,
            "Z": ZYZ_ANGLES,
            "Q": self.joint_names or WRIST_ANGLES,
        }
        return by_axis[axis]

    def row_shape(self, field: Field) -> tuple[int, ...]:
        """Return the shape without the growing axis; the whole shape of a field that is written once."""
        axes = field.shape[1:] if field.shape[0] in GROWING_AXES else field.shape
        return tuple(axis if isinstance(axis, int) else len(self.names(axis)) for axis in axes)

    def has(self, field: Field) -> bool:
        return self.protocol.has_fingers or not field.fingers_only

    def group_names(self) -> dict[str, tuple[str, ...]]:
        """Return the groups that have an attribute ``names``."""
        groups = {"/markers": self.protocol.markers, "/wrist": WRIST_ANGLES}
        return groups | ({"/joints": self.joint_names} if self.protocol.has_fingers else {})


# Two lines a row: where and what, then the words.
# fmt: off
CALIBRATION_FIELDS = (
    Field("/calibration/clicks", "clicks_px", "f8", ("M", 2), "px",
          "first-frame clicks as clicked, u right, v down"),
    Field("/calibration/marker_position", "marker_position_w0_m", "f8", ("M", 3), "m",
          "disc centres at the neutral pose in W0"),
    Field("/calibration/rotation", "rotation_w0_cam", "f8", (3, 3), "1",
          "rotation of g_w0c: vectors of W0 to the colour camera"),
    Field("/calibration/translation", "translation_w0_cam_m", "f8", (3,), "m",
          "translation of g_w0c: origin of W0 in the colour camera"),
    Field("/calibration/marker_covariance", "marker_covariance_w0_m2", "f8", ("M", 3, 3), "m^2",
          "how well the place of each disc is known, covariance in W0", optional=True),
    Field("/calibration/start_angles", "start_angles_rad", "f8", ("A",), "rad",
          "angles of the neutral pose as the therapist gave them, zero when none were; pronosupination from the palm "
          "down", optional=True),
    Field("/calibration/residual", "residual_m", "f8", ("M",), "m",
          "distance of each disc from its fitted place", optional=True),
    Field("/calibration/surface", "surface", "f8", (TABLE_ROWS, 5), "m",
          "back of the hand over its fixed unit in W0, NaN below its end: origin x, y, step, rows, columns of a grid;"
          " its middle; then every node as row, column, height, slopes", optional=True),
)

MOTION_FIELDS = (
    Field("/wrist/position", "position_m", "f8", ("N", 3), "m", "T: origin of W2 in W0"),
    Field("/wrist/velocity", "velocity_m_s", "f8", ("N", 3), "m/s",
          "v: velocity of the origin of W2 in W0"),
    Field("/wrist/w0_turn", "w0_turn_rad", "f8", ("N", 3), "rad",
          "rotation vector: W0 as refined by this frame, in whose axes rotation and angles are read, to W0 of "
          "/calibration, in whose axes all places are; W2 to the camera: calibration rotation, this, R",
          optional=True, since=2),
    Field("/wrist/rotation", "rotation_w2_w0", "f8", ("N", 3, 3), "1",
          "R: rotation of W2 in W0, not mirrored for a left hand"),
    Field("/wrist/angular_velocity", "angular_velocity_rad_s", "f8", ("N", 3), "rad/s",
          "angular velocity in W2, a state of the filter"),
    Field("/wrist/angles", "angles_rad", "f8", ("N", "A"), "rad",
          "clinical angles: + radial, + flexion, + supination on both hands; pronosupination from the palm down, "
          "so that thumb up is + 90 degrees"),
    Field("/wrist/angles_sd", "angles_sd_rad", "f8", ("N", "A"), "rad",
          "standard deviation of the clinical angles, calibration included"),
    Field("/wrist/angles_zyz", "angles_zyz_rad", "f8", ("N", "Z"), "rad",
          "ZYZ angles of R; NaN where beta is below 3 degrees"),
    Field("/joints/angles", "joint_angles_rad", "f8", ("N", "J"), "rad",
          "joint angles, zero = straight finger", fingers_only=True),
    Field("/joints/angles_sd", "joint_angles_sd_rad", "f8", ("N", "J"), "rad",
          "standard deviation of the joint angles", fingers_only=True),
    Field("/joints/velocity", "joint_velocity_rad_s", "f8", ("N", "J"), "rad/s",
          "rate of the joint angles", fingers_only=True),
    Field("/joints/position", "joint_position_m", "f8", ("N", "M", 3), "m",
          "joint centres and fingertips in W0; a coupled end joint bends by two thirds of the middle one",
          fingers_only=True),
)
"""Written from a frame's moment and, under ``/smoothed``, from the smoother's."""

FRAME_FIELDS = (
    Field("/frames/timestamp", "timestamp_s", "f8", ("N",), "s",
          "time of the colour picture as in the recording, strictly rising"),
    Field("/frames/status", "status", "u1", ("N",), "1", "0 tracked, 1 predicted, 2 lost,"
          " 3 doubtful: measured, but what is seen contradicts what is stated", fill=2),
    *MOTION_FIELDS,
    Field("/markers/position_camera", "marker_position_cam_m", "f8", ("N", "M", 3), "m",
          "centres of the discs as the model has them, in camera axes; finite for hidden ones too"),
    Field("/markers/measured", "marker_measured_px", "f8", ("N", "M", 2), "px",
          "the blob taken for the marker; NaN when none"),
    Field("/markers/measured_depth", "marker_measured_depth_m", "f8", ("N", "M"), "m",
          "depth of that blob along the camera's z; NaN when none"),
    Field("/markers/doubted", "doubted", "u1", ("N", "M"), "1",
          "1 where what is seen contradicts what is stated of the marker", optional=True, fill=0),
    Field("/quality/dropped_frames", "dropped_before", "i4", ("N",), "1",
          "frames missing before this one", fill=-1),
    Field("/quality/measured_share", "measured_share", "f8", ("N", "Q"), "1",
          "share of direct measurements in the last second"),
    Field("/quality/nis", "nis", "f8", ("N",), "1", "normalised innovation squared"),
    Field("/quality/nis_dof", "nis_dof", "i4", ("N",), "1",
          "degrees of freedom of nis", optional=True, fill=-1),
)

DETECTION_FRAME = Field("/detections/frame", "frame", "i8", ("D",), "1", "row of the frame in /frames, rising", fill=-1)
DETECTION_FIELDS = (
    Field("/detections/pixel", "pixel", "f8", ("D", 2), "px",
          "centre of the blob, u right, v down"),
    Field("/detections/depth", "depth_m", "f8", ("D",), "m",
          "depth of the blob along the camera's z; NaN when unknown"),
    Field("/detections/depth_sd", "depth_sd_m", "f8", ("D",), "m", "standard deviation of depth"),
    Field("/detections/area", "area_px", "f8", ("D",), "px^2", "area of the blob"),
    Field("/detections/similarity", "similarity", "f8", ("D",), "1",
          "Bhattacharyya coefficient to the reference colour"),
)
DETECTION_COUNT = Field("/detections/count", "count", "i4", ("N",), "1",
                        "blobs of this frame", optional=True, fill=-1)

SURFACE_FIELDS = (
    Field("/surface/pixel", "pixel", "u2", ("N", MAX_SURFACE_READINGS, 2), "px",
          "where the depth of the back of the hand was read, u right, v down; 65535 for none",
          optional=True, fill=65535),
    Field("/surface/depth", "depth_m", "f4", ("N", MAX_SURFACE_READINGS), "m",
          "depth read there along the camera's z; NaN for none", optional=True),
)
FINGER_FIELDS = (
    Field("/surface/finger_pixel", "pixel", "u2", ("N", MAX_FINGER_READINGS, 2), "px",
          "where the depth about the fingers was read, u right, v down; 65535 for none",
          optional=True, fingers_only=True, fill=65535),
    Field("/surface/finger_depth", "depth_m", "f4", ("N", MAX_FINGER_READINGS), "m",
          "depth read there along the camera's z; NaN for none", optional=True, fingers_only=True),
)
"""Depth samples that tracking again needs."""

RAW_STREAMS = (
    Field("/raw/color", "color", "u1", ("C",), "1",
          "colour pictures as files (JPEG or PNG), one after the other", optional=True, fill=0),
    Field("/raw/depth", "depth", "u1", ("B",), "1",
          "depth pictures as 16-bit PNG files, one after the other", optional=True, fill=0),
)
RAW_ENDS = (
    Field("/raw/color_end", "color", "i8", ("N",), "1",
          "where this frame's picture ends in /raw/color; it begins where the one before ends", optional=True, fill=-1),
    Field("/raw/depth_end", "depth", "i8", ("N",), "1",
          "where this frame's picture ends in /raw/depth; the same as before: no picture", optional=True, fill=-1),
)
RAW_DEPTH_UNIT = "depth_unit_m"
"""Attribute of ``/raw``: metres per count of the depth images."""

EVENT_FIELDS = (
    Field("/events/time", "time_s", "f8", ("E",), "s",
          "time of the event, on the clock of /frames/timestamp"),
    Field("/events/kind", "kind", "text", ("E",), "", "note, pain, pause, camera_lost, ..."),
    Field("/events/text", "text", "text", ("E",), "", "words that go with it"),
)
REPETITION_COLUMNS = (
    Column("start", "start_s", "f8", "s", "when it left its first turning place, or passed the middle "
           "of a motion to both sides, on the clock of /frames/timestamp"),
    Column("peak", "peak_s", "f8", "s", "when it was furthest on its way there, the middle of a hold"),
    Column("end", "end_s", "f8", "s", "when it reached its last turning place, or passed that middle again"),
    Column("angle", "angle_rad", "f8", "rad", "at the peak, counted as in /wrist/angles"),
    Column("arc", "arc_rad", "f8", "rad", "from its smallest angle to its largest, without what noise adds"),
    Column("arc_sd", "arc_sd_rad", "f8", "rad", "standard deviation of the arc by the tracker"),
    Column("peak_speed", "peak_speed_rad_s", "f8", "rad/s", "of its quickest stroke"),
    Column("peak_speed_sd", "peak_speed_sd_rad_s", "f8", "rad/s", "what noise leaves in the peak speed"),
    Column("movement_time", "movement_time_s", "f8", "s", "on its way, each stroke from 5 % to 5 % of its peak speed, "
           "pauses included, holds in the turning places not; not known where that of one stroke is not"),
    Column("sparc", "sparc", "f8", "1", "smoothness, mean of its strokes, pauses included; "
           "not of half a one from rest"),
    Column("movement_units", "movement_units", "f8", "1", "peaks of speed of all its strokes"),
    Column("pauses", "pauses", "f8", "1", "how often it stood still within a stroke"),
    Column("pause_time", "pause_s", "f8", "s", "for how long in all"),
    Column("at_least", "at_least", "u1", "1", "1 where the arc is a lower bound: the angle may have gone further while "
           "it was hidden; else 0"),
    Column("counted", "counted", "u1", "1", "1 where it counts, else 0"),
    Column("reason", "reason", "S64", "", "why it does not count: hidden, not seen well enough; cut_by_start, "
           "cut_by_gap, cut_by_end, when the recording began or ended in it or the hand was gone; empty where it does"),
)
REPETITIONS = Field("/repetitions", "repetitions", "rows", ("P",), "of each column",
                    "repetitions of the trained angle as counted when the session was finished", optional=True)
REPETITION_ANGLE = "angle"
"""Attribute of ``/repetitions``: name of the exercised angle, empty if there is none."""
REPETITION_DTYPE = np.dtype([(column.name, column.dtype) for column in REPETITION_COLUMNS])
# fmt: on

SMOOTHED_FIELDS = tuple(
    Field(
        "/smoothed" + field.path,
        field.attribute,
        field.dtype,
        field.shape,
        field.unit,
        field.description + "; by the smoother",
        optional=True,
        fingers_only=field.fingers_only,
        since=field.since,
    )
    for field in MOTION_FIELDS
)

ALL_FIELDS = (
    *CALIBRATION_FIELDS,
    *FRAME_FIELDS,
    DETECTION_FRAME,
    *DETECTION_FIELDS,
    DETECTION_COUNT,
    *SURFACE_FIELDS,
    *FINGER_FIELDS,
    *EVENT_FIELDS,
    REPETITIONS,
    *SMOOTHED_FIELDS,
    *RAW_STREAMS,
    *RAW_ENDS,
)

"""The session file in one table, followed by writer, reader, recovery and the format page.

A change of meaning raises :data:`FORMAT_VERSION`; a field added later states its version in ``since`` and is optional.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
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
    "format_version": f"{FORMAT_VERSION}, or {LENS_VERSION} with the distortion model inverse_brown_conrady",
    "session_id": "UUID of this session",
    "recording_id": "UUID of the recording; all results of one recording have the same; since version 2",
    "subject_id": "pseudonym of the patient",
    "recorded": "when the hand moved, ISO 8601 with time zone; empty if unknown; since version 2",
    "created": "when this file was made, ISO 8601 with time zone",
    "hand": "right or left",
    "protocol": " or ".join(protocol_names()),
    "exercise": "id of the exercise, such as WRIST_FE",
    "software_version": "version of Carpus that wrote the file",
    "parameters": "all settings as JSON; `set_up` has the number of repetitions and the goals (pronosupination counted "
    "from palm down). Within a set of exercises, its `set` has `run` (the same for all sessions of the set), `part`, "
    "`of` and `seconds`",
    "complete": "true; false only in an unfinished file of Carpus 0.2.0",
    "origin": "session_id of the session that was tracked again to make this one; else empty",
}
RECOVERED = "recovered"
"""Root attribute of an interrupted session that was finished later: when, ISO 8601."""

CAMERA_ATTRIBUTES = {
    "fx": "focal length in x, px",
    "fy": "focal length in y, px",
    "cx": "principal point in x, px",
    "cy": "principal point in y, px",
    "width": "width of an image, px",
    "height": "height of an image, px",
    "distortion": "k1 k2 p1 p2 k3; with rational_polynomial also k4 k5 k6",
    "origin": "where these values come from: file, calibration, factory, driver or default",
    "depth_sensor": "the depth sensor whose noise model was used, as JSON; its `origin` is `assumed` if the source "
    "did not name one. Without this attribute: PrimeSense",
    "distortion_model": "plumb_bob, rational_polynomial or inverse_brown_conrady (RealSense). Without this "
    "attribute: plumb_bob",
}
VERDICT_ATTRIBUTES = {
    "hand_length_m": "length of the hand, estimated from the palm",
    "tilt_rad": "angle between the normal of the palm and the camera's axis",
    "distance_m": "distance of WRIST from the camera",
    "frames_used": "number of still frames that were averaged",
    "findings": "what the calibration check found to be wrong, as JSON",
    "straight_fingers": "thumb to little finger, 1 if a person marked it as straight in the neutral pose; empty if "
    "nobody was asked",
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
          "clicks on the markers of the first frame, u to the right, v down"),
    Field("/calibration/marker_position", "marker_position_w0_m", "f8", ("M", 3), "m",
          "marker centres in the neutral pose, in W0"),
    Field("/calibration/rotation", "rotation_w0_cam", "f8", (3, 3), "1",
          "rotation of vectors from W0 to the colour camera"),
    Field("/calibration/translation", "translation_w0_cam_m", "f8", (3,), "m",
          "origin of W0 in the colour camera"),
    Field("/calibration/marker_covariance", "marker_covariance_w0_m2", "f8", ("M", 3, 3), "m^2",
          "covariance of each marker centre, in W0", optional=True),
    Field("/calibration/start_angles", "start_angles_rad", "f8", ("A",), "rad",
          "angles of the neutral pose as entered by the therapist, else zero; pronosupination counted from palm down",
          optional=True),
    Field("/calibration/residual", "residual_m", "f8", ("M",), "m",
          "distance of each marker from its place in the fitted hand", optional=True),
    Field("/calibration/surface", "surface", "f8", (TABLE_ROWS, 5), "m",
          "measured surface of the back of the hand, in W0: first row origin x, y, step, rows and columns of a grid; "
          "second row its middle; then each node as row, column, height and two slopes; NaN below the last",
          optional=True),
)

MOTION_FIELDS = (
    Field("/wrist/position", "position_m", "f8", ("N", 3), "m", "position of the wrist: origin of W2 in W0"),
    Field("/wrist/velocity", "velocity_m_s", "f8", ("N", 3), "m/s",
          "velocity of that origin in W0"),
    Field("/wrist/w0_turn", "w0_turn_rad", "f8", ("N", 3), "rad",
          "rotation vector from W0 as refined up to this frame (used for rotation and angles) to W0 of /calibration "
          "(used for all positions); W2 to camera is calibration rotation times this rotation times /wrist/rotation",
          optional=True, since=2),
    Field("/wrist/rotation", "rotation_w2_w0", "f8", ("N", 3, 3), "1",
          "rotation matrix from W2 to W0, not mirrored for a left hand"),
    Field("/wrist/angular_velocity", "angular_velocity_rad_s", "f8", ("N", 3), "rad/s",
          "angular velocity in W2, as estimated by the filter"),
    Field("/wrist/angles", "angles_rad", "f8", ("N", "A"), "rad",
          "clinical angles, + is radial, flexion, supination on both hands; pronosupination is counted from palm down, "
          "so thumb up is +90 degrees"),
    Field("/wrist/angles_sd", "angles_sd_rad", "f8", ("N", "A"), "rad",
          "standard deviation of the clinical angles, error of the calibration included"),
    Field("/wrist/angles_zyz", "angles_zyz_rad", "f8", ("N", "Z"), "rad",
          "ZYZ angles of /wrist/rotation; NaN where beta is below 3 degrees"),
    Field("/joints/angles", "joint_angles_rad", "f8", ("N", "J"), "rad",
          "joint angles, 0 is a straight finger", fingers_only=True),
    Field("/joints/angles_sd", "joint_angles_sd_rad", "f8", ("N", "J"), "rad",
          "standard deviation of the joint angles", fingers_only=True),
    Field("/joints/velocity", "joint_velocity_rad_s", "f8", ("N", "J"), "rad/s",
          "angular velocity of the joints", fingers_only=True),
    Field("/joints/position", "joint_position_m", "f8", ("N", "M", 3), "m",
          "joint centres and fingertips in W0; a coupled DIP joint flexes by two thirds of the PIP joint",
          fingers_only=True),
)
"""Written from a frame's moment and, under ``/smoothed``, from the smoother's."""

FRAME_FIELDS = (
    Field("/frames/timestamp", "timestamp_s", "f8", ("N",), "s",
          "time of the colour image as in the recording, strictly increasing"),
    Field("/frames/status", "status", "u1", ("N",), "1", "0 tracked, 1 predicted, 2 lost, "
          "3 doubtful: measured, but what the camera sees contradicts the estimate", fill=2),
    *MOTION_FIELDS,
    Field("/markers/position_camera", "marker_position_cam_m", "f8", ("N", "M", 3), "m",
          "estimated marker centres in the axes of the colour camera, also of occluded markers"),
    Field("/markers/measured", "marker_measured_px", "f8", ("N", "M", 2), "px",
          "blob that was assigned to the marker; NaN if none"),
    Field("/markers/measured_depth", "marker_measured_depth_m", "f8", ("N", "M"), "m",
          "depth of that blob along the camera's z axis; NaN if none"),
    Field("/markers/doubted", "doubted", "u1", ("N", "M"), "1",
          "1 where what the camera sees contradicts the estimate of the marker", optional=True, fill=0),
    Field("/quality/dropped_frames", "dropped_before", "i4", ("N",), "1",
          "number of frames that are missing before this one", fill=-1),
    Field("/quality/measured_share", "measured_share", "f8", ("N", "Q"), "1",
          "share of direct measurements in the last second, for each angle"),
    Field("/quality/nis", "nis", "f8", ("N",), "1", "normalised innovation squared of the filter"),
    Field("/quality/nis_dof", "nis_dof", "i4", ("N",), "1",
          "degrees of freedom of nis", optional=True, fill=-1),
)

DETECTION_FRAME = Field("/detections/frame", "frame", "i8", ("D",), "1",
                        "row of the frame in /frames, increasing", fill=-1)
DETECTION_FIELDS = (
    Field("/detections/pixel", "pixel", "f8", ("D", 2), "px",
          "centre of the blob, u to the right, v down"),
    Field("/detections/depth", "depth_m", "f8", ("D",), "m",
          "depth of the blob along the camera's z axis; NaN if unknown"),
    Field("/detections/depth_sd", "depth_sd_m", "f8", ("D",), "m", "standard deviation of the depth"),
    Field("/detections/area", "area_px", "f8", ("D",), "px^2", "area of the blob"),
    Field("/detections/similarity", "similarity", "f8", ("D",), "1",
          "similarity to the colour of the markers (Bhattacharyya coefficient)"),
)
DETECTION_COUNT = Field("/detections/count", "count", "i4", ("N",), "1",
                        "number of blobs in this frame", optional=True, fill=-1)

SURFACE_FIELDS = (
    Field("/surface/pixel", "pixel", "u2", ("N", MAX_SURFACE_READINGS, 2), "px",
          "pixels at which the depth of the back of the hand was read, u to the right, v down; 65535 if none",
          optional=True, fill=65535),
    Field("/surface/depth", "depth_m", "f4", ("N", MAX_SURFACE_READINGS), "m",
          "depth at these pixels along the camera's z axis; NaN if none", optional=True),
)
FINGER_FIELDS = (
    Field("/surface/finger_pixel", "pixel", "u2", ("N", MAX_FINGER_READINGS, 2), "px",
          "pixels at which the depth around the fingers was read, u to the right, v down; 65535 if none",
          optional=True, fingers_only=True, fill=65535),
    Field("/surface/finger_depth", "depth_m", "f4", ("N", MAX_FINGER_READINGS), "m",
          "depth at these pixels along the camera's z axis; NaN if none", optional=True, fingers_only=True),
)
"""Depth samples that tracking again needs."""

RAW_STREAMS = (
    Field("/raw/color", "color", "u1", ("C",), "1",
          "colour images as files (JPEG or PNG), one after the other", optional=True, fill=0),
    Field("/raw/depth", "depth", "u1", ("B",), "1",
          "depth images as 16-bit PNG files, one after the other", optional=True, fill=0),
)
RAW_ENDS = (
    Field("/raw/color_end", "color", "i8", ("N",), "1",
          "byte of /raw/color at which the image of this frame ends; it begins at the end of the one before",
          optional=True, fill=-1),
    Field("/raw/depth_end", "depth", "i8", ("N",), "1",
          "byte of /raw/depth at which the image of this frame ends; equal to the one before if there is no image",
          optional=True, fill=-1),
)
RAW_DEPTH_UNIT = "depth_unit_m"
"""Attribute of ``/raw``: metres per count of the depth images."""

EVENT_FIELDS = (
    Field("/events/time", "time_s", "f8", ("E",), "s",
          "time of the event, on the clock of /frames/timestamp"),
    Field("/events/kind", "kind", "text", ("E",), "", "note, pain, pause, camera_lost, ..."),
    Field("/events/text", "text", "text", ("E",), "", "text of the event"),
)
REPETITION_COLUMNS = (
    Column("start", "start_s", "f8", "s", "when the repetition began, on the clock of /frames/timestamp: it left its "
           "first turning point, or passed the middle of a movement to both sides"),
    Column("peak", "peak_s", "f8", "s", "when the angle was at its extreme; the middle of a hold"),
    Column("end", "end_s", "f8", "s", "when it reached its last turning point, or passed that middle again"),
    Column("angle", "angle_rad", "f8", "rad", "angle at the peak, counted as in /wrist/angles"),
    Column("arc", "arc_rad", "f8", "rad", "from the smallest angle to the largest, corrected for what noise adds"),
    Column("arc_sd", "arc_sd_rad", "f8", "rad", "standard deviation of the arc, from the tracker's uncertainty"),
    Column("peak_speed", "peak_speed_rad_s", "f8", "rad/s", "peak speed of the fastest stroke"),
    Column("peak_speed_sd", "peak_speed_sd_rad_s", "f8", "rad/s", "standard deviation of the peak speed, from noise"),
    Column("movement_time", "movement_time_s", "f8", "s", "time of its strokes, each from 5 % to 5 % of its peak "
           "speed; pauses count, holds at the turning points do not; NaN if one stroke has none"),
    Column("sparc", "sparc", "f8", "1", "smoothness (spectral arc length), mean of its strokes with their pauses; "
           "NaN for half a repetition from rest"),
    Column("movement_units", "movement_units", "f8", "1", "number of speed peaks in all its strokes"),
    Column("pauses", "pauses", "f8", "1", "number of pauses within strokes"),
    Column("pause_time", "pause_s", "f8", "s", "total duration of these pauses"),
    Column("at_least", "at_least", "u1", "1", "1 if the arc is a lower bound, because the angle may have gone further "
           "while it was occluded; else 0"),
    Column("counted", "counted", "u1", "1", "1 if the repetition is included, else 0"),
    Column("reason", "reason", "S64", "", "why it is excluded: hidden (not visible well enough), or cut_by_start, "
           "cut_by_gap, cut_by_end (the recording began or ended within it, or the hand was lost); empty if included"),
)
REPETITIONS = Field("/repetitions", "repetitions", "rows", ("P",), "of each column",
                    "repetitions of the trained angle, as counted when the session was finished", optional=True)
REPETITION_ANGLE = "angle"
"""Attribute of ``/repetitions``: name of the exercised angle, empty if there is none."""
REPETITION_DTYPE = np.dtype([(column.name, column.dtype) for column in REPETITION_COLUMNS])
# fmt: on

SMOOTHED_FIELDS = tuple(
    replace(field, path=f"/smoothed{field.path}", description=f"{field.description}; by the smoother", optional=True)
    for field in MOTION_FIELDS
)

_DETECTIONS = (DETECTION_FRAME, *DETECTION_FIELDS, DETECTION_COUNT)
ROW_FIELDS = (*FRAME_FIELDS, *_DETECTIONS, *SURFACE_FIELDS, *FINGER_FIELDS, *EVENT_FIELDS)
"""Datasets of a new file that grow with its frames and events."""
ALL_FIELDS = (*CALIBRATION_FIELDS, *ROW_FIELDS, REPETITIONS, *SMOOTHED_FIELDS, *RAW_STREAMS, *RAW_ENDS)

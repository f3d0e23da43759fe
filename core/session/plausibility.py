"""Checks for values of a session that no hand and no clock can have, made when it is read."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from carpus.core.calibration.result import Calibration
from carpus.core.model.errors import SessionUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Detections, FloatArray
from carpus.core.session.values import Session, SessionHeader

MAX_DURATION_S = 86_400.0
MAX_TIME_S = 1e11
"""Times of a recording count from anywhere, but no clock counts for 3000 years."""
MAX_ANGLE_RAD = 2.0 * math.pi
MAX_POSITION_M = 100.0
MAX_SD_RAD = 1e3
MAX_PIXEL = float(1 << 16)
ROTATION_TOLERANCE = 1e-3
MAX_COVARIANCE_M2, COVARIANCE_TOLERANCE_M2 = 1.0, 1e-9
MAX_TEXT_CHARACTERS, MAX_PARAMETERS_CHARACTERS = 200, 1 << 20
MAX_PARAMETERS_DEPTH = 40
STATUS_COUNT = 4


def check_header(path: Path, header: SessionHeader, parameters: object) -> None:
    """Raise :class:`SessionUnreadable` for texts that cannot be a pseudonym, an exercise or settings."""
    for name in (
        "session_id",
        "recording_id",
        "subject_id",
        "recorded",
        "created",
        "exercise",
        "software_version",
        "origin",
    ):
        text: str = getattr(header, name)
        if len(text) > MAX_TEXT_CHARACTERS or not (text.isprintable() or name == "origin"):
            raise SessionUnreadable(path, phrase("damaged: invalid {name}", name=name))
    if not header.session_id.strip():
        raise SessionUnreadable(path, phrase("damaged: no session_id"))
    if _nesting_depth(parameters) > MAX_PARAMETERS_DEPTH or len(header.parameters) > MAX_PARAMETERS_CHARACTERS:
        raise SessionUnreadable(path, phrase("damaged: invalid settings"))


def check_times(path: Path, timestamp_s: FloatArray) -> None:
    """Raise :class:`SessionUnreadable` unless the times are finite, rise, and span at most a day."""
    if not len(timestamp_s):
        return
    if not np.isfinite(timestamp_s).all() or np.abs(timestamp_s).max() > MAX_TIME_S:
        raise SessionUnreadable(path, phrase("damaged: impossible frame time"))
    wrong = np.flatnonzero(np.diff(timestamp_s) <= 0.0)
    if len(wrong):
        raise SessionUnreadable(
            path, phrase("damaged: frame {number} is not later than the previous one", number=int(wrong[0]) + 1)
        )
    if timestamp_s[-1] - timestamp_s[0] > MAX_DURATION_S:
        raise SessionUnreadable(path, phrase("times span more than a day: damaged, or a clock jumped"))


def check_values(path: Path, session: Session) -> None:
    """Raise :class:`SessionUnreadable` for impossible numbers; NaN stands for unknown everywhere."""
    check_times(path, session.timestamp_s)
    if len(session.status) and int(session.status.max()) >= STATUS_COUNT:
        raise SessionUnreadable(path, phrase("damaged: unknown frame status"))
    limits: list[tuple[str, FloatArray, float]] = [
        ("a marker's position", session.markers.position_cam_m, MAX_POSITION_M),
        ("a calibrated position", session.calibration.marker_position_w0_m, MAX_POSITION_M),
        ("the camera's place", session.calibration.translation_w0_cam_m, MAX_POSITION_M),
    ]
    for motion in (session.motion, session.smoothed):
        if motion is not None:
            limits += [
                ("a wrist angle", motion.angles_rad, MAX_ANGLE_RAD),
                ("a joint angle", motion.joint_angles_rad, MAX_ANGLE_RAD),
                ("a standard deviation", motion.angles_sd_rad, MAX_SD_RAD),
                ("a standard deviation", motion.joint_angles_sd_rad, MAX_SD_RAD),
                ("a position", motion.position_m, MAX_POSITION_M),
                ("a joint's position", motion.joint_position_m, MAX_POSITION_M),
            ]
    for what, values, limit in limits:
        # NaN compares as neither, so unknown values pass.
        if len(values) and bool((np.abs(values) > limit).any()):
            raise SessionUnreadable(path, phrase("damaged: {what} out of range", what=what))
    for motion in (session.motion, session.smoothed):
        if motion is not None and any(
            bool((values < 0.0).any()) for values in (motion.angles_sd_rad, motion.joint_angles_sd_rad)
        ):
            raise SessionUnreadable(path, phrase("damaged: negative standard deviation"))
    camera = session.camera
    if not all(map(math.isfinite, (camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px, *camera.distortion))):
        raise SessionUnreadable(path, phrase("damaged: unknown camera values"))
    if min(camera.fx_px, camera.fy_px) <= 0.0 or not 1 <= min(camera.width_px, camera.height_px) <= 1 << 16:
        raise SessionUnreadable(path, phrase("damaged: impossible camera values"))
    if not all(math.isfinite(event.time_s) for event in session.events):
        raise SessionUnreadable(path, phrase("damaged: an event has no time"))


def check_calibration(path: Path, calibration: Calibration) -> None:
    """Raise :class:`SessionUnreadable` for a calibration from which no hand can be tracked."""
    turn, spread = calibration.rotation_w0_cam, calibration.marker_covariance_w0_m2
    known = (turn, calibration.translation_w0_cam_m, calibration.marker_position_w0_m, calibration.start_angles_rad)
    good = all(np.isfinite(values).all() for values in known)
    good = good and bool(np.abs(turn @ turn.T - np.eye(3)).max() < ROTATION_TOLERANCE and np.linalg.det(turn) > 0.0)
    good = good and bool((np.abs(calibration.start_angles_rad) <= MAX_ANGLE_RAD).all())
    if good and len(spread) and not np.isnan(spread).all():
        good = bool(np.isfinite(spread).all() and np.abs(spread).max() <= MAX_COVARIANCE_M2)
        good = good and float(np.linalg.eigvalsh(spread).min()) >= -COVARIANCE_TOLERANCE_M2
    if not good:
        raise SessionUnreadable(path, phrase("damaged: its calibration does not describe a hand"))


def check_detections(path: Path, detections: Detections) -> None:
    """Raise :class:`SessionUnreadable` for impossible blobs; a depth may be unknown."""
    good = bool((np.abs(detections.pixel) <= MAX_PIXEL).all())  # NaN is not
    good = good and bool(np.isfinite(detections.area_px).all() and np.isfinite(detections.similarity).all())
    for values, most in ((detections.depth_m, MAX_POSITION_M), (detections.depth_sd_m, MAX_POSITION_M)):
        good = good and not bool(((values < 0.0) | (values > most)).any())
    if not good:
        raise SessionUnreadable(path, phrase("damaged: a blue spot belongs to no frame"))


def _nesting_depth(value: object) -> int:
    """Return how deeply dicts and lists are nested; counted without recursion."""
    deepest, level = 0, [value]
    while level:
        deepest += 1
        inside: list[object] = []
        for one in level:
            if isinstance(one, dict):
                inside += one.values()
            elif isinstance(one, list):
                inside += one
        level = inside
        if deepest > 2 * MAX_PARAMETERS_DEPTH:
            break
    return deepest

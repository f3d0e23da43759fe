"""Checks for values of a session that no hand and no clock can have, made when it is read."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carpus.core.calibration.result import Calibration
from carpus.core.model.errors import SessionUnreadable
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Detections
from carpus.core.session.values import Session, SessionHeader


class ContentError(Exception):
    """Raised with a text for content of a session file that cannot be; its reader names the file."""


def damage_error(place: str) -> ContentError:
    """Return the error for a part of a session file, by its path or name."""
    return ContentError(phrase("damaged: {value}", value=place))


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
_OWN_TEXTS = ("session_id", "recording_id", "subject_id", "recorded", "created")


def check_header(header: SessionHeader, parameters: object) -> None:
    """Raise :class:`ContentError` for texts that cannot be a pseudonym, an exercise or settings."""
    for name in (*_OWN_TEXTS, "exercise", "software_version", "origin"):
        text: str = getattr(header, name)
        is_missing = name == "session_id" and not text.strip()
        if is_missing or len(text) > MAX_TEXT_CHARACTERS or not (text.isprintable() or name == "origin"):
            raise damage_error(name)
    # how deeply dicts and lists are nested; counted without recursion
    deepest, level = 0, [parameters]
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
    if deepest > MAX_PARAMETERS_DEPTH or len(header.parameters) > MAX_PARAMETERS_CHARACTERS:
        raise damage_error("parameters")


def check_values(session: Session) -> None:
    """Raise :class:`ContentError` for impossible numbers; NaN stands for unknown, and compares as neither."""
    times_s = session.timestamp_s
    if not np.isfinite(times_s).all() or (np.abs(times_s) > MAX_TIME_S).any() or (np.diff(times_s) <= 0.0).any():
        raise damage_error("/frames/timestamp")
    if len(times_s) and times_s[-1] - times_s[0] > MAX_DURATION_S:
        raise ContentError(phrase("times span more than a day: damaged, or a clock jumped"))
    limits: list[tuple[str, NDArray[Any], float, float]] = [
        ("/frames/status", session.status, 0, STATUS_COUNT - 1),
        ("/markers/position_camera", session.markers.position_cam_m, -MAX_POSITION_M, MAX_POSITION_M),
        ("/calibration/marker_position", session.calibration.marker_position_w0_m, -MAX_POSITION_M, MAX_POSITION_M),
        ("/calibration/translation", session.calibration.translation_w0_cam_m, -MAX_POSITION_M, MAX_POSITION_M),
    ]
    for group, motion in (("", session.motion), ("/smoothed", session.smoothed)):
        if motion is not None:
            limits += [
                (f"{group}/wrist/angles", motion.angles_rad, -MAX_ANGLE_RAD, MAX_ANGLE_RAD),
                (f"{group}/joints/angles", motion.joint_angles_rad, -MAX_ANGLE_RAD, MAX_ANGLE_RAD),
                (f"{group}/wrist/angles_sd", motion.angles_sd_rad, 0.0, MAX_SD_RAD),
                (f"{group}/joints/angles_sd", motion.joint_angles_sd_rad, 0.0, MAX_SD_RAD),
                (f"{group}/wrist/position", motion.position_m, -MAX_POSITION_M, MAX_POSITION_M),
                (f"{group}/joints/position", motion.joint_position_m, -MAX_POSITION_M, MAX_POSITION_M),
            ]
    for path, values, low, high in limits:
        if ((values < low) | (values > high)).any():
            raise damage_error(path)
    camera = session.camera
    numbers = (camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px, *camera.distortion)
    is_camera = all(map(math.isfinite, numbers)) and min(camera.fx_px, camera.fy_px) > 0.0
    if not is_camera or not 1 <= min(camera.width_px, camera.height_px) <= 1 << 16:
        raise damage_error("/camera")
    if not all(math.isfinite(event.time_s) for event in session.events):
        raise damage_error("/events/time")


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
        raise SessionUnreadable(path, phrase("damaged: the calibration in it does not describe a hand"))


def check_detections(detections: Detections) -> None:
    """Raise :class:`ContentError` for impossible blobs; a depth may be unknown."""
    good = bool((np.abs(detections.pixel) <= MAX_PIXEL).all())  # NaN is not
    good = good and bool(np.isfinite(detections.area_px).all() and np.isfinite(detections.similarity).all())
    for values in (detections.depth_m, detections.depth_sd_m):
        good = good and not bool(((values < 0.0) | (values > MAX_POSITION_M)).any())
    if not good:
        raise damage_error("/detections")

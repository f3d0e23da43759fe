"""Card checks of a camera, one line each in a file that only grows, and the camera's status."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import numpy as np

from carpus.core.calibration.card.card import (
    DIMENSIONS,
    MAX_ANGLE_ERROR_DEG,
    MAX_LENGTH_ERROR_MM,
    CardReading,
    verdict_sentence,
)
from carpus.core.capture.calibrated_source import SUFFIX as CALIBRATION_SUFFIX
from carpus.core.capture.calibrated_source import age_days, load_stored_calibration
from carpus.core.capture.camera_info import read_camera_info
from carpus.core.model.dates import is_moment
from carpus.core.model.errors import CarpusFault
from carpus.core.model.installation import Finding, State
from carpus.core.model.names import CAMERAS_FOLDER, file_stem
from carpus.core.platform.durable import make_private_folder, open_private, write_fault

CHECKS_SUFFIX = ".checks.jsonl"
MAX_CHECK_AGE_DAYS = 7.0
"""A check is due weekly."""
MAX_CALIBRATION_AGE_DAYS = 365.0


@dataclass(frozen=True, slots=True)
class CardCheck:
    """Reading with the camera's serial number, its time, and the time of the calibration used (ISO 8601)."""

    checked_at: str
    serial: str
    reading: CardReading
    calibrated_at: str = ""


@dataclass(frozen=True, slots=True)
class CheckStatus:
    """Age of a camera's calibration and check in days, NaN for never, with its last check."""

    serial: str
    calibration_age_days: float = math.nan
    check_age_days: float = math.nan
    last_check: CardCheck | None = None
    is_recalibrated: bool = False

    @property
    def is_out_of_tolerance(self) -> bool:
        """True if the last check was out of tolerance and the camera was not calibrated since."""
        check = self.last_check
        return check is not None and not check.reading.is_within_tolerance and not self.is_recalibrated

    @property
    def is_due(self) -> bool:
        """True if the camera should be checked again."""
        return self.is_recalibrated or not self.check_age_days <= MAX_CHECK_AGE_DAYS


def checks_path(data_folder: Path, serial: str) -> Path:
    """Return the file of a camera's checks."""
    return data_folder / CAMERAS_FOLDER / f"{file_stem(serial)}{CHECKS_SUFFIX}"


def read_checks(path: Path) -> list[CardCheck]:
    """Read all checks in order of time; damaged lines are skipped."""
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return []
    found = [check for line in lines if (check := _parse_check(line)) is not None]
    return sorted(found, key=lambda check: datetime.fromisoformat(check.checked_at))


def add_check(path: Path, check: CardCheck) -> None:
    """Append one check durably. Raises :class:`OutputNotWritable`."""
    reading = check.reading
    content = {
        "when": check.checked_at, "serial": check.serial, "angle_error_deg": reading.angle_error_deg,
        "length_error_mm": reading.length_error_mm, "scale": reading.scale, "measured": reading.measured.tolist(),
        "sd": reading.sd.tolist(), "calibrated": check.calibrated_at, "most_angle_deg": reading.max_angle_error_deg,
        "most_length_mm": reading.max_length_error_mm,
    }  # fmt: skip
    make_private_folder(path.parent)
    try:
        with open(path, "ab", opener=open_private) as file:
            is_torn = file.tell() > 0 and path.read_bytes()[-1:] != b"\n"
            file.write(("\n" if is_torn else "").encode() + json.dumps(content).encode() + b"\n")
            file.flush()
            os.fsync(file.fileno())
    except OSError as cause:
        raise write_fault(path, cause) from cause


def check_status(data_folder: Path, serial: str, now: datetime) -> CheckStatus:
    """Return the status of a camera, empty for one without a serial number."""
    if not serial:
        return CheckStatus("")
    info = load_stored_calibration(data_folder, serial)
    calibrated = info.calibration.calibrated if info is not None and info.calibration is not None else ""
    checks = [one for one in read_checks(checks_path(data_folder, serial)) if one.serial == serial]
    if not checks:
        return CheckStatus(serial, age_days(calibrated, now))
    last = checks[-1]
    later = is_moment(calibrated) and datetime.fromisoformat(calibrated) > datetime.fromisoformat(last.checked_at)
    return CheckStatus(serial, age_days(calibrated, now), age_days(last.checked_at, now), last, later)


def find_camera_serials(data_folder: Path) -> set[str]:
    """Return the serial numbers of cameras with a calibration or a check."""
    folder = data_folder / CAMERAS_FOLDER
    found = {check.serial for path in folder.glob(f"*{CHECKS_SUFFIX}") for check in read_checks(path)}
    for path in folder.glob(f"*{CALIBRATION_SUFFIX}"):
        try:
            stored = read_camera_info(path).calibration
        except CarpusFault:
            continue
        if stored is not None:
            found.add(stored.serial)
    return {serial for serial in found if serial and file_stem(serial)}


def examine_cameras(data_folder: Path, now: datetime) -> Iterator[Finding]:
    """Yield one finding for each camera with stored data, or one that there is none."""
    serials = sorted(find_camera_serials(data_folder))
    for serial in serials:
        status = check_status(data_folder, serial, now)
        text, remedies = "never calibrated", ["Run: carpus calibrate-camera."]
        if math.isfinite(status.calibration_age_days):
            text = f"calibrated {_days_ago_text(status.calibration_age_days)}"
            remedies = ["Run: carpus calibrate-camera: the calibration is older than a year."]
            remedies = remedies if status.calibration_age_days > MAX_CALIBRATION_AGE_DAYS else []
        if status.last_check is None:
            text += ", never checked"
            remedies.append("Run: carpus check-card.")
        else:
            text += f", checked {_days_ago_text(status.check_age_days)}: {verdict_sentence(status.last_check.reading)}"
            if status.is_out_of_tolerance:
                remedies.append("It measured wrong at the last check: check once more, then calibrate it again.")
            elif status.is_due:
                is_old = f"the check is older than {MAX_CHECK_AGE_DAYS:g} days"
                reason = "it has been calibrated since" if status.is_recalibrated else is_old
                remedies.append(f"Run: carpus check-card: {reason}.")
        state: State = "bad" if status.is_out_of_tolerance else "warning" if remedies else "good"
        yield Finding(f"Camera {status.serial}", state, text, " ".join(remedies))
    if not serials:
        remedy = "Run: carpus calibrate-camera --board board.pdf, then hold the printed board before the camera."
        yield Finding("Calibration", "warning", "no camera has been calibrated or checked", remedy)


def _days_ago_text(days: float) -> str:
    """Return days in words.

    >>> _days_ago_text(0.2), _days_ago_text(1.3), _days_ago_text(12.9)
    ('today', 'yesterday', '12 days ago')
    """
    whole = int(days)
    return "today" if whole <= 0 else "yesterday" if whole == 1 else f"{whole} days ago"


def _parse_check(line: str) -> CardCheck | None:
    try:
        content = json.loads(line)
        measured, sd = (np.array(content[name], dtype=float) for name in ("measured", "sd"))
        when, serial, calibrated = (str(content[name]) for name in ("when", "serial", "calibrated"))
        most = (content.get("most_angle_deg", MAX_ANGLE_ERROR_DEG), content.get("most_length_mm", MAX_LENGTH_ERROR_MM))
        scale, most_angle_deg, most_length_mm = map(float, (content["scale"], *most))
    except (ValueError, KeyError, TypeError, OverflowError, RecursionError):
        return None
    numbers = (*measured.flat, scale, most_angle_deg, most_length_mm)
    if not is_moment(when) or measured.shape != (len(DIMENSIONS),) or not all(map(math.isfinite, numbers)):
        return None
    reading = CardReading(measured, sd, scale, math.nan, 0, most_angle_deg, most_length_mm)
    return CardCheck(when, serial, reading, calibrated)

"""How far a camera is to be trusted today: the age of its calibration and check, what the check said; for the doctor
too."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from carpus.core.calibration.card.chart import OLD_DAYS, SUFFIX, CardCheck, Verdict, chart_path, read_checks, verdict_of
from carpus.core.capture.calibrated import SUFFIX as CALIBRATION_SUFFIX
from carpus.core.capture.calibrated import age_days, stored_calibration
from carpus.core.capture.camera_info import read_camera_info
from carpus.core.dates import is_moment
from carpus.core.errors import CarpusFault
from carpus.core.installing import Finding, State
from carpus.core.names import CAMERAS, file_stem


@dataclass(frozen=True, slots=True)
class Standing:
    """Days since a camera was calibrated and checked, NaN for never; ``verdict`` of the newest ``check``, None without
    one. ``recalibrated``: it was calibrated after that check."""

    serial: str
    calibrated_days: float = math.nan
    checked_days: float = math.nan
    check: CardCheck | None = None
    verdict: Verdict | None = None
    recalibrated: bool = False

    @property
    def is_old(self) -> bool:
        """Whether the check is older than it should be."""
        return self.checked_days > OLD_DAYS

    @property
    def is_out(self) -> bool:
        """Whether the camera measured wrong, and nothing was done about it since."""
        return self.verdict == "out" and not self.recalibrated

    @property
    def is_unusual(self) -> bool:
        """Whether it measured otherwise than usual, and nothing was done about it since."""
        return self.verdict == "unusual" and not self.recalibrated


def standing_of(data_folder: Path, serial: str, now: datetime) -> Standing:
    """What the data folder knows of a camera; nothing of one without a number."""
    if not serial:
        return Standing("")
    info = stored_calibration(data_folder, serial)
    calibrated = info.calibration.calibrated if info is not None and info.calibration is not None else ""
    checks = [one for one in read_checks(chart_path(data_folder, serial)) if one.serial == serial]
    if not checks:
        return Standing(serial, age_days(calibrated, now))
    last = checks[-1]
    later = is_moment(calibrated) and datetime.fromisoformat(calibrated) > datetime.fromisoformat(last.when)
    return Standing(
        serial, age_days(calibrated, now), age_days(last.when, now), last, verdict_of(checks[:-1], last), later
    )


OLD_CALIBRATION_DAYS = 365.0
_CALIBRATE = "Run: carpus calibrate-camera"
_CHECK = "Run: carpus check-card"


def camera_ages(data_folder: Path, now: datetime) -> Iterator[Finding]:
    """One finding for each camera of which anything is kept; one that says so where nothing is."""
    serials = sorted(known_serials(data_folder))
    for serial in serials:
        yield _camera(data_folder, serial, now)
    if not serials:
        remedy = f"{_CALIBRATE} --board board.pdf, then hold the printed board before the camera."
        yield Finding("Calibration", "warning", "no camera has been calibrated or checked", remedy)


def known_serials(data_folder: Path) -> set[str]:
    """Serial numbers of cameras with a calibration or a check."""
    folder = data_folder / CAMERAS
    found = {check.serial for path in folder.glob(f"*{SUFFIX}") for check in read_checks(path)}
    for path in folder.glob(f"*{CALIBRATION_SUFFIX}"):
        try:
            made = read_camera_info(path).calibration
        except CarpusFault:
            continue
        if made is not None:
            found.add(made.serial)
    return {serial for serial in found if serial and file_stem(serial)}


def _camera(data_folder: Path, serial: str, now: datetime) -> Finding:
    info = stored_calibration(data_folder, serial)
    checks = read_checks(chart_path(data_folder, serial))
    said, remedies = [], []
    state: State = "good"
    if info is None or info.calibration is None:
        said.append("never calibrated")
        remedies.append(f"{_CALIBRATE}.")
    else:
        age = age_days(info.calibration.calibrated, now)
        said.append(f"calibrated {_ago(age)}")
        if not age <= OLD_CALIBRATION_DAYS:
            remedies.append(f"{_CALIBRATE}: the calibration is older than a year.")
    if not checks:
        said.append("never checked")
        remedies.append(f"{_CHECK}.")
    else:
        age = age_days(checks[-1].when, now)
        said.append(f"checked {_ago(age)}, {_result(checks)}")
        if standing_of(data_folder, serial, now).recalibrated:
            remedies.append(f"{_CHECK}: it was calibrated since.")
        elif verdict_of(checks[:-1], checks[-1]) == "out":
            state = "bad"
            remedies.append("It measured wrong at the last check: check once more, then calibrate it again.")
        elif not age <= OLD_DAYS:
            remedies.append(f"{_CHECK}: the check is older than {OLD_DAYS:g} days.")
    if state == "good" and remedies:
        state = "warning"
    return Finding(f"Camera {serial}", state, ", ".join(said), " ".join(remedies))


def _result(checks: list[CardCheck]) -> str:
    last = checks[-1]
    return f"{verdict_of(checks[:-1], last)} ({last.angle_error_deg:.1f}°, {last.length_error_mm:.1f} mm off at most)"


def _ago(days: float) -> str:
    """Days in words.

    >>> _ago(0.2), _ago(1.3), _ago(12.9)
    ('today', 'yesterday', '12 days ago')
    """
    whole = int(days)
    return "today" if whole <= 0 else "yesterday" if whole == 1 else f"{whole} days ago"

"""How far a camera is to be trusted today: the age of its calibration and check, and what the check said."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from carpus.core.calibration.card.chart import OLD_DAYS, CardCheck, Verdict, chart_path, read_checks, verdict_of
from carpus.core.capture.calibrated import age_days, stored_calibration
from carpus.core.dates import is_moment


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

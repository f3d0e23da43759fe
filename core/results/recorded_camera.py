"""Camera that a session was measured with."""

from __future__ import annotations

import math
from dataclasses import dataclass

from carpus.core.model.dates import is_moment
from carpus.core.platform.provenance import parameter_section


@dataclass(frozen=True, slots=True)
class RecordedCamera:
    """Camera of a session.

    ``serial`` is empty if unknown. ``calibrated_at`` (ISO 8601) is when it was calibrated with a board, empty if it was
    not; ``age_days`` is the age of that calibration at the recording, else NaN.
    """

    serial: str = ""
    calibrated_at: str = ""
    age_days: float = math.nan


UNKNOWN_CAMERA = RecordedCamera()


def parse_camera(parameters: str) -> RecordedCamera:
    """Parse the camera from the parameters of a session.

    >>> parameters = '{"source": {"serial": "77", "calibrated": "2026-11-20T09:00+00:00", "calibration_age_days": "5"}}'
    >>> parse_camera(parameters) == RecordedCamera("77", "2026-11-20T09:00+00:00", 5.0)
    True
    """
    source = parameter_section(parameters, "source")
    calibrated = str(source.get("calibrated") or "")
    try:
        age_days = float(str(source.get("calibration_age_days")))
    except ValueError:
        age_days = math.nan
    serial = str(source.get("serial") or "")
    return RecordedCamera(serial, calibrated, age_days) if is_moment(calibrated) else RecordedCamera(serial)

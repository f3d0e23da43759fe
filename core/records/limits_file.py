"""File of the clinic's own error limits in the data folder."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import asdict
from datetime import date
from pathlib import Path
from typing import Any

from carpus.core.formats.output_files import write_new_json
from carpus.core.measures.change_limits import ErrorLimits, MeasuredLimit, RetestStudy
from carpus.core.model.errors import SettingsInvalid
from carpus.core.model.phrase import phrase

LIMITS_FILE, FORMAT, FORMAT_VERSION = "error_limits.json", "carpus-error-limits", 1


def read_limits(data_folder: Path) -> ErrorLimits:
    """Return the clinic's own limits, none without a file. Raises :class:`SettingsInvalid`."""
    path = data_folder / LIMITS_FILE
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return ErrorLimits()
    except (OSError, ValueError, RecursionError) as cause:
        raise SettingsInvalid(path, phrase("not readable as JSON, so the default limits apply")) from cause
    try:
        if content["format"] != FORMAT or content["format_version"] != FORMAT_VERSION:
            raise ValueError("another format")
        return ErrorLimits(tuple(_parse_study(one) for one in content["studies"]))
    except (KeyError, TypeError, ValueError, AttributeError) as cause:
        raise SettingsInvalid(path, phrase("no limits, so the default limits apply")) from cause


def _parse_study(content: dict[str, Any]) -> RetestStudy:
    date.fromisoformat(content["made"])
    limits = tuple(
        MeasuredLimit(
            str(one["of"]),
            str(one["movement"]),
            int(one["people"]),
            _parse_error_deg(one["sem_deg"]),
            _parse_interval(one["sem_interval_deg"]),
            _parse_error_deg(one["mdc95_deg"]),
            _parse_interval(one["mdc95_interval_deg"]),
        )
        for one in content["limits"]
    )
    return RetestStudy(
        str(content["protocol"]),
        str(content["exercise"]),
        str(content["angle_order"]),
        str(content["made"]),
        int(content["people"]),
        int(content["sessions"]),
        int(content["raters"]),
        limits,
    )


def _parse_error_deg(value: Any) -> float:
    number = float(value)
    if not 0.0 <= number < 360.0:
        raise ValueError(f"{number} is no error in degrees")
    return number


def _parse_interval(value: Any) -> tuple[float, float]:
    low, high = value
    return tuple(math.nan if one is None else float(one) for one in (low, high))  # type: ignore[return-value]


def save_limits(data_folder: Path, studies: Sequence[RetestStudy]) -> Path:
    """Save studies, each in place of an earlier one of its kind; return the file.

    Raises :class:`SettingsInvalid` if the present file is damaged, and the faults of writing.
    """
    path = data_folder / LIMITS_FILE
    kinds = {(one.protocol, one.exercise, one.angle_order) for one in studies}
    kept = (
        one for one in read_limits(data_folder).studies if (one.protocol, one.exercise, one.angle_order) not in kinds
    )
    content = {
        "format": FORMAT,
        "format_version": FORMAT_VERSION,
        "studies": [asdict(one) for one in (*kept, *studies)],
    }
    return write_new_json(path, content, overwrite=True)

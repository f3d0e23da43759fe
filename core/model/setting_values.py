"""Conversion of values in TOML or JSON to the type of a settings field."""

from __future__ import annotations

import types
import typing
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, Literal

from carpus.core.model.errors import SettingsInvalid
from carpus.core.model.phrase import phrase

MAX_NUMBER = 1e15
FORMER_NAMES: Mapping[str, str] = {
    "live.tracking_waiting": "max_waiting_frames",
    "live.rows_waiting": "max_waiting_rows",
    "live.pictures_waiting": "max_waiting_images",
    "detection.skin_share": "min_skin_share",
    "detection.least_area": "min_area_ratio",
    "detection.most_area": "max_area_ratio",
    "detection.most_blobs": "max_blobs",
    "calibration.least_distance_m": "min_distance_m",
    "calibration.most_tilt_deg": "max_tilt_deg",
    "calibration.most_residual_mm": "max_residual_mm",
    "tracker.shape_hidden": "shape_bias_share",
    "tracker.association.least_company": "min_markers_at_depth",
    "tracker.association.apart_m": "max_depth_error_m",
    "tracker.association.beam": "beam_width",
    "tracker.association.consistent": "consistency_probability",
    "tracker.noise.depth_ratio": "depth_noise_ratio",
    "tracker.noise.depth_stays_m": "depth_bias_sd_m",
    "tracker.noise.most_adapted": "max_variance_factor",
    "tracker.noise.least_adapted": "min_variance_factor",
    "tracker.fingers.anatomy.depth_stays_m": "depth_bias_sd_m",
    "tracker.surface.steps": "iterations",
    "tracker.surface.most_m": "max_residual_m",
    "tracker.surface.least": "min_readings",
    "tracker.surface.shared": "shared_variance_share",
    "tracker.surface.reading_per_m": "min_reading_sd_per_m",
    "tracker.surface.up_sd_m": "height_sd_m",
    "tracker.surface.most_nis": "max_nis",
    "tracker.surface.stays": "persistent_share",
    "tracker.surface.goes_on": "persistence_factor",
}
"""Present names of settings of version 0.2.0, by section and former name.

Those of the tracker stand in sessions alone; a settings file cannot set them.
"""
NOT_IN_FILE: Mapping[str, bool] = {"in_file": False}
"""Metadata of a field that no settings file sets."""


def settable_names(kind: type) -> set[str]:
    """Return the fields of a settings class that a file may set."""
    return {item.name for item in fields(kind) if item.metadata.get("in_file", True)}


def expand_home(text: str) -> Path:
    """Expand ``~`` in a path; unchanged if there is no such user."""
    try:
        return Path(text).expanduser()
    except RuntimeError:
        return Path(text)


def convert_value(hint: Any, value: Any, name: str, file: str = "") -> Any:
    """Convert ``value`` to the type of a field. Raises :class:`SettingsInvalid`."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is Literal and value in arguments:
        return value
    if origin is tuple and isinstance(value, list):
        kinds = arguments[:1] * len(value) if arguments[-1] is Ellipsis else arguments
        if len(kinds) == len(value):
            return tuple(convert_value(one, item, name, file) for one, item in zip(kinds, value, strict=True))
    if origin in (typing.Union, types.UnionType):
        wanted = next(one for one in arguments if one is not type(None))
        return convert_value(wanted, value, name, file)
    if isinstance(value, str) and "\0" in value:
        raise SettingsInvalid(name, phrase("a text with an invalid character, in {file}", file=file))
    if hint is Path and isinstance(value, str):
        return expand_home(value)
    if hint is float and isinstance(value, (int, float)) and not isinstance(value, bool):
        if not abs(value) < MAX_NUMBER:
            raise SettingsInvalid(
                name, phrase("{value} is not a possible number, in {file}", value=str(value)[:20], file=file)
            )
        return float(value)
    if isinstance(hint, type) and type(value) is hint:
        return value
    found = {"value": f"{value!r}", "file": file}
    reasons = {
        float: phrase("{value} is not a number, in {file}", **found),
        int: phrase("{value} is not a whole number, in {file}", **found),
        bool: phrase("{value} is not true or false, in {file}", **found),
        str: phrase("{value} is not a text, in {file}", **found),
    }
    reason = phrase("{value} is not valid, in {file}", **found)
    if origin is Literal:
        reason = phrase("{value} is none of {choices}, in {file}", choices=", ".join(map(str, arguments)), **found)
    raise SettingsInvalid(name, reasons.get(hint, reason))

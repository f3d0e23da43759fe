"""Settings stored in a session, and how others differ from them."""

from __future__ import annotations

import json
import typing
from collections.abc import Iterator, Mapping
from dataclasses import asdict, is_dataclass
from typing import Any, NamedTuple, TypeVar

from carpus.core.model.errors import SettingsInvalid
from carpus.core.model.setting_values import FORMER_NAMES, convert_value
from carpus.core.pipeline.track import TrackSettings

T = TypeVar("T")


class StoredSettings(NamedTuple):
    """Settings of a session, and the names of those that this Carpus does not have."""

    settings: TrackSettings
    unknown: tuple[str, ...]


def settings_from_json(parameters: str, kind: type[TrackSettings] = TrackSettings) -> StoredSettings | None:
    """Parse the settings in a session's parameters; None if there are none.

    A setting newer than the session keeps its default; a setting that no longer exists is named in ``unknown``.
    """
    try:
        stored = json.loads(parameters)["settings"]
    except (KeyError, TypeError, ValueError):
        return None
    if not isinstance(stored, Mapping):
        return None
    unknown: list[str] = []
    return StoredSettings(_parse_settings(kind, stored, "", unknown), tuple(unknown))


def list_differences(before: TrackSettings, after: TrackSettings) -> list[str]:
    """Return the differing settings as text: name, new value and old value."""
    return list(_iter_differences(asdict(before), asdict(after)))


def _parse_settings(kind: type[T], stored: Mapping[str, Any], prefix: str, unknown: list[str]) -> T:
    hints = typing.get_type_hints(kind)
    found: dict[str, Any] = {}
    for stored_name, value in stored.items():
        place = f"{prefix}{stored_name}"
        name = FORMER_NAMES.get(place, stored_name)
        hint = hints.get(name)
        if hint is None:
            unknown += [place] if value is not None else []
        elif isinstance(hint, type) and is_dataclass(hint) and isinstance(value, Mapping):
            found[name] = _parse_settings(hint, value, f"{place}.", unknown)
        else:
            try:
                found[name] = convert_value(hint, value, place)
            except SettingsInvalid:
                unknown.append(place)
    return kind(**found)


def _iter_differences(before: dict[str, Any], after: dict[str, Any], prefix: str = "") -> Iterator[str]:
    for name in before | after:
        old, new = before.get(name), after.get(name)
        if isinstance(new, dict) and isinstance(old, dict):
            yield from _iter_differences(old, new, f"{prefix}{name}.")
        elif new != old:
            yield f"{prefix}{name} {_format_value(new)} (was {_format_value(old)})"


def _format_value(value: Any) -> Any:
    """Format a value; a whole section is on or off."""
    return "on" if isinstance(value, Mapping) else "off" if value is None else value

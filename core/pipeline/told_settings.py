"""The settings that a session was tracked with, read back from its parameters, and how others differ from them."""

from __future__ import annotations

import json
import types
import typing
from collections.abc import Iterator, Mapping
from dataclasses import asdict, fields, is_dataclass
from typing import Any, NamedTuple, TypeVar

from carpus.core.pipeline.track import TrackSettings

T = TypeVar("T")


class Told(NamedTuple):
    """``settings`` as the session was tracked, ``unknown`` the names of those that this Carpus does not have."""

    settings: TrackSettings
    unknown: tuple[str, ...]


def settings_told(parameters: str, kind: type[TrackSettings] = TrackSettings) -> Told | None:
    """The settings that a session's parameters tell, as those of a ``kind`` of filter; None where they do not.

    A setting that is newer than the session keeps its default; one that is gone is named.
    """
    try:
        told = json.loads(parameters)["settings"]
    except (KeyError, TypeError, ValueError):
        return None
    if not isinstance(told, Mapping):
        return None
    unknown: list[str] = []
    return Told(_filled(kind, told, "", unknown), tuple(unknown))


def differences(before: TrackSettings, after: TrackSettings) -> list[str]:
    """What differs, one text each: the setting's name, its value now and what it was."""
    return list(_differing(asdict(before), asdict(after)))


def _filled(kind: type[T], told: Mapping[str, Any], where: str, unknown: list[str]) -> T:
    hints = typing.get_type_hints(kind)
    found: dict[str, Any] = {}
    known = {item.name for item in fields(kind)}  # type: ignore[arg-type]
    unknown += [f"{where}{name}" for name in told if name not in known and told[name] is not None]
    for name in known & set(told):
        value = _value(hints[name], told[name], f"{where}{name}", unknown)
        if value is not _NOT_TAKEN:
            found[name] = value
    return kind(**found)


_NOT_TAKEN = object()


def _value(hint: Any, value: Any, place: str, unknown: list[str]) -> Any:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if is_dataclass(hint) and isinstance(hint, type) and isinstance(value, Mapping):
        return _filled(hint, value, f"{place}.", unknown)
    if origin is typing.Literal and value in arguments:
        return value
    if origin is tuple and isinstance(value, list):
        return tuple(tuple(item) if isinstance(item, list) else item for item in value)
    if origin in (typing.Union, types.UnionType):
        if value is None:
            return None
        return _value(next(one for one in arguments if one is not type(None)), value, place, unknown)
    if hint is float and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if isinstance(hint, type) and type(value) is hint:
        return value
    unknown.append(place)
    return _NOT_TAKEN


def _differing(before: dict[str, Any], after: dict[str, Any], where: str = "") -> Iterator[str]:
    for name in before | after:
        old, new = before.get(name), after.get(name)
        if isinstance(new, dict) and isinstance(old, dict):
            yield from _differing(old, new, f"{where}{name}.")
        elif new != old:
            yield f"{where}{name} {_said(new)} (was {_said(old)})"


def _said(value: Any) -> Any:
    """A whole part of the settings is there or not."""
    return "on" if isinstance(value, Mapping) else "off" if value is None else value

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
    names = {float: "a number", int: "a whole number", bool: "true or false", str: "a text"}
    wanted_words = " or ".join(map(str, arguments)) if origin is Literal else names.get(hint, "another kind of value")
    raise SettingsInvalid(
        name,
        phrase("{value} is not {wanted_words}, in {file}", value=f"{value!r}", wanted_words=wanted_words, file=file),
    )

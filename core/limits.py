"""Least and largest values of numbers that a person may choose."""

from __future__ import annotations

from collections.abc import Mapping

from carpus.core.errors import SettingsInvalid

Limits = Mapping[str, tuple[float, float]]
"""Least and largest value by the name of the field."""


def check_limits(where: str, chosen: object, limits: Limits) -> None:
    """Raise :class:`SettingsInvalid` for a number beyond its limits, also one of several, and for no number of several.
    None is no number."""
    for name, (low, high) in limits.items():
        value = getattr(chosen, name)
        several = value if isinstance(value, tuple) else (value,)
        if not several or not all(one is None or low <= one <= high for one in several):  # a NaN lies nowhere
            raise SettingsInvalid(where, f"{name} = {value}, from {low:g} to {high:g}")

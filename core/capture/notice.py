"""How a source tells what it does not raise."""

from __future__ import annotations

from collections.abc import Callable

from carpus.core.errors import CarpusFault

Notice = Callable[[CarpusFault], None]
"""Hears of faults that are told and not raised: the source goes on. Called where it is opened or frames are read."""


def ignore(_fault: CarpusFault) -> None:
    """For those who do not want to be told."""

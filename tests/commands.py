"""Commands of Carpus, run in the process of the tests."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple


class Done(NamedTuple):
    """What came of a command: its exit code, however it ended, and what it said."""

    code: int
    out: str
    err: str


Command = Callable[..., Done]
"""Runs ``carpus`` with these words, by the fixture ``command``."""

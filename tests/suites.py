"""Which cases of a test are tried with every change, and which only thoroughly."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest


def few(cases: Iterable[Any], count: int = 1) -> list[Any]:
    """Values of a parameter, or tuples of several: the first ``count`` for every run, the rest for the thorough one."""
    return [
        pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=[pytest.mark.thorough][: k >= count])
        for k, case in enumerate(cases)
    ]

"""Examples in docstrings give what they say."""

from __future__ import annotations

import doctest
import re
from importlib import import_module
from pathlib import Path

import pytest

from tests.sources import ROOT, modules

EXAMPLE = re.compile(r"^\s*>>> ", re.MULTILINE)


def named(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts if parts[0] == "tests" else ("carpus", *parts))


@pytest.mark.parametrize(
    "name",
    [named(path) for path in modules("app", "core", "ui", "tests") if EXAMPLE.search(path.read_text(encoding="utf-8"))],
)
def test_examples_hold(name: str) -> None:
    """Collected here, since pytest's own way loads and searches every file there is, in each of its processes."""
    found = doctest.testmod(import_module(name))
    assert found.attempted > 0
    assert found.failed == 0

"""The sources of the program, each parsed once by a process that runs tests.

What asks them is of one xdist group, ``SOURCES``: else each process parses them all.
"""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCES = pytest.mark.xdist_group("sources")


def modules(*parts: str) -> list[Path]:
    """The files of some folders, those further in too."""
    return sorted(path for part in parts for path in (ROOT / part).rglob("*.py"))


@cache
def parse_file(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def nodes(path: Path) -> tuple[ast.AST, ...]:
    """All that stands in a file, in no order that means anything."""
    return tuple(ast.walk(parse_file(path)))

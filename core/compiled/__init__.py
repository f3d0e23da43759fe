"""The costly steps of a frame, compiled by Cython: README.md beside this file.

A module that was not compiled is a broken installation, not a slow one: none of this package can then be imported.
``CARPUS_UNCOMPILED=1`` lets it run as Python all the same, hundreds of times slower, for a debugger.
"""

from __future__ import annotations

import os
from importlib import import_module
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

from carpus.core.model.errors import CompiledPartMissing


def find_sources(folder: Path) -> list[str]:
    """Names of the modules in ``folder``."""
    return sorted(path.stem for path in folder.glob("*.py") if path.stem != "__init__")


def find_uncompiled(folder: Path) -> list[str]:
    """Names of the modules in ``folder`` that have a source but no extension that this Python would take."""
    return [
        name
        for name in find_sources(folder)
        if not any((folder / f"{name}{ending}").is_file() for ending in EXTENSION_SUFFIXES)
    ]


if not os.environ.get("CARPUS_UNCOMPILED"):
    if _missing := find_uncompiled(Path(__file__).parent):
        raise CompiledPartMissing(", ".join(_missing))
    for _name in find_sources(Path(__file__).parent):
        try:
            import_module(f"{__package__}.{_name}")
        except ImportError as _cause:  # cut short, or of another computer
            raise CompiledPartMissing((_cause.name or _name).rpartition(".")[2]) from _cause

"""The costly steps of a frame, compiled by Cython: README.md beside this file.

A module that was not compiled is a broken installation, not a slow one: none of this package can then be imported.
``CARPUS_UNCOMPILED=1`` lets it run as Python all the same, hundreds of times slower, for a debugger.
"""

from __future__ import annotations

import os
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

from carpus.core.errors import CompiledPartMissing


def find_uncompiled(folder: Path) -> list[str]:
    """Names of the modules in ``folder`` that have a source but no extension."""
    names = {path.name.partition(".")[0] for ending in EXTENSION_SUFFIXES for path in folder.glob(f"*{ending}")}
    return sorted({path.stem for path in folder.glob("*.py")} - names - {"__init__"})


if not os.environ.get("CARPUS_UNCOMPILED") and (_missing := find_uncompiled(Path(__file__).parent)):
    raise CompiledPartMissing(", ".join(_missing))

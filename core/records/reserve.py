"""Reserved space in a data folder: on a full disk the store can still be opened and a patient erased."""

from __future__ import annotations

import contextlib
import os
import shutil
from pathlib import Path

from carpus.core.platform.durable import open_private

RESERVE_FILE = ".reserve"
RESERVE_BYTES = 2 << 20
"""For pages that SQLite writes before it can free others."""
MIN_FREE_BYTES = 20 * RESERVE_BYTES


def create_reserve(folder: Path) -> None:
    """Reserve the space if there is plenty and none is reserved."""
    path = folder / RESERVE_FILE
    with contextlib.suppress(OSError):
        if not path.exists() and shutil.disk_usage(folder).free > MIN_FREE_BYTES:
            with open(path, "xb", opener=open_private) as file:
                file.write(os.urandom(RESERVE_BYTES))  # what no disk can make smaller


def free_reserve(folder: Path) -> bool:
    """Free the space; return whether there was any."""
    try:
        (folder / RESERVE_FILE).unlink()
    except OSError:
        return False
    return True

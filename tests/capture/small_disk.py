"""A disk that is full."""

from __future__ import annotations

import resource
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from carpus.core.model.errors import DiskFull


@contextmanager
def disk_full_at(size_bytes: int) -> Iterator[None]:
    """No file can grow beyond a size, and what is done inside tells it."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size_bytes, limits[1]))
    try:
        with pytest.raises(DiskFull):
            yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)

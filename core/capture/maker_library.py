"""A maker's library as `carpus doctor` sees it: whether it is installed, and whether it can be loaded."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from importlib.metadata import PackageNotFoundError, version

from carpus.core.errors import DriverMissing
from carpus.core.finding import Finding
from carpus.core.installing import how_to_install
from carpus.core.phrase import phrase


def library_finding(name: str, package: str, load: Callable[[], None], *, asks: bool, wanted: bool) -> Finding | None:
    """The library by its package; loaded, in a process of its own, where ``asks`` and ``wanted``; None where it is
    missing and nothing wants it."""
    try:
        found = f"{package} {version(package)}"
    except PackageNotFoundError:
        found = phrase("missing: {package}", package=package)
        return Finding(name, "bad", found, how_to_install(package)) if wanted else None
    trouble = _load_trouble(load) if asks and wanted else ""
    if not trouble:
        return Finding(name, "good", found)
    return Finding(
        name,
        "bad",
        phrase("{found}, cannot be loaded: {trouble}", found=found, trouble=trouble),
        phrase("Install it, and what it names, again."),
    )


def _load_trouble(load: Callable[[], None]) -> str:
    """Why the library cannot be loaded; empty when it can."""
    try:
        with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as other:
            other.submit(load).result()
    except DriverMissing as fault:
        return fault.detail
    except BrokenProcessPool:
        return "it ends its process"
    return ""

"""How the OpenNI2 library on this computer is: there, its version, what it lacks."""

from __future__ import annotations

import multiprocessing
import sys
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool

from carpus.core.capture.finding import Finding
from carpus.core.capture.openni2 import library_version, load_library
from carpus.core.errors import DriverMissing


def driver_finding(asks_version: bool = True, _wanted: bool = True) -> Finding:
    """The OpenNI2 library; loaded, but not started. ``asks_version``, in a process of its own, takes half a second."""
    try:
        load_library()
    except DriverMissing as fault:
        remedy = (
            "Run: sudo apt-get install libopenni2-0"
            if sys.platform.startswith("linux")
            else "Install OpenNI2 from the camera's maker, then start Carpus again."
        )
        return Finding(
            "Driver", "bad", fault.detail or "not found", f"Needed for live cameras and .oni files. {remedy}"
        )
    if not asks_version:
        return Finding("Driver", "good", "OpenNI2")
    try:
        with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as other:
            return Finding("Driver", "good", f"OpenNI2 {other.submit(library_version).result()}")
    except BrokenProcessPool:
        return Finding("Driver", "bad", "OpenNI2 ends when it is asked for its version", "Install it again.")

"""How the OpenNI2 library on this computer is: there, its version, what it lacks."""

from __future__ import annotations

import multiprocessing
import sys
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool

from carpus.core.capture.openni2 import library_version, load_library
from carpus.core.errors import DriverMissing
from carpus.core.finding import Finding
from carpus.core.phrase import phrase


def driver_finding(asks_version: bool = True, _wanted: bool = True) -> Finding:
    """The OpenNI2 library; loaded, but not started. ``asks_version``, in a process of its own, takes half a second."""
    try:
        load_library()
    except DriverMissing as fault:
        remedy = (
            phrase("Run: sudo apt-get install libopenni2-0")
            if sys.platform.startswith("linux")
            else phrase("Install OpenNI2 from the camera's maker, then start Carpus again.")
        )
        return Finding(
            phrase("Driver"),
            "bad",
            fault.detail or "not found",
            phrase("Needed for live cameras. {remedy}", remedy=remedy),
        )
    if not asks_version:
        return Finding(phrase("Driver"), "good", phrase("OpenNI2"))
    try:
        with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as other:
            return Finding(
                phrase("Driver"), "good", phrase("OpenNI2 {value}", value=other.submit(library_version).result())
            )
    except BrokenProcessPool:
        return Finding(
            phrase("Driver"),
            "bad",
            phrase("OpenNI2 ends when it is asked for its version"),
            phrase("Install it again."),
        )

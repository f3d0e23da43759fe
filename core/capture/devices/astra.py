"""Orbbec's Astra cameras that speak OpenNI2: opened like the Xtion, through the maker's driver in OpenNI2's folder."""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

from carpus.core.capture.devices import openni2_camera
from carpus.core.capture.devices.cameras import CameraKind
from carpus.core.capture.devices.openni2_camera import open_openni2
from carpus.core.installing import Finding
from carpus.core.phrase import phrase

MODELS = {
    ("2bc5", "0401"): "Orbbec Astra",
    ("2bc5", "0402"): "Orbbec Astra S",
    ("2bc5", "0403"): "Orbbec Astra Pro",
    ("2bc5", "0404"): "Orbbec Astra Mini",
    ("2bc5", "0407"): "Orbbec Astra Mini S",
}
"""The Astra Pro is named, but its colour camera does not speak OpenNI2: opening it says so."""
DRIVER_FILES = {"win32": "orbbec.dll", "darwin": "liborbbec.dylib"}
DRIVER_FILE = "liborbbec.so"
NAME = phrase("Astra driver")


def driver_folders() -> list[Path]:
    """Where OpenNI2 may look for the drivers of makers."""
    installed = [Path(os.environ[key]) for key in ("OPENNI2_REDIST64", "OPENNI2_REDIST") if os.environ.get(key)]
    shared = [Path("/usr/lib"), *sorted(Path("/usr/lib").glob("*-linux-*")), Path("/usr/local/lib")]
    return [root / "OpenNI2" / "Drivers" for root in (*installed, *shared)]


def driver_finding(asks_version: bool = True, wanted: bool = True) -> Finding | None:
    """OpenNI2 and, beside it, the maker's driver; None where no Astra is plugged in."""
    if not wanted:
        return None
    library = openni2_camera.driver_finding(asks_version)
    if library.state != "good":
        return replace(library, name=NAME)
    file = DRIVER_FILES.get(sys.platform, DRIVER_FILE)
    folders = [folder for folder in driver_folders() if folder.is_dir()]
    for folder in folders:
        if (folder / file).exists():
            return Finding(NAME, "good", f"{library.found}, {folder / file}")
    into = folders[0] if folders else Path("OpenNI2") / "Drivers"
    remedy = phrase(
        "Copy {file} from the folder OpenNI2/Drivers of Orbbec's OpenNI2 package into {into}.", file=file, into=into
    )
    return Finding(NAME, "bad", phrase("{found}, without the maker's driver", found=library.found), remedy)


KIND = CameraKind(
    title="Orbbec Astra",
    models=MODELS,
    open=partial(open_openni2, models=MODELS),
    driver=driver_finding,
    needed_mbit=480,
    port=phrase("It needs a USB 2 port."),
)

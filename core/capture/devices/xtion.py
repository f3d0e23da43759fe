"""The ASUS Xtion and its PrimeSense relatives, by OpenNI2."""

from __future__ import annotations

from functools import partial

from carpus.core.capture.devices.cameras import CameraKind
from carpus.core.capture.devices.openni2_camera import driver_finding, open_openni2
from carpus.core.phrase import phrase

MODELS = {
    ("1d27", "0500"): "PrimeSense Carmine",
    ("1d27", "0600"): "Asus Xtion Pro Live",
    ("1d27", "0601"): "Asus Xtion Pro Live",
    ("1d27", "0609"): "PrimeSense Carmine 1.09",
}


KIND = CameraKind(
    title="Asus Xtion",
    models=MODELS,
    open=partial(open_openni2, models=MODELS),
    driver=driver_finding,
    needed_mbit=480,
    port=phrase("It needs a USB 2 port; some USB 3 ports refuse cameras with old firmware."),
)

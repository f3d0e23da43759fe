"""The ASUS Xtion and its PrimeSense relatives, by OpenNI2."""

from __future__ import annotations

from carpus.core.camera import Camera
from carpus.core.capture.camera_kind import CameraKind
from carpus.core.capture.notice import Notice
from carpus.core.capture.openni2_camera import OpenNI2Camera
from carpus.core.capture.openni2_driver import driver_finding
from carpus.core.depth_sensor import PRIMESENSE
from carpus.core.phrase import phrase

MODELS = {
    ("1d27", "0500"): "PrimeSense Carmine",
    ("1d27", "0600"): "Asus Xtion Pro Live",
    ("1d27", "0601"): "Asus Xtion Pro Live",
    ("1d27", "0609"): "PrimeSense Carmine 1.09",
}


def open_xtion(*, uri: str | None, camera: Camera | None, patience_s: float, notice: Notice) -> OpenNI2Camera:
    """The first Xtion, or the one at OpenNI2's ``uri``."""
    return OpenNI2Camera(uri=uri, camera=camera, patience_s=patience_s, notice=notice, models=MODELS, sensor=PRIMESENSE)


KIND = CameraKind(
    title="Asus Xtion",
    models=MODELS,
    open=open_xtion,
    driver=driver_finding,
    needed_mbit=480,
    port=phrase("It needs a USB 2 port; some USB 3 ports refuse cameras with old firmware."),
)

"""Opens a live camera that speaks OpenNI2."""

from __future__ import annotations

import math
from collections.abc import Mapping

from carpus.core.camera import Camera
from carpus.core.capture.camera_plan import CameraPlan
from carpus.core.capture.notice import Notice, ignore
from carpus.core.capture.openni2_process import serve
from carpus.core.capture.process_camera import SIZE_PX, ProcessCamera
from carpus.core.depth_sensor import PRIMESENSE


def open_openni2(
    *,
    models: Mapping[tuple[str, str], str],
    uri: str | None = None,
    camera: Camera | None = None,
    patience_s: float = math.inf,
    notice: Notice = ignore,
) -> ProcessCamera:
    """The first camera among ``models`` (names by USB vendor and product), or the one at OpenNI2's ``uri``."""
    plan = CameraPlan(size_px=SIZE_PX, models=models, uri=uri or "")
    name = uri or "camera"
    return ProcessCamera(serve, plan, name, lambda _: PRIMESENSE, camera=camera, patience_s=patience_s, notice=notice)

"""A live camera that speaks OpenNI2."""

from __future__ import annotations

import math
from collections.abc import Mapping

from carpus.core.camera import Camera
from carpus.core.capture.camera_plan import CameraPlan
from carpus.core.capture.notice import Notice, ignore
from carpus.core.capture.openni2_process import serve
from carpus.core.capture.process_camera import SIZE_PX, ProcessCamera
from carpus.core.depth_sensor import PRIMESENSE, DepthSensor


class OpenNI2Camera(ProcessCamera):
    """The first camera among ``models`` (names by USB vendor and product), or the one at ``uri``.

    The rest as for :class:`ProcessCamera`.
    """

    def __init__(
        self,
        *,
        uri: str | None = None,
        camera: Camera | None = None,
        patience_s: float = math.inf,
        notice: Notice = ignore,
        models: Mapping[tuple[str, str], str],
        sensor: DepthSensor = PRIMESENSE,
    ) -> None:
        plan = CameraPlan(uri=uri or "", size_px=SIZE_PX, models=models)
        super().__init__(serve, plan, uri or "camera", sensor, camera=camera, patience_s=patience_s, notice=notice)

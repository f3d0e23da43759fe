"""A live camera, driven in a process of its own, as a source of frames; it reconnects when plugged in again."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from carpus.core.capture.camera_info import rescale_camera
from carpus.core.capture.devices.capture_process import (
    SIZE_PX,
    CameraConfig,
    CaptureProcess,
    DeviceOpened,
    ExposureLocked,
    ImageArrived,
    ServeFunction,
    Signal,
)
from carpus.core.capture.frame_assembly import FrameAssembler, StreamLayout, camera_from_field_of_view, camera_from_lens
from carpus.core.capture.source import NoticeHandler, Sensor, SourceInfo
from carpus.core.model import errors
from carpus.core.model.camera import Camera
from carpus.core.model.depth_sensor import DepthSensor
from carpus.core.model.errors import CarpusFault
from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import Frame

POOL_SLOTS = 60
"""Slots for a camera, which does not wait: two seconds of images for a busy computer (55 MB, used only then)."""
OPEN_TIMEOUT_S = 15.0
MAX_WAITING_IMAGES = 3
"""A colour image waits no longer than a tenth of a second for its depth."""
MAX_START_DROPS = 30
"""Colour images skipped at the start while there is no depth yet; after a second images go on without it."""
RETRY_S = 1.0
MAX_CRASHES = 3
"""Restarts in a row without a single frame."""
SETTLE_FRAMES = 45
"""Frames until automatic exposure has settled, when a lock has to be set again."""
_RECOVERABLE_FAULTS = (
    errors.CameraBusy,
    errors.CameraLost,
    errors.CameraMissing,
    errors.CameraPermission,
    errors.DriverFailed,
)
"""Faults that reconnecting or waiting can resolve."""


class ProcessCamera:
    """Frames of a live camera: 640x480 RGB with registered depth, at 30 fps, in the device's own time.

    The camera runs from construction until :meth:`close`. When it is lost, ``notice`` receives :class:`CameraLost`,
    then :class:`CameraReturned`; if it is absent for ``patience_s``, :class:`CameraLost` is raised. If another camera
    is plugged in meanwhile, ``notice`` receives :class:`CameraMismatch` and the wait goes on. Missed frames are counted
    in the next one.

    ``serve`` serves ``plan`` in the capture process; ``subject`` names the camera in faults until it is open;
    ``find_sensor`` returns the depth sensor for the settings of the opened camera and the focal length of its colour
    images; ``camera`` are measured intrinsics, else those of the driver, or those from its field of view.
    """

    def __init__(
        self,
        serve: ServeFunction,
        plan: CameraConfig,
        subject: str,
        find_sensor: Callable[[Mapping[str, str], float], DepthSensor],
        *,
        camera: Camera | None,
        patience_s: float,
        notice: NoticeHandler,
    ) -> None:
        self._serve, self._plan, self._subject, self._find_sensor = serve, plan, subject, find_sensor
        self._patience_s = patience_s
        self._notice = notice
        self._closing = threading.Event()
        self._lock = threading.Lock()
        self._is_exposure_locked = False
        self._frames_to_relock = 0
        self._last_frame_s = time.monotonic()
        self._process = self._start_process()
        try:
            opened = self._process.receive_opened(self._closing, OPEN_TIMEOUT_S)
            assert opened is not None
            self._opened: DeviceOpened = opened
            self._assembler = FrameAssembler(
                build_layout(opened), 1e6 / opened.modes[Sensor.COLOR].fps, MAX_WAITING_IMAGES, MAX_START_DROPS
            )
            self.info = self._build_info(camera)
        except BaseException:
            self._process.close(gently=True)
            raise

    def lock_exposure(self) -> None:
        """Lock exposure and white balance, so that the markers keep their colours.

        A camera that cannot is reported by a notice.
        """
        self._is_exposure_locked = True
        self._process.send_command(Signal.LOCK_EXPOSURE)

    def frames(self) -> Iterator[Frame]:
        """Yield frames from now on until :meth:`close`; images from before are discarded."""
        with self._lock:
            if not self._closing.is_set():
                self._process.discard_images()
        crashes = 0
        while not self._closing.is_set():
            count = 0
            try:
                for frame in self._read_frames():
                    count += 1
                    yield frame
                return
            except _RECOVERABLE_FAULTS as fault:
                crashes = 1 if count else crashes + 1
                if isinstance(fault, errors.DriverFailed) and crashes >= MAX_CRASHES:
                    raise
                lost = (
                    fault if isinstance(fault, errors.CameraLost) else errors.CameraLost(self.info.name, fault.detail)
                )
            self._notice(lost)
            away_s = self._reconnect(lost)
            if away_s is None:
                return
            self._notice(errors.CameraReturned(self.info.name, f"{format_rounded(away_s)} s"))

    def close(self) -> None:
        """Release the camera; may be called twice, and while another thread waits for a frame."""
        self._closing.set()
        with self._lock:
            self._process.close(gently=True)

    def _start_process(self) -> CaptureProcess:
        width, height = SIZE_PX
        return CaptureProcess(self._serve, self._plan, self._subject, width * height * 3, POOL_SLOTS)

    def _read_frames(self) -> Iterator[Frame]:
        """Yield the frames of the running process."""
        while True:
            frames: list[Frame] = []
            is_held = True
            with self._lock:
                if self._closing.is_set():
                    return
                report = self._process.receive_report(self._closing)
                if isinstance(report, ImageArrived):
                    frames = self._process.read_image(report, self._assembler)
                elif isinstance(report, ExposureLocked):
                    is_held = report.is_locked
                elif report is None or report is Signal.ENDED:
                    return
            if not is_held:
                self._notice(errors.ExposureUnstable(self.info.name))
            for frame in frames:
                self._last_frame_s = time.monotonic()
                if self._frames_to_relock:  # a reconnected camera has lost its lock; its automatic settles first
                    self._frames_to_relock -= 1
                    if self._frames_to_relock == 0 and self._is_exposure_locked:
                        self._process.send_command(Signal.LOCK_EXPOSURE)
                yield frame

    def _reconnect(self, lost: CarpusFault) -> float | None:
        """Wait for the camera; return the seconds of its absence, or None if closed.

        Raises ``lost`` after ``patience_s``.
        """
        start_s = time.monotonic()
        other = ""
        self._plan = replace(self._plan, serial=self._opened.settings.get("serial", ""))  # the same one, and no other
        while not self._closing.is_set():
            try:
                with self._lock:
                    self._process.close(gently=False)
                    if self._closing.is_set():
                        return None
                    self._process = self._start_process()
                    opened = self._process.receive_opened(self._closing, OPEN_TIMEOUT_S)
                    first = self._receive_first_image() if opened else None
                if opened is None or first is None:
                    return None
                if _format_camera(opened) != _format_camera(self._opened) or opened.modes != self._opened.modes:
                    shown = ", ".join(f"{sensor.name.lower()} {mode}" for sensor, mode in opened.modes.items())
                    found = _format_camera(opened) + ("" if opened.modes == self._opened.modes else f": {shown}")
                    raise errors.CameraMismatch(_format_camera(self._opened), found)
                self._opened = opened
                away_s = time.monotonic() - self._last_frame_s
                self._assembler.restart(build_layout(opened), first.timestamp_us, round(away_s * 1e6))
                self._frames_to_relock = SETTLE_FRAMES if self._is_exposure_locked else 0
                return time.monotonic() - start_s
            except _RECOVERABLE_FAULTS as fault:
                if isinstance(fault, errors.CameraMismatch) and fault.detail != other:
                    other = fault.detail
                    self._notice(errors.CameraMismatch(_format_camera(self._opened), other))
                if time.monotonic() - start_s > self._patience_s:
                    raise lost from None
                self._closing.wait(RETRY_S)
        return None

    def _receive_first_image(self) -> ImageArrived | None:
        """Return the first image after a restart, for its time only."""
        while (report := self._process.receive_report(self._closing)) is not None:
            if isinstance(report, ImageArrived):
                self._process.release_slot(report)
                return report
        return None

    def _build_info(self, camera: Camera | None) -> SourceInfo:
        opened, layout = self._opened, self._assembler.layout
        name = opened.settings.get("camera", "camera")
        if camera is not None:
            found = rescale_camera(camera, layout.size_px)
        elif opened.lens is not None:
            found = rescale_camera(camera_from_lens(layout.color_size_px, opened.lens), layout.size_px)
        else:
            found = camera_from_field_of_view(layout.size_px, opened.field_of_view_rad)
        if found is None:
            raise errors.CameraFileUnreadable(name, "for images of another size: {}x{}".format(*layout.size_px))
        if opened.settings.get("registered") == "no":
            self._notice(errors.DepthNotRegistered(name))
        if layout.format_enlargement:
            self._notice(errors.FramesEnlarged(name, layout.format_enlargement))
        settings = {**opened.settings, "mirrored": "turned back" if opened.mirrored else "no"}
        focal_px = math.nan if opened.lens is None else opened.lens.fx_px
        seen = replace(found, sensor=self._find_sensor(opened.settings, focal_px))
        return SourceInfo(name, seen, True, None, float(opened.modes[Sensor.COLOR].fps), settings)


def _format_camera(opened: DeviceOpened) -> str:
    return f"{opened.settings.get('camera', 'camera')} {opened.settings.get('serial', '')}".strip()


def build_layout(opened: DeviceOpened) -> StreamLayout:
    """Return the layout of an opened device's images. Raises :class:`CameraUnsuited` for sizes that do not match."""
    sizes = {sensor: (mode.width_px, mode.height_px) for sensor, mode in opened.modes.items()}
    layout = StreamLayout(
        sizes[Sensor.COLOR],
        sizes.get(Sensor.DEPTH),
        Sensor.COLOR in opened.mirrored,
        Sensor.DEPTH in opened.mirrored,
        opened.depth_unit_m,
    )
    if layout.describe_size_mismatch():
        raise errors.CameraUnsuited(opened.settings.get("camera", "camera"), layout.describe_size_mismatch())
    return layout

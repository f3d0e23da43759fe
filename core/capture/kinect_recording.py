"""A recording of an Azure Kinect or Femto (Matroska, ``.mkv``) as a source of frames, read by PyAV (the extra ``mkv``).

Its depth lies in the depth camera's own pictures; it is laid on colour by the calibration that lies in the file.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.capture.depth_on_color import DepthOnColor
from carpus.core.capture.frame_assembly import Assembler, Layout, fitted_camera
from carpus.core.capture.kinect_calibration import KinectCalibration, read_calibration
from carpus.core.capture.notice import Notice, ignore
from carpus.core.capture.source import SourceInfo
from carpus.core.depth_sensor import AZURE_KINECT
from carpus.core.errors import ExtraMissing, PicturesLost, RecordingDamaged, RecordingUnsupported
from carpus.core.types import Frame

if TYPE_CHECKING:
    from av.container import InputContainer

PACKAGE = "av"
WIDEST_PX = 1920
"""Larger colour pictures are halved: discs are large enough in those, and reading is four times as fast."""
WAITING_PICTURES = 64
"""How far apart in the file colour and depth of one moment may lie."""
ENDS_EARLY_S = 0.5
DEPTH_UNIT_M = 1e-3


class KinectRecording:
    """Frames of a recording, all of them, in order, as fast as they are read.

    :meth:`frames` may be repeated, one walk at a time. Pictures that cannot be decoded are left out: ``notice`` hears
    :class:`PicturesLost` at the end. Raises :class:`ExtraMissing` without PyAV, :class:`RecordingDamaged` where it is
    no sound file, :class:`RecordingUnsupported` where it lacks colour, depth or calibration.
    """

    def __init__(self, path: Path, *, notice: Notice = ignore) -> None:
        if find_spec(PACKAGE) is None:
            raise ExtraMissing(PACKAGE)
        self._path, self._notice = path, notice
        self._closing = threading.Event()
        with closing(self._open()) as container:
            color, depth = self._track(container, "COLOR"), self._track(container, "DEPTH")
            self._sizes_px = (color.width, color.height), (depth.width, depth.height)
            self._fps = float(color.average_rate or color.guessed_rate or 30.0)
            self._calibration = self._calibrated(container)
            tags = {key.upper(): value for key, value in container.metadata.items()}
        self._shrink = 1 if color.width <= WIDEST_PX else 2
        self._laying: DepthOnColor | None = None
        self._info = self._describe(tags, str(color.codec_context.name))

    @property
    def info(self) -> SourceInfo:
        """Facts about the recording."""
        return self._info

    def frames(self) -> Iterator[Frame]:
        """All frames from the first on."""
        if self._closing.is_set():
            return
        import av

        lens = self._calibration
        if self._laying is None:
            self._laying = DepthOnColor(lens.depth, lens.color, lens.rotation, lens.translation_m, self._shrink)
        size_px = self._info.camera.width_px, self._info.camera.height_px
        assembler = Assembler(Layout(size_px, size_px, depth_unit_m=DEPTH_UNIT_M), 1e6 / self._fps, WAITING_PICTURES)
        seen = lost = 0
        last_s = 0.0
        with closing(self._open()) as container:
            color, depth = self._track(container, "COLOR"), self._track(container, "DEPTH")
            ends_s = container.duration / av.time_base if container.duration else 0.0
            packets = container.demux(color, depth)
            while not self._closing.is_set():
                try:
                    packet = next(packets, None)
                    if packet is None:
                        break
                    pictures: list[Any] = list(packet.decode())  # the last packet is empty: it fetches what still waits
                except av.error.InvalidDataError:
                    seen, lost = seen + 1, lost + 1
                    continue
                except av.error.FFmpegError as cause:
                    raise RecordingDamaged(self._path, cause.strerror or "") from cause
                for picture in pictures:
                    seen += 1
                    at_s = float(picture.pts * picture.time_base) if picture.pts is not None else last_s
                    last_s = max(last_s, at_s)
                    is_depth = packet.stream.index == depth.index
                    view = self._depth(picture) if is_depth else self._color(picture)
                    if view is None:
                        lost += 1
                    else:
                        yield from (assembler.depth if is_depth else assembler.color)(round(at_s * 1e6), 0, view)
            else:
                return
        yield from assembler.finish()
        if seen == lost:
            raise RecordingDamaged(self._path, "no picture in it")
        if last_s < ends_s - ENDS_EARLY_S:
            raise RecordingDamaged(self._path, f"it ends after {last_s:.1f} of {ends_s:.1f} s")
        if lost:
            self._notice(PicturesLost(self._path, f"{lost} of {seen}"))

    def close(self) -> None:
        """End playback; may be called twice, and while another thread waits for a frame."""
        self._closing.set()

    def _open(self) -> InputContainer:
        import av

        try:
            return av.open(str(self._path), "r", format="matroska", metadata_errors="replace")
        except (av.error.FFmpegError, OSError) as cause:
            raise RecordingDamaged(self._path, cause.strerror or "") from cause

    def _track(self, container: InputContainer, name: str) -> Any:
        tracks: list[Any] = list(container.streams.video)
        for stream in tracks:
            # without it nobody can decode the track
            if stream.codec_context is not None and name in (
                stream.metadata.get("title"),
                stream.metadata.get("TITLE"),
            ):
                return stream
        raise RecordingUnsupported(self._path, f"no {'colour' if name == 'COLOR' else 'depth'} pictures in it")

    def _calibrated(self, container: InputContainer) -> KinectCalibration:
        attached: list[Any] = list(container.streams)
        for stream in attached:
            if stream.type == "attachment" and str(stream.name).lower().endswith(".json"):
                try:
                    return read_calibration(stream.data, *self._sizes_px)
                except ValueError as cause:
                    raise RecordingUnsupported(self._path, str(cause)) from cause
        raise RecordingUnsupported(self._path, "no calibration of the camera in it")

    def _color(self, picture: Any) -> NDArray[Any] | None:
        if (picture.width, picture.height) != self._sizes_px[0]:
            return None
        out = np.asarray(picture.to_ndarray(format="rgb24"))
        if self._shrink == 1:
            return out
        size_px = out.shape[1] // self._shrink, out.shape[0] // self._shrink
        return np.asarray(cv2.resize(out, size_px, interpolation=cv2.INTER_AREA), dtype=np.uint8)

    def _depth(self, picture: Any) -> NDArray[Any] | None:
        if (picture.width, picture.height) != self._sizes_px[1]:
            return None
        assert self._laying is not None
        return self._laying.lay(np.ascontiguousarray(picture.to_ndarray(), dtype=np.uint16))

    def _describe(self, tags: dict[str, str], codec: str) -> SourceInfo:
        whole = self._calibration.color
        camera = fitted_camera(whole, (whole.width_px // self._shrink, whole.height_px // self._shrink))
        assert camera is not None
        (width, height), (depth_width, depth_height) = self._sizes_px
        settings = {
            "format": "Azure Kinect .mkv",
            "serial": tags.get("K4A_DEVICE_SERIAL_NUMBER", ""),
            "firmware": tags.get("K4A_COLOR_FIRMWARE_VERSION", ""),
            "color": f"{width}x{height} {codec} {self._fps:g} fps",
            "depth": f"{depth_width}x{depth_height} {tags.get('K4A_DEPTH_MODE', '')}".strip(),
            "lens_model": camera.distortion_model,
            "registered": "by Carpus",
            "shrunk": f"{self._shrink} pixels to one" if self._shrink > 1 else "",
        }
        told = {key: value for key, value in settings.items() if value}
        return SourceInfo(self._path.name, replace(camera, sensor=AZURE_KINECT), True, None, self._fps, told)

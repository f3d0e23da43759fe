"""A recording of an Azure Kinect or Femto (Matroska, ``.mkv``) as a source of frames, read by PyAV (the extra ``mkv``).

Its depth lies in the depth camera's own pictures; it is laid on colour by the calibration that lies in the file.
"""

from __future__ import annotations

import json
import math
import threading
from collections.abc import Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.camera import Camera
from carpus.core.capture.camera_info import fitted_camera
from carpus.core.capture.frame_assembly import Assembler, Layout, LensBending, straight_pixels
from carpus.core.capture.source import Notice, SourceInfo, ignore
from carpus.core.depth_sensor import AZURE_KINECT
from carpus.core.errors import ExtraMissing, PicturesLost, RecordingDamaged, RecordingUnsupported
from carpus.core.types import FloatArray, Frame

if TYPE_CHECKING:
    from av.container import InputContainer

# The calibration that lies in a recording of an Azure Kinect or Femto: both lenses, and how the cameras stand.
DEPTH_WINDOWS_PX: Mapping[tuple[int, int], tuple[int, int, int]] = {
    (640, 576): (1024, 192, 180),
    (320, 288): (512, 96, 90),
    (1024, 1024): (1024, 0, 0),
    (512, 512): (512, 0, 0),
}
"""Of each size of depth picture: the side of the whole sensor in its pixels, and where the picture begins on it."""
_PURPOSES = {"color": "CALIBRATION_CameraPurposePhotoVideo", "depth": "CALIBRATION_CameraPurposeDepth"}
_MODEL = "CALIBRATION_LensDistortionModelBrownConrady"
_VALUES = 14
_HIDDEN_SHARE = 0.125
"""Of the height of the whole colour sensor (4:3), above and below a picture of 16:9."""


@dataclass(frozen=True, slots=True)
class KinectCalibration:
    """Both cameras for pictures of one size each; a point p of the depth camera's axes is ``rotation`` p +
    ``translation_m`` in those of the colour camera."""

    color: Camera
    depth: Camera
    rotation: FloatArray
    translation_m: FloatArray


def read_calibration(text: bytes, color_size_px: tuple[int, int], depth_size_px: tuple[int, int]) -> KinectCalibration:
    """The calibration as the maker stores it (JSON), for pictures of these sizes. Raises ValueError with what is wrong.

    The maker's figures are shares of the whole sensor's sides; its pixels begin at 0, so their middles lie at 0.5.
    """
    if depth_size_px not in DEPTH_WINDOWS_PX:
        raise ValueError("depth pictures of {}x{}".format(*depth_size_px))
    width, height = color_size_px
    if width * 3 == height * 4:
        top, whole_height = 0.0, float(height)
    elif width * 9 == height * 16:
        whole_height = height / (1.0 - 2.0 * _HIDDEN_SHARE)
        top = whole_height * _HIDDEN_SHARE
    else:
        raise ValueError(f"colour pictures of {width}x{height}")
    side, left, above = DEPTH_WINDOWS_PX[depth_size_px]
    try:
        told = json.loads(text.decode("utf-8", errors="replace").rstrip("\0"))["CalibrationInformation"]["Cameras"]
        cameras = {each["Purpose"]: each for each in told}
        color, depth = (cameras[_PURPOSES[name]] for name in ("color", "depth"))
        lenses = (
            _camera(color, color_size_px, (float(width), whole_height), (0.0, top)),
            _camera(depth, depth_size_px, (float(side), float(side)), (float(left), float(above))),
        )
        (turn, shift_m), (depth_turn, depth_shift_m) = _pose(color), _pose(depth)
    except (KeyError, TypeError, IndexError, ValueError, RecursionError) as cause:
        raise ValueError("its calibration is not in the maker's form") from cause
    # each pose leads from common axes into a camera's
    rotation = turn @ depth_turn.T
    return KinectCalibration(*lenses, rotation, shift_m - rotation @ depth_shift_m)


def _camera(
    told: Any, size_px: tuple[int, int], whole_px: tuple[float, float], corner_px: tuple[float, float]
) -> Camera:
    intrinsics = told["Intrinsics"]
    if intrinsics["ModelType"] != _MODEL:
        raise ValueError("another model of the lens")
    values = [float(value) for value in intrinsics["ModelParameters"][:_VALUES]]
    cx, cy, fx, fy, k1, k2, k3, k4, k5, k6, *_, p2, p1 = values
    if len(values) != _VALUES or not all(map(math.isfinite, values)) or min(fx, fy) <= 0.0:
        raise ValueError("no lens")
    return Camera(
        fx * whole_px[0],
        fy * whole_px[1],
        cx * whole_px[0] - corner_px[0] - 0.5,
        cy * whole_px[1] - corner_px[1] - 0.5,
        *size_px,
        (k1, k2, p1, p2, k3, k4, k5, k6),
        origin="factory",
        distortion_model="rational_polynomial",
    )


def _pose(told: Any) -> tuple[FloatArray, FloatArray]:
    rotation = np.array(told["Rt"]["Rotation"], dtype=np.float64).reshape(3, 3)
    translation_m = np.array(told["Rt"]["Translation"], dtype=np.float64).reshape(3)
    off = np.abs(rotation @ rotation.T - np.eye(3)).max()
    if not off < 1e-2 or not np.abs(translation_m).max() < 1.0:
        raise ValueError("no pose")
    return rotation, translation_m


# Lays a depth camera's pictures on those of the colour camera beside it.
_NOTHING = np.iinfo(np.uint16).max


class DepthOnColor:
    """Moves each reading to where the colour camera sees it; the nearer of two wins, no reading is mixed with another.

    ``rotation`` and ``translation_m`` lead from the depth camera's axes into the colour camera's; ``shrink`` pixels of
    the colour camera, across and down, are one of the picture that is made.
    """

    def __init__(
        self, depth: Camera, color: Camera, rotation: FloatArray, translation_m: FloatArray, shrink: int = 1
    ) -> None:
        pixels = straight_pixels(depth).reshape(-1, 2).astype(np.float64)
        rays = depth.back_project(pixels, np.ones(len(pixels)))
        self._rays = (rays @ rotation.T).astype(np.float32)
        self._shift_mm = (translation_m * 1000.0).astype(np.float32)
        self._color = color
        self._footprint = max(1, math.ceil(color.fx_px / depth.fx_px - 0.05))
        """So many pixels of the colour picture, across and down, one of the depth picture covers."""
        self._bending = LensBending(color, shrink)

    def lay(self, depth_mm: NDArray[np.uint16]) -> NDArray[np.uint16]:
        """Depth (H, W), millimetres along the colour camera's axis, of depth (h, w), millimetres; 0: none."""
        width, height = self._color.width_px, self._color.height_px
        flat = depth_mm.reshape(-1)
        known = np.flatnonzero(flat)
        x, y, z = (self._rays[known] * flat[known, None].astype(np.float32) + self._shift_mm).T
        ahead = (z > 1.0) & (z < _NOTHING)
        x, y, z = x[ahead], y[ahead], z[ahead]
        order = np.argsort(-z)  # of what falls on one pixel the last that is written stays: the nearest
        x, y, z = x[order], y[order], z[order]
        begin = (self._footprint - 1) / 2.0
        u = np.rint(self._color.fx_px * x / z + self._color.cx_px - begin).astype(np.int64)
        v = np.rint(self._color.fy_px * y / z + self._color.cy_px - begin).astype(np.int64)
        readings = np.rint(z).astype(np.uint16)
        laid = np.full(height * width, _NOTHING, np.uint16)
        for down in range(self._footprint):
            for across in range(self._footprint):
                column, row = u + across, v + down
                inside = (column >= 0) & (column < width) & (row >= 0) & (row < height)
                place = row[inside] * width + column[inside]
                layer = np.full(height * width, _NOTHING, np.uint16)
                layer[place] = readings[inside]
                np.minimum(laid, layer, out=laid)
        laid[laid == _NOTHING] = 0
        bent: NDArray[np.uint16] = self._bending.bend(laid.reshape(height, width))
        return bent


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
        return self._info

    def frames(self) -> Iterator[Frame]:
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

"""Frames from the driver's images: unmirrored, brought to one size, paired by time, gaps counted."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.capture.camera_info import rescale_camera
from carpus.core.capture.source import Lens, PixelFormat, Sensor
from carpus.core.model.camera import DEFAULT_CAMERA, DISTORTION_COEFFICIENT_COUNTS, Camera, DistortionModel
from carpus.core.model.types import Frame

PAIRING_TOLERANCE_US = 20_000
"""A colour image without depth nearer in time than this has none."""


AnyImage = NDArray[Any]

FILE_PAIRING_LIMIT = 64
"""Largest distance of colour and depth of one time within a recording, in images."""

DEPTH_UNIT_M: dict[int, float] = {PixelFormat.DEPTH_1_MM: 1e-3, PixelFormat.DEPTH_100_UM: 1e-4}


@dataclass(frozen=True, slots=True)
class StreamLayout:
    """Sizes (width, height) of the images as they come, and which are mirrored; depth size None without depth."""

    color_size_px: tuple[int, int]
    depth_size_px: tuple[int, int] | None
    color_mirrored: bool = False
    depth_mirrored: bool = False
    depth_unit_m: float = 1e-3

    @property
    def size_px(self) -> tuple[int, int]:
        """Size of the frames: the larger of the two."""
        return max(self.color_size_px, self.depth_size_px or self.color_size_px)

    @property
    def format_enlargement(self) -> str:
        """Description of what is enlarged; empty if nothing is."""
        width, height = self.size_px
        for name, size in (("colour", self.color_size_px), ("depth", self.depth_size_px)):
            if size is not None and size != (width, height):
                return f"{name} from {size[0]}x{size[1]} to {width}x{height}"
        return ""

    def describe_size_mismatch(self) -> str:
        """Return why these sizes cannot be combined; empty if they are equal or one is twice the other."""
        width, height = self.size_px
        for size in (self.color_size_px, self.depth_size_px or self.color_size_px):
            if size != (width, height) and (2 * size[0], 2 * size[1]) != (width, height):
                color, depth = self.color_size_px, self.depth_size_px or (0, 0)
                return f"colour {color[0]}x{color[1]}, depth {depth[0]}x{depth[1]}"
        return ""

    def convert_color(self, view: AnyImage) -> AnyImage:
        """Return a read-only copy (H, W, 3) of a colour image in the driver's memory."""
        if self.color_size_px != self.size_px:
            # half-pixel centres: pixel u of the small image is at 2 u + 0.5 of the large one
            turned = view[:, ::-1] if self.color_mirrored else view
            return _make_read_only(
                cv2.resize(np.ascontiguousarray(turned), self.size_px, interpolation=cv2.INTER_LINEAR)
            )
        return _make_read_only(cv2.flip(view, 1) if self.color_mirrored else view.copy())

    def convert_depth(self, view: AnyImage) -> AnyImage:
        """Return a read-only copy (H, W) of a depth image, enlarged by repetition: no depth is invented."""
        turned = view[:, ::-1] if self.depth_mirrored else view
        if self.depth_size_px != self.size_px:
            return _make_read_only(turned.repeat(2, axis=0).repeat(2, axis=1))
        return _make_read_only(turned.copy())


class DriverImage(NamedTuple):
    """Image with its device time and its number in the stream."""

    timestamp_us: int
    number: int
    image: AnyImage


class FrameAssembler:
    """Builder of frames from images of one colour and one depth stream, paired by nearest time.

    A colour image is released when its depth is certain: one nearer than half a period has come, or a later one. At
    most ``limit`` images of a stream wait; then the oldest colour image is released with the nearest depth so far, or
    the oldest depth image is dropped. A depth image serves one colour image.

    The streams of a camera do not start at the same time: up to ``start_limit`` colour images before the first pair are
    skipped; 0 keeps all, for a recording. ``period_us`` is the time between colour images. Frames are numbered from 0;
    a colour image that is not later than the one before is skipped.
    """

    def __init__(self, layout: StreamLayout, period_us: float, limit: int, start_limit: int = 0) -> None:
        self._period_us, self._limit, self._start_limit = period_us, limit, start_limit
        self._offset_us = 0
        self._index = 0
        self._last_us: int | None = None
        self._reset(layout)

    def _reset(self, layout: StreamLayout) -> None:
        self.layout = layout
        self._has_depth = layout.depth_size_px is not None
        self._start_drops_left = self._start_limit
        self._colors: deque[DriverImage] = deque()
        self._depths: deque[DriverImage] = deque()
        self._last_number = 0

    def add(self, sensor: Sensor, timestamp_us: int, number: int, view: AnyImage) -> list[Frame]:
        """Add an image in the driver's memory; return the frames that are complete."""
        if sensor == Sensor.COLOR:
            self._colors.append(DriverImage(timestamp_us, number, self.layout.convert_color(view)))
        else:
            self._depths.append(DriverImage(timestamp_us, number, self.layout.convert_depth(view)))
        frames = self._release_frames()
        while len(self._depths) > self._limit:
            self._depths.popleft()
        return frames

    def finish(self) -> list[Frame]:
        """Return the frames that were still open; no more images come."""
        self._has_depth = False
        return self._release_frames()

    def restart(self, layout: StreamLayout, first_us: int, gap_us: int) -> None:
        """Continue after the device's clock restarted at ``first_us``, ``gap_us`` after the last frame.

        Times keep rising.
        """
        self._reset(layout)
        if self._last_us is not None:
            self._offset_us = self._last_us + max(gap_us, 1) - first_us

    def _release_frames(self) -> list[Frame]:
        frames: list[Frame] = []
        while self._colors:
            color = self._colors[0]
            nearest = min(self._depths, key=lambda depth: abs(depth.timestamp_us - color.timestamp_us), default=None)
            apart_us = abs(nearest.timestamp_us - color.timestamp_us) if nearest else 1 << 62
            certain = (
                not self._has_depth
                or apart_us <= 0.45 * self._period_us
                or (self._depths and self._depths[-1].timestamp_us >= color.timestamp_us)
                or len(self._colors) > self._limit
            )
            if not certain:
                break
            self._colors.popleft()
            partner = nearest if apart_us <= PAIRING_TOLERANCE_US else None
            if partner is None and self._start_drops_left > 0 and self._has_depth:
                self._start_drops_left -= 1
            else:
                self._start_drops_left = 0
                self._append_frame(frames, color, partner)
            used_up_us = partner.timestamp_us + 1 if partner else color.timestamp_us - PAIRING_TOLERANCE_US
            while self._depths and self._depths[0].timestamp_us < used_up_us:
                self._depths.popleft()
        return frames

    def _append_frame(self, frames: list[Frame], color: DriverImage, depth: DriverImage | None) -> None:
        now_us, missing = color.timestamp_us + self._offset_us, 0
        if self._last_us is not None:
            if now_us <= self._last_us:
                return
            by_time = round((now_us - self._last_us) / self._period_us) - 1
            by_number = color.number - self._last_number - 1 if self._last_number else 0
            missing = max(by_time, by_number, 0)
        depth_raw = None if depth is None else depth.image
        frames.append(Frame(self._index, now_us * 1e-6, color.image, depth_raw, self.layout.depth_unit_m, missing))
        self._index += 1
        self._last_us, self._last_number = now_us, color.number


def camera_from_field_of_view(size_px: tuple[int, int], field_of_view_rad: tuple[float, float] | None) -> Camera | None:
    """Return intrinsics from the driver's field of view, else the default ones; None for another aspect ratio."""
    width, height = size_px
    if field_of_view_rad is None:
        return rescale_camera(DEFAULT_CAMERA, (width, height))
    across, down = field_of_view_rad
    return Camera(
        width / 2.0 / math.tan(across / 2.0),
        height / 2.0 / math.tan(down / 2.0),
        (width - 1) / 2.0,
        (height - 1) / 2.0,
        width,
        height,
        origin="driver",
    )


def camera_from_lens(size_px: tuple[int, int], lens: Lens) -> Camera:
    """Return the camera with the driver's intrinsics; an unknown distortion model is taken as none."""
    model: DistortionModel = next((each for each in DISTORTION_COEFFICIENT_COUNTS if each == lens.model), "plumb_bob")
    known = lens.model == model and len(lens.coefficients) == DISTORTION_COEFFICIENT_COUNTS[model]
    return Camera(
        lens.fx_px,
        lens.fy_px,
        lens.cx_px,
        lens.cy_px,
        *size_px,
        lens.coefficients if known else (0.0,) * DISTORTION_COEFFICIENT_COUNTS[model],
        origin="factory",
        distortion_model=model,
    )


def _make_read_only(image: AnyImage) -> AnyImage:
    image.flags.writeable = False
    return image


GRID_STEP_PX = 8
"""Undistortion is iterative: it is done at each eighth pixel and interpolated. OpenCV interpolates in steps of 1/32, in
which eighths are exact.
"""


class DepthDistorter:
    """Maps undistorted depth (H, W) to the distorted, downscaled colour image.

    Readings are moved, never interpolated: a mean would be between a finger and the table. Pixels without a reading are
    0.
    """

    def __init__(self, camera: Camera, downscale: int = 1) -> None:
        self._maps: tuple[NDArray[np.float32], NDArray[np.float32]] | None = None
        if not camera.is_distorted and downscale == 1:
            return
        width, height = camera.width_px // downscale, camera.height_px // downscale
        across, down = (np.arange(0, side + GRID_STEP_PX, GRID_STEP_PX, dtype=np.float64) for side in (width, height))
        # half-pixel centres: the centre of a pixel is at a whole number
        nodes = (np.stack(np.meshgrid(across, down), axis=-1).reshape(-1, 2) + 0.5) * downscale - 0.5
        straight = camera.undistort(nodes).reshape(len(down), len(across), 2).astype(np.float32)
        u, v = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
        ideal = cv2.remap(straight, u / GRID_STEP_PX, v / GRID_STEP_PX, cv2.INTER_LINEAR)
        self._maps = np.ascontiguousarray(ideal[..., 0]), np.ascontiguousarray(ideal[..., 1])

    def distort(self, depth: NDArray[Any]) -> NDArray[Any]:
        """Return depth (H, W) uint16 as the distorted lens shows it, (H / downscale, W / downscale)."""
        if self._maps is None:
            return depth
        return np.asarray(
            cv2.remap(depth, *self._maps, cv2.INTER_NEAREST, borderMode=cv2.BORDER_CONSTANT, borderValue=0)
        )

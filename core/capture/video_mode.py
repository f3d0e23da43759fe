"""Video modes: sensor, size, rate and pixel format; the numbers are OpenNI2's."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum


class Sensor(IntEnum):
    """Kinds of streams."""

    IR = 1
    COLOR = 2
    DEPTH = 3


class PixelFormat(IntEnum):
    """Pixel formats that occur."""

    DEPTH_1_MM = 100
    DEPTH_100_UM = 101
    RGB888 = 200
    YUV422 = 201
    GRAY8 = 202
    GRAY16 = 203
    JPEG = 204
    YUYV = 205


@dataclass(frozen=True, slots=True)
class VideoMode:
    """Size, rate and pixel format of a stream."""

    pixel_format: int
    width_px: int
    height_px: int
    fps: int

    def __str__(self) -> str:
        names = {int(item): item.name for item in PixelFormat}
        return f"{self.width_px}x{self.height_px} {names.get(self.pixel_format, self.pixel_format)} {self.fps} fps"


@dataclass(frozen=True, slots=True)
class Lens:
    """Intrinsics of the colour images as the driver states them, px, with distortion model and coefficients."""

    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    model: str
    coefficients: tuple[float, ...]

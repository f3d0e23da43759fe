"""Single pictures as files in memory: depth as PNG without loss, colour as JPEG or as PNG without loss."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from carpus.core.types import ByteImage, DepthImage

JPEG_QUALITY = 95
_JPEG = [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY, cv2.IMWRITE_JPEG_SAMPLING_FACTOR, 0x111111]
"""No chroma subsampling: the markers' edges keep their colour."""
_PNG = [cv2.IMWRITE_PNG_COMPRESSION, 1, cv2.IMWRITE_PNG_STRATEGY, cv2.IMWRITE_PNG_STRATEGY_RLE]
"""Fast, and what is black or has no depth costs next to nothing; searching for repetitions finds none in noise."""


def encode_color(color_rgb: ByteImage, *, lossless: bool = False) -> bytes:
    """A colour picture (H, W, 3) as JPEG of quality 95, or as PNG."""
    bgr = cv2.cvtColor(color_rgb, cv2.COLOR_RGB2BGR)
    return _encode(".png", bgr, _PNG) if lossless else _encode(".jpg", bgr, _JPEG)


def encode_depth(depth_raw: DepthImage) -> bytes:
    """A depth picture (H, W) uint16 as PNG."""
    return _encode(".png", depth_raw, _PNG)


def decode_color(data: bytes | memoryview) -> ByteImage | None:
    """Inverse of :func:`encode_color`, read-only; None when it is no colour picture."""
    picture = _decode(data, cv2.IMREAD_COLOR_RGB)
    return picture if picture is not None and picture.ndim == 3 and picture.dtype == np.uint8 else None


def decode_depth(data: bytes | memoryview) -> DepthImage | None:
    """Inverse of :func:`encode_depth`, read-only; None when it is no depth picture."""
    picture = _decode(data, cv2.IMREAD_UNCHANGED)
    return picture if picture is not None and picture.ndim == 2 and picture.dtype == np.uint16 else None


def _encode(kind: str, picture: NDArray[Any], options: list[int]) -> bytes:
    done, data = cv2.imencode(kind, picture, options)
    assert done
    return data.tobytes()


def _decode(data: bytes | memoryview, flags: int) -> NDArray[Any] | None:
    if not data:
        return None
    try:
        picture: NDArray[Any] | None = cv2.imdecode(np.frombuffer(data, np.uint8), flags)
    except cv2.error:
        return None
    if picture is not None:
        picture.flags.writeable = False
    return picture

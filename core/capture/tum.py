"""A stored recording as a TUM RGB-D folder: two lists, two folders of pictures, perhaps a camera file."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from core.camera import Camera
from core.capture.camera_info import CAMERA_FILE, default_camera, read_camera_info
from core.capture.picture_file import read_color, read_depth
from core.capture.source import SourceInfo
from core.errors import (
    CameraFileUnreadable,
    DepthMissing,
    PictureDamaged,
    PictureSizeChanged,
    RecordingEmpty,
    RecordingMissing,
    RecordingUnreadable,
    TimesUnordered,
)
from core.types import SIMULATED, FloatArray, Frame

COLOR_LIST = "rgb.txt"
DEPTH_LIST = "depth.txt"
DEPTH_UNIT_M = 1.0 / 5000.0
PAIRING_LIMIT_S = 0.020
_TIME_ROUNDING_S = 1e-6
"""The lists give microseconds; two times 20 ms apart may differ by a little more in floating point."""
SIMULATED_REMARK = "# simulated by Carpus"
"""A line among the remarks of the lists of a simulated recording."""
_READING_THREADS = 2
_FPS_OF_ONE_PICTURE = 30.0


@dataclass(frozen=True, slots=True)
class StoredFrame:
    """One colour picture of the list, the depth picture nearest to it, and the frames missing before it."""

    timestamp_s: float
    color: Path
    depth: Path | None
    dropped_before: int


class TumFolder:
    """A TUM RGB-D folder as a :class:`core.capture.source.FrameSource`.

    Every colour picture is yielded once. With ``need_depth`` a folder without usable depth is a fault. With
    ``read_ahead`` > 0 that many frames are decoded in advance by two threads. Opening reads the lists, checks
    that every picture is there, and decodes the first; the others are decoded, and checked, as they come.
    """

    def __init__(self, folder: Path, *, need_depth: bool = True, read_ahead: int = 0) -> None:
        if not folder.exists():
            raise RecordingMissing(folder)
        if not folder.is_dir():
            raise RecordingUnreadable(folder, "not a folder")
        self._read_ahead = read_ahead
        color = _read_list(folder / COLOR_LIST)
        if not color:
            raise RecordingEmpty(folder, f"no picture in {COLOR_LIST}")
        depth = _depth_list(folder, need_depth)
        color_s = np.array([time_s for time_s, _ in color])
        partner = nearest_pairs(color_s, np.array([time_s for time_s, _ in depth]))
        if need_depth and not any(index is not None for index in partner):
            raise DepthMissing(folder, f"no depth picture within {PAIRING_LIMIT_S * 1e3:.0f} ms of a colour picture")
        self.stored = tuple(
            StoredFrame(time_s, path, None if index is None else depth[index][1], dropped)
            for (time_s, path), index, dropped in zip(color, partner, missing_before(color_s), strict=True)
        )
        first = read_color(self.stored[0].color)
        self._size = (first.shape[1], first.shape[0])
        self.info = SourceInfo(
            name=folder.resolve().name,
            camera=_camera(folder, *self._size),
            has_depth=any(frame.depth is not None for frame in self.stored),
            frame_count=len(self.stored),
            nominal_fps=1.0 / float(np.median(np.diff(color_s))) if len(color) > 1 else _FPS_OF_ONE_PICTURE,
            settings={"format": "tum", "depth_unit_m": repr(DEPTH_UNIT_M), **_simulated(folder / COLOR_LIST)},
        )

    def frames(self) -> Iterator[Frame]:
        """The frames in order; may be asked for again."""
        if self._read_ahead > 0:
            return self._frames_ahead(self._read_ahead)
        return (self._frame(index) for index in range(len(self.stored)))

    def close(self) -> None:
        """Nothing is held open between two frames."""

    def _frames_ahead(self, bound: int) -> Iterator[Frame]:
        pending: deque[Future[Frame]] = deque()
        with ThreadPoolExecutor(_READING_THREADS, thread_name_prefix="read-ahead") as pool:
            try:
                for index in range(len(self.stored)):
                    pending.append(pool.submit(self._frame, index))
                    if len(pending) > bound:
                        yield pending.popleft().result()
                while pending:
                    yield pending.popleft().result()
            finally:
                for future in pending:
                    future.cancel()

    def _frame(self, index: int) -> Frame:
        stored = self.stored[index]
        color = read_color(stored.color)
        self._check_size(stored.color, color.shape)
        depth = None if stored.depth is None else read_depth(stored.depth)
        if stored.depth is not None and depth is not None:
            self._check_size(stored.depth, depth.shape)
        return Frame(index, stored.timestamp_s, color, depth, DEPTH_UNIT_M, stored.dropped_before)

    def _check_size(self, path: Path, shape: tuple[int, ...]) -> None:
        width, height = self._size
        if shape[:2] != (height, width):
            raise PictureSizeChanged(path, f"{shape[1]} x {shape[0]} pixels, {width} x {height} before")


def nearest_pairs(color_s: FloatArray, depth_s: FloatArray) -> list[int | None]:
    """For each colour time the depth picture that belongs to it: nearest pairs first, each depth used once.

    Both lists rise strictly; pairs further apart than 20 ms are none.

    >>> nearest_pairs(np.array([0.0, 0.033]), np.array([0.004, 0.036]))
    [0, 1]
    """
    limit_s = PAIRING_LIMIT_S + _TIME_ROUNDING_S
    begin = np.searchsorted(depth_s, color_s - limit_s, side="left")
    end = np.searchsorted(depth_s, color_s + limit_s, side="right")
    candidates = sorted(
        (abs(float(depth_s[d] - color_s[c])), c, d) for c in range(len(color_s)) for d in range(begin[c], end[c])
    )
    partner: list[int | None] = [None] * len(color_s)
    used: set[int] = set()
    for _, c, d in candidates:
        if partner[c] is None and d not in used:
            partner[c] = d
            used.add(d)
    return partner


def missing_before(timestamp_s: FloatArray) -> list[int]:
    """Frames missing before each one: a gap of about n median periods lacks n - 1.

    >>> missing_before(np.array([0.0, 0.033, 0.066, 0.165, 0.198]))
    [0, 0, 0, 2, 0]
    """
    if len(timestamp_s) < 2:
        return [0] * len(timestamp_s)
    gap_s = np.diff(timestamp_s)
    return [0, *(max(0, round(float(gap)) - 1) for gap in gap_s / np.median(gap_s))]


def _depth_list(folder: Path, need_depth: bool) -> list[tuple[float, Path]]:
    path = folder / DEPTH_LIST
    depth = _read_list(path) if path.exists() else []
    if need_depth and not depth:
        raise DepthMissing(folder, f"no picture in {DEPTH_LIST}" if path.exists() else f"no {DEPTH_LIST}")
    return depth


def _read_list(path: Path) -> list[tuple[float, Path]]:
    """Times and picture files of ``rgb.txt`` or ``depth.txt``; the times rise strictly and every file is there."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError as cause:
        raise RecordingUnreadable(path, "missing") from cause
    except OSError as cause:
        raise RecordingUnreadable(path, cause.strerror or "cannot be opened") from cause
    except UnicodeDecodeError as cause:
        raise RecordingUnreadable(path, "not a text file") from cause
    entries: list[tuple[float, Path]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.strip()
        if not content or content.startswith("#"):
            continue
        time_s, picture = _entry(path, number, content)
        if entries and time_s <= entries[-1][0]:
            raise TimesUnordered(path, f"line {number}: {time_s:.6f} s after {entries[-1][0]:.6f} s")
        if not picture.is_file():
            raise PictureDamaged(picture, f"missing, {path.name} line {number}")
        entries.append((time_s, picture))
    return entries


def _simulated(color_list: Path) -> dict[str, str]:
    """The setting that says so, for a list that has been read already."""
    with color_list.open(encoding="utf-8-sig") as lines:
        remarks = (line.strip() for line in lines if line.startswith("#"))
        return {SIMULATED: "yes"} if SIMULATED_REMARK in remarks else {}


def _entry(path: Path, number: int, content: str) -> tuple[float, Path]:
    time_text, *names = content.split(maxsplit=1)
    try:
        time_s = float(time_text)
    except ValueError:
        time_s = math.nan
    if not math.isfinite(time_s) or not names:
        raise RecordingUnreadable(path, f"line {number} is not a time and a file name: {content[:60]!r}")
    return time_s, path.parent / names[0]


def _camera(folder: Path, width_px: int, height_px: int) -> Camera:
    path = folder / CAMERA_FILE
    size = f"{width_px} x {height_px} pixels"
    if not path.exists():
        camera = default_camera(width_px, height_px)
        if camera is None:
            raise CameraFileUnreadable(path, f"missing, and pictures of {size} have no default camera")
        return camera
    info = read_camera_info(path)
    camera = info.camera
    if (camera.width_px, camera.height_px) != (width_px, height_px):
        raise CameraFileUnreadable(path, f"for {camera.width_px} x {camera.height_px} pixels, pictures have {size}")
    if info.mirrored or info.registered is False:
        wrong = "mirrored: true" if info.mirrored else "registered: false"
        raise CameraFileUnreadable(path, f"{wrong}, which a folder of pictures cannot be")
    return camera

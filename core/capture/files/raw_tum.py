"""Records a source as a TUM RGB-D folder: an open format, every picture a PNG file, nothing lost."""

from __future__ import annotations

import errno
import shutil
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import TextIO

import numpy as np

from carpus.core.capture.camera_info import CAMERA_FILE, write_camera_info
from carpus.core.capture.files.raw_pictures import encode_color, encode_depth
from carpus.core.capture.files.tum import (
    COLOR_LIST,
    DEPTH_LIST,
    DEPTH_UNIT_M,
    RECORDED_REMARK,
    RECORDING_ID_REMARK,
    SIMULATED_REMARK,
)
from carpus.core.capture.source import SourceInfo, is_simulated
from carpus.core.durable import private
from carpus.core.errors import DiskFull, OutputExists, OutputNotWritable
from carpus.core.types import DepthImage, Frame

_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class TumWriter:
    """Writes one folder. A picture enters its list only when its file is whole, so a crash costs one frame."""

    def __init__(self, path: Path, info: SourceInfo) -> None:
        self._path = path
        self._count = 0
        self._lists: dict[str, TextIO] = {}
        if path.exists():
            raise OutputExists(path)
        try:
            for name, kind in ((COLOR_LIST, "rgb"), (DEPTH_LIST, "depth")):
                (path / kind).mkdir(parents=True)
                self._lists[kind] = open(path / name, "x", encoding="utf-8", opener=private)  # noqa: SIM115  # closed by close
                remark = f"{SIMULATED_REMARK}\n" if is_simulated(info) else ""
                remark += "".join(f"{name}{value}\n" for name, value in _said(info) if value)
                self._lists[kind].write(f"# {kind} pictures of {info.name}\n{remark}# timestamp filename\n")
        except OSError as cause:
            self.abandon()
            raise OutputNotWritable(path, cause.strerror or "") from cause
        write_camera_info(path / CAMERA_FILE, info.camera)

    def __enter__(self) -> TumWriter:
        return self

    def __exit__(self, kind: type[BaseException] | None, fault: BaseException | None, _: TracebackType | None) -> None:
        if kind is None:
            self.close()
        else:
            self.abandon()

    @property
    def path(self) -> Path:
        """The folder."""
        return self._path

    def __len__(self) -> int:
        """Frames written."""
        return self._count

    def append_frame(self, frame: Frame) -> None:
        """Store one frame; times rise strictly."""
        if frame.depth_raw is not None:
            self._store("depth", frame.timestamp_s, encode_depth(tum_depth(frame.depth_raw, frame.depth_unit_m)))
        self._store("rgb", frame.timestamp_s, encode_color(frame.color_rgb, lossless=True))
        self._count += 1

    def close(self) -> None:
        """Close the lists; may be called twice."""
        lists, self._lists = self._lists, {}
        for each in lists.values():
            try:
                each.close()
            except OSError as cause:
                raise _write_fault(self._path, cause) from cause

    def abandon(self) -> None:
        """Stop after a fault; what is on the disk stays readable."""
        for each in self._lists.values():
            with suppress(OSError):
                each.close()
        self._lists = {}

    def discard(self) -> None:
        """Remove the folder again: nothing was recorded."""
        self.abandon()
        shutil.rmtree(self._path, ignore_errors=True)

    def _store(self, kind: str, timestamp_s: float, data: bytes) -> None:
        name = f"{kind}/{timestamp_s:.6f}.png"
        try:
            with open(self._path / name, "wb", opener=private) as file:
                file.write(data)
            self._lists[kind].write(f"{timestamp_s:.6f} {name}\n")
            self._lists[kind].flush()
        except OSError as cause:
            raise _write_fault(self._path, cause) from cause


def _said(info: SourceInfo) -> tuple[tuple[str, str], ...]:
    return (RECORDED_REMARK, info.recorded), (RECORDING_ID_REMARK, info.recording_id)


def tum_depth(depth_raw: DepthImage, depth_unit_m: float) -> DepthImage:
    """Depth in the format's 5000 counts per metre; what lies beyond its 13.1 m becomes 0, no reading."""
    scale = depth_unit_m / DEPTH_UNIT_M
    if abs(scale - 1.0) < 1e-9:
        return depth_raw
    counts = np.rint(depth_raw * scale)
    return np.where(counts > np.iinfo(np.uint16).max, 0, counts).astype(np.uint16)


def _write_fault(path: Path, cause: OSError) -> DiskFull | OutputNotWritable:
    return DiskFull(path) if cause.errno in _FULL else OutputNotWritable(path, cause.strerror or "")

"""An .oni recording as a source of frames, played by the OpenNI2 library in a process of its own."""

from __future__ import annotations

import re
from collections.abc import Generator, Iterator
from contextlib import closing
from pathlib import Path
from typing import Literal

import numpy as np

from carpus.core.capture.camera_info import CameraInfo, read_camera_info
from carpus.core.capture.capture_link import OPEN_FILE_S
from carpus.core.capture.file_player import WAITING_PICTURES, FilePlayer
from carpus.core.capture.frame_assembly import (
    DEPTH_UNIT_M,
    Assembler,
    Layout,
    camera_of_view,
    fitted_camera,
)
from carpus.core.capture.notice import Notice, ignore
from carpus.core.capture.oni_check import OniContents, OniStream, check_recording
from carpus.core.capture.oni_writer import sidecar_path
from carpus.core.capture.openni2_plans import FilePlan
from carpus.core.capture.openni2_process import serve
from carpus.core.capture.source import SourceInfo
from carpus.core.capture.video_mode import Sensor, VideoMode
from carpus.core.errors import (
    CameraFileUnreadable,
    DepthNotRegistered,
    DriverFailed,
    PicturesEnlarged,
    PicturesLost,
    RecordingUnsupported,
    RegistrationAssumed,
)
from carpus.core.phrase import phrase
from carpus.core.types import SIMULATED, Frame

# Finds the damaged JPEG pictures on which the OpenNI2 library dies.
#
# It skips over a marker's segment without looking whether the picture goes that far, and then reads whatever memory
# follows. Other damage it survives. Needed only after it has died: see :class:`core.capture.oni_source.OniSource`.
START, END, SCAN = 0xD8, 0xD9, 0xDA
_MARKER = re.compile(rb"\xff+([^\x00\xff])")
_ALONE = frozenset({0x01, *range(0xD0, 0xD8)})
"""Markers without a segment; the reader goes on behind them."""
_SKIPPED = frozenset({0xDC, 0xFE, *range(0xE0, 0xF0)})
"""Segments that are skipped, by the length they tell."""
_READ = frozenset({0xC4, 0xCC, 0xDB, 0xDD, SCAN, 0xC0, 0xC1, 0xC2, 0xC9, 0xCA})
"""Segments that are read byte by byte, which stops at the picture's end."""


def kills_library(jpeg: bytes) -> bool:
    """Whether a segment that is skipped reaches beyond the picture's end.

    >>> kills_library(bytes.fromhex("ffd8 ffe0 0010 4a46"))
    True
    >>> kills_library(bytes.fromhex("0000 ffe0 0010 4a46"))
    False
    """
    if jpeg[:2] != bytes((0xFF, START)):
        return False
    position = 2
    while (found := _MARKER.search(jpeg, position)) is not None:
        marker, position = found[1][0], found.end()
        if marker in _ALONE:
            continue
        if marker not in _SKIPPED and marker not in _READ:
            return False
        length = int.from_bytes(jpeg[position : position + 2], "big")
        if marker in _SKIPPED and position + max(length, 2) > len(jpeg):
            return len(jpeg) - position >= 2
        position += max(length, 2)
    return False


def deadly_pictures(path: Path, stream: OniStream) -> tuple[int, ...]:
    """Positions in the file of the pictures on which the library dies."""
    with path.open("rb") as file:
        deadly = []
        for position, size in zip(stream.position.tolist(), stream.size_bytes.tolist(), strict=True):
            file.seek(position)
            if kills_library(file.read(size)):
                deadly.append(position)
    return tuple(deadly)


class OniSource:
    """Frames of an .oni file, all of them, in order, as fast as they are read.

    The file is checked at once; the library starts with the first call of :meth:`frames`, which may be repeated,
    one walk at a time. ``registered`` answers for a file without a sidecar; without an answer depth is taken to lie
    on colour and ``notice`` hears :class:`RegistrationAssumed`. Damaged pictures are left out: ``notice`` hears
    :class:`PicturesLost` at the end.
    """

    def __init__(self, path: Path, *, registered: bool | None = None, notice: Notice = ignore) -> None:
        self._contents = check_recording(path)
        self._path = path
        self._notice = notice
        self._streams = {Sensor.COLOR: self._contents.color}
        if self._contents.depth is not None:
            self._streams[Sensor.DEPTH] = self._contents.depth
        self._modes = {
            sensor: VideoMode(stream.pixel_format, stream.width_px, stream.height_px, stream.fps)
            for sensor, stream in self._streams.items()
        }
        self._player = FilePlayer(serve, path, max(stream.frame_bytes for stream in self._streams.values()))
        sidecar = sidecar_path(path)
        told = read_camera_info(sidecar) if sidecar.exists() else None
        self._layout = _layout(self._contents, told)
        times_us = self._contents.color.timestamp_us
        self._period_us = float(np.median(np.diff(times_us))) if len(times_us) > 1 else 1e6 / self._contents.color.fps
        self._info = self._describe(told, registered)

    @property
    def info(self) -> SourceInfo:
        """Facts about the recording."""
        return self._info

    def frames(self) -> Iterator[Frame]:
        """All frames from the first on; a walk under way ends when another begins."""
        deadly: tuple[int, ...] = ()
        count = 0
        while True:
            try:
                with closing(self._walk(deadly)) as walk:
                    for frame in walk:
                        if frame.index == count:
                            count += 1
                            yield frame
                return
            except DriverFailed:
                # it dies on certain damaged pictures: once more without these, on to where it was
                deadly = () if deadly else deadly_pictures(self._path, self._contents.color)
                if not deadly:
                    raise

    def _walk(self, deadly: tuple[int, ...]) -> Generator[Frame]:
        contents, modes = self._contents, self._modes
        last_number = {sensor: int(stream.number[-1]) for sensor, stream in self._streams.items()}
        plan = FilePlan(str(self._path.resolve()), contents.identity, last_number, deadly)
        opened = self._player.open(plan, OPEN_FILE_S)
        if opened is None:
            return
        if dict(opened.modes) != modes:
            self._player.stop()
            raise DriverFailed(self._path, "the library sees other pictures than the file holds")
        assembler = Assembler(self._layout, self._period_us, WAITING_PICTURES)
        if (yield from self._player.frames(assembler, modes)):
            self._tell_lost()

    def close(self) -> None:
        """End playback; may be called twice, and while another thread waits for a frame."""
        self._player.close()

    def _tell_lost(self) -> None:
        arrived, names = self._player.arrived, {Sensor.COLOR: "colour", Sensor.DEPTH: "depth"}
        counts = [
            f"{len(stream) - arrived[sensor]} of {len(stream)} {names[sensor]}"
            for sensor, stream in self._streams.items()
            if arrived[sensor] < len(stream)
        ]
        if counts:
            self._notice(PicturesLost(self._path, ", ".join(counts)))

    def _describe(self, told: CameraInfo | None, answer: bool | None) -> SourceInfo:
        contents, layout = self._contents, self._layout
        view = contents.color.field_of_view_rad or (contents.depth.field_of_view_rad if contents.depth else None)
        camera = fitted_camera(told.camera, layout.size_px) if told else camera_of_view(layout.size_px, view)
        if camera is None:
            size = "{}x{}".format(*layout.size_px)
            if told:
                detail = f"for pictures of {told.camera.width_px}x{told.camera.height_px}, these are {size}"
                raise CameraFileUnreadable(sidecar_path(self._path), detail)
            raise RecordingUnsupported(self._path, phrase("no intrinsics for pictures of {size}", size=size))
        settings = {"format": f".oni {contents.version}", "color": _stream_text(contents, "color")}
        if contents.depth is not None:
            settings["depth"] = _stream_text(contents, "depth")
            settings["registered"] = self._registration(told.registered if told else None, answer)
        settings["mirrored"] = "turned back" if layout.color_mirrored else "no"
        if layout.enlarged:
            settings["enlarged"] = layout.enlarged
            self._notice(PicturesEnlarged(self._path, layout.enlarged))
        if told is not None and told.simulated:
            settings[SIMULATED] = "yes"
        has_depth, count = contents.depth is not None, len(contents.color)
        return SourceInfo(self._path.name, camera, has_depth, count, float(contents.color.fps), settings)

    def _registration(self, told: bool | None, answer: bool | None) -> str:
        registered = told if told is not None else answer
        if registered is None:
            self._notice(RegistrationAssumed(self._path))
            return "assumed"
        if not registered:
            self._notice(DepthNotRegistered(self._path))
        return "yes" if registered else "no"


def _layout(contents: OniContents, told: CameraInfo | None) -> Layout:
    color, depth = contents.color, contents.depth
    mirrored = told.mirrored if told else None
    layout = Layout(
        (color.width_px, color.height_px),
        (depth.width_px, depth.height_px) if depth else None,
        color.mirrored if mirrored is None else mirrored,
        (depth.mirrored if depth else False) if mirrored is None else mirrored,
        DEPTH_UNIT_M[depth.pixel_format] if depth else 1e-3,
    )
    if layout.misfit():
        raise RecordingUnsupported(contents.path, layout.misfit())
    return layout


def _stream_text(contents: OniContents, name: Literal["color", "depth"]) -> str:
    stream = contents.color if name == "color" else contents.depth
    assert stream is not None
    return f"{stream.width_px}x{stream.height_px} {stream.codec} {stream.fps} fps"

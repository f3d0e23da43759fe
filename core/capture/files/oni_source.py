"""An .oni recording as a source of frames, read without the OpenNI2 library, which dies of some damaged files."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO, Literal

import numpy as np
from numpy.typing import NDArray

from carpus.core.capture.camera_info import CameraInfo, read_camera_info, sidecar_path
from carpus.core.capture.files.oni_contents import OniContents, OniStream, identity_of, read_contents
from carpus.core.capture.files.oni_depth_codec import decode_depth
from carpus.core.capture.files.oni_format import Codec
from carpus.core.capture.files.raw_pictures import decode_color
from carpus.core.capture.frame_assembly import (
    DEPTH_UNIT_M,
    WAITING_IN_FILE,
    Assembler,
    Layout,
    camera_of_view,
    fitted_camera,
)
from carpus.core.capture.source import Notice, SourceInfo, ignore
from carpus.core.capture.video_mode import Sensor
from carpus.core.errors import (
    CameraFileUnreadable,
    DepthNotRegistered,
    PicturesEnlarged,
    PicturesLost,
    RecordingDamaged,
    RecordingUnsupported,
    RegistrationAssumed,
)
from carpus.core.phrase import phrase
from carpus.core.types import SIMULATED, Frame


class OniSource:
    """Frames of an .oni file, all of them, in order, as fast as they are read.

    The file's structure is read at once; :meth:`frames` may be repeated, one walk at a time. ``registered`` answers
    for a file without a sidecar; without an answer depth is taken to lie on colour and ``notice`` hears
    :class:`RegistrationAssumed`. Damaged pictures are left out: ``notice`` hears :class:`PicturesLost` at the end.
    """

    def __init__(self, path: Path, *, registered: bool | None = None, notice: Notice = ignore) -> None:
        self._contents = read_contents(path)
        self._path = path
        self._notice = notice
        self._walk: object = None
        self._is_closed = False
        self._streams = {Sensor.COLOR: self._contents.color}
        if self._contents.depth is not None:
            self._streams[Sensor.DEPTH] = self._contents.depth
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
        walk = self._walk = object()
        assembler = Assembler(self._layout, self._period_us, WAITING_IN_FILE)
        takes = {Sensor.COLOR: assembler.color, Sensor.DEPTH: assembler.depth}
        arrived: Counter[Sensor] = Counter()
        try:
            with self._path.open("rb") as file:
                if identity_of(self._path) != self._contents.identity:
                    raise RecordingDamaged(self._path, phrase("the file changes while it is read"))
                for sensor, place in self._in_order():
                    if self._is_closed or self._walk is not walk:
                        return
                    stream = self._streams[sensor]
                    picture = self._picture(file, stream, place)
                    if picture is not None:
                        arrived[sensor] += 1
                        yield from takes[sensor](int(stream.timestamp_us[place]), int(stream.number[place]), picture)
        except OSError as cause:
            raise RecordingDamaged(self._path, cause.strerror or phrase("cannot be opened")) from cause
        yield from assembler.finish()
        self._tell_lost(arrived)

    def close(self) -> None:
        """End playback; may be called twice, and while another thread waits for a frame."""
        self._is_closed = True

    def _in_order(self) -> list[tuple[Sensor, int]]:
        """Each picture by its stream and place there, as they follow each other in the file."""
        places = [
            (position, sensor, place)
            for sensor, stream in self._streams.items()
            for place, position in enumerate(stream.position.tolist())
        ]
        return [(sensor, place) for _, sensor, place in sorted(places)]

    def _picture(self, file: BinaryIO, stream: OniStream, place: int) -> NDArray[Any] | None:
        """One picture, (H, W, 3) uint8 or (H, W) uint16; None where it is damaged."""
        size = int(stream.size_bytes[place])
        file.seek(int(stream.position[place]))
        data = file.read(size)
        if len(data) < size:
            raise RecordingDamaged(self._path, phrase("the file changes while it is read"))
        shape = (stream.height_px, stream.width_px)
        if stream is self._contents.depth:
            return decode_depth(data, stream.codec.encode(), shape)
        if stream.codec.encode() == Codec.JPEG:
            picture = decode_color(data)
            return picture if picture is not None and picture.shape == (*shape, 3) else None
        return np.frombuffer(data, np.uint8).reshape((*shape, 3)) if size == 3 * shape[0] * shape[1] else None

    def _tell_lost(self, arrived: Counter[Sensor]) -> None:
        names = {Sensor.COLOR: "colour", Sensor.DEPTH: "depth"}
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

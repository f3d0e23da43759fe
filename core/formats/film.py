"""A film as MP4 or a picture of it as PNG, by OpenCV; without sound, and without anything that says whose it is."""

from __future__ import annotations

import shutil
from collections.abc import Iterable
from pathlib import Path

import cv2

from carpus.core.durable import replace_file
from carpus.core.errors import OutputNotWritable
from carpus.core.phrase import phrase
from carpus.core.types import ByteImage

CODE = "mp4v"
"""MPEG-4 part 2: what OpenCV itself brings the means for on every system."""


UNFINISHED = "film.part.mp4"
"""Name of what is being written: one at a time, removed when the window opens again after it was killed."""


def write_picture(path: Path, picture: ByteImage) -> Path:
    """Write one picture, RGB, as PNG; raises :class:`OutputNotWritable` or :class:`DiskFull`."""
    data = cv2.imencode(".png", cv2.cvtColor(picture, cv2.COLOR_RGB2BGR))[1].tobytes()
    replace_file(path, lambda place: place.write_bytes(data))
    return path


def write_film(path: Path, pictures: Iterable[ByteImage], rate_hz: float, within: Path) -> Path:
    """Write pictures of one even size, RGB, at a rate; a file that is there is replaced when all is written.

    It grows as :data:`UNFINISHED` in the folder ``within``, never where a killed program would leave it for everybody.
    Raises :class:`OutputNotWritable` or :class:`DiskFull`; nothing half-written stays.
    """
    part = within / UNFINISHED
    writer = None
    try:
        part.touch(mode=0o600)
        for picture in pictures:
            if writer is None:
                size = (picture.shape[1], picture.shape[0])
                writer = cv2.VideoWriter(str(part), cv2.VideoWriter_fourcc(*CODE), rate_hz, size)  # type: ignore[attr-defined]
                if not writer.isOpened():
                    raise OutputNotWritable(path, phrase("no film can be written on this computer"))
            writer.write(cv2.cvtColor(picture, cv2.COLOR_RGB2BGR))
        if writer is None:
            raise OutputNotWritable(path, phrase("there is no picture of it"))
        writer.release()
        replace_file(path, lambda place: shutil.copyfile(part, place))
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause
    finally:
        if writer is not None:
            writer.release()
        part.unlink(missing_ok=True)
    return path

"""A simulated recording as an .oni file, as the camera's own library would have recorded it."""

from __future__ import annotations

import dataclasses
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from carpus.core.capture.camera_info import CAMERA_FILE
from carpus.core.capture.files.tum import TumFolder
from carpus.core.errors import OutputExists
from carpus.core.simulation.oni_writer import ColorCodec, write_oni
from carpus.core.simulation.recording import CLICKS_FILE, TRUTH_FILE, simulate
from carpus.core.simulation.spec import RecordingSpec
from carpus.core.types import Frame

RECORDING_FILE = "recording.oni"
_MILLIMETRE = 1e-3


def simulate_oni(
    spec: RecordingSpec,
    folder: Path,
    progress: Callable[[int, int], None] | None = None,
    *,
    color: ColorCodec = "jpeg",
) -> Path:
    """Make ``recording.oni`` with its sidecar, clicks and truth in ``folder``; the file's path.

    Depth is in whole millimetres, as the device gives it.
    """
    target = folder / RECORDING_FILE
    if target.exists():
        raise OutputExists(target)
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".rendering.", dir=folder) as scratch:
        pictures = Path(scratch) / "tum"
        simulate(spec, pictures, progress)
        source = TumFolder(pictures, read_ahead=4)
        frames = in_millimetres(source.frames())
        write_oni(target, frames, source.info.camera, fps=round(spec.fps), color=color, simulated=True)
        for name in (CLICKS_FILE, TRUTH_FILE, CAMERA_FILE):
            shutil.move(pictures / name, folder / name)
    return target


def in_millimetres(frames: Iterator[Frame]) -> Iterator[Frame]:
    """The frames with their depth in whole millimetres, as the device gives it."""
    for frame in frames:
        depth = frame.depth_raw
        if depth is not None:
            depth = np.rint(depth * (frame.depth_unit_m / _MILLIMETRE)).astype(np.uint16)
        yield dataclasses.replace(frame, depth_raw=depth, depth_unit_m=_MILLIMETRE)

"""TRC for OpenSim: marker positions in millimetres at uniform times, Y up; unknown is an empty cell.

``NAME.trc.json`` states rotation and provenance, for which the format has no place.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from carpus.core.formats.export_item import CAMERA_AXES, ExportItem, format_number
from carpus.core.formats.output_files import open_new_file, write_new_json

ROTATION_UP_CAM = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""Camera axes to OpenSim's: the camera looks down; X stays, Z is down in the image."""
ROTATION_DESCRIPTION = (
    "X_trc = x, Y_trc = -z, Z_trc = y of the colour camera's axes: Y up for a camera that looks straight down; "
    "right-handed, origin at the camera"
)


def write(take: ExportItem, folder: Path) -> list[Path]:
    """Write ``NAME.trc`` and ``NAME.trc.json``; return their paths."""
    path = folder / f"{take.name}.trc"
    with open_new_file(path) as file:
        for line in _lines(take, path.name):
            file.write(line.encode() + b"\n")
    even = take.times
    about = {
        "units": "mm",
        "estimate": "filter",
        "rotation_trc_from_camera": ROTATION_UP_CAM,
        "rotation_means": ROTATION_DESCRIPTION,
        "camera_axes": CAMERA_AXES,
        "sampling": f"even, {even.rate_hz:.6g} a second, on the line between two pictures; empty across a gap",
        "time_zero_timestamp_s": even.start_s,
        "missing": "empty cell",
        "provenance": take.provenance,
    }
    return [path, write_new_json(folder / f"{take.name}.trc.json", about)]


def _lines(take: ExportItem, name: str) -> Iterator[str]:
    session, even = take.session, take.times
    markers = session.header.protocol.markers
    rate, count = f"{even.rate_hz:.6f}", len(even)
    yield f"PathFileType\t4\t(X/Y/Z)\t{name}"
    yield "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames"
    yield f"{rate}\t{rate}\t{count}\t{len(markers)}\tmm\t{rate}\t1\t{count}"
    yield "Frame#\tTime\t" + "\t\t\t".join(markers) + "\t\t"
    yield "\t\t" + "\t".join(f"{axis}{m + 1}" for m in range(len(markers)) for axis in "XYZ")
    yield ""
    place_mm = 1e3 * even.interpolate(session.markers.position_cam_m) @ ROTATION_UP_CAM.T
    for k, (time_s, row) in enumerate(
        zip(even.elapsed_s.tolist(), place_mm.reshape(count, 3 * len(markers)), strict=True)
    ):
        # A tab ends the row: OpenSim drops an empty cell that nothing follows, and then misses a column.
        yield f"{k + 1}\t{time_s:.6f}\t" + "".join(f"{format_number(value, 4)}\t" for value in row.tolist())

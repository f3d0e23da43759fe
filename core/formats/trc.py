"""TRC of OpenSim: marker positions of a session, and points of other programs.

Written at uniform times in millimetres, Y up; unknown is an empty cell. ``NAME.trc.json`` states rotation and
provenance, for which the format has no place.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from carpus.core.formats.c3d import PointTrack, zeros_to_nan
from carpus.core.formats.export_item import CAMERA_AXES, ExportItem, format_number
from carpus.core.formats.output_files import write_new_json, write_new_text
from carpus.core.formats.table_read import check_times, parse_cell, read_text
from carpus.core.model.errors import ReferenceUnreadable
from carpus.core.model.phrase import phrase

ROTATION_UP_CAM = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""Camera axes to OpenSim's: the camera looks down; X stays, Z is down in the image."""
ROTATION_DESCRIPTION = (
    "X_trc = x, Y_trc = -z, Z_trc = y of the colour camera's axes: Y up for a camera that looks straight down; "
    "right-handed, origin at the camera"
)


_METRES = {"mm": 1e-3, "m": 1.0, "cm": 1e-2}


def write(take: ExportItem, folder: Path) -> list[Path]:
    """Write ``NAME.trc`` and ``NAME.trc.json``; return their paths."""
    path, even = folder / f"{take.name}.trc", take.times
    write_new_text(path, "".join(f"{line}\n" for line in _lines(take, path.name)))
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


def read_trc(path: Path) -> PointTrack:
    """Read the points of a TRC file. Raises :class:`ReferenceUnreadable`."""
    lines = read_text(path).splitlines()
    if len(lines) < 6 or not lines[0].startswith("PathFileType"):
        raise ReferenceUnreadable(path, "no TRC")
    tab = "\t" if "\t" in lines[0] else ","
    head = dict(zip(lines[1].split(tab), lines[2].split(tab), strict=False))
    unit = head.get("Units", "mm").strip().lower()
    if unit not in _METRES:
        raise ReferenceUnreadable(path, phrase("unit {unit}", unit=unit))
    names = [name.strip() for name in lines[3].split(tab)[2:] if name.strip()]
    rows = [line.split(tab) for line in lines[5:] if line.strip(f"{tab} ")]
    width = 2 + 3 * len(names)
    if not names or not rows:
        raise ReferenceUnreadable(path, phrase("no points"))
    try:
        table = np.array([[parse_cell(cell) for cell in (row + [""] * width)[:width]] for row in rows])
    except ValueError as cause:
        raise ReferenceUnreadable(path, str(cause)) from cause
    place_m = table[:, 2:].reshape(len(rows), len(names), 3) * _METRES[unit]
    return PointTrack(check_times(table[:, 1], path), tuple(names), zeros_to_nan(place_m), unit)

"""A session's wrist angles as a table that every program reads."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from core.errors import OutputExists, OutputNotWritable
from core.hand.protocols import WRIST_ANGLES
from core.session.values import Session
from core.types import TrackStatus


def export_csv(session: Session, folder: Path) -> str:
    """Write ``NAME.wrist.csv``: one row for each frame, degrees and seconds; unknown is empty. The file's name.

    Raises :class:`OutputExists` or :class:`OutputNotWritable`.
    """
    path = folder / f"{session.path.stem}.wrist.csv"
    head = ["timestamp_s", "status"]
    columns = [session.timestamp_s[:, None], np.asarray(session.status)[:, None]]
    for motion, prefix in ((session.motion, ""), (session.smoothed, "smoothed_")):
        if motion is not None:
            for values, suffix in ((motion.angles_rad, "deg"), (motion.angles_sd_rad, "sd_deg")):
                head += [f"{prefix}{name}_{suffix}" for name in WRIST_ANGLES]
                columns.append(np.degrees(values))
    rows = np.column_stack(columns)
    try:
        with path.open("x", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerow(head)
            for row in rows:
                status = TrackStatus(int(row[1])).name.lower()
                table.writerow([f"{row[0]:.6f}", status, *("" if np.isnan(v) else f"{v:.3f}" for v in row[2:])])
    except FileExistsError as cause:
        raise OutputExists(path) from cause
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause
    return path.name

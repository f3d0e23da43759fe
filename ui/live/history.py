"""The last seconds of what was tracked, as arrays ready to draw."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from core.output.exercises import STILL_RADIUS_MM
from core.types import FloatArray, TrackedFrame, TrackStatus
from ui.plot.series import Series

SHOWN_S = 10.0
KEPT_S = 11.0
"""A little more than is shown, so that lines run out of the picture instead of ending in it."""
HOME_S = 0.5
"""The forearm's place is the median over this long."""
_TIME, _ANGLES, _SDS, _STATUS, _POSITION, _SPEEDS, _AXES = (
    0,
    slice(1, 4),
    slice(4, 7),
    7,
    slice(8, 11),
    slice(11, 13),
    slice(13, 22),
)
_COLUMNS = 22


class History:
    """Frames in, arrays of the last ten seconds out: degrees, millimetres, seconds of the recording."""

    def __init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        """Forget everything, as before another recording."""
        self._rows = np.empty((0, _COLUMNS))
        self._home_mm = np.full(3, math.nan)
        self.last_index = -1
        self._waited_s = 0.0

    def wait(self, seconds: float) -> None:
        """Time goes on without frames: what is missing grows at the right."""
        self._waited_s += seconds

    def append(self, frames: Sequence[TrackedFrame]) -> None:
        """Add frames in order; what is older than needed goes."""
        fresh = [frame for frame in frames if frame.index > self.last_index]
        if not fresh:
            return
        self.last_index = fresh[-1].index
        self._waited_s = 0.0
        rows = np.concatenate((self._rows, np.array([_row(frame) for frame in fresh])))
        self._rows = rows[rows[:, _TIME] >= rows[-1, _TIME] - KEPT_S]
        if not np.isfinite(self._home_mm).all() and self._rows[-1, _TIME] - self._rows[0, _TIME] >= HOME_S:
            self.set_home()

    def set_home(self) -> None:
        """Take the wrist's present place as the forearm's place at rest."""
        recent = self._rows[self._rows[:, _TIME] >= self.now_s - HOME_S, _POSITION] if len(self._rows) else self._rows
        known = recent[np.isfinite(recent).all(axis=1)] if len(recent) else recent
        if len(known):
            self._home_mm = np.median(known, axis=0)

    @property
    def now_s(self) -> float:
        """The right end of the curves: time of the newest frame, NaN before the first."""
        return float(self._rows[-1, _TIME]) + self._waited_s if len(self._rows) else math.nan

    @property
    def waiting(self) -> bool:
        """Whether time goes on without frames."""
        return self._waited_s > 0.0

    @property
    def angles_deg(self) -> FloatArray:
        """Newest deviation, flexion, pro/supination (3,)."""
        return self._rows[-1, _ANGLES] if len(self._rows) else np.full(3, math.nan)

    @property
    def sds_deg(self) -> FloatArray:
        """Their standard deviations (3,)."""
        return self._rows[-1, _SDS] if len(self._rows) else np.full(3, math.nan)

    @property
    def status(self) -> TrackStatus:
        """Of the newest frame; lost before the first."""
        return TrackStatus(int(self._rows[-1, _STATUS])) if len(self._rows) else TrackStatus.LOST

    @property
    def speeds(self) -> FloatArray:
        """Newest linear speed in mm/s and angular speed in degrees per second (2,)."""
        return self._rows[-1, _SPEEDS] if len(self._rows) else np.full(2, math.nan)

    def angle(self, column: int) -> Series:
        """One angle with its band."""
        rows = self._rows
        return Series(
            rows[:, _TIME], rows[:, 1 + column], rows[:, 4 + column], rows[:, _STATUS] == TrackStatus.PREDICTED
        )

    def speed(self, column: int) -> Series:
        """Linear (0) or angular (1) speed; the filter gives no deviation for them."""
        rows = self._rows
        return Series(rows[:, _TIME], rows[:, 11 + column], None, rows[:, _STATUS] == TrackStatus.PREDICTED)

    def path_mm(self) -> FloatArray:
        """Places of the wrist from its home over the shown time (n, 3), gaps as NaN."""
        rows = self._rows[self._rows[:, _TIME] >= self.now_s - SHOWN_S] if len(self._rows) else self._rows
        return rows[:, _POSITION] - self._home_mm

    def axes(self) -> FloatArray:
        """Axes of W2 in W0 as columns over the shown time (n, 3, 3)."""
        rows = self._rows[self._rows[:, _TIME] >= self.now_s - SHOWN_S] if len(self._rows) else self._rows
        return rows[:, _AXES].reshape(-1, 3, 3)

    def from_home_mm(self) -> float:
        """Distance of the wrist from its home now."""
        if not len(self._rows):
            return math.nan
        return float(np.linalg.norm(self._rows[-1, _POSITION] - self._home_mm))

    def forearm_moved(self) -> bool:
        """Whether the wrist is outside the ball it must stay in."""
        distance = self.from_home_mm()
        return math.isfinite(distance) and distance > STILL_RADIUS_MM


def _row(frame: TrackedFrame) -> FloatArray:
    row = np.empty(_COLUMNS)
    row[_TIME] = frame.timestamp_s
    row[_ANGLES] = np.degrees(frame.angles_rad)
    row[_SDS] = np.degrees(frame.angles_sd_rad)
    row[_STATUS] = frame.status
    row[_POSITION] = 1000.0 * frame.position_m
    row[11] = 1000.0 * float(np.linalg.norm(frame.velocity_m_s))
    row[12] = math.degrees(float(np.linalg.norm(frame.angular_velocity_rad_s)))
    row[_AXES] = frame.rotation_w2_w0.ravel()
    if frame.status == TrackStatus.LOST:
        row[_ANGLES] = row[_SDS] = row[_POSITION] = row[_SPEEDS] = row[_AXES] = math.nan
    return row

"""One session to export, and its rows at uniform times for formats that need them.

Gaps stay gaps.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from carpus.core.formats.output_files import MACHINE_DIALECT, TableDialect
from carpus.core.measures.manual_measurements import ManualValue
from carpus.core.model.camera import Camera
from carpus.core.model.types import FloatArray
from carpus.core.results.repetition_rows import with_time_offset
from carpus.core.results.session_results import SessionResults
from carpus.core.session.values import Event, Session

DEFAULT_RATE_HZ = 30.0
WHOLE_RATE_TOLERANCE = 0.01
"""A rate this near to a whole number is that number: time stamps jitter, cameras do not."""
MAX_STEP = 1.75
"""In frame periods; between rows further apart nothing was recorded."""
MAX_OWN_STEP = 0.5
"""In frame periods; a frame stands for the uniform time nearest to its own."""
SAME_TIME_STEP = 1e-3
"""In frame periods; a time this near to a row is that row's."""


@dataclass(frozen=True, slots=True)
class UniformTimes:
    """K times ``start_s + k / rate_hz``.

    ``before`` and ``after`` (K,): rows around each time, -1 in a gap; ``fraction`` (K,) of the way between them.
    """

    start_s: float
    rate_hz: float
    before: np.ndarray
    after: np.ndarray
    fraction: FloatArray

    def __len__(self) -> int:
        return len(self.fraction)

    @property
    def elapsed_s(self) -> FloatArray:
        """Times (K,) after the first."""
        return np.arange(len(self)) / self.rate_hz

    @property
    def row_index(self) -> np.ndarray:
        """Nearest row (K,), for values that cannot be averaged, -1 in a gap."""
        return np.where(self.fraction <= 0.5, self.before, self.after)

    def interpolate(self, values: FloatArray, is_angular: bool = False) -> FloatArray:
        """Interpolate ``values`` (N, ...) linearly at the times (K, ...); NaN in a gap.

        If one of two rows is unknown the nearer one is used. ``is_angular`` takes the shorter way round the circle
        (radians).
        """
        if not len(values):
            return np.full((len(self), *values.shape[1:]), np.nan)
        first, second = values[self.before], values[self.after]
        step = np.where((self.before == self.after).reshape(-1, *(1,) * (values.ndim - 1)), 0.0, second - first)
        if is_angular:
            step = np.remainder(step + math.pi, 2.0 * math.pi) - math.pi
        share = self.fraction.reshape(-1, *(1,) * (values.ndim - 1))
        out = first + share * step
        # Where the row further away is lost: the nearest row's, which is not half a step away.
        out = np.where(np.isfinite(out), out, np.where(share > 0.5, second, first))
        out[self.before < 0] = np.nan
        return np.asarray(out, dtype=np.float64)


def frame_rate_hz(session: Session) -> float:
    """Return the camera's frame rate, missing frames included."""
    count = len(session)
    if count < 2:
        return DEFAULT_RATE_HZ
    steps = count - 1 + int(np.maximum(session.quality.dropped_before[1:], 0).sum())
    rate = steps / float(session.timestamp_s[-1] - session.timestamp_s[0])
    whole = round(rate)
    return float(whole) if whole and abs(rate - whole) <= WHOLE_RATE_TOLERANCE * whole else rate


def uniform_times(timestamp_s: FloatArray, rate_hz: float) -> UniformTimes:
    """Return uniform times from the first to the last of increasing times (N,).

    They are laid through the middle of the jittering time stamps, so a recording without gaps has one for each frame;
    the outermost may lie half a period outside.
    """
    count = len(timestamp_s)
    if not count:
        none = np.empty(0, dtype=np.int64)
        return UniformTimes(math.nan, rate_hz, none, none, np.empty(0))
    start_s = float(timestamp_s[0])
    place = (timestamp_s - start_s) * rate_hz  # in steps, so that nothing is lost of times that count from 1970
    middle = float(np.median(place - np.rint(place)))
    wanted = middle + np.arange(math.floor(place[-1] - middle + 0.5) + 1, dtype=np.float64)
    start_s += middle / rate_hz
    if count == 1:
        none = np.zeros(1, dtype=np.int64)
        return UniformTimes(start_s, rate_hz, none, none, np.zeros(1))
    after = np.clip(np.searchsorted(place, wanted - SAME_TIME_STEP), 1, count - 1)
    before = after - 1
    for row in (before, after):  # a time on a row is that row's, whatever lies beside it
        on_row = np.abs(place[row] - wanted) <= SAME_TIME_STEP
        before, after = np.where(on_row, row, before), np.where(on_row, row, after)
    span = np.where(before == after, 1.0, place[after] - place[before])
    share = np.where(before == after, 0.0, (wanted - place[before]) / span)
    gap = (span > MAX_STEP) & (share >= 0.0) & (share <= 1.0)
    # At the edges of a gap a time that is some row's own, up to how the stamps waver, has that row: it was recorded.
    leaving, coming = gap & (share * span <= MAX_OWN_STEP), gap & ((1.0 - share) * span <= MAX_OWN_STEP)
    after, before = np.where(leaving, before, after), np.where(coming, after, before)
    missing = gap & ~leaving & ~coming
    share = np.where(leaving | coming, 0.0, share)
    return UniformTimes(start_s, rate_hz, np.where(missing, -1, before), np.where(missing, -1, after), share)


CAMERA_AXES = "axes of the colour camera: x right, y down in its picture, z forward"
W0_AXES = (
    "W0, the hand's axes at the neutral pose: origin WRIST disc, X to the MCP3 disc, Z out of the back of the hand"
)
ANGLE_DEFINITIONS = (
    "deviation + radial, flexion + flexion, pronosupination + supination from the palm down (thumb up is + 90), on "
    "both hands; "
    "ZYX Euler angles of the hand W2 in W0; joints: zero is the straight finger, + bends, + spreads to the thumb's side"
)


@dataclass(frozen=True, slots=True)
class ExportItem:
    """Session to export; ``name`` is the stem of all its files."""

    session: Session
    results: SessionResults
    name: str
    provenance: Mapping[str, Any]
    manual_measurements: tuple[ManualValue, ...] = ()
    """Manual measurements on the day of the session, of its hand and of the person."""
    source_camera: Camera | None = None
    """Camera whose pixels the file has; that of the session may be a generic one."""
    dialect: TableDialect = MACHINE_DIALECT

    @property
    def times(self) -> UniformTimes:
        return uniform_times(self.session.timestamp_s, frame_rate_hz(self.session))


def repetition_events(item: ExportItem) -> list[Event]:
    """Return start, peak and end of every repetition as events on the clock of the frames."""
    if not len(item.session):
        return []
    start_s, out = float(item.session.timestamp_s[0]), []
    for number, one in enumerate(item.results.repetitions, 1):
        text = f"{number}" if one.row.counted else f"{number}, not counted: {one.row.reason.replace('_', ' ')}"
        row = with_time_offset(one.row, start_s)
        for kind, time_s in (("start", row.start_s), ("peak", row.peak_s), ("end", row.end_s)):
            if math.isfinite(time_s):
                out.append(Event(time_s, f"repetition_{kind}", text))
    return out


def joint_centres_cam_m(session: Session) -> FloatArray:
    """Return joint centres and tips (N, M, 3) in camera axes; (N, 0, 3) without fingers."""
    calibration = session.calibration
    turned = session.motion.joint_position_m @ calibration.rotation_w0_cam.T
    return np.asarray(turned + calibration.translation_w0_cam_m)


def is_measured(session: Session) -> np.ndarray:
    """Return whether each marker was seen in each frame, (N, M)."""
    return np.asarray(np.isfinite(session.markers.measured_px).all(axis=-1))


def format_number(value: float, digits: int) -> str:
    """Format a number of a table; unknown is empty, and there is no minus zero.

    >>> format_number(-0.0001, 3), format_number(float("nan"), 3)
    ('0.000', '')
    """
    if value != value:
        return ""
    text = f"{value:.{digits}f}"
    return text[1:] if text.startswith("-") and not text.strip("-0.") else text

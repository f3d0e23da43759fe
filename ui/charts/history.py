"""Last seconds of tracked frames, wrist and fingers, as arrays ready to draw."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Literal

import numpy as np

from carpus.core.measures.signals import BoolArray
from carpus.core.measures.wrist_centre import DEFAULT_CENTRE_M, estimate_wrist_centre, rotation_in_w0
from carpus.core.model.hand.exercises import STILL_RADIUS_MM, Exercise, get_exercise
from carpus.core.model.hand.forearm_rotation import to_clinical_wrist_angles
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import FloatArray, TrackedFrame, TrackStatus
from carpus.ui.charts.series import MAX_STEP_S, Series
from carpus.ui.words.finger_angles import (
    FINGER_ANGLES,
    angle_weights,
    estimate_finger_angles,
    find_measured_angles,
    joint_names,
)

VISIBLE_S = 10.0
# A little more than is shown, so that lines leave the chart at its edge.
BUFFER_S = 11.0
MarkerVisibility = Literal["seen", "partly", "hidden"]
# Marker visibility is averaged over this time: occluded after 0.3 s, visible again as fast.
VISIBILITY_WINDOW_S = 0.4
MIN_VISIBLE_FRACTION, MIN_PARTLY_VISIBLE_FRACTION = 0.75, 0.25
# Small panels draw ten points a second, about two pixels each.
POINT_INTERVAL_S = 0.1
# The forearm's rest position is the median over this time.
HOME_S = 0.5
FIT_INTERVAL_S = 1.0
# The wrist's rotation centre is fitted once a second to at most this many poses, spread over all frames.
FIT_POSES = 600
_TIME, _ANGLES, _SDS, _STATUS, _POSITION, _AXES = 0, slice(1, 4), slice(4, 7), 7, slice(8, 11), slice(11, 20)
_POSE = slice(8, 20)
_SPEEDS = slice(20, 22)
_COLUMNS = 22


class History:
    """Buffer of tracked frames, returned as arrays over the last ten seconds.

    Degrees, millimetres, and seconds of the recording. Finger angles are indexed as in
    :data:`ui.words.finger_angles.FINGER_ANGLES`; without finger markers all are NaN.
    """

    def __init__(self, protocol: MarkerProtocol) -> None:
        self.clear(protocol)

    def clear(
        self, protocol: MarkerProtocol, exercise: Exercise | None = None, start_angles_rad: FloatArray | None = None
    ) -> None:
        """Start again for a protocol, an exercise and the start position of the wrist (3,) in rad."""
        self._protocol, self._exercise = protocol, exercise or get_exercise("")
        self._start_rad = np.zeros(3) if start_angles_rad is None else start_angles_rad
        self._rows = np.empty((0, _COLUMNS))
        self._index = np.empty(0, dtype=np.int64)
        self._fingers = _FingerSamples.from_frames(protocol, ())
        self._weights = angle_weights(protocol.joint_names())
        self._home_mm = np.full(3, math.nan)
        self._home_rotation = np.full((3, 3), math.nan)
        self._centre_mm = 1000.0 * DEFAULT_CENTRE_M
        self._poses: list[FloatArray] = []
        self._pose_stride, self._pose_count, self._last_fit_s = 1, 0, -math.inf
        self.last_index = -1
        self._waited_s = 0.0

    def add_waiting_time(self, seconds: float) -> None:
        """Advance the time axis while no frames arrive."""
        self._waited_s += seconds

    def append(self, frames: Sequence[TrackedFrame]) -> None:
        """Add new frames in order and drop those older than the buffer."""
        fresh = [frame for frame in frames if frame.index > self.last_index]
        if not fresh:
            return
        self.last_index = fresh[-1].index
        self._waited_s = 0.0
        known, more = self._fingers, _FingerSamples.from_frames(self._protocol, fresh)
        if more.value_deg.shape[1]:
            self._weights = angle_weights(joint_names(self._protocol, len(fresh[-1].kinematics.joint_angles_rad)))
        more_rows = np.array([_to_row(frame) for frame in fresh])
        read_rad = to_clinical_wrist_angles(np.radians(more_rows[:, _ANGLES]), self._exercise, self._start_rad)
        more_rows[:, _ANGLES] = np.degrees(read_rad)
        self._rows = np.concatenate((self._rows, more_rows))
        self._collect_poses(more_rows)
        self._index = np.concatenate((self._index, [frame.index for frame in fresh]))
        self._fingers = known.append(more) if len(known.value_deg) else more
        recent = self._rows[:, _TIME] >= self._rows[-1, _TIME] - BUFFER_S
        if not recent.all():
            self._rows, self._index, self._fingers = (
                self._rows[recent],
                self._index[recent],
                self._fingers.select(recent),
            )
        if self.has_fingers:
            of_late = self._rows[:, _TIME] >= self._rows[-1, _TIME] - VISIBILITY_WINDOW_S
            self._visible_fraction = np.asarray(self._fingers.is_visible[of_late].mean(axis=0))
            self._has_visible_markers = find_measured_angles(
                self._protocol, self._visible_fraction[None] >= MIN_PARTLY_VISIBLE_FRACTION
            )[0]
        if not np.isfinite(self._home_mm).all() and self._rows[-1, _TIME] - self._rows[0, _TIME] >= HOME_S:
            self.set_home()

    def set_home(self) -> None:
        """Take the wrist's present position as the forearm's rest position."""
        recent = self._rows[self._rows[:, _TIME] >= self.end_s - HOME_S]
        known = recent[np.isfinite(recent[:, _POSITION]).all(axis=1)]
        if len(known):
            self._home_mm = np.median(known[:, _POSITION], axis=0)
            self._home_rotation = np.nanmedian(recent[:, _AXES], axis=0).reshape(3, 3)

    def __len__(self) -> int:
        return len(self._rows)

    @property
    def has_fingers(self) -> bool:
        return bool(self._fingers.value_deg.shape[1] > 0)

    @property
    def end_s(self) -> float:
        """Time at the right end of the curves; NaN before the first frame."""
        return float(self._rows[-1, _TIME]) + self._waited_s if len(self._rows) else math.nan

    @property
    def is_waiting(self) -> bool:
        return self._waited_s > 0.0

    @property
    def _last_row(self) -> FloatArray:
        return self._rows[-1] if len(self._rows) else np.full(_COLUMNS, math.nan)

    @property
    def angles_deg(self) -> FloatArray:
        """Newest deviation, flexion and pronation-supination (3,)."""
        return self._last_row[_ANGLES]

    @property
    def sds_deg(self) -> FloatArray:
        """Standard deviations of the newest angles (3,)."""
        return self._last_row[_SDS]

    @property
    def status(self) -> TrackStatus:
        """Track status of the newest frame; lost before the first."""
        return TrackStatus(int(self._last_row[_STATUS])) if len(self._rows) else TrackStatus.LOST

    @property
    def speeds(self) -> FloatArray:
        """Newest linear speed in mm/s and angular speed in degrees per second (2,)."""
        return self._last_row[_SPEEDS]

    def speed_series(self, column: int) -> Series:
        """Return linear (0) or angular (1) speed over time, without standard deviation."""
        rows = self._rows
        return Series(rows[:, _TIME], rows[:, _SPEEDS][:, column], None, rows[:, _STATUS] == TrackStatus.PREDICTED)

    def angle_series(self, column: int) -> Series:
        rows = self._rows
        return Series(
            rows[:, _TIME], rows[:, 1 + column], rows[:, 4 + column], rows[:, _STATUS] == TrackStatus.PREDICTED
        )

    # --- fingers ------------------------------------------------------------------------------------------
    def finger_series(self, *, speeds: bool = False) -> list[Series]:
        """Return the visible time of all finger angles, or of their absolute speeds in degrees per second."""
        rows, hand, now_s = self._rows, self._fingers, self.end_s
        if not self.has_fingers:
            return [Series(np.empty(0), np.empty(0), None, np.empty(0, dtype=bool))] * len(FINGER_ANGLES)
        frame_s = float(rows[-1, _TIME] - rows[0, _TIME]) / max(int(self._index[-1] - self._index[0]), 1)
        every = max(1, int(POINT_INTERVAL_S / frame_s + 0.25)) if frame_s > 0.0 else 1
        longest_s = MAX_STEP_S + 2 * (every - 1) * frame_s  # what is left out at both ends of a gap is none
        part = (rows[:, _TIME] >= now_s - VISIBLE_S) & (self._index % every == 0)
        predicted = ~hand.is_measured[part] | self._weights.is_inferred
        values = np.abs(hand.speed_deg_s[part]) if speeds else hand.value_deg[part]
        return [
            Series(rows[part, _TIME] - now_s, value, None if speeds else sd, dashed, longest_s, now_s)
            for value, sd, dashed in zip(values.T, hand.sd_deg[part].T, predicted.T, strict=True)
        ]

    def angle_value(self, index: int) -> tuple[float, float, bool]:
        """Return the newest angle, its standard deviation, and whether its markers have been visible recently."""
        hand = self._fingers
        if not len(self._rows) or not self.has_fingers:
            return math.nan, math.nan, False
        value, sd = float(hand.value_deg[-1, index]), float(hand.sd_deg[-1, index])
        shown = bool(self._has_visible_markers[index]) and self.status == TrackStatus.TRACKED
        return value, sd, shown and math.isfinite(value)

    def is_inferred(self, index: int) -> bool:
        """Return whether the angle is computed from another joint."""
        return bool(self._weights.is_inferred[index])

    def marker_visibility(self) -> dict[str, MarkerVisibility]:
        """Return how visible each marker has been recently."""
        if not len(self._rows) or not self.has_fingers:
            return dict.fromkeys(self._protocol.markers, "hidden")
        return {
            name: "seen"
            if part >= MIN_VISIBLE_FRACTION
            else "hidden"
            if part < MIN_PARTLY_VISIBLE_FRACTION
            else "partly"
            for name, part in zip(self._protocol.markers, self._visible_fraction.tolist(), strict=True)
        }

    # --- forearm ------------------------------------------------------------------------------------------
    def _collect_poses(self, rows: FloatArray) -> None:
        """Collect poses for the fit; drop every second one when they become too many."""
        for row in rows:
            if np.isfinite(row[_POSITION]).all() and int(row[_STATUS]) == TrackStatus.TRACKED:
                if self._pose_count % self._pose_stride == 0:
                    self._poses.append(row[_POSE])
                self._pose_count += 1
        if len(self._poses) > FIT_POSES:
            self._poses, self._pose_stride = self._poses[::2], 2 * self._pose_stride
        if len(self._poses) > 1 and self.end_s - self._last_fit_s >= FIT_INTERVAL_S:
            self._last_fit_s = self.end_s
            poses = np.array(self._poses)
            turned = poses[:, 3:].reshape(-1, 3, 3)
            found = estimate_wrist_centre(1e-3 * poses[:, :3], turned, np.ones(len(poses), dtype=bool))
            self._centre_mm = 1000.0 * found.centre_w2_m

    def has_forearm_moved(self) -> bool:
        """Return whether the wrist's rotation centre has left its rest position.

        The marker above it moves with every flexion.
        """
        if not len(self._rows):
            return False
        row = self._rows[-1]
        turned = (row[_AXES].reshape(3, 3) - self._home_rotation) @ self._centre_mm
        return bool(np.linalg.norm(row[_POSITION] - self._home_mm + turned) > STILL_RADIUS_MM)


@dataclass(frozen=True, slots=True)
class _FingerSamples:
    """Finger angles (n, F) and marker visibility (n, M); F is 0 without finger markers."""

    value_deg: FloatArray
    sd_deg: FloatArray
    speed_deg_s: FloatArray
    is_measured: BoolArray
    is_visible: BoolArray

    @staticmethod
    def from_frames(protocol: MarkerProtocol, frames: Sequence[TrackedFrame]) -> _FingerSamples:
        joints = len(frames[-1].kinematics.joint_angles_rad) if frames else 0
        if not joints:
            none = np.empty((len(frames), 0))
            return _FingerSamples(none, none, none, none.astype(bool), none.astype(bool))
        _, value, sd, measured, seen = estimate_finger_angles(protocol, frames)
        weight = angle_weights(joint_names(protocol, joints)).weight
        speed = np.degrees(np.array([frame.kinematics.joint_velocity_rad_s for frame in frames]) @ weight.T)
        return _FingerSamples(value, sd, np.where(np.isfinite(value), speed, math.nan), measured, seen)

    def append(self, more: _FingerSamples) -> _FingerSamples:
        return _FingerSamples(*(np.concatenate((getattr(self, f.name), getattr(more, f.name))) for f in fields(self)))

    def select(self, part: BoolArray) -> _FingerSamples:
        return _FingerSamples(*(getattr(self, f.name)[part] for f in fields(self)))


def _to_row(frame: TrackedFrame) -> FloatArray:
    row = np.empty(_COLUMNS)
    row[_TIME] = frame.timestamp_s
    row[_ANGLES] = np.degrees(frame.kinematics.angles_rad)
    row[_SDS] = np.degrees(frame.kinematics.angles_sd_rad)
    row[_STATUS] = frame.status
    row[_POSITION] = 1000.0 * frame.kinematics.position_m
    row[_AXES] = rotation_in_w0(frame.kinematics.rotation_w2_w0, frame.kinematics.w0_turn_rad).ravel()
    row[_SPEEDS] = (
        1000.0 * math.hypot(*frame.kinematics.velocity_m_s),
        math.degrees(math.hypot(*frame.kinematics.angular_velocity_rad_s)),
    )
    if frame.status == TrackStatus.LOST:
        row[_ANGLES] = row[_SDS] = row[_POSITION] = row[_AXES] = row[_SPEEDS] = math.nan
    return row

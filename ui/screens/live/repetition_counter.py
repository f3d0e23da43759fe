"""Repetitions, best values and duration of a running recording, computed as in the review."""

from __future__ import annotations

import math
from array import array
from collections.abc import Sequence

import numpy as np

from carpus.core.measures.finger_range import MIN_FURTHER_RAD
from carpus.core.measures.repetitions import find_repetitions
from carpus.core.measures.signals import MAX_ANGLE_SD_RAD, MAX_FILLED_GAP_S, SETTLING_S, resample_evenly
from carpus.core.model.hand.exercises import FLEXION, PRONOSUPINATION, Exercise
from carpus.core.model.hand.forearm_rotation import to_clinical_wrist_angles
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import TrackedFrame, TrackStatus
from carpus.ui.words.finger_angle_estimates import estimate_finger_angles
from carpus.ui.words.finger_angles import FINGER_ANGLES, find_finger_angle

_ZERO_START_ANGLES = np.zeros(3)


class RepetitionCounter:
    """Collects recorded frames; counts once a second."""

    def __init__(self, exercise: Exercise, protocol: MarkerProtocol | None = None) -> None:
        self._protocol, self._exercise = protocol or exercise.protocol, exercise
        self.angle = FLEXION if exercise.angle is None else exercise.angle
        self.joint = exercise.joint
        self._figure = FINGER_ANGLES.index(find_finger_angle(exercise.joint)) if exercise.joint else -1
        self._counts = exercise.has_repetitions
        self._times, self._values, self._valid = array("d"), array("d"), array("b")
        self.repetitions = 0
        self.found_count = 0
        """Present count; a repetition may turn out to be none with later frames."""
        self.last_end_s = math.nan
        """End of the last repetition, on the clock of the frames."""
        self.duration_s = 0.0
        self.best_positive_deg = math.nan
        self.best_negative_deg = math.nan
        self._passive_spans_s: list[tuple[float, float]] = []
        self._max_hidden_rad = -math.inf
        self._last_visible_s, self._visible_again_s = math.inf, -math.inf

    @property
    def is_best_lower_bound(self) -> bool:
        """True if the trained joint may have moved further than the best value while hidden."""
        best_rad = math.radians(self.best_positive_deg) if math.isfinite(self.best_positive_deg) else 0.0
        return self._max_hidden_rad > best_rad + MIN_FURTHER_RAD

    def set_passive(self, time_s: float, *, passive: bool) -> None:
        """Exclude movements from a time on, while somebody else moves the hand."""
        if self._is_passive(time_s):
            self._passive_spans_s[-1] = (self._passive_spans_s[-1][0], time_s)
        if passive:
            self._passive_spans_s.append((time_s, math.inf))

    def _is_passive(self, time_s: float) -> bool:
        return any(start <= time_s < end for start, end in self._passive_spans_s)

    def append(self, frames: Sequence[TrackedFrame]) -> None:
        for frame, (value, sd, valid) in zip(frames, self._read_angles(frames), strict=True):
            if self._times and frame.timestamp_s <= self._times[-1]:
                continue
            if self._times:
                # A pause leaves a long step between two frames; it is not recorded time.
                self.duration_s += min(frame.timestamp_s - self._times[-1], 0.2)
            valid = valid and math.isfinite(value) and sd <= MAX_ANGLE_SD_RAD
            self._times.append(frame.timestamp_s)
            self._values.append(value)
            self._valid.append(valid)
            if self._is_passive(frame.timestamp_s):
                self._is_settling(frame.timestamp_s)
            elif valid and not self._is_settling(frame.timestamp_s):
                self._update_best(math.degrees(value))
            elif not valid and self._figure >= 0 and math.isfinite(value + sd):
                self._max_hidden_rad = max(self._max_hidden_rad, value + sd)

    def _is_settling(self, time_s: float) -> bool:
        """Tell whether the hand was hidden just before: such frames give no best value."""
        if time_s - self._last_visible_s > MAX_FILLED_GAP_S:
            self._visible_again_s = time_s
        self._last_visible_s = time_s
        return time_s - self._visible_again_s <= SETTLING_S

    def update_count(self) -> int:
        """Count full repetitions.

        For joints the tracked angle is used also while hidden, as in the review: a fist hides its own end.
        """
        if self._counts and len(self._times) > 2:
            valid = None if self._figure >= 0 else np.array(self._valid, dtype=bool)
            signal = resample_evenly(np.array(self._times), np.array(self._values), valid)
            every = find_repetitions(signal).repetitions if len(signal.time_s) else ()
            found = [one for one in every if not self._is_passive(0.5 * (one.start_s + one.end_s))]
            self.found_count = len(found)
            self.last_end_s = found[-1].end_s if found else math.nan
            self.repetitions = max(self.repetitions, self.found_count)  # what was done stays done
        return self.repetitions

    def _read_angles(self, frames: Sequence[TrackedFrame]) -> list[tuple[float, float, bool]]:
        """Return the trained angle, its sd (both in radians) and whether it was measured, per frame."""
        if self._figure >= 0 and frames and len(frames[0].kinematics.joint_angles_rad):
            _, value_deg, sd_deg, measured, _ = estimate_finger_angles(self._protocol, frames)
            column = self._figure
            value, sd = np.radians(value_deg[:, column]).tolist(), np.radians(sd_deg[:, column]).tolist()
            return list(zip(value, sd, measured[:, column].tolist(), strict=True))
        return [
            (
                float(
                    to_clinical_wrist_angles(frame.kinematics.angles_rad, self._exercise, _ZERO_START_ANGLES)[
                        self.angle
                    ]
                ),
                float(frame.kinematics.angles_sd_rad[self.angle]),
                frame.status == TrackStatus.TRACKED,
            )
            for frame in frames
        ]

    def _update_best(self, value_deg: float) -> None:
        turns = self.angle == PRONOSUPINATION and self._figure < 0  # it begins at 90 degrees of one direction
        if value_deg >= 0.0 or turns:
            self.best_positive_deg = float(np.fmax(self.best_positive_deg, value_deg))
        if value_deg < 0.0 or turns:
            self.best_negative_deg = float(np.fmin(self.best_negative_deg, value_deg))

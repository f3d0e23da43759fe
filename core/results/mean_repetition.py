"""The mean repetition of one angle over a session: every counted repetition on the same scale from start to end.

Degrees. NaN where too few repetitions were seen: what the camera did not see is never filled in.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from carpus.core.measures.fingers import bending_weights
from carpus.core.measures.motion_range import FEWEST_FOR_SPREAD
from carpus.core.measures.signals import LONGEST_GAP_S
from carpus.core.measures.validity import valid_wrist_angles
from carpus.core.results.ranges import bending_joints, is_total
from carpus.core.results.repetition_rows import ShownRepetition
from carpus.core.results.seen import JointCurves, best_motion, joint_curves, seen_well
from carpus.core.session.values import Session
from carpus.core.types import FloatArray

Quantity = tuple[str, int]
"""What is drawn: a joint angle or ``TAM3`` by its name in every file and -1, or nothing and the wrist's column."""
POINTS = 101
"""Per cent of the repetition, both ends included."""
LEAST_SEEN_SHARE = 0.5
"""Share of the counted repetitions that must have been seen at a point for a mean there."""


@dataclass(frozen=True, slots=True)
class MeanRepetition:
    """``share`` (P,) 0 to 1 of the repetition; ``mean_deg``, ``sd_deg`` (P,) over the repetitions seen there and how
    many these are, ``seen`` (P,); ``count`` repetitions in all. ``sd_deg`` is NaN below three."""

    share: FloatArray
    mean_deg: FloatArray
    sd_deg: FloatArray
    seen: np.ndarray
    count: int

    @property
    def known(self) -> bool:
        """Whether there is anything to draw."""
        return bool(np.isfinite(self.mean_deg).any())


@dataclass(frozen=True, slots=True)
class SeenAngles:
    """The angles of a session with NaN where they were not seen well enough to be measured: ``time_s`` (N,) after the
    first frame, ``wrist_deg`` (N, 3), ``joints`` of the whole hand."""

    time_s: FloatArray
    wrist_deg: FloatArray
    joints: JointCurves | None

    def of(self, quantity: Quantity) -> FloatArray:
        """One angle (N,); all NaN where the session does not have it."""
        joint, angle = quantity
        if not joint:
            return self.wrist_deg[:, angle]
        if self.joints is None:
            return np.full(len(self.time_s), np.nan)
        if is_total(joint):
            return _total_bending(self.joints, int(joint.removeprefix("TAM")))
        if joint not in self.joints.names:
            return np.full(len(self.time_s), np.nan)
        column = self.joints.names.index(joint)
        return np.where(self.joints.seen[:, column], self.joints.angles_deg[:, column], np.nan)


def seen_angles(session: Session) -> SeenAngles:
    """What of a session counts as seen, by the rules of its ranges."""
    time_s, motion = session.timestamp_s - session.timestamp_s[:1], best_motion(session)
    valid = valid_wrist_angles(seen_well(session), motion.angles_rad, motion.angles_sd_rad)
    return SeenAngles(time_s, np.degrees(np.where(valid, motion.angles_rad, np.nan)), joint_curves(session))


def mean_repetition(
    time_s: FloatArray, value_deg: FloatArray, repetitions: Sequence[ShownRepetition], points: int = POINTS
) -> MeanRepetition:
    """Mean and sd over the counted repetitions of an angle (N,), each from its start (0) to its end (1).

    Between samples no further apart than the longest gap that counts as seen the angle goes straight; further apart it
    is unknown.
    """
    share = np.linspace(0.0, 1.0, points)
    counted = [repetition for repetition in repetitions if repetition.counts and repetition.end_s > repetition.start_s]
    rows = np.array(
        [_between(time_s, value_deg, rep.start_s + share * (rep.end_s - rep.start_s)) for rep in counted]
    ).reshape(len(counted), points)
    known = np.isfinite(rows)
    seen = known.sum(axis=0)
    fewest = max(min(FEWEST_FOR_SPREAD, len(counted)), LEAST_SEEN_SHARE * len(counted), 1)
    enough = seen >= fewest
    safe = np.where(known, rows, 0.0)
    mean = np.where(enough, safe.sum(axis=0) / np.maximum(seen, 1), np.nan)
    off = np.where(known, rows - mean, 0.0)
    spread = np.sqrt((off**2).sum(axis=0) / np.maximum(seen - 1, 1))
    sd = np.where(enough & (seen >= FEWEST_FOR_SPREAD), spread, np.nan)
    return MeanRepetition(share, mean, sd, seen, len(counted))


def _between(time_s: FloatArray, value: FloatArray, at_s: FloatArray) -> FloatArray:
    """The value (n,) at times, straight between known neighbours that are near enough, else NaN."""
    known = np.flatnonzero(np.isfinite(value))
    if not len(known):
        return np.full(len(at_s), np.nan)
    times, values = time_s[known], value[known]
    after = np.clip(np.searchsorted(times, at_s), 0, len(times) - 1)
    before = np.clip(np.searchsorted(times, at_s, side="right") - 1, 0, len(times) - 1)
    period = float(np.median(np.diff(time_s))) if len(time_s) > 1 else 0.0
    near = times[after] - times[before] <= LONGEST_GAP_S + 1.5 * period
    outside = np.maximum(times[0] - at_s, at_s - times[-1])
    out = np.where(near & (outside <= period), np.interp(at_s, times, values), np.nan)
    return np.asarray(out, dtype=np.float64)


def _total_bending(joints: JointCurves, finger: int) -> FloatArray:
    """Sum of a finger's bending (N,) where all its joints were seen; an end joint without a disc is two thirds of the
    middle joint."""
    names, inferred = bending_joints(finger, joints.names)
    if not set(names) <= set(joints.names):
        return np.full(len(joints.time_s), np.nan)
    columns = [joints.names.index(name) for name in names]
    bend = np.where(joints.seen[:, columns], np.maximum(joints.angles_deg[:, columns], 0.0), np.nan)
    return np.asarray(bend @ bending_weights(len(columns), inferred=inferred))

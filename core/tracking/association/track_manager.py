"""When a hand counts as seen, coasted or lost, found again and confirmed, by what it shows."""

from __future__ import annotations

import math
from enum import Enum, auto

import numpy as np

from carpus.core.model import so3
from carpus.core.model.types import FloatArray, TrackStatus
from carpus.core.tracking.association.reacquire import FoundPalm, TurnLimits

COLLINEAR_RMS_M = 0.008
"""Discs that lie as near (rms) to one line say nothing of turning about it."""
MIN_PALM_MARKERS = 3
"""That tell the pose of the palm; below a frame is predicted."""
PROBATION_S = 0.2
"""A hand found again out of nothing must keep showing for so long,"""
CONFIRMATION_S = 0.09
"""and four discs among those of fingers, before they are believed."""
DIRECT_SHARE_WINDOW_S = 1.0
"""Over which the share of direct measurements is told."""
VAGUE_SD_RAD = 0.15
"""Expecting the turn less surely the filter may settle on wrong names or at a wrong pose."""
MAX_TRUSTED_SD_RAD = 0.5
"""Less surely sigma points reach too far for a correction to be trusted even by the right names."""
AMBIGUOUS_SD_RAD: tuple[float, ...] = (0.1, 0.1, 0.15, 0.35, 0.5, 0.5)
"""Less surely any so many blobs would do for discs: none to five of them."""
AMBIGUOUS_WITH_FINGERS_SD_RAD: tuple[float, ...] = (0.1, 0.06, 0.15, 0.25, 0.35, 0.5)
"""The same where discs on fingers can look like some of the palm, even like five."""
TURN_SLACK_RAD = 0.35
"""A hand gone from sight is not found turned further than by this"""
MAX_RATE_RAD_S = 12.0
"""and so fast meanwhile."""
MAX_TURN_RAD = 1.9
"""Gone for long, lost, or shown by every disc of the palm it is turned no further from the neutral pose."""


class TrackStage(Enum):
    """What is thought of the one track: seen by so few discs that it may be something else, believed, believed and
    out of sight, given up."""

    TENTATIVE = auto()
    CONFIRMED = auto()
    COASTED = auto()
    LOST = auto()


class TrackManager:
    """Begins, confirms, coasts and deletes the track of one hand; it knows times and counts, and moves no filter.

    ``min_found`` discs by which a hand can be found, ``has_digits``: there are discs on fingers as well.
    """

    def __init__(self, min_found: int, lost_after_s: float, *, has_digits: bool) -> None:
        self._min_found, self._lost_after_s, self._has_digits = min_found, lost_after_s, has_digits
        self._ambiguous_sd_rad = AMBIGUOUS_WITH_FINGERS_SD_RAD if has_digits else AMBIGUOUS_SD_RAD
        self.stage = TrackStage.CONFIRMED
        self._time_s: float | None = None
        self._last_seen_s = self._started_s = self._found_s = -math.inf
        self._is_at_start = True
        self._candidate: tuple[float, FoundPalm] | None = None
        self._candidate_before: tuple[float, FoundPalm] | None = None

    def begin_at_neutral(self, at_s: float | None = None) -> None:
        """A person has the hand at the calibrated pose; at that time, or else with the next frame."""
        if at_s is not None:
            self._time_s = self._last_seen_s = at_s
        self.stage, self._is_at_start = TrackStage.CONFIRMED, True

    @property
    def is_lost(self) -> bool:
        return self.stage is TrackStage.LOST

    def time_step_s(self, timestamp_s: float) -> float:
        """Time since the last frame, 0 at the first."""
        return 0.0 if self._time_s is None else timestamp_s - self._time_s

    def is_timed_out(self, timestamp_s: float) -> bool:
        """Whether no picture came for so long that where the hand was says nothing of where it is."""
        return self._time_s is not None and timestamp_s - self._time_s > self._lost_after_s

    def start_frame(self, timestamp_s: float) -> bool:
        """A frame comes; whether it follows from the one before."""
        self._candidate_before, self._candidate = self._candidate, None
        is_linked, self._is_at_start = not self._is_at_start, False
        if not is_linked:
            self._started_s = timestamp_s
        return is_linked

    def try_initiate(self, found: FoundPalm | None, timestamp_s: float) -> bool:
        """Whether a track begins with what was found without any prediction."""
        if found is None or not self.is_confirmed(found, timestamp_s):
            return False
        self.accept_found(found)
        self._time_s = self._last_seen_s = self._found_s = timestamp_s
        return True

    def accept_found(self, found: FoundPalm) -> None:
        """The track is where a palm was found: by just so many discs as will do it is tentative."""
        self.stage = TrackStage.CONFIRMED if found.count > self._min_found else TrackStage.TENTATIVE

    def is_confirmed(self, found: FoundPalm, timestamp_s: float) -> bool:
        """Whether a palm found out of nothing is to be believed: among the discs of fingers some four often look like
        one, and only the palm goes on doing so."""
        if not self._has_digits or found.count > self._min_found:
            return True
        since_s = timestamp_s
        if self._candidate_before is not None:
            first_s, before = self._candidate_before
            goes_on = angle_between_rad(before.rotation_w2_w0, found.rotation_w2_w0) < TURN_SLACK_RAD
            if goes_on and np.array_equal(before.matched, found.matched):
                since_s = first_s
        self._candidate = since_s, found
        return timestamp_s - since_s >= CONFIRMATION_S

    def turn_limits(self, rotation_w2_w0: FloatArray, timestamp_s: float) -> TurnLimits:
        """How far a hand can have turned since it was last seen; a tentative one anyhow."""
        if self.stage is TrackStage.TENTATIVE:
            return self.widest_turn_limits()
        gone_s = timestamp_s - max(self._last_seen_s, self._started_s)
        most_rad = TURN_SLACK_RAD + MAX_RATE_RAD_S * gone_s
        return (
            TurnLimits(rotation_w2_w0, most_rad, MAX_TURN_RAD) if most_rad < MAX_TURN_RAD else self.widest_turn_limits()
        )

    def widest_turn_limits(self) -> TurnLimits:
        """How far a hand can be turned of which nothing is known."""
        return TurnLimits(np.eye(3), MAX_TURN_RAD, MAX_TURN_RAD)

    def is_vague(self, turn_sd_rad: float) -> bool:
        """Whether a turn was predicted so unsurely that the filter may settle at a wrong one."""
        return turn_sd_rad > VAGUE_SD_RAD

    def is_reacquisition_due(self, seen: int, unassigned: int, turn_sd_rad: float) -> bool:
        """Whether to look for the palm, of which ``seen`` discs are where they were predicted, without a prediction as
        well: ``unassigned`` blobs are left over."""
        few = seen <= MIN_PALM_MARKERS or self.stage is TrackStage.TENTATIVE
        return (few or self.is_vague(turn_sd_rad)) and unassigned + seen > MIN_PALM_MARKERS

    def is_uncertain(self, seen: int, turn_sd_rad: float) -> bool:
        """Whether what shows ``seen`` discs may be another hand: they are few, or it was not seen a moment ago."""
        return seen <= MIN_PALM_MARKERS or self.stage is not TrackStage.CONFIRMED or self.is_vague(turn_sd_rad)

    def can_be_flipped(self, seen: int, unassigned: int) -> bool:
        """Whether blobs are left over for the discs that are not where they were predicted: the knuckles can be where
        they should be and the hand turned over about their line."""
        return seen < len(self._ambiguous_sd_rad) <= seen + unassigned

    def is_ambiguous(self, seen: int, turn_sd_rad: float) -> bool:
        """Whether any so many blobs would do for discs of a hand whose turn was predicted so unsurely."""
        return seen < len(self._ambiguous_sd_rad) and turn_sd_rad > self._ambiguous_sd_rad[seen]

    def is_refuted(self, seen: int, timestamp_s: float) -> bool:
        """Whether the hand was found a moment ago and the next pictures do not bear it out."""
        least = MIN_PALM_MARKERS
        if timestamp_s == self._found_s:
            return seen < least + 1
        return timestamp_s - self._found_s < PROBATION_S and seen < least

    def update_status(self, timestamp_s: float, seen: int, *, is_consistent: bool) -> TrackStatus:
        """The track confirmed, coasted or given up after a frame that showed so many of its discs, where the updated
        pose puts them (``is_consistent``) or not."""
        self._time_s = timestamp_s
        is_believed = self.stage is not TrackStage.TENTATIVE or (seen > self._min_found and is_consistent)
        if seen >= MIN_PALM_MARKERS:
            self._last_seen_s = timestamp_s
            self.stage = TrackStage.CONFIRMED if is_believed else TrackStage.TENTATIVE
            return TrackStatus.TRACKED
        if timestamp_s - max(self._last_seen_s, self._started_s) > self._lost_after_s:
            return TrackStatus.LOST
        self.stage = TrackStage.COASTED if is_believed else TrackStage.TENTATIVE
        return TrackStatus.PREDICTED

    def drop_track(self, timestamp_s: float) -> None:
        """The track is given up."""
        self.stage, self._time_s = TrackStage.LOST, timestamp_s


def angle_between_rad(one: FloatArray, other: FloatArray) -> float:
    """By how much two rotations (3, 3) are turned against each other."""
    return float(np.linalg.norm(so3.log(one.T @ other)))

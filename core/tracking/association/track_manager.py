"""Track management: initiation, confirmation, coasting and deletion of the one track."""

from __future__ import annotations

import logging
import math
from enum import Enum, auto

import numpy as np

from carpus.core.model import so3
from carpus.core.model.types import FloatArray, LossReason, TrackStatus
from carpus.core.tracking.association.reacquire import FoundPalm, TurnLimits

log = logging.getLogger(__name__)

MIN_PALM_MARKERS = 3  # that determine the pose of the palm; with fewer a frame is predicted
PROBATION_S = 0.2  # a track initiated from nothing must go on being measured for so long
CONFIRMATION_S = 0.09  # four markers among those of fingers must be found for so long
DIRECT_SHARE_WINDOW_S = 1.0  # over which the share of direct measurements is reported
VAGUE_SD_RAD = 0.15  # predicted less surely the filter may settle on a wrong association or pose
MAX_TRUSTED_SD_RAD = 0.5  # beyond, sigma points reach too far to trust an update even by the right association
# beyond, any so many blobs would do for markers: none to five of them
AMBIGUOUS_SD_RAD: tuple[float, ...] = (0.1, 0.1, 0.15, 0.35, 0.5, 0.5)
# the same where markers on fingers can look like five of the palm
AMBIGUOUS_WITH_FINGERS_SD_RAD: tuple[float, ...] = (0.1, 0.06, 0.15, 0.25, 0.35, 0.5)
TURN_SLACK_RAD = 0.35  # a hand gone from sight is not found turned further than by this
MAX_RATE_RAD_S = 12.0  # and so fast meanwhile
MAX_TURN_RAD = 1.9  # from the neutral pose, of a hand that was lost or shows every marker of the palm


class TrackStage(Enum):
    """Stage of the track: so few markers that it may be something else, believed, hidden, deleted."""

    TENTATIVE = auto()
    CONFIRMED = auto()
    COASTED = auto()
    LOST = auto()


class TrackManager:
    """Initiates, confirms, coasts and deletes the track; it knows times and counts, and moves no filter.

    ``min_found`` markers by which a hand can be found; ``has_digits``: there are markers on fingers as well.
    """

    def __init__(self, min_found: int, lost_after_s: float, *, has_digits: bool) -> None:
        self._min_found, self._lost_after_s, self._has_digits = min_found, lost_after_s, has_digits
        self._ambiguous_sd_rad = AMBIGUOUS_WITH_FINGERS_SD_RAD if has_digits else AMBIGUOUS_SD_RAD
        self.stage = TrackStage.CONFIRMED
        self.loss_reason: LossReason | None = None
        self._time_s: float | None = None
        self._last_seen_s = self._started_s = self._found_s = -math.inf
        self._is_at_start = True
        self._candidate: tuple[float, FoundPalm] | None = None
        self._candidate_before: tuple[float, FoundPalm] | None = None

    def begin_at_neutral(self, at_s: float | None = None) -> None:
        """Confirm a hand at the calibrated pose, at that time or else with the next frame."""
        if at_s is not None:
            self._time_s = self._last_seen_s = at_s
        self.stage, self._is_at_start = TrackStage.CONFIRMED, True

    @property
    def is_lost(self) -> bool:
        return self.stage is TrackStage.LOST

    def time_step_s(self, timestamp_s: float) -> float:
        """Return the time since the last frame, 0 at the first."""
        return 0.0 if self._time_s is None else timestamp_s - self._time_s

    def is_timed_out(self, timestamp_s: float) -> bool:
        """Return whether no frame came for so long that the old pose says nothing."""
        return self._time_s is not None and timestamp_s - self._time_s > self._lost_after_s

    def start_frame(self, timestamp_s: float) -> bool:
        """Begin a frame; return whether it follows from the one before."""
        self._candidate_before, self._candidate = self._candidate, None
        is_linked, self._is_at_start = not self._is_at_start, False
        if not is_linked:
            self._started_s = timestamp_s
        return is_linked

    def try_initiate(self, found: FoundPalm | None, timestamp_s: float) -> bool:
        """Initiate the track with a palm found without a prediction, if it is confirmed."""
        if found is None or not self.is_confirmed(found, timestamp_s):
            return False
        self.accept_found(found)
        self._time_s = self._last_seen_s = self._found_s = timestamp_s
        return True

    def accept_found(self, found: FoundPalm) -> None:
        """Move the track to a palm that was found; by the fewest markers it is tentative."""
        self.stage = TrackStage.CONFIRMED if found.count > self._min_found else TrackStage.TENTATIVE

    def is_confirmed(self, found: FoundPalm, timestamp_s: float) -> bool:
        """Return whether a palm found without a prediction is to be believed.

        Among the markers of fingers some four often look like a palm, and only the palm goes on doing so.
        """
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
        """Return how far a hand can have turned since it was last measured; a tentative one anyhow."""
        if self.stage is TrackStage.TENTATIVE:
            return self.widest_turn_limits()
        gone_s = timestamp_s - max(self._last_seen_s, self._started_s)
        max_rad = TURN_SLACK_RAD + MAX_RATE_RAD_S * gone_s
        if max_rad >= MAX_TURN_RAD:
            return self.widest_turn_limits()
        return TurnLimits(rotation_w2_w0, max_rad, MAX_TURN_RAD)

    def widest_turn_limits(self) -> TurnLimits:
        """Return how far a hand can be turned of which nothing is known."""
        return TurnLimits(np.eye(3), MAX_TURN_RAD, MAX_TURN_RAD)

    def is_turn_uncertain(self, turn_sd_rad: float) -> bool:
        """Return whether the turn was predicted so unsurely that the filter may settle at a wrong one."""
        return turn_sd_rad > VAGUE_SD_RAD

    def is_reacquisition_due(self, seen: int, unassigned: int, turn_sd_rad: float) -> bool:
        """Return whether to search the palm without a prediction as well.

        ``seen`` markers are where they were predicted, ``unassigned`` blobs are left over.
        """
        few = seen <= MIN_PALM_MARKERS or self.stage is TrackStage.TENTATIVE
        return (few or self.is_turn_uncertain(turn_sd_rad)) and unassigned + seen > MIN_PALM_MARKERS

    def is_weakly_supported(self, seen: int, turn_sd_rad: float) -> bool:
        """Return whether ``seen`` markers may be of another hand: few, or not confirmed a moment ago."""
        return seen <= MIN_PALM_MARKERS or self.stage is not TrackStage.CONFIRMED or self.is_turn_uncertain(turn_sd_rad)

    def can_be_flipped(self, seen: int, unassigned: int) -> bool:
        """Return whether blobs are left for the markers that are not where they were predicted.

        The knuckles can be where they should be and the hand turned over about their line.
        """
        return seen < len(self._ambiguous_sd_rad) <= seen + unassigned

    def is_chance_match(self, seen: int, turn_sd_rad: float) -> bool:
        """Return whether any so many blobs would do for markers of so unsure a prediction."""
        return seen < len(self._ambiguous_sd_rad) and turn_sd_rad > self._ambiguous_sd_rad[seen]

    def find_loss_reason(self, seen: int, timestamp_s: float) -> LossReason | None:
        """Return why the track ends with a frame of ``seen`` markers; None where it goes on."""
        least = MIN_PALM_MARKERS + 1 if timestamp_s == self._found_s else MIN_PALM_MARKERS
        if timestamp_s - self._found_s < PROBATION_S and seen < least:
            return LossReason.UNCONFIRMED_POSE
        unseen_s = timestamp_s - max(self._last_seen_s, self._started_s)
        if seen < MIN_PALM_MARKERS and unseen_s > self._lost_after_s:
            return LossReason.TOO_FEW_MARKERS
        return None

    def update_status(self, timestamp_s: float, seen: int, *, is_consistent: bool) -> TrackStatus:
        """Confirm or coast the track after a frame with ``seen`` markers.

        ``is_consistent``: they lie where the updated pose puts them.
        """
        self._time_s = timestamp_s
        is_believed = self.stage is not TrackStage.TENTATIVE or (seen > self._min_found and is_consistent)
        if seen >= MIN_PALM_MARKERS:
            self._last_seen_s = timestamp_s
            self.stage = TrackStage.CONFIRMED if is_believed else TrackStage.TENTATIVE
            return TrackStatus.TRACKED
        self.stage = TrackStage.COASTED if is_believed else TrackStage.TENTATIVE
        return TrackStatus.PREDICTED

    def drop_track(self, timestamp_s: float, reason: LossReason | None = None) -> None:
        """Delete the track, and log why; one that is lost already keeps its reason."""
        if not self.is_lost and reason is not None:
            self.loss_reason = reason
            log.info("The track was lost at %.2f s: %s.", timestamp_s, reason.value)
        self.stage, self._time_s = TrackStage.LOST, timestamp_s


def angle_between_rad(one: FloatArray, other: FloatArray) -> float:
    """Return the angle between two rotations (3, 3)."""
    return float(np.linalg.norm(so3.log(one.T @ other)))

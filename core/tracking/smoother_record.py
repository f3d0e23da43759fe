"""The smoother's record: what the filter leaves behind of every frame, so that it can be smoothed later."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from carpus.core.tracking.digit_readout import seat_of
from carpus.core.tracking.finger_model import FingerModel
from carpus.core.tracking.finger_smoother import FingerStart, FingerStep, SmoothedFingers, smoothed_fingers
from carpus.core.tracking.motion import PalmMotion
from carpus.core.tracking.palm_smoother import FilterStep, smoothed_palm
from carpus.core.tracking.palm_state import View
from carpus.core.tracking.readout import Readout
from carpus.core.types import Moment


@dataclass(frozen=True, slots=True)
class KeptSteps:
    """Some frames in a row: the palm's and the fingers' steps, and what was believed of the fingers before the first
    (None at the neutral pose)."""

    steps: Sequence[FilterStep]
    fingers: Sequence[FingerStep | None]
    finger_start: FingerStart | None


@dataclass(frozen=True, slots=True)
class SmoothedHand:
    """The hand whose steps are recorded: how its palm moves and is seen, how its fingers do where they are tracked, a
    fresh ``readout``, and the ``lost`` moment, of which nothing is known."""

    motion: PalmMotion
    view: View
    fingers: FingerModel | None
    readout: Callable[[], Readout]
    lost: Moment


class SmootherRecord:
    """Grows by a step a frame; smooths what it holds, forgets, and hands over."""

    def __init__(self, hand: SmoothedHand) -> None:
        self._hand = hand
        self.history: list[FilterStep] = []
        self.finger_history: list[FingerStep | None] = []
        self.smoothed_digits: SmoothedFingers | None = None
        self._finger_start: FingerStart | None = None

    def append(self, step: FilterStep, fingers: FingerStep | None) -> None:
        """One more frame."""
        self.history.append(step)
        self.finger_history.append(fingers)

    def smoothed(self) -> list[Moment]:
        """Every frame so far in the light of all the others. Tracking may go on meanwhile."""
        hand, readout = self._hand, self._hand.readout()
        estimates = smoothed_palm(list(self.history), hand.motion)
        moments = [hand.lost if estimate is None else readout.moment(estimate) for estimate in estimates]
        if hand.fingers is None:
            return moments
        seats = [None if estimate is None else seat_of(estimate, hand.view, readout) for estimate in estimates]
        self.smoothed_digits = smoothed_fingers(
            hand.fingers, self.finger_history[: len(estimates)], seats, self._finger_start
        )
        return [
            hand.lost if joints is None or estimate is None else readout.with_joints(moment, joints, estimate)
            for moment, joints, estimate in zip(moments, self.smoothed_digits.moments, estimates, strict=True)
        ]

    def forget(self, before_s: float) -> None:
        """Give up the frames before that time, which were just smoothed."""
        count = sum(step.timestamp_s < before_s for step in self.history)
        if self.smoothed_digits is not None and self._hand.fingers is not None and count:
            self._finger_start = self.smoothed_digits.start_after(count, self._hand.fingers)
        self._drop(count)

    def hand_over(self, finger_start: FingerStart | None) -> KeptSteps:
        """Give up all frames, to the record of another tracker of the same hand; ``finger_start`` what is believed of
        the fingers now, for the frames to come."""
        kept = KeptSteps(list(self.history), list(self.finger_history), self._finger_start)
        if self.history:
            self._finger_start = finger_start
        self._drop(len(self.history))
        return kept

    def take_over(self, kept: KeptSteps) -> None:
        """Take what another record handed over; it goes on from what was taken before."""
        if not self.history:
            self._finger_start = kept.finger_start
        self.finger_history += kept.fingers
        self.history += kept.steps

    def _drop(self, count: int) -> None:
        if not count:
            return
        self.smoothed_digits = None
        del self.finger_history[:count]
        del self.history[:count]

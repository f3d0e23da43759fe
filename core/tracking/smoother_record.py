"""The smoother's record: what the filter leaves behind of every frame, so that it can be smoothed later."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from carpus.core.tracking.finger_model import FingerModel, seat_of
from carpus.core.tracking.finger_smoother import FingersLookedBack, FingerStart, FingerStep, smoothed_fingers
from carpus.core.tracking.motion import PalmMotion
from carpus.core.tracking.palm_smoother import FilterStep, smoothed_palm
from carpus.core.tracking.palm_view import View
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
        self.looked_back: FingersLookedBack | None = None
        self._finger_start: FingerStart | None = None

    def append(self, step: FilterStep, fingers: FingerStep | None) -> None:
        """One more frame."""
        self.history.append(step)
        self.finger_history.append(fingers)

    def smoothed(self) -> list[Moment]:
        """Every frame so far in the light of all the others. Tracking may go on meanwhile."""
        hand, readout = self._hand, self._hand.readout()
        beliefs = smoothed_palm(list(self.history), hand.motion)
        moments = [hand.lost if belief is None else readout.moment(belief) for belief in beliefs]
        if hand.fingers is None:
            return moments
        seats = [None if belief is None else seat_of(belief, hand.view, readout) for belief in beliefs]
        self.looked_back = smoothed_fingers(
            hand.fingers, self.finger_history[: len(beliefs)], seats, self._finger_start
        )
        return [
            hand.lost if joints is None or belief is None else readout.with_joints(moment, joints, belief)
            for moment, joints, belief in zip(moments, self.looked_back.moments, beliefs, strict=True)
        ]

    def forget(self, before_s: float) -> None:
        """Give up the frames before that time, which were just smoothed."""
        count = sum(step.timestamp_s < before_s for step in self.history)
        if self.looked_back is not None and self._hand.fingers is not None and count:
            self._finger_start = self.looked_back.start_after(count, self._hand.fingers)
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
        self.looked_back = None
        del self.finger_history[:count]
        del self.history[:count]

"""Record of the filter's steps, so that they can be smoothed later."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from carpus.core.model.types import KinematicState
from carpus.core.tracking.digits.digit_readout import base_from_estimate
from carpus.core.tracking.digits.finger_model import FingerModel
from carpus.core.tracking.filter.motion import PalmMotion
from carpus.core.tracking.filter.palm_state import PalmView
from carpus.core.tracking.filter.readout import Readout
from carpus.core.tracking.smoother.finger_smoother import FingerStart, FingerStep, SmoothedFingers, smooth_fingers
from carpus.core.tracking.smoother.palm_smoother import FilterStep, smooth_palm


@dataclass(frozen=True, slots=True)
class FilterSteps:
    """Some frames in a row: steps of palm and fingers, and the fingers before the first.

    ``finger_start`` is None at the neutral pose.
    """

    steps: Sequence[FilterStep]
    fingers: Sequence[FingerStep | None]
    finger_start: FingerStart | None


@dataclass(frozen=True, slots=True)
class SmootherModel:
    """The hand whose steps are recorded: motion and view of its palm, model of its fingers.

    ``make_readout`` returns a fresh readout; ``lost_state`` is the state of which nothing is known.
    """

    motion: PalmMotion
    view: PalmView
    fingers: FingerModel | None
    make_readout: Callable[[], Readout]
    lost_state: KinematicState


class SmootherRecord:
    """Grows by a step a frame; smooths what it holds, discards it, and hands it over."""

    def __init__(self, hand: SmootherModel) -> None:
        self._hand = hand
        self.history: list[FilterStep] = []
        self.finger_history: list[FingerStep | None] = []
        self.smoothed_digits: SmoothedFingers | None = None
        self._finger_start: FingerStart | None = None

    def append(self, step: FilterStep, fingers: FingerStep | None) -> None:
        """Add one frame."""
        self.history.append(step)
        self.finger_history.append(fingers)

    def smooth(self) -> list[KinematicState]:
        """Return every frame so far smoothed by all the others. Tracking may go on meanwhile."""
        hand, readout = self._hand, self._hand.make_readout()
        estimates = smooth_palm(list(self.history), hand.motion)
        moments = [hand.lost_state if estimate is None else readout.read_kinematics(estimate) for estimate in estimates]
        if hand.fingers is None:
            return moments
        bases = [
            None if estimate is None else base_from_estimate(estimate, hand.view, readout) for estimate in estimates
        ]
        self.smoothed_digits = smooth_fingers(
            hand.fingers, self.finger_history[: len(estimates)], bases, self._finger_start
        )
        return [
            hand.lost_state if joints is None or estimate is None else readout.with_joints(moment, joints, estimate)
            for moment, joints, estimate in zip(moments, self.smoothed_digits.joint_states, estimates, strict=True)
        ]

    def discard_before(self, time_s: float) -> None:
        """Discard the frames before that time, which were just smoothed."""
        count = sum(step.timestamp_s < time_s for step in self.history)
        if self.smoothed_digits is not None and self._hand.fingers is not None and count:
            self._finger_start = self.smoothed_digits.start_for_next(count, self._hand.fingers)
        self._drop(count)

    def pop_steps(self, finger_start: FingerStart | None) -> FilterSteps:
        """Remove and return all frames, for the record of another tracker of the same hand.

        ``finger_start`` is the estimate of the fingers now, for the frames to come.
        """
        kept = FilterSteps(list(self.history), list(self.finger_history), self._finger_start)
        if self.history:
            self._finger_start = finger_start
        self._drop(len(self.history))
        return kept

    def append_steps(self, steps: FilterSteps) -> None:
        """Add the steps of another record; it goes on from those added before."""
        if not self.history:
            self._finger_start = steps.finger_start
        self.finger_history += steps.fingers
        self.history += steps.steps

    def _drop(self, count: int) -> None:
        if not count:
            return
        self.smoothed_digits = None
        del self.finger_history[:count]
        del self.history[:count]

"""What the patient shall do next, computed from one snapshot after the other."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

from carpus.core.model.hand.exercises import FLEXION, PRONOSUPINATION, Exercise

Phase = Literal["out", "there", "back", "free", "hidden", "lost", "paused", "done", "rest", "away"]
"""Towards the goal, at it, back; without goal; trained joint hidden at the end of the movement; hand lost; break;
done; rest before the next exercise; nothing measured."""

LOST_AFTER_S = 0.5
FOUND_AFTER_S = 0.3
HOLD_S = 1.2
"""Time that the goal is shown as reached before the return."""
ROUNDED_DEG = 0.5
"""The goal is reached if the rounded number on the therapist's screen says so."""
MIN_MOVEMENT_DEG, MIN_SMALL_MOVEMENT_DEG, MIN_GOAL_SHARE = 12.0, 5.0, 0.3
"""Smaller movements, or smaller shares of the goal, are none."""
TURN_DEG, TURN_SHARE = 3.0, 0.2
"""A hand that has come back this far, and this share of the way, has turned."""
NEUTRAL_SHARE = 0.35
"""The return ends below this share of the way."""


RecordingState = Literal["off", "recording", "paused"]


@dataclass(frozen=True, slots=True)
class ExerciseSnapshot:
    """One look at the hand; degrees, unknown is NaN.

    ``time_s`` on a clock that never stands still. ``value_deg`` of the trained angle with its sign, ``is_measured``
    whether it
    is measured now; ``is_hand_visible`` whether at least the hand is, where the trained joint is not. ``wrist_deg``
    deviation, flexion, pro/supination and ``mean_flexion_deg`` the mean bending of the fingers, for exercises without a
    trained angle. ``done`` full repetitions of ``asked``; ``found_count`` as they
    are counted now, of which one may still turn out to be none. ``countdown_s``: seconds that are still counted down
    to the recording, 0 for none. ``is_late``: nothing is known of this moment, and that is not the patient's doing.
    """

    time_s: float
    value_deg: float = math.nan
    is_measured: bool = False
    is_hand_visible: bool = False
    wrist_deg: tuple[float, float, float] = (math.nan, math.nan, math.nan)
    mean_flexion_deg: float = math.nan
    state: RecordingState = "off"
    done: int = 0
    asked: int = 0
    found_count: int = 0
    countdown_s: int = 0
    is_late: bool = False


@dataclass(frozen=True, slots=True)
class GuideScene:
    """State of the guide.

    ``direction`` is 1 or -1. ``value_deg`` is the trained angle, NaN where no hand is drawn; ``goal_deg`` has its sign,
    NaN for none. ``opacity`` of the hand is 0 to 1. ``is_trial``: nothing is recorded yet.
    """

    phase: Phase = "away"
    direction: int = 1
    value_deg: float = math.nan
    goal_deg: float = math.nan
    opacity: float = 1.0
    wrist_deg: tuple[float, float, float] = (math.nan, math.nan, math.nan)
    mean_flexion_deg: float = math.nan
    is_trial: bool = False
    done: int = 0
    countdown_s: int = 0
    """Seconds left in the countdown."""
    asked: int = 0
    """Repetitions; in a rest between exercises, exercises."""
    rest_share: float = 0.0
    rest_s: int = 0
    """Remaining rest, as a share in tenths and in seconds."""

    @property
    def goal_share(self) -> float:
        """Share of the way to the goal; NaN without a goal or a hand."""
        return self.value_deg / self.goal_deg if self.goal_deg else math.nan


class ExerciseGuide:
    """Follows one exercise; a missed goal is never mentioned."""

    def __init__(self, exercise: Exercise, goal_positive_deg: float, goal_negative_deg: float) -> None:
        self._exercise = exercise
        self._goals = {1: goal_positive_deg, -1: goal_negative_deg}
        self._directions = _find_directions(exercise, self._goals)
        self._direction = self._directions[0]
        self._phase: Phase = "out"
        self._start_deg = self._min_deg = self._peak_deg = self._trough_deg = 0.0
        self._goal_reached_at_s = -math.inf
        self._unsure_since_s: float | None = None
        self._sure_since_s: float | None = None
        self._is_hand_lost = True
        self.goals_reached = 0
        """Number of goals reached, for the sound."""

    def update(self, snapshot: ExerciseSnapshot) -> GuideScene:
        scene = GuideScene(
            direction=self._direction,
            is_trial=snapshot.state == "off",
            done=snapshot.done,
            asked=snapshot.asked,
            countdown_s=snapshot.countdown_s,
        )
        with_goal = replace(scene, goal_deg=self._goals[self._direction])
        if snapshot.state == "paused":
            return replace(with_goal, phase="paused")
        if self._update_lost(snapshot):
            return scene if snapshot.is_late else replace(with_goal, phase="lost")
        if snapshot.state == "recording" and 0 < snapshot.asked <= snapshot.done:
            return replace(scene, phase="done")
        opacity = self._opacity(snapshot)
        if not self._exercise.has_repetitions:
            return replace(
                scene,
                phase="free",
                wrist_deg=snapshot.wrist_deg,
                mean_flexion_deg=snapshot.mean_flexion_deg,
                opacity=opacity,
            )
        if not snapshot.is_measured and self._is_at_far_end() and snapshot.is_hand_visible:
            return replace(with_goal, phase="hidden")
        if snapshot.is_measured:
            self._move(snapshot.value_deg, snapshot.time_s)
        return replace(
            scene,
            phase=self._phase,
            direction=self._direction,
            value_deg=snapshot.value_deg,
            goal_deg=self._goals[self._direction],
            opacity=opacity,
        )

    # --- whether the hand is there ------------------------------------------------------------------------
    def _update_lost(self, snapshot: ExerciseSnapshot) -> bool:
        if self._is_known(snapshot):
            self._unsure_since_s = None
            if self._sure_since_s is None:
                self._sure_since_s = snapshot.time_s
            if self._is_hand_lost and snapshot.time_s - self._sure_since_s >= FOUND_AFTER_S:
                self._is_hand_lost = False
                self._start_stroke(self._direction, snapshot.value_deg if snapshot.is_measured else 0.0)
        else:
            self._sure_since_s = None
            if self._unsure_since_s is None:
                self._unsure_since_s = snapshot.time_s
            if snapshot.time_s - self._unsure_since_s >= LOST_AFTER_S:
                self._is_hand_lost = True
        return self._is_hand_lost

    def _is_known(self, snapshot: ExerciseSnapshot) -> bool:
        if not self._exercise.has_repetitions:
            return snapshot.is_hand_visible
        return snapshot.is_measured or (snapshot.is_hand_visible and not self._is_hand_lost and self._is_at_far_end())

    def _is_at_far_end(self) -> bool:
        """Tell whether a finger is bent so far that the hand hides it from the camera."""
        return bool(self._exercise.joint) and self._peak_deg >= 2.0 * self._min_movement_deg()

    def _opacity(self, snapshot: ExerciseSnapshot) -> float:
        if self._unsure_since_s is None:
            return 1.0
        return max(0.0, 1.0 - (snapshot.time_s - self._unsure_since_s) / LOST_AFTER_S)

    # --- where the hand goes ------------------------------------------------------------------------------
    def _min_movement_deg(self) -> float:
        usual = MIN_SMALL_MOVEMENT_DEG if self._exercise.joint.endswith("abduction") else MIN_MOVEMENT_DEG
        goal = abs(self._goals[self._direction])
        return min(usual, MIN_GOAL_SHARE * goal) if math.isfinite(goal) else usual

    def _min_return_deg(self) -> float:
        return max(TURN_DEG, TURN_SHARE * (self._peak_deg - self._min_deg))

    def _move(self, value_deg: float, at_s: float) -> None:
        along, goal = self._direction * value_deg, abs(self._goals[self._direction])
        if self._phase == "out":
            self._move_outward(along, goal, at_s)
        elif self._phase == "there":
            self._peak_deg = max(self._peak_deg, along)
            if at_s - self._goal_reached_at_s >= HOLD_S or along < goal - self._min_return_deg():
                self._phase, self._trough_deg = "back", along
        elif self._phase == "back":
            self._trough_deg = min(self._trough_deg, along)
            turned, is_two_sided = self._min_return_deg(), -self._direction in self._directions
            if along <= NEUTRAL_SHARE * self._peak_deg:
                self._start_stroke(-self._direction if is_two_sided else self._direction, value_deg)
            elif along > self._trough_deg + turned and self._trough_deg < self._peak_deg - turned:
                self._start_stroke(self._direction, value_deg)

    def _move_outward(self, along: float, goal: float, at_s: float) -> None:
        if along < self._min_deg and self._peak_deg - self._min_deg < self._min_movement_deg():
            self._min_deg = self._peak_deg = along  # still on the way back, or to the other side
        self._peak_deg = max(self._peak_deg, along)
        if math.isfinite(goal) and along >= goal - ROUNDED_DEG:
            self._phase, self._goal_reached_at_s = "there", at_s
            self.goals_reached += 1
        elif (
            self._peak_deg - self._min_deg >= self._min_movement_deg()
            and along < self._peak_deg - self._min_return_deg()
        ):
            self._phase, self._trough_deg = "back", along
        elif -self._direction in self._directions and along < min(
            -self._min_movement_deg(), self._start_deg - self._min_movement_deg()
        ):
            self._start_stroke(-self._direction, along * self._direction)

    def _start_stroke(self, aim: int, value_deg: float) -> None:
        self._direction, self._phase = aim, "out"
        self._start_deg = self._peak_deg = self._min_deg = aim * value_deg


def _find_directions(exercise: Exercise, goals: dict[int, float]) -> tuple[int, ...]:
    """Return the directions with a goal; without goals those of the exercise."""
    asked = tuple(aim for aim in (1, -1) if math.isfinite(goals[aim]))
    if asked:
        return asked
    if exercise.angle is None or exercise.angle == PRONOSUPINATION:
        return (1,)  # a palm that looks down already turns up only; fingers only bend, spread or lift
    return (-1, 1) if exercise.angle == FLEXION else (1, -1)

"""What the patient is to do next, from one look at the hand after the other: no window, no clock of its own."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

from carpus.core.hand.exercises import FLEXION, PRONOSUPINATION, Exercise

Phase = Literal["out", "there", "back", "free", "hidden", "lost", "paused", "done", "rest", "away"]
"""Way to the goal, at it, way back; no goal; the trained joint is out of sight at the far end; the hand is not surely
seen; a break; all repetitions done; rest before the next exercise; nothing is measured of this moment."""

LOST_AFTER_S = 0.5
FOUND_AFTER_S = 0.3
HOLD_S = 1.2
"""So long the goal is held before the way back is shown."""
ROUNDED_DEG = 0.5
"""The goal is reached where the rounded number on the therapist's screen says so."""
LEAST_DEG, LEAST_SMALL_DEG, LEAST_SHARE = 12.0, 5.0, 0.3
"""A movement that is shorter, or a smaller part of the goal, is none yet."""
TURN_DEG, TURN_SHARE = 3.0, 0.2
"""A hand that has come back by so much, and by this part of the way, has turned round."""
NEUTRAL_SHARE = 0.35
"""Back is who has come back to this part of the way."""


RecordingState = Literal["off", "recording", "paused"]


@dataclass(frozen=True, slots=True)
class Glance:
    """One look at the hand; degrees, unknown is NaN.

    ``at_s`` on a clock that never stands still. ``value_deg`` of the trained angle with its sign, ``sure`` whether it
    is measured now; ``hand_seen`` whether at least the hand is, where the trained joint is not. ``wrist_deg``
    deviation, flexion, pro/supination and ``bent_deg`` the mean bending of the fingers, for exercises without a
    trained angle. ``done`` full repetitions of ``asked``; ``found`` as they
    are counted now, of which one may still turn out to be none. ``starts_s``: seconds that are still counted down
    to the recording, 0 for none. ``late``: nothing is known of this moment, and that is not the patient's doing.
    """

    at_s: float
    value_deg: float = math.nan
    sure: bool = False
    hand_seen: bool = False
    wrist_deg: tuple[float, float, float] = (math.nan, math.nan, math.nan)
    bent_deg: float = math.nan
    state: RecordingState = "off"
    done: int = 0
    asked: int = 0
    found: int = 0
    starts_s: int = 0
    late: bool = False


@dataclass(frozen=True, slots=True)
class GuideScene:
    """What is shown. ``aim`` is the direction, 1 or -1; ``value_deg`` of the trained angle, NaN where no hand is to be
    drawn; ``goal_deg`` with its sign, NaN for none; ``opacity`` of the hand, 0 to 1; ``tries``: nothing is recorded
    yet."""

    phase: Phase = "away"
    aim: int = 1
    value_deg: float = math.nan
    goal_deg: float = math.nan
    opacity: float = 1.0
    wrist_deg: tuple[float, float, float] = (math.nan, math.nan, math.nan)
    bent_deg: float = math.nan
    tries: bool = False
    done: int = 0
    starts_s: int = 0
    """Seconds that are still counted down to the recording."""
    asked: int = 0
    """Repetitions; in a rest between exercises, exercises."""
    rest_share: float = 0.0
    rest_s: int = 0
    """What is left of a rest, as a part of it in tenths, and in seconds."""

    @property
    def share(self) -> float:
        """Part of the way to the goal; NaN without a goal or a hand."""
        return self.value_deg / self.goal_deg if self.goal_deg else math.nan


class Guide:
    """Follows one exercise. A missed goal is never said: the way empties on the way back."""

    def __init__(self, exercise: Exercise, goal_positive_deg: float, goal_negative_deg: float) -> None:
        self._exercise = exercise
        self._goals = {1: goal_positive_deg, -1: goal_negative_deg}
        self._aims = _aims(exercise, self._goals)
        self._aim = self._aims[0]
        self._phase: Phase = "out"
        self._start_deg = self._low_deg = self._peak_deg = self._trough_deg = 0.0
        self._reached_at_s = -math.inf
        self._unsure_since_s: float | None = None
        self._sure_since_s: float | None = None
        self._lost = True
        self.reached = 0
        """How often the goal was reached, for a sound."""

    def take(self, glance: Glance) -> GuideScene:
        scene = GuideScene(
            aim=self._aim, tries=glance.state == "off", done=glance.done, asked=glance.asked, starts_s=glance.starts_s
        )
        with_goal = replace(scene, goal_deg=self._goals[self._aim])
        if glance.state == "paused":
            return replace(with_goal, phase="paused")
        if self._is_lost(glance):
            return scene if glance.late else replace(with_goal, phase="lost")
        if glance.state == "recording" and 0 < glance.asked <= glance.done:
            return replace(scene, phase="done")
        opacity = self._opacity(glance)
        if not self._exercise.counts:
            return replace(scene, phase="free", wrist_deg=glance.wrist_deg, bent_deg=glance.bent_deg, opacity=opacity)
        if not glance.sure and self._is_at_far_end() and glance.hand_seen:
            return replace(with_goal, phase="hidden")
        if glance.sure:
            self._move(glance.value_deg, glance.at_s)
        return replace(
            scene,
            phase=self._phase,
            aim=self._aim,
            value_deg=glance.value_deg,
            goal_deg=self._goals[self._aim],
            opacity=opacity,
        )

    # --- whether the hand is there ------------------------------------------------------------------------
    def _is_lost(self, glance: Glance) -> bool:
        if self._is_known(glance):
            self._unsure_since_s = None
            if self._sure_since_s is None:
                self._sure_since_s = glance.at_s
            if self._lost and glance.at_s - self._sure_since_s >= FOUND_AFTER_S:
                self._lost = False
                self._begin(self._aim, glance.value_deg if glance.sure else 0.0)
        else:
            self._sure_since_s = None
            if self._unsure_since_s is None:
                self._unsure_since_s = glance.at_s
            if glance.at_s - self._unsure_since_s >= LOST_AFTER_S:
                self._lost = True
        return self._lost

    def _is_known(self, glance: Glance) -> bool:
        if not self._exercise.counts:
            return glance.hand_seen
        return glance.sure or (glance.hand_seen and not self._lost and self._is_at_far_end())

    def _is_at_far_end(self) -> bool:
        """Whether a finger had gone most of its way, where the hand itself hides it from the camera."""
        return bool(self._exercise.joint) and self._peak_deg >= 2.0 * self._least_deg()

    def _opacity(self, glance: Glance) -> float:
        if self._unsure_since_s is None:
            return 1.0
        return max(0.0, 1.0 - (glance.at_s - self._unsure_since_s) / LOST_AFTER_S)

    # --- where the hand goes ------------------------------------------------------------------------------
    def _least_deg(self) -> float:
        usual = LEAST_SMALL_DEG if self._exercise.joint.endswith("abduction") else LEAST_DEG
        goal = abs(self._goals[self._aim])
        return min(usual, LEAST_SHARE * goal) if math.isfinite(goal) else usual

    def _turn_deg(self) -> float:
        return max(TURN_DEG, TURN_SHARE * (self._peak_deg - self._low_deg))

    def _move(self, value_deg: float, at_s: float) -> None:
        along, goal = self._aim * value_deg, abs(self._goals[self._aim])
        if self._phase == "out":
            self._go_out(along, goal, at_s)
        elif self._phase == "there":
            self._peak_deg = max(self._peak_deg, along)
            if at_s - self._reached_at_s >= HOLD_S or along < goal - self._turn_deg():
                self._phase, self._trough_deg = "back", along
        elif self._phase == "back":
            self._trough_deg = min(self._trough_deg, along)
            turned, is_two_sided = self._turn_deg(), -self._aim in self._aims
            if along <= NEUTRAL_SHARE * self._peak_deg:
                self._begin(-self._aim if is_two_sided else self._aim, value_deg)
            elif along > self._trough_deg + turned and self._trough_deg < self._peak_deg - turned:
                self._begin(self._aim, value_deg)

    def _go_out(self, along: float, goal: float, at_s: float) -> None:
        if along < self._low_deg and self._peak_deg - self._low_deg < self._least_deg():
            self._low_deg = self._peak_deg = along  # still on the way back, or to the other side
        self._peak_deg = max(self._peak_deg, along)
        if math.isfinite(goal) and along >= goal - ROUNDED_DEG:
            self._phase, self._reached_at_s = "there", at_s
            self.reached += 1
        elif self._peak_deg - self._low_deg >= self._least_deg() and along < self._peak_deg - self._turn_deg():
            self._phase, self._trough_deg = "back", along
        elif -self._aim in self._aims and along < min(-self._least_deg(), self._start_deg - self._least_deg()):
            self._begin(-self._aim, along * self._aim)

    def _begin(self, aim: int, value_deg: float) -> None:
        self._aim, self._phase = aim, "out"
        self._start_deg = self._peak_deg = self._low_deg = aim * value_deg


def _aims(exercise: Exercise, goals: dict[int, float]) -> tuple[int, ...]:
    """The directions that are asked for: those with a goal; without any the usual ones, the first to begin with."""
    asked = tuple(aim for aim in (1, -1) if math.isfinite(goals[aim]))
    if asked:
        return asked
    if exercise.angle is None or exercise.angle == PRONOSUPINATION:
        return (1,)  # a palm that looks down already turns up only; fingers only bend, spread or lift
    return (-1, 1) if exercise.angle == FLEXION else (1, -1)

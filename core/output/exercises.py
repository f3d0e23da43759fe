"""What is asked of the hand in each exercise, as facts (clinical reference 8.2); the words are the screen's."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from carpus.core.hand import protocols
from carpus.core.hand.marker_protocol import MarkerProtocol
from carpus.core.hand.sites import DIGITS

DEVIATION, FLEXION, PRONOSUPINATION = 0, 1, 2
"""Columns of the wrist angles, as in every file."""

Movement = Literal["radial", "ulnar", "flexion", "extension", "supination", "pronation", "arc"]

SIDES: tuple[tuple[Movement, Movement], ...] = (
    ("radial", "ulnar"), ("flexion", "extension"), ("supination", "pronation"),
)  # fmt: skip
"""Name of the positive and of the negative direction of each angle."""

AXIS_TICK_DEG = (40.0, 80.0, 80.0)
AXIS_LIMIT_DEG = (50.0, 86.0, 86.0)
"""Outermost tick and end of the fixed axis of each angle on every screen and page."""


@dataclass(frozen=True, slots=True)
class Exercise:
    """One exercise. ``angle`` is the trained column or None (free movement: all three are reported);
    ``trick_limit_deg`` within which the other angles should stay, NaN for none."""

    id: str
    angle: int | None
    repetitions: int
    trick_limit_deg: float
    pure_wrist: bool
    """Whether the forearm must lie still (WRIST disc within a ball of 15 mm)."""
    digits: tuple[int, ...] = ()
    """Thumb (1) to little finger (5): those it moves, which then need their discs; none where the wrist alone does."""
    joint: str = ""
    """The joint angle of the whole hand that is trained, by its name in every file; empty where ``angle`` counts.

    Of a fist the knuckle: seen from above its discs stay in view longest.
    """

    ends_free: bool = False
    """Whether the end joints of the fingers usually do not follow the middle joints in it."""

    @property
    def protocol(self) -> MarkerProtocol:
        """The discs that are put on for it, where nothing else was chosen: the first protocol that allows it."""
        return next(protocol for protocol in protocols.PROTOCOLS if self.is_allowed_by(protocol))

    def is_allowed_by(self, protocol: MarkerProtocol) -> bool:
        """Whether a protocol has the discs it needs, and not those of fingers that it does not move."""
        return protocol.has_fingers == bool(self.digits) and set(self.digits) <= set(protocol.digits)

    @property
    def counts(self) -> bool:
        """Whether repetitions of one angle are counted."""
        return self.angle is not None or bool(self.joint)


_FINGERS = DIGITS[1:]

EXERCISES = (
    Exercise("WRIST_FE", FLEXION, 10, 10.0, True),
    Exercise("WRIST_RU", DEVIATION, 10, 10.0, True),
    Exercise("FOREARM_PS", PRONOSUPINATION, 10, float("nan"), False),
    Exercise("FIST_COMPOSITE", None, 10, float("nan"), False, _FINGERS, "MCP3_flexion"),
    Exercise("FIST_HOOK", None, 10, float("nan"), False, _FINGERS, "PIP3_flexion", ends_free=True),
    Exercise("FINGER_ABAD", None, 10, float("nan"), False, _FINGERS, "MCP2_abduction"),
    Exercise("THUMB_OPP", None, 10, float("nan"), False, DIGITS, "CMC1_abduction"),
    Exercise("REACH_GRASP", None, 5, float("nan"), False, DIGITS),
    Exercise("FREE_HAND", None, 0, float("nan"), False, DIGITS),
    Exercise("FREE", None, 0, float("nan"), False),
)
STILL_RADIUS_MM = 15.0


def exercises_of(protocol: MarkerProtocol) -> tuple[Exercise, ...]:
    """What can be trained with these discs."""
    return tuple(exercise for exercise in EXERCISES if exercise.is_allowed_by(protocol))


def exercise_named(name: str) -> Exercise:
    """The exercise of that id; anything unknown is free movement, so every old session can be opened."""
    return next((exercise for exercise in EXERCISES if exercise.id == name), EXERCISES[-1])

"""Every exercise: what is asked of the hand (clinical reference 8.2), what is told of it, and its words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from typing import Literal

from carpus.core.hand import protocols
from carpus.core.hand.protocols import DIGITS, MarkerProtocol
from carpus.core.phrase import Phrase, phrase

DEVIATION, FLEXION, PRONOSUPINATION = 0, 1, 2
"""Columns of the wrist angles, as in every file."""

Movement = Literal["radial", "ulnar", "flexion", "extension", "supination", "pronation", "arc"]

SIDES: tuple[tuple[Movement, Movement], ...] = (
    ("radial", "ulnar"), ("flexion", "extension"), ("supination", "pronation"),
)  # fmt: skip
"""Name of the positive and of the negative direction of each angle."""


@dataclass(frozen=True, slots=True)
class MovementWords:
    """A movement in a word, with its noun where that word alone is none, and what is missing to neutral that way."""

    name: Phrase
    noun: Phrase
    deficit: Phrase


_FLEXION, _EXTENSION, _ARC = phrase("Flexion"), phrase("Extension"), phrase("Whole arc")
MOVEMENTS: Mapping[str, MovementWords] = {
    "radial": MovementWords(phrase("Radial"), phrase("Radial deviation"), phrase("Radial deviation deficit")),
    "ulnar": MovementWords(phrase("Ulnar"), phrase("Ulnar deviation"), phrase("Ulnar deviation deficit")),
    "flexion": MovementWords(_FLEXION, _FLEXION, phrase("Flexion deficit")),
    "extension": MovementWords(_EXTENSION, _EXTENSION, phrase("Extension deficit")),
    "supination": MovementWords(phrase("Supination"), phrase("Forearm supination"), phrase("Supination deficit")),
    "pronation": MovementWords(phrase("Pronation"), phrase("Forearm pronation"), phrase("Pronation deficit")),
    "arc": MovementWords(_ARC, _ARC, _ARC),
}
ARC_NAMES = (phrase("Side arc"), phrase("Bending arc"), phrase("Forearm rotation"))
"""The whole arc of each angle, where more than one is shown."""
STILL_NAMES = (phrase("Side movement"), phrase("Up and down"), phrase("Rotation from the start"))
"""Each angle where it should stay still."""

AXIS_TICK_DEG = (40.0, 80.0, 80.0)
AXIS_LIMIT_DEG = (50.0, 86.0, 86.0)
"""Outermost tick and end of the fixed axis of each angle on every screen and page."""


_TO_THE_MIDDLE, _BESIDE = phrase("Come back to the middle"), phrase("Further figures")

Further = Literal["reaches", "touches", "spans", "together", "thumb beside"]
"""What is told beside ranges: ways of the wrist, thumb to finger tips, tips apart, fingers together, and how surely the
thumb moves with the fingers while it is hidden."""


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
    _: KW_ONLY
    name: Phrase
    asked: Phrase
    """What the patient is asked to do, as the therapist reads it."""
    position: Phrase
    """How the arm lies before the start."""
    unseen: str = ""
    """What the camera will not see of it, said before it begins; empty where it sees all."""
    adult: tuple[str, str]
    child: tuple[str, str]
    """What the patient's own screen asks for, in the positive direction and in the negative one."""
    back: Phrase = _TO_THE_MIDDLE
    motion: str
    """The simulated patient's movement when it is practised."""
    ends_free: bool = False
    """Whether the end joints of the fingers usually do not follow the middle joints in it."""
    total: bool = True
    """Whether the sum of a finger's bending is its total active motion: not where no fist is asked for."""
    further: tuple[Further, ...] = ()
    further_title: Phrase = _BESIDE
    is_task: bool = False
    """Whether it is about what is told beside the ranges: that comes first then."""

    @property
    def protocol(self) -> MarkerProtocol:
        """The discs that are put on for it, where nothing else was chosen: the first protocol that allows it."""
        return next(protocol for protocol in protocols.PROTOCOLS if self.is_allowed_by(protocol))

    def is_allowed_by(self, protocol: MarkerProtocol) -> bool:
        """Whether a protocol has the discs it needs, and not those of fingers that it does not move."""
        return protocol.has_fingers == bool(self.digits) and set(self.digits) <= set(protocol.digits)

    @property
    def counts(self) -> bool:
        return self.angle is not None or bool(self.joint)


_FINGERS = DIGITS[1:]

EXERCISES = (
    Exercise(
        "WRIST_FE", FLEXION, 10, 10.0, True,
        name=phrase("Wrist flexion–extension"),
        asked=phrase("Bend the wrist up, then down, as far as is comfortable. Keep the forearm still."),
        position=phrase("Forearm on a 10 cm wedge, palm down, hand over the edge, fingers relaxed."),
        adult=(phrase("Bend your hand down"), phrase("Lift your hand up")), child=(phrase("Down"), phrase("Up")),
        motion="flexion",
    ),
    Exercise(
        "WRIST_RU", DEVIATION, 10, 10.0, True,
        name=phrase("Wrist side to side"),
        asked=phrase("Tilt the hand towards the thumb, then towards the little finger. Keep the forearm still."),
        position=phrase("Palm flat on a smooth sheet, forearm strapped."),
        adult=(phrase("Tilt your hand towards your thumb"), phrase("Tilt your hand towards your little finger")),
        child=(phrase("To the thumb"), phrase("To the little finger")),
        motion="deviation",
    ),
    Exercise(
        "FOREARM_PS", PRONOSUPINATION, 10, math.nan, False,
        name=phrase("Pronation–supination"),
        asked=phrase("Turn the palm up as far as the markers stay visible, then back."),
        position=phrase("Elbow at the side, forearm free, palm down under the camera."),
        unseen=phrase(
            "Angles are counted from thumb up: palm flat on the table is 90° pronation. Seen from above, the markers "
            "go out of sight at about 25° of pronation. A target short of thumb up has a minus: supination −25°."
        ),
        adult=(phrase("Turn your palm up"), phrase("Turn your palm down")),
        child=(phrase("Turn up"), phrase("Turn down")),
        back=phrase("Turn your hand back"), motion="palm_up",
    ),
    Exercise(
        "FIST_COMPOSITE", None, 10, math.nan, False, _FINGERS, "MCP3_flexion",
        name=phrase("Full fist"),
        asked=phrase("Close all fingers into a full fist, then open flat."),
        position=phrase("Forearm on the wedge, back of the hand towards the camera, fingers straight."),
        unseen=phrase(
            "At the end of a fist the middle and end joints go out of the camera's sight: repetitions are "
            "counted all the same, and those ranges are given as “at least”. To see more, turn the thumb side "
            "up."
        ),
        adult=(phrase("Close your hand to a fist"),) * 2, child=(phrase("Close"),) * 2,
        back=phrase("Open your hand"), motion="fist",
        further=("together",), further_title=phrase("Fingers together"),
    ),
    Exercise(
        "FIST_HOOK", None, 10, math.nan, False, _FINGERS, "PIP3_flexion",
        name=phrase("Hook fist"),
        asked=phrase("Keep the MCP joints straight. Bend the PIP and DIP joints into a hook, then straighten."),
        position=phrase("Forearm on the wedge, back of the hand towards the camera, fingers straight."),
        unseen=phrase(
            "About half-way the middle joints go out of the camera's sight: repetitions are counted all the "
            "same, and their range is given as “at least”. To see more, raise the wrist or turn the thumb side "
            "up."
        ),
        adult=(phrase("Bend your fingers to a hook"),) * 2, child=(phrase("Hook"),) * 2,
        back=phrase("Straighten your fingers"), motion="hook",
        ends_free=True,
        total=False,
        further=("together",), further_title=phrase("Fingers together"),
    ),
    Exercise(
        "FINGER_ABAD", None, 10, math.nan, False, _FINGERS, "MCP2_abduction",
        name=phrase("Spread the fingers"),
        asked=phrase("Spread the fingers wide, then close them."),
        position=phrase("Palm flat on the table, fingers straight and closed."),
        adult=(phrase("Spread your fingers wide"),) * 2, child=(phrase("Wide"),) * 2,
        back=phrase("Close your fingers"), motion="abduction",
        total=False,
        further=("spans",), further_title=phrase("Spans"),
    ),
    Exercise(
        "THUMB_OPP", None, 10, math.nan, False, DIGITS, "CMC1_abduction",
        name=phrase("Thumb across the palm"),
        asked=phrase("Touch each fingertip with the thumb in turn, opening it wide in between."),
        position=phrase("Forearm on the wedge, thumb side turned up a little, fingers relaxed."),
        unseen=phrase(
            "Under the palm the thumb's tip goes out of the camera's sight: what is trained here is its lift "
            "away from the palm, which stays in view."
        ),
        adult=(phrase("Open your thumb wide"),) * 2, child=(phrase("Thumb wide"),) * 2,
        back=phrase("Touch the next fingertip"), motion="opposition",
        total=False,
        further=("touches", "thumb beside"), further_title=phrase("Thumb to the finger tips"),
        is_task=True,
    ),
    Exercise(
        "REACH_GRASP", None, 5, math.nan, False, DIGITS,
        name=phrase("Reach and grasp"),
        asked=phrase("Reach, take the cup, lift it a little, put it back, return."),
        position=phrase("Hand at its place at the edge, a cup of 5 to 7 cm at 20 to 30 cm."),
        adult=(phrase("Take the cup, lift it a little, put it back"),) * 2, child=(phrase("Take the cup"),) * 2,
        motion="reach_grasp",
        total=False,
        further=("reaches", "thumb beside"), further_title=phrase("Reach and grasp"),
        is_task=True,
    ),
    Exercise(
        "FREE_HAND", None, 0, math.nan, False, DIGITS,
        name=phrase("Free movement of the fingers"),
        asked=phrase("Move the fingers freely. All joint angles are recorded; no repetitions are counted."),
        position=phrase("Hand in view of the camera, back of the hand up, fingers straight."),
        adult=(phrase("Move your fingers as you like"),) * 2, child=(phrase("Move your fingers"),) * 2,
        motion="fingers",
        further=("reaches",),
    ),
    Exercise(
        "FREE", None, 0, math.nan, False,
        name=phrase("Free movement"),
        asked=phrase("Move the wrist freely. All three angles are recorded; no repetitions are counted."),
        position=phrase("Hand in view of the camera, back of the hand up."),
        adult=(phrase("Move your hand as you like"),) * 2, child=(phrase("Move your hand"),) * 2,
        motion="mixed",
        further=("reaches",),
    ),
)  # fmt: skip
STILL_RADIUS_MM = 15.0


def exercises_of(protocol: MarkerProtocol) -> tuple[Exercise, ...]:
    """What can be trained with these discs."""
    return tuple(exercise for exercise in EXERCISES if exercise.is_allowed_by(protocol))


def known_exercise(name: str) -> Exercise | None:
    """The exercise of that id; None where there is none."""
    return next((exercise for exercise in EXERCISES if exercise.id == name), None)


def exercise_named(name: str) -> Exercise:
    """The exercise of that id; anything unknown is free movement, so every old session can be opened."""
    return known_exercise(name) or EXERCISES[-1]

"""Every exercise (clinical reference 8.2): what is asked, what is reported, its words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from typing import Literal

from carpus.core.model.hand import protocols
from carpus.core.model.hand.protocols import DIGITS, MarkerProtocol
from carpus.core.model.phrase import Phrase, phrase

DEVIATION, FLEXION, PRONOSUPINATION = 0, 1, 2  # Columns of the wrist angles, as in every file.

Movement = Literal["radial", "ulnar", "flexion", "extension", "supination", "pronation", "arc"]

# Name of the positive and of the negative direction of each angle.
DIRECTIONS: tuple[tuple[Movement, Movement], ...] = (
    ("radial", "ulnar"), ("flexion", "extension"), ("supination", "pronation"),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class MovementWords:
    """A movement's name, its noun where the name is an adjective, and its deficit to neutral."""

    name: Phrase
    noun: Phrase
    deficit: Phrase


_FLEXION, _EXTENSION, _ARC = phrase("Flexion"), phrase("Extension"), phrase("Total arc")
MOVEMENTS: Mapping[str, MovementWords] = {
    "radial": MovementWords(phrase("Radial"), phrase("Radial deviation"), phrase("Radial deviation deficit")),
    "ulnar": MovementWords(phrase("Ulnar"), phrase("Ulnar deviation"), phrase("Ulnar deviation deficit")),
    "flexion": MovementWords(_FLEXION, _FLEXION, phrase("Flexion deficit")),
    "extension": MovementWords(_EXTENSION, _EXTENSION, phrase("Extension deficit")),
    "supination": MovementWords(phrase("Supination"), phrase("Forearm supination"), phrase("Supination deficit")),
    "pronation": MovementWords(phrase("Pronation"), phrase("Forearm pronation"), phrase("Pronation deficit")),
    "arc": MovementWords(_ARC, _ARC, _ARC),
}
# The whole arc of each angle, where more than one is shown.
ARC_NAMES = (phrase("Radial–ulnar deviation"), phrase("Flexion–extension"), phrase("Forearm rotation"))
# Each angle where it should stay still.
STILL_NAMES = (phrase("Radial–ulnar deviation"), phrase("Flexion–extension"), phrase("Rotation from the start"))

AXIS_TICK_DEG = (40.0, 80.0, 80.0)
AXIS_LIMIT_DEG = (50.0, 86.0, 86.0)  # Outermost tick and end of the fixed axis of each angle on every screen and page.

_FOREARM_LIMIT = phrase("Any movement of the forearm is included in the angle.")
_RETURN_CUE, _TASK_TITLE = phrase("Come back to the middle"), phrase("Additional measures")

# Measures besides ranges: paths of the wrist, thumb to finger tips, tips apart, fingers together, and how surely the
# thumb moves with the fingers while it is hidden.
TaskMeasureKind = Literal["reaches", "touches", "spans", "together", "thumb beside"]


@dataclass(frozen=True, slots=True)
class Exercise:
    """One exercise, with its words for therapist and patient.

    ``angle`` is the trained column of the wrist angles or None (free movement: all three are reported);
    ``trick_limit_deg`` within which the other angles should stay, NaN for none; ``is_forearm_fixed``: the WRIST marker
    must stay within a ball of 15 mm. ``digits`` that move, thumb 1 to little finger 5, need their markers. ``joint`` is
    the trained joint angle of the whole hand by its name in every file; of a fist MCP, whose markers stay in view
    longest. ``instruction`` is read by the therapist, ``position`` says how the arm lies before the start,
    ``limit`` what its values do not tell. ``adult_cues`` and ``child_cues`` are shown to the patient for the
    positive and the negative direction. ``simulated_motion`` is used for practice. ``has_free_dip``: DIP flexion
    usually does not follow PIP flexion. ``has_total_motion``: the sum of a finger's flexion is its total active motion.
    ``is_task``: the task measures come before the ranges.
    """

    id: str
    angle: int | None
    repetitions: int
    trick_limit_deg: float
    is_forearm_fixed: bool
    digits: tuple[int, ...] = ()
    joint: str = ""
    _: KW_ONLY
    name: Phrase
    instruction: Phrase
    position: Phrase
    limit: Phrase
    adult_cues: tuple[str, str]
    child_cues: tuple[str, str]
    return_cue: Phrase = _RETURN_CUE
    simulated_motion: str
    has_free_dip: bool = False
    has_total_motion: bool = True
    task_measures: tuple[TaskMeasureKind, ...] = ()
    task_title: Phrase = _TASK_TITLE
    is_task: bool = False

    @property
    def protocol(self) -> MarkerProtocol:
        """The first marker protocol that allows the exercise."""
        return next(protocol for protocol in protocols.PROTOCOLS if self.is_allowed_by(protocol))

    def is_allowed_by(self, protocol: MarkerProtocol) -> bool:
        """Return whether a protocol has the markers it needs, and none of fingers that it does not move."""
        return protocol.has_fingers == bool(self.digits) and set(self.digits) <= set(protocol.digits)

    @property
    def has_repetitions(self) -> bool:
        return self.angle is not None or bool(self.joint)


_FINGERS = DIGITS[1:]

EXERCISES = (
    Exercise(
        "WRIST_FE", FLEXION, 10, 10.0, True,
        name=phrase("Wrist flexion–extension"),
        instruction=phrase("Bend the wrist up, then down, as far as is comfortable. Keep the forearm still."),
        position=phrase("Forearm on a 10 cm wedge, palm down, hand over the edge, fingers relaxed."),
        limit=_FOREARM_LIMIT,
        adult_cues=(phrase("Bend your hand down"), phrase("Lift your hand up")),
        child_cues=(phrase("Down"), phrase("Up")),
        simulated_motion="flexion",
    ),
    Exercise(
        "WRIST_RU", DEVIATION, 10, 10.0, True,
        name=phrase("Radial–ulnar deviation"),
        instruction=phrase("Tilt the hand towards the thumb, then towards the little finger. Keep the forearm still."),
        position=phrase("Palm flat on a smooth sheet, forearm strapped."),
        limit=_FOREARM_LIMIT,
        adult_cues=(phrase("Tilt your hand towards your thumb"), phrase("Tilt your hand towards your little finger")),
        child_cues=(phrase("To the thumb"), phrase("To the little finger")),
        simulated_motion="deviation",
    ),
    Exercise(
        "FOREARM_PS", PRONOSUPINATION, 10, math.nan, False,
        name=phrase("Pronation–supination"),
        instruction=phrase("Turn the palm up as far as the markers stay visible, then back."),
        position=phrase("Elbow at the side, forearm free, palm down under the camera."),
        limit=phrase("Below about 25° of pronation the markers are occluded. Only the visible part is measured."),
        adult_cues=(phrase("Turn your palm up"), phrase("Turn your palm down")),
        child_cues=(phrase("Turn up"), phrase("Turn down")),
        return_cue=phrase("Turn your hand back"), simulated_motion="palm_up",
    ),
    Exercise(
        "FIST_COMPOSITE", None, 10, math.nan, False, _FINGERS, "MCP3_flexion",
        name=phrase("Full fist"),
        instruction=phrase("Close all fingers into a full fist, then open flat."),
        position=phrase("Forearm on the wedge, back of the hand towards the camera, fingers straight."),
        limit=phrase("At the end of a fist the PIP and DIP joints are occluded. Their ranges are minimum values (≥)."),
        adult_cues=(phrase("Close your hand to a fist"),) * 2, child_cues=(phrase("Close"),) * 2,
        return_cue=phrase("Open your hand"), simulated_motion="fist",
        task_measures=("together",), task_title=phrase("Finger coordination"),
    ),
    Exercise(
        "FIST_HOOK", None, 10, math.nan, False, _FINGERS, "PIP3_flexion",
        name=phrase("Hook fist"),
        instruction=phrase("Keep the MCP joints straight. Bend the PIP and DIP joints into a hook, then straighten."),
        position=phrase("Forearm on the wedge, back of the hand towards the camera, fingers straight."),
        limit=phrase("About half-way the PIP joints are occluded. Their range is a minimum value (≥)."),
        adult_cues=(phrase("Bend your fingers into a hook"),) * 2, child_cues=(phrase("Hook"),) * 2,
        return_cue=phrase("Straighten your fingers"), simulated_motion="hook",
        has_free_dip=True,
        has_total_motion=False,
        task_measures=("together",), task_title=phrase("Finger coordination"),
    ),
    Exercise(
        "FINGER_ABAD", None, 10, math.nan, False, _FINGERS, "MCP2_abduction",
        name=phrase("Spread the fingers"),
        instruction=phrase("Spread the fingers wide, then close them."),
        position=phrase("Palm flat on the table, fingers straight and closed."),
        limit=phrase("The abduction of a flexed finger is unreliable. Keep the fingers straight."),
        adult_cues=(phrase("Spread your fingers wide"),) * 2, child_cues=(phrase("Wide"),) * 2,
        return_cue=phrase("Close your fingers"), simulated_motion="abduction",
        has_total_motion=False,
        task_measures=("spans",), task_title=phrase("Spans"),
    ),
    Exercise(
        "THUMB_OPP", None, 10, math.nan, False, DIGITS, "CMC1_abduction",
        name=phrase("Thumb opposition"),
        instruction=phrase("Touch each fingertip with the thumb in turn. Abduct the thumb fully in between."),
        position=phrase("Forearm on the wedge, thumb side turned up a little, fingers relaxed."),
        limit=phrase("Under the palm the thumb tip is occluded. Palmar abduction of the thumb stays visible."),
        adult_cues=(phrase("Open your thumb wide"),) * 2, child_cues=(phrase("Thumb wide"),) * 2,
        return_cue=phrase("Touch the next fingertip"), simulated_motion="opposition",
        has_total_motion=False,
        task_measures=("touches", "thumb beside"), task_title=phrase("Thumb to the fingertips"),
        is_task=True,
    ),
    Exercise(
        "REACH_GRASP", None, 5, math.nan, False, DIGITS,
        name=phrase("Reach and grasp"),
        instruction=phrase("Reach, take the cup, lift it a little, put it back, return."),
        position=phrase("Hand at the edge of the table. Cup 5 to 7 cm wide, 20 to 30 cm away."),
        limit=phrase("The cup may occlude the thumb. The results show for how long."),
        adult_cues=(phrase("Take the cup, lift it a little, put it back"),) * 2,
        child_cues=(phrase("Take the cup"),) * 2,
        simulated_motion="reach_grasp",
        has_total_motion=False,
        task_measures=("reaches", "thumb beside"), task_title=phrase("Reach and grasp"),
        is_task=True,
    ),
    Exercise(
        "FREE_HAND", None, 0, math.nan, False, DIGITS,
        name=phrase("Free movement of the fingers"),
        instruction=phrase("Move the fingers freely. All joint angles are recorded; no repetitions are counted."),
        position=phrase("Hand in view of the camera, back of the hand up, fingers straight."),
        limit=phrase("Occluded joints are not measured."),
        adult_cues=(phrase("Move your fingers as you like"),) * 2, child_cues=(phrase("Move your fingers"),) * 2,
        simulated_motion="fingers",
        task_measures=("reaches",),
    ),
    Exercise(
        "FREE", None, 0, math.nan, False,
        name=phrase("Free movement"),
        instruction=phrase("Move the wrist freely. All three angles are recorded; no repetitions are counted."),
        position=phrase("Hand in view of the camera, back of the hand up."),
        limit=_FOREARM_LIMIT,
        adult_cues=(phrase("Move your hand as you like"),) * 2, child_cues=(phrase("Move your hand"),) * 2,
        simulated_motion="mixed",
        task_measures=("reaches",),
    ),
)  # fmt: skip
STILL_RADIUS_MM = 15.0


def exercises_for_protocol(protocol: MarkerProtocol) -> tuple[Exercise, ...]:
    """Return the exercises that can be trained with a protocol's markers."""
    return tuple(exercise for exercise in EXERCISES if exercise.is_allowed_by(protocol))


def find_exercise(name: str) -> Exercise | None:
    """Return the exercise of that id; None where there is none."""
    return next((exercise for exercise in EXERCISES if exercise.id == name), None)


def get_exercise(name: str) -> Exercise:
    """Return the exercise of that id; free movement for an unknown one (an old session)."""
    return find_exercise(name) or EXERCISES[-1]

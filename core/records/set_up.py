"""What was chosen before measuring, and for whom; and sets: exercises that run one after the other with the same discs,
as a therapist puts them together, which belong to the clinic and to no patient."""

from __future__ import annotations

import uuid
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from carpus.core.hand.exercises import EXERCISES, Exercise, exercise_named
from carpus.core.hand.protocols import MarkerProtocol, protocol_named, protocol_names
from carpus.core.phrase import phrase
from carpus.core.types import Side

if TYPE_CHECKING:
    from carpus.core.results.progress import Goals


MARKERS_SUFFIX = ".markers.jpg"
"""Ends, in place of ``.h5``, the picture of the discs as they were stuck: the hand and nothing of the room."""
PRACTICE_PATIENT = "practice"
"""Identity of the practice patient: always the last row, simulated camera, nothing counts."""
PRACTICE_REPETITIONS = 3


@dataclass(frozen=True, slots=True)
class CoursePart:
    """One exercise of a set: until ``repetitions`` are done or, where these are 0, for ``seconds``; then ``rest_s``."""

    exercise: Exercise
    repetitions: int = 10
    seconds: int = 0
    rest_s: int = 30


@dataclass(frozen=True, slots=True)
class Course:
    """A set that runs; ``run_id`` is the same for all its sessions, ``number`` the part that it has come to, from 0."""

    set_id: str
    name: str
    run_id: str
    parts: tuple[CoursePart, ...]
    number: int = 0
    goals_deg: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Targets of the exercises for this hand of the patient, as of :class:`SetUp`."""

    @property
    def part(self) -> CoursePart:
        return self.parts[self.number]


@dataclass(frozen=True, slots=True)
class SetUp:
    """What was chosen before measuring.

    Targets in degrees of the trained angle with its sign (the negative direction below zero), NaN for none.
    """

    patient_id: str
    pseudonym: str
    side: Side
    exercise: Exercise
    repetitions: int
    target_positive_deg: float
    target_negative_deg: float
    keep_pictures: bool = False
    ends_free: bool = False
    """Whether the end joints of the fingers are measured by themselves, not taken to follow the middle joints."""
    discs: str = ""
    """Name of the marker protocol; empty for the exercise's usual one."""
    for_child: bool = False
    """Whether the patient's view speaks and draws for a child."""
    course: Course | None = None
    """The set that it is a part of."""

    @property
    def subject_id(self) -> str:
        """What a session file says of whose it is; of the practice patient the same in every language."""
        return PRACTICE_PATIENT if self.patient_id == PRACTICE_PATIENT else self.pseudonym

    @property
    def protocol(self) -> MarkerProtocol:
        return protocol_named(self.discs) if self.discs in protocol_names() else self.exercise.protocol


def practice_set_up(pseudonym: str) -> SetUp:
    """What the practice patient does first."""
    nothing = float("nan")
    return SetUp(PRACTICE_PATIENT, pseudonym, "right", EXERCISES[0], PRACTICE_REPETITIONS, nothing, nothing)


MOST_PARTS = 8
MOST_NAME = 40
MOST_REPETITIONS, MOST_SECONDS, MOST_REST_S = 50, 600, 600


@dataclass(frozen=True, slots=True)
class ExerciseSet:
    """A set by its name; ``discs`` the marker protocol that all its exercises are done with."""

    set_id: str
    name: str
    discs: str
    parts: tuple[CoursePart, ...]

    @property
    def problem(self) -> str:
        """What is missing to run it: ``name``, ``parts``, or empty."""
        if not self.name.strip():
            return "name"
        return "" if self.parts else "parts"


USUAL_SETS = (
    ExerciseSet(
        "usual-wrist", phrase("Wrist, all ways"), "wrist6",
        tuple(CoursePart(exercise_named(name), 10, 0, 30) for name in ("WRIST_FE", "WRIST_RU", "FOREARM_PS")),
    ),
    ExerciseSet(
        "usual-hand", phrase("Fist, hook, spread"), "hand21",
        tuple(CoursePart(exercise_named(name), 10, 0, 30) for name in ("FIST_COMPOSITE", "FIST_HOOK", "FINGER_ABAD")),
    ),
)  # fmt: skip


def new_set_id() -> str:
    """For a set that is not kept yet."""
    return str(uuid.uuid4())


def begun(one: ExerciseSet, set_up: SetUp, goals: Goals) -> SetUp:
    """The first exercise of a set, for the patient, hand and choices of a set-up, with the goals there are."""
    own = {exercise: targets for (exercise, side), targets in goals.items() if side == set_up.side}
    course = Course(one.set_id, one.name, str(uuid.uuid4()), one.parts, goals_deg=own)
    return at_part(replace(set_up, discs=one.discs), course)


def next_part(set_up: SetUp) -> SetUp | None:
    """The exercise that comes after the one of a set-up; None after the last and outside a set."""
    course = set_up.course
    if course is None or course.number + 1 >= len(course.parts):
        return None
    return at_part(set_up, replace(course, number=course.number + 1))


def at_part(set_up: SetUp, course: Course) -> SetUp:
    """A set-up at the part that a course has come to, with the goals of its exercise."""
    part, none = course.part, float("nan")
    positive, negative = course.goals_deg.get(part.exercise.id, (none, none))
    return replace(
        set_up, exercise=part.exercise, repetitions=part.repetitions, target_positive_deg=positive,
        target_negative_deg=negative, course=course,
    )  # fmt: skip

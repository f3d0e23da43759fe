"""Sets: exercises that run one after the other with the same discs, as a therapist puts them together.

They belong to the clinic and to no patient. Before the first own one there are the usual ones.
"""

from __future__ import annotations

import uuid
from dataclasses import dataclass, replace

from carpus.core.hand.exercises import exercise_named
from carpus.core.phrase import phrase
from carpus.core.records.set_up import Course, CoursePart, SetUp
from carpus.core.results.progress import Goals

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

"""What was chosen before measuring, and for whom; and sets: exercises that run one after the other with the same discs,
as a therapist puts them together, which belong to the clinic and to no patient."""

from __future__ import annotations

import uuid
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from carpus.core.model.hand.exercises import EXERCISES, Exercise, get_exercise
from carpus.core.model.hand.protocols import MarkerProtocol, get_protocol, protocol_names
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Side

if TYPE_CHECKING:
    from carpus.core.results.progress import Goals


MARKERS_SUFFIX = ".markers.jpg"
"""Ends, in place of ``.h5``, the picture of the discs as they were stuck: the hand and nothing of the room."""
PRACTICE_PATIENT = "practice"
"""Identity of the practice patient: always the last row, simulated camera, nothing counts."""
PRACTICE_REPETITIONS = 3


@dataclass(frozen=True, slots=True)
class SetPart:
    """One exercise of a set: until ``repetitions`` are done or, where these are 0, for ``seconds``; then ``rest_s``."""

    exercise: Exercise
    repetitions: int = 10
    seconds: int = 0
    rest_s: int = 30


@dataclass(frozen=True, slots=True)
class SetRun:
    """A set that runs; ``run_id`` is the same for all its sessions, ``part_index`` the part that it has come to, from
    0."""

    set_id: str
    name: str
    run_id: str
    parts: tuple[SetPart, ...]
    part_index: int = 0
    goals_deg: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Targets of the exercises for this hand of the patient, as of :class:`SessionSetup`."""

    @property
    def part(self) -> SetPart:
        return self.parts[self.part_index]


@dataclass(frozen=True, slots=True)
class SessionSetup:
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
    stores_frames: bool = False
    is_dip_free: bool = False
    """Whether the end joints of the fingers are measured by themselves, not taken to follow the middle joints."""
    protocol_name: str = ""
    """Name of the marker protocol; empty for the exercise's usual one."""
    for_child: bool = False
    """Whether the patient's view speaks and draws for a child."""
    set_run: SetRun | None = None
    """The set that it is a part of."""

    @property
    def subject_id(self) -> str:
        """What a session file says of whose it is; of the practice patient the same in every language."""
        return PRACTICE_PATIENT if self.patient_id == PRACTICE_PATIENT else self.pseudonym

    @property
    def protocol(self) -> MarkerProtocol:
        return get_protocol(self.protocol_name) if self.protocol_name in protocol_names() else self.exercise.protocol


def practice_setup(pseudonym: str) -> SessionSetup:
    """What the practice patient does first."""
    nothing = float("nan")
    return SessionSetup(PRACTICE_PATIENT, pseudonym, "right", EXERCISES[0], PRACTICE_REPETITIONS, nothing, nothing)


MAX_PARTS = 8
MAX_NAME_CHARACTERS = 40
MAX_REPETITIONS, MAX_SECONDS, MAX_REST_S = 50, 600, 600


@dataclass(frozen=True, slots=True)
class ExerciseSet:
    """A set by its name; ``protocol_name`` the marker protocol that all its exercises are done with."""

    set_id: str
    name: str
    protocol_name: str
    parts: tuple[SetPart, ...]

    @property
    def problem(self) -> str:
        """What is missing to run it: ``name``, ``parts``, or empty."""
        if not self.name.strip():
            return "name"
        return "" if self.parts else "parts"


DEFAULT_SETS = (
    ExerciseSet(
        "usual-wrist", phrase("Wrist, all ways"), "wrist6",
        tuple(SetPart(get_exercise(name), 10, 0, 30) for name in ("WRIST_FE", "WRIST_RU", "FOREARM_PS")),
    ),
    ExerciseSet(
        "usual-hand", phrase("Fist, hook, spread"), "hand21",
        tuple(SetPart(get_exercise(name), 10, 0, 30) for name in ("FIST_COMPOSITE", "FIST_HOOK", "FINGER_ABAD")),
    ),
)  # fmt: skip


def new_set_id() -> str:
    """For a set that is not kept yet."""
    return str(uuid.uuid4())


def start_set(exercise_set: ExerciseSet, set_up: SessionSetup, goals: Goals) -> SessionSetup:
    """The first exercise of a set, for the patient, hand and choices of a set-up, with the goals there are."""
    own = {exercise: targets for (exercise, side), targets in goals.items() if side == set_up.side}
    course = SetRun(exercise_set.set_id, exercise_set.name, str(uuid.uuid4()), exercise_set.parts, goals_deg=own)
    return with_part(replace(set_up, protocol_name=exercise_set.protocol_name), course)


def next_part(set_up: SessionSetup) -> SessionSetup | None:
    """The exercise that comes after the one of a set-up; None after the last and outside a set."""
    course = set_up.set_run
    if course is None or course.part_index + 1 >= len(course.parts):
        return None
    return with_part(set_up, replace(course, part_index=course.part_index + 1))


def with_part(set_up: SessionSetup, set_run: SetRun) -> SessionSetup:
    """A set-up at the part that a course has come to, with the goals of its exercise."""
    part, none = set_run.part, float("nan")
    positive, negative = set_run.goals_deg.get(part.exercise.id, (none, none))
    return replace(
        set_up, exercise=part.exercise, repetitions=part.repetitions, target_positive_deg=positive,
        target_negative_deg=negative, set_run=set_run,
    )  # fmt: skip

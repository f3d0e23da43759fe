"""Choices before a measurement, and sets: exercises done one after the other with the same markers.

Sets belong to the clinic, not to a patient.
"""

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
"""Replaces ``.h5`` in the name of the marker photo, which shows the hand and nothing of the room."""
PRACTICE_PATIENT = "practice"
"""Id of the practice patient: last in lists, with a simulated camera; its simulated sessions are counted."""
PRACTICE_REPETITIONS = 3


@dataclass(frozen=True, slots=True)
class SetPart:
    """Exercise of a set: ``repetitions`` or, if these are 0, ``seconds``; then a rest."""

    exercise: Exercise
    repetitions: int = 10
    seconds: int = 0
    rest_s: int = 30


@dataclass(frozen=True, slots=True)
class SetRun:
    """Set that is being done; ``run_id`` is the same in all its sessions, ``part_index`` counts from 0."""

    set_id: str
    name: str
    run_id: str
    parts: tuple[SetPart, ...]
    part_index: int = 0
    goals_deg: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Goals by exercise for this hand of the patient, as in :class:`SessionSetup`."""

    @property
    def part(self) -> SetPart:
        return self.parts[self.part_index]


@dataclass(frozen=True, slots=True)
class SessionSetup:
    """Choices before a measurement.

    Targets in degrees of the trained angle, signed (negative direction below zero), NaN for none.
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
    """The DIP joints are measured, not inferred from the PIP joints."""
    protocol_name: str = ""
    """Marker protocol; empty for the default one of the exercise."""
    for_child: bool = False
    """The patient's screen is for a child."""
    set_run: SetRun | None = None

    @property
    def subject_id(self) -> str:
        """Subject of the session file: the pseudonym, or the practice patient in every language."""
        return PRACTICE_PATIENT if self.patient_id == PRACTICE_PATIENT else self.pseudonym

    @property
    def protocol(self) -> MarkerProtocol:
        return get_protocol(self.protocol_name) if self.protocol_name in protocol_names() else self.exercise.protocol


def practice_setup(pseudonym: str) -> SessionSetup:
    """Return the first set-up of the practice patient."""
    nothing = float("nan")
    return SessionSetup(PRACTICE_PATIENT, pseudonym, "right", EXERCISES[0], PRACTICE_REPETITIONS, nothing, nothing)


MAX_PARTS = 8
MAX_NAME_CHARACTERS = 40
MAX_REPETITIONS, MAX_SECONDS, MAX_REST_S = 50, 600, 600


@dataclass(frozen=True, slots=True)
class ExerciseSet:
    """Named set; ``protocol_name`` is the marker protocol of all its exercises."""

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
        "usual-wrist", phrase("Wrist, all movements"), "wrist6",
        tuple(SetPart(get_exercise(name), 10, 0, 30) for name in ("WRIST_FE", "WRIST_RU", "FOREARM_PS")),
    ),
    ExerciseSet(
        "usual-hand", phrase("Fist, hook, spread"), "hand21",
        tuple(SetPart(get_exercise(name), 10, 0, 30) for name in ("FIST_COMPOSITE", "FIST_HOOK", "FINGER_ABAD")),
    ),
)  # fmt: skip


def start_set(exercise_set: ExerciseSet, set_up: SessionSetup, goals: Goals) -> SessionSetup:
    """Return the set-up of a set's first exercise, with the patient's goals."""
    own = {exercise: targets for (exercise, side), targets in goals.items() if side == set_up.side}
    course = SetRun(exercise_set.set_id, exercise_set.name, str(uuid.uuid4()), exercise_set.parts, goals_deg=own)
    return with_part(replace(set_up, protocol_name=exercise_set.protocol_name), course)


def next_part(set_up: SessionSetup) -> SessionSetup | None:
    """Return the set-up of the next exercise, None after the last and outside of a set."""
    course = set_up.set_run
    if course is None or course.part_index + 1 >= len(course.parts):
        return None
    return with_part(set_up, replace(course, part_index=course.part_index + 1))


def with_part(set_up: SessionSetup, set_run: SetRun) -> SessionSetup:
    """Return the set-up of the current part, with the goals of its exercise."""
    part, none = set_run.part, float("nan")
    positive, negative = set_run.goals_deg.get(part.exercise.id, (none, none))
    return replace(
        set_up, exercise=part.exercise, repetitions=part.repetitions, target_positive_deg=positive,
        target_negative_deg=negative, set_run=set_run,
    )  # fmt: skip

"""What was chosen before measuring, and for whom."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from carpus.core.hand.exercises import EXERCISES, Exercise
from carpus.core.hand.protocols import MarkerProtocol, protocol_named, protocol_names
from carpus.core.types import Side

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

"""Sets: exercises that run one after the other with the same discs, as a therapist puts them together.

They lie in the data folder and belong to no patient. Before the first own one there are the usual ones.
"""

from __future__ import annotations

import json
import uuid
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from carpus.core.errors import OutputNotWritable, SetsUnreadable
from carpus.core.hand.protocols import protocol_named, protocol_names
from carpus.core.library.set_up import Course, CoursePart, SetUp
from carpus.core.output.exercises import EXERCISES, exercise_named
from carpus.core.output.goals import Goals
from carpus.core.phrase import phrase

SETS_FILE = "exercise_sets.json"
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


def read_sets(folder: Path) -> tuple[ExerciseSet, ...]:
    """The sets of a data folder. Raises :class:`SetsUnreadable`."""
    path = folder / SETS_FILE
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
        return tuple(_set(one) for one in stored["sets"])
    except FileNotFoundError:
        return USUAL_SETS
    except (OSError, ValueError, OverflowError, KeyError, TypeError, AttributeError, RecursionError) as cause:
        raise SetsUnreadable(path, str(cause)) from cause


def keep_sets(folder: Path, sets: Sequence[ExerciseSet]) -> None:
    """Store all of them; a file that could not be read is kept beside. Raises :class:`OutputNotWritable`."""
    path = folder / SETS_FILE
    content = {
        "sets": [
            {
                "id": one.set_id,
                "name": one.name,
                "discs": one.discs,
                "parts": [
                    {
                        "exercise": part.exercise.id,
                        "repetitions": part.repetitions,
                        "seconds": part.seconds,
                        "rest_s": part.rest_s,
                    }
                    for part in one.parts
                ],
            }
            for one in sets
        ]
    }
    new = path.with_suffix(".new")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        new.unlink(missing_ok=True)
        new.touch(mode=0o600)
        new.write_text(json.dumps(content, indent=1, ensure_ascii=False), encoding="utf-8")
        try:
            read_sets(folder)
        except SetsUnreadable:
            with suppress(OSError):
                path.replace(path.with_suffix(".unusable.json"))
        new.replace(path)
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause


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


def _set(stored: Any) -> ExerciseSet:
    """Raises ValueError, OverflowError, KeyError or TypeError for what is no set."""
    discs = str(stored["discs"])
    if discs not in protocol_names():
        raise ValueError(f"discs {discs!r}")
    parts = tuple(_part(part) for part in stored["parts"])
    if not 1 <= len(parts) <= MOST_PARTS or not all(
        part.exercise.is_allowed_by(protocol_named(discs)) for part in parts
    ):
        raise ValueError("exercises that do not go together")
    return ExerciseSet(str(stored["id"]), str(stored["name"])[:MOST_NAME], discs, parts)


def _part(stored: Any) -> CoursePart:
    name = str(stored["exercise"])
    if name not in [exercise.id for exercise in EXERCISES]:
        raise ValueError(f"exercise {name!r}")
    part = CoursePart(exercise_named(name), int(stored["repetitions"]), int(stored["seconds"]), int(stored["rest_s"]))
    limits = (MOST_REPETITIONS, MOST_SECONDS, MOST_REST_S)
    counts = (part.repetitions, part.seconds, part.rest_s)
    if not all(0 <= count <= most for count, most in zip(counts, limits, strict=True)) or not part.has_end:
        raise ValueError("counts out of range")
    return part

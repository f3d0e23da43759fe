"""Texts about sets of exercises and the present part."""

from __future__ import annotations

from carpus.core.records.session_setup import ExerciseSet, SetPart, SetRun
from carpus.ui.kit.translate import tr, translate_phrase
from carpus.ui.words import terms


def part_words(part: SetPart) -> str:
    """Format a part: ``Full fist, 10 times``; ``Free movement, 60 s``."""
    if part.repetitions:
        pattern = tr("{exercise}, {count} times")
        return pattern.format(exercise=terms.exercise_name(part.exercise.id), count=part.repetitions)
    return tr("{exercise}, {count} s").format(exercise=terms.exercise_name(part.exercise.id), count=part.seconds)


def set_words(one: ExerciseSet) -> str:
    """Format all parts of a set."""
    return " → ".join(part_words(part) for part in one.parts)


def course_words(course: SetRun) -> str:
    """Format the present part: ``Set “Wrist”, 2 of 3: Radial–ulnar deviation, 10 times``."""
    return tr("Exercise set “{name}”, {number} of {count}: {part}").format(
        name=translate_phrase(course.name),
        number=course.part_index + 1,
        count=len(course.parts),
        part=part_words(course.part),
    )

"""The clinic's sets of exercises, as they are stored."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from sqlalchemy import Row, select

from carpus.core.errors import ChangedMeanwhile
from carpus.core.hand.exercises import EXERCISES, exercise_named
from carpus.core.hand.protocols import protocol_names
from carpus.core.library.exercise_sets import USUAL_SETS, ExerciseSet
from carpus.core.library.set_up import CoursePart
from carpus.core.records.changes import changed, kept, new
from carpus.core.records.schema import EXERCISE_SET
from carpus.core.records.store import Store


def read_sets(store: Store) -> tuple[ExerciseSet, ...]:
    """The sets of the clinic; those whose exercises this Carpus does not know are left out."""
    rows = store.rows(select(EXERCISE_SET).order_by(EXERCISE_SET.c.place))
    known = store.sound((row for row in rows if not row.gone), lambda row: [_set(row)] if _is_known(row) else [])
    return tuple(one for found in known for one in found) if rows else USUAL_SETS


def keep_sets(store: Store, sets: Sequence[ExerciseSet], before: Sequence[ExerciseSet]) -> None:
    """Store them in place of those that were read ``before``; what somebody else added meanwhile stays.

    Raises :class:`ChangedMeanwhile` where somebody else changed one of them, and the faults of writing.
    """
    there, read = {row.id: row for row in store.rows(select(EXERCISE_SET))}, {one.set_id: one for one in before}
    change = []
    for place, one in enumerate(sets):
        row = there.get(one.set_id)
        if row is None:
            change.append(new(EXERCISE_SET, one.set_id, **_columns(one), place=place))
        elif row.gone or read.get(one.set_id) != one or row.place != place:
            if not row.gone and store.sound([row], _set) != [read.get(one.set_id)]:
                raise ChangedMeanwhile(EXERCISE_SET.name)
            change.append(changed(EXERCISE_SET, one.set_id, row.version, **_columns(one), place=place, gone=0))
    for gone in sorted(read.keys() - {one.set_id for one in sets}):
        change.append(kept(EXERCISE_SET, gone, **_columns(read[gone]), gone=1))
    store.do(change)


def _is_known(row: Row[Any]) -> bool:
    names = {exercise.id for exercise in EXERCISES}
    return row.discs in protocol_names() and all(part[0] in names for part in json.loads(row.parts))


def _set(row: Row[Any]) -> ExerciseSet:
    parts = tuple(CoursePart(exercise_named(name), *counts) for name, *counts in json.loads(row.parts))
    return ExerciseSet(row.id, row.name, row.discs, parts)


def _columns(one: ExerciseSet) -> dict[str, str]:
    parts = [[part.exercise.id, part.repetitions, part.seconds, part.rest_s] for part in one.parts]
    return {"name": one.name, "discs": one.discs, "parts": json.dumps(parts)}

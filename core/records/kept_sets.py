"""The clinic's sets of exercises, and how the last session of each patient was set up, as they are stored."""

from __future__ import annotations

import json
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from sqlalchemy import Row, select

from carpus.core.errors import CarpusFault, ChangedMeanwhile
from carpus.core.hand.exercises import EXERCISES, exercise_named
from carpus.core.hand.forearm_rotation import read_targets_deg, stored_targets_deg
from carpus.core.hand.protocols import protocol_names
from carpus.core.records.changes import changed, kept, new
from carpus.core.records.patients import Patients, goal, goals, known, storable
from carpus.core.records.schema import EXERCISE_SET, SET_UP
from carpus.core.records.set_up import USUAL_SETS, CoursePart, ExerciseSet, SetUp, begun
from carpus.core.records.store import Store


def read_sets(store: Store) -> tuple[ExerciseSet, ...]:
    """The sets of the clinic; those whose exercises this Carpus does not know are left out."""
    rows = store.rows(select(EXERCISE_SET).order_by(EXERCISE_SET.c.place))
    sound = store.sound((row for row in rows if not row.gone), lambda row: [_set(row)] if _is_known(row) else [])
    return tuple(one for found in sound for one in found) if rows else USUAL_SETS


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


def last_set_up(store: Store, patient_id: str) -> SetUp | None:
    """None before the first. Of a set, its beginning, as the set is now."""
    row = store.row(select(SET_UP).where(SET_UP.c.id == patient_id))
    if row is None:
        return None
    exercise = exercise_named(row.exercise)
    last = SetUp(
        patient_id, Patients(store).one(patient_id).pseudonym, row.side, exercise, row.repetitions,
        *read_targets_deg((known(row.positive_deg), known(row.negative_deg)), exercise), bool(row.keep_pictures),
        bool(row.ends_free), row.discs, bool(row.for_child),
    )  # fmt: skip
    with suppress(CarpusFault):
        for one in read_sets(store) if row.set_id else ():
            if one.set_id == row.set_id and one.discs == last.protocol.name:
                return begun(one, last, goals(store, patient_id))
    return last


def keep_set_up(store: Store, set_up: SetUp) -> None:
    """Remember it, with its goal."""
    targets = set_up.target_positive_deg, set_up.target_negative_deg
    stored = stored_targets_deg(targets, set_up.exercise)
    row = kept(
        SET_UP, set_up.patient_id, patient_id=set_up.patient_id, side=set_up.side, exercise=set_up.exercise.id,
        discs=set_up.discs, set_id=set_up.course.set_id if set_up.course is not None else "",
        repetitions=set_up.repetitions, keep_pictures=int(set_up.keep_pictures), ends_free=int(set_up.ends_free),
        for_child=int(set_up.for_child), positive_deg=storable(stored[0]), negative_deg=storable(stored[1]),
    )  # fmt: skip
    of_goal = [goal(set_up.patient_id, set_up.exercise.id, set_up.side, *targets)] if set_up.exercise.counts else []
    store.do([row, *of_goal])

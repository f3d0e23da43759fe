"""Stored sets of exercises of the clinic, and the last set-up of each patient."""

from __future__ import annotations

import json
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from sqlalchemy import Row, select

from carpus.core.model.errors import CarpusFault, ConcurrentChange
from carpus.core.model.hand.exercises import EXERCISES, get_exercise
from carpus.core.model.hand.forearm_rotation import from_clinical_targets_deg, to_clinical_targets_deg
from carpus.core.model.hand.protocols import protocol_names
from carpus.core.records.changes import insert_row, update_row, upsert_row
from carpus.core.records.patients import Patients, goal_change, nan_to_null, null_to_nan, read_goals
from carpus.core.records.schema import EXERCISE_SET, SET_UP
from carpus.core.records.session_setup import DEFAULT_SETS, ExerciseSet, SessionSetup, SetPart, start_set
from carpus.core.records.store import Store


def read_sets(store: Store) -> tuple[ExerciseSet, ...]:
    """Return the clinic's sets, without those whose exercises are unknown."""
    rows = store.rows(select(EXERCISE_SET).order_by(EXERCISE_SET.c.place))
    sound = store.valid_rows(
        (row for row in rows if not row.gone), lambda row: [_set_from_row(row)] if _has_known_exercises(row) else []
    )
    return tuple(one for found in sound for one in found) if rows else DEFAULT_SETS


def save_sets(store: Store, sets: Sequence[ExerciseSet], previous: Sequence[ExerciseSet]) -> None:
    """Store sets in place of ``previous``; those added by somebody else stay.

    Raises :class:`ConcurrentChange` if somebody else changed one of them, and the faults of writing.
    """
    there, read = {row.id: row for row in store.rows(select(EXERCISE_SET))}, {one.set_id: one for one in previous}
    change = []
    for place, one in enumerate(sets):
        row = there.get(one.set_id)
        if row is None:
            change.append(insert_row(EXERCISE_SET, one.set_id, **_set_columns(one), place=place))
        elif row.gone or read.get(one.set_id) != one or row.place != place:
            if not row.gone and store.valid_rows([row], _set_from_row) != [read.get(one.set_id)]:
                raise ConcurrentChange(EXERCISE_SET.name)
            change.append(update_row(EXERCISE_SET, one.set_id, row.version, **_set_columns(one), place=place, gone=0))
    for gone in sorted(read.keys() - {one.set_id for one in sets}):
        change.append(upsert_row(EXERCISE_SET, gone, **_set_columns(read[gone]), gone=1))
    store.apply(change)


def _has_known_exercises(row: Row[Any]) -> bool:
    names = {exercise.id for exercise in EXERCISES}
    return row.discs in protocol_names() and all(part[0] in names for part in json.loads(row.parts))


def _set_from_row(row: Row[Any]) -> ExerciseSet:
    parts = tuple(SetPart(get_exercise(name), *counts) for name, *counts in json.loads(row.parts))
    return ExerciseSet(row.id, row.name, row.discs, parts)


def _set_columns(one: ExerciseSet) -> dict[str, str]:
    parts = [[part.exercise.id, part.repetitions, part.seconds, part.rest_s] for part in one.parts]
    return {"name": one.name, "discs": one.protocol_name, "parts": json.dumps(parts)}


def read_last_setup(store: Store, patient_id: str) -> SessionSetup | None:
    """Return a patient's last set-up, None before the first; of a set its first part."""
    row = store.row(select(SET_UP).where(SET_UP.c.id == patient_id))
    if row is None:
        return None
    exercise = get_exercise(row.exercise)
    last = SessionSetup(
        patient_id,
        Patients(store).get(patient_id).pseudonym,
        row.side,
        exercise,
        row.repetitions,
        *to_clinical_targets_deg((null_to_nan(row.positive_deg), null_to_nan(row.negative_deg)), exercise),
        bool(row.keep_pictures),
        bool(row.ends_free),
        row.discs,
        bool(row.for_child),
    )
    with suppress(CarpusFault):
        for one in read_sets(store) if row.set_id else ():
            if one.set_id == row.set_id and one.protocol_name == last.protocol.name:
                return start_set(one, last, read_goals(store, patient_id))
    return last


def save_setup(store: Store, set_up: SessionSetup) -> None:
    """Save a set-up and its goal."""
    targets = set_up.target_positive_deg, set_up.target_negative_deg
    stored = from_clinical_targets_deg(targets, set_up.exercise)
    row = upsert_row(
        SET_UP, set_up.patient_id, patient_id=set_up.patient_id, side=set_up.side, exercise=set_up.exercise.id,
        discs=set_up.protocol_name, set_id=set_up.set_run.set_id if set_up.set_run is not None else "",
        repetitions=set_up.repetitions, keep_pictures=int(set_up.stores_frames), ends_free=int(set_up.is_dip_free),
        for_child=int(set_up.for_child), positive_deg=nan_to_null(stored[0]), negative_deg=nan_to_null(stored[1]),
    )  # fmt: skip
    of_goal = (
        [goal_change(set_up.patient_id, set_up.exercise.id, set_up.side, *targets)]
        if set_up.exercise.has_repetitions
        else []
    )
    store.apply([row, *of_goal])

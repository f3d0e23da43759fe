"""How the last session of each patient was set up: the next one begins with it."""

from __future__ import annotations

from contextlib import suppress

from sqlalchemy import select

from carpus.core.errors import CarpusFault
from carpus.core.hand.exercises import exercise_named
from carpus.core.library.exercise_sets import begun
from carpus.core.library.kept_sets import read_sets
from carpus.core.library.set_up import SetUp
from carpus.core.records.changes import kept
from carpus.core.records.of_patients import goal, goals, known, storable
from carpus.core.records.patients import Patients
from carpus.core.records.schema import SET_UP
from carpus.core.records.store import Store


def last_set_up(store: Store, patient_id: str) -> SetUp | None:
    """None before the first. Of a set, its beginning, as the set is now."""
    row = store.row(select(SET_UP).where(SET_UP.c.id == patient_id))
    if row is None:
        return None
    last = SetUp(
        patient_id, Patients(store).one(patient_id).entry.pseudonym, row.side, exercise_named(row.exercise),
        row.repetitions, known(row.positive_deg), known(row.negative_deg), bool(row.keep_pictures),
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
    row = kept(
        SET_UP, set_up.patient_id, patient_id=set_up.patient_id, side=set_up.side, exercise=set_up.exercise.id,
        discs=set_up.discs, set_id=set_up.course.set_id if set_up.course is not None else "",
        repetitions=set_up.repetitions, keep_pictures=int(set_up.keep_pictures), ends_free=int(set_up.ends_free),
        for_child=int(set_up.for_child), positive_deg=storable(targets[0]), negative_deg=storable(targets[1]),
    )  # fmt: skip
    of_goal = [goal(set_up.patient_id, set_up.exercise.id, set_up.side, *targets)] if set_up.exercise.counts else []
    store.do([row, *of_goal])

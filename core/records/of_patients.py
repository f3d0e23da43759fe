"""What people write about a patient: values measured by hand, and the goals."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Iterable
from datetime import UTC, date, datetime
from typing import Any

from sqlalchemy import Row, select

from carpus.core.dates import day_of
from carpus.core.measures.by_hand import MEASURES, HandValue
from carpus.core.records.changes import RowChange, kept, new
from carpus.core.records.schema import GOAL, HOME_PLAN, MEASURED
from carpus.core.records.store import Store, new_id
from carpus.core.records.values import HomePlan, moment
from carpus.core.results.goals import Goals
from carpus.core.types import Side


def enter_by_hand(store: Store, patient_id: str, values: Iterable[HandValue]) -> None:
    """Add entries, each with its own time or now; what was entered before for the same stays readable."""
    now, first_ns = datetime.now(UTC), time.time_ns()
    store.do(
        [
            new(
                MEASURED, new_id(), patient_id=patient_id, measure=one.measure, way=one.way, side=one.side,
                day=one.day.isoformat(), tries=json.dumps(list(one.tries)), place=one.where, by=one.by,
                entered=(one.entered or now).astimezone(UTC).isoformat(timespec="seconds"),
                entered_ns=first_ns + number,
            )
            for number, one in enumerate(values)
        ]
    )  # fmt: skip


def by_hand(store: Store, patient_id: str) -> list[HandValue]:
    """Everything that was ever entered of a patient, in order; without measures that this Carpus does not know."""
    known = [measure.id for measure in MEASURES]
    query = select(MEASURED).where(MEASURED.c.patient_id == patient_id, MEASURED.c.measure.in_(known))
    return store.sound(store.rows(query.order_by(MEASURED.c.entered_ns, MEASURED.c.id)), _hand_value)


def _hand_value(row: Row[Any]) -> HandValue:
    return HandValue(
        row.measure, row.way, row.side, date.fromisoformat(row.day), tuple(map(float, json.loads(row.tries))),
        row.place, row.by, moment(row.entered, row.entered_ns / 1e9),
    )  # fmt: skip


def goals(store: Store, patient_id: str) -> Goals:
    """The targets that were last set for each exercise and hand of a patient; NaN for none."""
    out: dict[tuple[str, Side], tuple[float, float]] = {}
    for row in store.rows(select(GOAL).where(GOAL.c.patient_id == patient_id)):
        out[row.exercise, row.side] = known(row.positive_deg), known(row.negative_deg)
    return out


def goal(patient_id: str, exercise: str, side: Side, positive_deg: float, negative_deg: float) -> RowChange:
    """The change that sets one."""
    return kept(
        GOAL, f"{patient_id}:{exercise}:{side}", patient_id=patient_id, exercise=exercise, side=side,
        positive_deg=storable(positive_deg), negative_deg=storable(negative_deg),
    )  # fmt: skip


def home_plan(store: Store, patient_id: str) -> HomePlan | None:
    """What a patient was last given to do at home; None for nothing."""
    found = store.sound(store.rows(select(HOME_PLAN).where(HOME_PLAN.c.patient_id == patient_id)), _home_plan)
    return next(iter(found), None)


def _home_plan(row: Row[Any]) -> HomePlan:
    return HomePlan(
        tuple(row.exercises.split("\n")), row.times, row.rounds, date.fromisoformat(row.made), day_of(row.again),
        row.at, row.note, row.language,
    )  # fmt: skip


def keep_home_plan(store: Store, patient_id: str, plan: HomePlan) -> None:
    """In place of the one before."""
    again = plan.again.isoformat() if plan.again is not None else ""
    row = kept(
        HOME_PLAN, f"{patient_id}:home", patient_id=patient_id, exercises="\n".join(plan.exercises), times=plan.times,
        rounds=plan.rounds, made=plan.made.isoformat(), again=again, at=plan.at, note=plan.note,
        language=plan.language,
    )  # fmt: skip
    store.do([row])


def storable(value: float) -> float | None:
    """A number as it is stored: what is not known is no number."""
    return None if math.isnan(value) else float(value)


def known(value: float | None) -> float:
    """What :func:`storable` stored."""
    return math.nan if value is None else value

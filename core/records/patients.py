"""Patients, their manual measurements, goals and last set-up; names are stored here and nowhere else."""

from __future__ import annotations

import json
import math
import secrets
import time
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import fields
from datetime import UTC, date, datetime
from typing import Any, Literal, get_args, get_origin, get_type_hints

from sqlalchemy import ColumnElement, Row, select

from carpus.core.measures.manual_measurements import MEASURES, ManualValue
from carpus.core.model.dates import parse_day
from carpus.core.model.errors import CarpusFault, SessionUnreadable
from carpus.core.model.hand.exercises import find_exercise, get_exercise
from carpus.core.model.hand.forearm_rotation import from_clinical_targets_deg, to_clinical_targets_deg
from carpus.core.model.names import fold_name, normalize_name
from carpus.core.model.phrase import phrase
from carpus.core.model.types import Side
from carpus.core.records.changes import RowChange, delete_row, insert_row, update_row, upsert_row
from carpus.core.records.clinic_records import read_sets
from carpus.core.records.log import AuditAction
from carpus.core.records.schema import DIAGNOSIS, GOAL, HOME_PLAN, MANUAL_MEASUREMENT, PATIENT, SET_UP
from carpus.core.records.session_setup import PRACTICE_PATIENT, SessionSetup, start_set
from carpus.core.records.store import Store, new_id
from carpus.core.records.values import HomePlan, Patient, parse_time
from carpus.core.results.progress import Goals

WORDS = (
    "Acorn", "Alder", "Amber", "Apple", "Aspen", "Badger", "Barley", "Beaver", "Beech", "Birch", "Bramble", "Brook",
    "Cedar", "Cherry", "Clover", "Coral", "Cricket", "Daisy", "Dolphin", "Dune", "Elder", "Falcon", "Fern", "Finch",
    "Fir", "Garnet", "Ginger", "Harbour", "Hazel", "Heather", "Heron", "Hickory", "Island", "Ivy", "Jasper", "Juniper",
    "Kestrel", "Lantern", "Lark", "Laurel", "Lilac", "Linden", "Lupin", "Magpie", "Maple", "Marble", "Meadow",
    "Mistral", "Myrtle", "Nutmeg", "Oak", "Olive", "Orchid", "Otter", "Pebble", "Pepper", "Plover", "Poppy", "Quartz",
    "Raven", "Robin", "Rowan", "Saffron", "Sparrow", "Spruce", "Swallow", "Thistle", "Topaz", "Tulip", "Walnut",
    "Willow", "Wren",
)  # fmt: skip
"""Words of pseudonyms: easy to say and to hear across a room."""
_NUMBERS = range(10, 100)


def suggest_pseudonym(taken: Collection[str]) -> str:
    """Return a free pseudonym such as ``Linden 42``, chosen at random."""
    used = {name.casefold() for name in taken}
    free = [name for word in WORDS for number in _NUMBERS if (name := f"{word} {number}").casefold() not in used]
    if free:
        return secrets.choice(free)
    number = max(_NUMBERS) + 1
    while (name := f"{WORDS[0]} {number}").casefold() in used:
        number += 1
    return name


class Patients:
    """Patient list of a store, without the practice patient."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self.on_change: Callable[[AuditAction, str], None] = lambda did, patient_id: None
        """Called with the action and the id after a patient was added or changed."""

    def search(self, text: str = "", *, include_archived: bool = False, limit: int | None = None) -> list[Patient]:
        """Find patients whose :data:`SEARCHED_FIELDS` contain every word of ``text``, a date as ISO 8601.

        Last session first. Archived patients are left out unless ``include_archived``; archived sessions are never
        counted.
        """
        these: list[ColumnElement[bool]] = [PATIENT.c.id != PRACTICE_PATIENT, PATIENT.c.erasing == 0]
        if not include_archived:
            these.append(PATIENT.c.archived == "")
        words = fold_name(text).split()
        these += [PATIENT.c.search.contains(word, autoescape=True) for word in words]
        order = (PATIENT.c.last_s.desc(), PATIENT.c.added_s.desc())
        query = select(PATIENT).where(*these)
        if words:  # the index has all that is needed to find them; whole rows are read of those alone
            found = select(PATIENT.c.id).with_hint(PATIENT, "INDEXED BY patient_copy_found", "sqlite").where(*these)
            found = found.order_by(*order).limit(limit)
            rows = self._store.rows(select(PATIENT).where(PATIENT.c.id.in_(found)))
            return [_patient_from_row(row) for row in sorted(rows, key=lambda row: (-row.last_s, -row.added_s))]
        return [_patient_from_row(row) for row in self._store.rows(query.order_by(*order).limit(limit))]

    def get(self, patient_id: str) -> Patient:
        """Return the patient with this id. Raises :class:`SessionUnreadable` if there is none."""
        row = self._store.row(select(PATIENT).where(PATIENT.c.id == patient_id))
        if row is None:
            raise SessionUnreadable(patient_id, phrase("not in the patient list"))
        return _patient_from_row(row)

    def has(self, patient_id: str) -> bool:
        return self._store.row(select(PATIENT.c.id).where(PATIENT.c.id == patient_id)) is not None

    def id_of_pseudonym(self, pseudonym: str) -> str:
        """Return the id of a pseudonym, empty if there is none."""
        row = self._store.row(select(PATIENT.c.id).where(PATIENT.c.pseudonym_key == fold_name(pseudonym)))
        return str(row[0]) if row else ""

    def id_of_record_number(self, number: str) -> str:
        """Return the id of the patient with a record number, empty if there is none."""
        query = select(PATIENT.c.id).where(PATIENT.c.record_number == number, PATIENT.c.erasing == 0)
        row = self._store.row(query.order_by(PATIENT.c.last_s.desc()))
        return str(row[0]) if row else ""

    def suggest_pseudonym(self) -> str:
        return suggest_pseudonym([str(row[0]) for row in self._store.rows(select(PATIENT.c.pseudonym))])

    def save(self, patient: Patient) -> str:
        """Add or change a patient; return the id. Raises what :meth:`add` and :meth:`change` do."""
        if not patient.patient_id:
            return self.add(patient)
        self.change(patient)
        return patient.patient_id

    def add(self, patient: Patient, now: datetime | None = None) -> str:
        """Add a patient; return the new id. Raises :class:`PseudonymTaken`, :class:`NameUnsuited`."""
        patient_id = new_id()
        added_s = (now or datetime.now(UTC)).timestamp()
        self._store.apply([insert_row(PATIENT, patient_id, **patient_columns(patient), added_s=added_s)])
        self.on_change("added", patient_id)
        return patient_id

    def change(self, patient: Patient) -> None:
        """Change a patient as read in its ``version``, 0 for any.

        Raises :class:`PseudonymTaken`, :class:`NameUnsuited`, :class:`ConcurrentChange`. Session files keep an earlier
        pseudonym.
        """
        values = patient_columns(patient)
        row = self._store.row(select(PATIENT).where(PATIENT.c.id == patient.patient_id))
        if row is not None and row.pseudonym != values["pseudonym"]:
            former = dict.fromkeys([*row.former_pseudonyms.split("\n"), row.pseudonym])
            values["former_pseudonyms"] = "\n".join(former).strip()
        self._store.apply([update_row(PATIENT, patient.patient_id, patient.version, **values)])
        self._store.purge_deleted()  # of a name that was taken away
        self.on_change("changed", patient.patient_id)

    def archive(self, patient_id: str, now: datetime | None = None) -> None:
        since = (now or datetime.now(UTC)).isoformat(timespec="seconds")
        self._store.apply([update_row(PATIENT, patient_id, archived=since)])

    def unarchive(self, patient_id: str) -> None:
        self._store.apply([update_row(PATIENT, patient_id, archived="")])

    def diagnoses(self) -> list[str]:
        """Return the clinic's own list of diagnoses and operations, most frequent first."""
        had = Counter(fold_name(row.diagnosis) for row in self._store.rows(select(PATIENT.c.diagnosis)))
        listed = {fold_name(row.words): str(row.words) for row in self._store.rows(select(DIAGNOSIS.c.words))}
        return [words for _, words in sorted(listed.items(), key=lambda one: (-had[one[0]], one[0]))]

    def set_diagnosis_listed(self, diagnosis: str, *, is_listed: bool) -> None:
        """Add a diagnosis to the clinic's list or remove it; patients keep theirs."""
        same = [row.id for row in self._store.rows(select(DIAGNOSIS)) if fold_name(row.words) == fold_name(diagnosis)]
        if is_listed and not same:
            self._store.apply([insert_row(DIAGNOSIS, new_id(), words=diagnosis)])
        elif same and not is_listed:
            self._store.apply([delete_row(DIAGNOSIS, one) for one in same])

    def archive_times(self) -> dict[str, datetime]:
        rows = self._store.rows(select(PATIENT).where(PATIENT.c.archived != ""))
        return {str(row.id): parse_time(row.archived, row.added_s) for row in rows}


def _column_types(kind: Any) -> Mapping[str, Any]:
    """Return the type of each column that a person fills in."""
    types = get_type_hints(kind)
    return {one.name: types[one.name] for one in fields(kind) if not one.kw_only}


_PATIENT, _HOME_PLAN = _column_types(Patient), _column_types(HomePlan)
NORMALIZED_FIELDS = ("pseudonym", "name", "record_number", "diagnosis")
"""Texts that identify, stored in one form."""
SEARCHED_FIELDS = ("pseudonym", "name", "record_number", "birth_day", "diagnosis", "note")


def _to_columns(value: object, types: Mapping[str, Any]) -> dict[str, Any]:
    """Convert to columns: days as ISO 8601, empty for None; several texts one per line."""
    columns = {name: getattr(value, name) for name in types}
    for name, one in columns.items():
        if one is None or isinstance(one, date):
            columns[name] = one.isoformat() if one is not None else ""
        elif isinstance(one, tuple):
            columns[name] = "\n".join(one)
    return columns


def _from_columns(row: Row[Any], types: Mapping[str, Any]) -> dict[str, Any]:
    """Convert columns back; unknown choices of another program become the first choice."""
    read = {name: getattr(row, name) for name in types}
    for name, hint in types.items():
        origin: Any = get_origin(hint)
        if origin is Literal:
            read[name] = read[name] if read[name] in get_args(hint) else get_args(hint)[0]
        elif origin is tuple:
            read[name] = tuple(read[name].split("\n"))
        elif hint not in (str, int):  # a day, which may be missing where None may stand for it
            read[name] = date.fromisoformat(read[name]) if hint is date else parse_day(read[name])
    return read


def patient_columns(patient: Patient) -> dict[str, Any]:
    """Return a patient's columns. Raises :class:`NameUnsuited`."""
    columns = _to_columns(patient, _PATIENT)
    columns |= {name: normalize_name(columns[name]) for name in NORMALIZED_FIELDS}
    search = " ".join(columns[name] for name in SEARCHED_FIELDS)
    return columns | {"pseudonym_key": fold_name(columns["pseudonym"]), "search": fold_name(search)}


def _patient_from_row(row: Row[Any]) -> Patient:
    return Patient(
        **_from_columns(row, _PATIENT) | {"pseudonym": row.pseudonym.strip() or "?"}, patient_id=row.id,
        session_count=row.sessions, result_count=row.results, last_exercise=row.last_exercise, version=row.version,
        last_session=parse_time(row.last_session, row.last_s) if row.last_session else None,
    )  # fmt: skip


def add_manual_measurements(store: Store, patient_id: str, values: Iterable[ManualValue]) -> None:
    """Add measurements, with their own time or now; earlier ones stay readable."""
    now, first_ns = datetime.now(UTC), time.time_ns()
    store.apply(
        [
            insert_row(
                MANUAL_MEASUREMENT, new_id(), patient_id=patient_id, measure=one.measure, way=one.mode, side=one.side,
                day=one.day.isoformat(), tries=json.dumps(list(one.trials)), place=one.location, by=one.rater,
                entered=(one.entered_at or now).astimezone(UTC).isoformat(timespec="seconds"),
                entered_ns=first_ns + number,
            )
            for number, one in enumerate(values)
        ]
    )  # fmt: skip


def read_manual_measurements(store: Store, patient_id: str) -> list[ManualValue]:
    """Return all measurements of a patient in order, without measures unknown to this version."""
    known = [measure.id for measure in MEASURES]
    query = select(MANUAL_MEASUREMENT).where(
        MANUAL_MEASUREMENT.c.patient_id == patient_id, MANUAL_MEASUREMENT.c.measure.in_(known)
    )
    return store.valid_rows(
        store.rows(query.order_by(MANUAL_MEASUREMENT.c.entered_ns, MANUAL_MEASUREMENT.c.id)), _measurement_from_row
    )


def _measurement_from_row(row: Row[Any]) -> ManualValue:
    return ManualValue(
        row.measure, row.way, row.side, date.fromisoformat(row.day), tuple(map(float, json.loads(row.tries))),
        row.place, row.by, parse_time(row.entered, row.entered_ns / 1e9),
    )  # fmt: skip


def read_goals(store: Store, patient_id: str) -> Goals:
    """Return the last goals (degrees, NaN for none) by exercise and hand."""
    out: dict[tuple[str, Side], tuple[float, float]] = {}
    for row in store.rows(select(GOAL).where(GOAL.c.patient_id == patient_id)):
        stored = null_to_nan(row.positive_deg), null_to_nan(row.negative_deg)
        out[row.exercise, row.side] = to_clinical_targets_deg(stored, find_exercise(row.exercise))
    return out


def goal_change(patient_id: str, exercise: str, side: Side, positive_deg: float, negative_deg: float) -> RowChange:
    """Return the change that sets a goal; stored as in session files, supination from palm down."""
    positive_deg, negative_deg = from_clinical_targets_deg((positive_deg, negative_deg), find_exercise(exercise))
    return upsert_row(
        GOAL, f"{patient_id}:{exercise}:{side}", patient_id=patient_id, exercise=exercise, side=side,
        positive_deg=nan_to_null(positive_deg), negative_deg=nan_to_null(negative_deg),
    )  # fmt: skip


def read_home_plan(store: Store, patient_id: str) -> HomePlan | None:
    """Return a patient's last home plan, None for none."""
    rows = store.rows(select(HOME_PLAN).where(HOME_PLAN.c.patient_id == patient_id))
    return next(iter(store.valid_rows(rows, lambda row: HomePlan(**_from_columns(row, _HOME_PLAN)))), None)


def save_home_plan(store: Store, patient_id: str, plan: HomePlan) -> None:
    """Save a home plan in place of the last one."""
    store.apply([upsert_row(HOME_PLAN, f"{patient_id}:home", patient_id=patient_id, **_to_columns(plan, _HOME_PLAN))])


def nan_to_null(value: float) -> float | None:
    """Convert NaN to NULL."""
    return None if math.isnan(value) else float(value)


def null_to_nan(value: float | None) -> float:
    """Convert NULL to NaN."""
    return math.nan if value is None else value


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

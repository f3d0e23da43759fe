"""Records of the clinic: report form, therapists, recipients, exercise sets, backups, error limits, used folders."""

from __future__ import annotations

import base64
import json
import math
import time
import uuid
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from datetime import date, datetime
from pathlib import Path
from typing import Any

from sqlalchemy import Row, select

from carpus.core.formats.output_files import write_new_json
from carpus.core.measures.change_limits import ErrorLimits, MeasuredLimit, RetestStudy
from carpus.core.model.errors import ConcurrentChange, SettingsInvalid
from carpus.core.model.hand.exercises import EXERCISES, get_exercise
from carpus.core.model.hand.protocols import protocol_names
from carpus.core.model.names import fold_name
from carpus.core.model.phrase import phrase
from carpus.core.platform.durable import replace_text
from carpus.core.records.changes import delete_row, insert_row, update_row, upsert_row
from carpus.core.records.schema import BACKUP, EXERCISE_SET, RECIPIENT, REPORT_FORM, SESSION, THERAPIST
from carpus.core.records.session_setup import DEFAULT_SETS, ExerciseSet, SetPart
from carpus.core.records.store import Store, new_id
from carpus.core.records.values import Therapist, parse_time
from carpus.core.results.report_form import Letterhead, Paper, ReportForm

MAX_RECIPIENTS = 50
PLACES_FILE = "places.json"
"""In the data folder, for this computer only."""


def read_recipients(store: Store) -> list[str]:
    """Return addresses of letters, the last used first."""
    query = select(RECIPIENT.c.address).order_by(RECIPIENT.c.used_s.desc()).limit(MAX_RECIPIENTS)
    return [str(row.address) for row in store.rows(query)]


def save_recipient(store: Store, address: str) -> None:
    """Save an address of letters."""
    row_id = uuid.uuid5(uuid.NAMESPACE_OID, address).hex
    store.apply([upsert_row(RECIPIENT, row_id, address=address, used_s=time.time())])


@dataclass(frozen=True, slots=True)
class BackupRecord:
    """The last backup; ``later_sessions`` counts sessions made since."""

    made: datetime
    place: str
    sessions: int
    size_bytes: int
    later_sessions: int


def save_backup_record(store: Store, made: datetime, place: str, sessions: int, size_bytes: int) -> None:
    """Record that a backup was made."""
    row = {"made": made.isoformat(), "place": place, "sessions": sessions, "size_bytes": size_bytes}
    store.apply([insert_row(BACKUP, new_id(), **row)])


def read_last_backup(store: Store) -> BackupRecord | None:
    """Return the last backup, None before the first."""
    row = max(store.rows(select(BACKUP)), key=lambda one: parse_time(one.made, 0.0), default=None)
    if row is None:
        return None
    made = parse_time(row.made, 0.0)
    later = store.rows(select(SESSION.c.id).where(SESSION.c.created_s > made.timestamp(), SESSION.c.erasing == 0))
    return BackupRecord(made, row.place, row.sessions, row.size_bytes, len(later))


def read_last_place(folder: Path, name: str) -> str:
    """Return the folder last used for a purpose on this computer; empty before the first time."""
    return str(_read_places(folder).get(name, ""))


def save_place(folder: Path, name: str, place: str) -> None:
    """Remember a folder. Raises the faults of writing."""
    replace_text(folder / PLACES_FILE, json.dumps({**_read_places(folder), name: place}, ensure_ascii=False))


def clear_places(folder: Path, names: Iterable[str]) -> None:
    """Forget folders whose path contains one of these folded names."""
    for name, place in _read_places(folder).items():
        if any(one in fold_name(str(place)) for one in names):
            save_place(folder, name, "")


def _read_places(folder: Path) -> dict[str, Any]:
    with suppress(OSError, ValueError):
        found = json.loads((folder / PLACES_FILE).read_text(encoding="utf-8"))
        if isinstance(found, dict):
            return found
    return {}


_FORM_ID = "clinic"


def read_form(store: Store, default_paper: Paper = "a4") -> ReportForm:
    """Return the clinic's report form, or an empty one on the default paper."""
    row = _form_row(store)
    return ReportForm(paper=default_paper) if row is None else _form_from_row(row)


def save_form(store: Store, form: ReportForm, previous: ReportForm) -> None:
    """Store the report form in place of ``previous``.

    Raises :class:`ConcurrentChange` if somebody else changed it, and the faults of writing.
    """
    head = form.letterhead
    values = {
        "name": head.name, "address": json.dumps(head.address, ensure_ascii=False), "paper": form.paper,
        "logo": base64.b64encode(head.logo_png).decode("ascii"), "left_out": json.dumps(sorted(form.excluded_sections)),
        "sentences": json.dumps(form.sentences, ensure_ascii=False), "prints_names": int(form.prints_names),
    }  # fmt: skip
    row = _form_row(store)
    if row is None:
        store.apply([insert_row(REPORT_FORM, _FORM_ID, **values)])
    elif _form_from_row(row) != previous:
        raise ConcurrentChange(REPORT_FORM.name)
    else:
        store.apply([update_row(REPORT_FORM, _FORM_ID, row.version, **values)])


def read_therapists(store: Store) -> list[Therapist]:
    """Return the clinic's therapists by initials."""
    rows = store.rows(select(THERAPIST).order_by(THERAPIST.c.initials))
    return [Therapist(row.initials, row.name) for row in rows]


def save_therapists(store: Store, therapists: Iterable[Therapist], previous: Iterable[Therapist] = ()) -> None:
    """Save what differs from the ``previous`` list; what another computer added meanwhile stays."""
    rows, before = ({_therapist_id(one): one for one in listed} for listed in (therapists, previous))
    gone = [delete_row(THERAPIST, row_id) for row_id in before.keys() - rows.keys()]
    changed = {row_id: one for row_id, one in rows.items() if before.get(row_id) != one}
    kept = [upsert_row(THERAPIST, row_id, initials=one.initials, name=one.name) for row_id, one in changed.items()]
    store.apply([*gone, *kept])


def _therapist_id(therapist: Therapist) -> str:
    return uuid.uuid5(uuid.NAMESPACE_OID, therapist.initials).hex


def therapist_words(store: Store, initials: str) -> str:
    """Return ``Katrin Berger (KB)``, the initials alone if the list has no name."""
    name = next((one.name for one in read_therapists(store) if one.initials == initials), "")
    return f"{name} ({initials})" if name else initials


def _form_row(store: Store) -> Row[Any] | None:
    return store.row(select(REPORT_FORM).where(REPORT_FORM.c.id == _FORM_ID))


def _form_from_row(row: Row[Any]) -> ReportForm:
    return ReportForm(
        Letterhead(row.name, tuple(json.loads(row.address)), base64.b64decode(row.logo)), row.paper,
        frozenset(json.loads(row.left_out)), tuple(json.loads(row.sentences)), bool(row.prints_names),
    )  # fmt: skip


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


LIMITS_FILE, LIMITS_FORMAT, LIMITS_VERSION = "error_limits.json", "carpus-error-limits", 1


def read_limits(data_folder: Path) -> ErrorLimits:
    """Return the clinic's own limits, none without a file. Raises :class:`SettingsInvalid`."""
    path = data_folder / LIMITS_FILE
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return ErrorLimits()
    except (OSError, ValueError, RecursionError) as cause:
        raise SettingsInvalid(path, phrase("not readable as JSON, so the default limits apply")) from cause
    try:
        if content["format"] != LIMITS_FORMAT or content["format_version"] != LIMITS_VERSION:
            raise ValueError("another format")
        return ErrorLimits(tuple(_parse_study(one) for one in content["studies"]))
    except (KeyError, TypeError, ValueError, AttributeError) as cause:
        raise SettingsInvalid(path, phrase("no limits, so the default limits apply")) from cause


def _parse_study(content: dict[str, Any]) -> RetestStudy:
    date.fromisoformat(content["made"])
    limits = tuple(
        MeasuredLimit(
            str(one["of"]),
            str(one["movement"]),
            int(one["people"]),
            _parse_error_deg(one["sem_deg"]),
            _parse_interval(one["sem_interval_deg"]),
            _parse_error_deg(one["mdc95_deg"]),
            _parse_interval(one["mdc95_interval_deg"]),
        )
        for one in content["limits"]
    )
    return RetestStudy(
        str(content["protocol"]),
        str(content["exercise"]),
        str(content["angle_order"]),
        str(content["made"]),
        int(content["people"]),
        int(content["sessions"]),
        int(content["raters"]),
        limits,
    )


def _parse_error_deg(value: Any) -> float:
    number = float(value)
    if not 0.0 <= number < 360.0:
        raise ValueError(f"{number} is no error in degrees")
    return number


def _parse_interval(value: Any) -> tuple[float, float]:
    low, high = value
    return tuple(math.nan if one is None else float(one) for one in (low, high))  # type: ignore[return-value]


def save_limits(data_folder: Path, studies: Sequence[RetestStudy]) -> Path:
    """Save studies, each in place of an earlier one of its kind; return the file.

    Raises :class:`SettingsInvalid` if the present file is damaged, and the faults of writing.
    """
    path = data_folder / LIMITS_FILE
    kinds = {(one.protocol, one.exercise, one.angle_order) for one in studies}
    kept = (
        one for one in read_limits(data_folder).studies if (one.protocol, one.exercise, one.angle_order) not in kinds
    )
    content = {
        "format": LIMITS_FORMAT,
        "format_version": LIMITS_VERSION,
        "studies": [asdict(one) for one in (*kept, *studies)],
    }
    return write_new_json(path, content, overwrite=True)

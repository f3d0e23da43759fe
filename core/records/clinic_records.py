"""Records of the clinic: report form, therapists, recipients of letters, backups, and last used folders."""

from __future__ import annotations

import base64
import json
import time
import uuid
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from sqlalchemy import Row, select

from carpus.core.model.errors import ConcurrentChange
from carpus.core.model.names import fold_name
from carpus.core.platform.durable import replace_text
from carpus.core.records.changes import delete_row, insert_row, update_row, upsert_row
from carpus.core.records.schema import BACKUP, RECIPIENT, REPORT_FORM, SESSION, THERAPIST
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

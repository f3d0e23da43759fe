"""The clinic's form of reports, as it is stored: of no patient, the logo as a copy of its own."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any

from sqlalchemy import Row, select

from carpus.core.errors import ChangedMeanwhile
from carpus.core.records.changes import changed, new
from carpus.core.records.schema import REPORT_FORM
from carpus.core.records.store import Store, is_kept_in
from carpus.core.results.report_form import Letterhead, Paper, ReportForm

_ID = "clinic"


def read_form(store: Store, usual: Paper = "a4") -> ReportForm:
    """The form of a clinic; where there is none, no letterhead and the ``usual`` paper."""
    row = _row(store)
    return ReportForm(paper=usual) if row is None else _form(row)


def form_in(folder: Path, usual: Paper = "a4") -> ReportForm:
    """The form of a data folder, for a command."""
    if not is_kept_in(folder):
        return ReportForm(paper=usual)
    with Store(folder) as store:
        return read_form(store, usual)


def keep_form(store: Store, form: ReportForm, before: ReportForm) -> None:
    """Store it in place of the one that was read ``before``.

    Raises :class:`ChangedMeanwhile` where somebody else changed it, and the faults of writing.
    """
    head = form.letterhead
    values = {
        "name": head.name, "address": json.dumps(head.address, ensure_ascii=False), "paper": form.paper,
        "logo": base64.b64encode(head.logo_png).decode("ascii"), "left_out": json.dumps(sorted(form.left_out)),
        "sentences": json.dumps(form.sentences, ensure_ascii=False),
    }  # fmt: skip
    row = _row(store)
    if row is None:
        store.do([new(REPORT_FORM, _ID, **values)])
    elif _form(row) != before:
        raise ChangedMeanwhile(REPORT_FORM.name)
    else:
        store.do([changed(REPORT_FORM, _ID, row.version, **values)])


def _row(store: Store) -> Row[Any] | None:
    return store.row(select(REPORT_FORM).where(REPORT_FORM.c.id == _ID))


def _form(row: Row[Any]) -> ReportForm:
    return ReportForm(
        Letterhead(row.name, tuple(json.loads(row.address)), base64.b64decode(row.logo)), row.paper,
        frozenset(json.loads(row.left_out)), tuple(json.loads(row.sentences)),
    )  # fmt: skip

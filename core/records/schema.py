"""Tables of the store, the same in SQLite and PostgreSQL.

Every row has an ``id`` and a ``version`` that rises with each change, so that concurrent changes are noticed. Times are
ISO 8601 texts with zone; ``*_s`` (seconds since 1970) and ``*_ns`` sort rows.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sqlalchemy import REAL, BigInteger, Column, Double, ForeignKey, Index, Integer, MetaData, Table, Text
from sqlalchemy.types import TypeEngine

VERSION = "3"
"""Schema version; each has a migration script."""
METADATA = MetaData()
_REAL: TypeEngine[float] = Double().with_variant(REAL(), "sqlite")
_LONG: TypeEngine[int] = BigInteger().with_variant(Integer(), "sqlite")


def _texts(*names: str) -> list[Column[Any]]:
    return [Column(name, Text, nullable=False, server_default="") for name in names]


def _numbers(*names: str) -> list[Column[Any]]:
    return [Column(name, Integer, nullable=False, server_default="0") for name in names]


def _reals(*names: str, nullable: bool = False) -> list[Column[Any]]:
    default = None if nullable else "0"
    return [Column(name, _REAL, nullable=nullable, server_default=default) for name in names]


def _foreign_key(parent: str) -> Column[Any]:
    return Column(f"{parent}_id", Text, ForeignKey(f"{parent}.id", ondelete="CASCADE"), nullable=False, index=True)


def _table(name: str, *columns: Column[Any] | list[Column[Any]]) -> Table:
    flat = [one for part in columns for one in (part if isinstance(part, list) else [part])]
    return Table(
        name, METADATA, Column("id", Text, primary_key=True), *flat,
        Column("version", Integer, nullable=False, server_default="1"),
        sqlite_strict=True,
    )  # fmt: skip


PATIENT = _table(
    "patient",
    Column("pseudonym_key", Text, nullable=False, unique=True),
    _texts("pseudonym", "name", "birth_day", "record_number", "sex", "side", "dominance", "note", "search"),
    _texts("archived", "last_session", "last_exercise", "former_pseudonyms", "diagnosis", "onset", "onset_day"),
    _numbers("sessions", "results", "erasing"),
    _reals("added_s", "last_s"),
)
"""``pseudonym_key``: the pseudonym as it is compared. ``former_pseudonyms``: one per line, which files may still have.
``onset``: operation or injury, on ``onset_day``. ``archived``: since when, else empty. Counts and ``last*`` are of
listed, not simulated recordings, updated with each session."""
FORMER_COLUMNS = {"folded": "pseudonym_key", "former": "former_pseudonyms", "last": "last_session"}
"""Names of columns before version 3."""
Index("patient_last", PATIENT.c.last_s, PATIENT.c.added_s)
Index(
    "patient_copy_found", PATIENT.c.search, PATIENT.c.archived, PATIENT.c.erasing, PATIENT.c.last_s, PATIENT.c.added_s,
    PATIENT.c.id,
)  # fmt: skip

SESSION = _table(
    "session",
    Column("patient_id", Text, ForeignKey("patient.id", ondelete="SET NULL")),
    Column("path", Text, nullable=False, unique=True),
    Column("recording_id", Text, nullable=False, index=True),
    _texts("recorded", "created", "exercise", "hand", "by", "archived"),
    _numbers("frames", "complete", "simulated", "erasing"),
    _reals("recorded_s", "created_s", "duration_s"),
    Column("size", _LONG, nullable=False, server_default="0"),
)
"""``path``: relative to the session folder, with slashes. ``by``: initials."""
Index("session_of_patient", SESSION.c.patient_id, SESSION.c.recorded_s)

COMMENT = _table("comment", _foreign_key("session"), _texts("text", "by", "entered"), Column("entered_ns", _LONG))
CORRECTION = _table(
    "correction",
    Column("session_id", Text, ForeignKey("session.id", ondelete="CASCADE"), nullable=False, unique=True),
    _texts("left_out", "edges_s", "reason"),
    _numbers("not_counted"),
)
"""``left_out`` and ``edges_s``: JSON by the number of the repetition."""
MANUAL_MEASUREMENT = _table(
    "measured", _foreign_key("patient"), _texts("measure", "way", "side", "day", "tries", "place", "by", "entered"),
    Column("entered_ns", _LONG, nullable=False),
)  # fmt: skip
"""Measured with goniometer, dynamometer or questionnaire; ``tries`` as JSON."""
SET_UP = _table(
    "set_up", _foreign_key("patient"), _texts("side", "exercise", "discs", "set_id"),
    _numbers("repetitions", "keep_pictures", "ends_free", "for_child"),
    _reals("positive_deg", "negative_deg", nullable=True),
)  # fmt: skip
GOAL = _table(
    "goal", _foreign_key("patient"), _texts("exercise", "side"), _reals("positive_deg", "negative_deg", nullable=True)
)
HOME_PLAN = _table(
    "home_plan", _foreign_key("patient"), _texts("exercises", "made", "again", "at", "note", "language"),
    _numbers("times", "rounds"),
)  # fmt: skip
"""Last home plan; ``exercises`` one per line, ``again``: the next appointment."""
EXERCISE_SET = _table("exercise_set", _texts("name", "discs", "parts"), _numbers("place", "gone"))
REPORT_FORM = _table(
    "report_form", _texts("name", "address", "logo", "paper", "left_out", "sentences"), _numbers("prints_names")
)
THERAPIST = _table("therapist", _texts("initials", "name"))
RECIPIENT = _table("recipient", _texts("address"), _reals("used_s"))
DIAGNOSIS = _table("diagnosis", _texts("words"))
"""The clinic's own list to choose from; a patient's diagnosis is in the patient's row."""
OUTPUT_FILE = _table("made", _foreign_key("session"), _texts("path", "kind"))
"""Files outside the data folder that were made from a session."""
BACKUP = _table("backup", _texts("made", "place"), _numbers("sessions"), Column("size_bytes", _LONG, nullable=False))
AUDIT_LOG = _table(
    "deed", _texts("at", "who", "by", "did", "kind", "subject", "facts"), Column("at_ns", _LONG, index=True)
)
"""Insert only. ``subject``: fingerprint of a patient's or session's id."""

TABLES = dict(METADATA.tables)
"""Tables of what people write, ordered so that rows come after those they refer to."""
FILE_STATE = Table(
    "seen", METADATA, Column("path", Text, primary_key=True), Column("size", _LONG, nullable=False),
    Column("changed_ns", _LONG, nullable=False), Column("reason", Text, nullable=False), sqlite_strict=True,
)  # fmt: skip
"""Files as last read; ``reason`` why one is not a session."""


def rename_former_columns(table: Table, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return a row of an earlier version under the present names, without columns that are gone."""
    renamed = {FORMER_COLUMNS.get(name, name): value for name, value in values.items()}
    return {name: value for name, value in renamed.items() if name in table.c}


SQLITE_LOG = """
CREATE TRIGGER deed_stays BEFORE UPDATE ON deed BEGIN SELECT RAISE(ABORT, 'the log is only added to'); END;
CREATE TRIGGER deed_is_new BEFORE INSERT ON deed WHEN EXISTS (SELECT 1 FROM deed WHERE id = NEW.id OR rowid = NEW.rowid)
BEGIN SELECT RAISE(ABORT, 'the log is only added to'); END;
CREATE TRIGGER deed_is_kept BEFORE DELETE ON deed BEGIN SELECT RAISE(ABORT, 'the log is only added to'); END;
"""

"""Version 3: who a patient is, who measured, and whether reports print names."""

from alembic import op

revision, down_revision, branch_labels, depends_on = "3", "2", None, None

RENAMED = {"folded": "pseudonym_key", "former": "former_pseudonyms", "last": "last_session"}


def upgrade() -> None:
    """Add the columns, give three their plain names, and drop two that nothing uses.

    An age band, which has had no field for long, goes into the note.
    """
    connection = op.get_bind()
    connection.exec_driver_sql(
        "UPDATE patient SET note = trim(note || ' (' || age_band || ')'), search = search || ' ' || age_band"
        " WHERE age_band != ''"
    )
    text = "TEXT DEFAULT '' NOT NULL"
    for change in (
        *(f"ADD COLUMN {name} {text}" for name in ("birth_day", "record_number", "sex")),
        *(f"RENAME COLUMN {old} TO {new}" for old, new in RENAMED.items()),
        "DROP COLUMN age_band",
        "DROP COLUMN takes_part",
    ):
        connection.exec_driver_sql(f"ALTER TABLE patient {change}")
    connection.exec_driver_sql("ALTER TABLE report_form ADD COLUMN prints_names INTEGER DEFAULT 0 NOT NULL")
    strict = " STRICT" if connection.dialect.name == "sqlite" else ""
    connection.exec_driver_sql(
        f"CREATE TABLE therapist (id TEXT NOT NULL PRIMARY KEY, initials {text}, name {text},"
        f" version INTEGER DEFAULT 1 NOT NULL){strict}"
    )

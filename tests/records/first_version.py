"""The script that makes all tables of the store, as the schema has them: what the first migration holds."""

from __future__ import annotations

from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.schema import CreateIndex, CreateTable

from carpus.core.records.schema import COPIED, METADATA, SHARED, SQLITE_LOG

_POSTGRESQL = """
CREATE SEQUENCE carpus_step;
CREATE FUNCTION carpus_next_step() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN
  PERFORM pg_advisory_xact_lock(2026);
  NEW.step := nextval('carpus_step'); RETURN NEW; END $$;
CREATE FUNCTION carpus_gone() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN
  INSERT INTO tombstone (id, of_table) VALUES (OLD.id, TG_TABLE_NAME)
  ON CONFLICT (id) DO UPDATE SET of_table = excluded.of_table; RETURN OLD; END $$;
CREATE FUNCTION carpus_only_added() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN
  RAISE EXCEPTION 'the log is only added to'; END $$;
CREATE TRIGGER deed_stays BEFORE UPDATE OR DELETE OR TRUNCATE ON deed EXECUTE FUNCTION carpus_only_added();
"""
"""One change at a time gets its step, and so steps come in the order in which changes can be seen; what goes once more
gets a new one."""


def statements(dialect_name: str) -> str:
    """For SQLite or PostgreSQL."""
    dialect = sqlite.dialect() if dialect_name == "sqlite" else postgresql.dialect()  # type: ignore[no-untyped-call]
    out = []
    for table in METADATA.sorted_tables:
        out.append(str(CreateTable(table).compile(dialect=dialect)).strip())
        indices = sorted(table.indexes, key=lambda one: str(one.name))
        other = (
            "_step" if dialect_name == "sqlite" else "_found"
        )  # only the server tells steps, only copies are searched
        indices = [one for one in indices if not str(one.name).endswith(other)]
        out += [str(CreateIndex(index).compile(dialect=dialect)).strip() for index in indices]
    text = "".join(f"{' '.join(one.split())};\n" for one in out)
    if dialect_name == "sqlite":
        return text + SQLITE_LOG
    steps = "".join(
        f"CREATE TRIGGER step BEFORE INSERT OR UPDATE ON {name} FOR EACH ROW EXECUTE FUNCTION carpus_next_step();\n"
        for name in [*SHARED, "tombstone"]
    )
    gone = "".join(
        f"CREATE TRIGGER gone AFTER DELETE ON {table.name} FOR EACH ROW EXECUTE FUNCTION carpus_gone();\n"
        for table in COPIED
    )
    return text + _POSTGRESQL + steps + gone

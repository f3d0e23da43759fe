"""Version 1, as it was published: its script never changes."""

from pathlib import Path

from alembic import op

revision, down_revision, branch_labels, depends_on = "1", None, None, None


def upgrade() -> None:
    """Create all tables."""
    connection = op.get_bind()
    script = Path(__file__).with_name(f"1.{connection.dialect.name}.sql").read_text(encoding="utf-8")
    if connection.dialect.name == "sqlite":
        for statement in script.split(";\n"):
            if statement.strip():
                connection.exec_driver_sql(statement)
    else:
        connection.exec_driver_sql(script)

"""Version 2: all computers use the one store, so what their copies of it needed is dropped."""

from alembic import op

revision, down_revision, branch_labels, depends_on = "2", "1", None, None

TABLES = (
    "patient", "session", "comment", "correction", "measured", "set_up", "goal", "home_plan", "exercise_set",
    "report_form", "recipient", "diagnosis", "made", "backup", "deed",
)  # fmt: skip


def upgrade() -> None:
    """Drop the tables of the copies.

    On a server ``delivered`` stays for windows of 0.2.0 that are still open. In SQLite the outbox stays while changes
    wait in it for the server.
    """
    connection = op.get_bind()
    if connection.dialect.name == "postgresql":
        gone = ["FUNCTION carpus_next_step() CASCADE", "FUNCTION carpus_gone() CASCADE", "SEQUENCE carpus_step"]
        gone += ["TABLE tombstone, outbox, own"]
    else:
        waits = connection.exec_driver_sql("SELECT 1 FROM outbox").first() is not None
        gone = ["TABLE delivered", "TABLE tombstone", *(() if waits else ("TABLE outbox", "TABLE own"))]
    for one in gone:
        connection.exec_driver_sql(f"DROP {one}")
    for table in TABLES:
        connection.exec_driver_sql(f"ALTER TABLE {table} DROP COLUMN step")

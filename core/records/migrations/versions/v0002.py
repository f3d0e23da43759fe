"""The second version: every computer works on the one store, which needs nothing of what copies of it needed."""

from alembic import op

revision, down_revision, branch_labels, depends_on = "2", "1", None, None

TABLES = (
    "patient", "session", "comment", "correction", "measured", "set_up", "goal", "home_plan", "exercise_set",
    "report_form", "recipient", "diagnosis", "made", "backup", "deed",
)  # fmt: skip


def upgrade() -> None:
    """On a server ``delivered`` stays: a window of 0.2.0 that is still open delivers by it what waits there. In SQLite
    the outbox stays where changes wait in it, until the server is met."""
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

"""What Alembic runs: the versions, on the connection that it was given."""

from alembic import context

if hasattr(context, "config"):  # Alembic itself reads this, and nobody else
    context.configure(connection=context.config.attributes["connection"])
    context.run_migrations()

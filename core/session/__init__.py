"""Sessions on disk: the one schema, writer, reader, recovery, summary, and the register of patients."""

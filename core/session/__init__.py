"""Sessions on disk: the one schema, writer, reader, recovery."""

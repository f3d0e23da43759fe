"""Session files: schema, writer, reader and recovery."""

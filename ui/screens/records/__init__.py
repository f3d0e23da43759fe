"""Care of records: backup, deletion, archive, retention, log, lock."""

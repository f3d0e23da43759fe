"""What is asked and shown of records: erasing, the archive, what is due, the log."""

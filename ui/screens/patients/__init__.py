"""Patient list: search, summary of a patient, start of a session."""

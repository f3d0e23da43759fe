"""Results of a session: what reports, progress and tables show."""

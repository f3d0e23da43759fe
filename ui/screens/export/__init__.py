"""Export of a session in open formats."""

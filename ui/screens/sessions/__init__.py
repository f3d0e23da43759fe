"""All sessions of a patient: open, set aside, move, rename, delete."""

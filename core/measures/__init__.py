"""Outcome measures of an exercise, by section 5 and 6 of the clinical reference. Pure functions; unknown is NaN."""

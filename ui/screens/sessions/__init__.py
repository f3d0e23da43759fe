"""Sessions of a patient: open, exclude, move, change the exercise, delete."""

"""A stored session: curves with a cursor, repetitions that can be corrected, range of motion."""

"""The first two steps of the set-up: which exercise, and where the pictures come from."""

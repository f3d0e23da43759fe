"""The first two steps of the set-up: exercise and source."""

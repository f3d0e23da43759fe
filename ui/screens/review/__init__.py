"""Review of a stored session: curves, frames, repetitions and results."""

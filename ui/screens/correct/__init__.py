"""Markers of a stored session put right by a person."""

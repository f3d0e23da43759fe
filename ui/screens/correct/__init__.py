"""Correction of marker labels in a stored session."""

"""Endings of what lies beside a session's file, under its name."""

from __future__ import annotations

MARKERS_SUFFIX = ".markers.jpg"
"""The discs as they were stuck: the hand and nothing of the room."""

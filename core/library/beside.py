"""Endings of what lies beside a session's file, under its name."""

from __future__ import annotations

MARKERS_SUFFIX = ".markers.jpg"
"""The discs as they were stuck: the hand and nothing of the room."""
COMMENTS_SUFFIX = ".comments.json"
"""What a therapist wrote of it, all versions."""
CHOICES_SUFFIX = ".choices.json"
"""What a person left out or moved."""

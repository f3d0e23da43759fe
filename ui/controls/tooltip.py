"""Tooltips that say what a person or a file wrote, and never do what it says."""

from __future__ import annotations

from html import escape


def plain_tooltip(text: str) -> str:
    """A text as a tooltip shows it letter by letter; Qt would take tags in it for tags, and load their pictures."""
    return f"<span>{escape(text)}</span>" if "<" in text else text

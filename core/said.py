"""A sentence that core says: its template and the facts in it, so that a window can translate it before filling it.

As a string it is the English sentence, filled: what the command line prints and files hold. ``make translations``
finds the templates by the literal in ``said("...")``.
"""

from __future__ import annotations

from collections.abc import Mapping


class Said(str):
    """An English sentence that knows what it was made of; facts may be :class:`Said` themselves."""

    __slots__ = ("facts", "template")
    template: str
    facts: Mapping[str, object]


def said(template: str, **facts: object) -> Said:
    """The template with the facts in its places; without facts it stays as it is.

    >>> sentence = said("it has no column {name}", name="time")
    >>> sentence, sentence.template, sentence.facts
    ('it has no column time', 'it has no column {name}', {'name': 'time'})
    """
    words = Said(template.format(**facts) if facts else template)
    words.template, words.facts = template, facts
    return words

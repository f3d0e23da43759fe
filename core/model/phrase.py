"""A sentence that core says: its template and the facts in it, so that a window can translate it before filling it.

As a string it is the English sentence, filled: what the command line prints and files hold. ``make translations``
finds the templates by the literal in ``phrase("...")``.
"""

from __future__ import annotations

from collections.abc import Mapping


class Phrase(str):
    """An English sentence that knows what it was made of; facts may be :class:`Phrase` themselves."""

    __slots__ = ("facts", "template")
    template: str
    facts: Mapping[str, object]


def phrase(template: str, **facts: object) -> Phrase:
    """The template with the facts in its places; without facts it stays as it is.

    >>> sentence = phrase("it has no column {name}", name="time")
    >>> sentence, sentence.template, sentence.facts
    ('it has no column time', 'it has no column {name}', {'name': 'time'})
    """
    kept = {name: fact if isinstance(fact, (str, int, float)) else str(fact) for name, fact in facts.items()}
    words = Phrase(template.format(**kept) if kept else template)
    words.template, words.facts = template, kept
    return words

"""Translatable sentences of core: template and facts, so that a window can translate before filling in.

As a string it is the filled English sentence. ``make translations`` finds the literal in ``phrase("...")``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

LANGUAGES = {"en": "English", "de": "Deutsch", "it": "Italiano"}
"""Languages of window and reports by their own names."""


class Phrase(str):
    """English sentence with its template and facts, which may be :class:`Phrase` themselves."""

    __slots__ = ("facts", "template")
    template: str
    facts: Mapping[str, object]


def phrase(template: str, **facts: object) -> Phrase:
    """Fill facts into a template; without facts it stays as it is.

    >>> sentence = phrase("it has no column {name}", name="time")
    >>> sentence, sentence.template, sentence.facts
    ('it has no column time', 'it has no column {name}', {'name': 'time'})
    """
    kept = {name: fact if isinstance(fact, (str, int, float)) else str(fact) for name, fact in facts.items()}
    words = Phrase(template.format(**kept) if kept else template)
    words.template, words.facts = template, kept
    return words


_CONNECTIVES = " (for|at|to|in|für|auf|nach|unter|per|su|a) "
"""Words that join a fact to its sentence in all languages, and go with it if there is none."""


def fill_template(text: str, subject: str, detail: str) -> str:
    """Fill in the facts; the place of a missing fact is removed with its connective."""
    facts = {"subject": subject, "detail": " ".join(detail.split())}
    for name, fact in facts.items():
        if not fact:
            text = re.sub(rf" \([^()]*\{{{name}\}}\)|(: |{_CONNECTIVES}| )\{{{name}\}}", "", text)
    return text.format(**facts)

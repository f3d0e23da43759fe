"""Translation outside widgets: texts of functions share the empty context, as ``lupdate`` files them."""

from __future__ import annotations

import re

from PySide6.QtCore import QCoreApplication

from carpus.core.model.phrase import Phrase
from carpus.ui.kit import language

_DECIMAL = re.compile(r"[-+−]?\d+\.\d+")


def tr(text: str) -> str:
    """The text in the person's language. Widgets use ``self.tr``, whose context is their class."""
    return QCoreApplication.translate("", text)


def to_mid_sentence(words: str) -> str:
    """The words as they stand inside a sentence: with a small first letter where the language has it so. English and
    Italian have it for all words, German for a few that its translation lists; abbreviations keep theirs.

    >>> to_mid_sentence("Right hand"), to_mid_sentence("TAM"), to_mid_sentence("")
    ('right hand', 'TAM', '')
    """
    small = tr("words that lose their capital inside a sentence: *").rpartition(": ")[2].split()
    first = words.partition(" ")[0].rstrip(",.")
    if words[1:2].isupper() or not ("*" in small or first in small):
        return words
    return words[:1].lower() + words[1:]


def translate_phrase(text: str) -> str:
    """A phrase of core in the person's language, its facts in their places; any other text as it is."""
    if not isinstance(text, Phrase):
        return text
    template = QCoreApplication.translate("", text.template)
    if not text.facts:
        return template
    return template.format(**{name: _format_fact(fact) for name, fact in text.facts.items()})


def _format_fact(fact: object) -> object:
    """A fact as it stands in the sentence: a phrase said, a number with the language's decimal sign."""
    if isinstance(fact, Phrase):
        return translate_phrase(fact)
    if isinstance(fact, str) and _DECIMAL.fullmatch(fact):
        return fact.replace(".", language.locale().decimalPoint())
    return fact

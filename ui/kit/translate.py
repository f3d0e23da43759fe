"""Translation outside widgets; ``lupdate`` files such texts in the empty context."""

from __future__ import annotations

import re

from PySide6.QtCore import QCoreApplication

from carpus.core.model.phrase import Phrase
from carpus.ui.kit import language

_DECIMAL = re.compile(r"[-+−]?\d+\.\d+")


def tr(text: str) -> str:
    """Translate a text. Widgets use ``self.tr``, whose context is their class."""
    return QCoreApplication.translate("", text)


def to_mid_sentence(words: str) -> str:
    """Return words as they stand inside a sentence, with a small first letter where the language has one.

    English and Italian have it for all words, German for those that its translation lists. Abbreviations keep their
    capitals.

    >>> to_mid_sentence("Right hand"), to_mid_sentence("TAM"), to_mid_sentence("")
    ('right hand', 'TAM', '')
    """
    small = tr("words that lose their capital inside a sentence: *").rpartition(": ")[2].split()
    first = words.partition(" ")[0].rstrip(",.")
    if words[1:2].isupper() or not ("*" in small or first in small):
        return words
    return words[:1].lower() + words[1:]


def translate_phrase(text: str) -> str:
    """Translate a phrase of core and fill in its facts; return any other text unchanged."""
    if not isinstance(text, Phrase):
        return text
    template = QCoreApplication.translate("", text.template)
    if not text.facts:
        return template
    return template.format(**{name: _format_fact(fact) for name, fact in text.facts.items()})


def _format_fact(fact: object) -> object:
    """Format a fact for its sentence, with the decimal sign of the language."""
    if isinstance(fact, Phrase):
        return translate_phrase(fact)
    if isinstance(fact, str) and _DECIMAL.fullmatch(fact):
        return fact.replace(".", language.locale().decimalPoint())
    return fact

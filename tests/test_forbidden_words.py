"""Words that were taken out of the window's texts in three languages do not come back."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import pytest

from installer.translations import KEPT, LANGUAGES

FORBIDDEN = {
    "en": (
        r"anew", r"is told", r"to be seen", r"discs?", r"knuckles?", r"middle joints?", r"end joints?",
        r"counts? nowhere", r"seal(ed)?", r"figures", r"signs? too many", r"letters too many", r"out of its limits",
        r"back-ups?", r"whoever", r"nobody", r"judged", r"left out", r"work out", r"pictures/s", r"use as targets",
    ),
    "de": (
        r"Umfang", r"Umfänge", r"Winkelmesser", r"Hand verloren", r"Mittelgelenke?", r"Endgelenke?",
        r"Seitbewegung", r"Drehung", r"Zeitverschiebung", r"ungemessen", r"Spitzentempo", r"berichtigen",
        r"Deckung", r"Wiedersehen", r"versiegel\w*", r"über Fehler", r"Bilder/s",
    ),
    "it": (
        r"session[ei]", r"mano persa", r"segni di troppo", r"lettere di troppo", r"nocc(a|he)", r"ferma e rivedi",
        r"dischett[oi]", r"intanto", r"registrazione profondità-colore", r"va oltre", r"sigilla\w*", r"\w'\w+",
    ),
}  # fmt: skip
"""Regular expressions of whole words, by language."""


def texts(language: str) -> list[str]:
    """Return all texts of a language; English ones are the sources of a translation."""
    root = ElementTree.parse(KEPT / f"carpus_{'de' if language == 'en' else language}.ts").getroot()
    if language == "en":
        return [message.findtext("source", "") for message in root.iter("message")]
    return ["".join(node.itertext()) for node in root.iter("translation")]


@pytest.mark.parametrize("language", FORBIDDEN)
def test_texts_contain_no_forbidden_word(language: str) -> None:
    assert set(FORBIDDEN) == {"en", *LANGUAGES}
    words = re.compile(rf"(?<!\w)(?:{'|'.join(FORBIDDEN[language])})(?!\w)", re.IGNORECASE)
    found = texts(language)
    assert len(found) > 1000
    assert [text for text in found if words.search(text)] == []

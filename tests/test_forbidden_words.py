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
        r"pictures?", r"by hand", r"does not count", r"meanwhile", r"anybody", r"strokes?", r"beside", r"kept apart",
        r"known to about", r"tracking again", r"trained", r"usual", r"doubtful", r"not to be", r"put right",
    ),
    "de": (
        r"Umfang", r"Umfänge", r"Winkelmesser", r"Hand verloren", r"Mittelgelenke?", r"Endgelenke?",
        r"Seitbewegung", r"Drehung", r"Zeitverschiebung", r"ungemessen", r"Spitzentempo", r"berichtigen",
        r"Deckung", r"Wiedersehen", r"versiegel\w*", r"über Fehler", r"Bilder/s",
        r"Bemerkung\w*", r"IT-Support", r"Verteiler", r"Hinlangen", r"Flüssigkeit", r"von Hand", r"Markerset",
        r"Berichtigt", r"zählt nicht", r"Festplatten?", r"zweifelhaft\w*", r"Platte wie",
        r"Probepatient\w*", r"Startstellung", r"zum Teil verdeckt", r"EDV-Betreuung", r"Registrierung von Tiefe",
    ),
    "it": (
        r"session[ei]", r"mano persa", r"segni di troppo", r"lettere di troppo", r"nocc(a|he)", r"ferma e rivedi",
        r"dischett[oi]", r"intanto", r"registrazione profondità-colore", r"va oltre", r"sigilla\w*", r"\w'\w+",
        r"assistenza informatica", r"lisciat\w+", r"fonte", r"cliccare", r"refert[oi]", r"a mano",
        r"scheda di controllo", r"«", r"non conta", r"dubbi[oae]?", r"immagine (precedente|seguente|incerta)",
        r"cliccat\w+", r"rifare i clic", r"durante la misura", r"degli esperti", r"(al|del|dal) \{(day|when|date)\}",
        r"(il|del|al) \{(share|percent)\}",
    ),
}  # fmt: skip
"""Regular expressions of whole words, by language."""
GUIDE = KEPT.parent / "guide"


def texts(language: str) -> list[str]:
    """Return all texts of window and guide in a language; English ones are the sources of a translation."""
    pages = "".join(page.read_text("utf-8") for page in sorted((GUIDE / language).glob("*.md")))
    guide = re.sub(r"\]\([^)]*\)", "]", pages).splitlines()  # without the names of files
    root = ElementTree.parse(KEPT / f"carpus_{'de' if language == 'en' else language}.ts").getroot()
    if language == "en":
        return [*guide, *(message.findtext("source", "") for message in root.iter("message"))]
    return [*guide, *("".join(node.itertext()) for node in root.iter("translation"))]


@pytest.mark.parametrize("language", FORBIDDEN)
def test_texts_contain_no_forbidden_word(language: str) -> None:
    assert set(FORBIDDEN) == {"en", *LANGUAGES}
    words = re.compile(rf"(?<!\w)(?:{'|'.join(FORBIDDEN[language])})(?!\w)", re.IGNORECASE)
    found = texts(language)
    assert len(found) > 1000
    assert [text for text in found if words.search(text)] == []

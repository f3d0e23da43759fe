"""How a fault and a marker are said: the facts in their sentences, in English or translated before they are filled."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from carpus.core import errors
from carpus.core.errors import CarpusFault
from carpus.core.installing import how_to_install
from carpus.core.phrase import Phrase, phrase

Say = Callable[[str], str]
"""Says a :class:`Phrase` in a language, any other text as it is."""


@dataclass(frozen=True, slots=True)
class Words:
    """The three answers of every message; ``safe`` is empty where nothing is recorded yet."""

    happened: str
    safe: str
    do: str


_BINDING = " (for|at|to|in|für|auf|nach|unter|per|su|a) "
"""What binds a fact to its sentence, in all languages, and goes with it where there is none."""

_ABOUT_MARKERS = (
    errors.ClickOutsidePicture,
    errors.ClickOnNoMarker,
    errors.MarkerWithoutDepth,
    errors.CalibrationImpossible,
)

MARKERS: dict[str, Phrase] = {
    "WRIST": phrase("wrist"),
    "CMC1": phrase("thumb base"),
    "MCP1": phrase("thumb knuckle"),
    "IP1": phrase("thumb end joint"),
    "TIP1": phrase("thumb tip"),
    "MCP2": phrase("index knuckle"),
    "PIP2": phrase("index finger middle joint"),
    "DIP2": phrase("index finger end joint"),
    "TIP2": phrase("index tip"),
    "MCP3": phrase("middle knuckle"),
    "PIP3": phrase("middle finger middle joint"),
    "DIP3": phrase("middle finger end joint"),
    "TIP3": phrase("middle tip"),
    "MCP4": phrase("ring knuckle"),
    "PIP4": phrase("ring finger middle joint"),
    "DIP4": phrase("ring finger end joint"),
    "TIP4": phrase("ring tip"),
    "MCP5": phrase("little knuckle"),
    "PIP5": phrase("little finger middle joint"),
    "DIP5": phrase("little finger end joint"),
    "TIP5": phrase("little tip"),
}
"""Clinical name of every marker."""


def words_of(fault: CarpusFault, *, marker_names: bool = False, say: Say = str) -> Words:
    """The three answers for this fault; ``marker_names`` adds the markers' names of the files to the clinical ones;
    ``say`` says a phrase in another language."""
    subject = fault.subject
    if isinstance(fault, _ABOUT_MARKERS):
        spoken = markers_in_words(subject.split(", "), say)
        subject = f"{spoken}, {subject}" if marker_names and subject else spoken
    detail = say(fault.detail)
    said = [_filled(say(text), subject, detail) for text in (fault.happened, fault.safe, fault.do)]
    if isinstance(fault, errors.ExtraMissing) and subject:
        said[2] = say(how_to_install(subject))
    return Words(*said)


def one_sentence(fault: CarpusFault) -> str:
    """One line for the command line: what happened, with which file, whether data are safe, and what to do."""
    words = words_of(fault, marker_names=True)
    return " ".join(part for part in (words.happened, words.safe, words.do) if part)


def marker_in_words(marker: str, say: Say = str) -> str:
    """Clinical name of a marker; any other name stays.

    >>> marker_in_words("MCP2"), marker_in_words("CMC1"), marker_in_words("PIP5")
    ('index knuckle', 'thumb base', 'little finger middle joint')
    """
    return say(MARKERS[marker]) if marker in MARKERS else marker


def markers_in_words(markers: list[str] | tuple[str, ...], say: Say = str) -> str:
    """Several markers as a person says them.

    >>> markers_in_words(("MCP2", "MCP3")), markers_in_words(("WRIST", "CMC1", "MCP4"))
    ('index and middle knuckle', 'wrist, thumb base and ring knuckle')
    """
    names = [marker_in_words(marker, say) for marker in markers]
    if len(names) > 1 and all(name.endswith(" knuckle") for name in names):  # as one says it in English
        names = [*(name.removesuffix(" knuckle") for name in names[:-1]), names[-1]]
    if len(names) < 2:
        return "".join(names)
    return say(phrase("{one} and {other}", one=", ".join(names[:-1]), other=names[-1]))


def _filled(text: str, subject: str, detail: str) -> str:
    """Put the facts in their places; a place without a fact goes, with what binds it to the sentence."""
    facts = {"subject": subject, "detail": " ".join(detail.split())}
    for name, fact in facts.items():
        if not fact:
            text = re.sub(rf" \([^()]*\{{{name}\}}\)|(: |{_BINDING}| )\{{{name}\}}", "", text)
    return text.format(**facts)


def on_one_line(happened: str, do: str) -> str:
    """What happened and what to do as one sentence."""
    return f"{happened.removesuffix('.')}; {do[0].lower()}{do[1:]}"

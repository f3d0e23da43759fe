"""How a fault and a marker are said: the facts in their sentences, in English or translated before they are filled."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import PureWindowsPath

from carpus.core import errors
from carpus.core.errors import CarpusFault
from carpus.core.installing import how_to_install
from carpus.core.phrase import Phrase, phrase

Say = Callable[[str], str]
"""Says a :class:`Phrase` in a language, any other text as it is."""


@dataclass(frozen=True, slots=True)
class Words:
    """The three answers of every message; of a fault also its subject area, its code and ``details`` for IT support.

    ``safe`` is empty where nothing is recorded yet.
    """

    happened: str
    safe: str
    do: str
    title: str = ""
    code: str = ""
    details: tuple[str, ...] = ()


_BINDING = " (for|at|to|in|für|auf|nach|unter|per|su|a) "
"""What binds a fact to its sentence, in all languages, and goes with it where there is none."""

_FACT_IN_BRACKETS = re.compile(r" \((\{subject\}, )?\{detail\}\)")
MAX_LETTERS = 32
"""Of a name in the window."""

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


def words_of(fault: CarpusFault, *, marker_names: bool = False, brief: bool = False, say: Say = str) -> Words:
    """Fill the facts of a fault into its sentences.

    Parameters
    ----------
    fault
        The fault.
    marker_names
        Add the markers' names of the files to the clinical ones.
    brief
        For the window: only the end of a path, and the measured fact among the details, where it stands in brackets.
    say
        Says a phrase in another language.
    """
    subject = fault.subject
    if isinstance(fault, _ABOUT_MARKERS):
        spoken = markers_in_words(subject.split(", "), say)
        subject = f"{spoken}, {subject}" if marker_names and subject else spoken
    detail = say(fault.detail)
    templates = [say(text) for text in (fault.happened, fault.safe, fault.do)]
    support = _support_text(fault, say)
    if brief:
        templates = [_FACT_IN_BRACKETS.sub("", text) for text in templates]
        subject = end_of_path(subject)
    happened, safe, do = (_filled(text, subject, detail) for text in templates)
    details = tuple(part for part in (fault.subject, " ".join(detail.split()), support) if part)
    return Words(happened, safe, do, say(fault.title), fault.code, details)


def one_sentence(fault: CarpusFault) -> str:
    """One line for the command line: what happened, to which file, whether data are safe, what to do, and the code."""
    words = words_of(fault, marker_names=True)
    parts = (words.happened, words.safe, words.do, _support_text(fault, str), f"({words.code})")
    return " ".join(part for part in parts if part)


def _support_text(fault: CarpusFault, say: Say) -> str:
    """What who installs and repairs can do besides."""
    if isinstance(fault, errors.ExtraMissing) and fault.subject:
        return say(how_to_install(fault.subject))
    return say(fault.support)


def shorten(name: str, max_letters: int = MAX_LETTERS) -> str:
    """Return the beginning and the end of a long name.

    >>> shorten("Linden-42_2026-11-20_113600_WRIST_FE_right.h5", 24)
    'Linden-42_20…FE_right.h5'
    """
    if len(name) <= max_letters:
        return name
    tail = (max_letters - 1) // 2
    return f"{name[: max_letters - 1 - tail]}…{name[-tail:]}"


def end_of_path(text: str) -> str:
    """Return the last folder and the name of a path; any other text stays."""
    path = PureWindowsPath(text)  # takes both kinds of stroke
    if not path.root or len(path.parts) < 3:
        return text
    return f"…/{shorten(path.parent.name)}/{shorten(path.name)}"


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

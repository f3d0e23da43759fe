"""Texts of faults and markers: facts in their sentences, in English or translated before they are filled in."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import PureWindowsPath

from carpus.core.model import errors
from carpus.core.model.errors import CarpusFault
from carpus.core.model.installation import install_hint
from carpus.core.model.phrase import Phrase, fill_template, phrase

Translate = Callable[[str], str]
"""Translates a :class:`Phrase`; any other text stays."""


@dataclass(frozen=True, slots=True)
class MessageText:
    """Texts of a message: what happened, whether data are safe, and what to do.

    Faults add subject area, code and ``details`` for IT support. ``data_safety`` is empty where nothing is recorded
    yet.
    """

    summary: str
    data_safety: str
    remedy: str
    title: str = ""
    code: str = ""
    details: tuple[str, ...] = ()


_FACT_IN_BRACKETS = re.compile(r" \((\{subject\}, )?\{detail\}\)")
MAX_NAME_CHARACTERS = 32
"""Of a name in the window."""

_ABOUT_MARKERS = (
    errors.ClickOutsideImage,
    errors.ClickOnNoMarker,
    errors.MarkerWithoutDepth,
    errors.CalibrationImpossible,
)

MARKERS: dict[str, Phrase] = {
    "WRIST": phrase("wrist"),
    "CMC1": phrase("thumb CMC"),
    "MCP1": phrase("thumb MCP"),
    "IP1": phrase("thumb IP"),
    "TIP1": phrase("thumb tip"),
    "MCP2": phrase("index MCP"),
    "PIP2": phrase("index PIP"),
    "DIP2": phrase("index DIP"),
    "TIP2": phrase("index fingertip"),
    "MCP3": phrase("middle finger MCP"),
    "PIP3": phrase("middle finger PIP"),
    "DIP3": phrase("middle finger DIP"),
    "TIP3": phrase("middle fingertip"),
    "MCP4": phrase("ring finger MCP"),
    "PIP4": phrase("ring finger PIP"),
    "DIP4": phrase("ring finger DIP"),
    "TIP4": phrase("ring fingertip"),
    "MCP5": phrase("little finger MCP"),
    "PIP5": phrase("little finger PIP"),
    "DIP5": phrase("little finger DIP"),
    "TIP5": phrase("little fingertip"),
}
"""Clinical name of every marker."""


def format_fault(
    fault: CarpusFault, *, marker_names: bool = False, is_brief: bool = False, translate: Translate = str
) -> MessageText:
    """Fill the facts of a fault into its sentences.

    Parameters
    ----------
    fault
        The fault.
    marker_names
        Add the markers' names of the files to the clinical ones.
    is_brief
        For the window: only the end of a path, and the measured fact among the details, where it stands in brackets.
    translate
        Translates a phrase, the identity by default.
    """
    subject = fault.subject
    if isinstance(fault, _ABOUT_MARKERS):
        spoken = join_marker_names(subject.split(", "), translate)
        subject = f"{spoken}, {subject}" if marker_names and subject else spoken
    detail = translate(fault.detail)
    templates = [translate(text) for text in (fault.summary, fault.data_safety, fault.remedy)]
    support = _support_text(fault, translate)
    if is_brief:
        templates = [_FACT_IN_BRACKETS.sub("", text) for text in templates]
        subject = shorten_path(subject)
    happened, safe, do = (fill_template(text, subject, detail) for text in templates)
    details = tuple(part for part in (fault.subject, " ".join(detail.split()), support) if part)
    return MessageText(happened, safe, do, translate(fault.title), fault.code, details)


def format_fault_line(fault: CarpusFault) -> str:
    """Format a fault as one line for the command line, with its code."""
    words = format_fault(fault, marker_names=True)
    parts = (words.summary, words.data_safety, words.remedy, _support_text(fault, str), f"({words.code})")
    return " ".join(part for part in parts if part)


def _support_text(fault: CarpusFault, translate: Translate) -> str:
    if isinstance(fault, errors.ExtraMissing) and fault.subject:
        return translate(install_hint(fault.subject))
    return translate(fault.support)


def shorten(name: str, max_characters: int = MAX_NAME_CHARACTERS) -> str:
    """Return the beginning and the end of a long name.

    >>> shorten("Linden-42_2026-11-20_113600_WRIST_FE_right.h5", 24)
    'Linden-42_20…FE_right.h5'
    """
    if len(name) <= max_characters:
        return name
    tail = (max_characters - 1) // 2
    return f"{name[: max_characters - 1 - tail]}…{name[-tail:]}"


def shorten_path(text: str) -> str:
    """Return the last folder and the name of a path; any other text stays."""
    path = PureWindowsPath(text)  # takes both kinds of stroke
    if not path.root or len(path.parts) < 3:
        return text
    return f"…/{shorten(path.parent.name)}/{shorten(path.name)}"


def marker_name(marker: str, translate: Translate = str) -> str:
    """Return the clinical name of a marker; any other name stays.

    >>> marker_name("MCP2"), marker_name("CMC1"), marker_name("PIP5")
    ('index MCP', 'thumb CMC', 'little finger PIP')
    """
    return translate(MARKERS[marker]) if marker in MARKERS else marker


def join_marker_names(markers: list[str] | tuple[str, ...], translate: Translate = str) -> str:
    """Join the clinical names of markers.

    >>> join_marker_names(("MCP2", "MCP3")), join_marker_names(("WRIST", "CMC1", "MCP4"))
    ('index and middle finger MCP', 'wrist, thumb CMC and ring finger MCP')
    """
    names = [marker_name(marker, translate) for marker in markers]
    if len(names) > 1 and all(name.endswith(" MCP") for name in names):  # as one says it in English
        names = [*(name.removesuffix(" MCP") for name in names[:-1]), names[-1]]
    if len(names) < 2:
        return "".join(names)
    return translate(phrase("{one} and {other}", one=", ".join(names[:-1]), other=names[-1]))


def join_sentences(summary: str, remedy: str) -> str:
    """Join what happened and what to do in one sentence."""
    return f"{summary.removesuffix('.')}; {remedy[0].lower()}{remedy[1:]}"

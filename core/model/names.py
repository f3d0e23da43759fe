"""Rules for what a person types: pseudonyms and names, suggestions for mistyped ones, limits of numbers."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping
from difflib import get_close_matches

from carpus.core.model.errors import NameUnsuited, SettingsInvalid
from carpus.core.model.phrase import phrase

MAX_NAME_CHARACTERS = 100
_INVISIBLE = {"\u034f", "\u115f", "\u1160", "\u2800", "\u3164", "\uffa0", *map(chr, range(0xFE00, 0xFE10))}
"""Fillers, joiners and selectors, which count as letters or marks and show nothing."""


def normalize_name(text: str) -> str:
    """Return a name as stored: NFC, single blanks, none around it. Raises :class:`NameUnsuited`.

    Invisible characters are refused: two names that look alike would differ.

    >>> normalize_name(" Linden 42 ")
    'Linden 42'
    """
    name = re.sub(" +", " ", unicodedata.normalize("NFC", text).strip())
    if sign := next((one for one in name if not one.isprintable() or one in _INVISIBLE), ""):
        called = unicodedata.name(sign, f"U+{ord(sign):04X}").lower()
        raise NameUnsuited(called, phrase("invisible character"))
    if len(name) > MAX_NAME_CHARACTERS:
        raise NameUnsuited(str(len(name)), phrase("more than {count} characters", count=MAX_NAME_CHARACTERS))
    return name


def fold_name(text: str) -> str:
    """Return a name as it is compared, without case and variants of letters."""
    return unicodedata.normalize("NFKC", unicodedata.normalize("NFKC", text).casefold()).strip()


MAX_LISTED_NAMES = 24
MIN_SIMILARITY = 0.6


def find_similar_name(word: str, names: Iterable[str]) -> str | None:
    """Return the known name that a mistyped one most likely means, None if none is similar.

    >>> find_similar_name("trak", ["track", "info"]), find_similar_name("xyz", ["track"])
    ('track', None)
    """
    written = {name.casefold(): name for name in names}
    found = get_close_matches(word.casefold(), written, n=1, cutoff=MIN_SIMILARITY)
    return written[found[0]] if found else None


def describe_known_names(word: str, names: Iterable[str]) -> str:
    """Return a suggestion for a mistyped ``word`` and the known names as a sentence.

    >>> describe_known_names("slwo", ["slow", "brisk"])
    'did you mean “slow”? There are: slow, brisk'
    >>> describe_known_names("x", [])
    'there are none yet'
    """
    names = list(dict.fromkeys(names))
    if not names:
        return phrase("there are none yet")
    listed = ", ".join(names[:MAX_LISTED_NAMES]) + (", …" if len(names) > MAX_LISTED_NAMES else "")
    meant = find_similar_name(word, names)
    if meant is None:
        return phrase("there are: {names}", names=listed)
    return phrase("did you mean “{meant}”? There are: {names}", meant=meant, names=listed)


CAMERAS_FOLDER = "cameras"
"""Folder of camera calibrations and checks in the data folder, where backups find it."""


def file_stem(serial: str) -> str:
    """Return a serial number for use in a file name.

    >>> file_stem("1206/a b")
    '1206-a-b'
    """
    return re.sub(r"[^A-Za-z0-9.]+", "-", serial).strip("-.") or "camera"


Limits = Mapping[str, tuple[float, float]]
"""Minimum and maximum by field."""


def check_limits(section: str, settings: object, limits: Limits) -> None:
    """Raise :class:`SettingsInvalid` for numbers beyond their limits or an empty tuple; None is allowed."""
    for name, (low, high) in limits.items():
        value = getattr(settings, name)
        several = value if isinstance(value, tuple) else (value,)
        if not several or not all(one is None or low <= one <= high for one in several):  # a NaN lies nowhere
            raise SettingsInvalid(section, f"{name} = {value}, from {low:g} to {high:g}")

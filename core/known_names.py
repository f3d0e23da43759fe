"""A name that nobody knows, as every message tells it: what was probably meant, and what there is."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from carpus.core.phrase import phrase

MOST_LISTED = 24
CLOSE_ENOUGH = 0.6


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known name that a mistyped one most likely means, None where none is near.

    >>> nearest("trak", ["track", "info"]), nearest("Ferm 12", ["Fern 12"]), nearest("xyz", ["track"])
    ('track', 'Fern 12', None)
    """
    written = {name.casefold(): name for name in known}
    found = get_close_matches(word.casefold(), written, n=1, cutoff=CLOSE_ENOUGH)
    return written[found[0]] if found else None


def known_names(word: str, known: Iterable[str]) -> str:
    """What was meant by ``word`` and the names that there are, as one sentence for a person.

    >>> known_names("slwo", ["slow", "brisk"])
    'did you mean “slow”? There are: slow, brisk'
    >>> known_names("x", [])
    'there are none yet'
    """
    names = list(dict.fromkeys(known))
    if not names:
        return phrase("there are none yet")
    listed = ", ".join(names[:MOST_LISTED]) + (", …" if len(names) > MOST_LISTED else "")
    meant = nearest(word, names)
    if meant is None:
        return phrase("there are: {names}", names=listed)
    return phrase("did you mean “{meant}”? There are: {names}", meant=meant, names=listed)

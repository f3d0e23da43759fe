"""Names that are nobody's: a word of nature and a number, easy to say and to hear across a room."""

from __future__ import annotations

import random
from collections.abc import Collection

WORDS = (
    "Acorn", "Alder", "Amber", "Apple", "Aspen", "Badger", "Barley", "Beaver", "Beech", "Birch", "Bramble", "Brook",
    "Cedar", "Cherry", "Clover", "Coral", "Cricket", "Daisy", "Dolphin", "Dune", "Elder", "Falcon", "Fern", "Finch",
    "Fir", "Garnet", "Ginger", "Harbour", "Hazel", "Heather", "Heron", "Hickory", "Island", "Ivy", "Jasper", "Juniper",
    "Kestrel", "Lantern", "Lark", "Laurel", "Lilac", "Linden", "Lupin", "Magpie", "Maple", "Marble", "Meadow",
    "Mistral", "Myrtle", "Nutmeg", "Oak", "Olive", "Orchid", "Otter", "Pebble", "Pepper", "Plover", "Poppy", "Quartz",
    "Raven", "Robin", "Rowan", "Saffron", "Sparrow", "Spruce", "Swallow", "Thistle", "Topaz", "Tulip", "Walnut",
    "Willow", "Wren",
)  # fmt: skip
_NUMBERS = range(10, 100)


def suggest_pseudonym(taken: Collection[str], chance: random.Random | None = None) -> str:
    """A free pseudonym such as ``Linden 42``; never made from anything known of the patient.

    >>> suggest_pseudonym((), random.Random(7)).split()[0] in WORDS
    True
    """
    chance = chance or random.SystemRandom()
    used = {name.casefold() for name in taken}
    free = [name for word in WORDS for number in _NUMBERS if (name := f"{word} {number}").casefold() not in used]
    if free:
        return chance.choice(free)
    number = max(_NUMBERS) + 1
    while (name := f"{WORDS[0]} {number}").casefold() in used:
        number += 1
    return name

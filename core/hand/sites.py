"""Where a hand can carry discs, and the names of angles; the order here is that of every model and file.

The model of the hand has a place for a disc at each of these sites, whatever discs a marker protocol uses.
"""

from __future__ import annotations

from collections.abc import Sequence

WRIST_ANGLES = ("deviation", "flexion", "pronosupination")
PALM_MARKERS = ("WRIST", "CMC1", "MCP2", "MCP3", "MCP4", "MCP5")

DIGITS = (1, 2, 3, 4, 5)
"""Thumb to little finger."""
CHAIN_NAMES = (
    ("WRIST", "CMC1", "MCP1", "IP1", "TIP1"),
    *(("WRIST", *(f"{joint}{k}" for joint in ("MCP", "PIP", "DIP", "TIP"))) for k in DIGITS[1:]),
)
"""Sites of each digit from the wrist to the tip."""

SITES = ("WRIST", *(name for chain in CHAIN_NAMES for name in chain[1:]))
PALM_SITES = tuple(SITES.index(name) for name in PALM_MARKERS)
"""Rows in :data:`SITES` of what moves with the palm as one body."""
SITE_CHAINS = tuple(tuple(SITES.index(name) for name in names) for names in CHAIN_NAMES)
"""Rows in :data:`SITES` of each digit, from the wrist to the tip."""

_THUMB = ("CMC1_extension", "CMC1_abduction", "MCP1_flexion", "MCP1_abduction", "IP1_flexion")


def joint_angle_names(dip_free: bool = False, digits: Sequence[int] = DIGITS) -> tuple[str, ...]:
    """The angles of some digits in file order: of all five 17, or 21 where the end joints are free."""
    long_finger = ("MCP{}_abduction", "MCP{}_flexion", "PIP{}_flexion") + (("DIP{}_flexion",) if dip_free else ())
    thumb = _THUMB if 1 in digits else ()
    return thumb + tuple(name.format(k) for k in DIGITS[1:] if k in digits for name in long_finger)


def joint_discs(joint: str) -> tuple[str, str]:
    """The discs that show a joint angle: the one at its joint and the next one outwards.

    >>> joint_discs("PIP4_flexion")
    ('PIP4', 'DIP4')
    """
    at = SITES.index(joint.split("_")[0])
    return SITES[at], SITES[at + 1]

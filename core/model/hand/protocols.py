"""Sites of markers on a hand, names of angles, and the marker protocols.

The model of the hand has a place for a marker at each of these sites; a protocol says which of them have one. The order
here is that of every model and file; nothing outside compares one protocol with another.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from carpus.core.model.errors import ProtocolUnknown

WRIST_ANGLES = ("deviation", "flexion", "pronosupination")
PALM_MARKERS = ("WRIST", "CMC1", "MCP2", "MCP3", "MCP4", "MCP5")

DIGITS = (1, 2, 3, 4, 5)  # thumb to little finger
# Sites of each digit from the wrist to the tip.
CHAIN_NAMES = (
    ("WRIST", "CMC1", "MCP1", "IP1", "TIP1"),
    *(("WRIST", *(f"{joint}{k}" for joint in ("MCP", "PIP", "DIP", "TIP"))) for k in DIGITS[1:]),
)

SITES = ("WRIST", *(name for chain in CHAIN_NAMES for name in chain[1:]))
# Rows in SITES of the markers that move with the palm as one body.
PALM_SITES = tuple(SITES.index(name) for name in PALM_MARKERS)
# Rows in SITES of each digit, from the wrist to the tip.
SITE_CHAINS = tuple(tuple(SITES.index(name) for name in names) for names in CHAIN_NAMES)

_THUMB = ("CMC1_extension", "CMC1_abduction", "MCP1_flexion", "MCP1_abduction", "IP1_flexion")


def joint_angle_names(dip_free: bool = False, digits: Sequence[int] = DIGITS) -> tuple[str, ...]:
    """Return the angles of some digits in file order: of all five 17, or 21 with free DIP joints."""
    long_finger = ("MCP{}_abduction", "MCP{}_flexion", "PIP{}_flexion") + (("DIP{}_flexion",) if dip_free else ())
    thumb = _THUMB if 1 in digits else ()
    return thumb + tuple(name.format(k) for k in DIGITS[1:] if k in digits for name in long_finger)


def markers_at_joint(joint: str) -> tuple[str, str]:
    """Return the markers that show a joint angle: the one at its joint and the next one outwards.

    >>> markers_at_joint("PIP4_flexion")
    ('PIP4', 'DIP4')
    """
    at = SITES.index(joint.split("_")[0])
    return SITES[at], SITES[at + 1]


@dataclass(frozen=True, slots=True)
class MarkerProtocol:
    """The markers on the hand: those of the palm, and those of whole digits.

    ``name`` as in every file; ``markers`` in file order. A digit is tracked where all markers of its chain are there:
    thumb WRIST CMC1 MCP1 IP1 TIP1, finger k WRIST MCPk PIPk DIPk TIPk.
    """

    name: str
    markers: tuple[str, ...]

    def __post_init__(self) -> None:
        if not set(PALM_MARKERS) <= set(self.markers) <= set(SITES):
            raise ValueError(f"{self.name}: the palm's discs are needed, and others only at the sites of a hand")
        loose = set(self.markers) - set(PALM_MARKERS) - {name for digit in self.digits for name in _chain(digit)}
        if loose:
            raise ValueError(f"{self.name}: {', '.join(sorted(loose))} without the other discs of its finger")

    @property
    def palm(self) -> tuple[int, ...]:
        """Rows of the markers that move with the palm as one body."""
        return tuple(self.markers.index(name) for name in PALM_MARKERS)

    @property
    def digits(self) -> tuple[int, ...]:
        """Thumb (1) to little finger (5), those that carry markers from root to tip."""
        return tuple(digit for digit in DIGITS if set(_chain(digit)) <= set(self.markers))

    @property
    def has_fingers(self) -> bool:
        return bool(self.digits)

    @property
    def is_whole_hand(self) -> bool:
        return self.digits == DIGITS

    @property
    def sites(self) -> tuple[int, ...]:
        """Row in ``SITES`` of each marker."""
        return tuple(SITES.index(name) for name in self.markers)

    @property
    def chains(self) -> dict[int, tuple[int, ...]]:
        """Rows of the markers of each digit that it has, from the wrist to the tip."""
        return {digit: self.rows(_chain(digit)) for digit in self.digits}

    def rows(self, names: Sequence[str]) -> tuple[int, ...]:
        return tuple(self.markers.index(name) for name in names)

    def joint_names(self, dip_free: bool = False) -> tuple[str, ...]:
        """Return the joint angles that it measures, in file order; none for the palm alone."""
        return joint_angle_names(dip_free, self.digits)


def _chain(digit: int) -> tuple[str, ...]:
    return CHAIN_NAMES[digit - 1]


WRIST6 = MarkerProtocol("wrist6", PALM_MARKERS)  # the wrist (first paper)
HAND21 = MarkerProtocol("hand21", SITES)  # the whole hand: a marker at every site (second paper)
PROTOCOLS: tuple[MarkerProtocol, ...] = (WRIST6, HAND21)


def protocol_names() -> tuple[str, ...]:
    """Return the protocols' names, in the order in which they are offered."""
    return tuple(protocol.name for protocol in PROTOCOLS)


def get_protocol(name: str) -> MarkerProtocol:
    """Return the protocol of that name.

    Raises
    ------
    ProtocolUnknown
    """
    for protocol in PROTOCOLS:
        if protocol.name == name:
            return protocol
    raise ProtocolUnknown(name, ", ".join(protocol_names()))

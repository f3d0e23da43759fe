"""The marker protocols that there are, and what one says of itself; nothing outside compares one with another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from carpus.core.errors import ProtocolUnknown
from carpus.core.hand.sites import CHAIN_NAMES, DIGITS, PALM_MARKERS, SITES, joint_angle_names


@dataclass(frozen=True, slots=True)
class MarkerProtocol:
    """Which discs are on the hand: those of the palm, and those of whole digits.

    ``name`` as in every file; ``markers`` the discs in file order. A digit is tracked where all discs of its chain are
    there: thumb WRIST CMC1 MCP1 IP1 TIP1, finger k WRIST MCPk PIPk DIPk TIPk.
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
        """Thumb (1) to little finger (5), those that carry discs from root to tip."""
        return tuple(digit for digit in DIGITS if set(_chain(digit)) <= set(self.markers))

    @property
    def has_fingers(self) -> bool:
        return bool(self.digits)

    @property
    def is_whole_hand(self) -> bool:
        """Whether every site has its disc."""
        return self.digits == DIGITS

    @property
    def sites(self) -> tuple[int, ...]:
        """Row in :data:`~carpus.core.hand.sites.SITES` of each marker."""
        return tuple(SITES.index(name) for name in self.markers)

    @property
    def chains(self) -> dict[int, tuple[int, ...]]:
        """Rows of the markers of each digit that it has, from the wrist to the tip."""
        return {digit: self.rows(_chain(digit)) for digit in self.digits}

    def rows(self, names: Sequence[str]) -> tuple[int, ...]:
        return tuple(self.markers.index(name) for name in names)

    def joint_names(self, dip_free: bool = False) -> tuple[str, ...]:
        """The joint angles that it measures, in file order; none where only the palm has discs."""
        return joint_angle_names(dip_free, self.digits)


def _chain(digit: int) -> tuple[str, ...]:
    return CHAIN_NAMES[digit - 1]


WRIST6 = MarkerProtocol("wrist6", PALM_MARKERS)
"""The wrist (first paper)."""
HAND21 = MarkerProtocol("hand21", SITES)
"""The whole hand: a disc at every site (second paper)."""
PROTOCOLS: tuple[MarkerProtocol, ...] = (WRIST6, HAND21)


def protocol_names() -> tuple[str, ...]:
    """Their names, in the order in which they are offered."""
    return tuple(protocol.name for protocol in PROTOCOLS)


def protocol_named(name: str) -> MarkerProtocol:
    """The protocol of that name; raises :class:`ProtocolUnknown`."""
    for protocol in PROTOCOLS:
        if protocol.name == name:
            return protocol
    raise ProtocolUnknown(name, ", ".join(protocol_names()))

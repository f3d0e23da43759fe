"""Marker protocols and the names of angles; the order here is the order in every file."""

from __future__ import annotations

from dataclasses import dataclass

from carpus.core.errors import ProtocolUnknown

WRIST_ANGLES = ("deviation", "flexion", "pronosupination")
PALM_MARKERS = ("WRIST", "CMC1", "MCP2", "MCP3", "MCP4", "MCP5")


@dataclass(frozen=True, slots=True)
class MarkerProtocol:
    """Which discs are on the hand. ``palm`` indexes the markers that move with the palm as one body."""

    name: str
    markers: tuple[str, ...]

    @property
    def palm(self) -> tuple[int, ...]:
        return tuple(self.markers.index(name) for name in PALM_MARKERS)

    @property
    def has_fingers(self) -> bool:
        return len(self.markers) > len(PALM_MARKERS)


WRIST6 = MarkerProtocol("wrist6", PALM_MARKERS)
HAND21 = MarkerProtocol(
    "hand21",
    ("WRIST", "CMC1", "MCP1", "IP1", "TIP1")
    + tuple(f"{joint}{k}" for k in (2, 3, 4, 5) for joint in ("MCP", "PIP", "DIP", "TIP")),
)

HAND21_CHAINS = tuple(
    tuple(HAND21.markers.index(name) for name in names)
    for names in (
        ("WRIST", "CMC1", "MCP1", "IP1", "TIP1"),
        *(("WRIST", *(f"{joint}{k}" for joint in ("MCP", "PIP", "DIP", "TIP"))) for k in (2, 3, 4, 5)),
    )
)
"""Rows of the markers of thumb and fingers 2 to 5 in ``hand21``, from the wrist to the tip."""

_THUMB = ("CMC1_extension", "CMC1_abduction", "MCP1_flexion", "MCP1_abduction", "IP1_flexion")


def joint_angle_names(dip_free: bool = False) -> tuple[str, ...]:
    """The 17 angles of ``hand21`` (21 when the end joints are free), in file order."""
    long_finger = ("MCP{}_abduction", "MCP{}_flexion", "PIP{}_flexion") + (("DIP{}_flexion",) if dip_free else ())
    return _THUMB + tuple(name.format(k) for k in (2, 3, 4, 5) for name in long_finger)


def protocol_named(name: str) -> MarkerProtocol:
    """The protocol of that name; raises :class:`ProtocolUnknown`."""
    for protocol in (WRIST6, HAND21):
        if protocol.name == name:
            return protocol
    raise ProtocolUnknown(name, "wrist6, hand21")

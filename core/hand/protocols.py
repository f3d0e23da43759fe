"""The marker protocols that there are. A further one is a file like ``hand21.py`` and a name in :data:`PROTOCOLS`."""

from __future__ import annotations

from carpus.core.errors import ProtocolUnknown
from carpus.core.hand.hand21 import HAND21
from carpus.core.hand.marker_protocol import MarkerProtocol
from carpus.core.hand.wrist6 import WRIST6

__all__ = ["HAND21", "PROTOCOLS", "WRIST6", "MarkerProtocol", "protocol_named", "protocol_names"]

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

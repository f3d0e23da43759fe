"""The marker protocol of the whole hand: a disc at every site (second paper)."""

from __future__ import annotations

from carpus.core.hand.marker_protocol import MarkerProtocol
from carpus.core.hand.sites import SITES

HAND21 = MarkerProtocol("hand21", SITES)

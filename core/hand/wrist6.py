"""The marker protocol of the wrist: six discs on the palm (first paper)."""

from __future__ import annotations

from carpus.core.hand.marker_protocol import MarkerProtocol
from carpus.core.hand.sites import PALM_MARKERS

WRIST6 = MarkerProtocol("wrist6", PALM_MARKERS)

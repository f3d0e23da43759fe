"""Settings of the detection."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class DetectionSettings:
    """Settings of the detection.

    ``marker_radius_m`` of the paper discs; ``skin_share`` of the rim of a blob that must be skin or paper for it to lie
    on a hand; ``least_area``, ``most_area`` of a blob over that of a disc, relative to those learnt; ``most_blobs`` are
    reported of a frame.
    """

    marker_radius_m: float = 0.006
    skin_share: float = 0.25
    least_area: float = 0.12
    most_area: float = 2.2
    most_blobs: int = 48

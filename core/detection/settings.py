"""Settings of the detection."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class DetectionSettings:
    """Settings of the detection.

    Attributes
    ----------
    marker_radius_m : float
        Radius of the paper markers.
    min_skin_share : float
        Share of a blob's rim that must be skin or paper, so that the blob lies on a hand.
    min_area_ratio, max_area_ratio : float
        Limits of a blob's area over that of a marker at its depth, relative to the ratios learnt at calibration.
    max_blobs : int
        Blobs returned of one frame; the largest are kept.
    """

    marker_radius_m: float = 0.006
    min_skin_share: float = 0.25
    min_area_ratio: float = 0.12
    max_area_ratio: float = 2.2
    max_blobs: int = 48

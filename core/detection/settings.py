"""What can be chosen about detection."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class DetectionSettings:
    """``marker_radius_m`` of the paper discs and ``small_radius_m`` of the small ones (reference 2).

    Areas and similarities are relative to those learnt.

    ``paper_share``: a pixel belongs to a marker when its colour is this much likelier on paper than on the
    skin around; ``skin_share`` of the rim of a blob must be skin or paper for it to lie on a hand;
    ``darkest``: brightness below this share of the clicked markers' is no marker;
    ``least_area``, ``most_area``: blob area over the expected area of a disc;
    ``depth_valid_share``, ``depth_iqr_m``: when a blob's depth is not trusted (reference 7.2);
    ``slope_share``: on a steep surface half a pixel between the two pictures is a depth error of this share of
    the spread of the readings; ``edge_step_m``: a reading this far from the blob's is of another surface, and
    ``edge_sd_m`` is the depth's sd if all around were.
    """

    marker_radius_m: float = 0.006
    small_radius_m: float = 0.004
    paper_share: float = 0.5
    skin_share: float = 0.25
    darkest: float = 0.25
    least_area: float = 0.12
    most_area: float = 2.2
    least_similarity: float = 0.5
    region_sd: float = 4.0
    depth_valid_share: float = 0.3
    depth_iqr_m: float = 0.008
    slope_share: float = 0.35
    edge_step_m: float = 0.015
    edge_sd_m: float = 0.008
    most_blobs: int = 48

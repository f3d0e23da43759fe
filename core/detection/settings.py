"""What can be chosen about detection."""

from __future__ import annotations

from dataclasses import dataclass, field

from carpus.core.detection.components import TouchingSettings
from carpus.core.detection.stencil import StencilSettings
from carpus.core.detection.surface_samples import SamplingSettings


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
    ``edge_sd_m`` is the depth's sd if all around were; ``fewest_readings`` make a depth.
    ``paper_low``, ``paper_high``: shares of paper in a pixel below and above these count as none and all; symmetric, so
    an edge's centre stays. With fewer pixels than ``fewest_rim`` in a direction of the rim, or ``fewest_core`` in the
    core, all of the rim or of the blob is taken.

    Learning the colours: discs are found from clicks within ``click_reach`` radii (about 10 px at 0.7 m), their pixels
    are paper up to ``paper_reach`` radii, those at the edge more paper than skin; ``learning_rounds`` at most;
    ``fallback_radius_px`` of a disc where there is no depth.
    Without a prediction the hand is looked for in a picture ``coarse`` times smaller, as what is of skin's colour from
    ``skin_level`` on, of paper's from ``paper_level`` (of 255). ``usual_depth_m`` where none is read; however little is
    known of where a disc is, it is looked for no further away than ``most_unsure_px``.
    ``stencil`` of the window about a blob, ``touching`` discs, ``sampling`` of depths beside the discs.
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
    fewest_readings: int = 3
    paper_low: float = 0.2
    paper_high: float = 0.8
    fewest_rim: float = 3.0
    fewest_core: float = 4.0
    click_reach: float = 2.2
    paper_reach: float = 0.8
    learning_rounds: int = 3
    fallback_radius_px: float = 5.0
    coarse: int = 4
    skin_level: int = 128
    paper_level: int = 96
    usual_depth_m: float = 0.7
    most_unsure_px: float = 120.0
    stencil: StencilSettings = field(default_factory=StencilSettings)
    touching: TouchingSettings = field(default_factory=TouchingSettings)
    sampling: SamplingSettings = field(default_factory=SamplingSettings)

"""What can be chosen about thumb and fingers, with defaults and where they come from."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FingerSettings:
    """Defaults for ``hand21``.

    ``skin_offsets``: discs lie on the skin over the joints; without them the chain of the hand paper, discs in the
    joints. ``abduction_share`` of the process noise of flexion for abductions and the thumb's CMC (reference 4.5).
    ``range_after_s``: a joint that no disc shows is spread over its anatomical range within this time.
    ``learning``: share of what a picture says of the anatomy that is believed, against errors that stay.
    ``drift_per_s``: share of what was not known of the anatomy that comes back each second (skin over bone).
    ``skin_px``: how far a disc on a finger strays from where the model has it, besides the noise of its centre.
    ``depth_stays_m``: error of a disc's depth that no averaging removes. ``hidden_s`` and ``shown_s``: how long a disc
    stays hidden or seen on average; ``steepest_rad``: tilt at which discs vanish, give or take ``steepest_sd_rad``.
    ``clutter``: other blobs expected in a picture.
    """

    skin_offsets: bool = True
    abduction_share: float = 0.5
    range_after_s: float = 0.5
    learning: float = 0.2
    drift_per_s: float = 2e-3
    skin_px: float = 0.1
    depth_stays_m: float = 0.0004
    hidden_s: float = 0.4
    shown_s: float = 3.0
    steepest_rad: float = 1.22
    steepest_sd_rad: float = 0.15
    clutter: float = 3.0

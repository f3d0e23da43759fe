"""What can be chosen about thumb and fingers, with defaults and where they come from."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from carpus.core.hand.anatomy_prior import AnatomyPrior


@dataclass(frozen=True, slots=True)
class FingerSettings:
    """Defaults for ``hand21``.

    ``skin_offsets``: discs lie on the skin over the joints; without them the chain of the hand paper, discs in the
    joints. ``abduction_share`` of the process noise of flexion for abductions and the thumb's CMC (reference 4.5).
    ``range_after_s``: a joint that no disc shows is spread over its anatomical range within this time.
    ``learning``: share of what a picture says of the anatomy that is believed, against errors that stay: neighbouring
    pictures show skin that strays from its joint by millimetres in the same way.
    ``drift_per_s``: share of what was not known of the anatomy that comes back each second (skin over bone).
    ``skin_px``: how far a disc on a finger strays from where the model has it, besides the noise of its centre.
    ``depth_stays_m``: error of a disc's depth that no averaging removes. ``hidden_s`` and ``shown_s``: how long a disc
    stays hidden or seen on average; ``steepest_rad``: tilt at which discs vanish, give or take ``steepest_sd_rad``.
    ``clutter``: other blobs expected in a picture. ``skin_sd_rad``: how far discs
    that ride on gliding skin mislead about a joint, however long it is seen. ``anatomy``: how far a hand may
    differ from the average one.

    ``dip_slack_rad``: how far end joints that follow the middle ones stray from two thirds of them;
    ``thumb_aside_rad``: how far the thumb's MCP joint, which hardly moves sideways, strays from straight; both return
    within ``settles_s``.
    ``patience_frames`` for which a digit may show fewer than two discs before it is searched; ``posture_sd_rad`` of the
    grid on which it is, ``posture_rate_sd`` of its rates then, ``begins_rate_sd`` of those of a hand found again.
    A joint expected less surely than ``far_rad`` may be far from where h was linearised; a disc seen with less than the
    chance ``was_seen`` was hidden a moment ago; ``surely_sd`` beyond its reach a joint surely is not.
    ``size_grows``, ``size_shrinks``: how much of a picture's is taken into a disc's size, which half a disc understates
    and nothing overstates, while it is tilted by less than ``flat_rad``; tilted discs show no less than
    ``least_facing``. Centres of discs nearer than ``crowded_radii`` stray by ``crowded_px``. A blob ``merged_from``
    times as large as its disc seen square holds a neighbour's too (of single ones 99.9 % are smaller); where along
    it either lies is unsure by ``merged_share`` of what lies between them and its centre. ``click_px`` of a disc with
    no depth. ``across_m``: how closely a disc holds its joints across the line of sight where errors stay;
    ``sure_turn_rad`` of the palm, all axes, at which half as much is learnt of the fingers.
    ``gap_s`` between pictures from which on limits count before a picture too; a
    finger ``most_beyond_rad`` past its limits was misread.

    The chance that a disc is to be seen stays between ``least_seen`` and ``most_seen``, is ``seen_anew`` on a digit
    begun anew, and one that is in sight goes without a name with the chance ``missed``. Where a digit's names are
    weighed jointly each disc may be one of ``candidates`` blobs, one without its depth counted ``without_depth2``
    (squared standard deviations) further off. ``pinnings``: how often h is linearised again, of a digit found far from
    where it was expected, about what its discs say. ``inherited``: share of a joint's information that resists errors
    of its discs that stay.
    """

    skin_offsets: bool = True
    abduction_share: float = 0.5
    range_after_s: float = 0.5
    learning: float = 0.02
    drift_per_s: float = 2e-3
    skin_px: float = 0.1
    depth_stays_m: float = 0.0004
    hidden_s: float = 0.4
    shown_s: float = 3.0
    steepest_rad: float = 1.22
    steepest_sd_rad: float = 0.15
    clutter: float = 3.0
    skin_sd_rad: float = 0.022
    anatomy: AnatomyPrior = field(default_factory=AnatomyPrior)
    dip_slack_rad: float = math.radians(6.0)
    thumb_aside_rad: float = math.radians(6.0)
    settles_s: float = 1.0
    patience_frames: int = 2
    posture_sd_rad: float = math.radians(12.0)
    posture_rate_sd: float = 3.0
    begins_rate_sd: float = 1.0
    far_rad: float = math.radians(10.0)
    was_seen: float = 0.5
    surely_sd: float = 1.5
    size_grows: float = 0.2
    size_shrinks: float = 0.02
    flat_rad: float = math.radians(50.0)
    least_facing: float = 0.15
    crowded_px: float = 0.5
    crowded_radii: float = 2.4
    merged_from: float = 1.25
    merged_share: float = 0.5
    click_px: float = 2.0
    across_m: float = 0.00015
    sure_turn_rad: float = math.radians(1.0)
    gap_s: float = 0.12
    most_beyond_rad: float = math.radians(30.0)
    least_seen: float = 1e-4
    most_seen: float = 0.98
    seen_anew: float = 0.5
    missed: float = 0.1
    candidates: int = 4
    without_depth2: float = 14.0
    pinnings: int = 2
    inherited: float = 0.25

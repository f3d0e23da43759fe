"""When a hand counts as held in view, and when it is looked for anew."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class HoldingSettings:
    """Discs that lie within ``narrow_m`` (rms) of one line say nothing of turning about it.

    ``least_discs`` of the palm that tell its pose, below which a frame is predicted. A hand found again out of
    nothing must keep showing for ``probation_s``; four discs among those of fingers must do so for ``suspected_s``
    before they are believed. ``share_window_s`` over which the share of direct measurements is told.

    Expecting the hand's turn less surely than ``vague_rad`` the filter may settle on wrong names or at a wrong pose;
    less surely than ``too_vague_rad`` sigma points reach too far for a correction to be trusted even by the right
    names. Less surely than ``blind_rad`` any so many blobs would do for discs: none, one, two, three of them;
    ``blind_among_fingers_rad`` where there are discs on fingers, which can look like some of the palm, even like five.

    A hand gone from sight is not found turned further than it may have turned meanwhile (``turn_slack_rad`` and
    ``most_rate_rad_s``), nor ever the other way (``most_turn_rad``); lost and looked for anywhere, it is turned no
    further than that from the neutral pose.
    """

    narrow_m: float = 0.008
    least_discs: int = 3
    probation_s: float = 0.2
    suspected_s: float = 0.09
    share_window_s: float = 1.0
    vague_rad: float = 0.15
    too_vague_rad: float = 0.5
    blind_rad: tuple[float, ...] = (0.1, 0.1, 0.15, 0.35)
    blind_among_fingers_rad: tuple[float, ...] = (0.1, 0.06, 0.15, 0.25, 0.35, 0.5)
    turn_slack_rad: float = 0.35
    most_rate_rad_s: float = 12.0
    most_turn_rad: float = 1.9

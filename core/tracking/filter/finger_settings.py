"""Settings of thumb and fingers."""

from __future__ import annotations

from dataclasses import dataclass, field

from carpus.core.model.hand.anatomy_prior import AnatomyPrior


@dataclass(frozen=True, slots=True)
class FingerSettings:
    """Settings of thumb and fingers.

    ``skin_offsets``: discs lie on the skin over the joints; without them the chain of the hand paper, discs in the
    joints. ``anatomy``: how far a hand may differ from the average one.
    """

    skin_offsets: bool = True
    anatomy: AnatomyPrior = field(default_factory=AnatomyPrior)

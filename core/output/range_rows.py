"""One range of motion as it is shown: of an angle of the wrist, a joint of the hand, or a whole finger (TAM)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from carpus.core.measures.motion_range import RangeFigure
from carpus.core.output.exercises import Movement
from carpus.core.session.values import Motion, Session

RowKey = tuple[str, Movement, int]
"""Joint (empty for the wrist), movement, column of the wrist's angle (-1 for a joint)."""


@dataclass(frozen=True, slots=True)
class RangeRow:
    """Range of one movement over the counted repetitions. ``values_deg`` one each; ``limited`` by the camera's view."""

    movement: Movement
    angle: int
    mean_deg: float
    sd_deg: float
    best_deg: float
    measurement_sd_deg: float
    values_deg: tuple[float, ...]
    limited: bool
    joint: str = ""
    """The joint angle or ``TAM3``, by its name in every file; empty for the wrist, whose ``angle`` is its column."""
    seen_share: float = math.nan
    """Share of all frames in which the joint was seen."""
    inferred: bool = False
    """Whether an end joint that no disc measures is part of it."""

    @property
    def key(self) -> RowKey:
        """What it is the range of."""
        return self.joint, self.movement, self.angle

    @property
    def count(self) -> int:
        """Repetitions in the mean."""
        return len(self.values_deg)


def best_motion(session: Session) -> Motion:
    """The smoother's result where there is one, else the filter's."""
    return session.motion if session.smoothed is None else session.smoothed


def is_total(joint: str) -> bool:
    """Whether a row's joint is the total active motion of a finger."""
    return joint.startswith("TAM")


def range_row(movement: Movement, angle: int, figure: RangeFigure, limited: bool) -> RangeRow:
    """A row of the wrist; :func:`dataclasses.replace` makes it one of a joint."""
    values = tuple(math.degrees(value) for value in figure.values)
    return RangeRow(
        movement, angle, math.degrees(figure.mean), math.degrees(figure.spread_sd), math.degrees(figure.best),
        math.degrees(figure.measurement_sd), values, limited,
    )  # fmt: skip

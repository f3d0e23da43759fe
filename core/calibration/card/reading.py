"""What one check of a camera measured, and the fixed limits of its errors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from carpus.core.calibration.card.card import FIGURES
from carpus.core.types import FloatArray

CHECK_S = 30.0
"""Length of a check."""
MOST_ANGLE_DEG, MOST_LENGTH_MM, MOST_SCALE = 2.0, 2.5, 0.012
"""Fixed limits of the largest error of an angle and a length, and of all lengths together; the first two are wider for
a sensor that cannot do better (:mod:`core.calibration.card.measure`)."""


@dataclass(frozen=True, slots=True)
class CardReading:
    """What one check measured: ``measured`` and ``sd`` (6,) of :data:`FIGURES` in degrees and millimetres, the standard
    deviation that of one picture; ``scale`` of all distances between the discs, measured over true; ``distance_m`` to
    the card; ``pictures`` that count of those ``looked`` at; ``most_angle_deg`` and ``most_length_mm`` its limits."""

    measured: FloatArray
    sd: FloatArray
    scale: float
    distance_m: float
    pictures: int
    looked: int
    most_angle_deg: float = MOST_ANGLE_DEG
    most_length_mm: float = MOST_LENGTH_MM

    @property
    def errors(self) -> FloatArray:
        """Measured less true (6,)."""
        return np.asarray(self.measured - np.array([figure.true for figure in FIGURES]))

    @property
    def angle_error_deg(self) -> float:
        """The largest of the three."""
        return float(np.abs(self.errors[:3]).max())

    @property
    def length_error_mm(self) -> float:
        """The largest of the three."""
        return float(np.abs(self.errors[3:]).max())

    @property
    def angles_hold(self) -> bool:
        """Whether angles are within their limit."""
        return within_angles(self.angle_error_deg, self.most_angle_deg)

    @property
    def lengths_hold(self) -> bool:
        """Whether lengths are, each and all together."""
        return within_lengths(self.length_error_mm, self.scale, self.most_length_mm)


def within_angles(error_deg: float, most_deg: float) -> bool:
    """Whether the largest error of an angle is within its limit."""
    return error_deg <= most_deg


def within_lengths(error_mm: float, scale: float, most_mm: float) -> bool:
    """Whether the largest error of a length, and that of all lengths together, are within theirs."""
    return error_mm <= most_mm and abs(scale - 1.0) <= MOST_SCALE

"""Limits by which a calibration is judged."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CalibrationSettings:
    """Limits of the hand calibration.

    ``still_s`` is the longest time averaged, ``least_distance_m`` that of the wrist paper (II-C), ``most_tilt_deg`` of
    the palm to the image, ``hand_length_mm`` of a child of six to a tall man.
    """

    still_s: float = 0.5
    least_distance_m: float = 0.6
    most_tilt_deg: float = 15.0
    most_residual_mm: float = 4.0
    hand_length_mm: tuple[float, float] = (110.0, 225.0)

"""Limits by which a calibration is judged."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CalibrationSettings:
    """Limits of the hand calibration.

    Attributes
    ----------
    still_s : float
        Longest time over which the neutral pose is averaged while the hand is still.
    min_distance_m : float
        From camera to hand; wrist paper, II-C.
    max_tilt_deg : float
        Of the back of the hand to the image plane.
    max_residual_mm : float
        Of a marker from its expected position.
    hand_length_mm : tuple of float
        Shortest and longest plausible hand: a child of six to a tall man.
    """

    still_s: float = 0.5
    min_distance_m: float = 0.6
    max_tilt_deg: float = 15.0
    max_residual_mm: float = 4.0
    hand_length_mm: tuple[float, float] = (110.0, 225.0)

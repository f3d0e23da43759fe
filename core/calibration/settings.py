"""Limits by which a calibration is judged, and what it assumes of the sensor."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CalibrationSettings:
    """``still_s`` longest stretch averaged; ``still_px`` by how much the discs may have moved meanwhile;
    ``least_distance_m`` of the wrist paper (II-C); ``most_tilt_deg`` of the palm to the picture;
    ``most_residual_mm`` of a disc; ``hand_length_mm`` shortest and longest believed (a child of six to a
    tall man); ``enough_frames`` for a neutral pose worth its name; ``pixel_sd_px`` of a disc's centre where these
    are too few to show it, ``pixel_stays_px`` what of it no averaging removes.
    """

    still_s: float = 0.5
    still_px: float = 0.7
    least_distance_m: float = 0.6
    most_tilt_deg: float = 15.0
    most_residual_mm: float = 4.0
    hand_length_mm: tuple[float, float] = (110.0, 225.0)
    enough_frames: int = 5
    pixel_sd_px: float = 0.3
    pixel_stays_px: float = 0.1

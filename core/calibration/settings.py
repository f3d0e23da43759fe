"""Limits by which a calibration is judged, and what it assumes of the sensor."""

from __future__ import annotations

from dataclasses import dataclass, field

from carpus.core.calibration.candidates import CandidateSettings
from carpus.core.calibration.name_checks import FingerOrderSettings, OddDiscSettings, PalmNameSettings, SideSettings
from carpus.core.calibration.naming import NamingSettings
from carpus.core.calibration.still_depth import BackSettings, RegistrationSettings


@dataclass(frozen=True, slots=True)
class CalibrationSettings:
    """``still_s`` longest stretch averaged; ``still_px`` by how much the discs may have moved meanwhile;
    ``least_distance_m`` of the wrist paper (II-C); ``most_tilt_deg`` of the palm to the picture;
    ``most_residual_mm`` of a disc; ``hand_length_mm`` shortest and longest believed (a child of six to a
    tall man); ``enough_frames`` for a neutral pose worth its name; ``pixel_sd_px`` of a disc's centre where these
    are too few to show it, ``pixel_stays_px`` what of it no averaging removes. While the hand is still a disc lies
    within ``same_disc_px`` of where it was clicked, ``least_discs`` of them at least. ``most_length_change`` of a
    hand since last time: discs put on anew lie up to half a centimetre elsewhere on the 8 cm that are measured.

    What is taken for a disc (``candidates``), the names proposed for it (``naming``), and what speaks against names and
    places (``finger_order``, ``palm_names``, ``side``, ``odd_disc``); whether depth lies on colour (``registration``);
    the ``back`` of the hand as a surface.
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
    same_disc_px: float = 4.0
    least_discs: int = 3
    most_length_change: float = 0.15
    candidates: CandidateSettings = field(default_factory=CandidateSettings)
    naming: NamingSettings = field(default_factory=NamingSettings)
    finger_order: FingerOrderSettings = field(default_factory=FingerOrderSettings)
    palm_names: PalmNameSettings = field(default_factory=PalmNameSettings)
    side: SideSettings = field(default_factory=SideSettings)
    odd_disc: OddDiscSettings = field(default_factory=OddDiscSettings)
    registration: RegistrationSettings = field(default_factory=RegistrationSettings)
    back: BackSettings = field(default_factory=BackSettings)

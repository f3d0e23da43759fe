"""What calibration hands on: the clicks, the measured palm or hand, the neutral pose, the verdict."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from carpus.core.hand.back_surface import BackSurface
from carpus.core.hand.marker_protocol import MarkerProtocol
from carpus.core.types import FloatArray, Side

FindingKind = Literal[
    "click_on_no_marker",
    "two_clicks_on_one",
    "swapped",
    "misnamed",
    "shifted",
    "wrong_side",
    "no_depth",
    "residual",
    "hand_length",
    "other_length",
    "tilt",
    "distance",
    "moved",
    "few_frames",
    "depth_off",
    "other_spot",
    "spare_spot",
    "near_spot",
    "no_palm",
]

ALL_STRAIGHT = (True, True, True, True, True)
"""Thumb to little; what is taken for granted of a hand unless a person says otherwise."""


@dataclass(frozen=True, slots=True)
class Clicks:
    """A person's clicks on the first colour frame: ``pixel`` (M, 2), in the order of the protocol.

    ``straight_fingers`` thumb to little: what the person says of each finger at the neutral pose; empty where nobody
    said anything.
    """

    side: Side
    protocol: MarkerProtocol
    pixel: FloatArray
    straight_fingers: tuple[bool, ...] = ()


@dataclass(frozen=True, slots=True)
class CalibrationFinding:
    """One thing that is not as it should be. ``value`` in ``unit`` against ``limit``; words are elsewhere.

    ``markers`` of "swapped": those of one finger, then as many of the other, each for each; of "shifted": after each
    name the one that its disc should have.
    """

    kind: FindingKind
    markers: tuple[str, ...] = ()
    value: float = float("nan")
    limit: float = float("nan")
    unit: str = ""
    blocks: bool = False
    """True when no tracking can start from it (a click with no blob, a marker with no depth)."""
    spot_px: tuple[float, ...] = ()
    """Pixel (u, v) of the spot in question that has no name; nothing where it is about the markers themselves."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "spot_px", tuple(self.spot_px))  # a list in the session file


@dataclass(frozen=True, slots=True)
class Verdict:
    """Plain values on which a person judges the calibration.

    ``residual_mm`` (M,) distance of each disc from the fitted place, averaged over the frames used;
    ``hand_length_mm`` estimated from the palm; ``tilt_deg`` of the palm's normal to the camera's axis;
    ``distance_m`` of WRIST; ``frames_used`` still frames averaged.
    """

    residual_mm: FloatArray
    hand_length_mm: float
    tilt_deg: float
    distance_m: float
    frames_used: int
    findings: tuple[CalibrationFinding, ...]

    @property
    def is_good(self) -> bool:
        return not self.findings

    @property
    def can_start(self) -> bool:
        """Whether a person may measure although there are findings: not with names that are surely wrong."""
        return not any(finding.blocks or finding.kind == "shifted" for finding in self.findings)


@dataclass(frozen=True, slots=True)
class Calibration:
    """The measured hand at its neutral pose.

    ``marker_position_w0_m`` (M, 3) disc centres in W0; ``rotation_w0_cam`` (3, 3) and
    ``translation_w0_cam_m`` (3,) the pose g_w0c of the wrist paper; ``marker_covariance_w0_m2`` (M, 3, 3)
    how well each disc's place is known, which every later angle inherits;
    ``start_angles_rad`` (3,) deviation, flexion, pronosupination given by the therapist for a patient who
    cannot lie neutral, zero otherwise; ``surface`` of the back of the hand over its fixed unit, None where too little
    of it was seen.
    """

    clicks: Clicks
    marker_position_w0_m: FloatArray
    rotation_w0_cam: FloatArray
    translation_w0_cam_m: FloatArray
    marker_covariance_w0_m2: FloatArray
    start_angles_rad: FloatArray
    verdict: Verdict
    surface: BackSurface | None = None

    @property
    def straight_fingers(self) -> tuple[bool, ...]:
        """Thumb to little: False for a finger that could not lie straight at the neutral pose."""
        return self.clicks.straight_fingers or ALL_STRAIGHT

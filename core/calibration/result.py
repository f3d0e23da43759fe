"""Values of the hand calibration: clicks, measured hand, neutral pose, verdict."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from carpus.core.model.fault_text import MessageText, Translate, join_marker_names, join_sentences, marker_name
from carpus.core.model.hand.dorsal_surface import DorsalSurface
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.model.types import FloatArray, Side

ALL_STRAIGHT = (True, True, True, True, True)
"""Thumb to little finger; assumed unless a person says otherwise."""


@dataclass(frozen=True, slots=True)
class Clicks:
    """Labelled pixels (M, 2) on the first frame, in the order of the protocol.

    ``straight_fingers``: thumb to little finger, empty if nothing was entered; ``exercise``: id of what the recording
    shows, empty if unknown.
    """

    side: Side
    protocol: MarkerProtocol
    pixel: FloatArray
    straight_fingers: tuple[bool, ...] = ()
    exercise: str = ""


@dataclass(frozen=True, slots=True)
class CalibrationFinding:
    """Problem of a calibration, of a kind in ``FINDING_TEXTS``: ``value`` in ``unit`` against ``limit``.

    ``markers`` of "swapped": those of one finger, then as many of the other; of "shifted": each label is followed by
    the right one.
    """

    kind: str
    markers: tuple[str, ...] = ()
    value: float = float("nan")
    limit: float = float("nan")
    unit: str = ""
    blocks: bool = False
    """True if tracking cannot start (a click without a blob, a marker without depth)."""
    spot_px: tuple[float, ...] = ()
    """Pixel (u, v) of the unlabelled spot, empty if there is none."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "spot_px", tuple(self.spot_px))  # a list in the session file


@dataclass(frozen=True, slots=True)
class Verdict:
    """Values by which a person accepts the calibration.

    Attributes
    ----------
    residual_mm : (M,) mean distance of each marker from its fitted place
    hand_length_mm : estimated from the palm
    tilt_deg : of the palm's normal to the camera's axis
    distance_m : of WRIST
    frames_used : still frames that were averaged
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
        """True if tracking may start despite the findings: not with labels that are surely wrong."""
        return not any(finding.blocks or finding.kind == "shifted" for finding in self.findings)


@dataclass(frozen=True, slots=True)
class Calibration:
    """Measured hand at its neutral pose.

    Attributes
    ----------
    marker_position_w0_m : (M, 3) marker centres in W0
    rotation_w0_cam, translation_w0_cam_m : (3, 3), (3,) pose g_w0c of the wrist paper
    marker_covariance_w0_m2 : (M, 3, 3) uncertainty of the markers, which all later angles inherit
    start_angles_rad : (3,) deviation, flexion, pronosupination of a hand that cannot lie neutral, else zero
    surface : back of the hand over its fixed unit, None if too little of it was seen
    """

    clicks: Clicks
    marker_position_w0_m: FloatArray
    rotation_w0_cam: FloatArray
    translation_w0_cam_m: FloatArray
    marker_covariance_w0_m2: FloatArray
    start_angles_rad: FloatArray
    verdict: Verdict
    surface: DorsalSurface | None = None

    @property
    def straight_fingers(self) -> tuple[bool, ...]:
        """Thumb to little finger: False for one that could not lie straight."""
        return self.clicks.straight_fingers or ALL_STRAIGHT


_HAND = phrase("hand")
_FINGER_NAMES = {
    "1": phrase("thumb"), "2": phrase("index finger"), "3": phrase("middle finger"), "4": phrase("ring finger"),
    "5": phrase("little finger"),
}  # fmt: skip
FINDING_TEXTS: dict[str, tuple[Phrase, Phrase]] = {
    "click_on_no_marker": (
        phrase("No blue marker at the {markers}."),
        phrase("Click nearer to the marker, or check the light."),
    ),
    "two_clicks_on_one": (
        phrase("The clicks for the {markers} are on one marker."),
        phrase("Click each of the two on its own marker."),
    ),
    "swapped": (
        phrase("The labels of {markers} seem to be swapped."),
        phrase("Swap the two labels, or click both markers again."),
    ),
    "misnamed": (
        phrase("The {markers} does not lie on the line of its finger."),
        phrase("Check the lines on the image, and give the marker its correct label."),
    ),
    "shifted": (
        phrase("The labels seem to be shifted: the marker clicked as {first} is probably the {second}."),
        phrase("Click all markers again, each under its own label."),
    ),
    "wrong_side": (
        phrase("This looks like the other hand."),
        phrase("Choose the other side, or click the markers again."),
    ),
    "no_depth": (
        phrase("The camera cannot measure the depth at the {markers}."),
        phrase("Move the hand a little, and keep sunlight and reflections off the marker."),
    ),
    "residual": (
        phrase("The {markers} marker is {value} mm from its expected position (up to {limit} mm is good)."),
        phrase("Click the centre of the marker again, and keep the hand still."),
    ),
    "hand_length": (
        phrase("The hand length is {value} mm (the limit is {limit} mm)."),
        phrase("Check that every marker is clicked under its own label."),
    ),
    "other_spot": (
        phrase("Another blue spot fits the {markers} better than the clicked one."),
        phrase("Choose the spot with the question mark, if it is the marker."),
    ),
    "spare_spot": (
        phrase("There is one more blue spot on the hand than there are labels."),
        phrase("Cover the spot with the question mark, or give it the correct label."),
    ),
    "near_spot": (
        phrase("Another blue spot is close to the {markers}: it may be the marker."),
        phrase("Click the centre of the {markers} again, or cover the other spot."),
    ),
    "no_palm": (
        phrase("The {markers} does not fit the other markers: no hand has this shape."),
        phrase("Check that a marker was clicked there, and not another blue spot."),
    ),
    "other_length": (
        phrase("The hand length is {value} mm. Last time it was {limit} mm."),
        phrase("Check the patient, the side, and that every marker is clicked under its own label."),
    ),
    "tilt": (
        phrase("The hand is tilted {value}° to the camera (up to {limit}° is good)."),
        phrase("Turn the back of the hand to the camera."),
    ),
    "distance": (
        phrase("The hand is {value} m from the camera ({limit} m or more is good)."),
        phrase("Move the camera further from the hand."),
    ),
    "moved": (
        phrase("The hand moved in the first half second."),
        phrase("Keep the hand still and take the first image again."),
    ),
    "few_frames": (
        phrase("The hand was still for only {value} frames ({limit} or more are good)."),
        phrase("Keep the hand still for half a second."),
    ),
    "depth_off": (
        phrase("Depth and colour are not aligned at the {markers} ({value} {unit}, up to {limit} is good)."),
        phrase("Turn on depth registration in the camera settings, or track without depth."),
    ),
}
"""Problem and remedy of each kind of finding."""


def finding_words(
    finding: CalibrationFinding, translate: Translate = str, format_number: Callable[[float], str] = "{:.3g}".format
) -> MessageText:
    """Return problem and remedy of a finding in another language."""
    headline, remedy = map(translate, FINDING_TEXTS[finding.kind])
    if math.isnan(finding.value) and " (" in headline:
        headline = headline[: headline.index(" (")] + "."
    text = headline.format(
        markers=_finger_swap_text(finding, translate)
        or join_marker_names(finding.markers, translate)
        or translate(_HAND),
        first=marker_name(finding.markers[0], translate) if finding.markers else "",
        second=marker_name(finding.markers[1], translate) if len(finding.markers) > 1 else "",
        value=format_number(finding.value),
        limit=format_number(finding.limit),
        unit=finding.unit,
    )
    return MessageText(text[0].upper() + text[1:], "", remedy)


def _finger_swap_text(finding: CalibrationFinding, translate: Translate) -> str:
    """Return the names of two fingers whose labels are all exchanged."""
    if finding.kind != "swapped" or len(finding.markers) <= 2:
        return ""
    firsts = (finding.markers[0], finding.markers[len(finding.markers) // 2])
    return translate(phrase("{one} and {other}", one=_FINGER_NAMES[firsts[0][-1]], other=_FINGER_NAMES[firsts[1][-1]]))


def finding_sentence(finding: CalibrationFinding) -> str:
    """Return problem and remedy in one line."""
    words = finding_words(finding)
    return join_sentences(words.summary, words.remedy)

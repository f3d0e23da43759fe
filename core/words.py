"""How a fault or a finding is said: the facts in its sentences, in English or translated before they are filled."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

from carpus.core import errors
from carpus.core.calibration.result import CalibrationFinding
from carpus.core.errors import CarpusFault
from carpus.core.installing import how_to_install
from carpus.core.phrase import Phrase, phrase

Say = Callable[[str], str]
"""Says a :class:`Phrase` in a language, any other text as it is."""


@dataclass(frozen=True, slots=True)
class Words:
    """The three answers of every message; ``safe`` is empty where nothing is recorded yet."""

    happened: str
    safe: str
    do: str


_HAND = phrase("hand")
_BINDING = " (for|at|to|in|für|auf|nach|unter|per|su|a) "
"""What binds a fact to its sentence, in all languages, and goes with it where there is none."""

_ABOUT_MARKERS = (
    errors.ClickOutsidePicture,
    errors.ClickOnNoMarker,
    errors.MarkerWithoutDepth,
    errors.CalibrationImpossible,
)

FINDINGS: dict[str, tuple[Phrase, Phrase]] = {
    "click_on_no_marker": (
        phrase("No blue marker at the {markers}."),
        phrase("Click nearer to the marker, or check the light."),
    ),
    "two_clicks_on_one": (
        phrase("The clicks for the {markers} are on one marker."),
        phrase("Click each of the two on its own marker."),
    ),
    "swapped": (
        phrase("{markers} look swapped."),
        phrase("Swap the two names, or click both markers again."),
    ),
    "misnamed": (
        phrase("The {markers} does not lie on the line of its finger."),
        phrase("Look at the lines on the picture, and give the marker its right name."),
    ),
    "shifted": (
        phrase("The names look shifted: the marker clicked as {first} is the {second}."),
        phrase("Click all markers again, each under its own name."),
    ),
    "wrong_side": (
        phrase("This looks like the other hand."),
        phrase("Choose the other side, or click the markers again."),
    ),
    "no_depth": (
        phrase("The camera measures no depth at the {markers}."),
        phrase("Move the hand a little, and keep sunlight and shine off the marker."),
    ),
    "residual": (
        phrase("The marker of the {markers} is {value} mm off its place (up to {limit} mm is good)."),
        phrase("Click it again in its middle, and keep the hand still."),
    ),
    "hand_length": (
        phrase("The hand measures {value} mm ({limit} mm is the limit)."),
        phrase("Check that every marker is clicked under its own name."),
    ),
    "other_spot": (
        phrase("Another blue spot fits the {markers} better."),
        phrase("Take the spot with the question mark, if it is the disc."),
    ),
    "spare_spot": (
        phrase("There is one more blue spot on the hand than there are names."),
        phrase("Cover the spot with the question mark, or give it its name."),
    ),
    "near_spot": (
        phrase("Another blue spot lies close to the {markers}: it may be the disc."),
        phrase("Click the {markers} again in its middle, or cover the other spot."),
    ),
    "no_palm": (
        phrase("No hand has this shape: the {markers} does not lie where the other discs expect it."),
        phrase("Check that a disc was clicked there, and not another blue spot."),
    ),
    "other_length": (
        phrase("The hand measures {value} mm, and {limit} mm last time."),
        phrase("Check the patient, the side, and that every marker is clicked under its own name."),
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
        phrase("Keep the hand still and take the first picture again."),
    ),
    "few_frames": (
        phrase("The hand was still for {value} pictures only ({limit} or more are good)."),
        phrase("Keep the hand still for half a second."),
    ),
    "depth_off": (
        phrase("Depth and colour do not lie on each other at the {markers} ({value} {unit}, up to {limit} is good)."),
        phrase("Switch on registration in the camera, or track without depth."),
    ),
}
"""What is not as it should be, and how to mend it, for every kind of finding of calibration."""

_FINGERS = {
    "1": phrase("thumb"), "2": phrase("index finger"), "3": phrase("middle finger"), "4": phrase("ring finger"),
    "5": phrase("little finger"),
}  # fmt: skip

MARKERS: dict[str, Phrase] = {
    "WRIST": phrase("wrist"),
    "CMC1": phrase("thumb base"),
    "MCP1": phrase("thumb knuckle"),
    "IP1": phrase("thumb end joint"),
    "TIP1": phrase("thumb tip"),
    "MCP2": phrase("index knuckle"),
    "PIP2": phrase("index finger middle joint"),
    "DIP2": phrase("index finger end joint"),
    "TIP2": phrase("index tip"),
    "MCP3": phrase("middle knuckle"),
    "PIP3": phrase("middle finger middle joint"),
    "DIP3": phrase("middle finger end joint"),
    "TIP3": phrase("middle tip"),
    "MCP4": phrase("ring knuckle"),
    "PIP4": phrase("ring finger middle joint"),
    "DIP4": phrase("ring finger end joint"),
    "TIP4": phrase("ring tip"),
    "MCP5": phrase("little knuckle"),
    "PIP5": phrase("little finger middle joint"),
    "DIP5": phrase("little finger end joint"),
    "TIP5": phrase("little tip"),
}
"""Clinical name of every marker."""


def words_of(fault: CarpusFault, *, marker_names: bool = False, say: Say = str) -> Words:
    """The three answers for this fault; ``marker_names`` adds the markers' names of the files to the clinical ones;
    ``say`` says a phrase in another language."""
    subject = fault.subject
    if isinstance(fault, _ABOUT_MARKERS):
        spoken = markers_in_words(subject.split(", "), say)
        subject = f"{spoken}, {subject}" if marker_names and subject else spoken
    detail = say(fault.detail)
    said = [_filled(say(text), subject, detail) for text in (fault.happened, fault.safe, fault.do)]
    if isinstance(fault, errors.ExtraMissing) and subject:
        said[2] = say(how_to_install(subject))
    return Words(*said)


def one_sentence(fault: CarpusFault) -> str:
    """One line for the command line: what happened, with which file, and what to do."""
    words = words_of(fault, marker_names=True)
    return _joined(words.happened, words.do)


def finding_words(
    finding: CalibrationFinding, say: Say = str, written: Callable[[float], str] = "{:.3g}".format
) -> Words:
    """What a finding says and how to mend it; ``say`` says a phrase in another language, ``written`` writes figures."""
    headline, remedy = map(say, FINDINGS[finding.kind])
    if math.isnan(finding.value) and " (" in headline:
        headline = headline[: headline.index(" (")] + "."
    text = headline.format(
        markers=_exchanged_in_words(finding, say) or markers_in_words(finding.markers, say) or say(_HAND),
        first=marker_in_words(finding.markers[0], say) if finding.markers else "",
        second=marker_in_words(finding.markers[1], say) if len(finding.markers) > 1 else "",
        value=written(finding.value),
        limit=written(finding.limit),
        unit=finding.unit,
    )
    return Words(text[0].upper() + text[1:], "", remedy)


def _exchanged_in_words(finding: CalibrationFinding, say: Say) -> str:
    """``middle finger and ring finger`` where all names of two fingers stand in for each other."""
    if finding.kind != "swapped" or len(finding.markers) <= 2:
        return ""
    firsts = (finding.markers[0], finding.markers[len(finding.markers) // 2])
    return say(phrase("{one} and {other}", one=_FINGERS[firsts[0][-1]], other=_FINGERS[firsts[1][-1]]))


def finding_sentence(finding: CalibrationFinding) -> str:
    """What it says and how to mend it on one line."""
    words = finding_words(finding)
    return _joined(words.happened, words.do)


def marker_in_words(marker: str, say: Say = str) -> str:
    """Clinical name of a marker; any other name stays.

    >>> marker_in_words("MCP2"), marker_in_words("CMC1"), marker_in_words("PIP5")
    ('index knuckle', 'thumb base', 'little finger middle joint')
    """
    return say(MARKERS[marker]) if marker in MARKERS else marker


def markers_in_words(markers: list[str] | tuple[str, ...], say: Say = str) -> str:
    """Several markers as a person says them.

    >>> markers_in_words(("MCP2", "MCP3")), markers_in_words(("WRIST", "CMC1", "MCP4"))
    ('index and middle knuckle', 'wrist, thumb base and ring knuckle')
    """
    names = [marker_in_words(marker, say) for marker in markers]
    if len(names) > 1 and all(name.endswith(" knuckle") for name in names):  # as one says it in English
        names = [*(name.removesuffix(" knuckle") for name in names[:-1]), names[-1]]
    if len(names) < 2:
        return "".join(names)
    return say(phrase("{one} and {other}", one=", ".join(names[:-1]), other=names[-1]))


def _filled(text: str, subject: str, detail: str) -> str:
    """Put the facts in their places; a place without a fact goes, with what binds it to the sentence."""
    facts = {"subject": subject, "detail": " ".join(detail.split())}
    for name, fact in facts.items():
        if not fact:
            text = re.sub(rf" \([^()]*\{{{name}\}}\)|(: |{_BINDING}| )\{{{name}\}}", "", text)
    return text.format(**facts)


def _joined(happened: str, do: str) -> str:
    return f"{happened.removesuffix('.')}; {do[0].lower()}{do[1:]}"

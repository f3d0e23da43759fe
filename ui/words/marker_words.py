"""Names of the markers, where they are placed, and how to make them visible."""

from __future__ import annotations

from carpus.core.model import fault_text
from carpus.core.model.phrase import phrase
from carpus.ui.kit.translate import tr, translate_phrase


def marker_title(marker: str) -> str:
    """Return the name of a marker as a title, such as ``Thumb CMC`` for CMC1."""
    name = fault_text.marker_name(marker, translate_phrase)
    return name[:1].upper() + name[1:]


_FINGERS = {
    "1": (phrase("Thumb"), phrase("Thumb")), "2": (phrase("Index"), phrase("Index finger")),
    "3": (phrase("Middle"), phrase("Middle finger")), "4": (phrase("Ring"), phrase("Ring finger")),
    "5": (phrase("Little"), phrase("Little finger")),
}  # fmt: skip


def finger_name(finger: str) -> str:
    """Return the short name of a finger, such as ``Ring`` for 4."""
    return translate_phrase(_FINGERS[finger][0])


def long_finger_name(finger: str) -> str:
    """Return the name of a finger, such as ``Ring finger`` for 4."""
    return translate_phrase(_FINGERS[finger][1])


def click_instruction(marker: str) -> str:
    """Return the instruction to click a marker."""
    return tr("Click the {marker}").format(marker=fault_text.marker_name(marker, translate_phrase))


def marker_placement(marker: str) -> str:
    """Say where exactly a marker is placed on the hand."""
    joint = marker.rstrip("12345")
    if marker == "WRIST":
        return tr("In the middle of the back of the wrist, in the small hollow.")
    if marker == "CMC1":
        return tr("At the base of the thumb, just distal to the anatomical snuffbox.")
    return {
        "MCP": tr("On the back of the hand, 3–5 mm proximal to the MCP joint."),
        "PIP": tr("Centred on the creases over the PIP joint."),
        "DIP": tr("Centred on the creases over the DIP joint."),
        "IP": tr("Centred on the creases over the IP joint."),
        "TIP": tr("In the middle of the nail."),
    }.get(joint, "")


def occlusion_remedy(marker: str) -> str:
    """Say how to make an occluded marker visible."""
    if marker == "WRIST":
        return tr("Clear the view of the wrist")
    if marker == "CMC1":
        return tr("Turn the thumb side up")
    if marker == "MCP5":
        return tr("Turn the little-finger side up")
    return tr("Turn the back of the hand to the camera")

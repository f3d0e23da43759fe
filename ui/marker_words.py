"""Words for the markers: clinical name, where exactly it sits, what to do when it is hidden."""

from __future__ import annotations

from carpus.ui.translate import tr


def marker_name(marker: str) -> str:
    """``Thumb base`` for CMC1."""
    joint, finger = marker.rstrip("12345"), marker[-1]
    if marker == "WRIST":
        return tr("Wrist")
    if marker == "CMC1":
        return tr("Thumb base")
    pattern = {
        "MCP": tr("{finger} knuckle"),
        "PIP": tr("{finger} middle joint"),
        "DIP": tr("{finger} end joint"),
        "IP": tr("{finger} end joint"),
        "TIP": tr("{finger} tip"),
    }.get(joint, marker)
    return pattern.format(finger=finger_name(finger))


def finger_name(finger: str) -> str:
    """``Ring`` for 4."""
    return {"1": tr("Thumb"), "2": tr("Index"), "3": tr("Middle"), "4": tr("Ring"), "5": tr("Little")}.get(
        finger, finger
    )


def click_instruction(marker: str) -> str:
    """``Click the ring knuckle``."""
    name = marker_name(marker)
    return tr("Click the {marker}").format(marker=name[0].lower() + name[1:])


def marker_place(marker: str) -> str:
    """Where exactly on the hand."""
    joint = marker.rstrip("12345")
    if marker == "WRIST":
        return tr("In the middle of the back of the wrist, in the small dimple.")
    if marker == "CMC1":
        return tr("At the root of the thumb, just past the hollow beside the wrist.")
    return {
        "MCP": tr("On the back of the hand, 3–5 mm behind the knuckle, towards the wrist."),
        "PIP": tr("In the middle of the creases over the middle joint."),
        "DIP": tr("In the middle of the creases over the end joint."),
        "IP": tr("In the middle of the creases over the end joint."),
        "TIP": tr("On the nail, in its middle."),
    }.get(joint, "")


def hidden_remedy(marker: str) -> str:
    """How to bring one hidden marker back into view."""
    if marker == "WRIST":
        return tr("Clear the view of the wrist")
    if marker == "CMC1":
        return tr("Turn the thumb side up")
    if marker == "MCP5":
        return tr("Turn the little-finger side up")
    return tr("Turn the back of the hand to the camera")

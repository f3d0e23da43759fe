"""Words of the clinic for exercises, movements, hands and marker places."""

from __future__ import annotations

import math
from datetime import date

from carpus.core.hand.marker_protocol import MarkerProtocol
from carpus.core.output.exercises import SIDES
from carpus.core.types import FloatArray
from carpus.ui import numbers
from carpus.ui.translate import tr

LEGAL_SENTENCE = (
    "For research and education. Not a medical device, not CE-marked or FDA-cleared; values support, and do not "
    "replace, the judgement of a qualified clinician; do not use as the only basis for diagnosis or treatment."
)
"""Verbatim on the first screen and every report; never translated by meaning, only by an approved text."""


def exercise_name(exercise_id: str) -> str:
    """``Wrist flexion–extension``."""
    return {
        "WRIST_FE": tr("Wrist flexion–extension"),
        "WRIST_RU": tr("Wrist side to side"),
        "FOREARM_PS": tr("Palm up – palm down"),
        "FREE": tr("Free movement"),
        "FIST_COMPOSITE": tr("Full fist"),
        "FIST_HOOK": tr("Hook fist"),
        "FINGER_ABAD": tr("Spread the fingers"),
        "THUMB_OPP": tr("Thumb across the palm"),
        "REACH_GRASP": tr("Reach and grasp"),
        "FREE_HAND": tr("Free movement of the fingers"),
    }.get(exercise_id, exercise_id)


def protocol_name(protocol: MarkerProtocol) -> str:
    """What a marker protocol covers and with how many markers."""
    count = len(protocol.markers)
    if protocol.is_whole_hand:
        return tr("Whole hand · {count} markers").format(count=count)
    if protocol.has_fingers:
        return tr("Some fingers · {count} markers").format(count=count)
    return tr("Wrist · {count} markers").format(count=count)


def onset_words(onset: str, day: date | None) -> str:
    """``operated on 21 Aug 2026``; empty without a day."""
    if day is None:
        return ""
    pattern = tr("operated on {day}") if onset == "operation" else tr("injured on {day}")
    return pattern.format(day=numbers.day_of_year(day))


def exercise_instruction(exercise_id: str) -> str:
    """What the patient is asked to do."""
    return {
        "WRIST_FE": tr("Lift the back of the hand up, then let it drop as far as comfortable."),
        "WRIST_RU": tr("Slide the hand to the thumb side, then to the little-finger side. Keep it flat."),
        "FOREARM_PS": tr("Turn the palm up as far as the markers stay visible, then back."),
        "FREE": tr("Move the wrist freely. All three angles are recorded; no repetitions are counted."),
        "FIST_COMPOSITE": tr("Close all fingers into a full fist, then open flat."),
        "FIST_HOOK": tr("Keep the knuckles straight, bend only the end joints like a hook, then open."),
        "FINGER_ABAD": tr("Spread the fingers wide, then close them."),
        "THUMB_OPP": tr("Touch each fingertip with the thumb in turn, opening it wide in between."),
        "REACH_GRASP": tr("Reach, take the cup, lift it a little, put it back, return."),
        "FREE_HAND": tr("Move the fingers freely. All joint angles are recorded; no repetitions are counted."),
    }.get(exercise_id, "")


def exercise_position(exercise_id: str) -> str:
    """How the arm lies before the start."""
    return {
        "WRIST_FE": tr("Forearm on a 10 cm wedge, palm down, hand over the edge, fingers relaxed."),
        "WRIST_RU": tr("Palm flat on a smooth sheet, forearm strapped."),
        "FOREARM_PS": tr("Elbow at the side, forearm free, palm down under the camera."),
        "FREE": tr("Hand in view of the camera, back of the hand up."),
        "FIST_COMPOSITE": tr("Forearm on the wedge, back of the hand towards the camera, fingers straight."),
        "FIST_HOOK": tr("Forearm on the wedge, back of the hand towards the camera, fingers straight."),
        "FINGER_ABAD": tr("Palm flat on the table, fingers straight and closed."),
        "THUMB_OPP": tr("Forearm on the wedge, thumb side turned up a little, fingers relaxed."),
        "REACH_GRASP": tr("Hand at its place at the edge, a cup of 5 to 7 cm at 20 to 30 cm."),
        "FREE_HAND": tr("Hand in view of the camera, back of the hand up, fingers straight."),
    }.get(exercise_id, "")


def exercise_view(exercise_id: str) -> str:
    """What the camera will not see of an exercise, said before it begins; empty where it sees all."""
    return {
        "FIST_COMPOSITE": tr(
            "At the end of a fist the middle and end joints go out of the camera's sight: repetitions are counted all "
            "the same, and those ranges are given as “at least”. To see more, turn the thumb side up."
        ),
        "FIST_HOOK": tr(
            "About half-way the middle joints go out of the camera's sight: repetitions are counted all the same, and "
            "their range is given as “at least”. To see more, raise the wrist or turn the thumb side up."
        ),
        "THUMB_OPP": tr(
            "Under the palm the thumb's tip goes out of the camera's sight: what is trained here is its lift away from "
            "the palm, which stays in view."
        ),
    }.get(exercise_id, "")


def movement_name(movement: str) -> str:
    """``Flexion``, ``Radial``, ``Whole arc``."""
    return {
        "radial": tr("Radial"),
        "ulnar": tr("Ulnar"),
        "flexion": tr("Flexion"),
        "extension": tr("Extension"),
        "supination": tr("Supination"),
        "pronation": tr("Pronation"),
        "arc": tr("Whole arc"),
    }.get(movement, movement)


def deficit_name(movement: str) -> str:
    """``Extension deficit``: what is missing to neutral."""
    return {
        "radial": tr("Radial deviation deficit"),
        "ulnar": tr("Ulnar deviation deficit"),
        "flexion": tr("Flexion deficit"),
        "extension": tr("Extension deficit"),
        "supination": tr("Supination deficit"),
        "pronation": tr("Pronation deficit"),
    }.get(movement, movement)


def lacking(size: str) -> str:
    """``lacks 20°``: so much is missing to the neutral pose on a side that was never reached."""
    return tr("lacks {angle}").format(angle=size)


def end_words(mean_deg: float) -> str:
    """``42°``; ``lacks 20°`` of an end that was never reached, whatever stands beside it."""
    shown = numbers.degrees(mean_deg)
    return lacking(shown) if mean_deg < 0.0 and shown != numbers.degrees(0.0) else shown


def movement_long_name(movement: str) -> str:
    """As :func:`movement_name`, with the noun where the short word alone is not one."""
    return {"radial": tr("Radial deviation"), "ulnar": tr("Ulnar deviation")}.get(movement, movement_name(movement))


def movement_at_zero(angle: int) -> str:
    """What a wrist is in that shows no movement to either side; ``angle`` is the column."""
    return tr("Palm down") if angle == 2 else tr("Straight")


def arc_name(angle: int) -> str:
    """The whole arc of one angle, where more than one is shown."""
    return {0: tr("Side arc"), 1: tr("Bending arc"), 2: tr("Turning arc")}[angle]


def hand_name(side: str) -> str:
    """``Right hand``."""
    return {"right": tr("Right hand"), "left": tr("Left hand"), "both": tr("Both hands")}.get(side, side)


def side_name(side: str) -> str:
    """``Right``."""
    return {"right": tr("Right"), "left": tr("Left"), "both": tr("Both")}.get(side, side)


def affected_phrase(side: str, dominance: str) -> str:
    """``Right hand affected · right-handed``."""
    affected = {
        "right": tr("Right hand affected"),
        "left": tr("Left hand affected"),
        "both": tr("Both hands affected"),
    }.get(side, "")
    handed = {"right": tr("right-handed"), "left": tr("left-handed"), "both": tr("both-handed")}.get(dominance, "")
    return " · ".join(part for part in (affected, handed) if part)


def start_angle_words(angles_rad: FloatArray) -> str:
    """``Flexion 10°, Ulnar 5°`` of deviation, flexion, pro/supination (3,); empty for a straight hand."""
    parts = [
        f"{movement_name(SIDES[column][0 if angles_rad[column] > 0 else 1])} "
        f"{numbers.degrees(math.degrees(angles_rad[column]))}"
        for column in (1, 0, 2)
        if abs(angles_rad[column]) > 1e-6
    ]
    return ", ".join(parts)

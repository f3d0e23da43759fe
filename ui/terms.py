"""Words of the clinic for exercises, movements, hands and marker places."""

from __future__ import annotations

import math
from datetime import date

from carpus.core.hand.exercises import SIDES, known_exercise
from carpus.core.hand.protocols import MarkerProtocol
from carpus.core.types import FloatArray
from carpus.ui import language, numbers
from carpus.ui.translate import say, tr

LEGAL_SENTENCE = (
    "For research and education. Not a medical device, not CE-marked or FDA-cleared; values support, and do not "
    "replace, the judgement of a qualified clinician; do not use as the only basis for diagnosis or treatment."
)
"""Verbatim on the first screen and every report; never translated by meaning, only by an approved text."""


def legal_notice() -> str:
    """The sentence as a window has it, which says in its own language why this one is English."""
    before = "" if language.spoken() == "en" else tr("Legal notice, in its English wording:")
    return f"{before} {LEGAL_SENTENCE}".lstrip()


def exercise_name(exercise_id: str) -> str:
    """``Wrist flexion–extension``."""
    known = known_exercise(exercise_id)
    return exercise_id if known is None else say(known.name)


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

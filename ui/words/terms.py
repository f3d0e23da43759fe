"""Clinical terms for exercises, movements, hands, fingers, markers and people."""

from __future__ import annotations

import math
from datetime import date

import numpy as np

from carpus.core.model import fault_text
from carpus.core.model.hand.exercises import (
    ARC_NAMES,
    DIRECTIONS,
    MOVEMENTS,
    PRONOSUPINATION,
    Exercise,
    find_exercise,
    get_exercise,
)
from carpus.core.model.hand.forearm_rotation import is_counted_from_thumb_up, to_clinical_wrist_angles
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.phrase import phrase
from carpus.core.model.types import FloatArray
from carpus.core.records.values import Patient
from carpus.core.results.norms import Person
from carpus.ui.kit import language, numbers
from carpus.ui.kit.translate import tr, translate_phrase

# Verbatim on the first screen and every report; only an approved text may replace it.
LEGAL_SENTENCE = (
    "For research and education. Not a medical device, not CE-marked or FDA-cleared; values support, and do not "
    "replace, the judgement of a qualified clinician; do not use as the only basis for diagnosis or treatment."
)


def legal_notice() -> str:
    """Return the legal sentence, introduced in the user's language if that is not English."""
    before = "" if language.current_language() == "en" else tr("Legal notice, in its English wording:")
    return f"{before} {LEGAL_SENTENCE}".lstrip()


FOREARM = ("supination", "pronation")


def exercise_name(exercise_id: str) -> str:
    """Return the name of an exercise, such as ``Wrist flexion–extension``."""
    known = find_exercise(exercise_id)
    return exercise_id if known is None else translate_phrase(known.name)


def exercise_limit(exercise_id: str) -> str:
    """Return what the values of an exercise do not tell; empty for an unknown one."""
    known = find_exercise(exercise_id)
    return "" if known is None else translate_phrase(known.limit)


def protocol_name(protocol: MarkerProtocol) -> str:
    """Return the name of a marker protocol with its number of markers."""
    count = len(protocol.markers)
    if protocol.is_whole_hand:
        return tr("Whole hand · {count} markers").format(count=count)
    if protocol.has_fingers:
        return tr("Some fingers · {count} markers").format(count=count)
    return tr("Wrist · {count} markers").format(count=count)


def onset_words(onset: str, day: date | None) -> str:
    """Return ``operated on 21 Aug 2026``; empty without a day."""
    if day is None:
        return ""
    pattern = tr("operated on {day}") if onset == "operation" else tr("injured on {day}")
    return pattern.format(day=numbers.format_date(day))


def movement_name(movement: str) -> str:
    """Return the short name of a movement, such as ``Flexion`` or ``Radial``."""
    return translate_phrase(MOVEMENTS[movement].name)


def deficit_name(movement: str) -> str:
    """Return the name of a deficit, such as ``Extension deficit``."""
    return translate_phrase(MOVEMENTS[movement].deficit)


def deficit_words(size: str) -> str:
    """Return ``20° deficit``: what is missing to neutral."""
    return tr("{angle} deficit").format(angle=size)


def end_words(mean_deg: float, movement: str = "", sd_deg: float = math.nan) -> str:
    """Return ``42°``, or ``20° deficit`` for an end that did not reach neutral.

    For the forearm, whose palm faces down at 90° of pronation, it is ``−20°``.
    """
    shown = numbers.format_with_sd(mean_deg, sd_deg)
    if mean_deg >= 0.0 or numbers.format_degrees(mean_deg) == numbers.format_degrees(0.0):
        return shown
    return f"\N{MINUS SIGN}{shown}" if movement in FOREARM else deficit_words(shown)


def movement_long_name(movement: str) -> str:
    """Return the name of a movement as a noun."""
    return translate_phrase(MOVEMENTS[movement].noun)


def direction_names(angle: int, exercise: Exercise) -> tuple[str, str]:
    """Return both directions of a wrist angle.

    A rotation that accompanies another movement is not called supination.
    """
    if angle == PRONOSUPINATION and not is_counted_from_thumb_up(exercise):
        return tr("Rotation +"), tr("Rotation −")  # thumb side up, thumb side down
    upper, lower = DIRECTIONS[angle]
    return movement_name(upper), movement_name(lower)


def direction_long_name(angle: int, value_deg: float, exercise: Exercise) -> str:
    """Return the direction of a value as a noun."""
    if angle == PRONOSUPINATION and not is_counted_from_thumb_up(exercise):
        return direction_name(angle, value_deg, exercise)
    return movement_long_name(DIRECTIONS[angle][0 if value_deg >= 0.0 else 1])


def direction_name(angle: int, value_deg: float, exercise: Exercise) -> str:
    """Return the direction of a value."""
    return direction_names(angle, exercise)[0 if value_deg >= 0.0 else 1]


def thumb_up_words() -> str:
    """Say where pronation and supination are counted from."""
    return tr(
        "Forearm pronation and supination are measured from thumb up (0°). Palm flat on the table is 90° pronation."
    )


def neutral_name(angle: int, exercise: Exercise) -> str:
    """Return the name of the neutral position of a wrist angle (column ``angle``)."""
    if angle != PRONOSUPINATION:
        return tr("Neutral")
    return tr("Thumb up") if is_counted_from_thumb_up(exercise) else tr("As at the start")


def arc_name(angle: int) -> str:
    """Return the name of the arc of an angle where several are shown."""
    return translate_phrase(ARC_NAMES[angle])


_HANDS = {"right": phrase("Right hand"), "left": phrase("Left hand"), "both": phrase("Both hands")}
_SIDES = {"right": phrase("Right"), "left": phrase("Left"), "both": phrase("Both")}
_AFFECTED = {
    "right": phrase("Right hand affected"), "left": phrase("Left hand affected"), "both": phrase("Both hands affected"),
}  # fmt: skip
_HANDED = {"right": phrase("right-handed"), "left": phrase("left-handed"), "both": phrase("both-handed")}


def hand_name(side: str) -> str:
    """Return ``Right hand`` or ``Left hand``."""
    return translate_phrase(_HANDS.get(side, side))


def side_name(side: str) -> str:
    """Return ``Right`` or ``Left``."""
    return translate_phrase(_SIDES.get(side, side))


def hand_dominance(dominance: str) -> str:
    """Return ``right-handed`` or the like; empty if unknown."""
    return translate_phrase(_HANDED.get(dominance, ""))


def hand_status_words(side: str, dominance: str) -> str:
    """Return ``Right hand affected · right-handed``."""
    return " · ".join(filter(None, (translate_phrase(_AFFECTED.get(side, "")), hand_dominance(dominance))))


def start_angle_words(angles_rad: FloatArray) -> str:
    """Return ``Flexion 10°, Pronation 60°`` for the start angles (3,) of a file; empty for neutral."""
    read = to_clinical_wrist_angles(angles_rad, get_exercise("FOREARM_PS"), np.zeros(3))
    parts = []
    for column in (1, 0, 2):
        if abs(angles_rad[column]) > 1e-6:
            name = movement_name(DIRECTIONS[column][0 if read[column] > 0 else 1])
            parts.append(f"{name} {numbers.format_degrees(math.degrees(read[column]))}")
    return ", ".join(parts)


def marker_title(marker: str) -> str:
    """Return the name of a marker as a title, such as ``Thumb CMC`` for CMC1."""
    name = fault_text.marker_name(marker, translate_phrase)
    return name[:1].upper() + name[1:]


_FINGER_NAMES = {
    "1": (phrase("Thumb"), phrase("Thumb")), "2": (phrase("Index"), phrase("Index finger")),
    "3": (phrase("Middle"), phrase("Middle finger")), "4": (phrase("Ring"), phrase("Ring finger")),
    "5": (phrase("Little"), phrase("Little finger")),
}  # fmt: skip


def finger_name(finger: str) -> str:
    """Return the short name of a finger, such as ``Ring`` for 4."""
    return translate_phrase(_FINGER_NAMES[finger][0])


def long_finger_name(finger: str) -> str:
    """Return the name of a finger, such as ``Ring finger`` for 4."""
    return translate_phrase(_FINGER_NAMES[finger][1])


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


def birth_words(patient: Patient) -> str:
    """Return ``born 12 Mar 1981``; empty if unknown."""
    return tr("born {day}").format(day=numbers.format_date(patient.birth_day)) if patient.birth_day else ""


def to_person(patient: Patient | None, day: date) -> Person | None:
    """Return sex and age on a day, None if the age is not known."""
    if patient is None or patient.birth_day is None:
        return None
    born = patient.birth_day
    return Person(patient.sex, day.year - born.year - ((day.month, day.day) < (born.month, born.day)))


def record_number_words(patient: Patient) -> str:
    """Return ``No. 4711``; empty if there is none."""
    return tr("No. {number}").format(number=patient.record_number) if patient.record_number else ""


def identity_words(patient: Patient) -> str:
    """Return ``born 12 Mar 1981, female, No. 4711``."""
    sex = {"female": tr("female"), "male": tr("male"), "diverse": tr("other")}.get(patient.sex, "")
    return ", ".join(part for part in (birth_words(patient), sex, record_number_words(patient)) if part)


def printed_name(patient: Patient) -> str:
    """Return ``Erika Mustermann, born 12 Mar 1981, female, No. 4711``."""
    return ", ".join(part for part in (patient.name, identity_words(patient)) if part)

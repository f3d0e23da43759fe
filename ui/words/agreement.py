"""Names and values of an agreement; the sign of a difference is a word."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from carpus.ui.kit import numbers
from carpus.ui.kit.translate import tr, translate_phrase
from carpus.ui.words.finger_angles import FINGER_ANGLES

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.research.agreement.compare import Comparison
    from carpus.core.research.agreement.statistics import Interval

TOKENS = {"deviation": "deviation", "flexion": "flexion", "pronosupination": "rotation"}
_BY_JOINT = {angle.joint: angle for angle in FINGER_ANGLES}


def angle_name(name: str) -> str:
    """Return the display name of an angle, such as ``Flexion–extension``."""
    wrist = {
        "flexion": tr("Flexion–extension"), "deviation": tr("Radial–ulnar deviation"),
        "pronosupination": tr("Pronation–supination"),
    }  # fmt: skip
    if name in wrist:
        return wrist[name]
    if name in _BY_JOINT:
        return _BY_JOINT[name].long_name
    return tr("Thumb MCP, abduction–adduction") if name == "MCP1_abduction" else name


def angle_token(name: str) -> str:
    """Return the colour of an angle."""
    return TOKENS.get(name) or (_BY_JOINT[name].token if name in _BY_JOINT else "flexion")


def direction_names(name: str) -> tuple[str, str]:
    """Return the names of the positive and the negative direction of an angle."""
    wrist = {
        "flexion": (tr("flexion"), tr("extension")),
        "deviation": (tr("radial"), tr("ulnar")),
        "pronosupination": (tr("supination"), tr("pronation")),
    }
    return wrist.get(name, (tr("more"), tr("less")))


def format_tenths(size_deg: float) -> str:
    """Return ``0.6°`` without sign, a dash if unknown."""
    return f"{numbers.format_fixed(abs(size_deg), 1)}°" if math.isfinite(size_deg) else numbers.UNKNOWN


def format_difference(value_deg: float, name: str) -> str:
    """Return ``0.6° flexion``: the sign as a word."""
    if not math.isfinite(value_deg):
        return numbers.UNKNOWN
    return f"{format_tenths(value_deg)} {direction_names(name)[0 if value_deg >= 0.0 else 1]}"


def format_interval(low_high: Interval, name: str) -> str:
    """Return ``0.0° to 1.2°`` for one direction, else each end with its own."""
    low, high = low_high
    if not (math.isfinite(low) and math.isfinite(high)):
        return numbers.UNKNOWN
    if low * high < 0.0:
        return tr("{low} to {high}").format(low=format_difference(low, name), high=format_difference(high, name))
    near, far = sorted((abs(low), abs(high)))
    return tr("{low} to {high}").format(low=format_tenths(near), high=format_tenths(far))


def format_coefficient(value: float) -> str:
    """Return a coefficient such as ``0.995``, a dash if unknown."""
    return numbers.format_fixed(value, 3).replace("-", "\N{MINUS SIGN}")


def remark_words(compared: Comparison, name: str = "") -> list[str]:
    """Return the caveats of a comparison, of one angle or of all."""
    text = []
    for remark in compared.angle_remarks(name) if name else compared.remarks:
        angle, found, rest = translate_phrase(remark).partition(": ")
        text.append(f"{angle_name(angle)}: {rest}" if found else angle)
    return [f"{words[:1].upper()}{words[1:]}." for words in text]

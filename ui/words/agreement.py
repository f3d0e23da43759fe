"""What a comparison with another measurement is called and said in; the sign of a difference is a word."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from carpus.ui import numbers
from carpus.ui.figures import FIGURES, figure_of
from carpus.ui.translate import say, tr

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.agreement.compare import Compared
    from carpus.core.agreement.statistics import Interval

TOKENS = {"deviation": "curve_b", "flexion": "curve_a", "pronosupination": "curve_c"}


def angle_name(name: str) -> str:
    """``Flexion–extension`` of an angle's name in every file."""
    wrist = {
        "flexion": tr("Flexion–extension"), "deviation": tr("Side movement"),
        "pronosupination": tr("Pronation–supination"),
    }  # fmt: skip
    if name in wrist:
        return wrist[name]
    if any(figure.joint == name for figure in FIGURES):
        return figure_of(name).long_name
    return tr("Thumb, knuckle sideways") if name == "MCP1_abduction" else name


def angle_token(name: str) -> str:
    """Colour of an angle."""
    return TOKENS.get(name) or (figure_of(name).token if any(one.joint == name for one in FIGURES) else "curve_a")


def ends(name: str) -> tuple[str, str]:
    """What is more, and what is less, of an angle: ``flexion``, ``extension``."""
    wrist = {
        "flexion": (tr("flexion"), tr("extension")),
        "deviation": (tr("radial"), tr("ulnar")),
        "pronosupination": (tr("supination"), tr("pronation")),
    }
    return wrist.get(name, (tr("more"), tr("less")))


def tenths(size_deg: float) -> str:
    """``0.6°`` without sign; a dash where it is not known."""
    return f"{numbers.fixed(abs(size_deg), 1)}°" if math.isfinite(size_deg) else numbers.UNKNOWN


def signed(value_deg: float, name: str) -> str:
    """``0.6° flexion``: the sign is the word."""
    if not math.isfinite(value_deg):
        return numbers.UNKNOWN
    return f"{tenths(value_deg)} {ends(name)[0 if value_deg >= 0.0 else 1]}"


def interval(low_high: Interval, name: str) -> str:
    """``0.0° to 1.2°`` where both are on one side, else each with its word."""
    low, high = low_high
    if not (math.isfinite(low) and math.isfinite(high)):
        return numbers.UNKNOWN
    if low * high < 0.0:
        return tr("{low} to {high}").format(low=signed(low, name), high=signed(high, name))
    near, far = sorted((abs(low), abs(high)))
    return tr("{low} to {high}").format(low=tenths(near), high=tenths(far))


def share(value: float) -> str:
    """``0.995`` of a coefficient; a dash where there is none."""
    return numbers.fixed(value, 3) if math.isfinite(value) else numbers.UNKNOWN


def remark_words(compared: Compared, name: str = "") -> list[str]:
    """What must be looked at before the figures are believed, of one angle or of all."""
    said = [_reason(remark) for remark in (compared.remarks_on(name) if name else compared.remarks)]
    return [f"{words[:1].upper()}{words[1:]}." for words in said]


def _reason(reason: str) -> str:
    name, found, rest = say(reason).partition(": ")
    return f"{angle_name(name)}: {rest}" if found else say(reason)

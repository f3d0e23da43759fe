"""What a comparison with another measurement is called and said in; the sign of a difference is a word."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from carpus.core.agreement.statistics import Judgement, furthest, judged
from carpus.ui import numbers
from carpus.ui.figures import FIGURES, figure_of
from carpus.ui.icons import State
from carpus.ui.translate import inside as within
from carpus.ui.translate import say, tr

if TYPE_CHECKING:  # a window loads nothing that reads files
    from carpus.core.agreement.compare import Compared, Pairs
    from carpus.core.agreement.statistics import Agreement, Interval

TOKENS = {"deviation": "curve_b", "flexion": "curve_a", "pronosupination": "curve_c"}
SHOWN_REASONS = 6


def angle_name(name: str) -> str:
    """``Flexion–extension`` of an angle's name in every file."""
    wrist = {
        "flexion": tr("Flexion–extension"), "deviation": tr("Side movement"), "pronosupination": tr("Turning"),
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


def limits(figures: Agreement, name: str) -> str:
    """``3.4° extension to 4.6° flexion``."""
    if not math.isfinite(figures.limits[0]):
        return numbers.UNKNOWN
    low, high = figures.limits
    if low * high > 0.0:  # both on one side: its word once
        near, far = sorted((low, high), key=abs)
        return tr("{low} to {high}").format(low=tenths(near), high=signed(far, name))
    return tr("{low} to {high}").format(low=signed(low, name), high=signed(high, name))


def share(value: float) -> str:
    """``0.995`` of a coefficient; a dash where there is none."""
    return numbers.fixed(value, 3) if math.isfinite(value) else numbers.UNKNOWN


def judgement_words(pairs: Pairs, limit_deg: float, *, readings: bool) -> tuple[State, str]:
    """Sign and words of one angle."""
    figures = pairs.figures_deg
    if figures.is_opposite:
        return "bad", tr("runs the other way: opposite sign?")
    found: Judgement = judged(figures, limit_deg)
    limit, apart = numbers.degrees(limit_deg), numbers.degrees(math.ceil(furthest(figures) - 1e-9))
    if found == "not_judged":
        return "open", tr("not judged: no limit was set")
    if found == "few":
        return "warn", tr("too few to say, {count} readings").format(count=figures.count)
    if found == "agree":
        return "good", tr("agree within {limit}").format(limit=limit)
    if readings:
        return "warn", tr("agree within {apart}, {count} readings").format(apart=apart, count=figures.count)
    return "bad", tr("up to {apart} apart: do not mix").format(apart=apart)


def headline(compared: Compared, limit_deg: float) -> tuple[str, str]:
    """The sentence, and what it rests on."""
    turned = [pairs.name for pairs in compared.pairs if pairs.figures_deg.is_opposite]
    if turned:
        sentence = tr("{angles}: the reference runs the other way.").format(angles=_list(turned))
        return sentence, tr(
            "One of the two has the opposite sign, or they are not of one movement. Turn it and compare again."
        )
    found = {pairs.name: judged(pairs.figures_deg, limit_deg) for pairs in compared.pairs}
    agree = [name for name, one in found.items() if one == "agree"]
    apart = [name for name, one in found.items() if one == "apart"]
    few = [name for name, one in found.items() if one == "few"]
    limit = numbers.degrees(limit_deg)
    if not limit_deg > 0.0:
        first = most_moved(compared)
        low, high = (signed(value, first.name) for value in first.figures_deg.limits)
        words = tr("{angle}: Carpus lies between {low} and {high} of the reference. Not judged.")
        sentence = words.format(angle=angle_name(first.name), low=low, high=high)
    elif agree:
        words = tr("{angles} agree within {limit}.") if len(agree) > 1 else tr("{angles} agrees within {limit}.")
        sentence = words.format(angles=_list(agree), limit=limit)
        if apart:
            words = tr("{angles} do not.") if len(apart) > 1 else tr("{angles} does not.")
            sentence += " " + words.format(angles=_list(apart))
        if few:
            sentence += " " + tr("Too few readings of {angles}.").format(angles=_list(few, inside=True))
    elif apart:
        words = tr("{angles} do not agree within {limit}.")
        if len(apart) == 1:
            words = tr("{angles} does not agree within {limit}.")
        sentence = words.format(angles=_list(apart), limit=limit)
    else:
        sentence = tr("Too few readings to say whether they agree within {limit}.").format(limit=limit)
    basis = [
        tr("Judged against the {limit} that you set before.").format(limit=limit)
        if limit_deg > 0.0
        else tr("No limit is set: Settings, “Agreement”. Set it before you compare.")
    ]
    if compared.shift is None:
        basis.append(tr("A goniometer itself repeats within 4 to 5° by one rater."))
    basis.append(tr("One session of one person says nothing of others."))
    return sentence, " ".join(basis)


ORDER = ("flexion", "deviation", "pronosupination")


def in_order(compared: Compared) -> Compared:
    """The trained angles first, as everywhere in the window."""
    place = {name: number for number, name in enumerate(ORDER)}
    return replace(compared, pairs=tuple(sorted(compared.pairs, key=lambda pairs: place.get(pairs.name, len(place)))))


def most_moved(compared: Compared) -> Pairs:
    """The angle with the largest movement."""
    return max(compared.pairs, key=lambda pairs: float(pairs.measured_rad.max() - pairs.measured_rad.min()))


def _list(names: list[str], *, inside: bool = False) -> str:
    """``Flexion–extension and side movement``; more than three are counted."""
    if len(names) > 3:
        return tr("{count} angles").format(count=len(names))
    said = [angle_name(name) for name in names]
    said = [within(one) if inside or number else one for number, one in enumerate(said)]
    return said[0] if len(said) == 1 else tr("{first} and {last}").format(first=", ".join(said[:-1]), last=said[-1])


def joined_rows(compared: Compared) -> list[tuple[State, str, str, str]]:
    """How the two were brought together: state, thing, value, small words."""
    shift, alignment = compared.shift, compared.alignment
    rows: list[tuple[State, str, str, str]] = []
    if shift is None:
        rows.append(("good", tr("Time shift"), tr("none needed"), tr("hand held still at each reading")))
    else:
        by_ms = round(1e3 * abs(shift.reference_later_s))
        later = tr("reference later") if shift.reference_later_s >= 0.0 else tr("Carpus later")
        words = tr("{later}; curves match {match}") if by_ms else tr("curves match {match}")
        words = words.format(later=later, match=numbers.fixed(shift.match, 2))
        value = f"{by_ms}{numbers.NARROW_GAP}ms" if by_ms else tr("none")
        is_sure = not (shift.rivals or shift.at_edge or math.isfinite(shift.drift_found))
        rows.append(("good" if is_sure else "warn", tr("Time shift"), value, words))
    if alignment is None:
        rows.append(("open", tr("Alignment"), tr("none"), tr("angles compared as they are")))
    else:
        words = tr("turned as one rigid body; {off} mm apart").format(off=numbers.fixed(1e3 * alignment.residual_m, 1))
        rows.append(("good", tr("Alignment"), tenths(math.degrees(alignment.turn_rad)), words))
    if math.isfinite(compared.rate_hz):
        words = tr("of the reference; joined at Carpus’s pictures")
        rows.append(("good", tr("Sampling"), tr("{rate} a second").format(rate=f"{compared.rate_hz:.0f}"), words))
    what = tr("readings: hand not still or not seen") if shift is None else tr("pictures predicted, doubtful or lost")
    count = tr("{left} of {all}").format(left=compared.left_out, all=compared.pictures)
    rows.append(("warn" if compared.left_out else "good", tr("Left out"), count, what))
    return rows


def remark_words(compared: Compared, name: str = "") -> list[str]:
    """What must be looked at before the figures are believed, of one angle or of all."""
    said = [_reason(remark) for remark in (compared.remarks_on(name) if name else compared.remarks)]
    return [f"{words[:1].upper()}{words[1:]}." for words in said]


def left_words(compared: Compared) -> list[str]:
    """What was not used, each with its reason, as many as there is room for."""
    said = [_reason(reason) for reason in compared.not_used]
    more = len(said) - SHOWN_REASONS
    if more > 0:
        return [*said[:SHOWN_REASONS], tr("and {count} more, in the table that is saved").format(count=more)]
    return said


def _reason(reason: str) -> str:
    name, found, rest = say(reason).partition(": ")
    return f"{angle_name(name)}: {rest}" if found else say(reason)

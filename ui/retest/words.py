"""Sentences of the test and retest."""

from __future__ import annotations

import math
from collections.abc import Sequence
from datetime import date

from carpus.core.agreement.retest import Mounting, Person, Restated, Retest, RetestPlan
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.measures.change import ARC_LIMIT_FACTOR, FEWEST_PEOPLE, ErrorLimits, change_limit_rad
from carpus.ui import numbers, terms
from carpus.ui.figures import figure_of
from carpus.ui.icons import State
from carpus.ui.translate import inside, tr
from carpus.ui.verdicts import reason_words, verdict_word


def headline(plan: RetestPlan, limits: ErrorLimits) -> tuple[str, str]:
    """How far the study is, and what holds until then."""
    complete = plan.complete
    if not plan.people:
        return tr("Nobody takes part yet."), tr("Choose volunteers or staff, never patients, by “People…”.")
    if plan.blocked == "simulated":
        return tr("These are simulated hands."), tr("Limits of a simulated hand are never put into force.")
    lacking = FEWEST_PEOPLE - complete
    counted = tr("1 person is measured twice.") if complete == 1 else tr("{count} people are measured twice.")
    if lacking > 0:
        more = tr("{count} more make it usable.").format(count=lacking)
        basis = tr(
            "Until then progress and reports use the limits of before. {least} people are the least; 20 are better."
        )
        return f"{counted.format(count=complete)} {more}", basis.format(least=FEWEST_PEOPLE)
    study = plan.study
    own = limits.study(study.protocol, study.exercise, study.angle_order) if study is not None else None
    if own is not None:
        words = tr("Limits of {day} with {count} people are in force. “Use these limits” puts these in their place.")
        day = numbers.day_of_year(date.fromisoformat(own.made))
        return counted.format(count=complete), words.format(day=day, count=own.people)
    basis = tr("“Use these limits” puts them into force in progress and reports. Reports already made keep theirs.")
    return counted.format(count=complete), basis


def mounting_words(mounting: Mounting) -> str:
    """``Mon 2 Nov · MK``."""
    return " · ".join(part for part in (numbers.short_date(mounting.when), mounting.rater) if part)


def person_words(person: Person) -> str:
    """Pseudonym, and the hand where one was measured."""
    return person.pseudonym if person.side is None else f"{person.pseudonym}, {inside(terms.side_name(person.side))}"


def second_words(person: Person) -> str:
    """The last time that counts, or until when it must be."""
    counted = person.counted
    if len(counted) > 2:
        return tr("{last}, {count} times").format(last=mounting_words(counted[-1]), count=len(counted))
    if len(counted) == 2:
        return mounting_words(counted[-1])
    if person.due_by is not None:
        return tr("due by {day}").format(day=numbers.short_date(person.due_by))
    return ""


def state_words(person: Person) -> tuple[State, str]:
    """Sign and word; a session that takes no part says why."""
    why = [one.reason for one in person.mountings if one.reason]
    if person.state == "complete":
        return "good", tr("complete")
    if why:
        words = tr("more than 14 days later") if "too_late" in why else reason_words(why[:1])
        return "warn", tr("measure again: {reason}").format(reason=words)
    if person.state == "due":
        return "partly", tr("second due")
    if person.state == "too_late":
        return "warn", tr("too late: measure both again")
    return "open", tr("missing")


def figure_name(of: str, movement: str) -> str:
    """``Flexion``, ``Bending arc``, ``Middle finger, middle joint``."""
    if of in WRIST_ANGLES:
        return terms.arc_name(WRIST_ANGLES.index(of)) if movement == "arc" else terms.movement_name(movement)
    name = figure_of(of).long_name
    return name if movement == "arc" else f"{name}, {inside(terms.movement_name(movement))}"


def limit_now_deg(plan: RetestPlan, of: str, movement: str, limits: ErrorLimits) -> float:
    """What a change must exceed today: the clinic's own limit in force, else the usual one."""
    if plan.study is not None:
        own = limits.study(plan.study.protocol, plan.study.exercise, plan.study.angle_order)
        mine = own.limit_deg(of, movement) if own is not None else None
        if mine is not None:
            return mine
    usual = math.degrees(change_limit_rad("TAM" if of.startswith("TAM") else of))
    return usual * (ARC_LIMIT_FACTOR if movement == "arc" and not of.startswith("TAM") else 1.0)


def new_limit_deg(found: Retest) -> float:
    """What it would become: whole degrees, upwards."""
    return float(math.ceil(found.mdc95 - 1e-9)) if math.isfinite(found.mdc95) else math.nan


def restated_title(plan: RetestPlan) -> str:
    """Over what the limits would change."""
    if plan.blocked == "few":
        return tr("What changes in reports, once complete")
    return tr("What would change in today's reports")


def restated_words(statements: Sequence[Restated], done: int, patients: int) -> str:
    """How many of the statements about patients change, or how far the look at them is."""
    if done < patients:
        return tr("Looking at the sessions of {done} of {count} patients…").format(done=done + 1, count=patients)
    if not statements:
        return tr("Nobody else has two sessions of this exercise that compare.")
    changed = sum(one.is_changed for one in statements)
    pattern = tr("{changed} of {count} statements change. Reports already made keep theirs.")
    return pattern.format(changed=changed, count=len(statements))


def restated_state(one: Restated) -> State:
    """Sign of what is said of a patient then."""
    if one.is_changed:
        return "partly"
    return "good" if one.then == "improved" else "warn" if one.then == "worse" else "open"


def statement_words(one: Restated) -> str:
    """``Otter 29, extension, 6 Oct → 17 Nov``."""
    of = one.now.joint or WRIST_ANGLES[one.now.angle]
    name = figure_name(of, one.now.movement)
    days = f"{numbers.day_month(one.first)} → {numbers.day_month(one.last)}"
    return f"{one.pseudonym}, {inside(name)}, {days}"


def verdict_change(one: Restated) -> str:
    """``no change → improved``, or ``improved, as now``."""
    if one.is_changed:
        return f"{verdict_word(one.now.verdict)} → {verdict_word(one.then)}"
    return tr("{verdict}, as now").format(verdict=verdict_word(one.then))


def tenths(size_deg: float) -> str:
    """``6.6°``; a dash where it is not known."""
    return f"{numbers.fixed(size_deg, 1)}°" if math.isfinite(size_deg) else numbers.UNKNOWN

"""Reference ranges of healthy people, each with its source and whom that measured.

A range is of one joint moved actively to its end, so it is shown beside the trained angle only, and a total beside a
fist only. Pronation and supination are of the forearm, from thumb up.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from carpus.core.model.hand.exercises import DIRECTIONS, Exercise
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.results.measure import Measure, is_total_active_motion

Grade = Literal["excellent", "good", "fair", "poor"]
NORMAL_TOTAL_DEG = {1: 140.0, 2: 260.0, 3: 260.0, 4: 260.0, 5: 260.0}
"""TAM of a healthy finger if the other hand is unknown (clinical reference 4.3)."""


@dataclass(frozen=True, slots=True)
class Norm:
    """Lowest and highest value of the sources in degrees; source, ages and sexes in words."""

    low_deg: float
    high_deg: float
    source: str
    ages: str
    sexes: str

    def sentence(self) -> str:
        """Return the source and whom it covers as a sentence."""
        return phrase("Reference: {source}; {ages}, {sexes}.", source=self.source, ages=self.ages, sexes=self.sexes)


@dataclass(frozen=True, slots=True)
class Person:
    """Sex and age in years, which choose a reference; both stay in the store and on the screen."""

    sex: str
    age: int


_ADULTS = phrase("adults (ages not stated, not for children or older people)")
_BOTH = phrase("women and men together")
_WRIST_SOURCE = phrase("AMA Guides; AAOS 1965 (goniometer)")
_TOTAL_SOURCE = phrase("ASSH, sum of active flexion in a fist")
_WRIST_DEG: Mapping[str, tuple[float, float]] = {
    "flexion": (60.0, 80.0), "extension": (60.0, 70.0), "radial": (20.0, 20.0), "ulnar": (30.0, 30.0),
    "pronation": (80.0, 80.0), "supination": (80.0, 80.0),
}  # fmt: skip
"""The lower source (AMA) and the higher one (AAOS) (clinical reference 4.1)."""
_MOVEMENTS = ("flexion", "extension", "radial", "ulnar", "pronation", "supination")
_WRIST_BY_AGE: tuple[tuple[str, int, int, Phrase, Phrase, Phrase, tuple[float, ...]], ...] = (
    (
        "male", 18, 54, phrase("Boone and Azen 1979, 109 males from 18 months on (active, goniometer)"),
        phrase("up to 54 years"), phrase("men"),
        (76.0, 75.0, 22.0, 36.0, 76.0, 82.0),
    ),
    (
        "", 65, 85, phrase("Walker 1984, 60 people (active, goniometer)"), phrase("65 to 85 years"), _BOTH,
        (64.0, 63.0, 19.0, 26.0, 71.0, 74.0),
    ),
)  # fmt: skip
"""Means by sex (empty: any) and age, of :data:`_MOVEMENTS` (Norkin and White, table A.1). Of women below 65 it has 20
people of both sexes together, and passive values, so the ranges for adults apply."""
GRIP_SOURCE = "Steiber 2016"
_GRIP_KG: Mapping[str, tuple[tuple[int, float, float], ...]] = {
    "female": (
        (17, 31.5, 6.2), (20, 32.5, 5.4), (25, 33.6, 5.6), (30, 33.3, 5.8), (35, 34.2, 6.2), (40, 34.5, 6.3),
        (45, 33.4, 6.1), (50, 32.2, 5.9), (55, 30.0, 5.5), (60, 29.0, 5.3), (65, 27.6, 5.2), (70, 26.0, 4.9),
        (75, 24.2, 4.5), (80, 21.4, 4.1),
    ),
    "male": (
        (17, 48.3, 9.6), (20, 50.7, 8.2), (25, 52.4, 8.3), (30, 53.6, 8.2), (35, 53.4, 9.8), (40, 53.8, 9.3),
        (45, 52.9, 8.4), (50, 50.4, 8.4), (55, 49.1, 8.5), (60, 46.3, 8.4), (65, 44.1, 7.3), (70, 41.7, 7.6),
        (75, 37.8, 7.9), (80, 33.2, 7.5),
    ),
}  # fmt: skip
"""Lowest age of a group, mean and sd of grip (Steiber 2016, PLOS ONE 11: e0163917, table S3: 25,285 measurements in
Germany, Smedley dynamometer)."""
_MAX_GRIP_AGE = 90


def grip_norm_kg(person: Person | None) -> tuple[float, float] | None:
    """Return mean and sd of the grip of a person's sex and age, None if there is no group.

    >>> grip_norm_kg(Person("female", 64)), grip_norm_kg(Person("", 64)), grip_norm_kg(Person("male", 16))
    ((29.0, 5.3), None, None)
    """
    if person is None or person.age > _MAX_GRIP_AGE:
        return None
    groups = [(mean, sd) for age, mean, sd in _GRIP_KG.get(person.sex, ()) if age <= person.age]
    return groups[-1] if groups else None


def wrist_norm(movement: str, angle: int, exercise: Exercise, person: Person | None = None) -> Norm | None:
    """Return the range of a direction, or of an arc, if the exercise trains this angle.

    By sex and age where a source has them for this person, else for adults.

    >>> from carpus.core.model.hand.exercises import get_exercise
    >>> norm = wrist_norm("arc", 1, get_exercise("WRIST_FE"))
    >>> (norm.low_deg, norm.high_deg), wrist_norm("flexion", 1, get_exercise("WRIST_RU"))
    ((120.0, 150.0), None)
    """
    ends = DIRECTIONS[angle] if movement == "arc" else (movement,)
    if exercise.angle != angle or not all(end in _WRIST_DEG for end in ends):
        return None
    for sex, min_age, max_age, source, ages, sexes, means in _WRIST_BY_AGE:
        if person is not None and sex in ("", person.sex) and min_age <= person.age <= max_age:
            mean = sum(means[_MOVEMENTS.index(end)] for end in ends)
            return Norm(mean, mean, source, ages, sexes)
    low, high = (sum(_WRIST_DEG[end][side] for end in ends) for side in (0, 1))
    return Norm(low, high, _WRIST_SOURCE, _ADULTS, _BOTH)


def total_norm(finger: int, exercise: Exercise) -> Norm | None:
    """Return the range of a finger's TAM, if the exercise is the fist that the source describes."""
    if not (exercise.has_total_motion and exercise.joint):
        return None
    total = NORMAL_TOTAL_DEG[finger]
    return Norm(total, total, _TOTAL_SOURCE, _ADULTS, _BOTH)


SHARE_OF_NORMAL, SHARE_OF_OTHER = "share of the usual TAM", "share of the other hand's TAM"


def compute_total_shares(
    rows: Sequence[Measure], exercise: Exercise, other_hand: Sequence[Measure] = ()
) -> tuple[Measure, ...]:
    """Compute the share of every finger's TAM.

    Of the other hand's TAM if that was seen whole, else of the normal one in the exercise of its source. A lower bound
    gives a lower bound.
    """
    out = []
    beside = {
        row.subject: row.mean for row in other_hand if row.quantity == "arc" and row.count and not row.is_lower_bound
    }
    for row in rows:
        if is_total_active_motion(row.subject) and row.quantity == "arc" and row.count:
            finger, own = int(row.subject[3:]), beside.get(row.subject, math.nan)
            if not own > 0.0 and total_norm(finger, exercise) is None:
                continue
            share = row.mean / (own if own > 0.0 else NORMAL_TOTAL_DEG[finger])
            what = SHARE_OF_OTHER if own > 0.0 else SHARE_OF_NORMAL
            out.append(Measure("share", row.subject, what, "share", (share,), share, is_lower_bound=row.is_lower_bound))
    return tuple(out)


def grade_share(share: Measure) -> Grade | None:
    """Grade a share: excellent from 100 %, good above 75 %, fair above 50 %, else poor; None for a lower bound."""
    if share.is_lower_bound:
        return None
    if share.mean >= 1.0:
        return "excellent"
    return "good" if share.mean > 0.75 else "fair" if share.mean > 0.5 else "poor"

"""Usual ranges of healthy people: each with its source and whom that source measured; none where it says nothing.

A range is of one joint moved actively as far as it goes, so it stands beside the angle that an exercise trains, and
beside no other; a total beside a fist. Pro/supination has none: its zero here is palm down.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from carpus.core.measures.grade import USUAL_TOTAL_DEG
from carpus.core.output.exercises import SIDES, Exercise, Movement
from carpus.core.phrase import phrase


@dataclass(frozen=True, slots=True)
class Norm:
    """Lowest and highest usual value of the sources, degrees; ``source``, ``ages`` and ``sexes`` in words."""

    low_deg: float
    high_deg: float
    source: str
    ages: str
    sexes: str

    def sentence(self) -> str:
        """Where it is from and whom it covers."""
        return phrase(
            "Usual: {source}; {ages}, {sexes}; not for children or old age.",
            source=self.source, ages=self.ages, sexes=self.sexes,
        )  # fmt: skip


_ADULTS, _BOTH = phrase("adults, ages not told"), phrase("women and men together")
_WRIST_SOURCE = phrase("AMA Guides; AAOS 1965 (goniometer)")
_TOTAL_SOURCE = phrase("ASSH, sum of active bending in a fist")
_WRIST_DEG: Mapping[Movement, tuple[float, float]] = {
    "flexion": (60.0, 80.0), "extension": (60.0, 70.0), "radial": (20.0, 20.0), "ulnar": (30.0, 30.0),
}  # fmt: skip
"""The lower of the two sources (AMA), and the higher (AAOS) (clinical reference 4.1)."""


def wrist_norm(movement: Movement, angle: int, exercise: Exercise) -> Norm | None:
    """Of one direction, or the sum of both for an arc, where the exercise trains this angle.

    >>> from carpus.core.output.exercises import exercise_named
    >>> found = wrist_norm("arc", 1, exercise_named("WRIST_FE"))
    >>> (found.low_deg, found.high_deg), wrist_norm("flexion", 1, exercise_named("WRIST_RU"))
    ((120.0, 150.0), None)
    """
    ends = SIDES[angle] if movement == "arc" else (movement,)
    if exercise.angle != angle or not all(end in _WRIST_DEG for end in ends):
        return None
    low, high = (sum(_WRIST_DEG[end][side] for end in ends) for side in (0, 1))
    return Norm(low, high, _WRIST_SOURCE, _ADULTS, _BOTH)


def total_norm(finger: int, exercise: Exercise) -> Norm | None:
    """Of a finger's total active motion, where the exercise is the fist of which the source speaks."""
    if not (exercise.total and exercise.joint):
        return None
    total = USUAL_TOTAL_DEG[finger]
    return Norm(total, total, _TOTAL_SOURCE, _ADULTS, _BOTH)

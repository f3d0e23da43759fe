"""What is shown of two sessions side by side: gathered once, for window, page and tables."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.hand.exercises import SIDES
from carpus.core.results.figures import SessionFigures
from carpus.core.results.motion_curves import MeanRepetition, Quantity, SeenAngles, mean_repetition, seen_angles
from carpus.core.results.ranges import FREE_ORDER, RowKey
from carpus.core.results.seen import best_motion
from carpus.core.results.side_by_side import SideBySide, side_by_side
from carpus.core.session.values import Session
from carpus.ui import numbers, terms
from carpus.ui.figures import FINGERS, Figure, figure_of, with_side
from carpus.ui.plot.beside import BesidePlot
from carpus.ui.report.beside_words import middle_words, name_of
from carpus.ui.report.hand_rows import compared_row, followed_keys, followed_kinds, trains_thumb
from carpus.ui.translate import tr

MIDDLE = "middle"
"""The middle joints of all fingers."""


@dataclass(frozen=True, slots=True)
class Watched:
    """One session that was opened, with its figures and what of its angles was seen."""

    session: Session
    figures: SessionFigures
    seen: SeenAngles

    @classmethod
    def of(cls, session: Session, figures: SessionFigures) -> Watched:
        return cls(session, figures, seen_angles(session))


@dataclass(frozen=True, slots=True)
class Shown:
    """``followed`` is what of the whole hand is looked at, empty for the wrist; ``quantities`` what curves there are;
    ``means`` both mean repetitions of each."""

    both: SideBySide
    followed: str
    quantities: tuple[Quantity, ...]
    means: tuple[tuple[MeanRepetition, MeanRepetition], ...]

    @property
    def names(self) -> tuple[str, str]:
        first, second = self.both.first, self.both.second
        return name_of(first, second), name_of(second, first)

    def plot(self, quantity: Quantity) -> BesidePlot:
        return BesidePlot(quantity, *self.means[self.quantities.index(quantity)], self.names)

    @property
    def main_quantity(self) -> Quantity:
        main = self.both.main
        if main is not None and main.first.joint and (main.first.joint, -1) in self.quantities:
            return main.first.joint, -1
        if main is not None and ("", main.first.angle) in self.quantities:
            return "", main.first.angle
        joint = self.both.first.exercise.joint
        return self._of_finger(figure_of(joint).finger if joint else 0) or self.quantities[0]

    def quantity_of(self, finger: int) -> Quantity:
        """Of a finger, or the main one where it has none."""
        return self._of_finger(finger) or self.main_quantity

    def _of_finger(self, finger: int) -> Quantity | None:
        return next((one for one in self.quantities if one[0] and figure_of(one[0]).finger == finger), None)


def kinds(first: Watched, second: Watched) -> list[tuple[str, str]]:
    """What of the whole hand can be looked at, as value and words; nothing unless both are of fingers."""
    if not (first.figures.joint_rows and second.figures.joint_rows):
        return []
    found = followed_kinds(first.figures)
    if compared_row(first.figures) == "middle" and not trains_thumb(first.figures):
        return [(MIDDLE, middle_words()), *found]  # no finger stands for the others
    return found


def _keys(followed: str) -> tuple[RowKey, ...]:
    """What a choice of :func:`kinds` looks at."""
    if followed == MIDDLE:
        return tuple((Figure(finger, "middle").joint, "arc", -1) for finger in FINGERS[1:])
    return followed_keys(followed)


def shown(first: Watched, second: Watched, followed: str) -> Shown:
    """All that is shown of two sessions."""
    keys = _keys(followed)
    both = side_by_side(first.figures, second.figures, keys)
    quantities = tuple((key[0], -1) for key in keys) if keys else _angles(first.figures)
    means = {quantity: (_mean(first, quantity), _mean(second, quantity)) for quantity in quantities}
    drawn = tuple(quantity for quantity in quantities if any(mean.known for mean in means[quantity]))
    drawn = drawn or quantities[:1]
    return Shown(both, followed if keys else "", drawn, tuple(means[quantity] for quantity in drawn))


def _angles(figures: SessionFigures) -> tuple[Quantity, ...]:
    """The wrist's angles, the trained one first."""
    trained = figures.exercise.angle
    order = FREE_ORDER if trained is None else (trained, *(angle for angle in FREE_ORDER if angle != trained))
    return tuple(("", angle) for angle in order)


def _mean(watched: Watched, quantity: Quantity) -> MeanRepetition:
    return mean_repetition(watched.seen.time_s, watched.seen.of(quantity), watched.figures.repetitions)


def value_words(watched: Watched, quantity: Quantity, row: int) -> str:
    """``Flexion 37° ± 2°`` where the angle was seen."""
    joint, angle = quantity
    values = watched.seen.of(quantity)
    sign = figure_of(joint).sign if joint else 1.0  # from the angle in every file to the one that is spoken of
    value = sign * float(values[row]) if 0 <= row < len(values) else math.nan
    if not math.isfinite(value):
        return tr("not seen")
    if joint:
        figure = figure_of(joint)
        said = with_side(value, figure.finger) if figure.row == "spread" else numbers.signed_degrees(value)
        return f"{figure.row_name} {said}"
    sd = float(np.degrees(best_motion(watched.session).angles_sd_rad[row, angle]))
    return f"{terms.movement_name(SIDES[angle][0 if value >= 0 else 1])} {numbers.with_spread(value, sd)}"

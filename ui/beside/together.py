"""Two sessions played in step: where each is at a moment of the player, and in which repetition."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from carpus.core.results.repetition_rows import ShownRepetition
from carpus.core.results.side_by_side import InStep, Step, in_step
from carpus.ui.beside.shown import Watched
from carpus.ui.plot.session import row_at

BACK_S = 0.3
"""So soon after a start one goes to the repetition before."""


@dataclass(frozen=True, slots=True)
class Together:
    """Times are the player's unless they are said to be of one of the two."""

    watched: tuple[Watched, Watched]
    step: InStep

    @classmethod
    def of(cls, watched: tuple[Watched, Watched], step: Step) -> Together:
        one, other = watched
        return cls(watched, in_step(one.figures.repetitions, other.figures.repetitions, ends_s(watched), step))

    @property
    def repetitions(self) -> tuple[tuple[ShownRepetition, ...], tuple[ShownRepetition, ...]]:
        one, other = self.watched
        return one.figures.repetitions, other.figures.repetitions

    def row(self, place: int, time_s: float) -> int:
        return row_at(self.watched[place].seen.time_s, self.step.at(time_s)[place])

    def current(self, place: int, time_s: float) -> int:
        """The repetition that one of the two is in, from 0; -1 between them."""
        own_s = self.step.at(time_s)[place]
        found = enumerate(self.repetitions[place])
        return max((n for n, one in found if one.start_s - 1e-6 <= own_s <= one.end_s + 1e-6), default=-1)

    def share(self, place: int, time_s: float) -> float:
        """How far one of the two is in its repetition; NaN between them."""
        number = self.current(place, time_s)
        if number < 0:
            return math.nan
        one = self.repetitions[place][number]
        share = (self.step.at(time_s)[place] - one.start_s) / max(one.end_s - one.start_s, 1e-6)
        return min(max(share, 0.0), 1.0)

    def at_share(self, time_s: float, share: float) -> float:
        """Elsewhere in the repetition that the first is in; the same time between repetitions."""
        number = self.current(0, time_s)
        if number < 0:
            return time_s
        one = self.repetitions[0][number]
        return self.step.when_first(one.start_s + share * (one.end_s - one.start_s))

    def next_start(self, time_s: float, by: int) -> float:
        """The start of the next repetition, or of this one or the one before; the same time where there is none."""
        starts = self.step.starts_s or tuple(one.start_s for one in self.repetitions[0])
        if by > 0:
            return next((start for start in starts if start > time_s + 1e-3), time_s)
        return next((start for start in reversed(starts) if start < time_s - BACK_S), starts[0] if starts else time_s)

    def period_s(self) -> float:
        """From one picture of the first to the next."""
        times = self.watched[0].seen.time_s
        return float(np.median(np.diff(times))) if len(times) > 1 else 1.0 / 30.0


def ends_s(watched: tuple[Watched, Watched]) -> tuple[float, float]:
    """How long both are."""
    one, other = (float(of.seen.time_s[-1]) if len(of.seen.time_s) else 0.0 for of in watched)
    return one, other

"""Two sessions played in step: for every moment of the player where each of the two recordings is.

Seconds after each recording's first frame; the player's own time counts seconds at the speed at which it was recorded.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from carpus.core.results.repetition_rows import ShownRepetition
from carpus.core.types import FloatArray

Step = Literal["part", "start", "time"]
"""By part of the repetition, by repetition start, or by time."""


@dataclass(frozen=True, slots=True)
class InStep:
    """Knots (K,) between which time runs evenly: ``player_s`` rises strictly, ``first_s`` and ``second_s`` never fall.

    ``starts_s`` the player's time at which each pair of repetitions begins.
    """

    player_s: FloatArray
    first_s: FloatArray
    second_s: FloatArray
    starts_s: tuple[float, ...]

    @property
    def end_s(self) -> float:
        """How long the player runs."""
        return float(self.player_s[-1])

    def at(self, player_s: float) -> tuple[float, float]:
        """Where the first and the second recording are."""
        both = (np.interp(player_s, self.player_s, side) for side in (self.first_s, self.second_s))
        first, second = (float(value) for value in both)
        return first, second

    def when_first(self, time_s: float) -> float:
        """The player's first moment at which the first recording has come to a time."""
        return self._when(self.first_s, time_s)

    def when_second(self, time_s: float) -> float:
        """The player's first moment at which the second recording has come to a time."""
        return self._when(self.second_s, time_s)

    def _when(self, side_s: FloatArray, time_s: float) -> float:
        wanted = min(max(time_s, float(side_s[0])), float(side_s[-1]))
        k = int(np.searchsorted(side_s, wanted))  # the first knot at or after it
        if k == 0 or side_s[k] == side_s[k - 1]:
            return float(self.player_s[k])
        share = (wanted - side_s[k - 1]) / (side_s[k] - side_s[k - 1])
        return float(self.player_s[k - 1] + share * (self.player_s[k] - self.player_s[k - 1]))


def in_step(
    first: Sequence[ShownRepetition],
    second: Sequence[ShownRepetition],
    durations_s: tuple[float, float],
    step: Step = "part",
) -> InStep:
    """The first repetition beside the first one, the second beside the second, and so on, as both were found.

    ``part``: the first recording runs at its own speed, the second so that both are in the same part of their
    repetition. ``start``: both run at their own speed, and who is back first waits for the next start. What comes
    before the first repetition runs so that both begin it together; what comes after the last common one, and all of it
    with ``time``, runs at its own speed until each ends.
    """
    knots = _Knots()
    pairs = [] if step == "time" else list(zip(_edges(first, durations_s[0]), _edges(second, durations_s[1])))  # noqa: B905
    starts: list[float] = []
    if pairs:
        (start_first, _), (start_second, _) = pairs[0]
        lead_s = max(start_first, start_second)
        for wait_s in sorted({lead_s - start_first, lead_s - start_second}):
            knots.add(wait_s, max(0.0, wait_s - lead_s + start_first), max(0.0, wait_s - lead_s + start_second))
        knots.add(lead_s, start_first, start_second)
    for number, (mine, other) in enumerate(pairs):
        starts.append(knots.player_s)
        if step == "part":
            knots.go_on(mine[1] - mine[0] or other[1] - other[0], mine[1], other[1])
        if number + 1 < len(pairs):
            (next_first, _), (next_second, _) = pairs[number + 1]
            knots.run_to(next_first, next_second, together=step == "part")
    knots.run_to(*durations_s, together=False)
    return knots.made(tuple(starts))


class _Knots:
    """Collects knots; time never goes back."""

    def __init__(self) -> None:
        self._rows: list[tuple[float, float, float]] = [(0.0, 0.0, 0.0)]

    @property
    def player_s(self) -> float:
        return self._rows[-1][0]

    def add(self, player_s: float, first_s: float, second_s: float) -> None:
        last = self._rows[-1]
        row = (max(player_s, last[0]), max(first_s, last[1]), max(second_s, last[2]))
        if row[0] > last[0]:
            self._rows.append(row)

    def go_on(self, by_s: float, first_s: float, second_s: float) -> None:
        self.add(self.player_s + by_s, first_s, second_s)

    def run_to(self, first_s: float, second_s: float, *, together: bool) -> None:
        """To a place in each: evenly so that both arrive at once, or each at its own speed, waiting there."""
        _, at_first, at_second = self._rows[-1]
        ways = (max(first_s - at_first, 0.0), max(second_s - at_second, 0.0))
        if not together:
            self.go_on(min(ways), at_first + min(ways), at_second + min(ways))
            self.go_on(max(ways) - min(ways), at_first + ways[0], at_second + ways[1])
        else:
            self.go_on(max(ways), at_first + ways[0], at_second + ways[1])

    def made(self, starts_s: tuple[float, ...]) -> InStep:
        rows = np.array(self._rows if len(self._rows) > 1 else [*self._rows, (1e-3, 0.0, 0.0)])
        return InStep(rows[:, 0], rows[:, 1], rows[:, 2], starts_s)


def _edges(repetitions: Sequence[ShownRepetition], duration_s: float) -> list[tuple[float, float]]:
    """Start and end of each whole one, in order and inside the recording, whatever a person moved them to."""
    out: list[tuple[float, float]] = []
    last = 0.0
    for repetition in (one for one in repetitions if one.is_whole):
        start = min(max(repetition.start_s, last), duration_s)
        last = min(max(repetition.end_s, start), duration_s)
        out.append((start, last))
    return out

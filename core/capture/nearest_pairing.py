"""Colour and depth come as two streams with clocks that drift: each colour picture gets the nearest depth in time."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")

TOLERANCE_US = 20_000
"""Farther apart in time, a colour picture has no depth."""


@dataclass(frozen=True, slots=True)
class Stamped(Generic[T]):
    """A picture with its device time and its number in its stream."""

    timestamp_us: int
    number: int
    picture: T


Pair = tuple[Stamped[T], Stamped[T] | None]


class NearestPairing(Generic[T]):
    """Pairs two rising streams as they come.

    A colour picture leaves as soon as its depth is certain: one nearer than half a period has come, or one that is
    later. Bound: at most ``limit`` pictures of a stream wait; then the oldest colour picture leaves with the
    nearest depth so far, or the oldest depth picture is forgotten. A depth picture serves one colour picture.

    The streams of a camera do not start at one time: up to ``start_limit`` colour pictures from before the first
    pair are left out, where a recording (0) keeps every one.

    >>> pairing = NearestPairing[str](period_us=33_333)
    >>> pairing.add_color(Stamped(0, 1, "red"))
    []
    >>> [(color.picture, depth.picture) for color, depth in pairing.add_depth(Stamped(4_000, 1, "near"))]
    [('red', 'near')]
    """

    def __init__(self, period_us: float, *, has_depth: bool = True, limit: int = 4, start_limit: int = 0) -> None:
        self._certain_us = 0.45 * period_us
        self._has_depth = has_depth
        self._limit = limit
        self._may_leave_out = start_limit
        self._colors: deque[Stamped[T]] = deque()
        self._depths: deque[Stamped[T]] = deque()

    def add_color(self, color: Stamped[T]) -> list[Pair[T]]:
        """Take a colour picture; the pairs that are now certain, in order."""
        self._colors.append(color)
        return self._decide()

    def add_depth(self, depth: Stamped[T]) -> list[Pair[T]]:
        """Take a depth picture; the pairs that are now certain, in order."""
        self._depths.append(depth)
        decided = self._decide()
        while len(self._depths) > self._limit:
            self._depths.popleft()
        return decided

    def finish(self) -> list[Pair[T]]:
        """No more pictures come: the pairs that were still open."""
        self._has_depth = False
        return self._decide()

    def _decide(self) -> list[Pair[T]]:
        decided: list[Pair[T]] = []
        while self._colors:
            color = self._colors[0]
            nearest = min(self._depths, key=lambda depth: abs(depth.timestamp_us - color.timestamp_us), default=None)
            apart_us = abs(nearest.timestamp_us - color.timestamp_us) if nearest else 1 << 62
            certain = (
                not self._has_depth
                or apart_us <= self._certain_us
                or (self._depths and self._depths[-1].timestamp_us >= color.timestamp_us)
                or len(self._colors) > self._limit
            )
            if not certain:
                break
            self._colors.popleft()
            partner = nearest if apart_us <= TOLERANCE_US else None
            if partner is None and self._may_leave_out > 0 and self._has_depth:
                self._may_leave_out -= 1
            else:
                self._may_leave_out = 0
                decided.append((color, partner))
            used_up_us = partner.timestamp_us + 1 if partner else color.timestamp_us - TOLERANCE_US
            while self._depths and self._depths[0].timestamp_us < used_up_us:
                self._depths.popleft()
        return decided

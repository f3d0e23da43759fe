"""Which markers are named, which are proposed, which is next: the logic of the screen without the screen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from carpus.core.calibration.result import ALL_STRAIGHT, Clicks
from carpus.core.hand.protocols import MarkerProtocol
from carpus.core.types import FloatArray, Side
from carpus.ui.ports import ProposedMarker

SAME_DISC_PX = 3.0
"""Nearer than this two places are the same disc."""


@dataclass(slots=True)
class Clicking:
    """Pixels by marker name, in the order they were set; ``current`` is the one to be clicked next.

    ``proposed`` are names the program has put on discs and no person has confirmed. ``chosen``: a person has gone to
    the current one.
    """

    protocol: MarkerProtocol
    side: Side
    pixel: dict[str, FloatArray] = field(default_factory=dict)
    widths_px: dict[str, float] = field(default_factory=dict)
    current: str = ""
    chosen: bool = False
    proposed: dict[str, ProposedMarker] = field(default_factory=dict)
    straight_fingers: tuple[bool, ...] = ALL_STRAIGHT

    def __post_init__(self) -> None:
        self.current = self.protocol.markers[0]

    @property
    def order(self) -> tuple[str, ...]:
        """The order in which the drawing asks for the markers: that of the protocol."""
        return self.protocol.markers

    @property
    def places(self) -> dict[str, FloatArray]:
        """Where each name is, of a person or proposed."""
        return {name: one.pixel for name, one in self.proposed.items()} | self.pixel

    @property
    def missing(self) -> tuple[str, ...]:
        return tuple(name for name in self.order if name not in self.pixel)

    @property
    def complete(self) -> bool:
        return not self.missing

    @property
    def unnamed(self) -> tuple[str, ...]:
        return tuple(name for name in self.missing if name not in self.proposed)

    @property
    def doubtful(self) -> tuple[str, ...]:
        """Proposals that another name would fit nearly as well."""
        return tuple(name for name in self.missing if name in self.proposed and not self.proposed[name].is_sure)

    def propose(self, proposed: Mapping[str, ProposedMarker]) -> None:
        """Take the program's names for what no person has named; they replace earlier ones."""
        self.proposed = {name: proposed[name] for name in self.missing if name in proposed}
        if not (self.chosen and self.current in self.missing):
            self.current = (self.unnamed or self.missing or (self.current,))[0]

    def take_all(self) -> None:
        for name in self.order:
            if name in self.proposed and name not in self.pixel:
                self.pixel[name] = self.proposed[name].pixel
                self.widths_px[name] = self.proposed[name].width_px
        self.proposed.clear()
        self._go_on()

    def confirm(self, name: str) -> None:
        one = self.proposed.pop(name)
        self.pixel[name], self.widths_px[name] = one.pixel, one.width_px
        self._go_on()

    def confirms(self, pixel: FloatArray) -> bool:
        """Whether the current marker is proposed at this very place."""
        mine = self.proposed.get(self.current)
        return mine is not None and _same(mine.pixel, pixel)

    def taken_by(self, pixel: FloatArray) -> str:
        """The name a person has given to this disc, where the current marker has no place it could change for it."""
        if self.current in self.places:
            return ""
        return next((name for name, other in self.pixel.items() if _same(other, pixel)), "")

    def place(self, pixel: FloatArray, width_px: float) -> bool:
        """Set the current marker and go on to the next one that is missing; whether two names changed places.

        A name that was on this disc moves to where the current one was, or is taken off.
        """
        places = self.places
        had_place = places.pop(self.current, None) is not None
        swapped = had_place and any(_same(place, pixel) for place in places.values())
        mine = self.proposed.pop(self.current, None)
        before = self.pixel.pop(self.current, None)
        before_width_px = self.widths_px.get(self.current, width_px)
        for name in [name for name, other in self.pixel.items() if _same(other, pixel)]:
            if before is not None:
                self.pixel[name], self.widths_px[name] = before, before_width_px
            elif mine is not None:
                self.pixel[name], self.widths_px[name] = mine.pixel, mine.width_px
        for name in [name for name, one in self.proposed.items() if _same(one.pixel, pixel)]:
            del self.proposed[name]
            if before is not None:
                self.proposed[name] = ProposedMarker(before, before_width_px, is_sure=True)
            elif mine is not None:
                self.proposed[name] = mine
        self.pixel[self.current] = np.asarray(pixel, dtype=np.float64)
        self.widths_px[self.current] = width_px
        self._go_on()
        return swapped

    def undo(self) -> str:
        """Take back the marker set last; its name, empty when there is none."""
        if not self.pixel:
            return ""
        name, _ = self.pixel.popitem()
        self.current = name
        return name

    def clear(self, names: Sequence[str]) -> None:
        """Take back some markers, to be clicked again; without names all, as on another picture."""
        for name in names:
            self.pixel.pop(name, None)
        if not names:
            self.pixel.clear()
            self.proposed.clear()
            self.current, self.chosen = self.order[0], False
        else:
            self._go_on()

    def step(self, by: int) -> None:
        self.choose(self.order[(self.order.index(self.current) + by) % len(self.order)])

    def choose(self, name: str) -> None:
        """A person goes to a marker; names that are proposed meanwhile lead nowhere else."""
        self.current, self.chosen = name, True

    def near(self, pixel: FloatArray, reach_px: float) -> str:
        """The marker clicked or proposed within reach of a pixel, empty for none."""
        distances = {name: float(np.hypot(*(place - pixel))) for name, place in self.places.items()}
        name = min(distances, key=lambda key: distances[key], default="")
        return name if name and distances[name] <= reach_px else ""

    def clicks(self) -> Clicks:
        return Clicks(
            self.side, self.protocol, np.array([self.pixel[name] for name in self.order]), self.straight_fingers
        )

    def _go_on(self) -> None:
        self.chosen = False
        missing = self.unnamed or self.missing
        if missing:
            after = [name for name in missing if self.order.index(name) > self.order.index(self.current)]
            self.current = (after or list(missing))[0]


def _same(one: FloatArray, other: FloatArray) -> bool:
    return float(np.hypot(*(one - other))) < SAME_DISC_PX

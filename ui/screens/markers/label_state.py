"""Which markers are named, which are proposed, which is next: the logic of the screen without the screen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from carpus.core.calibration.result import ALL_STRAIGHT, Clicks
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import FloatArray, Side
from carpus.ui.shell.view_models import LabelProposal

SAME_MARKER_PX = 3.0
"""Nearer than this two places are the same disc."""


@dataclass(slots=True)
class LabelState:
    """Pixels by marker name, in the order they were set; ``current`` is the one to be clicked next.

    ``proposals`` are names the program has put on discs and no person has confirmed. ``is_chosen``: a person has gone
    to
    the current one.
    """

    protocol: MarkerProtocol
    side: Side
    confirmed_px: dict[str, FloatArray] = field(default_factory=dict)
    widths_px: dict[str, float] = field(default_factory=dict)
    current: str = ""
    is_chosen: bool = False
    proposals: dict[str, LabelProposal] = field(default_factory=dict)
    straight_fingers: tuple[bool, ...] = ALL_STRAIGHT

    def __post_init__(self) -> None:
        self.current = self.protocol.markers[0]

    @property
    def order(self) -> tuple[str, ...]:
        """The order in which the drawing asks for the markers: that of the protocol."""
        return self.protocol.markers

    @property
    def label_px(self) -> dict[str, FloatArray]:
        """Where each name is, of a person or proposed."""
        return {name: one.pixel for name, one in self.proposals.items()} | self.confirmed_px

    @property
    def missing(self) -> tuple[str, ...]:
        return tuple(name for name in self.order if name not in self.confirmed_px)

    @property
    def is_complete(self) -> bool:
        return not self.missing

    @property
    def open_markers(self) -> tuple[str, ...]:
        return tuple(name for name in self.missing if name not in self.proposals)

    @property
    def doubtful(self) -> tuple[str, ...]:
        """Proposals that another name would fit nearly as well."""
        return tuple(name for name in self.missing if name in self.proposals and not self.proposals[name].is_sure)

    def set_proposals(self, proposals: Mapping[str, LabelProposal]) -> None:
        """Take the program's names for what no person has named; they replace earlier ones."""
        self.proposals = {name: proposals[name] for name in self.missing if name in proposals}
        if not (self.is_chosen and self.current in self.missing):
            self.current = (self.open_markers or self.missing or (self.current,))[0]

    def accept_all(self) -> None:
        for name in self.order:
            if name in self.proposals and name not in self.confirmed_px:
                self.confirmed_px[name] = self.proposals[name].pixel
                self.widths_px[name] = self.proposals[name].width_px
        self.proposals.clear()
        self._advance()

    def confirm(self, name: str) -> None:
        one = self.proposals.pop(name)
        self.confirmed_px[name], self.widths_px[name] = one.pixel, one.width_px
        self._advance()

    def is_proposed_at(self, pixel: FloatArray) -> bool:
        """Whether the current marker is proposed at this very place."""
        mine = self.proposals.get(self.current)
        return mine is not None and _is_same_place(mine.pixel, pixel)

    def find_owner(self, pixel: FloatArray) -> str:
        """The name a person has given to this disc, where the current marker has no place it could change for it."""
        if self.current in self.label_px:
            return ""
        return next((name for name, other in self.confirmed_px.items() if _is_same_place(other, pixel)), "")

    def set_label(self, pixel: FloatArray, width_px: float) -> bool:
        """Set the current marker and go on to the next one that is missing; whether two names changed places.

        A name that was on this disc moves to where the current one was, or is taken off.
        """
        places = self.label_px
        had_place = places.pop(self.current, None) is not None
        swapped = had_place and any(_is_same_place(place, pixel) for place in places.values())
        mine = self.proposals.pop(self.current, None)
        before = self.confirmed_px.pop(self.current, None)
        before_width_px = self.widths_px.get(self.current, width_px)
        for name in [name for name, other in self.confirmed_px.items() if _is_same_place(other, pixel)]:
            if before is not None:
                self.confirmed_px[name], self.widths_px[name] = before, before_width_px
            elif mine is not None:
                self.confirmed_px[name], self.widths_px[name] = mine.pixel, mine.width_px
        for name in [name for name, one in self.proposals.items() if _is_same_place(one.pixel, pixel)]:
            del self.proposals[name]
            if before is not None:
                self.proposals[name] = LabelProposal(before, before_width_px, is_sure=True)
            elif mine is not None:
                self.proposals[name] = mine
        self.confirmed_px[self.current] = np.asarray(pixel, dtype=np.float64)
        self.widths_px[self.current] = width_px
        self._advance()
        return swapped

    def undo(self) -> str:
        """Take back the marker set last; its name, empty when there is none."""
        if not self.confirmed_px:
            return ""
        name, _ = self.confirmed_px.popitem()
        self.current = name
        return name

    def clear(self, names: Sequence[str]) -> None:
        """Take back some markers, to be clicked again; without names all, as on another picture."""
        for name in names:
            self.confirmed_px.pop(name, None)
        if not names:
            self.confirmed_px.clear()
            self.proposals.clear()
            self.current, self.is_chosen = self.order[0], False
        else:
            self._advance()

    def step(self, by: int) -> None:
        self.choose(self.order[(self.order.index(self.current) + by) % len(self.order)])

    def choose(self, name: str) -> None:
        """A person goes to a marker; names that are proposed meanwhile lead nowhere else."""
        self.current, self.is_chosen = name, True

    def find_near(self, pixel: FloatArray, reach_px: float) -> str:
        """The marker clicked or proposed within reach of a pixel, empty for none."""
        distances = {name: float(np.hypot(*(place - pixel))) for name, place in self.label_px.items()}
        name = min(distances, key=lambda key: distances[key], default="")
        return name if name and distances[name] <= reach_px else ""

    def clicks(self) -> Clicks:
        return Clicks(
            self.side, self.protocol, np.array([self.confirmed_px[name] for name in self.order]), self.straight_fingers
        )

    def _advance(self) -> None:
        self.is_chosen = False
        missing = self.open_markers or self.missing
        if missing:
            after = [name for name in missing if self.order.index(name) > self.order.index(self.current)]
            self.current = (after or list(missing))[0]


def _is_same_place(one: FloatArray, other: FloatArray) -> bool:
    return float(np.hypot(*(one - other))) < SAME_MARKER_PX

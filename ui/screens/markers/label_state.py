"""State of labelling, without the screen: confirmed, proposed and next markers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from carpus.core.calibration.hand_calibrator import SAME_MARKER_PX, FoundMarker
from carpus.core.calibration.result import ALL_STRAIGHT, Clicks
from carpus.core.model.hand.protocols import MarkerProtocol
from carpus.core.model.types import FloatArray, Side


@dataclass(slots=True)
class LabelState:
    """Labels of one frame.

    Attributes
    ----------
    confirmed_px : dict
        Pixel by marker, in the order they were set.
    current : str
        Marker to be clicked next.
    is_chosen : bool
        True if a person went to the current marker.
    proposals : dict
        Labels proposed by the program and not confirmed.
    """

    protocol: MarkerProtocol
    side: Side
    confirmed_px: dict[str, FloatArray] = field(default_factory=dict)
    widths_px: dict[str, float] = field(default_factory=dict)
    current: str = ""
    is_chosen: bool = False
    proposals: dict[str, FoundMarker] = field(default_factory=dict)
    straight_fingers: tuple[bool, ...] = ALL_STRAIGHT

    def __post_init__(self) -> None:
        self.current = self.protocol.markers[0]

    @property
    def order(self) -> tuple[str, ...]:
        """Order in which the markers are asked for."""
        return self.protocol.markers

    @property
    def label_px(self) -> dict[str, FloatArray]:
        """Pixel of each label, confirmed or proposed."""
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
        """Proposals that another label would fit nearly as well."""
        return tuple(name for name in self.missing if name in self.proposals and not self.proposals[name].is_sure)

    def set_proposals(self, proposals: Mapping[str, FoundMarker]) -> None:
        """Replace the proposals of markers that are not confirmed."""
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
        """Tell whether the current marker is proposed at this pixel."""
        mine = self.proposals.get(self.current)
        return mine is not None and _is_same_place(mine.pixel, pixel)

    def find_owner(self, pixel: FloatArray) -> str:
        """Return the label of a person at this pixel, if the current marker has none to swap; else empty."""
        if self.current in self.label_px:
            return ""
        return next((name for name, other in self.confirmed_px.items() if _is_same_place(other, pixel)), "")

    def set_label(self, pixel: FloatArray, width_px: float) -> bool:
        """Label the current marker and go to the next one; return True if two labels were swapped.

        Another label at this pixel moves to the current marker's former place, or is removed.
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
                self.proposals[name] = FoundMarker(before, before_width_px)
            elif mine is not None:
                self.proposals[name] = mine
        self.confirmed_px[self.current] = np.asarray(pixel, dtype=np.float64)
        self.widths_px[self.current] = width_px
        self._advance()
        return swapped

    def undo(self) -> str:
        """Remove the label set last and return its name; empty if there is none."""
        if not self.confirmed_px:
            return ""
        name, _ = self.confirmed_px.popitem()
        self.current = name
        return name

    def clear(self, names: Sequence[str]) -> None:
        """Remove some labels, or all without ``names``."""
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
        """Go to a marker; later proposals do not change it."""
        self.current, self.is_chosen = name, True

    def find_near(self, pixel: FloatArray, reach_px: float) -> str:
        """Return the marker labelled within reach of a pixel, empty for none."""
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

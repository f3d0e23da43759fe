"""What a person says of blue spots while measuring: this one is that marker, those are no discs."""

from __future__ import annotations

import json
from dataclasses import dataclass

SPOT_SAID = "spot_said"
"""The event of a session in which a person said which blue spot is a marker, or that one is none."""


@dataclass(frozen=True, slots=True)
class SpotAnswer:
    """``marker`` is the spot at ``place_px`` (u, v), None for none of those asked about; the spots at ``not_px`` are
    not it. All as they lie in picture ``index``."""

    index: int
    marker: str
    place_px: tuple[float, float] | None
    not_px: tuple[tuple[float, float], ...] = ()

    def text(self) -> str:
        """For the session's events."""
        told: dict[str, object] = {"marker": self.marker}
        told["at"] = None if self.place_px is None else _rounded(self.place_px)
        told["not"] = [_rounded(place) for place in self.not_px]
        return json.dumps(told, sort_keys=True)

    @staticmethod
    def of_text(text: str, index: int) -> SpotAnswer | None:
        """What the event of a session says of picture ``index``; None where it cannot be read."""
        try:
            told = json.loads(text)
            at = told["at"]
            place = None if at is None else (float(at[0]), float(at[1]))
            return SpotAnswer(index, str(told["marker"]), place, tuple((float(u), float(v)) for u, v in told["not"]))
        except (ValueError, TypeError, KeyError, IndexError):
            return None


def _rounded(place: tuple[float, float]) -> list[float]:
    return [round(place[0], 1), round(place[1], 1)]

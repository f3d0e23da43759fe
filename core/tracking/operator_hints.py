"""Operator hints, a layer over association: what a person said of blue spots while measuring.

A spot that is no disc is left out before blobs are associated; one that is a marker is associated as said. A spot is
followed from picture to picture, so that what was said of it goes on holding while it moves, and for a while after it
went out of sight.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from carpus.core.types import BoolArray, Detections, FloatArray, SpotAnswer

STEP_PX = 8.0
"""No further a spot is followed from picture to picture."""
BACK_WITHIN_PX = 12.0
"""So near to where it was, in the picture or beside its marker, a spot that comes back is the same."""
HOLDS_S = 60.0
"""After that a spot that is no disc is asked about again, if there is still something to ask."""
GONE_AFTER_S = 0.5
"""Where nobody will ask: out of sight for so long, what comes out there later may be a disc."""
KEPT_PICTURES = 60
"""In which a spot that was spoken of is looked for."""
ANSWER_HOLDS_S = 0.5
"""So long an answer waits for a picture that shows its spot."""
SAME_PX = 0.5
"""A blob so near to the spot that was followed is that spot."""


class RecentSpots:
    """The spots of the last pictures: what was said of one, a moment ago, is found in the newest."""

    def __init__(self, step_px: float = STEP_PX) -> None:
        self._step_px = step_px
        self._pictures: deque[tuple[int, FloatArray]] = deque(maxlen=KEPT_PICTURES)

    def keep(self, index: int, pixel: FloatArray) -> None:
        """Remember the spots (D, 2) of a picture."""
        self._pictures.append((index, pixel))

    def now_px(self, index: int, place_px: FloatArray) -> FloatArray | None:
        """Where the spot that lay at ``place_px`` (2,) in picture ``index`` lies in the newest; None when lost."""
        place = np.asarray(place_px, dtype=np.float64)
        for number, pixel in self._pictures:
            if number < index or not len(pixel):
                continue
            away = np.linalg.norm(pixel - place, axis=1)
            if away.min() <= self._step_px:
                place = pixel[int(away.argmin())]
        return place if len(self._pictures) and len(self._pictures[-1][1]) and self._is_seen(place) else None

    def _is_seen(self, place: FloatArray) -> bool:
        return bool(np.linalg.norm(self._pictures[-1][1] - place, axis=1).min() < 1e-6)


class NoDisc:
    """A spot that a person said at ``time_s`` is not a marker, row ``marker`` of the protocol."""

    def __init__(
        self,
        marker: int,
        place_px: FloatArray,
        beside_px: FloatArray,
        time_s: float,
        *,
        is_asked_again: bool,
    ) -> None:
        self.marker = marker
        self._place_px, self._beside_px, self._is_asked_again = place_px, beside_px, is_asked_again
        self._said_s = self._seen_s = time_s
        self._was_seen = True

    def holds(self, time_s: float) -> bool:
        """Whether what was said of it still counts."""
        if self._is_asked_again:
            return time_s - self._said_s <= HOLDS_S
        return time_s - self._seen_s <= GONE_AFTER_S

    def find(self, time_s: float, pixel: FloatArray, expected_px: FloatArray, held: BoolArray) -> int:
        """Which of the spots (D, 2) it is, -1 for none. ``expected_px`` (M, 2) where the markers should be; those
        ``held`` (M,) a moment ago keep the spots that are nearer to them."""
        if self._was_seen:
            self._seen_s = time_s
        if not len(pixel):
            self._was_seen = False
            return -1
        marker_px = expected_px[self.marker]
        guesses = [self._place_px] if self._was_seen else [self._place_px, marker_px + self._beside_px]
        reach_px = STEP_PX if self._was_seen else BACK_WITHIN_PX
        away = np.min([np.linalg.norm(pixel - guess, axis=1) for guess in guesses if np.isfinite(guess).all()], axis=0)
        claims = expected_px[held & np.isfinite(expected_px).all(axis=1)]
        if len(claims):
            claimed = np.linalg.norm(pixel[:, None] - claims[None], axis=-1).min(axis=1)
            away = np.where(claimed < away, math.inf, away)
        best = int(away.argmin())
        self._was_seen = bool(away[best] <= reach_px)
        if not self._was_seen:
            return -1
        self._place_px = pixel[best]
        if np.isfinite(marker_px).all():
            self._beside_px = self._place_px - marker_px
        return best


@dataclass(frozen=True, slots=True)
class NamedSpot:
    """An answer of which the spot is seen: ``blob`` of the picture is the protocol's ``marker``."""

    answer: SpotAnswer
    marker: int
    blob: int


@dataclass(frozen=True, slots=True)
class _Waiting:
    """An answer whose spots were looked for in vain ``since_s``, NaN for not yet."""

    answer: SpotAnswer
    is_asked_again: bool
    since_s: float = math.nan


@dataclass(frozen=True, slots=True)
class Hinted:
    """The blobs of a picture that may be discs, which ``no_disc`` (D,) of all were left out, and the one that a person
    has just named."""

    detections: Detections
    no_disc: BoolArray
    named: NamedSpot | None


class OperatorHints:
    """Remembers what a person said, and finds the spots again in every picture."""

    def __init__(self, markers: Sequence[str]) -> None:
        self._markers = markers
        self._spots = RecentSpots()
        self._answers: list[_Waiting] = []
        self._taken_up: list[SpotAnswer] = []
        self._no_discs: list[NoDisc] = []
        self._held = np.zeros(len(markers), dtype=bool)

    def hear(self, answer: SpotAnswer, *, is_asked_again: bool = True) -> None:
        """Something said of a picture shown a moment ago, from the next picture on; after a while the person is asked
        again, or never."""
        self._answers.append(_Waiting(answer, is_asked_again))

    def taken_up(self) -> list[SpotAnswer]:
        """The answers taken up since the last call, with the spots as they lay in the picture that took them."""
        out, self._taken_up = self._taken_up, []
        return out

    def take_up(self, named: NamedSpot) -> None:
        """The spot was associated as said."""
        self._taken_up.append(named.answer)

    def hold(self, measured_px: FloatArray) -> None:
        """Which markers a picture was measured by, (M, 2) NaN where not: they keep the spots nearer to them."""
        self._held = np.isfinite(measured_px[:, 0])

    def screened(
        self, index: int, timestamp_s: float, detections: Detections, expected_px: Callable[[], FloatArray]
    ) -> Hinted:
        """A picture in the light of what was said; ``expected_px`` (M, 2) where its markers should be, NaN while the
        hand is lost."""
        self._spots.keep(index, detections.pixel)
        heard = self._heard(index, timestamp_s, expected_px)
        no_disc = self._without(timestamp_s, detections.pixel, expected_px)
        left = detections.only(~no_disc) if self._no_discs else detections
        return Hinted(left, no_disc, None if heard is None else self._named(heard, left.pixel))

    def _heard(self, index: int, timestamp_s: float, expected_px: Callable[[], FloatArray]) -> SpotAnswer | None:
        """Take up what is no disc of every answer whose spots are seen, and the first that names one: a picture is
        associated with one name that is new, and the next takes its turn in the next."""
        waiting, self._answers = self._answers, []
        named: SpotAnswer | None = None
        for one in waiting:
            now = self._now(one.answer)
            if now is None:
                since_s = timestamp_s if math.isnan(one.since_s) else one.since_s
                if timestamp_s - since_s < ANSWER_HOLDS_S and one.answer.marker in self._markers:
                    self._answers.append(replace(one, since_s=since_s))
                continue
            now = replace(now, index=index)
            if now.place_px is not None and named is not None:
                self._answers.append(replace(one, answer=replace(now, not_px=()), since_s=math.nan))
                now = replace(now, place_px=None)
            elif now.place_px is not None:
                named = now
            if now.not_px or now.place_px is not None:
                self._add_no_discs(replace(one, answer=now), timestamp_s, expected_px)
        return named

    def _now(self, answer: SpotAnswer) -> SpotAnswer | None:
        """The answer with its spots where they lie in the newest picture; None while the spot it names is not seen."""
        if answer.marker not in self._markers:
            return None

        def now_px(place: tuple[float, float]) -> tuple[float, float] | None:
            found = self._spots.now_px(answer.index, np.array(place))
            return None if found is None else (float(found[0]), float(found[1]))

        place = None if answer.place_px is None else now_px(answer.place_px)
        others = tuple(spot for one in answer.not_px if (spot := now_px(one)) is not None)
        if place is None and (answer.place_px is not None or not others):
            return None
        return replace(answer, place_px=place, not_px=others)

    def _add_no_discs(self, said: _Waiting, time_s: float, expected_px: Callable[[], FloatArray]) -> None:
        answer = said.answer
        marker = self._markers.index(answer.marker)
        for place in answer.not_px:
            place_px = np.array(place)
            beside_px = place_px - expected_px()[marker]
            self._no_discs.append(NoDisc(marker, place_px, beside_px, time_s, is_asked_again=said.is_asked_again))
        self._held[marker] = False
        if answer.place_px is None:
            self._taken_up.append(answer)

    def _without(self, timestamp_s: float, pixel: FloatArray, expected_px: Callable[[], FloatArray]) -> BoolArray:
        """Which spots (D, 2) a person said are none of the markers they were asked about."""
        out = np.zeros(len(pixel), dtype=bool)
        self._no_discs = [one for one in self._no_discs if one.holds(timestamp_s)]
        for one in self._no_discs:
            found = one.find(timestamp_s, pixel, expected_px(), self._held)
            if found >= 0:
                out[found] = True
        return out

    def _named(self, heard: SpotAnswer, pixel: FloatArray) -> NamedSpot | None:
        """The blob (D, 2) that was shown, if it is one of those left."""
        if heard.place_px is None or not len(pixel):
            return None
        away_px = np.linalg.norm(pixel - heard.place_px, axis=1)
        blob = int(away_px.argmin())
        return NamedSpot(heard, self._markers.index(heard.marker), blob) if away_px[blob] <= SAME_PX else None

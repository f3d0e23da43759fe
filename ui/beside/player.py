"""One player for two sessions: a track for each, and where each is at a moment of the player."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout

from carpus.core.hand.exercises import FLEXION, SIDES
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.results.figures import SessionFigures
from carpus.core.results.measure import wrist_column
from carpus.core.results.motion_curves import seen_angle
from carpus.core.results.repetition_rows import ShownRepetition
from carpus.core.results.seen import best_motion
from carpus.core.results.side_by_side import InStep, in_step
from carpus.core.session.values import Session
from carpus.core.types import FloatArray
from carpus.ui import numbers, terms
from carpus.ui.controls.card import Card, KeyCaps
from carpus.ui.controls.layouts import fill, in_grid, in_line
from carpus.ui.controls.text import MEDIUM, REGULAR, Text
from carpus.ui.figures import figure_of, with_side
from carpus.ui.playback.transport import Playing, Scrubber, Transport
from carpus.ui.plot.session import row_at
from carpus.ui.theme import Theme
from carpus.ui.translate import tr


class BesidePlayer(Card):
    """``sought`` carries which of the two was pointed at (0 or 1) and a time in it."""

    sought = Signal(int, float)

    def __init__(self, theme: Theme, playing: Playing) -> None:
        super().__init__(theme, 0)
        self.transport = Transport(theme, playing, 4)
        self._names = (Text(theme, "", 14, REGULAR, "text2"), Text(theme, "", 14, REGULAR, "text2"))
        self.tracks = (Scrubber(theme), Scrubber(theme))
        self._times = (Text(theme, "", 14, MEDIUM), Text(theme, "", 14, MEDIUM))
        self._hints = KeyCaps(theme, [("[ ]", self.tr("repetition"))])
        line = in_line(self.transport, 16, gap=4, margins=(12, 4, 16, 4))
        fill(line, (self._both_tracks(), 1), 12, self._hints)
        self.body.addLayout(line)

    def _both_tracks(self) -> QGridLayout:
        grid = in_grid(12, 0, margins=(0, 0, 0, 0))
        for line, track in enumerate(self.tracks):
            track.setFixedHeight(22)
            track.sought.connect(lambda time_s, line=line: self.sought.emit(line, time_s))
            for column, widget in enumerate((self._names[line], track, self._times[line])):
                grid.addWidget(widget, line, column)
        grid.setColumnStretch(1, 1)
        return grid

    def show_tight(self, tight: bool) -> None:
        self._hints.setVisible(not tight)

    def show_names(self, names: Sequence[str]) -> None:
        for line, name in enumerate(names):
            self._names[line].setText(name)
            self.tracks[line].setAccessibleName(self.tr("Time in the session: {name}").format(name=name))

    def show_places(
        self, times_s: Sequence[float], currents: Sequence[int], ends_s: Sequence[float],
        repetitions: Sequence[Sequence[ShownRepetition]],
    ) -> None:  # fmt: skip
        for line, track in enumerate(self.tracks):
            self._times[line].setText(numbers.clock_tenths(times_s[line]))
            track.show_session(max(ends_s[line], 1e-3), repetitions[line], currents[line])
            track.show_time(times_s[line])


BACK_S = 0.3
"""So soon after a start one goes to the repetition before."""


@dataclass(frozen=True, slots=True)
class Watched:
    """One session that was opened: ``time_s`` (N,) after the first frame, and its trained angle ``value_deg`` (N,)
    where that was seen."""

    session: Session
    figures: SessionFigures
    time_s: FloatArray
    value_deg: FloatArray

    @classmethod
    def of(cls, session: Session, figures: SessionFigures) -> Watched:
        time_s = session.timestamp_s - session.timestamp_s[:1]
        return cls(session, figures, time_s, seen_angle(session, figures.main_angle or WRIST_ANGLES[FLEXION]))


def value_words(watched: Watched, row: int) -> str:
    """``Flexion 37° ± 2°`` where the trained angle was seen."""
    of = watched.figures.main_angle or WRIST_ANGLES[FLEXION]
    value = float(watched.value_deg[row]) if 0 <= row < len(watched.value_deg) else math.nan
    if not math.isfinite(value):
        return tr("not seen")
    angle = wrist_column(of)
    if angle < 0:
        figure = figure_of(of)
        value *= figure.sign  # from the angle in every file to the one that is spoken of
        said = with_side(value, figure.finger) if figure.row == "spread" else numbers.signed_degrees(value)
        return f"{figure.long_name} {said}"
    sd = float(np.degrees(best_motion(watched.session).angles_sd_rad[row, angle]))
    return f"{terms.movement_name(SIDES[angle][0 if value >= 0 else 1])} {numbers.with_spread(value, sd)}"


@dataclass(frozen=True, slots=True)
class Together:
    """Times are the player's unless they are said to be of one of the two."""

    watched: tuple[Watched, Watched]
    step: InStep

    @classmethod
    def of(cls, watched: tuple[Watched, Watched]) -> Together:
        one, other = watched
        return cls(watched, in_step(one.figures.repetitions, other.figures.repetitions, ends_s(watched)))

    @property
    def repetitions(self) -> tuple[tuple[ShownRepetition, ...], tuple[ShownRepetition, ...]]:
        one, other = self.watched
        return one.figures.repetitions, other.figures.repetitions

    def row(self, place: int, time_s: float) -> int:
        return row_at(self.watched[place].time_s, self.step.at(time_s)[place])

    def current(self, place: int, time_s: float) -> int:
        """The repetition that one of the two is in, from 0; -1 between them."""
        own_s = self.step.at(time_s)[place]
        found = enumerate(self.repetitions[place])
        return max((n for n, one in found if one.start_s - 1e-6 <= own_s <= one.end_s + 1e-6), default=-1)

    def next_start(self, time_s: float, by: int) -> float:
        """The start of the next repetition, or of this one or the one before; the same time where there is none."""
        starts = self.step.starts_s or tuple(one.start_s for one in self.repetitions[0])
        if by > 0:
            return next((start for start in starts if start > time_s + 1e-3), time_s)
        return next((start for start in reversed(starts) if start < time_s - BACK_S), starts[0] if starts else time_s)

    def period_s(self) -> float:
        times = self.watched[0].time_s
        return float(np.median(np.diff(times))) if len(times) > 1 else 1.0 / 30.0


def ends_s(watched: tuple[Watched, Watched]) -> tuple[float, float]:
    """How long both are."""
    one, other = (float(of.time_s[-1]) if len(of.time_s) else 0.0 for of in watched)
    return one, other

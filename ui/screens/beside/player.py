"""Playback of two sessions in step, with a track for each."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout

from carpus.core.model.hand.exercises import DIRECTIONS, FLEXION
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.types import FloatArray
from carpus.core.results.measure import wrist_angle_index
from carpus.core.results.motion_curves import visible_angle_deg
from carpus.core.results.repetition_rows import RepetitionResult
from carpus.core.results.session_results import SessionResults
from carpus.core.results.side_by_side import PlaybackTimeline, align_playback
from carpus.core.results.valid_data import motion_estimate
from carpus.core.session.values import Session
from carpus.ui.charts.session import find_nearest_row
from carpus.ui.kit import numbers
from carpus.ui.kit.card import Card, KeyCaps
from carpus.ui.kit.layouts import fill, grid_layout, row_layout
from carpus.ui.kit.text import MEDIUM, REGULAR, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import tr
from carpus.ui.picture.playback_controls import PlaybackClock, PlaybackControls, TimeSlider
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import find_finger_angle, format_spread


class ComparisonPlayer(Card):
    """Tracks of both sessions.

    Signals: ``time_requested`` with the session (0 or 1) and a time in it.
    """

    time_requested = Signal(int, float)

    def __init__(self, theme: Theme, playing: PlaybackClock) -> None:
        super().__init__(theme, 0)
        self.transport = PlaybackControls(theme, playing, 4)
        self._names = (Text(theme, "", 14, REGULAR, "text2"), Text(theme, "", 14, REGULAR, "text2"))
        self.tracks = (TimeSlider(theme), TimeSlider(theme))
        self._times = (Text(theme, "", 14, MEDIUM), Text(theme, "", 14, MEDIUM))
        self._hints = KeyCaps(theme, [("[ ]", self.tr("repetition"))])
        line = row_layout(self.transport, 16, gap=4, margins=(12, 4, 16, 4))
        fill(line, (self._make_tracks(), 1), 12, self._hints)
        self.body.addLayout(line)

    def _make_tracks(self) -> QGridLayout:
        grid = grid_layout(12, 0, margins=(0, 0, 0, 0))
        for line, track in enumerate(self.tracks):
            track.setFixedHeight(22)
            track.time_chosen.connect(lambda time_s, line=line: self.time_requested.emit(line, time_s))
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

    def show_times(
        self, times_s: Sequence[float], currents: Sequence[int], ends_s: Sequence[float],
        repetitions: Sequence[Sequence[RepetitionResult]],
    ) -> None:  # fmt: skip
        for line, track in enumerate(self.tracks):
            self._times[line].setText(numbers.format_clock_tenths(times_s[line]))
            track.show_session(max(ends_s[line], 1e-3), repetitions[line], currents[line])
            track.show_time(times_s[line])


RESTART_WINDOW_S = 0.3
"""This soon after a repetition's start, Back goes to the repetition before."""


@dataclass(frozen=True, slots=True)
class ComparedSession:
    """An open session.

    ``time_s`` (N,) counts from the first frame. ``value_deg`` (N,) is the trained angle, NaN where not visible.
    """

    session: Session
    figures: SessionResults
    time_s: FloatArray
    value_deg: FloatArray

    @classmethod
    def from_figures(cls, session: Session, figures: SessionResults) -> ComparedSession:
        time_s = session.timestamp_s - session.timestamp_s[:1]
        return cls(session, figures, time_s, visible_angle_deg(session, figures.main_angle or WRIST_ANGLES[FLEXION]))


def value_words(watched: ComparedSession, row: int) -> str:
    """Return the trained angle, such as ``Flexion 37° ± 2°``."""
    of = watched.figures.main_angle or WRIST_ANGLES[FLEXION]
    value = float(watched.value_deg[row]) if 0 <= row < len(watched.value_deg) else math.nan
    if not math.isfinite(value):
        return tr("not visible")
    angle = wrist_angle_index(of)
    if angle < 0:
        figure = find_finger_angle(of)
        value *= figure.sign  # from the angle in every file to the one that is spoken of
        text = format_spread(value, figure.finger) if figure.kind == "spread" else numbers.format_signed_degrees(value)
        return f"{figure.long_name} {text}"
    sd = float(np.degrees(motion_estimate(watched.session).angles_sd_rad[row, angle]))
    return f"{terms.movement_name(DIRECTIONS[angle][0 if value >= 0 else 1])} {numbers.format_with_sd(value, sd)}"


@dataclass(frozen=True, slots=True)
class PlaybackAlignment:
    """Common time of both sessions.

    All times are playback times unless named otherwise; ``which`` is the session, 0 or 1.
    """

    sessions: tuple[ComparedSession, ComparedSession]
    step: PlaybackTimeline

    @classmethod
    def from_sessions(cls, sessions: tuple[ComparedSession, ComparedSession]) -> PlaybackAlignment:
        one, other = sessions
        return cls(sessions, align_playback(one.figures.repetitions, other.figures.repetitions, durations_s(sessions)))

    @property
    def repetitions(self) -> tuple[tuple[RepetitionResult, ...], tuple[RepetitionResult, ...]]:
        one, other = self.sessions
        return one.figures.repetitions, other.figures.repetitions

    def frame_row(self, which: int, time_s: float) -> int:
        return find_nearest_row(self.sessions[which].time_s, self.step.recording_times(time_s)[which])

    def current_repetition(self, which: int, time_s: float) -> int:
        """Return the current repetition of a session, from 0; -1 between repetitions."""
        own_s = self.step.recording_times(time_s)[which]
        found = enumerate(self.repetitions[which])
        return max((n for n, one in found if one.start_s - 1e-6 <= own_s <= one.end_s + 1e-6), default=-1)

    def next_start(self, time_s: float, direction: int) -> float:
        """Return the start of the next or previous repetition; the same time if there is none."""
        starts = self.step.starts_s or tuple(one.start_s for one in self.repetitions[0])
        if direction > 0:
            return next((start for start in starts if start > time_s + 1e-3), time_s)
        return next(
            (start for start in reversed(starts) if start < time_s - RESTART_WINDOW_S), starts[0] if starts else time_s
        )

    def frame_period_s(self) -> float:
        times = self.sessions[0].time_s
        return float(np.median(np.diff(times))) if len(times) > 1 else 1.0 / 30.0


def durations_s(sessions: tuple[ComparedSession, ComparedSession]) -> tuple[float, float]:
    """Return the durations of both sessions."""
    one, other = (float(of.time_s[-1]) if len(of.time_s) else 0.0 for of in sessions)
    return one, other

"""Comparison of two sessions: the result, synchronised frames, the differences."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QPainter

from carpus.core.model.hand.exercises import DIRECTIONS, FLEXION
from carpus.core.model.hand.protocols import WRIST_ANGLES
from carpus.core.model.types import ByteImage, FloatArray
from carpus.core.results.measure import Measure, MeasureKey, negate_measure, wrist_angle_index
from carpus.core.results.motion_curves import visible_angle_deg
from carpus.core.results.progress import Comparison, Progress, ProgressPoint
from carpus.core.results.ranges import progress_keys
from carpus.core.results.session_results import SessionResults
from carpus.core.results.side_by_side import PlaybackTimeline, SessionPair, align_playback, compare_pair, order_pair
from carpus.core.results.valid_data import motion_estimate
from carpus.core.session.values import Session
from carpus.ui.charts.series import find_nearest_row
from carpus.ui.kit import numbers
from carpus.ui.kit.background import Background
from carpus.ui.kit.card import Card, KeyCaps
from carpus.ui.kit.icons import State
from carpus.ui.kit.keys import bind_screen_keys
from carpus.ui.kit.layouts import FittedWidget, column_layout, fill, row_layout, scroll_page
from carpus.ui.kit.table import Cell, Table, TableColumn, TableContent, TableRow
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, ElidedText, Icon, Text, caption, heading
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.kit.translate import tr
from carpus.ui.picture.playback_controls import PlaybackClock, PlaybackControls, TimeSlider, clock_words
from carpus.ui.picture.session_frames import SessionFrameView
from carpus.ui.picture.view import HAND_AREA_FACTOR, PALM_AREA_FACTOR, FrameView
from carpus.ui.words import terms
from carpus.ui.words.finger_angles import FINGERS, FingerAngle, find_finger_angle, format_spread
from carpus.ui.words.fingers import is_thumb_exercise, main_kind, progress_choices
from carpus.ui.words.progress import (
    comparison_name,
    difference_words,
    error_limit_words,
    reason_words,
    short_change_words,
    uncertainty_words,
)
from carpus.ui.words.progress import headline as progress_headline
from carpus.ui.words.ranges import LOWER_BOUND, is_deficit, mean_head, mean_words, repetition_words

if TYPE_CHECKING:
    from carpus.core.records.data_folder import DataFolder

# This soon after a repetition's start, Back goes to the repetition before.
RESTART_WINDOW_S = 0.3


class ComparisonFrameView(SessionFrameView):
    """Frame of one session, mirrored if that makes the hands alike."""

    def __init__(self, theme: Theme, background: Background, read: Callable[[str, int], ByteImage | None]) -> None:
        super().__init__(theme, (324, 243), background, read)
        self.is_mirrored = False
        self.overlay = self._paint_overlay

    def open_session(self, session: Session, *, is_mirrored: bool) -> None:
        self.is_mirrored = is_mirrored
        self.set_session(session)
        room = HAND_AREA_FACTOR if session.header.joint_names else PALM_AREA_FACTOR
        self.set_hand_area(self._mirror_pixels(session.calibration.clicks.pixel, session), room)

    def show_frame(self, color_rgb: ByteImage) -> None:
        super().show_frame(np.ascontiguousarray(color_rgb[:, ::-1]) if self.is_mirrored else color_rgb)

    def _mirror_pixels(self, pixel: FloatArray, session: Session) -> FloatArray:
        """Return pixels (..., 2) as shown."""
        out = pixel.copy()
        if self.is_mirrored:
            out[..., 0] = session.camera.width_px - 1.0 - out[..., 0]
        return out

    def _paint_overlay(self, painter: QPainter, _: FrameView) -> None:
        if self.session is not None and 0 <= self.row < len(self.session):
            spots, seen = self.marker_pixels(self.session)
            self.paint_markers(painter, self.session, self._mirror_pixels(spots, self.session), seen)


@dataclass(frozen=True, slots=True)
class ComparedSession:
    """An open session.

    ``time_s`` (N,) counts from the first frame. ``value_deg`` (N,) is the trained angle, NaN where not visible.
    """

    session: Session
    results: SessionResults
    time_s: FloatArray
    value_deg: FloatArray

    @classmethod
    def from_results(cls, session: Session, results: SessionResults) -> ComparedSession:
        joint = results.main_angle or WRIST_ANGLES[FLEXION]
        return cls(session, results, session.timestamp_s - session.timestamp_s[:1], visible_angle_deg(session, joint))

    @property
    def duration_s(self) -> float:
        return float(self.time_s[-1]) if len(self.time_s) else 0.0

    def repetition_number(self, time_s: float) -> int:
        """Return the repetition of a time, from 1; 0 between repetitions."""
        found = enumerate(self.results.repetitions, start=1)
        return max((n for n, one in found if one.start_s - 1e-6 <= time_s <= one.end_s + 1e-6), default=0)


class ComparisonScreen(FittedWidget):
    """Comparison of two sessions.

    Signals: ``fault_raised``, ``sessions_shown``.
    """

    fault_raised = Signal(object)
    sessions_shown = Signal()

    def __init__(self, theme: Theme, background: Background, store: DataFolder) -> None:
        super().__init__()
        self._theme, self._background, self._store = theme, background, store
        self.session_ids: tuple[str, str] = ("", "")
        """The requested sessions; once shown, in the order on the screen."""
        self._affected_side, self._request_number = "", 0
        self.comparison: SessionPair | None = None
        """The sessions on the screen; None while they are read."""
        self.sessions: tuple[ComparedSession, ...] = ()
        self.timeline: PlaybackTimeline | None = None
        self.playing = PlaybackClock(self)
        self.answer = heading(theme, wrap=True)
        self._basis = Text(theme, "", 16, REGULAR, "text2", wrap=True)
        self._warning = Text(theme, "", 14, SEMIBOLD, wrap=True)
        self._strip = Card(theme, 12, "warn_soft", "warn")
        self.frame_views = tuple(ComparisonFrameView(theme, background, store.read_frame) for _ in range(2))
        self.frame_labels = tuple(ElidedText(theme, "", 14, MEDIUM) for _ in range(2))
        self.transport = PlaybackControls(theme, self.playing, 4)
        self.slider, self._time = TimeSlider(theme), Text(theme, "", 14, MEDIUM)
        self._player, self._differences = Card(theme, 0), Card(theme, 20)
        self.table, self._facts = Table(theme, gap=16), caption(theme, wrap=True)
        self._build_layout()
        self._connect()
        theme.changed.connect(self._fit)
        self._show_sections()

    def _build_layout(self) -> None:
        theme = self._theme
        self._strip.body.addLayout(
            row_layout((Icon(theme, "warn"), 0, Qt.AlignmentFlag.AlignVCenter), (self._warning, 1), gap=10)
        )
        line = row_layout(self.transport, 16, (self.slider, 1), 8, self._time, 12, gap=4, margins=(12, 4, 16, 4))
        line.addWidget(KeyCaps(theme, [("[ ]", self.tr("repetition"))]))
        self._player.body.addLayout(line)
        fill(self._differences.body, Text(theme, self.tr("Differences"), 20, SEMIBOLD), self.table, self._facts)
        framed = zip(self.frame_views, self.frame_labels, strict=True)
        pictures = row_layout(*((column_layout((view, 1), label, gap=6), 1) for view, label in framed), gap=12)
        parts = (self.answer, self._basis, self._strip, (pictures, 5), self._player, self._differences)
        column = column_layout(*parts, gap=12, margins=(MARGIN_PX, GAP_PX - 4, MARGIN_PX, GAP_PX))
        column.addStretch(0)
        column_layout(scroll_page(column), margins=(0, 0, 0, 0), parent=self)

    def _fit(self) -> None:
        """Use smaller frames with large text."""
        least = 180 if is_tight(self, self._theme) else 240
        for view in self.frame_views:
            view.setMinimumSize(round(least * 4 / 3), least)

    def _connect(self) -> None:
        for view in self.frame_views:
            view.read_failed.connect(self.fault_raised)
            view.read_failed.connect(self.playing.stop)
        self.playing.time_changed.connect(lambda _: self._show_time())
        self.transport.stepped.connect(self.step_frames)
        self.slider.time_chosen.connect(self.playing.set_time)
        actions = {
            "play": self.playing.toggle,
            "frame_back": lambda: self.step_frames(-1), "frame_on": lambda: self.step_frames(1),
            "repetition_back": lambda: self.jump_to_repetition(-1),
            "repetition_on": lambda: self.jump_to_repetition(1),
        }  # fmt: skip
        bind_screen_keys(self, actions)

    # --- life ---------------------------------------------------------------------------------------------
    def load_sessions(self, session_ids: tuple[str, str], affected_side: str = "") -> None:
        """Read two sessions in the background and show them; ``affected_side`` is the patient's hand."""
        self.playing.open(-1.0)
        self.session_ids, self._affected_side = session_ids, affected_side
        self.comparison, self.timeline, self.sessions = None, None, ()
        self.answer.setText(self.tr("Reading both sessions…"))
        for view in self.frame_views:
            view.set_session(None, self.tr("Reading the session…"))
        self._show_sections()
        self.setFocus(Qt.FocusReason.OtherFocusReason)
        self._request_number += 1
        asked, store = self._request_number, self._store

        def read() -> list[ComparedSession]:
            return [ComparedSession.from_results(store.session(one), store.results_by_id(one)) for one in session_ids]

        def on_failed(fault: Exception) -> None:
            if asked == self._request_number:
                self.answer.setText(self.tr("The sessions cannot be compared, because one of them could not be read."))
                for view in self.frame_views:
                    view.clear()
                self.fault_raised.emit(fault)

        self._background.run(
            read, lambda both: self._show_sessions(both) if asked == self._request_number else None, on_failed, self
        )

    def _show_sessions(self, read: list[ComparedSession]) -> None:
        one, other = read
        first, second = order_pair(one.results, other.results, self._affected_side)  # type: ignore[arg-type]
        self.sessions = (one, other) if first is one.results else (other, one)
        self.session_ids = (first.session_id, second.session_id)
        for view, shown in zip(self.frame_views, self.sessions, strict=True):
            view.open_session(shown.session, is_mirrored=first.side != second.side and shown.results.side == "left")
        durations_s = (self.sessions[0].duration_s, self.sessions[1].duration_s)
        self.timeline = align_playback(first.repetitions, second.repetitions, durations_s)
        self.comparison = compare_pair(first, second, compared_keys(first, second))
        answer, basis = headline(self.comparison)
        self.answer.setText(answer)
        self._basis.setText(basis)
        self._warning.setText(warning_words(self.comparison))
        self.table.show_rows(*difference_table(self.comparison))
        self._facts.setText(facts_words(self.comparison))
        self.playing.end_s = self.timeline.end_s
        self.slider.show_session(self.timeline.end_s, (), -1)
        self.playing.set_time(self.timeline.starts_s[0] if self.timeline.starts_s else 0.0)
        self._show_sections()
        self._fit_soon()
        self.sessions_shown.emit()

    def _show_sections(self) -> None:
        is_ready = self.comparison is not None
        self._player.setEnabled(is_ready)
        self._basis.setVisible(is_ready and bool(self._basis.text()))
        self._strip.setVisible(is_ready and bool(self._warning.text()))
        self._differences.setVisible(self.comparison is not None and bool(self.comparison.ranges))
        self._fit()

    # --- time ---------------------------------------------------------------------------------------------
    def step_frames(self, frames: int) -> None:
        if self.sessions:
            times = self.sessions[0].time_s
            period_s = float(np.median(np.diff(times))) if len(times) > 1 else 1.0 / 30.0
            self.playing.set_time(self.playing.time_s + frames * period_s)

    def jump_to_repetition(self, direction: int) -> None:
        """Go to the next repetition, or to the start of this one, then to the one before."""
        now, starts = self.playing.time_s, () if self.timeline is None else self.timeline.starts_s
        after = [start for start in starts if start > now + 1e-3]
        before = [start for start in starts if start < now - RESTART_WINDOW_S] or list(starts[:1])
        if found := after[:1] if direction > 0 else before[-1:]:
            self.playing.set_time(found[0])

    def _show_time(self) -> None:
        if self.timeline is None:
            return
        time_s = self.playing.time_s
        self._time.setText(clock_words(time_s, self.timeline.end_s))
        self.slider.show_time(time_s)
        for place, (shown, own_s) in enumerate(zip(self.sessions, self.timeline.recording_times(time_s), strict=True)):
            view, other = self.frame_views[place], self.sessions[1 - place]
            view.show_row(find_nearest_row(shown.time_s, own_s))
            joint = shown.results.main_angle or WRIST_ANGLES[FLEXION]
            number = shown.repetition_number(own_s)
            words = [
                picture_words(shown.results, other.results, self._affected_side, is_mirrored=view.is_mirrored),
                self.tr("Repetition {number}").format(number=number) if number else "",
                angle_words(shown.session, joint, shown.value_deg, view.row),
            ]
            self.frame_labels[place].setText(" · ".join(filter(None, words)))


_VALUE = TableColumn(SEMIBOLD, scale=1.14)
# Movement, both sessions, difference.
COLUMNS = (TableColumn(MEDIUM), _VALUE, _VALUE, TableColumn())


def session_name(results: SessionResults, other: SessionResults) -> str:
    """Return what tells a session from the other: hand, day, or both."""
    day = numbers.format_distinct_day(results.when, other.when)
    if results.side == other.side:
        if results.when == other.when and results.exercise.id != other.exercise.id:
            return terms.exercise_name(results.exercise.id)
        return day
    if results.when.date() == other.when.date():
        return terms.side_name(results.side)
    return tr("{side}, {day}").format(side=terms.side_name(results.side), day=day)


def picture_words(results: SessionResults, other: SessionResults, affected: str, *, is_mirrored: bool) -> str:
    """Return the label of a frame, such as ``Left, unaffected · mirrored`` or ``20 Nov``."""
    name = session_name(results, other)
    if results.side != other.side and affected in ("right", "left"):
        pattern = tr("{name}, affected") if results.side == affected else tr("{name}, unaffected")
        name = pattern.format(name=name)
    return tr("{name} · mirrored").format(name=name) if is_mirrored else name


def angle_words(session: Session, joint: str, value_deg: FloatArray, row: int) -> str:
    """Return the trained angle at a row, such as ``Flexion 37° ± 2°``."""
    value = float(value_deg[row]) if 0 <= row < len(value_deg) else math.nan
    if not math.isfinite(value):
        return tr("not visible")
    angle = wrist_angle_index(joint)
    if angle < 0:
        figure = find_finger_angle(joint)
        value *= figure.sign  # from the angle in every file to the one that is spoken of
        text = format_spread(value, figure.finger) if figure.kind == "spread" else numbers.format_signed_degrees(value)
        return f"{figure.long_name} {text}"
    sd = float(np.degrees(motion_estimate(session).angles_sd_rad[row, angle]))
    return f"{terms.movement_name(DIRECTIONS[angle][0 if value >= 0 else 1])} {numbers.format_with_sd(value, sd)}"


def headline(pair: SessionPair) -> tuple[str, str]:
    """Return the result in one sentence, and the values behind it."""
    main = pair.main_comparison
    if not pair.is_comparable:
        return tr("The sessions are shown side by side, but not compared."), ""
    if main is None:
        return tr("Not compared: the two sessions share no movement."), ""
    if pair.relation == "dates":
        return progress_headline(_to_progress(pair))
    if main.verdict == "not_judged":
        why = reason_words(main.reasons) or tr("not measured")
        return tr("Not compared: {why}.").format(why=why), tr("Frames with occluded joints are not analysed.")
    note = tr("The other hand is a comparison, not a norm: left and right differ in healthy people too.")
    if not main.is_beyond_error:
        return tr("No difference beyond measurement error between right and left."), note
    size = _format_bound(main, numbers.format_degrees(main.display_difference_deg))
    pattern = {
        (True, True): tr("{movement}: {size} less on the right than on the left."),
        (True, False): tr("{movement}: {size} more on the right than on the left."),
        (False, True): tr("{movement}: {size} less on the left than on the right."),
        (False, False): tr("{movement}: {size} more on the left than on the right."),
    }[pair.first.side == "right", main.difference_deg < 0.0]
    return pattern.format(movement=comparison_name(main, pair.ranges), size=size), note


def _format_bound(one: Comparison, size: str) -> str:
    """Say of a difference that it is a lower bound, because one of the two was partly occluded."""
    is_bound = one.is_beyond_error and one.lower_bounds[0] != one.lower_bounds[1]
    return tr("at least {size}").format(size=size) if is_bound else size


def warning_words(pair: SessionPair) -> str:
    """Return why the sessions are not comparable, or what was uncertain about them."""
    if not pair.is_comparable:
        words = tr("Not comparable: {why}. Values are shown without an assessment.")
        return words.format(why=reason_words(pair.reasons))
    course = _to_progress(pair)
    return " ".join(words for point in course.points if (words := uncertainty_words(point, course)))


def _to_progress(pair: SessionPair) -> Progress:
    """Return the pair as a progress of two sessions."""
    return Progress((ProgressPoint(pair.second, ()), ProgressPoint(pair.first, ())), pair.ranges, None)


def facts_words(pair: SessionPair) -> str:
    """Return of how many repetitions each value is the mean, and what the measurement error is."""
    first, second = pair.first, pair.second
    counts = [
        tr("{name}: {what}").format(name=session_name(one, other), what=repetition_words(one))
        for one, other in ((first, second), (second, first))
    ]
    return f"{'; '.join(counts)}. {error_limit_words(first.study)}"


def difference_table(pair: SessionPair) -> TableContent:
    """Return the measures that both sessions share."""
    first = mean_head(session_name(pair.first, pair.second), [one.after for one in pair.ranges])
    second = mean_head(session_name(pair.second, pair.first), [one.before for one in pair.ranges])
    difference = Cell(tr("Difference"), MEDIUM, "text2", state="none")  # as far in as the words below it
    heads = (tr("Movement"), first, second, difference)
    return TableContent(COLUMNS, heads, tuple(_make_row(one, pair) for one in pair.ranges))


def _make_row(one: Comparison, pair: SessionPair) -> TableRow:
    look = (SEMIBOLD, "text") if one.is_beyond_error else (REGULAR, "text2")
    state: State = "none"
    if one.verdict != "not_judged":
        words = _format_bound(one, short_change_words(one.verdict, one.display_difference_deg, one.limit_deg))
        beyond: State = "warn" if pair.relation == "hands" else "good" if one.verdict == "improved" else "bad"
        state = beyond if one.is_beyond_error else "open"
    elif pair.is_comparable:
        words = tr("not compared: {why}").format(why=reason_words(one.reasons) or tr("not measured"))
    else:  # the strip says why
        known = math.isfinite(one.difference_deg) and not any(one.lower_bounds)
        words = difference_words(one.display_difference_deg) if known else numbers.UNKNOWN
    name = comparison_name(one, pair.ranges)
    return name, _value_words(one.after), _value_words(one.before), Cell(words, *look, state=state)


def _value_words(row: Measure) -> str:
    """Return ``57° ± 2°``, ``≥ 57°`` if partly occluded, ``5° deficit`` if an end was not reached."""
    if not row.count:
        return tr("not visible")
    if row.is_lower_bound and row.wrist_angle < 0:
        return f"{LOWER_BOUND}{numbers.NARROW_GAP}{numbers.format_degrees(row.mean)}"
    return terms.deficit_words(mean_words(negate_measure(row))) if is_deficit(row) else mean_words(row)


def compared_keys(first: SessionResults, second: SessionResults) -> tuple[MeasureKey, ...]:
    """Return the measures of a whole hand that its exercise trains; none for the wrist."""
    if not (first.joint_ranges and second.joint_ranges):
        return ()
    if main_kind(first) == "middle" and not is_thumb_exercise(first):  # no finger stands for the others
        return tuple((FingerAngle(finger, "middle").joint, "arc") for finger in FINGERS[1:])
    return progress_keys(progress_choices(first)[0][0])

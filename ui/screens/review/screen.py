"""Review screen: frames and curves in step, repetitions to correct, results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QLineEdit, QWidget

from carpus.core.model.types import TrackStatus
from carpus.core.results.repetition_rows import PASSIVE, RepetitionChoices, RepetitionResult
from carpus.core.results.session_results import SessionResults
from carpus.ui.charts.series import find_nearest_row
from carpus.ui.charts.session import HandPlot, SessionChart, SessionPlot
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card, KeyCaps
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.field import ChoiceRow
from carpus.ui.kit.keys import bind_screen_keys
from carpus.ui.kit.layouts import STRETCH, FittedWidget, column_layout, fill, row_layout, scroll_page
from carpus.ui.kit.text import MEDIUM, Text
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.picture.playback_controls import PlaybackClock, PlaybackControls, TimeSlider, clock_words
from carpus.ui.screens.review.card import ReviewCard
from carpus.ui.screens.review.frame_view import HandImage, HandImageDialog, ReviewFrameView, build_hand_image
from carpus.ui.screens.review.reviewed_session import ReviewedSession
from carpus.ui.screens.tour.bubble import MIN_SCREEN_PX, BubbleView
from carpus.ui.words.finger_angles import FINGERS, find_finger_angle
from carpus.ui.words.terms import finger_name

if TYPE_CHECKING:
    from carpus.core.records.data_folder import DataFolder

# Instead of a finger's number: the three wrist angles.
WRIST = -1
EDGE_STEP_S = 0.1


class ReviewScreen(FittedWidget):
    """Review of one session; the flow connects the buttons of its card.

    ``correction_requested`` carries session id, session and row.
    """

    correction_requested = Signal(str, object, int)
    hand_image_requested = Signal(HandImage)
    fault_raised = Signal(object)
    session_shown = Signal()

    def __init__(self, theme: Theme, background: Background, store: DataFolder) -> None:
        super().__init__()
        self._theme, self._background, self._store = theme, background, store
        self.session_id = ""
        self._whole_hand = self._tight = False
        self.reviewed: ReviewedSession | None = None
        self._earlier_choices: list[RepetitionChoices] = []  # of the session shown, the last one last
        # Current repetition from 0, -1 for none.
        self.current = -1
        self.playing = PlaybackClock(self)
        self.frame_view = ReviewFrameView(theme, background, store.read_frame)
        self.charts = ReviewCharts(theme)
        self.player = Player(theme, self.playing)
        self.card = ReviewCard(theme)
        self.bubble = BubbleView(theme, wide=True)
        self.exclusion_dialog = ExclusionDialog(self, theme)
        self.hand_image_dialog = HandImageDialog(self, theme)
        self._column = column_layout(
            (row_layout((self.frame_view, 480), (self.charts, 736), gap=GAP_PX), 1),
            self.player,
            self.bubble,
            self.card,
            gap=12,
            margins=(MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX),
        )
        self._page = scroll_page(self._column)
        column_layout(self._page, margins=(0, 0, 0, 0), parent=self)
        self._connect()
        self._bind()
        theme.changed.connect(self._fit)
        theme.changed.connect(self._fit_soon)

    def _fit(self) -> None:
        self.bubble.set_room(self.height() >= MIN_SCREEN_PX * self._theme.text_scale)
        tight = is_tight(self, self._theme)
        if tight != self._tight:  # once more, and not with every size: what is fitted again may come out otherwise
            self._tight = tight
            self._fit_soon()
        if self.charts.fit(self.reviewed, above=self._column if tight else None):
            self._refresh()
        else:
            self.card.fit(self._column, self.height(), tight=tight, whole_hand=self._whole_hand)

    def _connect(self) -> None:
        curves = self.charts.curves
        self.playing.time_changed.connect(self._show_time)
        self.frame_view.read_failed.connect(self.fault_raised)
        self.frame_view.correct_button.clicked.connect(self.correct_here)
        self.frame_view.save_button.clicked.connect(self.open_hand_image_dialog)
        curves.cursor_moved.connect(self.playing.set_time)
        curves.edges_moved.connect(lambda *edges: self._apply_choices(lambda one: one.set_edges(*edges)))
        curves.menu.fault_raised.connect(self.fault_raised)
        self.charts.finger.chosen.connect(lambda _: self._refresh())
        self.player.transport.stepped.connect(self.step)
        self.player.repetition_button.clicked.connect(self.toggle_excluded)
        self.exclusion_dialog.reason_chosen.connect(self._exclude_repetition)
        self.hand_image_dialog.accepted.connect(self._request_hand_image)
        self.card.include_button.clicked.connect(self.toggle_included)

    def _bind(self) -> None:
        curves, card = self.charts.curves, self.card
        actions: dict[str, Callable[[], object]] = {
            "play": self.playing.toggle, "frame_back": lambda: self.step(-1), "frame_on": lambda: self.step(1),
            "repetition_back": lambda: self.select_repetition(self.current - 1),
            "repetition_on": lambda: self.select_repetition(self.current + 1),
            "leave_out": self.toggle_excluded,
            "edge_back": lambda: self.nudge_edge(-EDGE_STEP_S), "edge_on": lambda: self.nudge_edge(EDGE_STEP_S),
            "review_undo": self.undo_choice,
            "report": card.report_button.click, "export": card.export_button.click, "plot_in": curves.zoom_in,
            "plot_out": curves.zoom_out, "plot_all": curves.show_all, "correct": self.correct_here,
            "comparison": card.compare_button.click, "angle": self.frame_view.angle_button.click,
            "hand_picture": self.open_hand_image_dialog,
        }  # fmt: skip
        bind_screen_keys(self, actions)

    # --- life ---------------------------------------------------------------------------------------------
    def load_session(
        self, patient_id: str, session_id: str, *, may_repeat: bool = False, whole_hand: bool | None = None
    ) -> None:
        """Read a session in the background, then show it; ``whole_hand``, if known, fixes the layout at once."""
        self.session_id, self.reviewed = session_id, None
        self._earlier_choices.clear()
        for sheet in (self.exclusion_dialog, self.hand_image_dialog):
            sheet.close_dialog()  # what they ask about was of the session before
        self.playing.open(-1.0)
        self.charts.curves.clear()
        self.player.show_nothing()
        self.card.show_reading(on=True)
        self._page.verticalScrollBar().setValue(0)
        if whole_hand is not None:
            self._whole_hand = whole_hand
            self.charts.finger.setVisible(whole_hand)
            self.card.tables.show_layout(whole_hand=whole_hand)
            self._fit()
        self.card.repeat_button.setVisible(may_repeat)
        self.frame_view.set_session(None, self.tr("Reading the session…"))
        store = self._store

        def report_failure(fault: Exception) -> None:
            if session_id == self.session_id:
                self.frame_view.set_session(
                    None, self.tr("This session cannot be read. Go back, or choose another one.")
                )
            self.fault_raised.emit(fault)

        self._background.run(
            lambda: ReviewedSession.load(store, patient_id, session_id), self._show, report_failure, self
        )
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    @property
    def is_loaded(self) -> bool:
        return self.reviewed is not None

    @property
    def results(self) -> SessionResults | None:
        return None if self.reviewed is None else self.reviewed.results

    def _show(self, reviewed: ReviewedSession) -> None:
        if reviewed.id != self.session_id:
            return  # another one was asked for meanwhile
        self.reviewed, self._whole_hand = reviewed, reviewed.is_hand
        self.playing.open(float(reviewed.curves.time_s[-1]) if len(reviewed.curves.time_s) else -1.0)
        self.charts.finger.setVisible(reviewed.is_hand)
        self.card.tables.show_layout(whole_hand=reviewed.is_hand)
        self.frame_view.show_session(reviewed.session)
        self.card.tables.versions.show_versions(reviewed.versions, self.session_id)
        all_of_them = reviewed.results.repetitions
        count = (n for n, repetition in enumerate(all_of_them) if repetition.is_counted)
        self.current = next(count, 0 if all_of_them else -1)  # also where all are passive
        self._refresh()
        self.charts.curves.show_repetitions()
        self.playing.set_time(all_of_them[self.current].start_s if all_of_them else 0.0)
        self.session_shown.emit()

    def _refresh(self) -> None:
        reviewed = self.reviewed
        if reviewed is None:
            return
        plot = self.charts.show_plot(reviewed, self.current)
        self.player.show_session(plot.end_s, reviewed.results.repetitions, self.current)
        self.frame_view.show_repetition(reviewed, self.current, max(self.charts.finger_number, 0))
        self.card.show_session(reviewed)
        self._fit()

    # --- time ---------------------------------------------------------------------------------------------
    def _show_time(self, time_s: float) -> None:
        """Show a time; the repetition under the cursor becomes the current one."""
        if self.reviewed is None:
            return
        under = self.reviewed.find_repetitions(time_s)
        if under and self.current not in under:
            self.current = under[0]
            self._refresh()
        self.charts.curves.set_time(time_s)
        self.frame_view.show_time(time_s, find_nearest_row(self.reviewed.curves.time_s, time_s))

    def step(self, frames: int) -> None:
        if self.reviewed is not None and len(times := self.reviewed.curves.time_s):
            row = find_nearest_row(times, self.playing.time_s) + frames
            self.playing.set_time(float(times[np.clip(row, 0, len(times) - 1)]))

    def select_repetition(self, number: int) -> None:
        if self.reviewed is not None and 0 <= number < len(self.reviewed.results.repetitions):
            self.current = number
            self._refresh()
            self.playing.set_time(self.reviewed.results.repetitions[number].start_s)

    def correct_here(self) -> None:
        if self.reviewed is not None and self.frame_view.row >= 0:
            self.playing.stop()
            self.correction_requested.emit(self.session_id, self.reviewed.session, self.frame_view.row)

    # --- picture of the hand ------------------------------------------------------------------------------
    def open_hand_image_dialog(self) -> None:
        """Ask for consent to save the frame as an image, if frames were stored."""
        reviewed = self.reviewed
        if reviewed is None or self.frame_view.save_button.isHidden():
            return
        self.playing.stop()
        status = reviewed.curves.status[self.frame_view.row]
        self.hand_image_dialog.open_form(refused=status in (TrackStatus.LOST, TrackStatus.DOUBTFUL))

    def _request_hand_image(self) -> None:
        if self.reviewed is not None:
            self.hand_image_requested.emit(build_hand_image(self.reviewed, self.frame_view.row, self.playing.time_s))

    # --- corrections --------------------------------------------------------------------------------------
    def toggle_excluded(self) -> None:
        """Ask how to exclude the current repetition, or include it again."""
        if self.reviewed is None or self.current < 0:
            return
        if self.reviewed.results.repetitions[self.current].exclusion_reason:
            self._apply_choices(lambda one: one.include_repetition(self.current))
        else:
            self.playing.stop()  # what is asked about stays the current one
            self.exclusion_dialog.open_form(self.current + 1)

    def _exclude_repetition(self, number: int, reason: str, and_after: bool) -> None:
        self._apply_choices(lambda one: one.exclude_repetition(number - 1, reason, and_after=and_after))

    def nudge_edge(self, by_s: float) -> None:
        """Move the edge of the current repetition that is nearer to the cursor."""
        if self.current >= 0:
            self._apply_choices(lambda one: one.nudge_edge(self.current, self.playing.time_s, by_s))

    def toggle_included(self) -> None:
        if self.reviewed is not None:
            self._apply_choices(
                lambda one: replace(one.choices, is_session_excluded=not one.choices.is_session_excluded)
            )
            self.session_shown.emit()

    def _apply_choices(self, choices_of: Callable[[ReviewedSession], RepetitionChoices]) -> None:
        if self.reviewed is None:
            return
        self._earlier_choices.append(self.reviewed.choices)
        self._save_choices(choices_of(self.reviewed))

    def undo_choice(self) -> None:
        """Take back the last exclusion or moved edge since the session was opened."""
        if self._earlier_choices:
            self._save_choices(self._earlier_choices.pop())
            self.session_shown.emit()

    def _save_choices(self, choices: RepetitionChoices) -> None:
        if self.reviewed is None:
            return
        self.reviewed = self.reviewed.apply_choices(choices)
        self._refresh()
        store, session_id = self._store, self.session_id
        self._background.run(
            lambda: store.save_choices(session_id, choices), lambda _: None, self.fault_raised.emit, self
        )


class ReviewCharts(QWidget):
    """Curves of the wrist, or of one or all fingers."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        fingers: list[tuple[object, str]] = [(0, self.tr("All fingers"))]
        fingers += [(finger, finger_name(str(finger))) for finger in FINGERS]
        self.finger = ChoiceRow(theme, [*fingers, (WRIST, self.tr("Wrist"))])
        self.finger.hide()  # until a session of the whole hand is shown
        for button in self.finger.buttons():
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click must leave Space and the arrows to the player
        self.curves = SessionChart(theme)
        self._column = column_layout(self.finger, gap=8, margins=(0, 0, 0, 0), parent=self)
        fill(self._column, (self.curves, 1))

    @property
    def finger_number(self) -> int:
        """Chosen finger, 0 for all, :data:`WRIST` for the wrist."""
        value = self.finger.value()
        return value if isinstance(value, int) else 0

    def fit(self, reviewed: ReviewedSession | None, *, above: QBoxLayout | None) -> bool:
        """Show fewer panels for large text; return True if another finger had to be chosen."""
        tight, place = above is not None, above or self._column
        self.curves.show_single(tight)
        if place.indexOf(self.finger) < 0:
            place.insertWidget(0, self.finger)
        self.finger.buttons()[0].setVisible(not tight)
        if tight and reviewed is not None and reviewed.is_hand and self.finger_number == 0:
            self.finger.choose(find_finger_angle(reviewed.results.exercise.joint).finger)  # five panels have no room
            return True
        return False

    def show_plot(self, reviewed: ReviewedSession, current: int) -> SessionPlot:
        """Show the angles of the wrist or of the chosen finger."""
        shown = (reviewed.curves, reviewed.results.exercise, reviewed.results.repetitions, current)
        plot: SessionPlot
        if reviewed.joints is not None and self.finger_number != WRIST:
            plot = HandPlot(*shown, joints=reviewed.joints, finger=self.finger_number)
        else:
            plot = SessionPlot(*shown, *reviewed.results.targets_deg)
        self.curves.show_plot(plot)
        return plot


class Player(Card):
    """Buttons and time slider below frame and curves."""

    def __init__(self, theme: Theme, playing: PlaybackClock) -> None:
        super().__init__(theme, 0)
        self._end_s = 1.0
        self.transport = PlaybackControls(theme, playing)
        self.repetition_button = Button(theme, self.tr("Repetition…"), "quiet", hint="X", height_px=40)
        self.repetition_button.setToolTip(
            self.tr("Mark as passive or excluded (X). [ and ] select another repetition.")
        )
        self.repetition_button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.time = Text(theme, "", 14, MEDIUM)
        self.scrubber = TimeSlider(theme)
        row = row_layout(self.transport, 8, KeyCaps(theme, [(self.tr("Space"), self.tr("play"))]), gap=4)
        fill(row, self.repetition_button, STRETCH, self.time, 8, (self.scrubber, 6), 8)
        row.addWidget(KeyCaps(theme, [("← →", self.tr("frame"))]))
        row.setContentsMargins(12, 7, 16, 7)
        self.body.addLayout(row)
        self.scrubber.time_chosen.connect(playing.set_time)
        playing.time_changed.connect(self._show_time)

    def show_session(self, end_s: float, repetitions: Sequence[RepetitionResult], current: int) -> None:
        self._end_s = end_s
        self.scrubber.show_session(end_s, repetitions, current)

    def show_nothing(self) -> None:
        self.show_session(0.0, (), -1)
        self._show_time(0.0)

    def _show_time(self, time_s: float) -> None:
        self.time.setText(clock_words(time_s, self._end_s))
        self.scrubber.show_time(time_s)


class ExclusionDialog(Dialog):
    """Emits ``reason_chosen`` with the repetition (from 1), the reason, and whether it applies to all later ones."""

    reason_chosen = Signal(int, str, bool)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        self._number = 0
        self.add_heading(
            words=self.tr("Passive (moved by the therapist): analysed separately from active repetitions.")
        )
        body = self.card.body
        self.passive_button = Button(theme, self.tr("Passive"), "plain", height_px=40)
        self.passive_button.clicked.connect(lambda: self._accept(PASSIVE))
        self.passive_onwards_button = Button(theme, self.tr("Passive from here on"), "plain", height_px=40)
        self.passive_onwards_button.clicked.connect(lambda: self._accept(PASSIVE, and_after=True))
        body.addLayout(row_layout(self.passive_button, self.passive_onwards_button, STRETCH))
        words = self.tr("Excluded from the results, but still shown on the curves and mentioned in the report.")
        body.addWidget(Text(theme, words, 14, token="text2", wrap=True))
        quick = QHBoxLayout()
        self.reason_buttons: list[Button] = []
        for reason in (self.tr("pain"), self.tr("other movement"), self.tr("practice run")):
            button = Button(theme, reason, "plain", height_px=40)
            button.clicked.connect(lambda _=False, reason=reason: self._accept(reason))
            quick.addWidget(button)
            self.reason_buttons.append(button)
        quick.addStretch(1)
        body.addLayout(quick)
        self.reason_field = QLineEdit(placeholderText=self.tr("Another reason"))
        self.reason_field.setAccessibleName(self.tr("Another reason"))
        self.reason_field.textChanged.connect(self._update_default)
        self._accept_button = Button(theme, self.tr("Exclude"), "plain")
        self._accept_button.clicked.connect(lambda: self._accept(self.reason_field.text().strip()))
        self._cancel_button = Button(theme, self.tr("Keep included"), "plain")
        self._cancel_button.clicked.connect(self.close_dialog)
        body.addLayout(row_layout((self.reason_field, 1), self._accept_button, self._cancel_button))

    def open_form(self, number: int) -> None:
        self._number = number
        self.title.setText(self.tr("Is repetition {number} passive or excluded?").format(number=number))
        self.reason_field.clear()
        self._update_default("")
        self.open()

    def _update_default(self, text: str) -> None:
        """Make Enter exclude only after a reason was typed."""
        self._accept_button.setEnabled(bool(text.strip()))
        self.set_default(self._accept_button if text.strip() else self._cancel_button)

    def _accept(self, reason: str, *, and_after: bool = False) -> None:
        if reason:
            self.close_dialog()
            self.reason_chosen.emit(self._number, reason, and_after)

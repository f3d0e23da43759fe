"""Correction of a wrong or missing marker in any frame, and re-analysis from there."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QPushButton, QSizePolicy, QWidget

from carpus.core.model.rounding import format_rounded
from carpus.core.model.types import ByteImage, FloatArray, TrackStatus
from carpus.core.results.session_results import compute_session_results
from carpus.core.session.values import Session
from carpus.ui.kit import numbers
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import ENTER_KEY, Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.keys import KEYS, bind_screen_keys
from carpus.ui.kit.layouts import STRETCH, FittedWidget, clear_layout, column_layout, fill, row_layout, scroll_column
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, ElidedText, Icon, StateText, Text
from carpus.ui.kit.theme import GAP_PX, MARGIN_PX, Theme, is_tight
from carpus.ui.picture.playback_controls import PlaybackControls, TimeSlider, clock_words
from carpus.ui.picture.session_frames import RowReader, blank_frame
from carpus.ui.screens.correct.frame_view import CorrectionFrameView, MarkerEdits
from carpus.ui.words.terms import marker_title

if TYPE_CHECKING:
    from carpus.core.records.corrections import Corrections

ARROWS = {
    Qt.Key.Key_Left: (-1.0, 0.0), Qt.Key.Key_Right: (1.0, 0.0), Qt.Key.Key_Up: (0.0, -1.0), Qt.Key.Key_Down: (0.0, 1.0),
}  # fmt: skip
BIG_STEP_PX = 10.0
LARGE_RESIDUAL_MM = 8.0
"""A marker farther than this from its expected position is flagged."""


class CorrectionScreen(FittedWidget):
    """Correction of marker labels.

    Signals: ``reanalysis_requested`` with session and corrections, ``back_requested``, ``fault_raised``.
    """

    reanalysis_requested = Signal(str, object)
    back_requested = Signal()
    fault_raised = Signal(object)

    def __init__(self, theme: Theme, background: Background, store: Corrections) -> None:
        super().__init__()
        self._theme = theme
        self._session_id = ""
        self._session: Session | None = None
        self.edits: MarkerEdits | None = None
        self._time_s = np.empty(0)
        self.row = 0
        self._blob_px: FloatArray = np.empty((0, 2))
        self.current_marker = ""
        self.frame_view = CorrectionFrameView(theme)
        self.reader = RowReader(background, self, store.read_frame, self._on_frame_read, self.fault_raised.emit)
        self.transport = PlaybackControls(theme)
        self.time_text = Text(theme, "", 14, MEDIUM)
        self.scrubber = TimeSlider(theme)
        self.state = StateText(theme)
        self.title = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.hint = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.rows: dict[str, MarkerRow] = {}
        self._rows = column_layout(gap=0)
        self.next_doubtful_button = Button(
            theme, self.tr("Next uncertain frame"), "quiet", hint=KEYS["correct_doubtful"], height_px=36
        )
        self.hide_button = Button(theme, self.tr("Not visible here"), "quiet", hint=KEYS["correct_hide"], height_px=36)
        self.primary_button = Button(theme, self.tr("Re-analyse from here"), "primary", hint=ENTER_KEY)
        self.cancel_button = Button(theme, self.tr("Cancel"), height_px=52)
        self.cancel_button.setToolTip(self.tr("Back to the review (Esc)"))
        self._build_layout()
        self._connect()

    def _build_layout(self) -> None:
        left = column_layout((self.frame_view, 452), gap=8)
        player = Card(self._theme, 0)
        line = row_layout(
            self.transport, 32, STRETCH, self.time_text, 8, (self.scrubber, 6), 8, gap=4, margins=(12, 7, 16, 7)
        )
        player.body.addLayout(line)
        left.addWidget(player)
        right = column_layout(self.state, self.title, self.hint, gap=8, margins=(0, 0, 0, 0))
        card = Card(self._theme, 16)
        card.body.addWidget(Text(self._theme, self.tr("Distance to the expected position"), 14, SEMIBOLD))
        column = column_layout(self._rows, STRETCH)
        card.body.addWidget(scroll_column(column), 1)
        fill(right, (card, 1), row_layout(self.hide_button, STRETCH), self.next_doubtful_button)
        right.addLayout(row_layout((self.primary_button, 1), self.cancel_button, gap=12))
        self._column = QWidget()
        self._column.setLayout(right)
        row_layout((left, 1), self._column, gap=MARGIN_PX, margins=(MARGIN_PX, GAP_PX, MARGIN_PX, GAP_PX), parent=self)
        self._theme.changed.connect(self._fit)
        self._fit()

    def _fit(self) -> None:
        tight = is_tight(self, self._theme)
        self._column.setFixedWidth(self._theme.px(376))
        self.next_doubtful_button.setVisible(bool(self._find_doubtful_rows().size))
        self.primary_button.set_label(self.primary_button.text(), hint="" if tight else ENTER_KEY)

    def _connect(self) -> None:
        self.frame_view.marker_moved.connect(self.place_marker)
        self.frame_view.marker_selected.connect(self.select_marker)
        self.frame_view.empty_clicked.connect(self._place_current)
        self.scrubber.time_chosen.connect(self._show_time)
        self.transport.stepped.connect(self.step_frames)
        self.primary_button.clicked.connect(self._request_reanalysis)
        self.cancel_button.clicked.connect(self.cancel_or_return)
        self.hide_button.clicked.connect(self.hide_current)
        self.next_doubtful_button.clicked.connect(self.show_next_doubtful)
        for button in (self.hide_button, self.next_doubtful_button):
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        actions = {
            "correct_back": lambda: self.step_frames(-1), "correct_on": lambda: self.step_frames(1),
            "correct_hide": self.hide_current, "correct_undo": self.undo, "correct_doubtful": self.show_next_doubtful,
        }  # fmt: skip
        bind_screen_keys(self, actions)

    # --- life ---------------------------------------------------------------------------------------------
    def show_session(self, session_id: str, session: Session, row: int) -> None:
        self._session_id, self._session = session_id, session
        self.edits = MarkerEdits(session)
        self._time_s = session.timestamp_s - session.timestamp_s[:1]
        self.current_marker = ""
        clear_layout(self._rows)
        self.rows = {}
        for name in self.edits.markers:
            line = MarkerRow(self._theme, marker_title(name))
            line.clicked.connect(lambda _=False, name=name: self.select_marker(name))
            line.nudged.connect(self._nudge_marker)
            self.rows[name] = line
            self._rows.addWidget(line)
        self.frame_view.clear(self.tr("Reading the frame…"))
        self.frame_view.set_hand_area(session.calibration.clicks.pixel)
        self.row = -1
        self.scrubber.show_session(float(self._time_s[-1]), compute_session_results(session).repetitions, -1)
        self.reader.set_session(session_id)
        self.show_row(row)
        self._fit()
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def _find_doubtful_rows(self) -> np.ndarray:
        if self._session is None:
            return np.empty(0, dtype=int)
        doubted = self._session.markers.doubted.any(axis=1) | (self._session.status == TrackStatus.DOUBTFUL)
        return np.flatnonzero(doubted)

    # --- time ---------------------------------------------------------------------------------------------

    def show_row(self, row: int) -> None:
        if self._session is None:
            return
        row = int(np.clip(row, 0, len(self._session) - 1))
        if row != self.row:
            self.row = row
            self._blob_px = np.empty((0, 2))
            self.time_text.setText(clock_words(float(self._time_s[row]), float(self._time_s[-1])))
            self.scrubber.show_time(float(self._time_s[row]))
            self.reader.request(row)
        self._refresh()

    def step_frames(self, frames: int) -> None:
        self.show_row(self.row + frames)

    def _show_time(self, time_s: float) -> None:
        if self._session is not None:
            self.show_row(int(np.clip(np.searchsorted(self._time_s, time_s), 0, len(self._time_s) - 1)))

    def show_next_doubtful(self) -> None:
        """Show the next uncertain frame after the current run of them."""
        rows = self._find_doubtful_rows()
        if not rows.size:
            return
        begins = rows[np.flatnonzero(np.diff(rows, prepend=-9) > 1)]
        after = begins[begins > self.row]
        self.show_row(int(after[0] if after.size else begins[0]))

    def _on_frame_read(self, row: int, moment: tuple[ByteImage | None, FloatArray]) -> None:
        if row != self.row or self._session is None or self.edits is None:
            return  # the one that is shown follows
        picture_rgb, self._blob_px = moment
        self.frame_view.show_frame(blank_frame(self._session.camera) if picture_rgb is None else picture_rgb)
        self.frame_view.show_edits(self.edits, row, self._blob_px, has_frame=picture_rgb is not None)
        self._refresh()

    # --- what a person says -------------------------------------------------------------------------------
    def select_marker(self, name: str) -> None:
        self.current_marker = name
        self._refresh()

    def place_marker(self, name: str, pixel: FloatArray) -> None:
        if self.edits is not None:
            self.edits.place_marker(self.row, name, pixel, self._blob_px)
            self.select_marker(name)

    def _place_current(self, pixel: FloatArray) -> None:
        """Move the selected marker to the clicked pixel."""
        if self.current_marker:
            self.place_marker(self.current_marker, pixel)

    def _nudge_marker(self, key: int, big: bool) -> None:
        """Move the selected marker by an arrow key, from its own or the model's position."""
        if self.edits is None or not self.current_marker:
            return
        number = self.edits.markers.index(self.current_marker)
        start = self.edits.current_px(self.row)[number]
        if not np.isfinite(start).all():
            start = self.edits.model_px(self.row)[number]
        if np.isfinite(start).all():
            step = (BIG_STEP_PX if big else 1.0) * np.array(ARROWS[Qt.Key(key)])
            self.edits.place_marker(self.row, self.current_marker, start + step, np.empty((0, 2)))
            self._refresh()

    def hide_current(self) -> None:
        if self.edits is not None and self.current_marker:
            self.edits.hide_marker(self.row, self.current_marker)
            self._refresh()

    def undo(self) -> None:
        if self.edits is not None:
            row = self.edits.undo()
            if row >= 0:
                self.show_row(row)
                self._refresh()

    def cancel_or_return(self) -> None:
        """Cancel a drag, else go back to the review."""
        if not self.frame_view.cancel_drag():
            self.back_requested.emit()

    def _request_reanalysis(self) -> None:
        if self.edits is not None and self.edits.corrections():
            self.reanalysis_requested.emit(self._session_id, self.edits.corrections())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self.primary_button.isEnabled():
            self._request_reanalysis()
        elif event.key() in ARROWS and self.current_marker:
            self._nudge_marker(event.key(), bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier))
        else:
            super().keyPressEvent(event)

    # --- showing ------------------------------------------------------------------------------------------
    def _refresh(self) -> None:
        places, session = self.edits, self._session
        if places is None or session is None or self.row < 0:
            return
        at = numbers.format_clock_tenths(float(self._time_s[self.row]))
        doubtful = bool(session.markers.doubted[self.row].any()) or session.status[self.row] == TrackStatus.DOUBTFUL
        changed = places.row_edits(self.row)
        state = self.tr("Uncertain at {time}") if doubtful else self.tr("Frame at {time}")
        self.state.show_state("warn" if doubtful else "none", state.format(time=at))
        name = marker_title(self.current_marker) if self.current_marker else ""
        self.title.setText(
            self.tr("Drag the label “{marker}” to its marker").format(marker=name)
            if name
            else self.tr("Which label is wrong?")
        )
        if self.frame_view.has_frame:
            self.hint.setText(self.tr("Drag a label in the frame, or select it below and click its marker."))
        elif self.frame_view.image is None:  # it is being read
            self.hint.clear()
        else:
            pattern = self.tr(
                "No video was saved. These are the {count} blue spots of this frame. Drag a label to its spot."
            )
            self.hint.setText(pattern.format(count=len(self._blob_px)))
        now = places.current_px(self.row)
        for number, (marker, line) in enumerate(self.rows.items()):
            seen = bool(np.isfinite(now[number]).all())
            off = places.residual_mm(self.row, marker)
            was = places.residual_mm(self.row, marker, is_original=True) if marker in changed else math.nan
            line.show_residual(
                off,
                was,
                is_visible=seen,
                is_changed=marker in changed,
                is_selected=marker == self.current_marker,
            )
        self.hide_button.setEnabled(bool(self.current_marker))
        self.frame_view.current_marker = self.current_marker
        self.frame_view.headings = [at]
        if changed:
            words = [marker_title(marker) for marker in changed]
            self.frame_view.headings.append(self.tr("Changed here: {markers}").format(markers=", ".join(words)))
        self.frame_view.update()
        some = bool(places.corrections())
        self.primary_button.setEnabled(some)
        first = places.corrections()[0].row if some else 0
        again = self.tr("Re-analyse from {time}").format(time=numbers.format_clock_tenths(float(self._time_s[first])))
        self.next_doubtful_button.setVisible(bool(self._find_doubtful_rows().size))
        self.primary_button.set_label(again if some else self.tr("Nothing corrected yet"))
        self.setAccessibleName(self.title.text())


ROW_PX = 34


class MarkerRow(QPushButton):
    """Row of a marker.

    Signals: ``nudged`` with an arrow key and whether Shift was held.
    """

    nudged = Signal(int, bool)

    def __init__(self, theme: Theme, name: str) -> None:
        super().__init__()
        self._theme, self._name = theme, name
        self._sign = Icon(theme, "good", 18, (18, 20))
        self._label, self._value = ElidedText(theme, name, 14, MEDIUM), Text(theme, "", 14, REGULAR)
        self._value.setObjectName("value")
        row = row_layout(gap=10, margins=(8, 0, 8, 0), parent=self)
        for part in (self._sign, self._label, self._value):
            part.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
            row.addWidget(part, int(part is self._label))
        self.on_enter = "pass"
        self.setCheckable(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        theme.changed.connect(self.updateGeometry)

    def show_residual(
        self,
        residual_mm: float,
        original_mm: float,
        *,
        is_visible: bool,
        is_changed: bool,
        is_selected: bool,
    ) -> None:
        """Show the distance from the expected position, now and before the change; NaN if unknown."""
        now = (
            self.tr("{size} mm").format(size=numbers.format_fixed(residual_mm, 1))
            if math.isfinite(residual_mm)
            else "–"
        )
        if not is_visible:
            now = self.tr("occluded")
        if is_changed and math.isfinite(original_mm):
            now = self.tr("{now}, was {size} mm").format(now=now, size=format_rounded(original_mm))
        far = is_visible and math.isfinite(residual_mm) and residual_mm > LARGE_RESIDUAL_MM
        self._sign.show_icon("warn" if far else "predicted" if is_changed else "partly" if not is_visible else "good")
        self._value.setText(now)
        self._label.set_style("text", SEMIBOLD if is_selected else MEDIUM)
        self.setChecked(is_selected)
        self.setAccessibleName(f"{self._name}, {now}")
        self.setToolTip(f"{self._name}, {now}")

    def sizeHint(self) -> QSize:
        return QSize(300, self._theme.px(ROW_PX))

    def minimumSizeHint(self) -> QSize:
        return QSize(200, self._theme.px(ROW_PX))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in ARROWS and self.isChecked():
            self.nudged.emit(event.key(), bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier))
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            event.ignore()  # Enter tracks again, wherever the keyboard is
        else:
            super().keyPressEvent(event)

"""The calibration screen: one instruction, one frame, one verdict, one button."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, Qt, QTimer
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QBoxLayout, QWidget

from carpus.core.calibration.hand_calibrator import HandCalibrator
from carpus.core.model.fault_text import marker_name
from carpus.core.model.types import ByteImage, FloatArray
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import Button
from carpus.ui.kit.keys import bind_key
from carpus.ui.kit.layouts import STRETCH, FittedWidget, column_layout, require_parent, row_layout
from carpus.ui.kit.text import REGULAR, Text
from carpus.ui.kit.theme import MARGIN_PX, Theme
from carpus.ui.kit.translate import translate_phrase
from carpus.ui.picture.photo import Photo, label_size
from carpus.ui.picture.view import HAND_AREA_FACTOR, PALM_AREA_FACTOR
from carpus.ui.screens.markers.guidance import COLUMN_PX, GuidancePanel, StartAngleDialog
from carpus.ui.screens.markers.labelling import (
    LabellingController,
    LabelState,
    Remedy,
    find_faulty_markers,
    find_swapped,
)
from carpus.ui.screens.markers.marker_frame import MarkerFrameView
from carpus.ui.words import terms

PREVIEW_EVERY_MS = 60
MIN_MARKERS = 3
"""Fewer candidates are chance: the hand is not in view or has no markers."""
MIN_WIDE_PX = 780
"""Width from which the hint is beside the buttons instead of above them."""
TWO_LINES_PX, BUTTONS_PX = 40, 36


class MarkersScreen(FittedWidget):
    """Screen of a :class:`LabellingController`."""

    def __init__(self, theme: Theme, background: Background) -> None:
        super().__init__()
        self._theme = theme
        self.labelling = LabellingController(background)
        self.picture = MarkerFrameView(theme)
        self.previous_photo = PreviousPhoto(theme, self.picture)
        self.guidance = GuidancePanel(theme)
        self._is_fitting = False
        self.bubble = self.guidance.bubble
        self.primary_button, self.second_button = self.guidance.primary_button, self.guidance.second_button
        self.start_angle_button = Button(theme, self.tr("Wrist cannot reach neutral…"), "quiet", height_px=32)
        self.start_anyway_button = Button(theme, self.tr("Start anyway (&uncertain)"), "quiet", height_px=32)
        self.accept_all_button = Button(theme, self.tr("All labels are correct"), "quiet", height_px=32)
        self.click_again_button = Button(theme, self.tr("Click all again"), "quiet", hint="C", height_px=32)
        self.new_frame_button = Button(theme, self.tr("New image"), "quiet", hint="N", height_px=32)
        self.hint = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.angle_dialog = StartAngleDialog(self, theme)
        self._build_layout()
        self._connect()
        self._preview_timer = QTimer(self, interval=PREVIEW_EVERY_MS)
        self._preview_timer.timeout.connect(self._show_newest)

    def _build_layout(self) -> None:
        left = column_layout((self.picture, 1), gap=8)
        self._below = QWidget()
        below = self._below_row = QBoxLayout(QBoxLayout.Direction.LeftToRight, self._below)
        below.setContentsMargins(0, 0, 0, 0)
        below.setSpacing(4)
        below.addWidget(self.hint, 1)
        buttons = row_layout(
            STRETCH, self.new_frame_button, self.start_angle_button, self.accept_all_button, self.click_again_button,
            self.start_anyway_button,
        )  # fmt: skip
        for button in (self.accept_all_button, self.click_again_button, self.start_anyway_button):
            button.hide()
        below.addLayout(buttons)
        left.addWidget(self._below)
        columns = row_layout(
            (left, 1), gap=MARGIN_PX, margins=(MARGIN_PX, MARGIN_PX - 4, MARGIN_PX, MARGIN_PX - 4), parent=self
        )
        columns.addWidget(self.guidance)
        self._theme.changed.connect(self._fit)
        self._fit()

    def _fit(self) -> None:
        """Keep space for two lines and the buttons, so that the frame keeps its height."""
        if self._is_fitting:  # what is shown meanwhile lays the screen out, which asks again
            return
        self._is_fitting = True
        narrow = self.width() - self._theme.px(COLUMN_PX) - 3 * MARGIN_PX < MIN_WIDE_PX * self._theme.text_scale
        direction = QBoxLayout.Direction.TopToBottom if narrow else QBoxLayout.Direction.LeftToRight
        self._below_row.setDirection(direction)
        self._below.setFixedHeight(self._theme.px(TWO_LINES_PX + (BUTTONS_PX if narrow else 0)))
        clicks = self.labels is not None and not self.labels.is_complete
        height_px = self.height()
        try:
            self.guidance.fit(height_px, clicks=clicks)
        finally:
            self._is_fitting = False
        if self.height() != height_px:
            self._fit()

    def _connect(self) -> None:
        naming, picture, straight = self.labelling, self.picture, self.guidance.straight_fingers
        naming.labels_changed.connect(self._clear_verdict)
        naming.view_changed.connect(self._refresh)
        naming.doubt_found.connect(picture.set_cursor)
        self.bubble.changed.connect(self._fit)
        picture.cursor_moved.connect(self._find_marker)
        picture.clicked.connect(self._click)
        picture.label_grabbed.connect(self._grab)
        self.primary_button.clicked.connect(self._on_primary)
        self.second_button.clicked.connect(self._on_second)
        self.start_anyway_button.clicked.connect(naming.begin_tracking)
        self.start_angle_button.clicked.connect(lambda: self.angle_dialog.open_angles(naming.start_angles_rad))
        self.angle_dialog.angles_entered.connect(self._set_start_angles)
        self.new_frame_button.clicked.connect(self.preview)
        self.click_again_button.clicked.connect(naming.click_again)
        self.accept_all_button.clicked.connect(lambda: naming.accept_all())
        straight.changed.connect(naming.set_straight_fingers)
        for number in range(1, 6):
            bind_key(self, f"finger_{number}", partial(self._toggle_straight, number))
        picture.installEventFilter(self)
        actions: dict[str, Callable[[], object]] = {
            "undo": naming.undo, "swap": naming.swap, "new_picture": self.preview, "pedal": self.primary_button.click,
            "last_picture": self.previous_photo.toggle, "click_again": naming.click_again,
        }  # fmt: skip
        for name, action in actions.items():
            bind_key(self, name, action)
        bind_key(picture, "accept", self.accept, Qt.ShortcutContext.WidgetShortcut)

    # --- life ---------------------------------------------------------------------------------------------
    @property
    def labels(self) -> LabelState | None:
        """Labels of the frozen frame, None before."""
        return self.labelling.labels

    def initial_focus(self) -> QWidget:
        return self.picture

    def open_calibrator(
        self, calibrator: HandCalibrator, last_rgb: ByteImage | None = None, last_day: str = ""
    ) -> None:
        self.labelling.open_calibrator(calibrator)
        self.picture.labels = None  # of another picture
        self._show_start_angles()
        self.previous_photo.show_picture(last_rgb, last_day)
        self.new_frame_button.setVisible(calibrator.is_live)
        if calibrator.is_live:
            self.preview()
        else:
            self.freeze_frame()

    def close_calibrator(self) -> None:
        self._preview_timer.stop()
        self.labelling.calibrator = None

    def preview(self) -> None:
        if self.labelling.calibrator is None or not self.labelling.calibrator.is_live:
            return
        self.labelling.reset()
        self.picture.labels = None
        self.picture.set_hand_area(None)
        self.picture.clear(self.tr("Waiting for the camera image"))
        self._preview_timer.start()
        self._show_newest()
        self._refresh()
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def freeze_frame(self) -> None:
        calibrator = self.labelling.calibrator
        assert calibrator is not None
        self._preview_timer.stop()
        frame = self.labelling.freeze_frame()
        self.picture.clear_cursor()
        self.picture.labels = self.labels
        self.guidance.straight_fingers.show_answer(calibrator.previous_straight_fingers)
        self._clear_verdict()
        self.picture.show_frame(frame.color_rgb)
        room = HAND_AREA_FACTOR if calibrator.protocol.has_fingers else PALM_AREA_FACTOR
        self.picture.set_hand_area(calibrator.hand_area(), room)
        self.picture.blobs_px = calibrator.candidate_px()
        self.labelling.request_proposals()
        self._refresh()
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_newest(self) -> None:
        calibrator = self.labelling.calibrator
        frame = calibrator.current_frame() if calibrator else None
        if frame is not None:
            self.picture.show_frame(frame.color_rgb)

    # --- clicking -----------------------------------------------------------------------------------------
    def _find_marker(self, pixel: FloatArray) -> None:
        calibrator = self.labelling.calibrator
        self.picture.no_marker_words = ""
        self.picture.found_marker = calibrator.find_marker(pixel) if self.labels is not None and calibrator else None

    def _click(self, pixel: FloatArray) -> None:
        if self.labels is None or self.labelling.calibrator is None:
            return
        taken = self.labelling.click(pixel)
        if taken is None:
            return
        self.picture.no_marker_words = self.tr("No blue marker here. Click nearer.")
        if taken:
            name = marker_name(taken, translate_phrase)
            self.picture.no_marker_words = self.tr("Already the {name}").format(name=name)
            self.hint.setText(self.tr("This marker is already the {name}. Click another one.").format(name=name))
        self.picture.update()

    def _grab(self, name: str) -> None:
        if self.labels is not None:
            self.labels.choose(name)
            self._refresh()

    def accept(self) -> None:
        """Label the marker under the cursor; freeze a live frame."""
        if self.labels is None:
            if self.labelling.calibrator is not None and self.picture.image is not None:
                self.freeze_frame()
        elif self.picture.cursor_px is not None:
            self._click(self.picture.cursor_px)

    def _toggle_straight(self, number: int) -> None:
        if self.guidance.straight_fingers.isVisible():
            self.guidance.straight_fingers.buttons[number - 1].click()

    def _clear_verdict(self) -> None:
        self.picture.wrong_labels, self.picture.questioned_blobs = (), []
        self.picture.update()
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def _set_start_angles(self, angles_rad: FloatArray) -> None:
        self.labelling.start_angles_rad = angles_rad
        self._show_start_angles()
        if self.labels is not None and self.labels.is_complete:
            self.labelling.request_verdict()

    def _show_start_angles(self) -> None:
        angles = terms.start_angle_words(self.labelling.start_angles_rad)
        entered = self.tr("Start position {angles} (entered)").format(angles=angles)
        self.start_angle_button.set_label(entered if angles else self.tr("Wrist cannot reach neutral…"))

    # --- what the buttons do ------------------------------------------------------------------------------
    def _on_primary(self) -> None:
        naming, clicking = self.labelling, self.labels
        if clicking is None:
            self.accept()
        elif naming.outcome is None and clicking.doubtful:
            naming.confirm_doubtful()
        elif naming.outcome is None:
            naming.accept_all(starts_if_good=True)
        elif naming.outcome.verdict.is_good:
            naming.begin_tracking()
        else:
            actions: dict[Remedy, Callable[[], None]] = {
                "swap": naming.swap, "click_these": naming.click_again, "correct": self.correct_labels,
                "take_spot": naming.accept_other_blob, "new_picture": self.preview,
            }  # fmt: skip
            actions[naming.remedy()]()

    def _on_second(self) -> None:
        """Run the second remedy, or start although the verdict is uncertain."""
        naming = self.labelling
        if naming.outcome is None:
            naming.label_manually()
        elif naming.outcome.verdict.can_start and naming.remedy() != "swap":
            naming.begin_tracking()
        else:
            self.correct_labels()

    def correct_labels(self) -> None:
        """Move the keyboard to the frame, where labels can be dragged."""
        self.hint.setText(self.tr("Drag a label to its marker. Two labels can be swapped."))
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    # --- showing ------------------------------------------------------------------------------------------
    def _refresh(self) -> None:
        naming, clicking = self.labelling, self.labels
        outcome, calibrator = naming.outcome, naming.calibrator
        if calibrator is None:
            return
        self.new_frame_button.setEnabled(clicking is not None)
        named = clicking is not None and clicking.is_complete
        self.guidance.straight_fingers.setVisible(named and calibrator.protocol.has_fingers)
        doubtful = outcome is not None and not outcome.verdict.is_good
        remedy = naming.remedy() if doubtful else "correct"
        pair = outcome is not None and outcome.verdict.can_start and bool(find_swapped(outcome.verdict))
        self.start_anyway_button.setVisible(pair)
        self.click_again_button.setVisible(doubtful)
        self.start_angle_button.setVisible(not doubtful)
        self.accept_all_button.setVisible(
            clicking is not None and outcome is None and not naming.is_proposing and bool(clicking.doubtful)
        )
        self.new_frame_button.setVisible(calibrator.is_live and not (doubtful and remedy == "new_picture"))
        if clicking is None:
            self.guidance.show_preview(calibrator)
            self.hint.setText("")
        elif outcome is None:
            sees_none = not clicking.confirmed_px and len(calibrator.candidate_px()) < MIN_MARKERS
            self.guidance.show_labelling(clicking, sees_none=sees_none, is_proposing=naming.is_proposing)
            self.hint.setText(self.tr("The hand lies flat and still, palm down. Fingers that stay bent are fine."))
        else:
            wrong = find_faulty_markers(outcome.verdict)
            self.picture.wrong_labels = wrong
            spots = [one for one in outcome.verdict.findings if one.spot_px]
            self.picture.questioned_blobs = [(one.spot_px, one.markers[0] if one.markers else "") for one in spots]
            self.guidance.show_verdict(clicking, outcome, remedy)
            if doubtful:
                self.click_again_button.set_label(self.tr("Click these again") if wrong else self.tr("Click all again"))
                self.click_again_button.setVisible(remedy != "click_these")  # the primary says it
                self.hint.setText(self.tr("The labels stay as they are until you change one."))
        self._fit()  # by what is shown now
        self.picture.update()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Let Tab go through the markers and Enter press the primary button."""
        if watched is self.picture and event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent):
            if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                self.primary_button.click()
                return True
            step, clicking = {Qt.Key.Key_Tab: 1, Qt.Key.Key_Backtab: -1}.get(Qt.Key(event.key()), 0), self.labels
            if step and clicking is not None and self.labelling.outcome is None:
                clicking.step(step)
                if clicking.current in clicking.confirmed_px:
                    self.picture.set_cursor(clicking.confirmed_px[clicking.current])
                elif clicking.current in clicking.proposals:
                    self.picture.set_cursor(clicking.proposals[clicking.current].pixel)
                self._refresh()
                return True
        return False


SMALL_PX, LARGE_PX = (158, 138), (420, 335)


class PreviousPhoto(Photo):
    """Photo of the last session on the lower left; a click or M changes its size."""

    def __init__(self, theme: Theme, host: QWidget) -> None:
        super().__init__(theme)
        self.setParent(host)
        self._is_large = False
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        host.installEventFilter(self)
        theme.changed.connect(self._fit)
        self.hide()

    def show_picture(self, color_rgb: ByteImage | None, day: str) -> None:
        """Set the photo; without one nothing is shown."""
        super().show_picture(color_rgb, self.tr("Last time, {day}").format(day=day))
        self._is_large = False
        self._fit()

    def toggle(self) -> None:
        self._is_large = not self._is_large
        self._fit()

    def _fit(self) -> None:
        scale = 1.0 if self._is_large else min(self._theme.text_scale, require_parent(self).width() / 832)
        width, height = (round(scale * size) for size in (LARGE_PX if self._is_large else SMALL_PX))
        width = max(width, round(label_size(self._theme, self._label).width()) + 24)
        self.setGeometry(13, require_parent(self).height() - height - 13, width, height)

    def layout_boxes(self) -> tuple[QRectF, QPointF]:
        room = QRectF(self.rect()).adjusted(3, 3, -3, -self._theme.px(23))
        return room, QPointF(3, self.height() - self._theme.px(22))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize:
            self._fit()
        return False

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.toggle()

"""The calibration screen: one instruction, one picture, one verdict, one button."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, Qt, QTimer
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QBoxLayout, QWidget

from carpus.core.types import ByteImage, FloatArray
from carpus.core.words import marker_in_words
from carpus.ui import terms
from carpus.ui.background import Background
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import KeyCaps
from carpus.ui.controls.layouts import STRETCH, Fitted, host_of, in_column, in_line
from carpus.ui.controls.text import REGULAR, Text
from carpus.ui.keys import bind
from carpus.ui.markers.clicking import Clicking
from carpus.ui.markers.guidance import COLUMN_PX, Guidance, StartAngleSheet
from carpus.ui.markers.naming import Naming, Remedy, at_fault, exchanged
from carpus.ui.markers.picture import MarkerPicture
from carpus.ui.picture.photo import Photo, label_size
from carpus.ui.picture.view import HAND_ROOM, PALM_ROOM
from carpus.ui.ports import Calibrator
from carpus.ui.theme import MARGIN_PX, Theme
from carpus.ui.translate import say

PREVIEW_EVERY_MS = 60
FEWEST_DISCS = 3
"""Fewer spots than these are chance: the hand is not in the picture, or has no discs on."""
BESIDE_PX = 780
"""From this width on the words under the picture stand beside the buttons, else over them."""
TWO_LINES_PX, BUTTONS_PX = 40, 36


class MarkersScreen(Fitted):
    """What is done on it is told by its :class:`Naming`."""

    def __init__(self, theme: Theme, background: Background) -> None:
        super().__init__()
        self._theme = theme
        self.naming = Naming(background)
        self.picture = MarkerPicture(theme)
        self.last = LastPicture(theme, self.picture)
        self.guidance = Guidance(theme)
        self._is_fitting = False
        self.bubble, self.primary, self.second = self.guidance.bubble, self.guidance.primary, self.guidance.second
        self.start_angle = Button(theme, self.tr("Wrist cannot lie straight…"), "quiet", height_px=32)
        self.although = Button(theme, self.tr("Start although &doubtful"), "quiet", height_px=32)
        self.take_rest = Button(theme, self.tr("All names are right"), "quiet", height_px=32)
        self.click_all = Button(theme, self.tr("Click all again"), "quiet", hint="C", height_px=32)
        self.new_picture = Button(theme, self.tr("New picture"), "quiet", hint="N", height_px=32)
        self.hint = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.angle_sheet = StartAngleSheet(self, theme)
        self.caps = KeyCaps(theme, self._keys_now())
        self._lay_out()
        self._connect()
        self._preview = QTimer(self, interval=PREVIEW_EVERY_MS)
        self._preview.timeout.connect(self._show_newest)

    def _lay_out(self) -> None:
        left = in_column((self.picture, 1), gap=8)
        left.addLayout(in_line(self.caps, STRETCH))
        self._below = QWidget()
        below = self._below_row = QBoxLayout(QBoxLayout.Direction.LeftToRight, self._below)
        below.setContentsMargins(0, 0, 0, 0)
        below.setSpacing(4)
        below.addWidget(self.hint, 1)
        buttons = in_line(STRETCH)
        for button in (self.new_picture, self.start_angle, self.take_rest, self.click_all, self.although):
            buttons.addWidget(button)
        for button in (self.take_rest, self.click_all, self.although):
            button.hide()
        below.addLayout(buttons)
        left.addWidget(self._below)
        columns = in_line(
            (left, 1), gap=MARGIN_PX, margins=(MARGIN_PX, MARGIN_PX - 4, MARGIN_PX, MARGIN_PX - 4), within=self
        )
        columns.addWidget(self.guidance)
        self._theme.changed.connect(self._fit)
        self._fit()

    def _keys_now(self) -> list[tuple[str, str]]:
        """What the keys do: Enter presses the button at the right, Space takes the spot under the cursor."""
        clicking = self.clicking
        clicks = clicking is not None and bool(clicking.missing)
        keys = [("Space", self.tr("accept"))] if clicks else []
        if not clicks or (clicking is not None and clicking.proposed):
            keys.insert(0, ("Enter", self.tr("go on")))
        if clicking is None:
            return keys  # nothing to undo, to move or to name
        return [
            *keys, ("Backspace", self.tr("undo")), ("← ↑ → ↓", self.tr("move 1 px")), ("+ −", self.tr("zoom")),
            ("Tab", self.tr("next marker")), ("M", self.tr("larger last picture")),
        ]  # fmt: skip

    def _fit(self) -> None:
        """Room for two lines and the buttons whether they are there or not: the picture keeps its height too."""
        if self._is_fitting:  # what is shown meanwhile lays the screen out, which asks again
            return
        self._is_fitting = True
        narrow = self.width() - self._theme.px(COLUMN_PX) - 3 * MARGIN_PX < BESIDE_PX * self._theme.text_scale
        direction = QBoxLayout.Direction.TopToBottom if narrow else QBoxLayout.Direction.LeftToRight
        self._below_row.setDirection(direction)
        self._below.setFixedHeight(self._theme.px(TWO_LINES_PX + (BUTTONS_PX if narrow else 0)))
        clicks = self.clicking is not None and not self.clicking.complete
        height_px = self.height()
        try:
            self.guidance.fit(height_px, clicks=clicks, judged=self.naming.outcome is not None)
        finally:
            self._is_fitting = False
        if self.height() != height_px:
            self._fit()

    def _connect(self) -> None:
        naming, picture, straight = self.naming, self.picture, self.guidance.straight
        naming.edited.connect(self._forget_verdict)
        naming.changed.connect(self._refresh)
        naming.doubted.connect(picture.set_cursor)
        self.bubble.changed.connect(self._fit)
        picture.moved.connect(self._look)
        picture.clicked.connect(self._click)
        picture.grabbed.connect(self._grab)
        self.primary.clicked.connect(self._primary)
        self.second.clicked.connect(self._second)
        self.although.clicked.connect(self.start_doubtful)
        self.start_angle.clicked.connect(lambda: self.angle_sheet.begin(naming.start_angles_rad))
        self.angle_sheet.kept.connect(self._take_start_angles)
        self.new_picture.clicked.connect(self.preview)
        self.click_all.clicked.connect(naming.click_again)
        self.take_rest.clicked.connect(lambda: naming.take_all())
        straight.changed.connect(naming.say_straight)
        for number in range(1, 6):
            bind(self, f"finger_{number}", partial(self._toggle_straight, number))
        picture.installEventFilter(self)
        actions: dict[str, Callable[[], object]] = {
            "undo": naming.undo, "zoom_in": lambda: picture.zoom(1), "zoom_out": lambda: picture.zoom(-1),
            "swap": naming.swap, "new_picture": self.preview, "pedal": self.primary.click,
            "last_picture": self.last.toggle, "click_again": naming.click_again,
        }  # fmt: skip
        for name, action in actions.items():
            bind(self, name, action)
        bind(picture, "accept", self.accept, Qt.ShortcutContext.WidgetShortcut)

    # --- life ---------------------------------------------------------------------------------------------
    @property
    def clicking(self) -> Clicking | None:
        """The names on the picture that is held; None before."""
        return self.naming.clicking

    @property
    def has_names(self) -> bool:
        return self.clicking is not None and bool(self.clicking.pixel)

    def first(self) -> QWidget:
        return self.picture

    def begin(self, calibrator: Calibrator, last_rgb: ByteImage | None = None, last_day: str = "") -> None:
        self.naming.begin(calibrator)
        self.picture.clicking = None  # of another picture
        self._name_start_angles()
        self.last.show_picture(last_rgb, last_day)
        self.new_picture.setVisible(calibrator.is_live)
        if calibrator.is_live:
            self.preview()
        else:
            self.hold()

    def end(self) -> None:
        self._preview.stop()
        self.naming.calibrator = None

    def preview(self) -> None:
        if self.naming.calibrator is None or not self.naming.calibrator.is_live:
            return
        self.naming.aim()
        self.picture.clicking = None
        self.picture.set_area(None)
        self.picture.clear(self.tr("Waiting for a picture"))
        self._preview.start()
        self._show_newest()
        self._refresh()
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def hold(self) -> None:
        calibrator = self.naming.calibrator
        assert calibrator is not None
        self._preview.stop()
        frame = self.naming.hold()
        self.picture.forget_cursor()
        self.picture.clicking = self.clicking
        self.guidance.straight.show_answer(calibrator.last_straight_fingers)
        self.picture.show_wrong(())
        self.picture.show_spots(())
        self.picture.show_frame(frame.color_rgb)
        room = HAND_ROOM if calibrator.protocol.has_fingers else PALM_ROOM
        self.picture.set_hand_area(calibrator.hand_area(), room)
        self.picture.show_discs(calibrator.discs_px())
        self.naming.ask_for_names()
        self._refresh()
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_newest(self) -> None:
        calibrator = self.naming.calibrator
        frame = calibrator.newest_frame() if calibrator else None
        if frame is not None:
            self.picture.show_frame(frame.color_rgb)

    # --- clicking -----------------------------------------------------------------------------------------
    def _look(self, pixel: FloatArray) -> None:
        calibrator = self.naming.calibrator
        self.picture.no_marker_words = ""
        self.picture.found = calibrator.marker_at(pixel) if self.clicking is not None and calibrator else None

    def _click(self, pixel: FloatArray) -> None:
        if self.clicking is None or self.naming.calibrator is None:
            return
        taken = self.naming.click(pixel)
        if taken is None:
            return
        self.picture.no_marker_words = self.tr("No blue marker here. Click nearer.")
        if taken:
            name = marker_in_words(taken, say)
            self.picture.no_marker_words = self.tr("Already the {name}").format(name=name)
            self.hint.setText(self.tr("This marker is the {name} already. Click another one.").format(name=name))
        self.picture.update()

    def _grab(self, name: str) -> None:
        if self.clicking is not None:
            self.clicking.choose(name)
            self._refresh()

    def accept(self) -> None:
        """Take the marker under the cursor; on a live picture, fix the picture."""
        if self.clicking is None:
            if self.naming.calibrator is not None and self.picture.image is not None:
                self.hold()
        elif self.picture.cursor_px is not None:
            self._click(self.picture.cursor_px)

    def _toggle_straight(self, number: int) -> None:
        if self.guidance.straight.isVisible():
            self.guidance.straight.toggle(number)

    def _forget_verdict(self) -> None:
        self.picture.show_wrong(())
        self.picture.show_spots(())
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def _take_start_angles(self, angles_rad: FloatArray) -> None:
        self.naming.start_angles_rad = angles_rad
        self._name_start_angles()
        if self.clicking is not None and self.clicking.complete:
            self.naming.edit()

    def _name_start_angles(self) -> None:
        words, pattern = terms.start_angle_words(self.naming.start_angles_rad), self.tr("Starts at {angles} (given)")
        self.start_angle.set_face(pattern.format(angles=words) if words else self.tr("Wrist cannot lie straight…"))

    # --- what the buttons do ------------------------------------------------------------------------------
    def _primary(self) -> None:
        naming, clicking = self.naming, self.clicking
        if clicking is None:
            self.accept()
        elif naming.outcome is None and clicking.doubtful:
            naming.confirm_doubtful()
        elif naming.outcome is None:
            naming.take_all(goes_on=True)
        elif naming.outcome.verdict.is_good:
            naming.start()
        else:
            actions: dict[Remedy, Callable[[], None]] = {
                "swap": naming.swap, "click_these": naming.click_again, "correct": self.correct_names,
                "take_spot": naming.take_spot, "new_picture": self.preview,
            }  # fmt: skip
            actions[naming.remedy()]()

    def _second(self) -> None:
        """The other way out; a doubtful verdict is passed over by a button that says so only."""
        naming = self.naming
        if naming.outcome is None:
            naming.click_by_hand()
        elif naming.outcome.verdict.can_start and naming.remedy() != "swap":
            naming.start()
        else:
            self.correct_names()

    def correct_names(self) -> None:
        """Everything stays named; the keyboard goes to the picture, where a name is dragged to its disc."""
        self.hint.setText(self.tr("Drag a name to its disc. Names that change places swap."))
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def start_doubtful(self) -> None:
        """The markers look swapped, but the person knows this hand better."""
        if self.naming.outcome is not None and self.naming.outcome.verdict.can_start:
            self.naming.start()

    # --- showing ------------------------------------------------------------------------------------------
    def _refresh(self) -> None:
        naming, clicking, outcome, calibrator = self.naming, self.clicking, self.naming.outcome, self.naming.calibrator
        if calibrator is None:
            return
        self.new_picture.setEnabled(clicking is not None)
        self.caps.set_keys(self._keys_now())
        named = clicking is not None and clicking.complete
        self.guidance.straight.setVisible(named and calibrator.protocol.has_fingers)
        self._fit()
        doubtful = outcome is not None and not outcome.verdict.is_good
        remedy = naming.remedy() if doubtful else "correct"
        pair = outcome is not None and outcome.verdict.can_start and bool(exchanged(outcome.verdict))
        self.although.setVisible(pair)
        self.click_all.setVisible(doubtful)
        self.start_angle.setVisible(not doubtful)
        self.take_rest.setVisible(
            clicking is not None and outcome is None and not naming.waits and bool(clicking.doubtful)
        )
        self.new_picture.setVisible(calibrator.is_live and not (doubtful and remedy == "new_picture"))
        if clicking is None:
            self.guidance.show_preview(calibrator)
            self.hint.setText("")
        elif outcome is None:
            sees_none = not clicking.pixel and calibrator.discs_seen() < FEWEST_DISCS
            self.guidance.show_clicking(clicking, calibrator, sees_none=sees_none, waits=naming.waits)
            self.hint.setText(self.tr("The hand lies flat and still, palm down. Fingers that stay bent are fine."))
            self._fit()  # by the words of this marker
        else:
            wrong = at_fault(outcome.verdict)
            self.picture.show_wrong(wrong)
            spots = [one for one in outcome.verdict.findings if one.spot_px]
            self.picture.show_spots([(one.spot_px, one.markers[0] if one.markers else "") for one in spots])
            self.guidance.show_verdict(clicking, calibrator, outcome, remedy)
            if doubtful:
                self.click_all.set_face(self.tr("Click these again") if wrong else self.tr("Click all again"))
                self.click_all.setVisible(remedy != "click_these")  # the primary says it
                self.hint.setText(self.tr("The names stay as they are until you change one."))
        self.picture.update()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Tab goes through the markers while the picture has the keyboard and markers are open; Enter starts."""
        if watched is self.picture and event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent):
            if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                self.primary.click()
                return True
            step, clicking = {Qt.Key.Key_Tab: 1, Qt.Key.Key_Backtab: -1}.get(Qt.Key(event.key()), 0), self.clicking
            if step and clicking is not None and self.naming.outcome is None:
                clicking.step(step)
                if clicking.current in clicking.pixel:
                    self.picture.set_cursor(clicking.pixel[clicking.current])
                elif clicking.current in clicking.proposed:
                    self.picture.set_cursor(clicking.proposed[clicking.current].pixel)
                self._refresh()
                return True
        return False


SMALL_PX, LARGE_PX = (158, 138), (420, 335)


class LastPicture(Photo):
    """Lies on the lower left of its host; a click or M makes it large and small."""

    def __init__(self, theme: Theme, host: QWidget) -> None:
        super().__init__(theme)
        self.setParent(host)
        self._large = False
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        host.installEventFilter(self)
        theme.changed.connect(self._fit)
        self.hide()

    def show_picture(self, color_rgb: ByteImage | None, day: str) -> None:
        """Set the picture; without one nothing is shown."""
        super().show_picture(color_rgb, self.tr("Last time, {day}").format(day=day))
        self._large = False
        self._fit()

    def toggle(self) -> None:
        self._large = not self._large
        self._fit()

    def _fit(self) -> None:
        scale = 1.0 if self._large else min(self._theme.text_scale, host_of(self).width() / 832)
        width, height = (round(scale * size) for size in (LARGE_PX if self._large else SMALL_PX))
        width = max(width, round(label_size(self._theme, self._label).width()) + 24)
        self.setGeometry(13, host_of(self).height() - height - 13, width, height)

    def place(self) -> tuple[QRectF, QPointF]:
        room = QRectF(self.rect()).adjusted(3, 3, -3, -self._theme.px(23))
        return room, QPointF(3, self.height() - self._theme.px(22))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize:
            self._fit()
        return False

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.toggle()

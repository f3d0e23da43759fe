"""The calibration screen: one instruction, one picture, one verdict, one button."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np
from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QHBoxLayout, QVBoxLayout, QWidget

from carpus.core.calibration.result import CalibrationFinding
from carpus.core.types import ByteImage, FloatArray
from carpus.core.words import marker_in_words
from carpus.ui import terms
from carpus.ui.background import Background
from carpus.ui.controls.button import Button
from carpus.ui.controls.default_answer import ENTER
from carpus.ui.controls.key_caps import KeyCaps
from carpus.ui.controls.text import MEDIUM, REGULAR, StateText, Text, heading
from carpus.ui.fault_words import finding_words
from carpus.ui.hand_drawing import HandDrawing, MarkerState
from carpus.ui.keys import Keys, bind
from carpus.ui.marker_words import click_instruction, marker_place
from carpus.ui.markers import proposals
from carpus.ui.markers.clicking import Clicking
from carpus.ui.markers.last_picture import LastPicture
from carpus.ui.markers.picture import MarkerPicture
from carpus.ui.markers.remedy import Remedy, face, remedy_of
from carpus.ui.markers.start_angle import StartAngleSheet
from carpus.ui.markers.straight import StraightFingers
from carpus.ui.markers.verdict import DISC_DOUBTED, NAMES_WRONG, VerdictPanel, headline, rows_before, rows_of
from carpus.ui.picture.view import HAND_ROOM, PALM_ROOM
from carpus.ui.ports import Calibrator, Judged, ProposedMarker
from carpus.ui.theme import MARGIN_PX, Theme
from carpus.ui.tour.bubble import LEAST_SCREEN_PX, BubbleView
from carpus.ui.tour.order import Work
from carpus.ui.translate import say

PREVIEW_EVERY_MS = 60
FEWEST_DISCS = 3
"""Fewer spots than these are chance: the hand is not in the picture, or has no discs on."""

ALL_FITS_PX = 700
CROWDED_BELOW_PX = 460
GUIDED_MORE_PX = 60
BESIDE_PX = 780
"""From this width on the words under the picture stand beside the buttons, else over them."""
TWO_LINES_PX, BUTTONS_PX = 40, 36


class MarkersScreen(QWidget):
    """``started`` when tracking has begun; ``judged`` carries each verdict; ``told`` a fault for a message card."""

    started = Signal()
    told = Signal(object)
    judged = Signal(object)

    def __init__(self, theme: Theme, keys: Keys, background: Background) -> None:
        super().__init__()
        self._theme, self._background = theme, background
        self._calibrator: Calibrator | None = None
        self.clicking: Clicking | None = None
        self._judged: Judged | None = None
        self._judging = 0
        self._goes_on = False
        self._held = False
        self._by_hand = False
        self._proposing = 0
        self._waits_for_names = False
        self._start_angles_rad = np.zeros(3)
        self.picture = MarkerPicture(theme)
        self.last = LastPicture(theme, self.picture)
        self.step = StateText(theme, 14, MEDIUM)
        self.title = heading(theme, wrap=True)
        self.place = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.hand = HandDrawing(theme)
        self.panel = VerdictPanel(theme)
        self.straight = StraightFingers(theme)
        self.straight.hide()
        self.bubble = BubbleView(theme)
        self.primary = Button(theme, "", "primary")
        self.second = Button(theme, "", "plain", height_px=52)
        self.start_angle = Button(theme, self.tr("Wrist cannot lie straight…"), "quiet", height_px=32)
        self.although = Button(theme, self.tr("Start although &doubtful"), "quiet", height_px=32)
        self.take_rest = Button(theme, self.tr("All names are right"), "quiet", height_px=32)
        self.take_rest.hide()
        self.click_all = Button(theme, self.tr("Click all again"), "quiet", hint="C", height_px=32)
        self.new_picture = Button(theme, self.tr("New picture"), "quiet", hint="N", height_px=32)
        self.hint = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.angle_sheet = StartAngleSheet(self, theme)
        self.caps = KeyCaps(theme, self._keys_now())
        self._lay_out()
        self._connect(keys)
        self._preview = QTimer(self)
        self._preview.setInterval(PREVIEW_EVERY_MS)
        self._preview.timeout.connect(self._show_newest)

    def _lay_out(self) -> None:
        left = QVBoxLayout()
        left.setSpacing(8)
        left.addWidget(self.picture, 1)
        caps = QHBoxLayout()
        caps.addWidget(self.caps)
        caps.addStretch(1)
        left.addLayout(caps)
        self._below = QWidget()
        below = self._below_row = QBoxLayout(QBoxLayout.Direction.LeftToRight, self._below)
        below.setContentsMargins(0, 0, 0, 0)
        below.setSpacing(4)
        below.addWidget(self.hint, 1)
        buttons = QHBoxLayout()
        buttons.addStretch(1)
        for button in (self.new_picture, self.start_angle, self.take_rest, self.click_all, self.although):
            buttons.addWidget(button)
        self.click_all.hide()
        self.although.hide()
        below.addLayout(buttons)
        left.addWidget(self._below)
        right = self._right = QVBoxLayout()
        right.setSpacing(8)
        right.addSpacing(8)
        right.addWidget(self.step)
        right.addWidget(self.title)
        right.addWidget(self.place)
        right.addWidget(self.hand, 1)
        right.addStretch(0)  # where the drawing has given way its room stays in one piece
        right.addWidget(self.straight)
        right.addWidget(self.panel)
        right.addSpacing(8)
        right.addWidget(self.bubble)
        row = QHBoxLayout()
        row.setSpacing(12)
        row.addWidget(self.primary, 1)
        row.addWidget(self.second)
        right.addLayout(row)
        columns = QHBoxLayout(self)
        columns.setContentsMargins(MARGIN_PX, MARGIN_PX - 4, MARGIN_PX, MARGIN_PX - 4)
        columns.setSpacing(MARGIN_PX)
        columns.addLayout(left, 1)
        self._column = QWidget()
        right.setContentsMargins(0, 0, 0, 0)
        self._column.setLayout(right)
        columns.addWidget(self._column)
        self._theme.changed.connect(self._fit)
        self._fit()

    def _keys_now(self) -> list[tuple[str, str]]:
        """What the keys do: Enter presses the button at the right, Space takes the spot under the cursor."""
        clicks = self._held and self.clicking is not None and bool(self.clicking.missing)
        keys = [("Space", self.tr("accept"))] if clicks else []
        if not clicks or (self.clicking is not None and self.clicking.proposed):
            keys.insert(0, ("Enter", self.tr("go on")))
        if not self._held:
            return keys  # nothing to undo, to move or to name
        return [
            *keys, ("Backspace", self.tr("undo")), ("← ↑ → ↓", self.tr("move 1 px")), ("+ −", self.tr("zoom")),
            ("Tab", self.tr("next marker")), ("M", self.tr("larger last picture")),
        ]  # fmt: skip

    def _fit(self) -> None:
        """The column keeps its width whatever the words, so that the picture never moves under the cursor."""
        self._column.setFixedWidth(self._theme.px(376))
        # Room for two lines and the buttons whether they are there or not: the picture keeps its height too.
        narrow = self.width() - self._theme.px(376) - 3 * MARGIN_PX < BESIDE_PX * self._theme.text_scale
        direction = QBoxLayout.Direction.TopToBottom if narrow else QBoxLayout.Direction.LeftToRight
        self._below_row.setDirection(direction)
        self._below.setFixedHeight(self._theme.px(TWO_LINES_PX + (BUTTONS_PX if narrow else 0)))
        # The question of the straight fingers and the checks are read; the drawing has done its work by then.
        asks = not self.straight.isHidden()
        self.bubble.give_room(self.height() >= LEAST_SCREEN_PX * self._theme.text_scale)
        # The bubble takes its height, and the air of a gap more than what gives way for it.
        guided_px = 0 if self.bubble.isHidden() else self.bubble.sizeHint().height() + self._theme.px(GUIDED_MORE_PX)
        room_px = self.height() - guided_px
        self.hand.setVisible(not (asks and room_px < ALL_FITS_PX * self._theme.text_scale))
        # With less room still, first the drawing that says where to click, then the question, else the checks.
        crowded = self.height() > 0 and room_px < CROWDED_BELOW_PX * self._theme.text_scale
        clicks = self.clicking is not None and not self.clicking.complete
        self.panel.setVisible(not (crowded and (clicks or asks)))
        self.panel.show_close(False)
        if crowded:
            self.hand.setVisible(clicks)
            self._right.invalidate()
            needed_px = self._right.minimumHeightForWidth(self._theme.px(376)) + 2 * (MARGIN_PX - 4) + guided_px
            self.panel.show_close(needed_px > self.height())
        elif clicks and self.height() > 0:
            # A long name of a marker may take a line more than there is: the checks, not known yet, wait.
            self._right.invalidate()
            needed_px = self._right.minimumHeightForWidth(self._theme.px(376)) + 2 * (MARGIN_PX - 4) + guided_px
            self.panel.setVisible(needed_px <= self.height())
        elif self._judged is not None and not asks and self.bubble.isHidden() and self.height() > 0:
            self._right.invalidate()  # the checks are what is read now: where both have no room, the drawing waits
            needed_px = self._right.minimumHeightForWidth(self._theme.px(376)) + 2 * (MARGIN_PX - 4)
            self.hand.setVisible(needed_px <= self.height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit()

    def _connect(self, keys: Keys) -> None:
        self.bubble.changed.connect(self._fit)
        self.picture.moved.connect(self._look)
        self.picture.clicked.connect(self._click)
        self.picture.grabbed.connect(self._grab)
        self.primary.clicked.connect(self._primary)
        self.second.clicked.connect(self._second)
        self.although.clicked.connect(self._start_doubtful)
        self.start_angle.clicked.connect(lambda: self.angle_sheet.begin(self._start_angles_rad))
        self.angle_sheet.kept.connect(self._take_start_angles)
        self.new_picture.clicked.connect(self.preview)
        self.click_all.clicked.connect(self._click_again)
        self.take_rest.clicked.connect(self.take_all)
        self.straight.changed.connect(self._take_straight)
        for number in range(1, 6):
            bind(self, keys, f"finger_{number}", partial(self._toggle_straight, number))
        self.picture.installEventFilter(self)
        actions = {
            "undo": self.undo, "zoom_in": lambda: self.picture.zoom(1), "zoom_out": lambda: self.picture.zoom(-1),
            "swap": self._swap,
        }  # fmt: skip
        for name, action in actions.items():
            bind(self, keys, name, action)
        bind(self.picture, keys, "accept", self.accept, Qt.ShortcutContext.WidgetShortcut)
        bind(self, keys, "new_picture", self.preview)
        bind(self, keys, "pedal", self.primary.click)
        bind(self, keys, "last_picture", self.last.toggle)
        bind(self, keys, "click_again", self._click_again)

    # --- life ---------------------------------------------------------------------------------------------
    def begin(self, calibrator: Calibrator, last_rgb: ByteImage | None = None, last_day: str = "") -> None:
        """Show a source's picture and begin."""
        self._calibrator = calibrator
        self._held, self._judged = False, None
        self.clicking = self.picture.clicking = None  # of another picture
        self._start_angles_rad = np.zeros(3)
        self._take_start_angles(self._start_angles_rad)
        self.last.show_picture(last_rgb, last_day)
        self.new_picture.setVisible(calibrator.is_live)
        if calibrator.is_live:
            self.preview()
        else:
            self.hold()

    def end(self) -> None:
        """Stop the preview and let go."""
        self._preview.stop()
        self._calibrator = None

    def preview(self) -> None:
        """Show the live picture until the hand lies right."""
        if self._calibrator is None or not self._calibrator.is_live:
            return
        self._held = False
        self._judged = None
        self.clicking = self.picture.clicking = None
        self.picture.set_area(None)
        self.picture.clear(self.tr("Waiting for a picture"))
        self._preview.start()
        self._show_newest()
        self._refresh()
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def hold(self) -> None:
        """Fix the picture and ask for the first marker."""
        assert self._calibrator is not None
        self._preview.stop()
        frame = self._calibrator.hold()
        self._held = True
        self._judged = None
        self.picture.forget_cursor()
        self.clicking = self.picture.clicking = Clicking(
            self._calibrator.protocol, self._calibrator.side, straight_fingers=self._calibrator.last_straight_fingers
        )
        self.straight.show_answer(self.clicking.straight_fingers)
        self.picture.show_wrong(())
        self.picture.show_spots(())
        self.picture.show_frame(frame.color_rgb)
        room = HAND_ROOM if self._calibrator.protocol.has_fingers else PALM_ROOM
        self.picture.set_hand_area(self._calibrator.hand_area(), room)
        self._by_hand = False
        self.picture.show_discs(self._calibrator.discs_px())
        self._ask_for_names()
        self._refresh()
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show_newest(self) -> None:
        frame = self._calibrator.newest_frame() if self._calibrator else None
        if frame is not None:
            self.picture.show_frame(frame.color_rgb)

    @property
    def work(self) -> Work:
        """How far the markers are."""
        if not self._held:
            return "aiming"
        if self._judged is None:
            return "clicking"
        return "checked" if self._judged.verdict.is_good else "doubtful"

    @property
    def has_names(self) -> bool:
        """Whether a person has named a disc of this picture."""
        return self._held and self.clicking is not None and bool(self.clicking.pixel)

    # --- clicking -----------------------------------------------------------------------------------------
    def _look(self, pixel: FloatArray) -> None:
        self.picture.no_marker_words = ""
        self.picture.found = self._calibrator.marker_at(pixel) if self._held and self._calibrator else None

    def _click(self, pixel: FloatArray) -> None:
        if not self._held or self.clicking is None or self._calibrator is None:
            return
        found = self._calibrator.marker_at(pixel)
        if found is None:
            self.picture.no_marker_words = self.tr("No blue marker here. Click nearer.")
            self.picture.update()
            return
        taken = self.clicking.taken_by(found.pixel)
        if taken:
            name = marker_in_words(taken, say)
            self.picture.no_marker_words = self.tr("Already the {name}").format(name=name)
            self.hint.setText(self.tr("This marker is the {name} already. Click another one.").format(name=name))
            self.picture.update()
            return
        agreed = self.clicking.confirms(found.pixel)
        swapped = self.clicking.place(found.pixel, found.width_px)
        if not agreed and not swapped:
            self._ask_for_names()  # of two that changed places the person has said all there is to say
        self._changed()

    def _grab(self, name: str) -> None:
        if self.clicking is not None:
            self.clicking.current = name
            self._refresh()

    def _ask_for_names(self) -> None:
        """Let the program propose the names no person has given; each click of a person is one more thing it knows."""
        self._proposing += 1
        self._waits_for_names = False
        if self._by_hand or self.clicking is None or self._calibrator is None or self.clicking.complete:
            return
        number, calibrator, named = self._proposing, self._calibrator, dict(self.clicking.pixel)
        self._waits_for_names = True

        def take(proposed: Mapping[str, ProposedMarker]) -> None:
            if number != self._proposing or self.clicking is None:
                return
            self._waits_for_names = False
            if set(self.clicking.pixel) != set(named):
                self._ask_for_names()  # clicked meanwhile
                return
            self.clicking.propose(proposed)
            self._show_doubtful(self.clicking)
            self._refresh()
            self.picture.update()

        self._background.run(
            lambda: calibrator.propose(named), take, lambda fault: self._take_fault(self._judging, fault), self
        )

    def _show_doubtful(self, clicking: Clicking) -> None:
        """Bring the first doubtful disc under the cursor and into the loupe, to be confirmed or changed."""
        if clicking.doubtful:
            clicking.current = clicking.doubtful[0]
            self.picture.set_cursor(clicking.proposed[clicking.current].pixel)

    def take_all(self, *, goes_on: bool = False) -> None:
        """Confirm all names that are proposed. ``goes_on``: with all checks good and nothing to ask it measures."""
        if self.clicking is not None and self.clicking.proposed:
            self.clicking.take_all()
            self._changed(goes_on=goes_on)

    def _confirm_doubtful(self) -> None:
        """The doubtful name in the loupe is right; the next one comes into it."""
        assert self.clicking is not None
        name = self.clicking.doubtful[0]
        self.clicking.confirm(name)
        self._show_doubtful(self.clicking)
        self._changed()

    def click_by_hand(self) -> None:
        """No more proposals: every marker is clicked by the person."""
        self._by_hand = True
        self._proposing += 1
        self._waits_for_names = False
        if self.clicking is not None:
            self.clicking.propose({})
            self._changed()

    def accept(self) -> None:
        """Take the marker under the cursor; on a live picture, fix the picture."""
        if not self._held:
            if self._calibrator is not None and self.picture.image is not None:
                self.hold()
        elif self.picture.cursor_px is not None:
            self._click(self.picture.cursor_px)

    def _take_straight(self, answer: tuple[bool, ...]) -> None:
        if self.clicking is not None and self.clicking.straight_fingers != answer:
            self.clicking.straight_fingers = answer
            self._changed()

    def _toggle_straight(self, number: int) -> None:
        if self.straight.isVisible():
            self.straight.toggle(number)

    def undo(self) -> None:
        """Take back the marker set last."""
        if self.clicking is not None and self.clicking.undo():
            self._ask_for_names()
            self._changed()

    def _changed(self, *, goes_on: bool = False) -> None:
        """Clicks are different: the old verdict no longer counts, a new one is asked for when all are there."""
        self._judged, self._goes_on = None, goes_on
        self.picture.show_wrong(())
        self.picture.show_spots(())
        self._judging += 1
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)
        if self.clicking is not None and self.clicking.complete and self._calibrator is not None:
            number, calibrator, clicks, angles = (
                self._judging,
                self._calibrator,
                self.clicking.clicks(),
                self._start_angles_rad,
            )
            self._background.run(
                lambda: calibrator.judge(clicks, angles),
                lambda judged: self._take_verdict(number, judged),
                lambda fault: self._take_fault(number, fault),
                self,
            )
        self._refresh()

    def _take_verdict(self, number: int, judged: Judged) -> None:
        if number == self._judging:
            self._judged = judged
            self._refresh()
            self.judged.emit(judged.verdict)
            if self._goes_on and judged.verdict.is_good and self.straight.isHidden():  # nothing is left to decide
                self._start()

    def _take_fault(self, number: int, fault: Exception) -> None:
        if number == self._judging:
            self.told.emit(fault)

    def _take_start_angles(self, angles_rad: FloatArray) -> None:
        self._start_angles_rad = angles_rad
        words = terms.start_angle_words(angles_rad)
        pattern = self.tr("Starts at {angles} (given)")
        self.start_angle.set_face(pattern.format(angles=words) if words else self.tr("Wrist cannot lie straight…"))
        if self.clicking is not None and self.clicking.complete:
            self._changed()

    # --- what the buttons do ------------------------------------------------------------------------------
    def _primary(self) -> None:
        if not self._held:
            self.accept()
        elif self._judged is None and self.clicking is not None and self.clicking.doubtful:
            self._confirm_doubtful()
        elif self._judged is None:
            self.take_all(goes_on=True)
        elif self._judged.verdict.is_good:
            self._start()
        else:
            actions: dict[Remedy, Callable[[], None]] = {
                "swap": self._swap, "click_these": self._click_again, "correct": self.correct_names,
                "take_spot": self._take_spot, "new_picture": self.preview,
            }  # fmt: skip
            actions[self._remedy()]()

    def _second(self) -> None:
        """The other way out; a doubtful verdict is passed over by a button that says so only."""
        if self._judged is None:
            self.click_by_hand()
        elif self._judged.verdict.can_start and self._remedy() != "swap":
            self._start()
        else:
            self.correct_names()

    def _remedy(self) -> Remedy:
        assert self._judged is not None
        assert self._calibrator is not None
        return remedy_of(self._judged.verdict, is_live=self._calibrator.is_live)

    def correct_names(self) -> None:
        """Everything stays named; the keyboard goes to the picture, where a name is dragged to its disc."""
        self.hint.setText(self.tr("Drag a name to its disc. Names that change places swap."))
        self.picture.setFocus(Qt.FocusReason.OtherFocusReason)

    def _start_doubtful(self) -> None:
        """The markers look swapped, but the person knows this hand better."""
        if self._judged is not None and self._judged.verdict.can_start:
            self._start()

    def _start(self) -> None:
        if self._judged is not None and self._judged.calibration is not None and self._calibrator is not None:
            self._calibrator.begin(self._judged.calibration)
            self.started.emit()

    def _pairs(self) -> list[tuple[str, str]]:
        """Names that stand in for each other: two, or those of two fingers each for each."""
        findings = self._judged.verdict.findings if self._judged else ()
        names = next((finding.markers for finding in findings if finding.kind == "swapped"), ())
        half = len(names) // 2
        return list(zip(names[:half], names[half:], strict=True))

    def _swap(self) -> None:
        pairs = self._pairs()
        if pairs and self.clicking is not None:
            for one, other in pairs:
                self.clicking.swap(one, other)
            self._changed()

    def _click_again(self) -> None:
        """Take back the markers at fault, or all of them where the fault lies with none."""
        if self.clicking is None or self._judged is None:
            if self.clicking is not None and self.clicking.proposed:
                self.click_by_hand()
            return
        wrong = self._wrong_markers()
        if wrong:
            self.clicking.clear(wrong)
        else:
            self.clicking.clear_all()
        self._changed()

    def _take_spot(self) -> None:
        """The spot in question is the disc: the name moves to it."""
        findings = self._judged.verdict.findings if self._judged else ()
        for finding in findings:
            if finding.spot_px and finding.markers and self.clicking is not None:
                (name,) = finding.markers
                self.clicking.pixel[name] = np.array(finding.spot_px)
        self._changed()

    def _spots(self, findings: Sequence[CalibrationFinding]) -> list[tuple[tuple[float, ...], str]]:
        return [(one.spot_px, one.markers[0] if one.markers else "") for one in findings if one.spot_px]

    def _wrong_markers(self) -> tuple[str, ...]:
        findings: Sequence[CalibrationFinding] = self._judged.verdict.findings if self._judged else ()
        return tuple(dict.fromkeys(name for finding in findings for name in finding.markers))

    # --- showing ------------------------------------------------------------------------------------------
    def _refresh(self) -> None:
        if self._calibrator is None:
            return
        self.new_picture.setEnabled(self._held)
        self.caps.set_keys(self._keys_now())
        self.take_rest.hide()
        named = self._held and self.clicking is not None and self.clicking.complete
        self.straight.setVisible(bool(named) and self._calibrator.protocol.has_fingers)
        self._fit()
        pair = self._judged is not None and self._judged.verdict.can_start and bool(self._pairs())
        doubtful = self._judged is not None and not self._judged.verdict.is_good
        self.although.setVisible(pair)
        self.click_all.setVisible(doubtful)
        self.start_angle.setVisible(not doubtful)
        self.new_picture.setVisible(self._calibrator.is_live and not (doubtful and self._remedy() == "new_picture"))
        if not self._held or self.clicking is None:
            self._show_preview()
        elif self._judged is None:
            self._show_clicking(self.clicking)
        else:
            self._show_verdict(self.clicking, self._judged)
        self.picture.update()

    def _show_preview(self) -> None:
        assert self._calibrator is not None
        self.step.show_state("none", self.tr("Picture"))
        self.title.setText(self.tr("Lay the hand flat and still"))
        self.place.setText(
            self.tr("Palm down, fingers as straight as they go, forearm in line. Then take the picture.")
        )
        order = self._calibrator.protocol.markers
        self.hand.show_markers(self._calibrator.side, dict.fromkeys(order, "later"))
        self.panel.show_rows(self.tr("Checks"), "none", rows_before(0, len(order), self._calibrator.limits))
        self.primary.setEnabled(True)
        self.primary.set_face(self.tr("Take the picture"), icon="", hint=ENTER)
        self.second.hide()
        self.hint.setText("")

    def _show_clicking(self, clicking: Clicking) -> None:
        assert self._calibrator is not None
        done, asked = len(clicking.pixel), len(clicking.order)
        number = clicking.order.index(clicking.current) + 1
        self.step.show_state("none", self.tr("Marker {number} of {asked}").format(number=number, asked=asked))
        self.title.setText(click_instruction(clicking.current))
        self.place.setText(marker_place(clicking.current))
        if clicking.complete:  # nothing is left to click while they are checked
            self.step.show_state("good", self.tr("All markers found"))
            self.title.setText(self.tr("Checking the markers…"))
            self.place.setText(self.tr("Hold the hand in this position until the measuring begins."))
        self.hand.show_markers(clicking.side, self._hand_states(clicking, ()))
        words = self.tr("Checking…") if clicking.complete else self.tr("Good so far") if done else self.tr("Checks")
        state = "good" if done and not clicking.complete else "none"
        self.panel.show_rows(words, state, rows_before(done, asked, self._calibrator.limits))  # type: ignore[arg-type]
        self.primary.setEnabled(False)
        to_go = len(clicking.missing)
        left = self.tr("1 marker to go") if to_go == 1 else self.tr("{count} markers to go").format(count=to_go)
        words = self.tr("Start measuring · {left}").format(left=left) if to_go else self.tr("Checking the markers…")
        self.primary.set_face(words, icon="", hint="")
        self.second.hide()
        self.hint.setText(self.tr("The hand lies flat and still, palm down. Fingers that stay bent are fine."))
        if not done and self._calibrator.discs_seen() < FEWEST_DISCS:
            self._show_no_disc()
        if self._waits_for_names:
            self.step.show_state("none", self.tr("Looking for the markers…"))
        elif clicking.proposed:
            self._show_proposals(clicking)
        self._fit()  # by the words of this marker

    def _show_no_disc(self) -> None:
        """Nothing in the picture looks like blue paper: said at once, before anybody looks for what is not there."""
        assert self._calibrator is not None
        self.step.show_state("warn", self.tr("No blue disc in the picture"), token="warn")
        self.title.setText(self.tr("No blue disc is to be seen"))
        self.place.setText(
            self.tr("Are the discs on, and the hand under the camera? More light helps; dark blue cloth is no disc.")
        )

    def _show_proposals(self, clicking: Clicking) -> None:
        words = proposals.words_for(clicking)
        self.step.show_state(words.state, words.step, token="warn" if words.state == "warn" else "text2")
        self.title.setText(words.title)
        self.place.setText(words.place)
        self.primary.setEnabled(True)
        self.primary.set_face(words.primary, icon="", hint=ENTER)
        self.second.set_face(self.tr("Click by hand"), hint="C")
        self.second.show()
        self.take_rest.setVisible(bool(clicking.doubtful))
        asked, proposed = len(clicking.order), len(clicking.proposed) + len(clicking.pixel)
        assert self._calibrator is not None
        checks = self.tr("Names to confirm")
        self.panel.show_rows(checks, "none", rows_before(proposed, asked, self._calibrator.limits, proposed=True))

    def _show_verdict(self, clicking: Clicking, judged: Judged) -> None:
        assert self._calibrator is not None
        verdict = judged.verdict
        words, state = headline(verdict)
        wrong = self._wrong_markers()
        self.picture.show_wrong(wrong)
        self.picture.show_spots(self._spots(verdict.findings))
        self.hand.show_markers(clicking.side, self._hand_states(clicking, wrong))
        self.panel.show_rows(
            words if verdict.is_good else self.tr("Checks"), state, rows_of(verdict, self._calibrator.limits)
        )
        self.primary.setEnabled(True)
        if verdict.is_good:
            self.step.show_state("good", self.tr("All markers found"))
            self.title.setText(self.tr("Ready to measure"))
            self.place.setText(self.tr("Hold the hand in this position until the measuring begins."))
            self.primary.set_face(self.tr("Start measuring"), icon="play", hint=ENTER)
            self.second.hide()
            self.primary.setFocus(Qt.FocusReason.OtherFocusReason)
            return
        first = max(
            verdict.findings,
            key=lambda finding: (finding.blocks, finding.kind in NAMES_WRONG, finding.kind in DISC_DOUBTED),
        )
        said = finding_words(first)
        self.step.show_state(state, words, token="bad" if state == "bad" else "warn")
        self.title.setText(said.happened.rstrip("."))
        self.place.setText(" ".join(part for part in (said.safe, said.do) if part))
        remedy = self._remedy()
        words, key = face(remedy)
        self.primary.set_face(words, icon="", hint=key)
        swap = remedy == "swap"
        self.second.set_face(self.tr("Correct names") if swap else self.tr("Start although &doubtful"), hint="")
        self.second.setVisible(swap or verdict.can_start)
        self.click_all.set_face(self.tr("Click these again") if wrong else self.tr("Click all again"))
        self.click_all.setVisible(remedy != "click_these")  # the primary says it
        self.hint.setText(self.tr("The names stay as they are until you change one."))
        self.primary.setFocus(Qt.FocusReason.OtherFocusReason)

    def _hand_states(self, clicking: Clicking, wrong: Sequence[str]) -> dict[str, MarkerState]:
        states: dict[str, MarkerState] = {}
        for name in clicking.order:
            states[name] = "wrong" if name in wrong else "done" if name in clicking.pixel else "later"
        for name, one in clicking.proposed.items():
            states[name] = "proposed" if one.is_sure else "doubtful"
        if (clicking.missing and not clicking.proposed) or clicking.current in clicking.unnamed:
            states[clicking.current] = "next"
        return states

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Tab goes through the markers while the picture has the keyboard and markers are open; Enter starts."""
        if watched is self.picture and event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent):
            if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                self.primary.click()
                return True
            step = {Qt.Key.Key_Tab: 1, Qt.Key.Key_Backtab: -1}.get(Qt.Key(event.key()), 0)
            if step and self._held and self.clicking is not None and self._judged is None:
                self.clicking.step(step)
                current = self.clicking.current
                if current in self.clicking.pixel:
                    self.picture.set_cursor(self.clicking.pixel[current])
                elif current in self.clicking.proposed:
                    self.picture.set_cursor(self.clicking.proposed[current].pixel)
                self._refresh()
                return True
        return False

"""The bubbles of the guided session: when each is shown, its words, and its view, which covers nothing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QPainter, QPainterPath, QPaintEvent, QPen
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QVBoxLayout, QWidget

from carpus.ui.kit.button import Button
from carpus.ui.kit.layouts import fill, row_layout
from carpus.ui.kit.text import MEDIUM, Text, caption
from carpus.ui.kit.theme import CARD_RADIUS_PX, Theme
from carpus.ui.kit.translate import tr

Bubble = Literal["patient", "camera", "aim", "click", "check", "record", "stop", "results", "report", "save", "end"]
LabelStage = Literal["aiming", "clicking", "checked", "doubtful"]
"""Labelling: no frame yet, labels missing, all checks good, something uncertain."""

PLACES: Mapping[Bubble, str] = {
    "patient": "patients", "camera": "camera", "aim": "markers", "click": "markers",
    "check": "markers", "record": "live", "stop": "live", "results": "review", "report": "review", "save": "report",
    "end": "report",
}  # fmt: skip
"""Screen of each bubble, in the order of a session."""
PARTS = ("patients", "markers", "live", "review", "report")
"""Screens that are counted as parts of the session."""
ONLY_READ: tuple[Bubble, ...] = ("click", "results")
"""Bubbles whose “Next” presses nothing."""
WITHOUT_POINTER: tuple[Bubble, ...] = (*ONLY_READ, "end")
"""Bubbles that are not about the control below them."""


@dataclass(frozen=True, slots=True)
class TourState:
    """What decides on the bubble.

    ``is_wanted``: the practice patient is open, or the tour was requested; ``is_covered``: a message or dialog is
    open; ``is_busy``: something is still running.
    """

    place: str
    is_wanted: bool = True
    is_covered: bool = False
    is_busy: bool = False
    label_stage: LabelStage = "aiming"
    is_recording: bool = False
    is_saved: bool = False


def find_bubble(state: TourState, read: frozenset[Bubble] = frozenset()) -> Bubble | None:
    """Return the bubble to show; read bubbles are not shown again."""
    if state.is_covered or state.is_busy or not state.is_wanted:
        return None
    return next((bubble for bubble in _candidate_bubbles(state) if bubble not in read), None)


def _candidate_bubbles(state: TourState) -> tuple[Bubble, ...]:
    if state.place == "markers":
        at_work: Mapping[LabelStage, tuple[Bubble, ...]] = {
            "aiming": ("aim",),
            "clicking": ("click",),
            "checked": ("check",),
        }
        return at_work.get(state.label_stage, ())  # the screen itself says what is wrong
    if state.place == "live":
        return ("stop",) if state.is_recording else ("record",)
    if state.place == "report":
        return ("end",) if state.is_saved else ("save",)
    return tuple(bubble for bubble, place in PLACES.items() if place == state.place)


def bubble_words(bubble: Bubble) -> str:
    """Return the sentence of a bubble."""
    words: Mapping[Bubble, str] = {
        "patient": tr("Choose a patient in the list, then start here. The practice patient is simulated."),
        "camera": tr("Choose the image source, then continue here."),
        "aim": tr("Take the image when the hand lies flat and every marker is visible."),
        "click": tr("Check that every label is on its marker, then press Enter."),
        "check": tr("Every marker has its label and all checks are good. Start measuring here."),
        "record": tr("The joints are already tracked. The space bar starts the recording."),
        "stop": tr("Let the hand move a few times. Then press the space bar to stop and save."),
        "results": tr("These are the results. The key X excludes the current repetition."),
        "report": tr("Make the report of this session here."),
        "save": tr("Save the report as a PDF. It contains only the pseudonym."),
        "end": tr("You have finished a whole session. The arrow at the top left leads back to the patients."),
    }
    return words[bubble]


TAIL_PX = 9
MIN_SCREEN_PX = 445
"""On a lower screen, in text-scaled pixels, the bubble gives way to the controls."""
TAIL_WIDTH_PX = 20
TAIL_IN_PX = 96
"""Distance of the pointer from the right edge of a wide bubble."""


class BubbleView(QWidget):
    """Shows a bubble, hidden without one.

    ``wide``: one line that points below its right end, else a column that points below its middle. ``keys`` is False
    where the space bar must always reach the screen.
    """

    changed = Signal()
    """Emitted when it appears or disappears: the screen must be fitted again."""

    def __init__(self, theme: Theme, *, wide: bool = False, keys: bool = True) -> None:
        super().__init__()
        self._theme, self._wide = theme, wide
        self.bubble: Bubble | None = None
        self._has_room = True
        self.text = Text(theme, "", 14, MEDIUM, wrap=True)
        self.part_label = caption(theme)
        self.next_button = Button(theme, self.tr("&Next"), height_px=36)
        self.leave_button = Button(theme, self.tr("End the tour"), "quiet", hint=self.tr("Esc"), height_px=36)
        for button in (self.next_button, self.leave_button):
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus if keys else Qt.FocusPolicy.NoFocus)
        foot = row_layout(gap=4)
        whole = QHBoxLayout(self) if wide else QVBoxLayout(self)
        if wide:
            whole.setSpacing(16)
            whole.addWidget(self.text, 1)
            fill(foot, self.part_label, 8)
        else:
            whole.setSpacing(6)
            whole.addWidget(self.part_label)
            whole.addWidget(self.text)
            foot.addStretch(1)
        fill(foot, self.leave_button, self.next_button)
        whole.addLayout(foot)
        whole.setContentsMargins(16, 8, 10, 8 + TAIL_PX)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        theme.changed.connect(self.update)
        self.hide()

    def show_bubble(self, bubble: Bubble | None) -> None:
        if bubble == self.bubble:
            return
        self.bubble = bubble
        if bubble is not None:
            self.text.setText(bubble_words(bubble))
            words, place = self.tr("First session"), PLACES[bubble]
            if place in PARTS:
                numbered = self.tr("First session · {number} of {count}")
                words = numbered.format(number=PARTS.index(place) + 1, count=len(PARTS))
            self.part_label.setText(words)
            self.next_button.set_label(self.tr("&Done") if bubble == "end" else self.tr("&Next"))
            self.setAccessibleName(bubble_words(bubble))
        self._update_visibility()
        self.update()

    @property
    def has_pointer(self) -> bool:
        """True if the text is about the control below."""
        return self.bubble not in WITHOUT_POINTER

    def set_room(self, has_room: bool) -> None:
        """Hide the bubble where large text leaves no space for it."""
        if has_room != self._has_room:
            self._has_room = has_room
            self._update_visibility()

    def _update_visibility(self) -> None:
        self.setVisible(self.bubble is not None and self._has_room)
        self.changed.emit()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        body = QRectF(self.rect()).adjusted(1, 1, -1, -1 - TAIL_PX)
        outline = QPainterPath()
        outline.addRoundedRect(body, CARD_RADIUS_PX, CARD_RADIUS_PX)
        middle = body.right() - self._theme.px(TAIL_IN_PX) if self._wide else body.center().x()
        tail = QPainterPath(QPointF(middle - TAIL_WIDTH_PX / 2, body.bottom() - 1))
        tail.lineTo(QPointF(middle, body.bottom() + TAIL_PX))
        tail.lineTo(QPointF(middle + TAIL_WIDTH_PX / 2, body.bottom() - 1))
        tail.closeSubpath()
        painter.setPen(QPen(self._theme.color("accent"), 1.5))
        painter.setBrush(self._theme.color("soft"))
        painter.drawPath(outline.united(tail) if self.has_pointer else outline)

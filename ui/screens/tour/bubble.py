"""The bubble of the guided session; it has space of its own and covers nothing."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QPainter, QPainterPath, QPaintEvent, QPen
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QVBoxLayout, QWidget

from carpus.ui.kit.button import Button
from carpus.ui.kit.layouts import fill, row_layout
from carpus.ui.kit.text import MEDIUM, Text, caption
from carpus.ui.kit.theme import CARD_RADIUS_PX, Theme
from carpus.ui.screens.tour.bubbles import PARTS, WITHOUT_POINTER, Bubble, bubble_words, part_number

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
            number = part_number(bubble)
            self.text.setText(bubble_words(bubble))
            self.part_label.setText(
                self.tr("First session · {number} of {count}").format(number=number, count=len(PARTS))
                if number
                else self.tr("First session")
            )
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

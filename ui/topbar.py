"""The bar at the top: who is measured, where in the journey, what the camera does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QWidget

from carpus.ui import numbers
from carpus.ui.controls.button import Button, icon_button
from carpus.ui.controls.card import Line, Surface
from carpus.ui.controls.layouts import in_column, in_line
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD, Sign, StateText, Text, plain_tooltip
from carpus.ui.fonts import font
from carpus.ui.icons import paint_state
from carpus.ui.theme import MARGIN_PX, Theme

BAR_PX = 56
MOST_NAME_PX = 190
RECORDING_LINE_PX = 3


class TopBar(Surface):
    """``tab`` and ``step`` carry the number of a tab, or of a step already done, that was chosen; ``again`` is for what
    is tracked again or waits for a decision."""

    tab = Signal(int)
    step = Signal(int)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self.brand = _Brand(theme)
        self._bar_line = Line(theme, vertical=True)
        self._bar_line.setFixedHeight(24)
        self.back_button = icon_button(theme, "chevron-left", self.tr("Back (Esc)"))
        self.name = Text(theme, "", 14, SEMIBOLD)
        self.where = Text(theme, "", 14, REGULAR, "text2")
        self.camera = StateText(theme)
        self.disk = StateText(theme)
        self.pill = RecordingPill(theme)
        self.again = AgainButton(theme)
        self.help_button = icon_button(theme, "circle-help", self.tr("Help (F1)"))
        self.settings_button = icon_button(theme, "settings", self.tr("Settings (Ctrl+,)"))
        self._middle = in_line(gap=4)
        self._way: list[WayButton] = []
        self._left, self._right = QWidget(), QWidget()
        left = _row(self._left, 8, self.brand, self._bar_line, self.back_button, self.name, self.where)
        left.addStretch(1)
        right = _row(self._right, 16, self.camera, self.disk, self.again, self.pill)
        right.insertStretch(0, 1)
        right.addSpacing(-4)
        right.addWidget(self.help_button)
        right.addSpacing(-12)
        right.addWidget(self.settings_button)
        row = in_line(
            (self._left, 1), self._middle, (self._right, 1), gap=8, margins=(MARGIN_PX - 4, 0, MARGIN_PX - 10, 0)
        )
        for said in (self.camera, self.disk, self.again, self.pill):
            said.resized.connect(self._fit)
        whole = in_column((row, 1), gap=0, margins=(0, 0, 0, 0), within=self)
        self._under = Surface(theme, under="line")
        self._under.setFixedHeight(RECORDING_LINE_PX)
        whole.addSpacing(1 - RECORDING_LINE_PX)  # the red line lies over the bar's last pixels and moves nothing
        whole.addWidget(self._under)
        theme.changed.connect(self._take_theme)
        self._take_theme()
        self.show_place("", "")

    def _take_theme(self) -> None:
        self.setFixedHeight(self._theme.px(BAR_PX) + RECORDING_LINE_PX - 2)
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit()

    def _fit(self) -> None:
        """What there is no room for gives way to what must be seen: an ample disk, the exercise, the program's name, a
        camera that works."""
        named = bool(self.name.text())
        shown = {
            "disk": bool(self.disk.text()), "where": named and bool(self.where.text()), "again": True, "name": True,
            "camera": bool(self.camera.text()),
        }  # fmt: skip
        may_go = {
            "disk": self.disk.state == "none", "where": True, "again": True, "name": named,
            "camera": self.camera.state == "good",
        }  # fmt: skip
        for part in may_go:
            if self._needed_px(shown) <= self.width():
                break
            shown[part] = shown[part] and not may_go[part]
        self.disk.setVisible(shown["disk"])
        self.where.setVisible(shown["where"])
        self.brand.show_name(shown["name"])
        self.camera.setVisible(shown["camera"])
        self.again.shorten(not shown["again"])

    def _needed_px(self, shown: dict[str, bool]) -> float:
        named = [self._bar_line, self.back_button, self.name] if self.name.text() else []
        left = [self.brand.width_px(shown["name"]), *(one.sizeHint().width() for one in named)]
        left += [self.where.sizeHint().width()] if shown["where"] else []
        right = [one.sizeHint().width() for one in (self.help_button, self.settings_button)]
        right += [one.width() for one in (self.camera, self.disk) if shown["camera" if one is self.camera else "disk"]]
        right += [self.again.width_px(short=not shown["again"])] if self.again.words else []
        right += [self.pill.sizeHint().width()] if self.pill.state != "off" else []
        middle = [one.sizeHint().width() for one in self._way]
        gaps = 8 * (len(left) - 1) + 4 * max(len(middle) - 1, 0) + 16 * (len(right) - 1) - 16
        return sum(left) + sum(middle) + sum(right) + gaps + 2 * MARGIN_PX - 14 + 3 * 8

    def show_place(self, pseudonym: str, where: str) -> None:
        """Whose session this is, and hand and exercise; empty on the first screen."""
        self.name.setText(self._elided(pseudonym))
        self.name.setToolTip(plain_tooltip(pseudonym))
        for widget in (self._bar_line, self.back_button, self.name):
            widget.setVisible(bool(pseudonym))
        self.where.setText(where)
        self._fit()

    def _elided(self, pseudonym: str) -> str:
        """A long name must not push the way through the session aside."""
        face = font(14 * self._theme.text_scale, SEMIBOLD)
        return QFontMetricsF(face).elidedText(pseudonym, Qt.TextElideMode.ElideRight, self._theme.px(MOST_NAME_PX))

    def show_steps(self, names: Sequence[str], current: int) -> None:
        self._show_way([WayButton(self._theme, name, number, current, True) for number, name in enumerate(names)])
        for number, button in enumerate(self._way):
            button.setEnabled(number < current)
            button.clicked.connect(lambda _=False, number=number: self.step.emit(number))

    def show_tabs(self, names: Sequence[str], current: int) -> None:
        self._show_way([WayButton(self._theme, name, number, current, False) for number, name in enumerate(names)])
        for number, button in enumerate(self._way):
            button.clicked.connect(lambda _=False, number=number: self.tab.emit(number))

    def show_nothing(self) -> None:
        self._show_way([])

    def way(self) -> list[WayButton]:
        return self._way

    def _show_way(self, buttons: list[WayButton]) -> None:
        for old in self._way:
            self._middle.removeWidget(old)
            old.hide()
            old.deleteLater()
        self._way = buttons
        for button in buttons:
            self._middle.addWidget(button)
            button.show()
        self._fit()

    def show_recording(self, recording: bool) -> None:
        self._under.set_colors("band_bad" if recording else "surface")

    def lock_aside(self, locked: bool) -> None:
        """Nothing leads aside from a running recording, nor takes its keys; back asks whether it shall stop."""
        for button, words in (
            (self.help_button, self.tr("Help (F1)")),
            (self.settings_button, self.tr("Settings (Ctrl+,)")),
        ):
            button.setEnabled(not locked)
            button.setToolTip(self.tr("After the recording") if locked else words)


class WayButton(Button):
    """A step with its number or check, or a tab with a line under it."""

    def __init__(self, theme: Theme, text: str, number: int, current: int, is_step: bool) -> None:
        super().__init__(theme, text, "quiet", height_px=40)
        self._number, self._current, self._is_step = number, current, is_step
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        done = is_step and number < current
        here = self.tr("{name}, you are here").format(name=text)
        self.setAccessibleName(
            here if number == current else self.tr("{name}, done").format(name=text) if done else text
        )
        self.setCursor(Qt.CursorShape.PointingHandCursor if done or not is_step else Qt.CursorShape.ArrowCursor)

    @property
    def is_current(self) -> bool:
        return self._number == self._current

    def _face(self) -> QFont:
        return font(14 * self._theme.text_scale, SEMIBOLD if self.is_current else MEDIUM)

    def sizeHint(self) -> QSize:
        bold = QFontMetricsF(font(14 * self._theme.text_scale, SEMIBOLD)).horizontalAdvance(self.text())
        return QSize(round(bold) + (self._theme.px(20) + 32 if self._is_step else 24), self._theme.px(40))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        color = self._theme.color
        left = 12.0
        if self._is_step:
            size = float(self._theme.px(20))
            box = QRectF(left, (self.height() - size) / 2, size, size)
            self._paint_number(painter, box)
            left += size + 8
        painter.setFont(self._face())
        painter.setPen(color("text" if self.is_current or (self.underMouse() and self.isEnabled()) else "text2"))
        painter.drawText(
            QRectF(left, 0, self.width() - left, self.height()), int(Qt.AlignmentFlag.AlignVCenter), self.text()
        )
        if not self._is_step and self.is_current:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(color("accent"))
            painter.drawRoundedRect(QRectF(10, self.height() - 3, self.width() - 20, 3), 1.5, 1.5)

    def _paint_number(self, painter: QPainter, box: QRectF) -> None:
        color = self._theme.color
        if self._number < self._current:
            paint_state(painter, "good", box, color("accent"), color("on_accent"))
            return
        here = self.is_current
        painter.setPen(Qt.PenStyle.NoPen if here else QPen(color("border"), 1))
        painter.setBrush(color("accent") if here else Qt.BrushStyle.NoBrush)
        painter.drawEllipse(box.center(), box.width() / 2 - 0.5, box.width() / 2 - 0.5)
        painter.setFont(font(12 * self._theme.text_scale, SEMIBOLD))
        painter.setPen(color("on_accent" if here else "text2"))
        painter.drawText(box.translated(QPointF(0, 0)), Qt.AlignmentFlag.AlignCenter, str(self._number + 1))


class AgainButton(Button):
    """What is tracked again, or waits for a decision, in words or, where there is little room, in short. ``resized``
    when it needs other room; hidden without words."""

    resized = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, "", "plain", icon="history", height_px=36)
        self.words = self._in_short = ""
        self._short = False
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # after a click Space and Enter stay with the screen
        self.hide()

    def show_words(self, words: str, in_short: str, tip: str = "") -> None:
        """Say something, or with empty words nothing; ``tip`` says what a click is for."""
        if (words, in_short) == (self.words, self._in_short):
            return
        self.words, self._in_short = words, in_short
        self._show()
        self.setToolTip(tip)
        self.setVisible(bool(words))
        self.resized.emit()

    def shorten(self, short: bool) -> None:
        if short != self._short:
            self._short = short
            self._show()

    def width_px(self, *, short: bool) -> int:
        face = QFontMetricsF(font(14 * self._theme.text_scale, SEMIBOLD))
        text = self._in_short if short else self.words
        return round(face.horizontalAdvance(text)) + self._theme.px(18) + 8 + 2 * 16

    def _show(self) -> None:
        self.set_face(self._in_short if self._short else self.words)
        self.setAccessibleName(self.words)


class _Brand(QWidget):
    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._mark, self._word = Sign(theme, "carpus", 22, (26, 32)), Text(theme, "Carpus", 16, SEMIBOLD)
        row = _row(self, 6, self._mark, self._word)
        row.addSpacing(6)
        self.setAccessibleName("Carpus")

    def width_px(self, named: bool) -> int:
        return self._mark.width() + 12 + (self._word.sizeHint().width() if named else 0)

    def show_name(self, named: bool) -> None:
        self._word.setVisible(named)


def _row(host: QWidget, spacing_px: int, *widgets: QWidget) -> QHBoxLayout:
    row = in_line(gap=spacing_px, margins=(0, 0, 0, 0), within=host)
    for widget in widgets:
        row.addWidget(widget)
    return row


PillState = Literal["off", "recording", "paused"]


class RecordingPill(Surface):
    """Hidden while nothing is recorded; as wide whatever the time. ``resized`` when it needs other room."""

    resized = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self.state: PillState = "off"
        self._dot, self._bars = Surface(theme, "on_band_bad"), Sign(theme, "pause", 16, (16, 20), "text")
        self._dot.setObjectName("dot")
        self._dot.setFixedSize(13, 13)
        self._words = Text(theme, "", 20, SEMIBOLD)
        in_line(self._dot, self._bars, self._words, gap=8, margins=(14, 0, 16, 0), within=self)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.hide()

    def show_state(self, state: PillState, seconds: float) -> None:
        pattern = self.tr("Recording {time}") if state == "recording" else self.tr("Paused at {time}")
        text = pattern.format(time=numbers.clock(seconds)) if state != "off" else ""
        if (state, text) != (self.state, self._words.text()):
            resize = state != self.state or len(text) != len(self._words.text())
            self._words.setText(text)
            self.setAccessibleName(text)
            self.setVisible(state != "off")
            if state != self.state:
                self.state = state
                recording = state == "recording"
                self.set_colors(*(("band_bad",) if recording else ("surface", "text")))
                self._words.set_look("on_band_bad" if recording else "text", SEMIBOLD)
                self._dot.setVisible(recording)
                self._bars.setVisible(not recording)
            if resize:
                self.updateGeometry()
                self.resized.emit()

    def sizeHint(self) -> QSize:
        return QSize(super().sizeHint().width(), self._theme.px(40))

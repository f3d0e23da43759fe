"""Top bar: patient, navigation, and the state of camera, disk and recording."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QMenu, QSizePolicy, QWidget

from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button, icon_button
from carpus.ui.kit.card import Separator, Surface
from carpus.ui.kit.fonts import font
from carpus.ui.kit.icons import paint_state
from carpus.ui.kit.layouts import STRETCH, column_layout, row_layout
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, Icon, StateText, Text, plain_tooltip
from carpus.ui.kit.theme import MARGIN_PX, Theme

BAR_PX = 56
MIN_NAME_PX = 300
RECORDING_LINE_PX = 3


class TopBar(Surface):
    """Top bar of the window.

    Signals: ``tab_selected`` and ``step_selected`` with the number of a tab or of a finished step.
    ``reanalysis_button`` shows a running re-analysis or one that waits for a decision.
    """

    tab_selected = Signal(int)
    step_selected = Signal(int)

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self.brand = _Brand(theme)
        self._separator = Separator(theme, vertical=True)
        self._separator.setFixedHeight(24)
        self.back_button = icon_button(theme, "chevron-left", self.tr("Back (Esc)"))
        self._name = ""
        self.patient_name = Text(theme, "", 14, SEMIBOLD)
        self.session_label = Text(theme, "", 14, REGULAR, "text2")
        self.camera = StateText(theme)
        self.disk = StateText(theme)
        self.recording_pill = RecordingPill(theme)
        self.reanalysis_button = ReanalysisButton(theme)
        self.therapist_button = Button(theme, "", "quiet", height_px=40)
        self.therapist_button.setMenu(QMenu(self))
        self.names_button = icon_button(theme, "eye", self.tr("Hide names (Ctrl+D)"))
        self.names_button.setCheckable(True)
        self.names_button.toggled.connect(self._show_names_hidden)
        self.help_button = icon_button(theme, "circle-help", self.tr("Help (F1)"))
        self.settings_button = icon_button(theme, "settings", self.tr("Settings (Ctrl+,)"))
        self._navigation = row_layout(gap=4)
        self.navigation_buttons: list[NavigationButton] = []
        self._left, self._right = QWidget(), QWidget()
        bare = (0, 0, 0, 0)
        row_layout(
            self.brand, self._separator, self.back_button, self.patient_name, self.session_label, STRETCH, gap=8,
            margins=bare, parent=self._left,
        )  # fmt: skip
        right = row_layout(
            STRETCH, self.camera, self.disk, self.reanalysis_button, self.recording_pill, -4, gap=16, margins=bare,
            parent=self._right,
        )  # fmt: skip
        for button in (self.therapist_button, self.names_button, self.help_button):
            right.addWidget(button)
            right.addSpacing(-12)
        right.addWidget(self.settings_button)
        row = row_layout(
            (self._left, 1), self._navigation, (self._right, 1), gap=8, margins=(MARGIN_PX - 4, 0, MARGIN_PX - 10, 0)
        )
        for status in (self.camera, self.disk, self.reanalysis_button, self.recording_pill):
            status.resized.connect(self._fit)
        whole = column_layout((row, 1), gap=0, margins=(0, 0, 0, 0), parent=self)
        self._bottom_line = Surface(theme, bottom_edge="line")
        self._bottom_line.setFixedHeight(RECORDING_LINE_PX)
        whole.addSpacing(1 - RECORDING_LINE_PX)  # the red line lies over the bar's last pixels and moves nothing
        whole.addWidget(self._bottom_line)
        theme.changed.connect(self._apply_theme)
        self._apply_theme()
        self.show_session("", "")

    def _apply_theme(self) -> None:
        self.setFixedHeight(self._theme.px(BAR_PX) + RECORDING_LINE_PX - 2)
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        self._fit()

    def _fit(self) -> None:
        """Hide what does not fit, in this order: ample disk, exercise, short button, program name, working camera."""
        named = bool(self._name)
        shown = {
            "disk": bool(self.disk.text()),
            "where": named and bool(self.session_label.text()),
            "again": True,
            "name": True,
            "camera": bool(self.camera.text()),
        }
        may_go = {
            "disk": self.disk.state == "none", "where": True, "again": True, "name": named,
            "camera": self.camera.state == "good",
        }  # fmt: skip
        for part in may_go:
            if self._min_width_px(shown) <= self.width():
                break
            shown[part] = shown[part] and not may_go[part]
        self.disk.setVisible(shown["disk"])
        self.session_label.setVisible(shown["where"])
        self.brand.show_name(shown["name"])
        self.camera.setVisible(shown["camera"])
        self.reanalysis_button.set_short(not shown["again"])
        room_px = self.width() - self._min_width_px(shown) + self._min_name_px()
        metrics = QFontMetricsF(font(14 * self._theme.text_scale, SEMIBOLD))
        self.patient_name.setText(metrics.elidedText(self._name, Qt.TextElideMode.ElideRight, room_px))

    def _min_name_px(self) -> float:
        metrics = QFontMetricsF(font(14 * self._theme.text_scale, SEMIBOLD))
        return min(metrics.horizontalAdvance(self._name) + 1, self._theme.px(MIN_NAME_PX))

    def _min_width_px(self, is_shown: dict[str, bool]) -> float:
        named = [self._separator.sizeHint().width(), self.back_button.sizeHint().width(), self._min_name_px()]
        left = [self.brand.width_px(is_shown["name"]), *(named if self._name else [])]
        left += [self.session_label.sizeHint().width()] if is_shown["where"] else []
        buttons = (self.therapist_button, self.names_button, self.help_button, self.settings_button)
        right = [sum(one.sizeHint().width() + 4 for one in buttons)]
        right += [
            one.width() for one in (self.camera, self.disk) if is_shown["camera" if one is self.camera else "disk"]
        ]
        right += (
            [self.reanalysis_button.width_px(short=not is_shown["again"])] if self.reanalysis_button.text_shown else []
        )
        right += [self.recording_pill.sizeHint().width()] if self.recording_pill.state != "off" else []
        middle = [one.sizeHint().width() for one in self.navigation_buttons]
        gaps = 8 * (len(left) - 1) + 4 * max(len(middle) - 1, 0) + 16 * (len(right) - 1) - 16
        return sum(left) + sum(middle) + sum(right) + gaps + 2 * MARGIN_PX - 14 + 3 * 8

    def show_session(self, name: str, label: str) -> None:
        """Show patient, hand and exercise; empty on the first screen."""
        self._name = name
        self.patient_name.setToolTip(plain_tooltip(name))
        for widget in (self._separator, self.back_button, self.patient_name):
            widget.setVisible(bool(name))
        self.session_label.setText(label)
        self._fit()

    def show_therapist(self, initials: str) -> None:
        """Show who works now; empty for nobody."""
        name = self.tr("Therapist: {initials}").format(initials=initials) if initials else self.tr("Choose a therapist")
        self.therapist_button.set_label(initials or self.tr("Therapist"))
        self.therapist_button.setToolTip(name)
        self.therapist_button.setAccessibleName(name)
        self._fit()

    def _show_names_hidden(self, is_hidden: bool) -> None:
        name = self.tr("Show names (Ctrl+D)") if is_hidden else self.tr("Hide names (Ctrl+D)")
        self.names_button.set_label("", icon="eye-off" if is_hidden else "eye")
        self.names_button.setToolTip(name)
        self.names_button.setAccessibleName(name)

    def show_navigation(self, names: Sequence[str] = (), current: int = 0, *, is_steps: bool = False) -> None:
        """Show the steps of the set-up or the tabs of a patient; nothing without names."""
        for old in self.navigation_buttons:
            self._navigation.removeWidget(old)
            old.hide()
            old.deleteLater()
        self.navigation_buttons = [
            NavigationButton(self._theme, name, number, current, is_steps) for number, name in enumerate(names)
        ]
        selected = self.step_selected if is_steps else self.tab_selected
        for number, button in enumerate(self.navigation_buttons):
            button.setEnabled(not is_steps or number < current)
            button.clicked.connect(lambda _=False, number=number: selected.emit(number))
            self._navigation.addWidget(button)
            button.show()
        self._fit()

    def show_recording(self, is_recording: bool) -> None:
        self._bottom_line.set_colors("band_bad" if is_recording else "surface")

    def lock_overlays(self, is_locked: bool) -> None:
        """Disable help, settings and the therapist during a recording."""
        self.therapist_button.setEnabled(not is_locked)
        for button, words in (
            (self.help_button, self.tr("Help (F1)")),
            (self.settings_button, self.tr("Settings (Ctrl+,)")),
        ):
            button.setEnabled(not is_locked)
            button.setToolTip(self.tr("Available after the recording") if is_locked else words)


class NavigationButton(Button):
    """Step with its number or check mark, or tab with an underline."""

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
        painter.setFont(font(14 * self._theme.text_scale, SEMIBOLD if self.is_current else MEDIUM))
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
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, str(self._number + 1))


class ReanalysisButton(Button):
    """Button for a re-analysis, with a short text where there is little room; hidden without text.

    Signals: ``resized`` when its width changes.
    """

    resized = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme, "", "plain", icon="history", height_px=36)
        self.text_shown = self._short_text = ""
        self._is_short = False
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # after a click Space and Enter stay with the screen
        self.hide()

    def show_text(self, text: str, short_text: str, tip: str = "") -> None:
        """Show a text with its short form; an empty one hides the button."""
        if (text, short_text) == (self.text_shown, self._short_text):
            return
        self.text_shown, self._short_text = text, short_text
        self._update_face()
        self.setToolTip(tip)
        self.setVisible(bool(text))
        self.resized.emit()

    def set_short(self, short: bool) -> None:
        if short != self._is_short:
            self._is_short = short
            self._update_face()

    def width_px(self, *, short: bool) -> int:
        face = QFontMetricsF(font(14 * self._theme.text_scale, SEMIBOLD))
        text = self._short_text if short else self.text_shown
        return round(face.horizontalAdvance(text)) + self._theme.px(18) + 8 + 2 * 16

    def _update_face(self) -> None:
        self.set_label(self._short_text if self._is_short else self.text_shown)
        self.setAccessibleName(self.text_shown)


class _Brand(QWidget):
    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._mark, self._word = Icon(theme, "carpus", 22, (26, 32)), Text(theme, "Carpus", 16, SEMIBOLD)
        row_layout(self._mark, self._word, 6, gap=6, margins=(0, 0, 0, 0), parent=self)
        self.setAccessibleName("Carpus")

    def width_px(self, named: bool) -> int:
        return self._mark.width() + 12 + (self._word.sizeHint().width() if named else 0)

    def show_name(self, named: bool) -> None:
        self._word.setVisible(named)


PillState = Literal["off", "recording", "paused"]


class RecordingPill(Surface):
    """Recording indicator of constant width, hidden while nothing is recorded.

    Signals: ``resized`` when its width changes.
    """

    resized = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__(theme)
        self.state: PillState = "off"
        self._dot, self._bars = Surface(theme, "on_band_bad"), Icon(theme, "pause", 16, (16, 20), "text")
        self._dot.setObjectName("dot")
        self._dot.setFixedSize(13, 13)
        self._words = Text(theme, "", 20, SEMIBOLD)
        row_layout(self._dot, self._bars, self._words, gap=8, margins=(14, 0, 16, 0), parent=self)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.hide()

    def show_state(self, state: PillState, seconds: float) -> None:
        pattern = self.tr("Recording {time}") if state == "recording" else self.tr("Paused at {time}")
        text = pattern.format(time=numbers.format_clock(seconds)) if state != "off" else ""
        if (state, text) != (self.state, self._words.text()):
            resize = state != self.state or len(text) != len(self._words.text())
            self._words.setText(text)
            self.setAccessibleName(text)
            self.setVisible(state != "off")
            if state != self.state:
                self.state = state
                recording = state == "recording"
                self.set_colors(*(("band_bad",) if recording else ("surface", "text")))
                self._words.set_style("on_band_bad" if recording else "text", SEMIBOLD)
                self._dot.setVisible(recording)
                self._bars.setVisible(not recording)
            if resize:
                self.updateGeometry()
                self.resized.emit()

    def sizeHint(self) -> QSize:
        return QSize(super().sizeHint().width(), self._theme.px(40))

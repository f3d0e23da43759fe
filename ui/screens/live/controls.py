"""The bar below the live screen: status light, notes, pause, and the recording button."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from carpus.core.records.session_setup import next_part
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Surface
from carpus.ui.kit.fonts import MEDIUM, SEMIBOLD, font
from carpus.ui.kit.icons import paint_state
from carpus.ui.kit.layouts import fill, row_layout
from carpus.ui.kit.theme import MARGIN_PX, Theme
from carpus.ui.screens.live.recording import RecordingController
from carpus.ui.screens.live.status_light import StatusLight


class RecordingControls(Surface):
    """Shows the state of the recording.

    Buttons take no focus: the space bar, or a pedal that sends it, must always reach the screen.
    """

    def __init__(self, theme: Theme, recording: RecordingController) -> None:
        super().__init__(theme)
        self._recording, self._is_tight = recording, False
        self.light_view = StatusLightView(theme)
        self.note_button = Button(theme, self.tr("Note"), "quiet", icon="notebook-pen", hint="F5")
        self.pain_button = Button(theme, self.tr("Pain"), "quiet", hint="F6")
        self.pause_button = Button(theme, self.tr("Pause"), icon="pause", hint="F7", height_px=52)
        self.main_button = Button(theme, "", "primary", height_px=56)
        row = row_layout(
            (self.light_view, 1),
            8,
            self.note_button,
            self.pain_button,
            8,
            self.pause_button,
            gap=4,
            margins=(0, 0, MARGIN_PX, 0),
            parent=self,
        )
        fill(row, 12, self.main_button)
        for button in (self.note_button, self.pain_button, self.pause_button, self.main_button):
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        recording.changed.connect(self.refresh)

    def fit(self, *, tight: bool) -> None:
        """Hide hints with large text on a small screen."""
        self._is_tight = tight
        for button, hint in ((self.note_button, "F5"), (self.pain_button, "F6"), (self.pause_button, "F7")):
            button.set_label(button.text(), hint="" if tight else hint)
        self.refresh()

    def reset(self) -> None:
        self.pain_button.set_label(self.tr("Pain"), icon="")

    def show_pain(self, score: int) -> None:
        self.pain_button.set_label(self.tr("Pain {score}").format(score=score), icon="check")

    def show_storing(self, words: str = "") -> None:
        """Show that the recording is being stored, or how long catching up takes."""
        self.main_button.set_label(words or self.tr("Saving…"), icon="", hint="")

    def refresh(self) -> None:
        recording = self._recording
        state = recording.state
        runs = state != "off" and not recording.is_storing  # what is stopped takes no more notes
        self.note_button.set_label(self.tr("Passive") if recording.is_passive else self.tr("Note"))
        self.note_button.setEnabled(runs)
        self.pain_button.setEnabled(runs)
        self.pause_button.setEnabled(runs and not recording.camera_lost)  # nothing can go on without pictures
        paused = state == "paused" and not recording.camera_lost
        self.pause_button.set_label(
            self.tr("Continue") if paused else self.tr("Pause"), icon="play" if paused else "pause"
        )
        self.main_button.setEnabled(not recording.is_storing)
        if recording.is_busy:
            return
        words = self.tr("Play and record") if recording.is_playback else self.tr("Record")
        if runs:
            follows = recording.set_up is not None and next_part(recording.set_up) is not None
            words = self.tr("Stop and next exercise") if follows else self.tr("Stop and review")
        elif recording.countdown_s:
            words = self.tr("Starting in {seconds} (cancel)").format(seconds=recording.countdown_s)
        hint = "" if self._is_tight else self.tr("Space · pedal")
        self.main_button.set_label(words, icon="square" if runs else "", hint=hint)


HEIGHT_PX = 72
BANDS = {
    "good": ("good_soft", "good", "text", "good", "good_soft"),
    "warn": ("band_warn", "on_band_warn", "on_band_warn", "on_band_warn", "band_warn"),
    "bad": ("band_bad", "on_band_bad", "on_band_bad", "on_band_bad", "band_bad"),
    "idle": ("sunken", "text2", "text2", "border", "sunken"),
}
"""Colours by rank: background, state, remedy, icon body, icon sign."""
WRAP_FLAG = int(Qt.TextFlag.TextWordWrap)
TEXT_SHARES = [0.95 - 0.05 * step for step in range(10)]


class StatusLightView(QWidget):
    """Paints a :class:`StatusLight`."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self.status_light = StatusLight("idle", "", "")
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self.updateGeometry)

    def show_light(self, status_light: StatusLight) -> None:
        """Change the light; screen readers get both lines."""
        if status_light != self.status_light:
            self.status_light = status_light
            self.setAccessibleName(f"{status_light.state}. {status_light.remedy}")
            self.update()

    def sizeHint(self) -> QSize:
        return QSize(620, self._theme.px(HEIGHT_PX))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        color, scale = self._theme.color, self._theme.text_scale
        ground, word, remedy, body, sign = BANDS[self.status_light.rank]
        painter.fillRect(self.rect(), color(ground))
        size = 36 * scale
        icon = QRectF(34, (self.height() - size) / 2, size, size)
        paint_state(
            painter,
            "open" if self.status_light.rank == "idle" else self.status_light.rank,
            icon,
            color(body),
            color(sign),
        )
        left = icon.right() + 18
        room = QRectF(left, 4, self.width() - left - 12, self.height() - 8)
        for (text, face, place), ink in zip(self._place_lines(room), (word, remedy), strict=True):
            painter.setFont(face)
            painter.setPen(color(ink))
            painter.drawText(place, WRAP_FLAG, text)

    def _place_lines(self, room: QRectF) -> list[tuple[str, QFont, QRectF]]:
        """Place state and remedy on one line if they fit, else one above the other, shrunk to fit."""
        (state, large, _), (remedy, small, _) = above = self._stack_lines(room, 1.0)
        upper, lower = QFontMetricsF(large), QFontMetricsF(small)
        beside = upper.horizontalAdvance(state) + 18
        if beside + lower.horizontalAdvance(remedy) <= room.width():
            baseline = room.center().y() + 10 * self._theme.text_scale
            left = room.translated(0, baseline - upper.ascent() - room.top())
            return [(state, large, left), (remedy, small, left.translated(beside, upper.ascent() - lower.ascent()))]
        for share in TEXT_SHARES:
            if all(room.contains(place) for *_, place in above):
                break
            above = self._stack_lines(room, share)
        return above

    def _stack_lines(self, room: QRectF, share: float) -> list[tuple[str, QFont, QRectF]]:
        """Place both lines one above the other in the middle, at ``share`` of their size."""
        placed, size = [], share * self._theme.text_scale
        for text, face in (
            (self.status_light.state, font(28 * size, SEMIBOLD)),
            (self.status_light.remedy, font(20 * size, MEDIUM)),
        ):
            placed.append((text, face, QFontMetricsF(face).boundingRect(room, WRAP_FLAG, text)))
        (*_, upper), (*_, lower) = placed
        upper.moveTop(room.center().y() - (upper.height() + lower.height()) / 2)
        lower.moveTop(upper.bottom())
        return placed

"""Buttons that show their mnemonic and shortcut."""

from __future__ import annotations

from typing import Literal

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QHelpEvent, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QApplication, QPushButton, QSizePolicy, QToolTip, QWidget

from carpus.ui.kit.fonts import MEDIUM, SEMIBOLD, font
from carpus.ui.kit.icons import paint_icon
from carpus.ui.kit.keys import key_name
from carpus.ui.kit.theme import CONTROL_RADIUS_PX, Theme

ButtonKind = Literal["primary", "plain", "quiet", "well"]
EnterAction = Literal["press", "pass", "nothing"]
MIN_PADDING_PX = 6
HEIGHT_PX = {"primary": 52, "plain": 44, "quiet": 44, "well": 40}


class Button(QPushButton):
    """Button of a kind: ``primary`` (one per screen), ``plain``, ``quiet`` without outline, ``well`` filled and small.

    ``icon`` is a line icon before the text, ``hint`` the key beside it; a mnemonic (&) is underlined.
    """

    def __init__(
        self,
        theme: Theme,
        text: str = "",
        kind: ButtonKind = "plain",
        *,
        icon: str = "",
        hint: str = "",
        height_px: int = 0,
    ) -> None:
        super().__init__(text)
        self._theme, self._kind, self._icon, self._key = theme, kind, icon, hint
        # What Enter does while the button has the keyboard; ``pass`` leaves it to the dialog or screen.
        self.on_enter: EnterAction = "press"
        self.height_px = height_px or HEIGHT_PX[kind]
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setSizePolicy(QSizePolicy.Policy.Minimum, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(text.replace("&", ""))
        self.setAutoDefault(False)
        theme.changed.connect(self._apply_theme)
        application = QApplication.instance()
        if isinstance(application, QApplication):
            application.focusChanged.connect(self._update_key_hint)

    def _update_key_hint(self, *_: object) -> None:
        if self._key == ENTER_KEY:
            self.update()

    @property
    def key(self) -> str:
        return self._key

    @property
    def visible_key(self) -> str:
        return "" if self._key == ENTER_KEY and not is_enter_target(self) else self._key

    @property
    def _hint(self) -> str:
        """The key's name on the person's keyboard; its room stays while it is not written."""
        return key_name(self._key)

    def set_label(self, text: str, *, icon: str | None = None, hint: str | None = None) -> None:
        icon = self._icon if icon is None else icon
        key = self._key if hint is None else hint
        if (text, icon, key) != (self.text(), self._icon, self._key):
            self._icon, self._key = icon, key
            self.setText(text)
            self.setAccessibleName(text.replace("&", ""))
            self._apply_theme()

    def _apply_theme(self) -> None:
        self.updateGeometry()
        self.update()

    def _text_font(self) -> QFont:
        big = self._kind == "primary" and self.height_px >= 50
        return font((16 if big else 14) * self._theme.text_scale, SEMIBOLD)

    def _hint_font(self) -> QFont:
        return font(12 * self._theme.text_scale, MEDIUM)

    @property
    def _words(self) -> str:
        return self.text().replace("&&", "\0").replace("&", "").replace("\0", "&")

    def _parts_px(self) -> tuple[float, float, float]:
        shown = self._words
        text = QFontMetricsF(self._text_font()).horizontalAdvance(shown) if shown else 0.0
        icon = float(self._theme.px(18)) if self._icon else 0.0
        hint = QFontMetricsF(self._hint_font()).horizontalAdvance(self._hint) if self._hint else 0.0
        return icon, text, hint

    def sizeHint(self) -> QSize:
        icon, text, hint = self._parts_px()
        gaps = (8 if icon and text else 0) + (12 if hint else 0)
        pad = 11 if not text else 16 if self._kind != "primary" else 20
        return QSize(round(icon + text + hint + gaps + 2 * pad), self._theme.px(self.height_px))

    def minimumSizeHint(self) -> QSize:
        """Return the size without the key's name, which is omitted first."""
        hint = self._parts_px()[2]
        return self.sizeHint() - QSize(round(hint + 12) if hint else 0, 0)

    @property
    def visible_text(self) -> str:
        """The part of the text that fits; a tooltip has the rest."""
        icon, text, _ = self._parts_px()
        room = self.width() - icon - (8 if icon and text else 0) - 2 * MIN_PADDING_PX
        if text <= room:
            return self.text()
        return QFontMetricsF(self._text_font()).elidedText(self._words, Qt.TextElideMode.ElideRight, room)

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and not self.toolTip() and self.visible_text != self.text():
            QToolTip.showText(event.globalPos(), self._words, self)
            return True
        return super().event(event)

    def _colors(self) -> tuple[QColor, QColor, QColor | None, QColor]:
        color = self._theme.color
        if self._kind == "primary":
            if not self.isEnabled():
                return color("sunken"), color("text2"), color("line"), color("text2")
            body = "accent_pressed" if self.isDown() else "accent_hover" if self.underMouse() else "accent"
            return color(body), color("on_accent"), None, color("on_accent")
        body = "sunken" if self.isDown() or self.isChecked() else "canvas" if self.underMouse() else "surface"
        text = "text" if self.isEnabled() else "border" if self._kind == "quiet" else "text2"
        if self._kind == "quiet":
            clear = QColor(0, 0, 0, 0)
            lit = self.isDown() or self.underMouse() or self.isChecked()
            return (color("sunken") if lit else clear), color(text), None, color("text2")
        if self._kind == "well" and self.isChecked():
            return color("soft"), color(text), color("accent"), color("text2")
        if self._kind == "well":
            return color("sunken"), color(text), color("border"), color("text2")
        return color(body), color(text), color("border" if self.isEnabled() else "line"), color("text2")

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Press on Enter as on the space bar; Qt does so in dialogs only."""
        if is_enter_key(event):
            event.setAccepted(self.on_enter != "pass")
            if self.on_enter == "press":
                self.click()
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        body, text_color, outline, hint_color = self._colors()
        box = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.setPen(QPen(outline, 1) if outline is not None else Qt.PenStyle.NoPen)
        painter.setBrush(body)
        painter.drawRoundedRect(box, CONTROL_RADIUS_PX, CONTROL_RADIUS_PX)
        icon, text, hint = self._parts_px()
        gap_icon, gap_hint = (8.0 if icon and text else 0.0), (12.0 if hint else 0.0)
        if icon + text + hint + gap_icon + gap_hint > self.width() - 2 * MIN_PADDING_PX:
            hint = gap_hint = 0.0
        words = self.visible_text
        if words != self.text():
            text = QFontMetricsF(self._text_font()).horizontalAdvance(words)
        left = max(float(MIN_PADDING_PX), (self.width() - icon - text - hint - gap_icon - gap_hint) / 2)
        middle = self.height() / 2
        if self._icon:
            paint_icon(
                painter,
                self._icon,
                QRectF(QPointF(left, middle - icon / 2), QPointF(left + icon, middle + icon / 2)),
                text_color,
            )
        left += icon + gap_icon
        painter.setFont(self._text_font())
        painter.setPen(text_color)
        flags = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft | Qt.TextFlag.TextShowMnemonic
        painter.drawText(QRectF(left, 0, text + 4, self.height()), int(flags), words)
        if hint and self.visible_key:
            painter.setFont(self._hint_font())
            painter.setPen(hint_color)
            painter.drawText(
                QRectF(left + text + gap_hint, 0, hint + 4, self.height()),
                int(Qt.AlignmentFlag.AlignVCenter),
                self._hint,
            )


def icon_button(theme: Theme, icon: str, name: str, kind: ButtonKind = "quiet") -> Button:
    """Return a 40 px square button without text; its name is tooltip and accessible name."""
    button = Button(theme, "", kind, icon=icon, height_px=40)
    button.setToolTip(name)
    button.setAccessibleName(name)
    return button


# The key hint of a default button.
ENTER_KEY = "Enter"


def is_enter_key(event: QKeyEvent) -> bool:
    """Return whether Enter was pressed on either key block, alone or with Ctrl."""
    left_alone = Qt.KeyboardModifier.KeypadModifier | Qt.KeyboardModifier.ControlModifier
    return not event.modifiers() & ~left_alone and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)


def is_enter_handler(widget: QWidget | None) -> bool:
    """Return whether a widget keeps Enter to itself, as buttons do."""
    return isinstance(widget, QPushButton) and getattr(widget, "on_enter", "press") != "pass"


def is_enter_target(button: QPushButton) -> bool:
    """Return whether Enter would press a default button now."""
    now: QWidget | None = button.window().focusWidget()
    return button.isEnabled() and (now is button or not is_enter_handler(now))


def press_default(button: QPushButton | None) -> bool:
    """Press the default button; return False if there is none that can be pressed."""
    if button is None or not button.isVisible() or not button.isEnabled():
        return False
    button.click()
    return True

"""Labels in the sizes of the design that follow theme and text scale."""

from __future__ import annotations

import math
from html import escape

from PySide6.QtCore import QEvent, QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFont, QFontMetricsF, QHelpEvent, QPainter, QPaintEvent, QPalette, QShowEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QToolTip, QWidget

from carpus.ui.kit.fonts import DISPLAY_FAMILY, MEDIUM, REGULAR, SEMIBOLD, font
from carpus.ui.kit.icons import State, paint_icon, paint_logo, paint_state
from carpus.ui.kit.theme import Theme

__all__ = [
    "MEDIUM",
    "REGULAR",
    "SEMIBOLD",
    "Icon",
    "PlainText",
    "StateText",
    "Text",
    "caption",
    "heading",
    "paint_status",
]


class PlainText(QLabel):
    """Label with size, weight and colour token; plain text, so that nothing typed becomes markup.

    It overrides no method of Qt: pages and tables have hundreds.
    """

    def __init__(
        self,
        theme: Theme,
        text: str = "",
        size_px: float = 14,
        weight: int = REGULAR,
        token: str = "text",
        *,
        wrap: bool = False,
    ) -> None:
        super().__init__(text)
        self._theme, self._size_px, self._weight, self._token = theme, size_px, weight, token
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setWordWrap(wrap)
        if wrap:
            self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        theme.on_change(self, self._apply_theme)

    def _apply_theme(self) -> None:
        self.setFont(self._theme.font(self._size_px, self._weight))
        palette = self.palette()
        palette.setColor(QPalette.ColorRole.WindowText, self._theme.color(self._token))
        self.setPalette(palette)
        self._reserve_ascent()

    def _reserve_ascent(self) -> None:
        """Reserve room for Ä, Ö, Ü and È, which rise above the line of the display font."""
        top_px = 0
        if self.font().family() == DISPLAY_FAMILY and not self.text().isascii():
            metrics = QFontMetricsF(self.font())
            top_px = max(0, math.ceil(-metrics.tightBoundingRect(self.text()).top() - metrics.ascent()))
        if top_px != self.contentsMargins().top():
            self.setContentsMargins(0, top_px, 0, 0)


class Text(PlainText):
    """Label of a screen whose text may change; it elides, with the whole text as tooltip."""

    def setText(self, text: str) -> None:
        super().setText(text)
        self._reserve_ascent()

    def show_text(self, words: str) -> None:
        """Show a text; hide the label if it is empty."""
        self.setText(words)
        self.setVisible(bool(words))

    def set_style(self, token: str, weight: int) -> None:
        if (token, weight) != (self._token, self._weight):
            self._token, self._weight = token, weight
            self._apply_theme()

    def showEvent(self, event: QShowEvent) -> None:
        # A label that was not on a screen yet when the colours changed is given its old ones back by the style sheet.
        self._apply_theme()
        super().showEvent(event)

    # Qt gives an empty label another height than one with a word, and what lies below would move when the word comes.
    def sizeHint(self) -> QSize:
        return super().sizeHint() if self.text() else QSize(super().sizeHint().width(), self._line_px())

    def minimumSizeHint(self) -> QSize:
        return super().minimumSizeHint() if self.text() else QSize(super().minimumSizeHint().width(), self._line_px())

    def heightForWidth(self, width: int) -> int:
        return super().heightForWidth(width) if self.text() or not self.wordWrap() else self._line_px()

    @property
    def visible_text(self) -> str:
        """The part of a single line that fits."""
        if self.wordWrap() or "\n" in self.text():
            return self.text()
        words = self.text().replace("&", "") if self.buddy() is not None else self.text()
        room = self.contentsRect().width() + 2
        if self.fontMetrics().horizontalAdvance(words) <= room:
            return self.text()
        return self.fontMetrics().elidedText(words, Qt.TextElideMode.ElideRight, room)

    def paintEvent(self, event: QPaintEvent) -> None:
        words = self.visible_text
        if words == self.text():
            super().paintEvent(event)
            return
        painter = QPainter(self)
        painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
        painter.drawText(self.contentsRect(), self.alignment().value, words)

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and not self.toolTip() and self.visible_text != self.text():
            QToolTip.showText(event.globalPos(), self.text(), self)
            return True
        return super().event(event)

    def _line_px(self) -> int:
        return self.fontMetrics().boundingRect(QRect(0, 0, 1000, 1000), 0, "x").height()


class ElidedText(Text):
    """One line that asks for no room and is elided at its end."""

    def __init__(
        self, theme: Theme, text: str = "", size_px: int = 14, weight: int = REGULAR, token: str = "text"
    ) -> None:
        super().__init__(theme, text, size_px, weight, token)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)

    @property
    def visible_text(self) -> str:
        return self.fontMetrics().elidedText(self.text(), Qt.TextElideMode.ElideRight, self.width())


def heading(theme: Theme, text: str = "", *, wrap: bool = False) -> Text:
    """Return the 28 px title of a page."""
    return Text(theme, text, 28, SEMIBOLD, wrap=wrap)


def caption(theme: Theme, text: str = "", *, wrap: bool = False) -> Text:
    """Return small secondary text."""
    return Text(theme, text, 12, MEDIUM, "text2", wrap=wrap)


STATE_TOKENS: dict[State, str] = {
    "good": "good", "warn": "warn", "bad": "bad", "open": "border", "partly": "warn", "predicted": "border",
    "none": "text2",
}  # fmt: skip


def paint_status(painter: QPainter, theme: Theme, state: State, box: QRectF) -> None:
    """Paint a state icon in its colours."""
    paint_state(painter, state, box, theme.color(STATE_TOKENS[state]), theme.color("surface"))


class StateText(QWidget):
    """State icon or line icon with its text; emits ``resized`` when it needs other room."""

    resized = Signal()

    def __init__(self, theme: Theme, size_px: int = 14, weight: int = MEDIUM, icon_px: int = 18) -> None:
        super().__init__()
        self._theme, self._size_px, self._weight, self._icon_px = theme, size_px, weight, icon_px
        self._state: State = "none"
        self._icon = ""
        self._text = ""
        self._token = "text2"
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self._resize)

    def show_state(self, state: State, text: str, icon: str = "", token: str = "text2") -> None:
        """Show a state and its text; ``icon`` replaces the state's icon by a line icon."""
        if (state, text, icon, token) != (self._state, self._text, self._icon, self._token):
            self._state, self._text, self._icon, self._token = state, text, icon, token
            self.setAccessibleName(text)
            self._resize()

    def text(self) -> str:
        return self._text

    @property
    def state(self) -> State:
        return self._state

    def _resize(self) -> None:
        metrics = QFontMetricsF(self._font())
        icon = self._theme.px(self._icon_px) + (8 if self._text else 0) if self._has_icon() else 0
        width = int(icon + metrics.horizontalAdvance(self._text)) + (2 if self._text else 0)
        high = int(max(icon, metrics.height(), 20)) + 4 if self._text else icon + 2  # a sign alone needs no line
        self.setFixedSize(max(width, 1), max(high, 1))
        self.setVisible(bool(self._text) or self._has_icon())
        self.update()
        self.resized.emit()

    def _has_icon(self) -> bool:
        return self._state != "none" or bool(self._icon)

    def _font(self) -> QFont:
        return font(self._size_px * self._theme.text_scale, self._weight)

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        size = self._theme.px(self._icon_px)
        box = QRectF(0, (self.height() - size) / 2, size, size)
        left = 0.0
        if self._has_icon():
            if self._state != "none":
                paint_status(painter, self._theme, self._state, box)
            else:
                paint_icon(painter, self._icon, box, self._theme.color(self._token))
            left = size + 8.0
        painter.setFont(self._font())
        painter.setPen(self._theme.color(self._token))
        painter.drawText(QRectF(left, 0, self.width() - left, self.height()), Qt.AlignmentFlag.AlignVCenter, self._text)


class Icon(QWidget):
    """State icon or line icon without text.

    It is ``size_px`` large, centred in the height of ``box_px``, and placed in its width by ``alignment`` (0 to 1).
    """

    def __init__(
        self, theme: Theme, name: str, size_px: int = 18, box_px: tuple[int, int] = (20, 20), token: str = "accent",
        alignment: float = 0.0,
    ) -> None:  # fmt: skip
        super().__init__()
        self._theme, self._box_px, self._alignment = theme, box_px, alignment
        self.show_icon(name, token, size_px)
        theme.on_change(self, self._apply_theme)

    def show_icon(self, name: str, token: str = "accent", size_px: int = 18) -> None:
        """Show another icon; ``token`` colours a line icon, a state has its own colour."""
        self._name, self._token, self._size_px = name, token, size_px
        self.update()

    def _apply_theme(self) -> None:
        self.setFixedSize(*(self._theme.px(side) for side in self._box_px))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, size = QPainter(self), self._theme.px(self._size_px)
        box = QRectF((self.width() - size) * self._alignment, (self.height() - size) / 2, size, size)
        if self._name == "carpus":
            paint_logo(painter, box, self._theme.color(self._token))
        elif self._name == "chosen":
            paint_state(painter, "good", box, self._theme.color("accent"), self._theme.color("on_accent"))
        elif self._name in STATE_TOKENS:
            paint_status(painter, self._theme, self._name, box)
        else:
            paint_icon(painter, self._name, box, self._theme.color(self._token))


def plain_tooltip(text: str) -> str:
    """Return a text as a tooltip that shows it literally; Qt would interpret its tags."""
    return f"<span>{escape(text)}</span>" if "<" in text else text

"""Cards and surfaces, separators, progress bars, and the row of key caps."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRect, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPalette, QPen, QShowEvent
from PySide6.QtWidgets import QProgressBar, QSizePolicy, QWidget

from carpus.ui.kit.keys import key_name
from carpus.ui.kit.layouts import FittedWidget, column_layout
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, Text
from carpus.ui.kit.theme import CARD_PADDING_PX, CARD_RADIUS_PX, Theme


def paint_card(painter: QPainter, theme: Theme, box: QRectF) -> QRectF:
    """Paint the surface of a card and return the rectangle of its outline."""
    frame = box.adjusted(0.5, 0.5, -0.5, -0.5)
    painter.setPen(QPen(theme.color("line"), 1.0))
    painter.setBrush(theme.color("surface"))
    painter.drawRoundedRect(frame, CARD_RADIUS_PX, CARD_RADIUS_PX)
    return frame


class Surface(QWidget):
    """Plain ground in the colour of a token; the application's style sheet paints it."""

    def __init__(self, theme: Theme, fill: str = "surface", edge: str = "", bottom_edge: str = "") -> None:
        """Set the tokens of the ground, of the outline, and of a line at the lower end."""
        super().__init__()
        self._theme = theme
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("under", bottom_edge)
        self.set_colors(fill, edge)

    def set_colors(self, fill: str, edge: str = "", edge_px: float = 1.0) -> None:
        for name, value in (("fill", fill), ("edge", edge), ("thick", edge_px > 1.0)):
            self.setProperty(name, value)
        self.style().unpolish(self)
        self.style().polish(self)


class Card(Surface):
    """Rounded surface with a 1 px outline and a vertical layout, ``body``."""

    def __init__(
        self, theme: Theme, padding_px: int = CARD_PADDING_PX, fill: str = "surface", edge: str = "line"
    ) -> None:
        super().__init__(theme, fill, edge)
        self.body = column_layout(gap=8, margins=(padding_px, padding_px, padding_px, padding_px), parent=self)

    def add_heading(self, title: str, words: str = "") -> None:
        """Add a title, and an explanation below it."""
        self.body.addWidget(Text(self._theme, title, 20, SEMIBOLD))
        if words:
            self.body.addWidget(Text(self._theme, words, 14, REGULAR, "text2", wrap=True))


class ColorFill(QWidget):
    """Rectangle in the colour of a token, on paper too, where no style sheet applies."""

    def __init__(self, theme: Theme, token: str) -> None:
        super().__init__()
        self._theme, self._token = theme, token
        self.setAutoFillBackground(True)
        theme.on_change(self, self._apply_theme)

    def _apply_theme(self) -> None:
        palette = self.palette()
        palette.setColor(QPalette.ColorRole.Window, self._theme.color(self._token))
        self.setPalette(palette)

    def showEvent(self, event: QShowEvent) -> None:
        self._apply_theme()  # the style sheet gives one that was hidden while the colours changed its old ones back
        super().showEvent(event)


class Separator(ColorFill):
    """Separator, one pixel wide on the screen."""

    def __init__(self, theme: Theme, *, vertical: bool = False) -> None:
        super().__init__(theme, "line")
        if vertical:
            self.setFixedWidth(theme.line_px)
        else:
            self.setFixedHeight(theme.line_px)


def progress_bar(name: str) -> QProgressBar:
    """Return a thin progress bar; the application's style sheet paints it."""
    bar = QProgressBar(textVisible=False)
    bar.setAccessibleName(name)
    return bar


SPACE_PX, BETWEEN_PX = 7, 16


class KeyCaps(FittedWidget):
    """Keys and what they do in one line, such as ``[("Space", "accept"), ...]``."""

    def __init__(self, theme: Theme, keys: Sequence[tuple[str, str]]) -> None:
        super().__init__()
        self._theme = theme
        self._keys: tuple[tuple[str, str], ...] = ()
        self._pairs: list[tuple[QWidget, Text]] = []
        self.set_keys(keys)
        self.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        theme.changed.connect(self._fit)

    def set_keys(self, keys: Sequence[tuple[str, str]]) -> None:
        if self._keys == tuple(keys):
            return
        for part in (part for pair in self._pairs for part in pair):
            part.setParent(None)
            part.deleteLater()
        self._keys, self._pairs = tuple(keys), []
        for name, words in keys:
            cap, said = Surface(self._theme, "surface", "border"), Text(self._theme, words, 12, MEDIUM, "text2")
            inside = column_layout(margins=(6, 0, 6, 0), parent=cap)
            inside.addWidget(Text(self._theme, key_name(name), 12, MEDIUM), 0, Qt.AlignmentFlag.AlignCenter)
            for part in (cap, said):
                part.setParent(self)
            self._pairs.append((cap, said))
        self._fit()

    def _places(self) -> list[tuple[int, int, int]]:
        places, left = [], 0
        for cap, said in self._pairs:
            words = left + cap.sizeHint().width() + SPACE_PX
            places.append((left, words, words + said.sizeHint().width()))
            left = places[-1][2] + BETWEEN_PX
        return places

    def _fit(self) -> None:
        self.updateGeometry()
        height = self.height()
        for (cap, said), (left, words, end) in zip(self._pairs, self._places(), strict=True):
            cap.setGeometry(QRect(left, 1, words - SPACE_PX - left, height - 2))
            said.setGeometry(QRect(words, 0, end - words, height))
            for part in (cap, said):
                part.setVisible(end <= self.width() + 1)  # else left out whole; the help names every key

    def minimumSizeHint(self) -> QSize:
        return QSize(0, self.sizeHint().height())

    def sizeHint(self) -> QSize:
        places = self._places()
        high = max((said.sizeHint().height() for _, said in self._pairs), default=0)
        return QSize(places[-1][2] if places else 0, high + 8)

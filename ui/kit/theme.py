"""Design tokens: colours of both themes, sizes and spacing. No other module names a colour."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QColor, QFont

from carpus.ui.kit.fonts import font

if TYPE_CHECKING:  # a page that is painted alone loads no widgets
    from PySide6.QtWidgets import QWidget

ThemeName = Literal["light", "dark"]
TEXT_SCALES = (1.0, 1.25, 1.5)


@dataclass(frozen=True, slots=True)
class Tokens:
    """Colours of one theme as hex; a test checks contrast and colour vision."""

    canvas: str
    surface: str
    sunken: str
    norm: str
    line: str
    border: str
    text: str
    text2: str
    accent: str
    on_accent: str
    soft: str
    good: str
    good_soft: str
    warn: str
    warn_soft: str
    bad: str
    bad_soft: str
    band_warn: str
    on_band_warn: str
    band_bad: str
    on_band_bad: str
    # Of the wrist's curves; fingers, paths and other curves take the same three colours.
    flexion: str
    deviation: str
    rotation: str
    accent_hover: str
    accent_pressed: str


LIGHT = Tokens(
    canvas="#F4F6F5", surface="#FFFFFF", sunken="#EAEEED", norm="#E3E9E7", line="#D8DFDD", border="#7A8885",
    text="#16201E", text2="#4F5D5A", accent="#0B6B6E", on_accent="#FFFFFF", soft="#DCEEEE",
    good="#1B7340", good_soft="#E1F2E7", warn="#8A5200", warn_soft="#FBECD2", bad="#B1221A", bad_soft="#FBE5E2",
    band_warn="#F6BC46", on_band_warn="#2A1B00", band_bad="#B1221A", on_band_bad="#FFFFFF",
    flexion="#1560B8", deviation="#B85300", rotation="#3D3D46", accent_hover="#095E61", accent_pressed="#074F52",
)  # fmt: skip
DARK = Tokens(
    canvas="#12171A", surface="#1B2226", sunken="#252E33", norm="#2B353A", line="#333E44", border="#7F8F95",
    text="#E9EEEE", text2="#A9B6B9", accent="#57BFC1", on_accent="#062223", soft="#173A3D",
    good="#6CC992", good_soft="#173626", warn="#F0B65A", warn_soft="#3C2E14", bad="#FF8A80", bad_soft="#43201E",
    band_warn="#F0B65A", on_band_warn="#2A1B00", band_bad="#D2363A", on_band_bad="#FFFFFF",
    flexion="#5AA2F5", deviation="#F59A3C", rotation="#E6E6E6", accent_hover="#6BCACC", accent_pressed="#85D5D6",
)  # fmt: skip

CURVE_TOKENS = ("deviation", "flexion", "rotation")
"""Colours of the curves of deviation, flexion and pronation-supination."""
ON_PICTURE_LINE = "#FFFFFF"
ON_PICTURE_PARTLY = "#F0B65A"
ON_PICTURE_WRONG = "#FF7A6E"
ON_PICTURE_PROPOSED = "#7FE3E4"
ON_PICTURE_LABEL = "#0B1214"
"""Colours over a camera frame are the same in both themes, with a black halo behind every line."""

MARGIN_PX = 24
GAP_PX = 16
CARD_PADDING_PX = 16
CARD_RADIUS_PX = 10
CONTROL_RADIUS_PX = 8
FOCUS_OUTSIDE_PX = 3
DIM_ALPHA = {"light": 110, "dark": 170}
"""Opacity, of 255, of the black over a screen under a dialog."""
BAND_ALPHA = 95
MIN_ROOMY_SIZE_PX = (1000, 620)
"""A smaller screen, in text-scaled pixels, shows fewer things instead of cut ones."""


class Theme(QObject):
    """The chosen tokens and text scale.

    Signals: ``palette_changed`` comes first and updates the application's palette and style sheet, ``changed`` then
    tells each widget to take its colours and sizes.
    """

    line_px = 1
    """Width of a separator."""
    palette_changed = Signal()
    changed = Signal()

    def __init__(self, name: ThemeName = "light", text_scale: float = 1.0) -> None:
        super().__init__()
        self.name: ThemeName = name
        self.text_scale = text_scale

    @property
    def tokens(self) -> Tokens:
        """Tokens of the chosen theme."""
        return LIGHT if self.name == "light" else DARK

    def choose(self, name: ThemeName | None = None, text_scale: float | None = None) -> None:
        """Set theme, text scale or both; signal only if something changed."""
        before = self.name, self.text_scale
        self.name = name or self.name
        self.text_scale = text_scale or self.text_scale
        if (self.name, self.text_scale) == before:
            return
        self.palette_changed.emit()
        self.changed.emit()

    def on_change(self, widget: QObject, callback: Callable[[], None]) -> None:
        """Call ``callback`` now and after each change as long as ``widget`` exists."""
        callback()
        connection = self.changed.connect(callback)
        widget.destroyed.connect(lambda: QObject.disconnect(connection))

    def color(self, token: str, alpha: int = 255) -> QColor:
        """Return the colour of a token, such as ``theme.color("text2")``."""
        value = QColor(getattr(self.tokens, token))
        value.setAlpha(alpha)
        return value

    def font(self, size_px: float, weight: int) -> QFont:
        """Return the font for a design size, scaled."""
        return font(size_px * self.text_scale, weight)

    def px(self, size: float) -> int:
        """Return a length that grows with the text, in whole pixels."""
        return round(size * self.text_scale)


def is_tight(screen: QWidget, theme: Theme) -> bool:
    """Return whether the text is too large for everything to fit on the screen."""
    width, height = MIN_ROOMY_SIZE_PX
    return screen.width() < width * theme.text_scale or screen.height() < height * theme.text_scale

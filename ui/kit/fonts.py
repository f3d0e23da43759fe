"""The bundled typeface. Figures are tabular in the files themselves (resources/fonts/make_fonts.py)."""

from __future__ import annotations

from importlib.resources import files

from PySide6.QtCore import QByteArray
from PySide6.QtGui import QFont, QFontDatabase, QFontInfo

TEXT_FAMILY = "Carpus Inter"
DISPLAY_FAMILY = "Carpus Inter Display"
DISPLAY_FROM_PX = 28
REGULAR, MEDIUM, SEMIBOLD = 400, 500, 600


_CHECKED_SIZES_PX = (*range(11, 25), 28, 32, 44)
_loaded: list[str] = []


def load_fonts() -> tuple[str, ...]:
    """Register the bundled faces with Qt; the families found. Needs a QGuiApplication; costs next to nothing twice, and
    does it again where Qt has forgotten them: it has been seen, after many minutes, to draw single sizes in the
    system's face and to keep to that. Registering drops what it keeps, so that it looks again."""
    if _loaded and all(
        _is_available(size_px, weight) for size_px in _CHECKED_SIZES_PX for weight in (REGULAR, MEDIUM, SEMIBOLD)
    ):
        return tuple(_loaded)
    families: set[str] = set()
    for entry in sorted(files("carpus.resources").joinpath("fonts").iterdir(), key=lambda item: item.name):
        if entry.name.endswith(".otf"):
            number = QFontDatabase.addApplicationFontFromData(QByteArray(entry.read_bytes()))
            families.update(QFontDatabase.applicationFontFamilies(number))
    _loaded[:] = sorted(families)
    return tuple(_loaded)


def _is_available(size_px: int, weight: int) -> bool:
    asked = font(size_px, weight)
    return QFontInfo(asked).family() == asked.family()


def font(size_px: float, weight: int = REGULAR, *, display: bool | None = None) -> QFont:
    """The face for a size already scaled: the display cut from 28 px up, or as told where a pixel is not a pixel."""
    if display is None:
        display = size_px >= DISPLAY_FROM_PX
    face = QFont(DISPLAY_FAMILY if display else TEXT_FAMILY)
    if display:
        weight = max(weight, MEDIUM)
    face.setPixelSize(max(1, round(size_px)))
    face.setWeight(QFont.Weight(weight))
    face.setHintingPreference(QFont.HintingPreference.PreferVerticalHinting)
    return face

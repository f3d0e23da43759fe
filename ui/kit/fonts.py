"""The bundled typeface; its digits are tabular (resources/fonts/make_fonts.py)."""

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
    """Register the bundled fonts with Qt and return their families.

    Needs a QGuiApplication. Call it again where Qt may have forgotten a font: after many minutes it has drawn single
    sizes in the system's font and kept to that. Registering clears its cache.
    """
    faces = (font(size_px, weight) for size_px in _CHECKED_SIZES_PX for weight in (REGULAR, MEDIUM, SEMIBOLD))
    if _loaded and all(QFontInfo(face).family() == face.family() for face in faces):
        return tuple(_loaded)
    families: set[str] = set()
    for entry in sorted(files("carpus.resources").joinpath("fonts").iterdir(), key=lambda item: item.name):
        if entry.name.endswith(".otf"):
            number = QFontDatabase.addApplicationFontFromData(QByteArray(entry.read_bytes()))
            families.update(QFontDatabase.applicationFontFamilies(number))
    _loaded[:] = sorted(families)
    return tuple(_loaded)


def font(size_px: float, weight: int = REGULAR, *, display: bool | None = None) -> QFont:
    """Return the font for a scaled size in pixels; the display cut from 28 px up unless ``display`` says otherwise."""
    if display is None:
        display = size_px >= DISPLAY_FROM_PX
    face = QFont(DISPLAY_FAMILY if display else TEXT_FAMILY)
    if display:
        weight = max(weight, MEDIUM)
    face.setPixelSize(max(1, round(size_px)))
    face.setWeight(QFont.Weight(weight))
    face.setHintingPreference(QFont.HintingPreference.PreferVerticalHinting)
    return face

"""Every icon that is named is there, draws something, and takes the colour asked for; none lies about unused."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QImage, QPainter

from carpus.ui.kit.icons import paint_state

ROOT = Path(__file__).parents[2]
ICONS = sorted(path.stem for path in (ROOT / "resources" / "icons").glob("*.svg"))


def inked(paint) -> np.ndarray:  # type: ignore[no-untyped-def]
    image = QImage(48, 48, QImage.Format.Format_RGBA8888)
    image.fill(0)
    painter = QPainter(image)
    paint(painter)
    painter.end()
    return np.frombuffer(image.constBits(), np.uint8).reshape(48, 48, 4).copy()


def test_state_icons_differ_in_shape_not_only_in_colour() -> None:
    white, black = QColor("#FFFFFF"), QColor("#000000")
    shapes = {
        state: inked(lambda painter, state=state: paint_state(painter, state, QRectF(0, 0, 48, 48), black, white))[
            ..., 3
        ]
        > 128  # type: ignore[arg-type]
        for state in ("good", "warn", "bad", "open", "partly", "predicted")
    }
    names = list(shapes)
    for i, one in enumerate(names):
        for other in names[i + 1 :]:
            assert np.mean(shapes[one] != shapes[other]) > 0.02, (one, other)


def test_icons_are_all_used() -> None:
    code = "\n".join(path.read_text(encoding="utf-8") for part in ("ui", "app") for path in (ROOT / part).rglob("*.py"))
    unused = [name for name in ICONS if not re.search(rf'"{name}"', code) and not name.endswith(("-light", "-dark"))]
    assert not unused

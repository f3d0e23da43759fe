"""Parts of every screen: background work, fields, icons, and the palette's contrast and colour differences, recomputed
from the hex values (WCAG 2, CIE76 under Machado 2009); and where window and file dialogs come up."""

from __future__ import annotations

import gc
import itertools
import re
import threading
import weakref
from pathlib import Path

import cv2
import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, QRect, QRectF, Qt, QThread
from PySide6.QtGui import QColor, QImage, QPainter, QWheelEvent
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from carpus.ui.kit.background import Background
from carpus.ui.kit.field import Combo
from carpus.ui.kit.icons import paint_state
from carpus.ui.kit.theme import DARK, LIGHT, Tokens
from carpus.ui.shell.recent_locations import (
    TITLE_BAR_PX,
    RecentLocations,
    encode_geometry,
    fit_on_screen,
    restore_window,
)


def test_background_work_answers_in_the_window_s_thread(qtbot: QtBot) -> None:
    background = Background()
    window, seen = QThread.currentThread(), []
    worker: list[int] = []

    def work() -> int:
        worker.append(threading.get_ident())
        return 7

    background.run(work, lambda value: seen.append((value, QThread.currentThread() is window)), seen.append)
    background.run(lambda: 1 / 0, seen.append, lambda fault: seen.append(type(fault)))
    qtbot.waitUntil(lambda: len(seen) == 2)
    assert seen == [(7, True), ZeroDivisionError]
    assert worker[0] != threading.get_ident()
    assert not background.is_busy


@pytest.mark.parametrize("fails", [False, True])
def test_background_releases_answered_callers(qtbot: QtBot, background: Background, *, fails: bool) -> None:
    """A window that stands open for days asks ten thousand times."""

    def ask() -> weakref.ref[Asks]:
        asks = Asks()
        background.run(lambda: 1 // (not fails), asks.take, asks.take)
        qtbot.waitUntil(lambda: asks.answered is not None)
        assert isinstance(asks.answered, ZeroDivisionError if fails else int)
        return weakref.ref(asks)

    kept = ask()

    def is_gone() -> bool:
        gc.collect()
        return kept() is None

    qtbot.waitUntil(is_gone)


class Asks:
    answered: object = None

    def take(self, answer: object) -> None:
        self.answered = answer


def turned(field: QWidget) -> bool:
    """Whether a field takes a turn of the wheel over it."""
    turn = QWheelEvent(
        QPointF(5, 5), field.mapToGlobal(QPointF(5, 5)), QPoint(), QPoint(0, -120), Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(field, turn)
    return turn.isAccepted()


def test_wheel_chooses_nothing_in_list_of_choices(qtbot: QtBot) -> None:
    choice = Combo()
    choice.set_choices([(1, "one"), (2, "two")])
    qtbot.addWidget(choice)
    choice.show()
    choice.setFocus()
    assert not turned(choice)
    assert choice.currentIndex() == 0


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


MACHADO_2009 = {
    "normal": np.eye(3),
    "protan": np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    "deutan": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    "tritan": np.array(
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
    ),
}
TEXT_PAIRS = [
    ("text", "surface"), ("text", "soft"), ("text", "canvas"), ("text2", "surface"), ("text2", "sunken"),
    ("text2", "soft"), ("text2", "canvas"), ("accent", "surface"), ("accent", "canvas"), ("accent", "soft"),
    ("on_accent", "accent"),
    ("on_accent", "accent_hover"), ("on_accent", "accent_pressed"), ("good", "surface"), ("good", "good_soft"),
    ("warn", "surface"), ("warn", "warn_soft"), ("bad", "surface"), ("bad", "bad_soft"),
    ("on_band_warn", "band_warn"), ("on_band_bad", "band_bad"),
]  # fmt: skip
PART_PAIRS = [("border", "surface"), ("border", "canvas"), ("flexion", "surface"), ("deviation", "surface"),
              ("rotation", "surface"), ("flexion", "soft"), ("deviation", "soft")]  # fmt: skip


def linear(hex_color: str) -> np.ndarray:
    value = np.array([int(hex_color[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def contrast(first: str, second: str) -> float:
    light = sorted((float(linear(color) @ (0.2126, 0.7152, 0.0722)) for color in (first, second)), reverse=True)
    return (light[0] + 0.05) / (light[1] + 0.05)


def lab(hex_color: str, eye: str) -> np.ndarray:
    seen = np.clip(MACHADO_2009[eye] @ linear(hex_color), 0.0, 1.0)
    return np.asarray(cv2.cvtColor(seen.astype(np.float32).reshape(1, 1, 3), cv2.COLOR_LRGB2LAB)).reshape(3)


@pytest.mark.parametrize("tokens", [LIGHT, DARK], ids=["light", "dark"])
@pytest.mark.parametrize(("pairs", "least"), [(TEXT_PAIRS, 4.5), (PART_PAIRS, 3.0)], ids=["text", "parts"])
def test_theme_contrast_is_sufficient(tokens: Tokens, pairs: list[tuple[str, str]], least: float) -> None:
    for front, back in pairs:
        assert contrast(getattr(tokens, front), getattr(tokens, back)) >= least, (front, back)


@pytest.mark.parametrize(("tokens", "least", "least_of_bands"), [(LIGHT, 31.0, 42.0), (DARK, 44.0, 22.0)])
@pytest.mark.parametrize("eye", list(MACHADO_2009))
def test_theme_curves_and_bands_differ_with_colour_vision_deficiency(
    tokens: Tokens, least: float, least_of_bands: float, eye: str
) -> None:
    curves, bands = (
        (tokens.flexion, tokens.deviation, tokens.rotation),
        (tokens.good_soft, tokens.band_warn, tokens.band_bad),
    )
    for colors, apart in ((curves, least), (bands, least_of_bands)):
        assert (
            min(float(np.linalg.norm(a - b)) for a, b in itertools.combinations([lab(one, eye) for one in colors], 2))
            >= apart
        )


ROOM = QRect(0, 0, 1280, 800)


@pytest.mark.parametrize(
    ("place", "whole"),
    [
        (QRect(0, 0, 1280, 800), False), (QRect(-300, 700, 1100, 700), True), (QRect(5000, 5000, 1024, 700), True),
        (QRect(100, 60, 1024, 700), True), (QRect(0, 0, 3000, 2000), False),
    ],
)  # fmt: skip
def test_window_position_stays_on_screen(place: QRect, whole: bool) -> None:
    fits, kept_size = fit_on_screen(place, ROOM)
    assert ROOM.adjusted(0, TITLE_BAR_PX, 0, 0).contains(fits)
    assert kept_size == whole


def test_window_remembers_its_place(qtbot: QtBot) -> None:
    first, second = QWidget(), QWidget()
    for window in (first, second):
        qtbot.addWidget(window)
    first.setGeometry(40, 60, 500, 400)
    restore_window(second, encode_geometry(first))
    assert second.size() == first.size()
    restore_window(second, "not a place")
    assert second.size() == first.size()


def test_recent_locations_are_kept_per_kind_until_missing(tmp_path: Path) -> None:
    places = RecentLocations(tmp_path)
    for kind in ("reports", "recordings"):
        (tmp_path / kind).mkdir()
        places.save(kind, str(tmp_path / kind))  # type: ignore[arg-type]
    again = RecentLocations(tmp_path)
    assert again.folder("reports") == str(tmp_path / "reports")
    assert again.folder("recordings") == str(tmp_path / "recordings")
    (tmp_path / "reports").rmdir()
    assert again.folder("reports") != str(tmp_path / "reports")

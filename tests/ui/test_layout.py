"""No word is cut and nothing overlaps: on every screen at 1280x800 with text at 150 %; on the main ones at 1024x700 as
well, which leaves less room than 1280x800; where a sign may stand over the screen also at 1280x720, with text at 150 %
and the sign.

Found by geometry: of the widgets, and of every text as it is painted.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QLocale, QSize
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QApplication, QLabel, QWidget

from carpus.ui.kit import language
from carpus.ui.screens.markers.screen import MarkersScreen
from carpus.ui.screens.review.screen import ReviewScreen
from carpus.ui.words import terms
from tests.ui import pseudo
from tests.ui.fakes import WHY
from tests.ui.gallery import STATES, Gallery
from tests.ui.geometry import complaints, letter_of, lettered, shown_texts

LARGE, SMALL = ((1280, 800), 1.5), ((1024, 700), 1.0)
"""On the main screens the text is large first, so that it also grows small again: each change costs as much as a
screen, and of what is gone before it, it costs nothing."""
MAIN = (
    "patients", "patients_welcome", "exercise_hand", "camera", "markers_clicking", "markers_ready", "markers_proposed",
    "live", "live_hand", "live_marker_hidden", "review", "review_hand", "correct", "progress",
    "progress_hand", "report", "report_hand", "settings", "sessions_list", "help",
    "board_showing", "board_result", "card",
)  # fmt: skip
"""Where little room has a layout of its own, or is what nearly everybody sees."""
LOW = ((1280, 720), 1.5)
SIGNED = ("markers", "live", "review", "exercise")
"""What may have a sign over it, or as little room."""
SIGN = "Simulated hand: not Linden 42, excluded from analysis."
FAKED = (
    "Right hand", "Left hand", "Camera", "Sessions", "Review", "Report", "Progress", "Measure", "Markers", "Exercise",
    "30 fps", "Space for 212 min", "Saved", "Splint off", "Flexion", "No camera",
)  # fmt: skip
"""What the gallery's fakes say themselves."""

TRANSLATED: list[dict[str, set[str]]] = []
"""Of each language but English what stands for a text, on whichever screen."""
for _file in sorted((Path(__file__).parents[2] / "resources" / "translations").glob("*.ts")):
    TRANSLATED.append({})
    for (_, _text), _said in language.parse_texts(_file.read_bytes()).items():
        TRANSLATED[-1].setdefault(_text, set()).add(_said)
PICTURES: dict[tuple[tuple[int, int], float], QSize] = {}
"""Size of the picture on the markers screen."""


@pytest.fixture(scope="module")
def gallery(qapp: QApplication) -> Iterator[Gallery]:
    QLocale.setDefault(QLocale(QLocale.Language.English, QLocale.Country.UnitedKingdom))
    shown = Gallery(qapp, "light", (1280, 800))
    yield shown
    shown.close()


@pytest.mark.parametrize("state", STATES)
def test_layout_has_no_cut_or_overlap(gallery: Gallery, state: str) -> None:
    order = [LARGE, SMALL] if state in MAIN else [LARGE]
    gallery.theme.choose(text_scale=order[0][1])  # before there is a screen: it costs nothing
    gallery.show_state(state)
    found = {}
    texts = lettered(gallery.shell)
    for said in ({}, *TRANSLATED):
        shown = [said.get(text, {text}) for text in texts]
        letters = Counter(letter_of(*one) for one in shown if len(one) == 1)  # else it is said otherwise elsewhere
        assert not [letter for letter, count in letters.items() if count > 1], texts
    if state in MAIN and state.startswith(SIGNED):
        order.append(LOW)
    for size, scale in order:
        gallery.shell.banner.show_lines([SIGN] if (size, scale) == LOW else [])
        gallery.theme.choose(text_scale=scale)
        gallery.shell.resize(*size)
        gallery.settle()
        assert gallery.shell.size().toTuple() == size
        found[size, scale] = complaints(gallery.shell)
        screen = gallery.shell.screen_stack.currentWidget()
        if isinstance(screen, MarkersScreen):  # whatever is said beside it, it stays where it is under the cursor
            assert screen.picture.size() == PICTURES.setdefault((size, scale), screen.picture.size())
        if isinstance(screen, ReviewScreen):  # fitted once more, its tables stay as high as they are
            fitted_px = screen.card.tables.height()
            screen._fit()
            gallery.settle()
            assert screen.card.tables.height() == fitted_px
    gallery.shell.banner.show_lines([])
    gallery.show(QWidget())
    gallery.shell.resize(1280, 800)
    assert not any(found.values()), found


LONG = (
    "patients", "exercise", "camera", "markers_ready", "live", "review", "progress", "settings", "sessions_list",
    "by_hand",
)  # fmt: skip
"""Looked at in the lengthened language too; ``python -m tests.ui.pseudo`` looks at all."""
OWN_WORDS = re.compile(
    r"^(Carpus|MCP|PIP|DIP|CMC|TIP|TAM|PRWE|English|Deutsch|Italiano|~/.*)$|\.(c3d|csv|mot|trc)\b|"
    r"\b[A-Z][a-z]+ \d\d\b|[a-z]\.? \d\d?:|Nov|Okt|2026|" + "|".join(why[:16] for why, _ in WHY.values())
)
"""Names, days and abbreviations, which are no language's."""


def test_layout_in_longer_language_is_complete(qapp: QApplication) -> None:
    """The texts of the gallery's own fakes stay English: what they say is listed in the gallery."""
    with pseudo.spoken():
        shown = Gallery(qapp, "light", (1280, 800))
        found, english = {}, {}
        for state in LONG:
            shown.show_state(state)
            found[state] = complaints(shown.shell, may_elide=True)
            plain = {one for one in shown_texts(shown.shell) if not pseudo.is_pseudo(one) and not OWN_WORDS.search(one)}
            english[state] = {one for one in plain if one != terms.LEGAL_SENTENCE and not one.startswith(FAKED)}
        shown.close()
    assert not any(found.values()), found
    assert not any(english.values()), english


class Painted(QWidget):
    """Paints words where it is told."""

    def __init__(self, host: QWidget, *words: tuple[int, int, str]) -> None:
        super().__init__(host)
        self._words = words

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802
        painter = QPainter(self)
        for x, y, text in self._words:
            painter.drawText(x, y, text)


def test_layout_check_detects_defects(qapp: QApplication) -> None:
    """The test of the test: cut, over each other, reaching out, crossing."""
    host = QWidget()
    host.resize(400, 200)
    label = QLabel("as long as it is cut", host)
    label.setGeometry(10, 10, 40, 20)
    Painted(host, (10, 20, "one over"), (14, 22, "another")).setGeometry(100, 10, 200, 40)
    Painted(host, (10, 20, "out")).setGeometry(380, 100, 60, 40)
    for x in (20, 60):
        Painted(host).setGeometry(x, 100, 60, 40)
    host.show()
    found = "\n".join(complaints(host))
    for said in ("cut: 'as long", "over: 'one over' and 'another'", "outside:", "crossing:"):
        assert said in found
    host.close()

"""The question which blue spot a marker is, at the foot of the live picture: answered while measuring goes on."""

from __future__ import annotations

import math

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QHBoxLayout, QWidget

from carpus.core.types import FloatArray
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card
from carpus.ui.controls.text import Text
from carpus.ui.fonts import SEMIBOLD
from carpus.ui.keys import Keys
from carpus.ui.live.doubt import Chosen, Doubt, lower_name
from carpus.ui.picture.overlay import haloed
from carpus.ui.picture.photo import label_size, paint_label
from carpus.ui.picture.view import PictureView
from carpus.ui.theme import DARK, Theme
from carpus.ui.translate import tr

AWAY_PX = 12
RING_PX = 15.0
SETTLES_S = 0.5
"""A question that has only just come takes no answer: the key was meant for something else."""


class SpotQuestion(Card):
    """Stands over the picture while a :class:`Doubt` with another spot is open; ``chosen`` says what is answered."""

    chosen = Signal(str)

    def __init__(self, picture: QWidget, theme: Theme, keys: Keys) -> None:
        super().__init__(theme, 12, "surface", "warn")
        self._keys, self._picture = keys, picture
        self.setParent(picture)
        self.set_colors("surface", "warn", 2.0)
        self.setProperty("floats", True)  # over the picture, which goes on under it
        self.doubt: Doubt | None = None
        self._since_s = math.nan
        self._at_top = False
        self.words = Text(theme, "", 16, SEMIBOLD)
        self.buttons: dict[Chosen, Button] = {
            name: Button(theme, "", height_px=36) for name in ("disc", "spot", "none")
        }
        row = QHBoxLayout()
        row.setSpacing(8)
        for name, button in self.buttons.items():
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
            button.clicked.connect(lambda _=False, name=name: self.chosen.emit(name))
            row.addWidget(button)
        row.addStretch(1)
        self.body.addWidget(self.words)
        self.body.addLayout(row)
        self.hide()

    def ask(self, doubt: Doubt | None, now_s: float, picture: PictureView) -> bool:
        """Show a question, or none; whether it is another than before. ``now_s`` in the recording's own time."""
        if doubt is not None and not doubt.has_spot:
            doubt = None
        before, self.doubt = self.doubt, doubt
        same = before is not None and doubt is not None and self._key(before) == self._key(doubt)
        if same or (before is None and doubt is None):
            return False
        if doubt is None:
            self.hide()
            return True
        self._since_s = now_s
        self._set_faces(doubt)
        self._at_top = self._would_cover(doubt, picture)
        self.place()
        self.show()
        self.raise_()
        return True

    def takes_answers(self, now_s: float) -> bool:
        """Whether the question has stood long enough to be what an answer means."""
        return self.doubt is not None and now_s - self._since_s >= SETTLES_S - 1e-9

    def key_of(self, name: str) -> Chosen | None:
        """What the key of an action answers now, None for nothing."""
        if self.doubt is None:
            return None
        told: dict[str, Chosen] = {"answer_none": "none"}
        told |= {"answer_first": "spot"} if self.doubt.hidden else {"answer_first": "disc", "answer_second": "spot"}
        return told.get(name)

    def place(self) -> None:
        """At the foot of the picture, or at its head where the foot shows what is asked about."""
        host = self._picture
        width = host.width() - 2 * AWAY_PX
        height = self.sizeHint().height()
        top = AWAY_PX if self._at_top else host.height() - AWAY_PX - height
        self.setGeometry(AWAY_PX, top, width, height)

    @staticmethod
    def _key(doubt: Doubt) -> tuple[str, bool]:
        return doubt.marker, doubt.hidden

    def _set_faces(self, doubt: Doubt) -> None:
        name = lower_name(doubt.marker)
        if doubt.hidden:
            self.words.setText(self.tr("Is this blue spot the {marker}?").format(marker=name))
            faces = {"spot": (self.tr("Yes"), "answer_first"), "none": (self.tr("No"), "answer_none")}
        else:
            self.words.setText(self.tr("Which one is the {marker}?").format(marker=name))
            faces = {
                "disc": (self.tr("Disc 1"), "answer_first"),
                "spot": (self.tr("Spot 2"), "answer_second"),
                "none": (self.tr("Neither"), "answer_none"),
            }
        for which, button in self.buttons.items():
            button.setVisible(which in faces)
            if which in faces:
                words, key = faces[which]
                button.set_face(words, hint=self._keys[key])

    def _would_cover(self, doubt: Doubt, picture: PictureView) -> bool:
        foot_px = picture.height() - 2 * AWAY_PX - self.sizeHint().height() - RING_PX
        return any(
            math.isfinite(place[0]) and picture.to_screen(float(place[0]), float(place[1])).y() > foot_px
            for place in (doubt.disc_px, doubt.spot_px)
        )


def paint_question(painter: QPainter, theme: Theme, doubt: Doubt, picture: PictureView) -> None:
    """Rings about what is asked about, numbered where there are two."""
    words = tr("Another blue spot")
    _ring(painter, theme, picture, doubt.spot_px, words if doubt.hidden else f"2 · {words}", beside=True)
    if not doubt.hidden:
        _ring(painter, theme, picture, doubt.disc_px, "1", beside=False)


def _ring(
    painter: QPainter, theme: Theme, picture: PictureView, place: FloatArray, words: str, *, beside: bool
) -> None:
    """A ring with words to the right of it or, where the picture ends, above; else below."""
    at = picture.to_screen(float(place[0]), float(place[1]))
    radius = RING_PX * theme.text_scale
    haloed(painter, DARK.warn, 2.5, lambda: painter.drawEllipse(at, radius, radius))
    size = label_size(theme, words)
    left, top = at.x() + radius + 6, at.y() - size.height() / 2
    if not beside:
        left, top = at.x() - size.width() / 2, at.y() + radius + 5
    elif left + size.width() > picture.width() - 8:
        left, top = at.x() - size.width() / 2, at.y() - radius - 5 - size.height()
    most_left = picture.width() - 8 - size.width()
    paint_label(painter, theme, words, max(8.0, min(left, most_left)), max(8.0, top))

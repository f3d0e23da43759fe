"""The question which blue spot is a marker, at the foot of the live frame."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt, Signal
from PySide6.QtGui import QPainter, QShortcut
from PySide6.QtWidgets import QWidget

from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card
from carpus.ui.kit.fonts import SEMIBOLD
from carpus.ui.kit.keys import KEYS, bind_key
from carpus.ui.kit.layouts import fill, grid_layout
from carpus.ui.kit.text import Text
from carpus.ui.kit.theme import DARK, Theme
from carpus.ui.kit.translate import tr
from carpus.ui.picture.overlay import draw_with_halo
from carpus.ui.picture.photo import label_size, paint_label
from carpus.ui.picture.view import FrameView
from carpus.ui.screens.live.marker_doubt import Choice, MarkerDoubt, SteadyDoubt, marker_in_sentence

EDGE_PX, PADDING_PX, GAP_PX = 12, 12, 8
RING_PX = 15.0
ANSWER_DELAY_S = 0.5
"""A new question takes no key this long: the key was meant for something else."""


class MarkerQuestion(Card):
    """Card over the frame while a :class:`MarkerDoubt` with another spot is open.

    ``answered`` carries the :class:`MarkerLabel`, ``changed`` tells of another question or none. Its keys are bound
    on ``host``; ``get_time_s`` returns the time of the recording.
    """

    answered = Signal(object)
    changed = Signal()

    def __init__(self, picture: FrameView, theme: Theme, host: QWidget, get_time_s: Callable[[], float]) -> None:
        super().__init__(theme, PADDING_PX, "surface", "warn")
        self._picture = picture
        self._steady = SteadyDoubt()
        self.open_doubt: MarkerDoubt | None = None
        """The doubt, also if there is nothing to choose."""
        self.host_shortcuts: Sequence[QShortcut] = ()
        """Shortcuts of the host, disabled while a question uses their keys."""
        self._get_time_s = get_time_s
        self.setParent(picture)
        self.set_colors("surface", "warn", 2.0)
        self.setProperty("floats", True)  # over the picture, which goes on under it
        self.asked_doubt: MarkerDoubt | None = None
        """The doubt that is asked about."""
        self._shown_at_s = math.nan
        self._is_at_top = False
        self.words = Text(theme, "", 16, SEMIBOLD, wrap=True)
        self.buttons: dict[Choice, Button] = {
            name: Button(theme, "", height_px=32) for name in ("disc", "spot", "none")
        }
        self._grid = grid_layout(GAP_PX, GAP_PX)
        for name, button in self.buttons.items():
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
            button.clicked.connect(lambda _=False, name=name: self.answer(name))
        self._grid.setColumnStretch(len(self.buttons), 1)
        fill(self.body, self.words, self._grid)
        self.hide()
        names = ("answer_first", "answer_second", "answer_none")
        self._answer_keys = {name: bind_key(host, name, partial(self._answer_by_key, name)) for name in names}
        self._enable_keys()

    def update_doubt(self, doubt: MarkerDoubt | None) -> MarkerDoubt | None:
        self.open_doubt = self._steady.update(doubt, self._get_time_s())
        self._show_question(self.open_doubt)
        return self.open_doubt

    def withdraw(self) -> None:
        self._steady.clear()
        self.open_doubt = None
        self._show_question(None)

    def _show_question(self, doubt: MarkerDoubt | None) -> None:
        if doubt is not None and not doubt.has_other:
            doubt = None
        before, self.asked_doubt = self.asked_doubt, doubt
        same = before is not None and doubt is not None and self._question_key(before) == self._question_key(doubt)
        if same or (before is None and doubt is None):
            return
        if doubt is None:
            self.hide()
        else:
            self._shown_at_s = self._get_time_s()
            self._set_faces(doubt)
            self.reposition()
            self.show()
            self.raise_()
        self._enable_keys()
        self.changed.emit()

    def _enable_keys(self) -> None:
        armed = [key for name, key in self._answer_keys.items() if self.choice_for_key(name) is not None]
        for key in self._answer_keys.values():
            key.setEnabled(key in armed)
        for key in self.host_shortcuts:
            key.setEnabled(key.key() not in [one.key() for one in armed])

    def _answer_by_key(self, name: str) -> None:
        """Answer by key once the question has been shown long enough."""
        chosen = self.choice_for_key(name)
        if chosen is not None and self._get_time_s() - self._shown_at_s >= ANSWER_DELAY_S - 1e-9:
            self.answer(chosen)

    def answer(self, choice: Choice) -> None:
        """Close the question and emit the answer."""
        if self.asked_doubt is not None:
            answer = self.asked_doubt.answer(choice)
            self.withdraw()
            self._picture.update()
            self.answered.emit(answer)

    def choice_for_key(self, name: str) -> Choice | None:
        """Return the choice of a key, None for nothing."""
        if self.asked_doubt is None:
            return None
        told: dict[str, Choice] = {"answer_none": "none"}
        told |= (
            {"answer_first": "spot"}
            if self.asked_doubt.is_hidden
            else {"answer_first": "disc", "answer_second": "spot"}
        )
        return told.get(name)

    def reposition(self) -> None:
        """Place the card at the foot of the frame, or at its head if it would cover the question's spots."""
        host = self._picture
        width = host.width() - 2 * EDGE_PX
        self._arrange_buttons(width - 2 * PADDING_PX)
        height = self.body.totalHeightForWidth(width)
        if self.asked_doubt is not None:
            self._is_at_top = self._is_covering(self.asked_doubt, height)
        top = EDGE_PX if self._is_at_top else host.height() - EDGE_PX - height
        self.setGeometry(EDGE_PX, top, width, height)

    def _arrange_buttons(self, room_px: int) -> None:
        shown = [button for button in self.buttons.values() if not button.isHidden()]
        needed = sum(button.sizeHint().width() for button in shown) + GAP_PX * max(len(shown) - 1, 0)
        columns = len(shown) if needed <= room_px else 2
        for button in self.buttons.values():
            self._grid.removeWidget(button)
        for number, button in enumerate(shown):
            self._grid.addWidget(button, number // columns, number % columns)

    @staticmethod
    def _question_key(doubt: MarkerDoubt) -> tuple[str, bool]:
        return doubt.marker, doubt.is_hidden

    def _set_faces(self, doubt: MarkerDoubt) -> None:
        name = marker_in_sentence(doubt.marker)
        if doubt.is_hidden:
            self.words.setText(self.tr("Is this blue spot the {marker}?").format(marker=name))
            faces = {"spot": (self.tr("Yes"), "answer_first"), "none": (self.tr("No"), "answer_none")}
        else:
            self.words.setText(self.tr("Which one is the {marker}?").format(marker=name))
            faces = {
                "disc": (self.tr("Marker 1"), "answer_first"),
                "spot": (self.tr("Spot 2"), "answer_second"),
                "none": (self.tr("Neither"), "answer_none"),
            }
        for which, button in self.buttons.items():
            button.setVisible(which in faces)
            if which in faces:
                words, key = faces[which]
                button.set_label(words, hint=KEYS[key])

    def _is_covering(self, doubt: MarkerDoubt, height_px: int) -> bool:
        """Tell whether the card at the foot would cover the question's spots."""
        foot_px = self._picture.height() - 2 * EDGE_PX - height_px - RING_PX * self._theme.text_scale
        return any(
            math.isfinite(place[0]) and self._picture.to_screen(float(place[0]), float(place[1])).y() > foot_px
            for place in (doubt.assigned_px, doubt.other_px)
        )


def _place_plate(center: QPointF, direction: QPointF, radius: float, size: QSizeF) -> QRectF:
    """Return the place of a label beside a ring."""
    middle = (
        center
        + direction * (radius + 5.0)
        + QPointF(0.5 * size.width() * direction.x(), 0.5 * size.height() * direction.y())
    )
    return QRectF(QPointF(middle.x() - 0.5 * size.width(), middle.y() - 0.5 * size.height()), size)


def paint_question(painter: QPainter, theme: Theme, doubt: MarkerDoubt, picture: FrameView, covered: QRectF) -> None:
    """Paint rings around the question's spots, numbered if there are two.

    ``covered`` is the part of the frame under the card.
    """
    spot = picture.to_screen(float(doubt.other_px[0]), float(doubt.other_px[1]))
    if doubt.is_hidden:
        _paint_ring(painter, theme, picture, covered, spot, QPointF(1.0, 0.0), tr("Another blue spot"))
        return
    disc = picture.to_screen(float(doubt.assigned_px[0]), float(doubt.assigned_px[1]))
    away = spot - disc
    away /= math.hypot(away.x(), away.y()) or 1.0
    _paint_ring(painter, theme, picture, covered, disc, -away, "1")
    _paint_ring(painter, theme, picture, covered, spot, away, "2")


def _paint_ring(
    painter: QPainter,
    theme: Theme,
    picture: FrameView,
    covered: QRectF,
    center: QPointF,
    direction: QPointF,
    words: str,
) -> None:
    """Paint a ring with a label beside it."""
    radius = RING_PX * theme.text_scale
    draw_with_halo(painter, DARK.warn, 2.5, lambda: painter.drawEllipse(center, radius, radius))
    size = label_size(theme, words)
    plate = _place_plate(center, direction, radius, size)
    if plate.intersects(covered):
        plate = _place_plate(center, QPointF(1.0 if direction.x() >= 0.0 else -1.0, 0.0), radius, size)
    left, top = plate.left(), plate.top()
    if left + size.width() > picture.width() - 8:
        left, top = picture.width() - 8 - size.width(), center.y() - radius - 5 - size.height()
    paint_label(painter, theme, words, max(8.0, left), max(8.0, top))

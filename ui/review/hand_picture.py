"""A frame of a session as a picture of the hand alone, with the trained angle drawn on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QImage, QPainter
from PySide6.QtWidgets import QWidget

from carpus.core.hand.exercises import Exercise
from carpus.core.results.hand_cutout import DrawnAngle, cut_out, drawn_angle
from carpus.core.session.values import Session
from carpus.core.types import ByteImage
from carpus.ui.controls.button import Button, Tick
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.picture.convert import image_of
from carpus.ui.picture.overlay import ToScreen, haloed
from carpus.ui.picture.photo import paint_label
from carpus.ui.review.reviewed import Reviewed
from carpus.ui.theme import DARK, ON_PICTURE_LINE, Theme
from carpus.ui.translate import tr

ARC_SHARE = 0.55
"""Where the arc runs, as a part of the lines."""
MIN_SIDE_PX = 640
"""A small hand is shown larger, as far as whole multiples stay within this."""


@dataclass(frozen=True, slots=True)
class HandPicture:
    """Row of a session whose frame is wanted as a picture, and the words on it."""

    session: Session
    row: int
    exercise: Exercise
    words: str


def hand_picture(reviewed: Reviewed, row: int, time_s: float) -> HandPicture:
    """The picture of a row at a time; its words say so where the angle is not the patient's own."""
    words, figures = reviewed.angle_words(row), reviewed.figures
    if words and any(figures.repetitions[number].helped for number in reviewed.under(time_s)):
        words = tr("{angle}, passive").format(angle=words)
    if reviewed.session.header.simulated:
        words = " · ".join(filter(None, (words, tr("Simulated hand"))))
    return HandPicture(reviewed.session, row, figures.exercise, words)


def paint_angle(painter: QPainter, angle: DrawnAngle, to_screen: ToScreen) -> None:
    """Dashed where it is 0, a thick line where the hand stands, and the arc between them."""
    vertex, zero, hand = (to_screen(*map(float, point)) for point in (angle.vertex, angle.zero, angle.hand))
    haloed(painter, ON_PICTURE_LINE, 2.0, lambda: painter.drawLine(vertex, zero), dash=True)
    haloed(painter, DARK.curve_b, 4.0, lambda: painter.drawLine(vertex, hand))
    lines = [point - vertex for point in (zero, hand)]
    radius = ARC_SHARE * min(float(np.hypot(line.x(), line.y())) for line in lines)
    start, end = (float(np.degrees(np.arctan2(-line.y(), line.x()))) for line in lines)
    span = (end - start + 180.0) % 360.0 - 180.0
    box = QRectF(vertex.x() - radius, vertex.y() - radius, 2 * radius, 2 * radius)
    haloed(painter, DARK.curve_b, 2.0, lambda: painter.drawArc(box, round(16 * start), round(16 * span)))


def draw_hand_picture(theme: Theme, wanted: HandPicture, frame: ByteImage) -> QImage | None:
    """Draw the hand alone, its angle where that lies in the image plane, and the words; None without a hand."""
    found = cut_out(frame, wanted.session, wanted.row)
    if found is None:
        return None
    alone = image_of(found.image)
    scale = max(1, MIN_SIDE_PX // max(alone.width(), alone.height()))
    image = alone.scaled(alone.size() * scale, mode=Qt.TransformationMode.SmoothTransformation)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    angle = drawn_angle(wanted.session, wanted.row, wanted.exercise)
    if angle is not None:
        corner = QPointF(found.left_px - 0.5, found.top_px - 0.5)
        paint_angle(painter, angle, lambda u, v: (QPointF(u, v) - corner) * scale)
    if wanted.words:
        paint_label(painter, theme, wanted.words, 8, 8)
    painter.end()
    return image


class HandPictureSheet(Sheet):
    """Emits ``accepted`` once a person has ticked that the patient agrees."""

    accepted = Signal()

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        body = self.card.body
        words = self.tr(
            "The hand alone, with its angle: face and room are cut away, there is no name. Where the movement does not "
            "lie in the picture, the angle is said in words only."
        )
        self.head(self.tr("Picture of the hand"), words)
        words = self.tr("Whoever has the file can look at it: Carpus cannot protect it there. It is noted in the log.")
        body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        words = self.tr("The hand is not visible here, or its marker labels are doubtful. Choose another moment.")
        self._refused = Text(theme, words, 14, SEMIBOLD, "warn", wrap=True)
        body.addWidget(self._refused)
        self.agreed = Tick(theme, self.tr("The patient has agreed"))
        body.addWidget(self.agreed)
        self.take = Button(theme, self.tr("Save…"), "primary", height_px=44)
        self.close_button = self.answer_row(self.take)
        self.agreed.toggled.connect(self._check)
        self.take.clicked.connect(self._take)

    def begin(self, *, refused: bool = False) -> None:
        """Ask for the patient's agreement, each time again; a frame that shows no sure hand is ``refused``."""
        self._refused.setVisible(refused)
        self.agreed.setDisabled(refused)
        self.agreed.setChecked(False)
        self._check(False)
        self.open()

    def _check(self, agreed: bool) -> None:
        """Without agreement nothing is saved, and Enter saves nothing."""
        self.take.setEnabled(agreed)
        answer = self.take if agreed else self.close_button
        self.set_default(answer)
        if self.isVisible():
            answer.setFocus(Qt.FocusReason.OtherFocusReason)

    def _take(self) -> None:
        self.close_sheet()
        self.accepted.emit()

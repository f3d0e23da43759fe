"""Frame of a session as an image of the hand alone, with the trained angle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QImage, QPainter
from PySide6.QtWidgets import QCheckBox, QWidget

from carpus.core.model.hand.exercises import Exercise
from carpus.core.model.types import ByteImage
from carpus.core.results.hand_cutout import AngleOverlay, angle_overlay, cut_out_hand
from carpus.core.session.values import Session
from carpus.ui.kit.button import Button
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Text
from carpus.ui.kit.theme import DARK, ON_PICTURE_LINE, Theme
from carpus.ui.kit.translate import tr
from carpus.ui.picture.convert import to_qimage
from carpus.ui.picture.overlay import ToScreen, draw_with_halo
from carpus.ui.picture.photo import paint_label
from carpus.ui.screens.review.reviewed_session import ReviewedSession

# Radius of the arc as a share of the lines.
ARC_FRACTION = 0.55
# A small hand is enlarged by whole factors up to this size.
MIN_SIDE_PX = 640


@dataclass(frozen=True, slots=True)
class HandImage:
    """Frame of a session to be saved as an image, and the words on it."""

    session: Session
    row: int
    exercise: Exercise
    words: str


def build_hand_image(reviewed: ReviewedSession, row: int, time_s: float) -> HandImage:
    """Return the image of a frame; its words say if the movement was passive or simulated."""
    words, results = reviewed.angle_words(row), reviewed.results
    if words and any(results.repetitions[number].is_passive for number in reviewed.find_repetitions(time_s)):
        words = tr("{angle}, passive").format(angle=words)
    if reviewed.session.header.is_simulated:
        words = " · ".join(filter(None, (words, tr("Simulated hand"))))
    return HandImage(reviewed.session, row, results.exercise, words)


def paint_angle(painter: QPainter, angle: AngleOverlay, to_screen: ToScreen) -> None:
    """Paint a dashed line at zero, a thick one at the angle, and the arc between them."""
    vertex, zero, hand = (to_screen(*map(float, point)) for point in (angle.vertex, angle.zero, angle.hand))
    draw_with_halo(painter, ON_PICTURE_LINE, 2.0, lambda: painter.drawLine(vertex, zero), dash=True)
    draw_with_halo(painter, DARK.deviation, 4.0, lambda: painter.drawLine(vertex, hand))
    lines = [point - vertex for point in (zero, hand)]
    radius = ARC_FRACTION * min(float(np.hypot(line.x(), line.y())) for line in lines)
    start, end = (float(np.degrees(np.arctan2(-line.y(), line.x()))) for line in lines)
    span = (end - start + 180.0) % 360.0 - 180.0
    box = QRectF(vertex.x() - radius, vertex.y() - radius, 2 * radius, 2 * radius)
    draw_with_halo(painter, DARK.deviation, 2.0, lambda: painter.drawArc(box, round(16 * start), round(16 * span)))


def draw_hand_image(theme: Theme, hand_image: HandImage, frame: ByteImage) -> QImage | None:
    """Draw the hand with its angle and words; None without a visible hand."""
    found = cut_out_hand(frame, hand_image.session, hand_image.row)
    if found is None:
        return None
    alone = to_qimage(found.image)
    scale = max(1, MIN_SIDE_PX // max(alone.width(), alone.height()))
    image = alone.scaled(alone.size() * scale, mode=Qt.TransformationMode.SmoothTransformation)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    angle = angle_overlay(hand_image.session, hand_image.row, hand_image.exercise)
    if angle is not None:
        corner = QPointF(found.left_px - 0.5, found.top_px - 0.5)
        paint_angle(painter, angle, lambda u, v: (QPointF(u, v) - corner) * scale)
    if hand_image.words:
        paint_label(painter, theme, hand_image.words, 8, 8)
    painter.end()
    return image


class HandImageDialog(Dialog):
    """Emits ``accepted`` once the patient's consent is ticked."""

    accepted = Signal()

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        body = self.card.body
        words = self.tr(
            "The image shows only the hand and its angle. Face, room and name are removed. If the hand does not move "
            "in the image plane, the angle is only written, not drawn."
        )
        self.add_heading(self.tr("Image of the hand"), words)
        words = self.tr("Carpus cannot protect the saved file: anyone who has it can open it. The export is logged.")
        body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        words = self.tr("The hand is not visible here, or its marker labels are uncertain. Choose another moment.")
        self._refusal = Text(theme, words, 14, SEMIBOLD, "warn", wrap=True)
        body.addWidget(self._refusal)
        self.consent_check = QCheckBox(self.tr("The patient has agreed"))
        body.addWidget(self.consent_check)
        self.accept_button = Button(theme, self.tr("Save…"), "primary", height_px=44)
        self.close_button = self.add_buttons(self.accept_button)
        self.consent_check.toggled.connect(self._check)
        self.accept_button.clicked.connect(self._accept)

    def open_form(self, *, refused: bool = False) -> None:
        """Ask for consent, each time again; ``refused`` for a frame without a certain hand."""
        self._refusal.setVisible(refused)
        self.consent_check.setDisabled(refused)
        self.consent_check.setChecked(False)
        self._check(False)
        self.open()

    def _check(self, agreed: bool) -> None:
        """Without consent nothing can be saved, not even by Enter."""
        self.accept_button.setEnabled(agreed)
        answer = self.accept_button if agreed else self.close_button
        self.set_default(answer)
        if self.isVisible():
            answer.setFocus(Qt.FocusReason.OtherFocusReason)

    def _accept(self) -> None:
        self.close_dialog()
        self.accepted.emit()

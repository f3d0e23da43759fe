"""The angle on the picture, and a repetition as a film of the hand alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QImage, QPainter
from PySide6.QtWidgets import QWidget

from carpus.core.hand.exercises import Exercise
from carpus.core.results.hand_cutout import DrawnAngle, box_of, cut_out, drawn_angle
from carpus.core.session.values import Session
from carpus.core.types import ByteImage
from carpus.ui.controls.button import Button, Tick
from carpus.ui.controls.field import Choices
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Text
from carpus.ui.picture.convert import image_of
from carpus.ui.picture.overlay import ToScreen, haloed
from carpus.ui.picture.photo import paint_label
from carpus.ui.review.reviewed import Reviewed
from carpus.ui.theme import DARK, ON_PICTURE_LINE, Theme
from carpus.ui.translate import tr

SPEEDS = ((1.0, "1"), (0.5, "½"), (0.25, "¼"))
STILL = 0.0
"""In place of a speed: the picture at the cursor alone."""
ARC_SHARE = 0.55
"""Where the arc runs, as a part of the lines."""
LEAST_SIDE_PX = 640
"""A small hand is shown larger, as far as whole multiples stay within this."""


@dataclass(frozen=True, slots=True)
class FilmWanted:
    """One repetition to be written: rows of the session, pictures a second, and what is said on each row; 0 a second is
    one picture, not a film."""

    session: Session
    session_id: str
    number: int
    rows: Sequence[int]
    rate_hz: float
    exercise: Exercise
    words: Callable[[int], str]


def film_of(reviewed: Reviewed, number: int, row: int, factor: float) -> FilmWanted:
    """A repetition so many times as fast as it was, or with :data:`STILL` the picture of a row."""
    rows = range(row, row + 1) if factor == STILL else reviewed.rows_of(number)
    times, session, figures = reviewed.curves.time_s, reviewed.session, reviewed.figures
    rate_hz = factor * len(rows) / max(float(times[rows.stop - 1] - times[rows.start]), 1e-3)
    words = {row: reviewed.angle_words(row) for row in rows}
    if figures.repetitions[number].helped:  # it would pass for what the patient can do
        words = {row: said and tr("{angle}, passive").format(angle=said) for row, said in words.items()}
    if session.header.simulated:
        nobodys = tr("Simulated hand")
        words = {row: f"{said} · {nobodys}" if said else nobodys for row, said in words.items()}
    return FilmWanted(session, reviewed.id, number + 1, rows, rate_hz, figures.exercise, words.__getitem__)


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


def film_pictures(theme: Theme, wanted: FilmWanted, picture: Callable[[int], ByteImage | None]) -> Iterator[ByteImage]:
    """The pictures of a film: the hand alone, its angle where that lies in the picture, and the figure in words."""
    box = box_of(wanted.session, wanted.rows)
    larger = max(1, LEAST_SIDE_PX // max(box[2] - box[0], box[3] - box[1], 1))
    for row in wanted.rows:
        found = picture(row)
        if found is None or box[2] <= box[0]:
            continue
        alone = image_of(cut_out(found, wanted.session, row, box))
        image = alone.scaled(alone.size() * larger, mode=Qt.TransformationMode.SmoothTransformation)
        painter = QPainter(image)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        angle = drawn_angle(wanted.session, row, wanted.exercise)
        if angle is not None:
            place = lambda u, v: QPointF(u + 0.5 - box[0], v + 0.5 - box[1]) * larger  # noqa: E731
            paint_angle(painter, angle, place)
        if words := wanted.words(row):
            paint_label(painter, theme, words, 8, 8)
        painter.end()
        yield _array_of(image)


def _array_of(image: QImage) -> ByteImage:
    plain = image.convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(plain.constBits(), np.uint8).reshape(plain.height(), plain.bytesPerLine())
    return np.ascontiguousarray(rows[:, : 3 * plain.width()].reshape(plain.height(), plain.width(), 3))


class FilmSheet(Sheet):
    """``wanted`` carries how fast it shall be, once a person has ticked that the patient agrees."""

    wanted = Signal(float)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        body = self.card.body
        words = self.tr(
            "The hand alone, with its angle: face and room are cut away, there is no sound and no name. Where the "
            "movement does not lie in the picture, the angle is said in words only."
        )
        self.head(words=words)
        body.addWidget(Text(theme, self.tr("Speed"), 14, REGULAR, "text2"))
        self.speed = Choices(theme, [*SPEEDS, (STILL, self.tr("This picture only"))], 0.5)
        body.addWidget(self.speed)
        words = self.tr("Whoever has the file can watch it: Carpus cannot protect it there. It is noted in the log.")
        body.addWidget(Text(theme, words, 14, REGULAR, "text2", wrap=True))
        words = self.tr("Part of it is doubtful: another repetition ([ and ]) makes a film.")
        self._refused = Text(theme, words, 14, SEMIBOLD, "warn", wrap=True)
        body.addWidget(self._refused)
        self.agreed = Tick(theme, self.tr("The patient has agreed"))
        body.addWidget(self.agreed)
        self.take = Button(theme, self.tr("Save…"), "primary", height_px=44)
        self.close_button = self.answer_row(self.take)
        self.agreed.toggled.connect(self._check)
        self.take.clicked.connect(self._take)

    def begin(self, number: int, *, doubtful: bool = False) -> None:
        """Ask about a repetition, counted from 1; agreement is given anew each time. A ``doubtful`` one is refused."""
        self._refused.setVisible(doubtful)
        self.agreed.setDisabled(doubtful)
        self.title.setText(self.tr("Film of repetition {number}").format(number=number))
        self.agreed.setChecked(False)
        self._check(False)
        self.open()

    def _check(self, agreed: bool) -> None:
        """Without agreement there is no film, and Enter makes none."""
        self.take.setEnabled(agreed)
        answer = self.take if agreed else self.close_button
        self.set_default(answer)
        if self.isVisible():
            answer.setFocus(Qt.FocusReason.OtherFocusReason)

    def _take(self) -> None:
        self.close_sheet()
        self.wanted.emit(float(self.speed.value()))  # type: ignore[arg-type]

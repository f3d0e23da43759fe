"""Home exercise sheet: drawn exercises, the patient's progress and the next appointment, without degrees."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date, timedelta
from functools import partial
from typing import ClassVar

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen, QPolygonF, QTransform
from PySide6.QtWidgets import QLayout, QVBoxLayout

from carpus.core.model.hand.exercises import EXERCISES, PRONOSUPINATION, Exercise
from carpus.core.model.hand.forearm_rotation import from_clinical_targets_deg
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.model.types import Side
from carpus.core.records.values import HomePlan
from carpus.core.results.progress import Goals, compare_ranges, compute_progress, goal_measure
from carpus.core.results.session_results import SessionResults
from carpus.ui.charts.panel import draw_text
from carpus.ui.kit import language, numbers
from carpus.ui.kit.layouts import STRETCH, Part
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.kit.translate import to_mid_sentence, tr, translate_phrase
from carpus.ui.picture.hand_pose import build_pose, find_arc
from carpus.ui.report.page import (
    CHART,
    PAPER,
    UNIT,
    PaintedPart,
    RoundedBox,
    column,
    label,
    line,
    page_head,
    paragraph,
    rule,
    to_layout_units,
)
from carpus.ui.report.session_page import DerivedReport
from carpus.ui.words import terms
from carpus.ui.words.patient import task_words

MAX_TASKS, MAX_DAYS, DEFAULT_DAYS = 3, 7, 7
# Exercises of one angle.
DRAWABLE_EXERCISES = tuple(exercise for exercise in EXERCISES if exercise.has_repetitions)
REST_DEG, DRAWN_DEG = 0.0, 45.0
# Width of a picture, and its largest height.
PICTURE_PT, MAX_PICTURE_PT = 190.0, 180.0
MAX_NOTE_LENGTH = 160


@dataclass(frozen=True, slots=True)
class HomeTask:
    """One exercise with its repetitions and rounds a day."""

    exercise: Exercise
    times: int
    rounds: int


@dataclass(frozen=True, slots=True)
class HomeProgress:
    """Progress of one movement in signed degrees; drawn, never printed as a number. The goal may be NaN."""

    days: tuple[date, ...]
    values_deg: tuple[float, ...]
    goal_deg: float
    has_improved: bool


@dataclass(frozen=True, slots=True)
class HomeReport(DerivedReport):
    """Home exercise sheet; never with a diagnosis.

    ``next_appointment`` is None for a line to write on, ``appointment_time`` as it was typed; ``language`` is the
    patient's.
    """

    kind: ClassVar[Phrase] = phrase("home")
    tasks: tuple[HomeTask, ...]
    day: date
    next_appointment: date | None = None
    appointment_time: str = ""
    note: str = ""
    progress: HomeProgress | None = None
    language: str = ""

    @property
    def plan(self) -> HomePlan:
        """The plan as it is stored with the patient."""
        names, first = tuple(task.exercise.id for task in self.tasks), self.tasks[0]
        return HomePlan(
            names,
            first.times,
            first.rounds,
            self.day,
            self.next_appointment,
            self.appointment_time,
            self.note,
            self.language,
        )

    def head(self, number: str) -> QLayout:
        return _head(self, number)

    def pages(self) -> list[QVBoxLayout]:
        return [_page(self)]


def build_home_progress(
    results: SessionResults, history: Sequence[SessionResults], goals: Goals
) -> HomeProgress | None:
    """Return the progress to show: only comparable sessions, and only an improvement or a kept range."""
    exercise = results.exercise
    alike = [one for one in history if (one.exercise.id, one.side) == (exercise.id, results.side)]
    known = [one for one in alike if one.when <= results.when and one.session_id != results.session_id]
    fair = [point.results for point in compute_progress([*known, results]).points if point.is_comparable]
    rows = [(one, goal_measure(one, exercise, 1)) for one in fair]
    found = [(one, row) for one, row in rows if row is not None and row.count and not row.is_lower_bound]
    if len(found) < 2 or found[-1][0] is not results:
        return None
    change = compare_ranges(found[0][0], results, [found[-1][1]])
    if not change or change[0].verdict not in ("improved", "no_change"):
        return None
    since = [compare_ranges(one, results, [found[-1][1]]) for one, _ in found[1:-1]]
    if change[0].verdict == "no_change" and any(item.verdict == "worse" for items in since for item in items):
        return None  # what was reached in between is not held
    # Nothing of it is a number: the hand is drawn from where it lies, of the forearm from palm down.
    goal = from_clinical_targets_deg(goals.get((exercise.id, results.side), results.targets_deg), exercise)[0]
    values = tuple(from_clinical_targets_deg((row.mean, math.nan), exercise)[0] for _, row in found)
    return HomeProgress(tuple(one.when.date() for one, _ in found), values, goal, change[0].verdict == "improved")


def home_progress_words(progress: HomeProgress) -> str:
    """Return the sentence above the progress."""
    first, last, goal = progress.values_deg[0], progress.values_deg[-1], progress.goal_deg
    if not progress.has_improved:
        return tr("You have kept the progress you made.")
    if math.isfinite(goal) and last >= goal:
        return tr("You have reached our goal.")
    if math.isfinite(goal) and last - first > 0.5 * (goal - first):
        return tr("You are more than halfway to our goal.")
    return tr("You can move further than when you started.")


def _head(home: HomeReport, number: str) -> QLayout:
    patient = f"{home.pseudonym}, {to_mid_sentence(terms.hand_name(home.side))}"
    day = numbers.format_long_date(home.day)
    return page_head(day, number, tr("Hand exercises at home"), patient, home.printed_patient)


def _page(home: HomeReport) -> QVBoxLayout:
    tick = label(tr("Tick the box of the day when you have done all its exercises."), 8.5, REGULAR, "text2")
    parts: list[Part] = [_task(home, task, place) for place, task in enumerate(home.tasks, 1)]
    parts.append((tick, 0, Qt.AlignmentFlag.AlignRight))
    if home.progress is not None:
        parts.append(_progress_box(home, home.progress))
    pain = tr(
        "You may feel a stretch, but no pain. If your hand still hurts an hour later, do less next time and call us."
    )
    legal = paragraph(terms.LEGAL_SENTENCE, 7.0, REGULAR, "text2")
    return column(
        *parts, STRETCH, _appointment_box(home), column(paragraph(pain, 9.0, SEMIBOLD), legal, gap=3.0), gap=10.0
    )


def _task(home: HomeReport, task: HomeTask, number: int) -> QLayout:
    words = translate_phrase(task.exercise.instruction)
    if task.exercise.angle == PRONOSUPINATION:  # at home nobody looks for markers
        words = tr("Turn your palm up, then down. Keep your elbow at your side.")
    times = tr("once") if task.times == 1 else tr("{count} times").format(count=task.times)
    rounds = tr("once a day") if task.rounds == 1 else tr("{count} times a day").format(count=task.rounds)
    named = line(
        PaintedPart(partial(_paint_number, number), 18.0, width=18.0),
        7.0,
        (paragraph(task_words(task.exercise.id), 13.0, SEMIBOLD), 1),
    )
    often = column(paragraph(times, 13.0, SEMIBOLD, "accent"), paragraph(rounds, 10.0, SEMIBOLD))
    days = [
        column(
            (
                label(
                    language.locale().dayName(day.isoweekday(), language.locale().FormatType.ShortFormat),
                    7.5,
                    REGULAR,
                    "text2",
                ),
                0,
                Qt.AlignmentFlag.AlignHCenter,
            ),
            PaintedPart(_paint_tick_box, 19.0, width=19.0),
            gap=3.0,
        )
        for day in _days(home)
    ]
    asked = column(named, paragraph(words, 9.5), STRETCH, line((often, 1), *days, gap=4.0), gap=4.0)
    picture = PaintedPart(partial(_paint_exercise, task.exercise, home.side), 110.0, MAX_PICTURE_PT, PICTURE_PT)
    return line(picture, (asked, 1), gap=14.0)


def _progress_box(home: HomeReport, progress: HomeProgress) -> RoundedBox:
    """Return the hand at the start, today and at the goal, with the curve of the sessions."""
    key = tr("dashed: at the start; solid: today")
    if math.isfinite(progress.goal_deg):
        key = tr("dashed: at the start; solid: today; green: our goal")
    hands = PaintedPart(partial(_paint_progress_hands, home.report.results.exercise, home.side, progress), 80.0, 110.0)
    pictures = line((hands, 1), (PaintedPart(partial(_paint_progress_curve, progress), 80.0, 110.0), 1))
    return RoundedBox(
        paragraph(home_progress_words(progress), 12.5, SEMIBOLD),
        4.0,
        pictures,
        2.0,
        paragraph(key, 8.0, REGULAR, "text2"),
    )


def _appointment_box(home: HomeReport) -> QLayout:
    again: list[Part | float] = [paragraph(tr("Next appointment"), 9.5, MEDIUM), 4.0]
    if home.next_appointment is None:
        again += [18.0, rule()]
    else:
        again += [
            paragraph(numbers.format_long_date(home.next_appointment), 12.0, SEMIBOLD),
            3.0,
            paragraph(home.appointment_time, 12.0, SEMIBOLD),
        ]
    card = RoundedBox(*again, STRETCH, fill="soft")
    card.setFixedWidth(PAPER.px(PICTURE_PT))
    notes = column(paragraph(tr("Notes and questions for your next appointment"), 9.5, MEDIUM), gap=3.0)
    if home.note:
        notes.addWidget(paragraph(home.note, 9.5))
    notes.addWidget(PaintedPart(_paint_lines, 57.0), 1)
    return line(card, (notes, 1), gap=14.0)


def _days(home: HomeReport) -> list[date]:
    """Return the days from today to the day before the next appointment, a week at most."""
    count = DEFAULT_DAYS if home.next_appointment is None else (home.next_appointment - home.day).days
    return [home.day + timedelta(days=day) for day in range(min(max(count, 1), MAX_DAYS))]


def _paint_number(number: int, painter: QPainter, box: QRectF) -> None:
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(PAPER.color("accent"))
    painter.drawEllipse(box)
    draw_text(
        painter, box, str(number), PAPER.font(10.0, SEMIBOLD), PAPER.color("on_accent"), Qt.AlignmentFlag.AlignCenter
    )


def _paint_tick_box(painter: QPainter, box: QRectF) -> None:
    painter.setPen(QPen(PAPER.color("border"), 0.8 * UNIT))
    painter.drawRoundedRect(box.adjusted(2.0, 2.0, -2.0, -2.0), 4 * UNIT, 4 * UNIT)


def _paint_lines(painter: QPainter, box: QRectF) -> None:
    painter.setPen(QPen(PAPER.color("line"), 0.6 * UNIT))
    for y in range(PAPER.px(18.0), round(box.height()), PAPER.px(19.0)):
        painter.drawLine(QLineF(0.0, y, box.width(), y))


def _fit_transform(box: QRectF, side: Side, part: QRectF) -> QTransform:
    """Return the transform of a drawn hand into a box, mirrored for a left hand."""
    scale = min(box.width() / part.width(), box.height() / part.height())
    to = QTransform()
    to.translate(box.center().x(), box.center().y())
    to.scale(scale if side == "right" else -scale, scale)
    to.translate(-part.center().x(), -part.center().y())
    return to


def _visible_rect(exercise: Exercise, values_deg: Sequence[float]) -> QRectF:
    """Return the visible part of a drawing: the hands, and a piece of the forearm."""
    part = QRectF()
    for value in values_deg:
        part = part.united(build_pose(exercise, value).hand.boundingRect())
    arm = build_pose(exercise, 0.0).arm.boundingRect()
    piece = QRectF(-150.0, -60.0, 150.0, 120.0) if arm.width() > arm.height() else QRectF(-60.0, 0.0, 120.0, 150.0)
    return part.united(piece if not arm.isEmpty() else QRectF()).adjusted(-25, -25, 25, 25)


def _paint_exercise(exercise: Exercise, side: Side, painter: QPainter, box: QRectF) -> None:
    """Paint the hand at the start (dashed) and at the end, with a double arrow."""
    start, end = (-DRAWN_DEG, DRAWN_DEG) if exercise.angle is not None else (REST_DEG, 1.6 * DRAWN_DEG)
    if exercise.angle == 0 or exercise.joint.endswith("abduction"):
        start, end = 0.5 * start, 0.5 * end
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(PAPER.color("sunken"))
    painter.drawRoundedRect(box, 6 * UNIT, 6 * UNIT)
    painter.setClipRect(box)
    arc = find_arc(exercise)
    way = arc.path(0.75 * start, 0.75 * end)
    part = _visible_rect(exercise, (start, end)).united(way.boundingRect().adjusted(-20, -20, 20, 20))
    edge = 6 * UNIT
    to = _fit_transform(box.adjusted(edge, edge, -edge, -edge), side, part)
    for value, is_dashed in ((start, True), (end, False)):
        _paint_hand(painter, exercise, value, to, "border" if is_dashed else "text", is_dashed=is_dashed)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(PAPER.color("accent"), 2.2 * UNIT, c=Qt.PenCapStyle.RoundCap))
    painter.drawPath(to.map(way))
    for at, sense in ((0.75 * start, -1.0), (0.75 * end, 1.0)):
        _paint_arrow(painter, to.map(arc.point(at - 2.0 * sense)), to.map(arc.point(at + 6.0 * sense)))


def _paint_arrow(painter: QPainter, before: QPointF, tip: QPointF) -> None:
    along = tip - before
    along = along * (7.0 * UNIT / (math.hypot(along.x(), along.y()) or 1.0))
    across = QPointF(-along.y(), along.x()) * 0.6
    painter.setBrush(PAPER.color("accent"))
    painter.setPen(Qt.PenStyle.NoPen)
    painter.drawPolygon(QPolygonF([tip, tip - along + across, tip - along - across]))


def _paint_hand(
    painter: QPainter, exercise: Exercise, value_deg: float, transform: QTransform, token: str, *, is_dashed: bool,
    is_filled: bool = True,
) -> None:  # fmt: skip
    style = Qt.PenStyle.DashLine if is_dashed else Qt.PenStyle.SolidLine
    painter.setPen(QPen(PAPER.color(token), 1.1 * UNIT, style))
    is_solid, hand = is_filled and not is_dashed, build_pose(exercise, value_deg)
    painter.setBrush(PAPER.color("surface") if is_solid else Qt.BrushStyle.NoBrush)
    for path in (hand.hand_and_arm, *(hand.digits if is_solid else ())):
        painter.drawPath(transform.map(path))


def _paint_progress_hands(
    exercise: Exercise, side: Side, progress: HomeProgress, painter: QPainter, box: QRectF
) -> None:
    shown = [("border", progress.values_deg[0], True), ("text", progress.values_deg[-1], False)]
    if math.isfinite(progress.goal_deg):
        shown.insert(1, ("accent", progress.goal_deg, True))
    painter.setClipRect(box)
    to = _fit_transform(box, side, _visible_rect(exercise, [value for _, value, _ in shown]))
    for token, value, is_dashed in shown:
        _paint_hand(painter, exercise, value, to, token, is_dashed=is_dashed, is_filled=False)


def _paint_progress_curve(progress: HomeProgress, painter: QPainter, box: QRectF) -> None:
    area = box.adjusted(*to_layout_units(20.0, 8.0, -62.0, -20.0))
    values = [*progress.values_deg, *([progress.goal_deg] if math.isfinite(progress.goal_deg) else [])]
    low, high = min(0.0, *values), max(values)
    span = max((progress.days[-1] - progress.days[0]).days, 1)

    def place(day: date, value: float) -> QPointF:
        x = area.left() + area.width() * (day - progress.days[0]).days / span
        return QPointF(x, area.bottom() - area.height() * (value - low) / max(high - low, 1.0))

    shown = [place(day, value) for day, value in zip(progress.days, progress.values_deg, strict=True)]
    painter.setPen(QPen(PAPER.color("line"), 0.6 * UNIT))
    painter.drawLine(QLineF(area.left() - 16.0, area.bottom(), area.right() + 16.0, area.bottom()))
    painter.setPen(QPen(PAPER.color("flexion"), 1.8 * UNIT))
    painter.drawPolyline(QPolygonF(shown))
    painter.setBrush(PAPER.color("flexion"))
    for point in shown:
        painter.drawEllipse(point, 2.2 * UNIT, 2.2 * UNIT)
    aside, face = QPointF(8.0 * UNIT, 3.0 * UNIT), PAPER.font(9.0, SEMIBOLD)
    draw_text(painter, QPointF(area.right(), shown[-1].y()) + aside, tr("today"), face, PAPER.color("text"))
    if math.isfinite(progress.goal_deg):
        y = place(progress.days[0], progress.goal_deg).y()
        painter.setPen(QPen(PAPER.color("accent"), 1.4 * UNIT, Qt.PenStyle.DashLine))
        painter.drawLine(QLineF(area.left(), y, area.right(), y))
        if abs(y - shown[-1].y()) > 12 * UNIT:
            draw_text(painter, QPointF(area.right(), y) + aside, tr("our goal"), face, PAPER.color("accent"))
    days = area.adjusted(*to_layout_units(-4.0, 0.0, 4.0, 16.0))
    for day, side in ((progress.days[0], Qt.AlignmentFlag.AlignLeft), (progress.days[-1], Qt.AlignmentFlag.AlignRight)):
        words = numbers.format_day_month(day)
        draw_text(painter, days, words, CHART.label_font, PAPER.color("text2"), Qt.AlignmentFlag.AlignBottom | side)

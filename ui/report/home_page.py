"""The sheet to take home: exercises as drawn pictures, the own way so far, when to come again. One page, no degrees."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date, timedelta
from functools import partial

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen, QPolygonF, QTransform
from PySide6.QtWidgets import QLayout

from carpus.core.hand.exercises import EXERCISES, PRONOSUPINATION, Exercise
from carpus.core.hand.forearm_rotation import stored_targets_deg
from carpus.core.records.values import HomePlan
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import Goals, compare, progress, row_aimed_at
from carpus.core.types import Side
from carpus.ui import language, numbers, terms
from carpus.ui.controls.layouts import STRETCH, Part
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.patient.figure import arc_of, figure_at
from carpus.ui.patient.words import task_words
from carpus.ui.plot.style import write
from carpus.ui.report.page import (
    CHART,
    PAPER,
    UNIT,
    Body,
    PaintedPart,
    RoundedBox,
    column,
    label,
    line,
    page_head,
    paragraph,
    points,
    rule,
)
from carpus.ui.report.session_page import OfSession
from carpus.ui.translate import inside, say, tr

MOST_TASKS, MOST_DAYS, USUAL_DAYS = 3, 7, 7
DRAWN = tuple(exercise for exercise in EXERCISES if exercise.counts)
"""What can be drawn: exercises of one angle."""
REST_DEG, SHOWN_DEG = 0.0, 45.0
PICTURE_PT, TALLEST_PT = 190.0, 180.0
"""Width of a picture, and its height where there is room."""
MOST_NOTE = 160


@dataclass(frozen=True, slots=True)
class HomeTask:
    """One exercise: how often in a row, and how often a day."""

    exercise: Exercise
    times: int
    rounds: int


@dataclass(frozen=True, slots=True)
class OwnWay:
    """The patient's own way in one movement, signed degrees; it is drawn, never printed as a figure. ``said`` whether
    it is further, or held; ``goal_deg`` NaN for none."""

    days: tuple[date, ...]
    values_deg: tuple[float, ...]
    goal_deg: float
    further: bool


def _kind() -> str:
    return tr("home")


@dataclass(frozen=True, slots=True)
class HomeReport(OfSession):
    """All that is on the page: never a diagnosis or the real name. ``again`` the next appointment, None for a line to
    write it on; ``at`` its time as it was typed; ``language`` the patient's, by two letters."""

    tasks: tuple[HomeTask, ...]
    day: date
    again: date | None = None
    at: str = ""
    note: str = ""
    way: OwnWay | None = None
    language: str = ""

    @property
    def plan(self) -> HomePlan:
        """What is to be done, as it is remembered with the patient."""
        names, first = tuple(task.exercise.id for task in self.tasks), self.tasks[0]
        return HomePlan(names, first.times, first.rounds, self.day, self.again, self.at, self.note, self.language)

    @property
    def kind(self) -> str:
        return _kind()

    def bodies(self) -> list[Body]:
        return [partial(_body, self)]


def own_way(figures: SessionFigures, history: Sequence[SessionFigures], goals: Goals) -> OwnWay | None:
    """What may be shown of progress: sessions that compare, and no bad news; None where there is nothing good to say
    that is beyond doubt."""
    exercise = figures.exercise
    alike = [one for one in history if (one.exercise.id, one.side) == (exercise.id, figures.side)]
    known = [one for one in alike if one.when <= figures.when and one.session_id != figures.session_id]
    fair = [point.figures for point in progress([*known, figures]).points if point.fair]
    rows = [(one, row_aimed_at(one, exercise, 1)) for one in fair]
    found = [(one, row) for one, row in rows if row is not None and row.count and not row.at_least]
    if len(found) < 2 or found[-1][0] is not figures:
        return None
    change = compare(found[0][0], figures, [found[-1][1]])
    if not change or change[0].verdict not in ("improved", "no_change"):
        return None
    since = [compare(one, figures, [found[-1][1]]) for one, _ in found[1:-1]]
    if change[0].verdict == "no_change" and any(item.verdict == "worse" for items in since for item in items):
        return None  # what was reached in between is not held
    # Nothing of it is a number: the hand is drawn from where it lies, of the forearm from palm down.
    goal = stored_targets_deg(goals.get((exercise.id, figures.side), figures.targets_deg), exercise)[0]
    values = tuple(stored_targets_deg((row.mean, math.nan), exercise)[0] for _, row in found)
    return OwnWay(tuple(one.when.date() for one, _ in found), values, goal, change[0].verdict == "improved")


def way_words(way: OwnWay) -> str:
    """What is said above it, beyond error only: how much of the way to the goal is done, or that it is held."""
    first, last, goal = way.values_deg[0], way.values_deg[-1], way.goal_deg
    if not way.further:
        return tr("You are holding what you reached.")
    if math.isfinite(goal) and last >= goal:
        return tr("You have reached our goal.")
    if math.isfinite(goal) and last - first > 0.5 * (goal - first):
        return tr("More than half of the way is done.")
    return tr("You come further than at the start.")


def _body(home: HomeReport, number: str) -> QLayout:
    who = f"{home.pseudonym}, {inside(terms.hand_name(home.side))}"
    tick = label(tr("Tick a box when all rounds of the day are done."), 8.5, REGULAR, "text2")
    parts: list[Part] = [page_head(numbers.long_date(home.day), number, tr("Your hand at home"), who)]
    parts += [_task(home, task, place) for place, task in enumerate(home.tasks, 1)]
    parts.append((tick, 0, Qt.AlignmentFlag.AlignRight))
    if home.way is not None:
        parts.append(_way(home, home.way))
    pain = tr("It may pull, but it should not hurt. If it still hurts an hour later, do less next time and call us.")
    legal = paragraph(terms.LEGAL_SENTENCE, 7.0, REGULAR, "text2")
    return column(*parts, STRETCH, _next_time(home), column(paragraph(pain, 9.0, SEMIBOLD), legal, gap=3.0), gap=10.0)


def _task(home: HomeReport, task: HomeTask, number: int) -> QLayout:
    """A drawn exercise, what is to be done, how often, and a box for each day."""
    words = say(task.exercise.asked)
    if task.exercise.angle == PRONOSUPINATION:  # at home nobody looks for markers
        words = tr("Turn the palm up, then down. The elbow stays at your side.")
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
            (label(_day_name(day), 7.5, REGULAR, "text2"), 0, Qt.AlignmentFlag.AlignHCenter),
            PaintedPart(_paint_tick_box, 19.0, width=19.0),
            gap=3.0,
        )
        for day in _days(home)
    ]
    asked = column(named, paragraph(words, 9.5), STRETCH, line((often, 1), *days, gap=4.0), gap=4.0)
    picture = PaintedPart(partial(_paint_exercise, task.exercise, home.side), 110.0, TALLEST_PT, PICTURE_PT)
    return line(picture, (asked, 1), gap=14.0)


def _way(home: HomeReport, way: OwnWay) -> RoundedBox:
    """The hand at the start, today and at the goal, and the own curve; no degrees, and nobody else's."""
    key = tr("dashed: at the start; full line: today")
    if math.isfinite(way.goal_deg):
        key = tr("dashed: at the start; full line: today; green: our goal")
    hands = PaintedPart(partial(_paint_way, home.report.figures.exercise, home.side, way), 80.0, 110.0)
    pictures = line((hands, 1), (PaintedPart(partial(_paint_curve, way), 80.0, 110.0), 1))
    return RoundedBox(
        paragraph(way_words(way), 12.5, SEMIBOLD), 4.0, pictures, 2.0, paragraph(key, 8.0, REGULAR, "text2")
    )


def _next_time(home: HomeReport) -> QLayout:
    """When to come again, and room for questions."""
    again: list[Part | float] = [paragraph(tr("See you again"), 9.5, MEDIUM), 4.0]
    if home.again is None:
        again += [18.0, rule()]
    else:
        again += [paragraph(numbers.long_date(home.again), 12.0, SEMIBOLD), 3.0, paragraph(home.at, 12.0, SEMIBOLD)]
    card = RoundedBox(*again, STRETCH, fill="soft")
    card.setFixedWidth(PAPER.px(PICTURE_PT))
    notes = column(paragraph(tr("Notes, or what to ask next time"), 9.5, MEDIUM), gap=3.0)
    if home.note:
        notes.addWidget(paragraph(home.note, 9.5))
    notes.addWidget(PaintedPart(_paint_lines, 57.0), 1)
    return line(card, (notes, 1), gap=14.0)


def _days(home: HomeReport) -> list[date]:
    """From today to the day before the next appointment, a week at most."""
    count = USUAL_DAYS if home.again is None else (home.again - home.day).days
    return [home.day + timedelta(days=day) for day in range(min(max(count, 1), MOST_DAYS))]


def _day_name(day: date) -> str:
    return language.locale().dayName(day.isoweekday(), language.locale().FormatType.ShortFormat)


def _paint_number(number: int, painter: QPainter, box: QRectF) -> None:
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(PAPER.color("accent"))
    painter.drawEllipse(box)
    write(painter, box, str(number), PAPER.font(10.0, SEMIBOLD), PAPER.color("on_accent"), Qt.AlignmentFlag.AlignCenter)


def _paint_tick_box(painter: QPainter, box: QRectF) -> None:
    painter.setPen(QPen(PAPER.color("border"), 0.8 * UNIT))
    painter.drawRoundedRect(box.adjusted(2.0, 2.0, -2.0, -2.0), 4 * UNIT, 4 * UNIT)


def _paint_lines(painter: QPainter, box: QRectF) -> None:
    """Lines to write on."""
    painter.setPen(QPen(PAPER.color("line"), 0.6 * UNIT))
    for y in range(PAPER.px(18.0), round(box.height()), PAPER.px(19.0)):
        painter.drawLine(QLineF(0.0, y, box.width(), y))


def _placed(box: QRectF, side: Side, part: QRectF) -> QTransform:
    """From a figure's plane into a box, mirrored for a left hand."""
    scale = min(box.width() / part.width(), box.height() / part.height())
    to = QTransform()
    to.translate(box.center().x(), box.center().y())
    to.scale(scale if side == "right" else -scale, scale)
    to.translate(-part.center().x(), -part.center().y())
    return to


def _shown_part(exercise: Exercise, values_deg: Sequence[float]) -> QRectF:
    """What of the figure's plane is to be seen: the hands, and a piece of the forearm."""
    part = QRectF()
    for value in values_deg:
        part = part.united(figure_at(exercise, value).hand.boundingRect())
    arm = figure_at(exercise, 0.0).arm.boundingRect()
    piece = QRectF(-150.0, -60.0, 150.0, 120.0) if arm.width() > arm.height() else QRectF(-60.0, 0.0, 120.0, 150.0)
    return part.united(piece if not arm.isEmpty() else QRectF()).adjusted(-25, -25, 25, 25)


def _paint_exercise(exercise: Exercise, side: Side, painter: QPainter, box: QRectF) -> None:
    """The hand where it begins, dashed, and where it goes, with an arrow there and back."""
    start, end = (-SHOWN_DEG, SHOWN_DEG) if exercise.angle is not None else (REST_DEG, 1.6 * SHOWN_DEG)
    if exercise.angle == 0 or exercise.joint.endswith("abduction"):
        start, end = 0.5 * start, 0.5 * end
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(PAPER.color("sunken"))
    painter.drawRoundedRect(box, 6 * UNIT, 6 * UNIT)
    painter.setClipRect(box)
    arc = arc_of(exercise)
    way = arc.path(0.75 * start, 0.75 * end)
    part = _shown_part(exercise, (start, end)).united(way.boundingRect().adjusted(-20, -20, 20, 20))
    edge = 6 * UNIT
    to = _placed(box.adjusted(edge, edge, -edge, -edge), side, part)
    for value, is_dashed in ((start, True), (end, False)):
        _paint_hand(painter, exercise, value, to, "border" if is_dashed else "text", is_dashed=is_dashed)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(PAPER.color("accent"), 2.2 * UNIT, c=Qt.PenCapStyle.RoundCap))
    painter.drawPath(to.map(way))
    for at, sense in ((0.75 * start, -1.0), (0.75 * end, 1.0)):
        _paint_arrow(painter, to.map(arc.at(at - 2.0 * sense)), to.map(arc.at(at + 6.0 * sense)))


def _paint_arrow(painter: QPainter, before: QPointF, tip: QPointF) -> None:
    along = tip - before
    along = along * (7.0 * UNIT / (math.hypot(along.x(), along.y()) or 1.0))
    across = QPointF(-along.y(), along.x()) * 0.6
    painter.setBrush(PAPER.color("accent"))
    painter.setPen(Qt.PenStyle.NoPen)
    painter.drawPolygon(QPolygonF([tip, tip - along + across, tip - along - across]))


def _paint_hand(
    painter: QPainter, exercise: Exercise, value_deg: float, to: QTransform, token: str, *, is_dashed: bool,
    is_filled: bool = True,
) -> None:  # fmt: skip
    style = Qt.PenStyle.DashLine if is_dashed else Qt.PenStyle.SolidLine
    painter.setPen(QPen(PAPER.color(token), 1.1 * UNIT, style))
    painter.setBrush(PAPER.color("surface") if is_filled and not is_dashed else Qt.BrushStyle.NoBrush)
    painter.drawPath(to.map(figure_at(exercise, value_deg).whole))


def _paint_way(exercise: Exercise, side: Side, way: OwnWay, painter: QPainter, box: QRectF) -> None:
    shown = [("border", way.values_deg[0], True), ("text", way.values_deg[-1], False)]
    if math.isfinite(way.goal_deg):
        shown.insert(1, ("accent", way.goal_deg, True))
    painter.setClipRect(box)
    to = _placed(box, side, _shown_part(exercise, [value for _, value, _ in shown]))
    for token, value, is_dashed in shown:
        _paint_hand(painter, exercise, value, to, token, is_dashed=is_dashed, is_filled=False)


def _paint_curve(way: OwnWay, painter: QPainter, box: QRectF) -> None:
    area = box.adjusted(*points(20.0, 8.0, -62.0, -20.0))
    values = [*way.values_deg, *([way.goal_deg] if math.isfinite(way.goal_deg) else [])]
    low, high = min(0.0, *values), max(values)
    span = max((way.days[-1] - way.days[0]).days, 1)

    def place(day: date, value: float) -> QPointF:
        x = area.left() + area.width() * (day - way.days[0]).days / span
        return QPointF(x, area.bottom() - area.height() * (value - low) / max(high - low, 1.0))

    shown = [place(day, value) for day, value in zip(way.days, way.values_deg, strict=True)]
    painter.setPen(QPen(PAPER.color("line"), 0.6 * UNIT))
    painter.drawLine(QLineF(area.left() - 16.0, area.bottom(), area.right() + 16.0, area.bottom()))
    painter.setPen(QPen(PAPER.color("curve_a"), 1.8 * UNIT))
    painter.drawPolyline(QPolygonF(shown))
    painter.setBrush(PAPER.color("curve_a"))
    for point in shown:
        painter.drawEllipse(point, 2.2 * UNIT, 2.2 * UNIT)
    aside, face = QPointF(8.0 * UNIT, 3.0 * UNIT), PAPER.font(9.0, SEMIBOLD)
    write(painter, QPointF(area.right(), shown[-1].y()) + aside, tr("today"), face, PAPER.color("text"))
    if math.isfinite(way.goal_deg):
        y = place(way.days[0], way.goal_deg).y()
        painter.setPen(QPen(PAPER.color("accent"), 1.4 * UNIT, Qt.PenStyle.DashLine))
        painter.drawLine(QLineF(area.left(), y, area.right(), y))
        if abs(y - shown[-1].y()) > 12 * UNIT:
            write(painter, QPointF(area.right(), y) + aside, tr("our goal"), face, PAPER.color("accent"))
    days = area.adjusted(*points(-4.0, 0.0, 4.0, 16.0))
    for day, side in ((way.days[0], Qt.AlignmentFlag.AlignLeft), (way.days[-1], Qt.AlignmentFlag.AlignRight)):
        words = numbers.day_month(day)
        write(painter, days, words, CHART.label, PAPER.color("text2"), Qt.AlignmentFlag.AlignBottom | side)

"""The sheet to take home: exercises as drawn pictures, the own way so far, when to come again. One page, no degrees."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date, timedelta

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainterPath, QPen, QPolygonF, QTransform

from carpus.core.hand.exercises import EXERCISES, PRONOSUPINATION, Exercise
from carpus.core.hand.forearm_rotation import stored_targets_deg
from carpus.core.records.values import HomePlan
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import Goals, compare, progress, row_aimed_at
from carpus.core.types import Side
from carpus.ui import language, numbers, terms
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.patient.figure import arc_of, figure_at
from carpus.ui.patient.words import task_words
from carpus.ui.report.page import A4_PT, MARGIN_PT, Page
from carpus.ui.report.session_page import OfSession, paint_head
from carpus.ui.theme import LIGHT
from carpus.ui.translate import inside, say, tr

MOST_TASKS, MOST_DAYS, USUAL_DAYS = 3, 7, 7
DRAWN = tuple(exercise for exercise in EXERCISES if exercise.counts)
"""What can be drawn: exercises of one angle."""
REST_DEG, SHOWN_DEG = 0.0, 45.0
LEFT_PT, GAP_PT = 190.0, 14.0
"""Width of a picture, and what lies between it and its words."""
ROWS_PT, TALLEST_PT = 402.0, 180.0
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


def paint_home_page(page: Page, home: HomeReport) -> None:
    """Paint everything on one page."""
    who = f"{home.pseudonym}, {inside(terms.hand_name(home.side))}"
    y = paint_head(page, numbers.long_date(home.day), tr("Your hand at home"), who) + 14
    height = min(TALLEST_PT, ROWS_PT / max(len(home.tasks), 1) - 12)
    for number, task in enumerate(home.tasks, 1):
        _paint_task(page, home, task, number, QRectF(page.left, y, LEFT_PT, height))
        y += height + 12
    said = tr("Tick a box when all rounds of the day are done.")
    page.text_right(said, page.right, y, 8.5, REGULAR, "text2")
    y += 10
    if home.way is not None:
        y = _paint_way(page, home, home.way, y)
    _paint_foot(page, home, y + 4)


def _paint_task(page: Page, home: HomeReport, task: HomeTask, number: int, box: QRectF) -> None:
    _paint_exercise(page, task.exercise, home.side, box)
    left, right = box.right() + GAP_PT, page.right
    page.painter.setPen(Qt.PenStyle.NoPen)
    page.painter.setBrush(QColor(LIGHT.accent))
    page.painter.drawEllipse(page.at(left + 9, box.top() + 10), 9 * page.point, 9 * page.point)
    words = str(number)
    page.text(words, left + 9 - page.width_of(words, 10, SEMIBOLD) / 2, box.top() + 13.5, 10, SEMIBOLD, "on_accent")
    page.text(task_words(task.exercise.id), left + 25, box.top() + 15, 13.0, SEMIBOLD)
    words = say(task.exercise.asked)
    if task.exercise.angle == PRONOSUPINATION:  # at home nobody looks for markers
        words = tr("Turn the palm up, then down. The elbow stays at your side.")
    page.paragraph(words, left, box.top() + 24, right - left, 9.5)
    foot = box.bottom()
    times = tr("once") if task.times == 1 else tr("{count} times").format(count=task.times)
    page.text(times, left, foot - 14, 13.0, SEMIBOLD, "accent")
    rounds = tr("once a day") if task.rounds == 1 else tr("{count} times a day").format(count=task.rounds)
    page.text(rounds, left, foot - 1, 10.0, SEMIBOLD)
    for place, day in enumerate(reversed(_days(home))):
        edge = right - 19.0 - 23.0 * place
        name = language.locale().dayName(day.isoweekday(), language.locale().FormatType.ShortFormat)
        page.text(name, edge + 9.5 - page.width_of(name, 7.5) / 2, foot - 22, 7.5, REGULAR, "text2")
        page.painter.setPen(QPen(QColor(LIGHT.border), 0.8 * page.point))
        page.painter.setBrush(Qt.BrushStyle.NoBrush)
        page.painter.drawRoundedRect(page.box(edge, foot - 19, 19, 19), 4 * page.point, 4 * page.point)


def _days(home: HomeReport) -> list[date]:
    """From today to the day before the next appointment, a week at most."""
    count = USUAL_DAYS if home.again is None else (home.again - home.day).days
    return [home.day + timedelta(days=day) for day in range(min(max(count, 1), MOST_DAYS))]


def _placed(page: Page, box: QRectF, side: Side, part: QRectF) -> QTransform:
    """From a figure's plane into a box in points, mirrored for a left hand."""
    scale = min(box.width() / part.width(), box.height() / part.height()) * page.point
    to = QTransform()
    to.translate(box.center().x() * page.point, box.center().y() * page.point)
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


def _paint_exercise(page: Page, exercise: Exercise, side: Side, box: QRectF) -> None:
    """The hand where it begins, dashed, and where it goes, with an arrow there and back."""
    ends = (-SHOWN_DEG, SHOWN_DEG) if exercise.angle is not None else (REST_DEG, 1.6 * SHOWN_DEG)
    if exercise.angle == 0 or exercise.joint.endswith("abduction"):
        ends = tuple(0.5 * end for end in ends)  # type: ignore[assignment]
    page.painter.save()
    page.fill(box.x(), box.y(), box.width(), box.height(), "sunken")
    page.painter.setClipRect(page.box(box.x(), box.y(), box.width(), box.height()))
    arc = arc_of(exercise)
    way = arc.path(0.75 * ends[0], 0.75 * ends[1])
    part = _shown_part(exercise, ends).united(way.boundingRect().adjusted(-20, -20, 20, 20))
    to = _placed(page, box.adjusted(6, 6, -6, -6), side, part)
    for value, dashed in ((ends[0], True), (ends[1], False)):
        _paint_hand(page, exercise, value, to, "border" if dashed else "text", dashed=dashed)
    page.painter.setBrush(Qt.BrushStyle.NoBrush)
    page.painter.setPen(QPen(QColor(LIGHT.accent), 2.2 * page.point, c=Qt.PenCapStyle.RoundCap))
    page.painter.drawPath(to.map(way))
    for at, sense in ((0.75 * ends[0], -1.0), (0.75 * ends[1], 1.0)):
        tip, before = to.map(arc.at(at + 6.0 * sense)), to.map(arc.at(at - 2.0 * sense))
        _paint_arrow(page, before, tip)
    page.painter.restore()


def _paint_arrow(page: Page, before: QPointF, tip: QPointF) -> None:
    along = tip - before
    length = math.hypot(along.x(), along.y()) or 1.0
    along = along * (7.0 * page.point / length)
    across = QPointF(-along.y(), along.x()) * 0.6
    page.painter.setBrush(QColor(LIGHT.accent))
    page.painter.setPen(Qt.PenStyle.NoPen)
    page.painter.drawPolygon(QPolygonF([tip, tip - along + across, tip - along - across]))


def _paint_hand(
    page: Page, exercise: Exercise, value_deg: float, to: QTransform, token: str, *, dashed: bool, filled: bool = True
) -> None:
    pen = QPen(QColor(getattr(LIGHT, token)), 1.1 * page.point)
    if dashed:
        pen.setStyle(Qt.PenStyle.DashLine)
    page.painter.setPen(pen)
    page.painter.setBrush(QColor("#FFFFFF") if filled and not dashed else Qt.BrushStyle.NoBrush)
    path: QPainterPath = figure_at(exercise, value_deg).whole
    page.painter.drawPath(to.map(path))


def _paint_way(page: Page, home: HomeReport, way: OwnWay, top: float) -> float:
    """The hand at the start, today and at the goal, and the own curve; no degrees, and nobody else's."""
    exercise, height, width = home.report.figures.exercise, 138.0, page.right - page.left
    page.card(page.left, top, width, height)
    page.text(way_words(way), page.left + 14, top + 20, 12.5, SEMIBOLD)
    picture = QRectF(page.left + 8, top + 28, 0.42 * width, height - 44)
    shown = [("border", way.values_deg[0], True), ("text", way.values_deg[-1], False)]
    if math.isfinite(way.goal_deg):
        shown.insert(1, ("accent", way.goal_deg, True))
    page.painter.save()
    page.painter.setClipRect(page.box(picture.x(), picture.y(), picture.width(), picture.height()))
    to = _placed(page, picture, home.side, _shown_part(exercise, [value for _, value, _ in shown]))
    for token, value, dashed in shown:
        _paint_hand(page, exercise, value, to, token, dashed=dashed, filled=False)
    page.painter.restore()
    said = tr("dashed: at the start; full line: today")
    if math.isfinite(way.goal_deg):
        said = tr("dashed: at the start; full line: today; green: our goal")
    page.text(said, page.left + 14, top + height - 6, 8.0, REGULAR, "text2")
    _paint_curve(page, way, QRectF(page.left + 0.5 * width, top + 34, 0.36 * width, height - 60))
    return top + height


def _paint_curve(page: Page, way: OwnWay, box: QRectF) -> None:
    values = [*way.values_deg, *([way.goal_deg] if math.isfinite(way.goal_deg) else [])]
    low, high = min(0.0, *values), max(values)
    span = max((way.days[-1] - way.days[0]).days, 1)

    def place(day: date, value: float) -> QPointF:
        x = box.left() + box.width() * (day - way.days[0]).days / span
        y = box.bottom() - box.height() * (value - low) / max(high - low, 1.0)
        return QPointF(x * page.point, y * page.point)

    points = [place(day, value) for day, value in zip(way.days, way.values_deg, strict=True)]
    page.rule(box.bottom(), box.left() - 4, box.right() + 4)
    page.painter.setPen(QPen(QColor(LIGHT.curve_a), 1.8 * page.point))
    page.painter.drawPolyline(QPolygonF(points))
    page.painter.setBrush(QColor(LIGHT.curve_a))
    for point in points:
        page.painter.drawEllipse(point, 2.2 * page.point, 2.2 * page.point)
    page.text(tr("today"), box.right() + 8, points[-1].y() / page.point + 3, 9.0, SEMIBOLD)
    if math.isfinite(way.goal_deg):
        y = place(way.days[0], way.goal_deg).y()
        page.painter.setPen(QPen(QColor(LIGHT.accent), 1.4 * page.point, Qt.PenStyle.DashLine))
        page.painter.drawLine(QPointF(box.left() * page.point, y), QPointF(box.right() * page.point, y))
        if abs(y - points[-1].y()) > 12 * page.point:
            page.text(tr("our goal"), box.right() + 8, y / page.point + 3, 9.0, SEMIBOLD, "accent")
    page.text(numbers.day_month(way.days[0]), box.left() - 4, box.bottom() + 12, 8.5, REGULAR, "text2")
    page.text_right(numbers.day_month(way.days[-1]), box.right() + 4, box.bottom() + 12, 8.5, REGULAR, "text2")


def _paint_foot(page: Page, home: HomeReport, top: float) -> None:
    """When to come again, room for questions, what to do when it hurts."""
    top = max(top, A4_PT[1] - MARGIN_PT - 150)
    page.fill(page.left, top, LEFT_PT, 74, "soft")
    page.text(tr("See you again"), page.left + 12, top + 18, 9.5, MEDIUM)
    if home.again is None:
        page.rule(top + 48, page.left + 12, page.left + LEFT_PT - 12)
    else:
        words = numbers.long_date(home.again)
        size = page.fitting(words, LEFT_PT - 24, 13.0, SEMIBOLD)
        page.text(words, page.left + 12, top + 38, size, SEMIBOLD)
        page.text(home.at, page.left + 12, top + 56, 12.0, SEMIBOLD)
    left = page.left + LEFT_PT + GAP_PT
    page.text(tr("Notes, or what to ask next time"), left, top + 12, 9.5, MEDIUM)
    below = page.paragraph(home.note, left, top + 16, page.right - left, 9.5) if home.note else top + 14
    while (below := below + 19) <= top + 76:
        page.rule(below, left, page.right)
    y = top + 84
    said = tr("It may pull, but it should not hurt. If it still hurts an hour later, do less next time and call us.")
    y = page.said(said, y, 9.0, SEMIBOLD)
    page.said(terms.LEGAL_SENTENCE, y + 2, 7.0, REGULAR, "text2")

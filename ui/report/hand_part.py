"""The part of the session report that is the whole hand's: table of the fingers, the wrist beside it, curves."""

from __future__ import annotations

from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor, QPen

from carpus.core.output.joint_content import JointCurves
from carpus.core.output.report_content import Curves, SessionFigures
from carpus.ui.figures import TOKENS, row_name
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.plot.session import BENDING, HandPlot, paint_session
from carpus.ui.report.hand_rows import FingerRow, column_heads, finger_rows, limits_words
from carpus.ui.report.page import Page
from carpus.ui.report.tables import mean_words, repetition_words
from carpus.ui.terms import arc_name
from carpus.ui.theme import LIGHT
from carpus.ui.translate import tr

EDGES = (0.0, 0.064, 0.166, 0.268, 0.356, 0.487, 0.626, 0.700, 0.790)
"""Left edge of the finger, the five figures, the share, last time, change, as shares of the width."""
EDGES_ALONE = (*(edge / EDGES[7] for edge in EDGES[:7]), 1.0, 1.0)
"""The same where there is no last time to compare with."""
ROW_PT, CURVES_PT, LEAST_CURVES_PT, BETWEEN_PT = 21.5, 176.0, 110.0, 6.0
LEAST_SIZE_PT = 6.0
TITLE_PT, KEY_PT, KEY_GAP_PT = 11.5, 8.5, 22.0


def paint_finger_table(
    page: Page, figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None, top: float
) -> float:
    """One row for each finger, then in words what the camera's view limits."""
    page.title(tr("Range of motion of the fingers"), top + 11, repetition_words(figures))
    baseline = top + 25
    edges = EDGES if previous is not None else EDGES_ALONE
    for column, head in enumerate(column_heads(figures, previous, other), 1):
        _fitted(page, edges, head, column, baseline, 8.0, MEDIUM, "text2")
    y = baseline + 4.5
    for row in finger_rows(figures, previous, other):
        page.rule(y)
        _paint_row(page, edges, row, y)
        y += ROW_PT
    page.rule(y)
    words = limits_words(figures)
    return page.paragraph(words, page.left, y + 2, page.right - page.left, 8.0) if words else y


def _paint_row(page: Page, edges: tuple[float, ...], row: FingerRow, top: float) -> None:
    middle = top + ROW_PT / 2 + 3
    _fitted(page, edges, row.name, 0, middle, 9.0, MEDIUM)
    for column, cell in enumerate(row.cells, 1):
        if cell.small:
            _fitted(page, edges, cell.shown, column, top + 9.5, 9.0, SEMIBOLD)
            _fitted(page, edges, cell.small, column, top + 18.5, 7.5, REGULAR, "text2")
        else:
            _fitted(page, edges, cell.shown, column, middle, 8.5, REGULAR, "text2")
    if row.share.small:
        _fitted(page, edges, row.share.main, 6, top + 9.5, 9.0, SEMIBOLD)
        _fitted(page, edges, row.share.small, 6, top + 18.5, 7.5, REGULAR, "text2")
    _fitted(page, edges, row.last, 7, middle, 8.5)
    _fitted(page, edges, row.change, 8, middle, 8.0, MEDIUM)


def _fitted(
    page: Page,
    edges: tuple[float, ...],
    text: str,
    column: int,
    baseline: float,
    size: float,
    weight: int = REGULAR,
    token: str = "text",
) -> None:
    """A text in its column, smaller or on two lines where it is too long."""
    width = page.right - page.left
    room = ((edges[column + 1] if column + 1 < len(edges) else 1.0) - edges[column]) * width - 6
    left = page.left + edges[column] * width
    while size > LEAST_SIZE_PT and page.width_of(text, size, weight) > room:
        if " " in text and column == len(EDGES) - 1 and size <= 7.0:
            page.paragraph(text, left, baseline - 1.6 * size, room, LEAST_SIZE_PT + 0.5, weight, token)
            return
        size -= 0.25
    page.text(text, left, baseline, size, weight, token)


def paint_wrist_line(page: Page, figures: SessionFigures, top: float) -> float:
    """The wrist's three arcs in one line under the table of the fingers."""
    page.title(tr("Wrist"), top + 11, tr("whole arcs over the same time"))
    arcs = [row for row in figures.rows if row.movement == "arc"]
    baseline, left = top + 26, page.left
    step = (page.right - page.left) / 3
    for row in arcs:
        end = page.text(arc_name(row.angle), left, baseline, 8.5, REGULAR, "text2")
        page.text(mean_words(row), end + 6, baseline, 9.0, SEMIBOLD)
        left += step
    if not arcs:
        page.text(tr("not seen"), page.left, baseline, 8.5, REGULAR, "text2")
    page.rule(baseline + 4.5)
    return baseline + 4.5


def paint_finger_curves(
    page: Page, curves: Curves, joints: JointCurves, figures: SessionFigures, top: float, room: float
) -> float:
    """Bending of every finger over time, in the height that is left; dashed where it was hidden."""
    height = min(CURVES_PT, max(room - 28 - 16, LEAST_CURVES_PT))
    aside = tr("dashed: hidden; hatched: lost")
    words = tr("Bending over time")
    page.title(words, top + 11, aside)
    left = page.left + page.width_of(words, TITLE_PT, SEMIBOLD) + 10
    _paint_key(page, left, page.right - page.width_of(aside, 8.5) - 12, top + 11)
    plot = HandPlot(curves, figures.exercise, figures.repetitions, -1, joints=joints)
    box = page.box(page.left + 80, top + 28, page.right - page.left - 88, height)
    paint_session(page.painter, page.style, plot, plot.panels(box, BETWEEN_PT * page.point))
    return top + 28 + height + 16


def _paint_key(page: Page, least_left: float, right: float, baseline: float) -> None:
    """Which colour is which joint, ending at ``right``; smaller where it would reach the title."""
    names = {row: tr("Middle joint, of the thumb lift") if row == "middle" else row_name(row) for row in BENDING}
    size = KEY_PT
    while size > LEAST_SIZE_PT:
        if right - sum(page.width_of(name, size) + KEY_GAP_PT for name in names.values()) >= least_left:
            break
        size -= 0.25
    for row in reversed(BENDING):
        name = names[row]
        left = right - page.width_of(name, size)
        page.text(name, left, baseline, size, REGULAR, "text2")
        page.painter.setPen(QPen(QColor(getattr(LIGHT, TOKENS[row])), 1.6 * page.point))
        y = (baseline - 3.0) * page.point
        page.painter.drawLine(QPointF((left - 14) * page.point, y), QPointF((left - 4) * page.point, y))
        right = left - 22

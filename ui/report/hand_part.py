"""The part of the session report that is the whole hand's: table of the fingers, the wrist beside it, curves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate

from carpus.core.results.figures import SessionFigures
from carpus.core.results.seen import JointCurves, ReportCurves
from carpus.ui.figures import TOKENS, row_name
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.plot.session import BENDING, HandPlot, paint_session
from carpus.ui.report.page import Page
from carpus.ui.terms import arc_name
from carpus.ui.translate import tr
from carpus.ui.words.fingers import FingerRow, column_heads, finger_rows, limits_words
from carpus.ui.words.ranges import mean_words, repetition_words

ROW_PT, CURVES_PT, LEAST_CURVES_PT = 21.5, 176.0, 110.0
LEAST_SIZE_PT, GAP_PT = 6.0, 6.0
CHANGE_COLUMN, CHANGE_PT = 8, 92.0
"""The change may take two lines: so wide at most, or as its head."""
TITLE_PT, KEY_PT, KEY_GAP_PT = 11.5, 8.5, 22.0


def paint_finger_table(
    page: Page, figures: SessionFigures, previous: SessionFigures | None, other: SessionFigures | None, top: float
) -> float:
    """One row for each finger, then in words what the camera's view limits."""
    baseline = top + 25 + page.title(tr("Range of motion of the fingers"), top + 11, repetition_words(figures))
    heads, rows = column_heads(figures, previous, other), finger_rows(figures, previous, other)
    edges = column_edges(page, heads, rows)
    for column, head in enumerate(heads, 1):
        _fitted(page, edges, column, CellLine(head, 8.0, MEDIUM, "text2"), baseline)
    y = baseline + 4.5
    for row in rows:
        page.rule(y)
        for column, lines in enumerate(lines_of(row)):
            for number, line in enumerate(lines):
                down = ROW_PT / 2 + 3 if len(lines) == 1 else (9.5, 18.5)[number]
                _fitted(page, edges, column, line, y + down)
        y += ROW_PT
    page.rule(y)
    words = limits_words(figures)
    return page.said(words, y + 2, 8.0) if words else y


@dataclass(frozen=True, slots=True)
class CellLine:
    """A line of a cell at the size it should have."""

    text: str
    size_pt: float
    weight: int = REGULAR
    token: str = "text"


def lines_of(row: FingerRow) -> list[tuple[CellLine, ...]]:
    """What stands in each column of a finger's row, one line or two."""
    cells = [
        (CellLine(cell.shown, 9.0, SEMIBOLD), CellLine(cell.small, 7.5, REGULAR, "text2"))
        if cell.small
        else (CellLine(cell.shown, 8.5, REGULAR, "text2"),)
        for cell in row.cells
    ]
    share = (CellLine(row.share.main, 9.0, SEMIBOLD), CellLine(row.share.small, 7.5, REGULAR, "text2"))
    return [
        (CellLine(row.name, 9.0, MEDIUM),),
        *cells,
        share if row.share.small else (),
        (CellLine(row.last, 8.5),),
        (CellLine(row.change, 8.0, MEDIUM),),
    ]


def column_edges(page: Page, heads: Sequence[str], rows: Sequence[FingerRow]) -> tuple[float, ...]:
    """Left edges of finger, five figures, share, last time and change in points after the page's left, and the right
    one: as wide as the words of this language and these figures ask for, and closer in one measure where that is
    more than the page has."""
    columns: list[list[CellLine]] = [[], *([CellLine(head, 8.0, MEDIUM)] for head in heads)]
    for row in rows:
        for column, lines in enumerate(lines_of(row)):
            columns[column].extend(lines)
    asked = [
        max((page.width_of(one.text, one.size_pt, one.weight) for one in lines if one.text), default=-GAP_PT) + GAP_PT
        for lines in columns
    ]
    head = page.width_of(heads[-1], 8.0, MEDIUM) + GAP_PT
    asked[CHANGE_COLUMN] = min(asked[CHANGE_COLUMN], max(CHANGE_PT, head))
    share = (page.right - page.left) / sum(asked)
    return tuple(accumulate((share * width for width in asked), initial=0.0))


def _fitted(page: Page, edges: tuple[float, ...], column: int, line: CellLine, baseline: float) -> None:
    """A text in its column, smaller or on two lines where it is too long."""
    room = edges[column + 1] - edges[column] - GAP_PT
    left, size = page.left + edges[column], line.size_pt
    if column == CHANGE_COLUMN and " " in line.text and page.width_of(line.text, 7.0, line.weight) > room:
        page.paragraph(line.text, left, baseline - 11.2, room, LEAST_SIZE_PT + 0.5, line.weight, line.token)
        return
    size = page.fitting(line.text, room, size, line.weight, LEAST_SIZE_PT)
    page.text(line.text, left, baseline, size, line.weight, line.token)


def paint_wrist_line(page: Page, figures: SessionFigures, top: float) -> float:
    """The wrist's three arcs in one line under the table of the fingers."""
    page.title(tr("Wrist"), top + 11, tr("whole arcs over the same time"))
    arcs = [row for row in figures.wrist_ranges if row.what == "arc"]
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
    page: Page, curves: ReportCurves, joints: JointCurves, figures: SessionFigures, top: float, room: float
) -> float:
    """Bending of every finger over time, in the height that is left; dashed where it was hidden."""
    height = min(CURVES_PT, max(room - 28 - 16, LEAST_CURVES_PT))
    aside = tr("dashed: hidden; hatched: lost")
    words = tr("Bending over time")
    page.title(words, top + 11, aside)
    left = page.left + page.width_of(words, TITLE_PT, SEMIBOLD) + 10
    _paint_key(page, left, page.right - page.width_of(aside, 8.5) - 12, top + 11)
    plot = HandPlot(curves, figures.exercise, figures.repetitions, -1, joints=joints)
    box = page.box(page.left, top + 8, page.right - page.left, height + 36)
    if not page.is_trial:
        paint_session(page.painter, page.style, plot, box)
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
        page.line((left - 14, baseline - 3.0), (left - 4, baseline - 3.0), TOKENS[row], 1.6)
        right = left - 22

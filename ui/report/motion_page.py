"""The second page of a session report: the papers' figures and what the exercise has beside its ranges."""

from __future__ import annotations

from carpus.core.results.figures import SessionFigures
from carpus.core.results.motion_curves import MotionCurves
from carpus.ui import numbers
from carpus.ui.fonts import MEDIUM, REGULAR
from carpus.ui.plot.motion import MotionKind, MotionPlot, zyz_words
from carpus.ui.plot.session import paint_session
from carpus.ui.plot.ways import WayPlot, finger_ways, paint_ways, wrist_way
from carpus.ui.report.page import Page, paint_to_fit
from carpus.ui.report.session_page import LOWEST_PT, SessionReport, paint_head, what_words
from carpus.ui.terms import LEGAL_SENTENCE
from carpus.ui.translate import tr
from carpus.ui.words.further import further_rows, further_title

WAYS_PT, HAND_WAYS_PT = 172.0, 124.0
CURVES_PT, ZYZ_PT, HAND_CURVES_PT, HAND_ZYZ_PT = 190.0, 110.0, 108.0, 78.0
ROW_PT = 12.5


def paint_motion_page(page: Page, report: SessionReport) -> None:
    """Paint everything from the upper to the lower margin, smaller where there is too much."""
    if report.motion is None:
        return
    motion = report.motion
    paint_to_fit(page, LOWEST_PT, lambda trial: _paint_all(trial, report, motion))


def _paint_all(page: Page, report: SessionReport, motion: MotionCurves) -> float:
    hand = bool(motion.joint_names)
    y = paint_head(page, tr("Session report, page 2"), report.pseudonym, what_words(report))
    y = _paint_further(page, report.figures, report.previous, y + 7)
    ways_pt = HAND_WAYS_PT if hand else WAYS_PT
    y = _paint_ways(page, tr("Path of the wrist"), wrist_way(motion), y, ways_pt, tr("with the hand’s axes along it"))
    if hand:
        words = tr("joint centres; dashed: disc hidden")
        y = _paint_ways(page, tr("Ways of the finger tips"), finger_ways(motion, 0), y, ways_pt, words)
    curves_pt, zyz_pt = (HAND_CURVES_PT, HAND_ZYZ_PT) if hand else (CURVES_PT, ZYZ_PT)
    aside = tr("X (black) to the fingers, Y (blue) to the thumb, Z (orange) up")
    if motion.side == "left":
        aside = tr("X (black) to the fingers, Y (blue) from the thumb, Z (orange) up")
    y = _paint_curves(page, report, motion, "place", tr("Place, speed, turning"), aside, y, curves_pt)
    y = _paint_curves(
        page, report, motion, "zyz", tr("ZYZ angles"), tr("band: ± 1 sd; black: α + γ, with γ"), y, zyz_pt
    )
    y = page.said(zyz_words([motion]), y, 8.0, REGULAR, "text2")
    y = page.said(LEGAL_SENTENCE, y + 3, 8.0, MEDIUM)
    return y + 8


def _paint_ways(page: Page, title: str, plot: WayPlot, top: float, height: float, aside: str) -> float:
    page.title(title, top + 11, aside)
    if page.is_trial:
        return top + 16 + height + 8
    paint_ways(page.painter, page.style, plot, page.box(page.left, top + 16, page.right - page.left, height))
    return top + 16 + height + 8


def _paint_curves(
    page: Page, report: SessionReport, motion: MotionCurves, kind: MotionKind, title: str, aside: str,
    top: float, height: float,
) -> float:  # fmt: skip
    page.title(title, top + 11, aside)
    plot = MotionPlot(report.curves, report.figures.exercise, report.figures.repetitions, -1, motion=motion, kind=kind)
    box = page.box(page.left, top + 9, page.right - page.left, height + 36)
    if not page.is_trial:
        paint_session(page.painter, page.style, plot, box)
    return top + 29 + height + 18


def _paint_further(page: Page, figures: SessionFigures, previous: SessionFigures | None, top: float) -> float:
    """Two figures to a line."""
    rows = further_rows(figures, previous)
    if not rows:
        return top
    day = numbers.day_beside(previous.when, figures.when) if previous is not None and previous.group("task") else ""
    page.title(further_title(figures), top + 11, tr("mean ± sd; at the right: {day}").format(day=day) if day else "")
    gap = 18.0
    width = (page.right - page.left - gap) / 2
    for place, row in enumerate(rows):
        left, baseline = page.left + (place % 2) * (width + gap), top + 26 + ROW_PT * (place // 2)
        page.rule(baseline + 3.5, left, left + width)
        page.text(row.name, left, baseline, 8.0, REGULAR, "text2")
        page.text(row.today, left + 0.54 * width, baseline, 8.5, MEDIUM)
        page.text_right(row.last, left + width, baseline, 8.5)
    return top + 26 + ROW_PT * (-(-len(rows) // 2)) - 2

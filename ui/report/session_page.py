"""The first page of the session report: A4, always light, readable in grey."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date

from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor

from carpus.core.hand.exercises import AXIS_TICK_DEG, PRONOSUPINATION, SIDES, Exercise
from carpus.core.hand.forearm_rotation import is_from_thumb_up
from carpus.core.hand.protocols import WRIST_ANGLES
from carpus.core.measures.by_hand import HandValue
from carpus.core.results.figures import SessionFigures
from carpus.core.results.motion_curves import MotionCurves
from carpus.core.results.norms import wrist_norm
from carpus.core.results.progress import compare
from carpus.core.results.report_form import USUAL_FORM, ReportForm
from carpus.core.results.seen import JointCurves, ReportCurves
from carpus.core.rounding import written
from carpus.core.types import Side
from carpus.ui import numbers, terms
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.icons import State, paint_mark, paint_state
from carpus.ui.plot.session import SessionPlot, paint_session
from carpus.ui.report.hand_part import paint_finger_curves, paint_finger_table, paint_wrist_line
from carpus.ui.report.page import A4_PT, MARGIN_PT, Page, PageColumn, paint_to_fit, painted_on_nothing
from carpus.ui.theme import CURVE_TOKENS, LIGHT
from carpus.ui.translate import inside, tr
from carpus.ui.words.active_passive import active_passive
from carpus.ui.words.by_hand import day_words
from carpus.ui.words.fingers import compared_figures, hand_summary
from carpus.ui.words.progress import corrected_words
from carpus.ui.words.ranges import TableRow, column_names, norm_words, repetition_words, table_rows
from carpus.ui.words.session import method, other_lines, quality_lines, summary, warnings

INSIDE_PT = 11.0
"""Between the line of a card and its words."""
COMMENT_PT, COMMENT_LEADING_PT = 9.0, 12.5
MOST_COMMENT_LINES = 6
"""A longer comment has pages of its own."""
LOWEST_PT = A4_PT[1] - MARGIN_PT + 11
"""Lower edge of what a page may carry."""


@dataclass(frozen=True, slots=True)
class SessionReport:
    """All that is on the page."""

    figures: SessionFigures
    curves: ReportCurves
    markers: int
    pseudonym: str
    session_number: int = 0
    dominance: str = "unknown"
    diagnosis: str = ""
    onset: str = ""
    onset_day: date | None = None
    """Why the patient comes: printed only where the form has it."""
    therapist: str = ""
    previous: SessionFigures | None = None
    first: SessionFigures | None = None
    other_hand: SessionFigures | None = None
    joints: JointCurves | None = None
    motion: MotionCurves | None = None
    digest: str = ""
    settings_digest: str = ""
    revision: str = ""
    recording_digest: str = ""
    by_hand: tuple[HandValue, ...] = ()
    """What was measured by hand of this hand and person on the day of the session."""
    comment: str = ""
    """The therapist's own words, several lines."""
    form: ReportForm = USUAL_FORM
    language: str = ""
    """The language it is painted in, by two letters; empty for the window's."""

    @property
    def sessions(self) -> tuple[SessionFigures, ...]:
        return (self.figures,)


@dataclass(frozen=True, slots=True)
class OfSession:
    """A page made of what the report of a session has."""

    report: SessionReport

    @property
    def form(self) -> ReportForm:
        return self.report.form

    @property
    def pseudonym(self) -> str:
        return self.report.pseudonym

    @property
    def side(self) -> Side:
        return self.report.figures.side

    @property
    def sessions(self) -> tuple[SessionFigures, ...]:
        return self.report.sessions


def paint_session_page(page: Page, report: SessionReport) -> None:
    """Paint everything from the upper to the lower margin, smaller where many warnings leave too little room."""
    paint_to_fit(page, LOWEST_PT, lambda trial: _paint_all(trial, report))


def _paint_all(page: Page, report: SessionReport) -> float:
    """Everything but what lies behind; returns the lower edge."""
    y = paint_head(page, tr("Session report"), report.pseudonym, what_words(report))
    y = _paint_facts(page, report, y)
    said = (summary if report.joints is None else hand_summary)(report.figures, report.previous, report.first)
    y = page.said(said, y + 5, 10.0, SEMIBOLD)
    if report.joints is None:
        if report.form.has("table"):
            y = _paint_active_passive(page, report, _paint_table(page, report, y + 7))
        if report.form.has("curves"):
            y = _paint_curves(page, report, y + 8)
        if report.form.has("bars"):
            y = _paint_bars(page, report, y + 8)
    else:
        if report.form.has("table"):
            y = paint_finger_table(page, report.figures, report.previous, report.other_hand, y + 7)
            y = _paint_active_passive(page, report, y)
            y = paint_wrist_line(page, report.figures, y + 7)
        below = painted_on_nothing(
            page,
            lambda trial: _paint_foot(trial, report, _paint_told(trial, report, paint_boxes(trial, report, 9.0))),
        )
        room = LOWEST_PT - 2 - y - 8 - below
        if report.form.has("curves"):
            y = paint_finger_curves(page, report.curves, report.joints, report.figures, y + 8, room)
    y = paint_boxes(page, report, y + 9)
    return _paint_foot(page, report, _paint_told(page, report, y))


def paint_watermark(page: Page) -> None:
    """SIMULATED across the page, behind everything: no copy of it passes for a patient's."""
    painter = page.painter
    painter.save()
    painter.translate(page.at(A4_PT[0] / 2, A4_PT[1] / 2))
    painter.rotate(-55.0)
    words = tr("SIMULATED")
    page.text(words, -page.width_of(words, 96.0, SEMIBOLD) / 2, 34.0, 96.0, SEMIBOLD, "norm")
    painter.restore()


def paint_head(page: Page, kind: str, pseudonym: str, what: str) -> float:
    """Mark, kind of report, who and what; returns the lower edge."""
    top = MARGIN_PT - 12
    paint_mark(page.painter, page.box(page.left, top, 15, 15), QColor(LIGHT.accent))
    page.text("Carpus", page.left + 20, top + 12, 11.5, SEMIBOLD)
    aside = f"{kind} · {page.number}" if page.number else kind
    page.text_right(aside, page.right, top + 12, 8.5, REGULAR, "text2")
    size, beside = 21.0, 14.0
    while size > 9.0 and page.width_of(pseudonym, size, SEMIBOLD) + 11 + page.width_of(what, beside) > (
        page.right - page.left
    ):
        size, beside = size - 0.5, max(9.0, beside - 0.25)
    end = page.text(pseudonym, page.left, top + 46, size, SEMIBOLD)
    page.text(what, end + 11, top + 46, beside, REGULAR, "text2")
    page.rule(top + 57)
    return top + 57


def what_words(report: SessionReport) -> str:
    """Exercise and hand."""
    figures = report.figures
    return f"{terms.exercise_name(figures.exercise.id)}, {inside(terms.hand_name(figures.side))}"


def _paint_facts(page: Page, report: SessionReport, top: float) -> float:
    figures = report.figures
    session = tr("active")
    if figures.has_passive:
        session = tr("active and passive") if figures.counted else tr("passive")
    if report.session_number:
        session = f"{numbers.ordinal(report.session_number)}, {session}"
    handed = {"right": tr("right-handed"), "left": tr("left-handed"), "both": tr("both-handed")}.get(
        report.dominance, ""
    )
    pairs = [
        (tr("Date"), numbers.report_date(figures.when)),
        (tr("Session"), session),
        (tr("Hand"), ", ".join(part for part in (inside(terms.side_name(figures.side)), handed) if part)),
        (tr("Length"), numbers.clock(figures.duration_s + 0.5)),
        (tr("Therapist"), report.therapist or numbers.UNKNOWN),
    ]
    page.facts(pairs, top + 5, (0.0, 0.25, 0.44, 0.67, 0.81))
    lines = [(_diagnosis_words(report), MEDIUM, "text"), *((words, SEMIBOLD, "warn") for words in warnings(figures))]
    if said := corrected_words(figures):
        kept = tr("Markers were put right by hand; the result as measured is kept.")
        lines.append((f"{said} {kept}", MEDIUM, "text"))
    for words, weight, token in lines:
        if words:
            top = page.said(words, top + 35, 8.5, weight, token) - 33
    page.rule(top + 36)
    return top + 36


def _diagnosis_words(report: SessionReport) -> str:
    """``Wrist fracture, plate, operated on 21 Aug 2026, 13 weeks before``, where the clinic wants it."""
    day = report.onset_day
    if not report.form.has("diagnosis"):
        return ""
    parts = [report.diagnosis, inside(terms.onset_words(report.onset, day))]
    if day is not None and (weeks := numbers.weeks_since(day, report.figures.when.date())):
        parts.append(tr("{weeks} before").format(weeks=weeks))
    return ", ".join(part for part in parts if part)


TABLE = (
    PageColumn(0.0, MEDIUM, room=0.135), PageColumn(0.143, SEMIBOLD), PageColumn(0.354, ends=True),
    PageColumn(0.467, ends=True), PageColumn(0.594, ends=True), PageColumn(0.690, ends=True),
    PageColumn(0.715, MEDIUM, room=0.285),
)  # fmt: skip


def _paint_table(page: Page, report: SessionReport, top: float) -> float:
    figures = report.figures
    rows = [row for row in table_rows(figures, report.previous, report.other_hand) if row.best]
    if not rows and figures.has_passive:
        return top  # the table of what was passive says all there is
    top += 18 + page.title(tr("Range of motion"), top + 11, repetition_words(figures))
    heads = column_names(figures, report.previous, report.other_hand)
    y = page.table(TABLE, [_cells(row) for row in rows], top, heads=_cells(heads))
    if source := norm_words(figures):
        page.small_line(source, y + 9.5, 7.5)
        y += 10.0
    return y


def _cells(row: TableRow) -> tuple[str, ...]:
    return (
        row.movement, row.today, row.best, row.other_hand, row.usual, row.last, row.short_change or row.change,
    )  # fmt: skip


def _paint_active_passive(page: Page, report: SessionReport, top: float) -> float:
    """Active and passive beside each other, with what was measured by hand, where there is more than the first."""
    found = active_passive(report.figures, report.by_hand if report.form.has("by_hand") else ())
    if found is None:
        return top
    said = "" if report.figures.wrist_ranges or report.joints is not None else repetition_words(report.figures)
    y = top + 18 + page.title(tr("Active and passive"), top + 18, said)
    if found.said:
        y = page.said(found.said, y, 9.0, MEDIUM)
    y = paint_words(page, found.heads, found.rows, y)
    return page.said(found.note, y + 2, 7.5, REGULAR, "text2") if found.note else y


def paint_words(page: Page, heads: Sequence[str], rows: Sequence[Sequence[str]], top: float) -> float:
    """A table of words in even columns, the first one wider, smaller where a word is too long; the lower edge."""
    step = 1.0 / (len(heads) + 0.4)
    gap = 4.0 / (page.right - page.left)
    columns = [PageColumn(0.0, room=1.4 * step - gap)]
    columns += [PageColumn((k + 0.4) * step, room=step - gap) for k in range(1, len(heads))]
    return page.table(columns, rows, top + 3, heads=heads, head_pt=8.0, pitch_pt=14.5, drop_pt=3.5)


def _paint_curves(page: Page, report: SessionReport, top: float) -> float:
    aside = tr("grey: repetitions; band: ± 1 sd of the angle")
    if any(math.isfinite(target) for target in report.figures.targets_deg):
        aside += "; " + tr("dashed: target")
    page.title(tr("Angles over time"), top + 11, aside)
    plot = SessionPlot(
        report.curves, report.figures.exercise, report.figures.repetitions, -1,
        *report.figures.targets_deg,
    )  # fmt: skip
    box = page.box(page.left, top + 10, page.right - page.left, 158 + 36)
    if not page.is_trial:
        paint_session(page.painter, page.style, plot, box)
    return top + 30 + 158 + 16


def _bars_end_deg(exercise: Exercise, angles: Sequence[int]) -> float:
    """The end of the axis of the bars; a forearm goes beyond 90 degrees of pronation."""
    if PRONOSUPINATION in angles and is_from_thumb_up(exercise):
        return 120.0
    return AXIS_TICK_DEG[angles[0]] if len(angles) == 1 else 80.0


def _paint_bars(page: Page, report: SessionReport, top: float) -> float:
    """Today, last time and the other hand from one end of the movement to the other."""
    figures = report.figures
    angles = [figures.exercise.angle] if figures.exercise.angle is not None else [1, 0, 2]
    bars: list[tuple[str, SessionFigures, int, float, str]] = []
    for angle in angles:
        several = {0: tr("Today side"), 1: tr("Today bending"), 2: tr("Today turning")}
        bars.append((tr("Today") if len(angles) == 1 else several[angle], figures, angle, 8.0, CURVE_TOKENS[angle]))
    if len(angles) == 1 and report.previous is not None:
        bars.append((numbers.day_beside(report.previous.when, figures.when), report.previous, angles[0], 6.0, "border"))
    if len(angles) == 1 and report.other_hand is not None:
        bars.append((terms.hand_name(report.other_hand.side), report.other_hand, angles[0], 3.0, "text2"))
    bars = [bar for bar in bars if any(row.angle == bar[2] for row in bar[1].wrist_ranges)]
    if not bars:
        return top - 8
    compared = any(shown is not figures for _, shown, *_ in bars)
    page.title(tr("Range today, last time and other hand") if compared else tr("Range today"), top + 11)
    tick = _bars_end_deg(figures.exercise, angles)
    left, right = page.left + 78, page.right - 6
    area_top, height = top + 20, 15.0 * len(bars) + 6

    def x(value_deg: float) -> float:
        return left + (max(-tick, min(tick, value_deg)) + tick) / (2 * tick) * (right - left)

    upper, lower = SIDES[angles[0]]
    for movement, sign in ((upper, 1.0), (lower, -1.0)):
        norm = wrist_norm(movement, angles[0], figures.exercise)
        if norm is not None:
            ends = sorted((x(sign * norm.low_deg), x(sign * norm.high_deg)))
            width = max(ends[1] - ends[0], 1.5)
            page.painter.fillRect(page.box(ends[0], area_top, width, height), QColor(LIGHT.norm))
    step = tick / 4
    for k in range(-4, 5):
        value = k * step
        page.line((x(value), area_top), (x(value), area_top + height), "border" if k == 0 else "line")
        label = f"{written(abs(value))}°"
        page.text(label, x(value) - page.width_of(label, 8.5) / 2, area_top + height + 11, 8.5, REGULAR, "text2")
    for place, (name, shown, angle, thick, token) in enumerate(bars):
        middle = area_top + 10.5 + 15.0 * place
        page.text(name, page.left, middle + 3, 9.0, MEDIUM)
        _paint_bar(page, shown, angle, middle, thick, token, x)
    foot = area_top + height + 21
    if len(angles) == 1:
        page.text(terms.movement_name(lower), left, foot, 8.5, REGULAR, "text2")
        page.text_right(terms.movement_name(upper), right, foot, 8.5, REGULAR, "text2")
        if wrist_norm(upper, angles[0], figures.exercise) is not None:
            words = tr("grey: usual in adults (AMA, AAOS)")
            page.text(words, 0.5 * (left + right) - page.width_of(words, 8.5) / 2, foot, 8.5, REGULAR, "text2")
    return foot + 2


def _paint_bar(page: Page, figures: SessionFigures, angle: int, middle: float, thick: float, token: str, x) -> None:  # type: ignore[no-untyped-def]
    upper, lower = SIDES[angle]
    of = WRIST_ANGLES[angle]
    top_row, bottom_row = figures.find(of, upper), figures.find(of, lower)
    high = top_row.mean if top_row else 0.0
    low = -bottom_row.mean if bottom_row else 0.0
    page.fill(x(low), middle - thick / 2, x(high) - x(low), thick, token, 1.0)
    if thick < 7:
        return
    for value, row in ((high, top_row), (low, bottom_row)):
        if row is not None and math.isfinite(row.sd):
            ends = x(value - row.sd), x(value + row.sd)
            page.line((ends[0], middle), (ends[1], middle), "text", 0.9)
            for end in ends:
                page.line((end, middle - 3), (end, middle + 3), "text", 0.9)


def paint_boxes(page: Page, report: SessionReport, top: float) -> float:
    """How sure the figures are beside speed, pain and notes, as far as they are wanted."""
    lines, others = quality_lines(report.figures), other_lines(report.figures)
    good = all(fine for _, _, fine in lines)
    sure, other = report.form.has("quality") or not good, report.form.has("speed")  # doubts are never left out
    if not (sure or other):
        return top
    notes = "  ".join(f"“{text}”" for _, text in report.figures.notes[:3])
    gap = 12.0
    width = (page.right - page.left - gap) / 2
    rows = max(len(lines) * sure, (len(others) + (2 if notes else 0)) * other)
    height = 24 + 13.5 * rows + 6
    left = page.left
    if sure:
        said = [(name, value, "text" if fine else "warn") for name, value, fine in lines]
        _paint_box(page, QRectF(left, top, width, height), tr("How sure are these figures?"), said)
        sign = page.box(left + width - INSIDE_PT - 12, top + 7, 12, 12)
        state: State = "good" if good else "warn"
        paint_state(page.painter, state, sign, QColor(getattr(LIGHT, state)), QColor("#FFFFFF"))
        left += width + gap
    if other:
        said = [(name, value, "text") for name, value in others]
        baseline = _paint_box(page, QRectF(left, top, width, height), tr("Speed, pain, note"), said)
        if notes:
            room = width - 2 * INSIDE_PT
            most = int(2 * room / page.width_of("n", 8.5))
            shown = notes if len(notes) <= most else notes[: most - 1] + "…"
            page.paragraph(shown, left + INSIDE_PT, baseline - 9, room, 8.5)
    return top + height


def _paint_box(page: Page, box: QRectF, title: str, lines: Sequence[tuple[str, str, str]]) -> float:
    """A card with names and their values; returns the baseline of the line after them."""
    page.card(box.left(), box.top(), box.width(), box.height())
    page.text(title, box.left() + INSIDE_PT, box.top() + 17, 10.0, SEMIBOLD)
    baseline = box.top() + 33
    for name, value, token in lines:
        both = f"{name}  {value}"  # where they are long both are printed smaller, never over one another
        size = page.fitting(both, box.width() - 2 * INSIDE_PT, 8.5, MEDIUM)
        page.text(name, box.left() + INSIDE_PT, baseline, size, REGULAR, "text2")
        page.text_right(value, box.right() - INSIDE_PT, baseline, size, MEDIUM, token)
        baseline += 13.5
    return baseline


def _paint_told(page: Page, report: SessionReport, top: float) -> float:
    """What persons add: values by hand and the comment; where the foot begins."""
    return _paint_comment(page, report, _paint_by_hand(page, report, top))


def comment_lines(page: Page, comment: str) -> list[str]:
    """The comment as it is broken into lines."""
    width = page.right - page.left
    return [line for part in comment.splitlines() for line in page.lines(part, width, COMMENT_PT)]


def is_short(page: Page, comment: str) -> bool:
    """Whether the comment has room on the first page."""
    return len(comment_lines(page, comment)) <= MOST_COMMENT_LINES


def _paint_comment(page: Page, report: SessionReport, top: float) -> float:
    """The comment, or where it is; where the foot begins."""
    if not report.comment.strip():
        return top
    if not is_short(page, report.comment):
        words = tr("The therapist’s comment is on the last page.")
        return page.said(words, top, 8.5, MEDIUM) + 5
    page.text(tr("Comment of the therapist"), page.left, top + 9, 10.0, SEMIBOLD)
    return paint_comment_lines(page, comment_lines(page, report.comment), top + 12) + 5


def paint_comment_lines(page: Page, lines: Sequence[str], top: float) -> float:
    """Lines that are broken already, as they are; returns the lower edge."""
    for line in lines:
        page.text(line, page.left, top + COMMENT_PT, COMMENT_PT)
        top += COMMENT_LEADING_PT
    return top


def _paint_by_hand(page: Page, report: SessionReport, top: float) -> float:
    """What was entered by hand that day, in one paragraph; where the foot begins."""
    if not report.by_hand or not report.form.has("by_hand"):
        return top + 10
    words = tr("Entered by hand, not measured by Carpus: {values}.").format(values=day_words(report.by_hand))
    return page.said(words, top + 5, 8.5) + 5


def _speaks_of_error(report: SessionReport) -> bool:
    """Whether any change is judged on the page, against its measurement error."""
    figures = report.figures
    rows = list(figures.wrist_ranges)
    if report.joints is not None:
        joints = [figure.joint for figure in compared_figures(figures)]
        rows = [row for row in figures.joint_ranges if row.what == "arc" and row.of in joints]
    before = [item for item in (report.previous, report.first) if item is not None]
    return any(item.verdict != "not_judged" for earlier in before for item in compare(earlier, figures, rows))


def _paint_foot(page: Page, report: SessionReport, top: float) -> float:
    figures = report.figures
    page.rule(top)
    by_hand = report.by_hand if report.form.has("by_hand") else ()
    said = method(figures, report.markers, compared=_speaks_of_error(report), by_hand=by_hand)
    y = page.said(said, top + 4, 8.0, REGULAR, "text2")
    y = page.said(terms.LEGAL_SENTENCE, y + 3, 8.0, SEMIBOLD)
    residual = figures.quality.residual_mm
    made_by = f" ({report.revision[:7]})" if report.revision else ""
    parts = [tr("Session {id}").format(id=figures.session_id[:8]), f"Carpus {figures.software_version}{made_by}"]
    if report.settings_digest:
        parts.append(tr("settings {digest}").format(digest=report.settings_digest[:4]))
    if report.digest:
        parts.append(tr("data {digest}").format(digest=f"{report.digest[:4]}…{report.digest[-4:]}"))
    if report.recording_digest:
        digest = f"{report.recording_digest[:4]}…{report.recording_digest[-4:]}"
        parts.append(tr("recording {digest}").format(digest=digest))
    if math.isfinite(residual):
        parts.append(tr("calibrated to {size} mm").format(size=numbers.fixed(residual, 1)))
    parts.append(tr("smoothed") if figures.smoothed else tr("as measured live"))
    page.small_line(" · ".join(parts), max(y + 12, A4_PT[1] - MARGIN_PT + 8))
    return y + 12

"""The progress report: the answer, the chart, the table, why sessions were left out. One page of A4."""

from __future__ import annotations

from dataclasses import dataclass

from core.output.report_content import Progress
from ui import numbers, terms
from ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from ui.progress.chart_painter import paint_chart
from ui.progress.words import before_after, change_line, comparison_name, doubt_words, headline, unfair_words
from ui.report.page import A4_PT, MARGIN_PT, Page
from ui.report.session_page import paint_head, paint_watermark, painted_on_nothing
from ui.translate import tr
from ui.verdicts import verdict_token, verdict_word

CHART_HEIGHT_PT, LEAST_CHART_PT = 390.0, 180.0
MOST_UNFAIR = 4


@dataclass(frozen=True, slots=True)
class ProgressReport:
    """All that is on the page."""

    progress: Progress
    pseudonym: str
    therapist: str = ""


def paint_progress_page(page: Page, report: ProgressReport) -> None:
    """Paint everything from the upper to the lower margin."""
    progress = report.progress
    if any(point.figures.simulated for point in progress.points):
        paint_watermark(page)
    newest = progress.points[-1].figures
    what = f"{terms.exercise_name(newest.exercise.id)}, {terms.hand_name(newest.side).lower()}"
    y = paint_head(page, tr("Progress report"), report.pseudonym, what)
    first, last = progress.points[0].figures, newest
    pairs = [
        (tr("Sessions"), str(len(progress.points))),
        (tr("First"), numbers.report_date(first.when)),
        (tr("Last"), numbers.report_date(last.when)),
        (tr("Therapist"), report.therapist or numbers.UNKNOWN),
    ]
    page.facts(pairs, y + 5, (0.0, 0.2, 0.47, 0.76))
    page.rule(y + 36)
    answer, basis = headline(progress)
    width = page.right - page.left
    y = page.paragraph(answer, page.left, y + 44, width, 14.0, SEMIBOLD)
    y = page.paragraph(basis, page.left, y + 1, width, 9.5, REGULAR, "text2")
    foot = A4_PT[1] - MARGIN_PT
    below = painted_on_nothing(page, lambda trial: _paint_below(trial, progress, 22.0))
    height = min(CHART_HEIGHT_PT, max(foot - 34 - 8 - below - y, LEAST_CHART_PT))
    paint_chart(page.painter, page.style, page.box(page.left, y + 8, width, height), progress)
    _paint_below(page, progress, y + height + 22)
    page.paragraph(terms.LEGAL_SENTENCE, page.left, foot - 34, width, 8.0, SEMIBOLD)
    ids = " · ".join(point.figures.session_id[:8] for point in progress.points[-8:])
    words = tr("Sessions {ids} · Carpus {version}").format(ids=ids, version=newest.software_version)
    page.text(words, page.left, foot + 8, 8.0, REGULAR, "text2")


def _paint_below(page: Page, progress: Progress, top: float) -> float:
    """What stands under the chart; returns the lower edge."""
    return _paint_fairness(page, progress, _paint_table(page, progress, top) + 16)


def _paint_table(page: Page, progress: Progress, top: float) -> float:
    first, last = progress.first, progress.last
    if first is None or last is None or not progress.comparisons:
        return top
    days = tr("{first} and {last}").format(
        first=numbers.day_beside(first.when, last.when), last=numbers.day_beside(last.when, first.when)
    )
    counts = tr("{before} and {after} repetitions").format(before=first.counted, after=last.counted)
    page.title(tr("First to last session"), top, f"{days} · {counts}")
    baseline = top + 6
    for item in progress.comparisons:
        page.rule(baseline)
        baseline += 15.5
        page.text(comparison_name(item), page.left, baseline - 4, 9.0, MEDIUM)
        page.text(before_after(item), page.left + 130, baseline - 4, 9.0, SEMIBOLD)
        page.text(change_line(item), page.left + 240, baseline - 4, 9.0)
        page.text_right(
            verdict_word(item.verdict), page.right, baseline - 4, 9.0, SEMIBOLD, verdict_token(item.verdict)
        )
    page.rule(baseline)
    return baseline


def _paint_fairness(page: Page, progress: Progress, top: float) -> float:
    unfair = [point for point in progress.points if not point.fair]
    page.title(tr("Fair comparison"), top + 6)
    width, y = page.right - page.left, top + 11
    for point in unfair[:MOST_UNFAIR]:
        y = page.paragraph(unfair_words(point, progress), page.left, y, width, 9.0)
    for words in [said for point in progress.points if (said := doubt_words(point, progress))][:MOST_UNFAIR]:
        y = page.paragraph(words, page.left, y, width, 9.0, REGULAR, "warn")
    if not unfair:
        y = page.paragraph(tr("All sessions were set up alike."), page.left, y, width, 9.0)
    words = tr(
        "± is the spread between repetitions. “Error” is the smallest difference that can be called a change: "
        "published values for the same protocol, side and set-up, until the clinic has measured its own."
    )
    return page.paragraph(words, page.left, y + 2, width, 8.0, REGULAR, "text2")

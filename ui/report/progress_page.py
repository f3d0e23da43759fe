"""The progress report: the answer, the chart, the table, why sessions were left out. One page of A4."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import Progress
from carpus.core.results.report_form import USUAL_FORM, ReportForm
from carpus.ui import numbers, terms
from carpus.ui.fonts import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.plot.course import paint_chart
from carpus.ui.report.page import A4_PT, MARGIN_PT, Page, PageColumn, painted_on_nothing
from carpus.ui.report.session_page import paint_head
from carpus.ui.translate import inside, tr
from carpus.ui.verdicts import counted_once_words, limit_words, verdict_token, verdict_word
from carpus.ui.words.by_hand import change_words, changes, day_words, full_name, verdict_words
from carpus.ui.words.progress import before_after, change_line, comparison_name, doubt_words, headline, unfair_words

CHART_HEIGHT_PT, LEAST_CHART_PT = 390.0, 180.0
MOST_UNFAIR = 4
MOST_IDS = 8
MOST_BY_HAND, MOST_DAYS = 5, 3
"""So many changes, and days of what was taken once, are on the page; the table of them has all."""
CHANGED = (PageColumn(0.0, MEDIUM), PageColumn(0.255, SEMIBOLD), PageColumn(0.47), PageColumn(1.0, ends=True))
BY_HAND = (PageColumn(0.0, MEDIUM), PageColumn(0.372), PageColumn(1.0, SEMIBOLD, ends=True))


@dataclass(frozen=True, slots=True)
class ProgressReport:
    """All that is on the page."""

    progress: Progress
    pseudonym: str
    therapist: str = ""
    made_by: str = ""
    """Version and revision of the program that makes the report."""
    form: ReportForm = USUAL_FORM
    language: str = ""
    """The language it is painted in, by two letters; empty for the window's."""

    @property
    def sessions(self) -> tuple[SessionFigures, ...]:
        return tuple(point.figures for point in self.progress.points)


def paint_progress_page(page: Page, report: ProgressReport) -> None:
    """Paint everything from the upper to the lower margin."""
    progress = report.progress
    newest = progress.points[-1].figures
    what = f"{terms.exercise_name(newest.exercise.id)}, {inside(terms.hand_name(newest.side))}"
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
    y = page.said(answer, y + 44, 14.0, SEMIBOLD)
    y = page.said(basis, y + 1, 9.5, REGULAR, "text2")
    foot = A4_PT[1] - MARGIN_PT
    below = painted_on_nothing(page, lambda trial: _paint_below(trial, progress, 22.0))
    height = min(CHART_HEIGHT_PT, max(foot - 34 - 8 - below - y, LEAST_CHART_PT))
    paint_chart(page.painter, page.style, page.box(page.left, y + 8, width, height), progress)
    _paint_below(page, progress, y + height + 22)
    paint_made_of(page, report.made_by, report.sessions)


def paint_made_of(page: Page, made_by: str, sessions: Sequence[SessionFigures]) -> None:
    """The legal sentence and what the page is made of, at its foot."""
    foot = A4_PT[1] - MARGIN_PT
    page.said(terms.LEGAL_SENTENCE, foot - 34, 8.0, SEMIBOLD)
    page.small_line(made_of(made_by, sessions), foot + 8)


def made_of(made_by: str, sessions: Sequence[SessionFigures]) -> str:
    """``Made by Carpus 0.1.0 (1a2b3c4) of 7 sessions: 0b1c2d3e … · they were measured by Carpus 0.1.0``."""
    ids = ", ".join(figures.session_id[:8] for figures in sessions[-MOST_IDS:])
    if len(sessions) > MOST_IDS:
        ids = f"…, {ids}"
    versions = ", ".join(sorted({figures.software_version for figures in sessions}))
    of = tr("1 session: {ids}") if len(sessions) == 1 else tr("{count} sessions: {ids}")
    return " · ".join(
        (
            tr("Made by Carpus {version}").format(version=made_by),
            of.format(count=len(sessions), ids=ids),
            tr("measured by Carpus {versions}").format(versions=versions),
        )
    )


def _paint_below(page: Page, progress: Progress, top: float) -> float:
    """What stands under the chart; returns the lower edge."""
    return _paint_fairness(page, progress, _paint_by_hand(page, progress, _paint_table(page, progress, top)) + 16)


def _paint_table(page: Page, progress: Progress, top: float) -> float:
    first, last = progress.first, progress.last
    if first is None or last is None or not progress.comparisons:
        return top
    days = tr("{first} and {last}").format(
        first=numbers.day_beside(first.when, last.when), last=numbers.day_beside(last.when, first.when)
    )
    counts = tr("{before} and {after} repetitions").format(before=first.counted, after=last.counted)
    page.title(tr("First to last session"), top, f"{days} · {counts}")
    rows = [
        (
            comparison_name(item, progress.comparisons), before_after(item), change_line(item),
            (verdict_word(item.verdict), SEMIBOLD, verdict_token(item.verdict)),
        )
        for item in progress.comparisons
    ]  # fmt: skip
    return page.table(CHANGED, rows, top + 6, drop_pt=4.0)


def _paint_by_hand(page: Page, progress: Progress, top: float) -> float:
    """What was measured by hand, each way for itself; values of one day only in one paragraph."""
    if not progress.by_hand:
        return top
    page.title(tr("Entered by hand"), top + 22, tr("never joined with the figures above"))
    changed = changes(progress.by_hand)
    rows = [(full_name(key), change_words(one), verdict_words(one)[1]) for key, one in changed[:MOST_BY_HAND]]
    y = page.table(BY_HAND, rows, top + 28, drop_pt=4.0)
    known = {key for key, _ in changed[:MOST_BY_HAND]}
    rest = [one for one in progress.by_hand if one.key not in known]
    words = "; ".join(
        f"{numbers.day_month(day)}: {day_words([one for one in rest if one.day == day])}"
        for day in sorted({one.day for one in rest})[-MOST_DAYS:]
    )
    return page.said(words, y + 4, 8.5) if words else y


def _paint_fairness(page: Page, progress: Progress, top: float) -> float:
    unfair = [point for point in progress.points if not point.fair]
    page.title(tr("Fair comparison"), top + 6)
    y = top + 11
    for point in unfair[:MOST_UNFAIR]:
        y = page.said(unfair_words(point, progress), y, 9.0)
    for words in [said for point in progress.points if (said := doubt_words(point, progress))][:MOST_UNFAIR]:
        y = page.said(words, y, 9.0, REGULAR, "warn")
    if not unfair:
        y = page.said(tr("All sessions were set up alike."), y, 9.0)
    if once := counted_once_words(progress.earlier_results):
        y = page.said(once, y, 9.0)
    words = f"{tr('± is the spread between repetitions.')} {limit_words(progress.study)}"
    return page.said(words, y + 2, 8.0, REGULAR, "text2")

"""The progress report: the answer, the chart, the table, why sessions were left out. One page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from PySide6.QtWidgets import QLayout

from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import Progress
from carpus.core.results.report_form import USUAL_FORM, ReportForm
from carpus.ui import numbers
from carpus.ui.controls.layouts import STRETCH, Part
from carpus.ui.controls.text import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.plot.course import paint_chart
from carpus.ui.report.page import (
    CHART,
    Body,
    PaintedPart,
    column,
    facts,
    legal_line,
    paragraph,
    rule,
    session_head,
    table,
    title,
)
from carpus.ui.translate import tr
from carpus.ui.verdicts import counted_once_words, limit_words, verdict_token, verdict_word
from carpus.ui.words.by_hand import change_words, changes, day_words, full_name, verdict_words
from carpus.ui.words.progress import before_after, change_line, comparison_name, doubt_words, headline, unfair_words
from carpus.ui.words.table import Cell, TableColumn

MIN_CHART_PT, MAX_CHART_PT = 180.0, 420.0
MOST_UNFAIR = 4
MOST_IDS = 8
MOST_BY_HAND, MOST_DAYS = 5, 3
"""So many changes, and days of what was taken once, are on the page; the table of them has all."""
CHANGED = (TableColumn(MEDIUM), TableColumn(SEMIBOLD), TableColumn(), TableColumn(ends=True))
BY_HAND = (TableColumn(MEDIUM), TableColumn(), TableColumn(SEMIBOLD, ends=True))


def _kind() -> str:
    return tr("progress")


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

    @property
    def kind(self) -> str:
        return _kind()

    def bodies(self) -> list[Body]:
        return [partial(_body, self)]


def _body(report: ProgressReport, number: str) -> QLayout:
    progress = report.progress
    first, newest = progress.points[0].figures, progress.points[-1].figures
    pairs = [
        (tr("Sessions"), str(len(progress.points))),
        (tr("First"), numbers.report_date(first.when)),
        (tr("Last"), numbers.report_date(newest.when)),
        (tr("Therapist"), report.therapist or numbers.UNKNOWN),
    ]
    answer, basis = headline(progress)
    chart = PaintedPart(lambda painter, box: paint_chart(painter, CHART, box, progress), MIN_CHART_PT, MAX_CHART_PT)
    return column(
        session_head(newest, report.pseudonym, tr("Progress report"), number),
        facts(pairs),
        rule(),
        column(paragraph(answer, 14.0, SEMIBOLD), paragraph(basis, 9.5, REGULAR, "text2")),
        chart,
        *_changes(progress),
        *_changes_by_hand(progress),
        _fairness(progress),
        STRETCH,
        column(legal_line(), paragraph(made_of(report.made_by, report.sessions), 8.0, REGULAR, "text2"), gap=3.0),
        gap=7.0,
    )


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


def _changes(progress: Progress) -> list[Part]:
    first, last = progress.first, progress.last
    if first is None or last is None or not progress.comparisons:
        return []
    days = tr("{first} and {last}").format(
        first=numbers.day_beside(first.when, last.when), last=numbers.day_beside(last.when, first.when)
    )
    counts = tr("{before} and {after} repetitions").format(before=first.counted, after=last.counted)
    rows = [
        (
            comparison_name(item, progress.comparisons), before_after(item), change_line(item),
            Cell(verdict_word(item.verdict), SEMIBOLD, verdict_token(item.verdict)),
        )
        for item in progress.comparisons
    ]  # fmt: skip
    shown = table(CHANGED, (), rows)
    return [column(title(tr("First to last session"), f"{days} · {counts}"), shown, gap=2.0)]


def _changes_by_hand(progress: Progress) -> list[Part]:
    """What was measured by hand, each way for itself; values of one day only in one paragraph."""
    if not progress.by_hand:
        return []
    changed = changes(progress.by_hand)
    rows = [(full_name(key), change_words(one), verdict_words(one)[1]) for key, one in changed[:MOST_BY_HAND]]
    shown = table(BY_HAND, (), rows)
    known = {key for key, _ in changed[:MOST_BY_HAND]}
    rest = [one for one in progress.by_hand if one.key not in known]
    words = "; ".join(
        f"{numbers.day_month(day)}: {day_words([one for one in rest if one.day == day])}"
        for day in sorted({one.day for one in rest})[-MOST_DAYS:]
    )
    below = [paragraph(words, 8.5)] if words else []
    return [column(title(tr("Entered by hand"), tr("never joined with the figures above")), shown, *below, gap=2.0)]


def _fairness(progress: Progress) -> QLayout:
    unfair = [unfair_words(point, progress) for point in progress.points if not point.fair]
    doubts = [words for point in progress.points if (words := doubt_words(point, progress))]
    lines = [paragraph(words) for words in unfair[:MOST_UNFAIR]]
    lines += [paragraph(words, token="warn") for words in doubts[:MOST_UNFAIR]]
    if not unfair:
        lines.append(paragraph(tr("All sessions were set up alike.")))
    if once := counted_once_words(progress.earlier_results):
        lines.append(paragraph(once))
    words = f"{tr('± is the spread between repetitions.')} {limit_words(progress.study)}"
    return column(title(tr("Fair comparison")), *lines, paragraph(words, 8.0, REGULAR, "text2"), gap=2.0)

"""Progress report on one page: answer, chart, table and comparability."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import ClassVar

from PySide6.QtWidgets import QLayout, QVBoxLayout

from carpus.core.measures.manual_measurements import ManualChange, ManualValue, MeasureKey
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.platform.provenance import version_with_revision
from carpus.core.records.values import Patient
from carpus.core.results.progress import Progress, compute_progress, find_other_hand
from carpus.core.results.ranges import progress_keys
from carpus.core.results.report_form import DEFAULT_FORM, ReportForm
from carpus.core.results.session_results import SessionResults
from carpus.ui.charts.progress import ProgressChart
from carpus.ui.kit import numbers
from carpus.ui.kit.layouts import STRETCH, Part
from carpus.ui.kit.table import VERDICT_TOKENS, Cell, TableColumn
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD
from carpus.ui.kit.translate import tr, translate_phrase
from carpus.ui.report.page import (
    chart_part,
    column,
    exercise_head,
    fact_row,
    legal_line,
    paged_table,
    paragraph,
    rule,
    section_title,
    table,
)
from carpus.ui.words.fingers import progress_choices
from carpus.ui.words.manual_values import (
    change_words,
    day_words,
    find_changes,
    full_name,
    list_other_values,
    verdict_words,
)
from carpus.ui.words.progress import (
    change_line,
    comparability_lines,
    compared_words,
    comparison_name,
    error_limit_words,
    headline,
    value_pair,
    verdict_word,
)

MIN_CHART_PT, MAX_CHART_PT = 180.0, 420.0
MAX_EXCLUDED = 4
MAX_IDS = 8
# More of them are on a page of their own.
MAX_MANUAL_CHANGES, MAX_DAYS = 5, 3
CHANGE_COLUMNS = (TableColumn(MEDIUM), TableColumn(SEMIBOLD), TableColumn(), TableColumn(is_right_aligned=True))
MANUAL_COLUMNS = (TableColumn(MEDIUM), TableColumn(), TableColumn(SEMIBOLD, is_right_aligned=True))


@dataclass(frozen=True, slots=True)
class ProgressReport:
    """Report over the sessions of one exercise and hand."""

    kind: ClassVar[Phrase] = phrase("progress")
    title: ClassVar[Phrase] = phrase("Progress report")
    progress: Progress
    pseudonym: str
    printed_patient: Patient | None = None
    therapist: str = ""
    # Version and revision of the program.
    made_by: str = ""
    form: ReportForm = DEFAULT_FORM
    # Two letters; empty for the window's.
    language: str = ""

    @property
    def sessions(self) -> tuple[SessionResults, ...]:
        return tuple(point.results for point in self.progress.points)

    def head(self, number: str) -> QLayout:
        return exercise_head(self, translate_phrase(self.title), number)

    def pages(self) -> list[QVBoxLayout]:
        """Return the page, and all manual measurements if there are more than it has room for."""
        return [_first_page(self), *_manual_pages(self)]


def build_progress_report(
    sessions: Sequence[SessionResults],
    *,
    pseudonym: str = "",
    therapist: str = "",
    choice: str | None = None,
    manual_values: Sequence[ManualValue] = (),
    form: ReportForm | None = None,
    language: str = "",
    other_hand: SessionResults | None = None,
) -> ProgressReport:
    """Build the progress report of the newest session's exercise and hand.

    ``choice`` is what is followed of a whole hand, as in :func:`progress_choices`, the first one by default.
    ``manual_values`` are those of this hand and person. ``other_hand`` is used if the ``sessions`` have none of it.
    """
    newest = max(sessions, key=lambda results: results.when)
    alike = [f for f in sessions if (f.exercise.id, f.side) == (newest.exercise.id, newest.side)]
    kinds = progress_choices(newest)
    followed = progress_keys(choice if choice is not None else kinds[0][0]) if kinds else ()
    course = compute_progress(alike, other_hand or find_other_hand(sessions, newest), followed)
    course = replace(course, manual_measurements=tuple(manual_values))
    name = pseudonym or newest.subject_id or "–"
    return ProgressReport(
        course, name, therapist=therapist, made_by=version_with_revision(), form=form or ReportForm(), language=language
    )


def _first_page(report: ProgressReport) -> QVBoxLayout:
    progress = report.progress
    first, newest = progress.points[0].results, progress.points[-1].results
    pairs = [
        (tr("Sessions"), str(len(progress.points))),
        (tr("First"), numbers.format_date_time(first.when)),
        (tr("Last"), numbers.format_date_time(newest.when)),
        (tr("Therapist"), report.therapist or numbers.UNKNOWN),
    ]
    answer, basis = headline(progress)
    chart = chart_part(partial(ProgressChart, progress=progress), MIN_CHART_PT, MAX_CHART_PT)
    return column(
        fact_row(pairs),
        rule(),
        column(paragraph(answer, 14.0, SEMIBOLD), paragraph(basis, 9.5, REGULAR, "text2")),
        chart,
        *_changes(progress),
        *_manual_changes(progress),
        _comparability(progress),
        STRETCH,
        column(
            legal_line(), paragraph(provenance_words(report.made_by, report.sessions), 8.0, REGULAR, "text2"), gap=3.0
        ),
        gap=7.0,
    )


def provenance_words(made_by: str, sessions: Sequence[SessionResults]) -> str:
    """Return which program made the report, of which sessions, and which program measured them."""
    ids = ", ".join(results.session_id[:8] for results in sessions[-MAX_IDS:])
    if len(sessions) > MAX_IDS:
        ids = f"…, {ids}"
    versions = ", ".join(sorted({results.software_version for results in sessions}))
    pattern = tr("1 session: {ids}") if len(sessions) == 1 else tr("{count} sessions: {ids}")
    return " · ".join(
        (
            tr("Made with Carpus {version}").format(version=made_by),
            pattern.format(count=len(sessions), ids=ids),
            tr("measured with Carpus {versions}").format(versions=versions),
        )
    )


def _changes(progress: Progress) -> list[Part]:
    if not (aside := compared_words(progress)):
        return []
    rows = [
        (
            comparison_name(item, progress.comparisons), value_pair(item), change_line(item),
            Cell(verdict_word(item.verdict), SEMIBOLD, VERDICT_TOKENS.get(item.verdict, "text2")),
        )
        for item in progress.comparisons
    ]  # fmt: skip
    shown = table(CHANGE_COLUMNS, (), rows)
    return [column(section_title(tr("First to last session"), aside), shown, gap=2.0)]


def _manual_changes(progress: Progress) -> list[Part]:
    """Return the changes of each manual measure; values of a single day in one paragraph."""
    if not progress.manual_measurements:
        return []
    changed, rest = _split_manual_values(progress)
    rows = [(full_name(key), change_words(one), verdict_words(one)[1]) for key, one in changed[:MAX_MANUAL_CHANGES]]
    shown = table(MANUAL_COLUMNS, (), rows)
    words = "; ".join(
        f"{numbers.format_day_month(day)}: {day_words([one for one in rest if one.day == day])}"
        for day in sorted({one.day for one in rest})[-MAX_DAYS:]
    )
    below = [paragraph(words, 8.5)] if words else []
    aside = tr("not combined with the values above")
    if _has_manual_pages(progress):
        aside += "; " + tr("see the next page for the complete list")
    return [column(section_title(tr("Manual measurements"), aside), shown, *below, gap=2.0)]


def _split_manual_values(progress: Progress) -> tuple[list[tuple[MeasureKey, ManualChange]], list[ManualValue]]:
    """Return all changes, and the values that have none; pages of their own have those without room."""
    changed = find_changes(progress.manual_measurements)
    return changed, list_other_values(progress.manual_measurements, (key for key, _ in changed))


def _has_manual_pages(progress: Progress) -> bool:
    """Return whether the first page has no room for all manual measurements."""
    changed, rest = _split_manual_values(progress)
    return len(changed) > MAX_MANUAL_CHANGES or len({one.day for one in rest}) > MAX_DAYS


def _manual_pages(report: ProgressReport) -> list[QVBoxLayout]:
    """Return the manual measurements of every day, on as many pages as they need."""
    values, pages = report.progress.manual_measurements, []
    if not _has_manual_pages(report.progress):
        return []
    days = sorted({one.day for one in values})
    rows = [(numbers.format_date(day), day_words([one for one in values if one.day == day])) for day in days]
    for shown in paged_table(report.form, (TableColumn(MEDIUM, is_wrapped=False), TableColumn()), (), rows):
        pages.append(column(section_title(tr("Manual measurements")), shown, STRETCH, legal_line(), gap=7.0))
    return pages


def _comparability(progress: Progress) -> QLayout:
    lines = [paragraph(words, token=token) for words, token in comparability_lines(progress, MAX_EXCLUDED)]
    words = f"{tr('± is the SD between repetitions.')} {error_limit_words(progress.study)}"
    return column(section_title(tr("Comparability")), *lines, paragraph(words, 8.0, REGULAR, "text2"), gap=2.0)

"""First page of the session report: always light, readable in grey."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from datetime import date
from functools import lru_cache, partial
from typing import ClassVar

from PySide6.QtWidgets import QLayout, QVBoxLayout, QWidget

from carpus.core.measures.manual_measurements import ManualValue, session_values
from carpus.core.model.phrase import Phrase, phrase
from carpus.core.model.types import Side
from carpus.core.platform.provenance import parameter_section
from carpus.core.records.values import Patient
from carpus.core.results.motion_curves import MotionCurves, compute_motion_curves
from carpus.core.results.progress import (
    compare_ranges,
    compute_progress,
    error_limits,
    find_other_hand,
    find_previous,
    select_latest_versions,
)
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.report_form import DEFAULT_FORM, ReportForm
from carpus.core.results.session_results import SessionResults, compute_data_digest, compute_session_results
from carpus.core.results.valid_data import JointCurves, WristCurves, joint_curves, wrist_curves
from carpus.core.session.values import Session
from carpus.ui.charts.session import FLEXION_KINDS, HandPlot, SessionChart, SessionPlot
from carpus.ui.kit import numbers
from carpus.ui.kit.card import ColorFill
from carpus.ui.kit.layouts import STRETCH, Part
from carpus.ui.kit.table import cell_text
from carpus.ui.kit.text import MEDIUM, REGULAR, SEMIBOLD, Icon, PlainText
from carpus.ui.kit.translate import to_mid_sentence, tr, translate_phrase
from carpus.ui.report.motion_page import motion_page
from carpus.ui.report.page import (
    BODY_WIDTH_PT,
    PAPER,
    RoundedBox,
    break_lines,
    chart_part,
    column,
    exercise_head,
    fact_row,
    label,
    legal_line,
    line,
    paragraph,
    rule,
    section_title,
    table,
    to_layout_units,
    value_rows,
)
from carpus.ui.words import terms
from carpus.ui.words.active_passive import build_active_passive
from carpus.ui.words.finger_angles import KIND_TOKENS, kind_name
from carpus.ui.words.fingers import find_main_ranges, finger_table, limitation_words
from carpus.ui.words.manual_values import day_words
from carpus.ui.words.progress import correction_words
from carpus.ui.words.ranges import mean_words, range_table, reference_words, repetition_words
from carpus.ui.words.session import (
    hand_summary,
    method_words,
    pain_lines,
    quality_lines,
    warning_lines,
    wrist_summary,
)
from carpus.ui.words.terms import to_person

COMMENT_PT = 9.0
# A longer comment gets pages of its own.
MAX_COMMENT_LINES, LINES_ON_A_PAGE = 6, 52


@dataclass(frozen=True, slots=True)
class SessionReport:
    """Report of one session."""

    kind: ClassVar[Phrase] = phrase("report")
    title: ClassVar[Phrase] = phrase("Session report")
    results: SessionResults
    curves: WristCurves
    markers: int
    pseudonym: str
    # Whose real name is printed.
    printed_patient: Patient | None = None
    session_number: int = 0
    dominance: str = "unknown"
    diagnosis: str = ""
    onset: str = ""
    # Diagnosis and onset are printed only if the form includes them.
    onset_day: date | None = None
    therapist: str = ""
    previous: SessionResults | None = None
    first: SessionResults | None = None
    other_hand: SessionResults | None = None
    joints: JointCurves | None = None
    motion: MotionCurves | None = None
    digest: str = ""
    settings_digest: str = ""
    revision: str = ""
    recording_digest: str = ""
    # Of this hand and person, on the day of the session.
    manual_values: tuple[ManualValue, ...] = ()
    # The therapist's own words, several lines.
    comment: str = ""
    form: ReportForm = DEFAULT_FORM
    # Two letters; empty for the window's.
    language: str = ""

    @property
    def sessions(self) -> tuple[SessionResults, ...]:
        return (self.results,)

    def head(self, number: str) -> QLayout:
        return exercise_head(self, translate_phrase(self.title), number)

    def pages(self) -> list[QVBoxLayout]:
        """Return the pages of all sections that have content and are not excluded."""
        shown = [one for one in SECTIONS if one.has_content(self) and self.form.includes(one.name)]
        return [page for one in sorted(shown, key=lambda one: one.is_last) for page in one.make_pages(self)]


@dataclass(frozen=True, slots=True)
class ReportSection:
    """Section of the session report.

    The form may exclude a section with a ``label``, which the panel beside the report has a tick for. ``make_pages``
    lays out pages of its own below their heads, ``is_last`` behind those of all others; other sections are parts of
    the first page.
    """

    name: str
    label: str = ""
    has_content: Callable[[SessionReport], bool] = lambda report: True
    make_pages: Callable[[SessionReport], Sequence[QVBoxLayout]] = lambda report: ()
    is_last: bool = False


def build_session_report(
    session: Session,
    *,
    choices: RepetitionChoices | None = None,
    history: Sequence[SessionResults] = (),
    pseudonym: str = "",
    dominance: str = "unknown",
    therapist: str = "",
    manual_values: Sequence[ManualValue] = (),
    comment: str = "",
    form: ReportForm | None = None,
    language: str = "",
) -> SessionReport:
    """Build the report of a session.

    ``history`` are the results of the patient's other sessions, in any order. ``manual_values`` are all of the
    patient; those of the session's day and hand are used. ``language`` is empty for the window's.
    """
    results = compute_session_results(session, choices, error_limits(history))
    known = next((other for other in history if other.session_id == results.session_id), results)
    older = all(one is not results for one in select_latest_versions((*history, results)))
    results = replace(results, earlier_results=known.earlier_results, is_superseded=older)
    earlier = [other for other in history if other.when < results.when]
    alike = [other for other in earlier if (other.exercise.id, other.side) == (results.exercise.id, results.side)]
    fair = [point.results for point in compute_progress(alike).points if point.is_comparable]
    made_by, source = (
        parameter_section(session.header.parameters, "provenance"),
        parameter_section(session.header.parameters, "source"),
    )
    return SessionReport(
        results=results,
        curves=wrist_curves(session),
        joints=joint_curves(session),
        motion=compute_motion_curves(session),
        markers=len(session.header.protocol.markers),
        pseudonym=pseudonym or session.header.subject_id or "–",
        session_number=sum(one.side == results.side for one in select_latest_versions(earlier)) + 1 if history else 0,
        dominance=dominance,
        therapist=therapist,
        previous=find_previous(history, results),
        first=fair[0] if fair else None,
        other_hand=find_other_hand(history, results),
        digest=compute_data_digest(session),
        settings_digest=hashlib.sha256(session.header.parameters.encode()).hexdigest(),
        revision=str(made_by.get("revision") or ""),
        recording_digest=str(source.get("sha256") or ""),
        manual_values=session_values(manual_values, results.side, results.when.date()),
        comment=comment,
        form=form or ReportForm(),
        language=language,
    )


@dataclass(frozen=True, slots=True)
class DerivedReport:
    """Page made from a session report."""

    report: SessionReport

    @property
    def form(self) -> ReportForm:
        return self.report.form

    @property
    def pseudonym(self) -> str:
        return self.report.pseudonym

    @property
    def printed_patient(self) -> Patient | None:
        return self.report.printed_patient

    @property
    def side(self) -> Side:
        return self.report.results.side

    @property
    def sessions(self) -> tuple[SessionResults, ...]:
        return self.report.sessions


def _first_page(report: SessionReport) -> QVBoxLayout:
    results, form, comment = report.results, report.form, comment_lines(report.comment)
    summed_up = wrist_summary if report.joints is None else hand_summary
    parts: list[Part] = _facts(report)
    parts.append(paragraph(summed_up(results, report.previous, report.first), 10.0, SEMIBOLD))
    if form.includes("table"):
        is_hand, sessions = report.joints is not None, (results, report.previous, report.other_hand)
        parts += _finger_section(*sessions) if is_hand else _range_table(report)
        parts += _active_passive(report)
        parts += _wrist_section(results) if is_hand else []
    if form.includes("curves"):
        parts += (
            _curves(report) if report.joints is None else _finger_curve_section(report.curves, report.joints, results)
        )
    parts += [STRETCH, *_boxes(report)]
    if report.manual_values and form.includes("by_hand"):
        words = tr("Measured manually, not by Carpus: {values}.").format(values=day_words(report.manual_values))
        parts.append(paragraph(words, 8.5))
    if len(comment) > MAX_COMMENT_LINES:
        pages = math.ceil(len(comment) / LINES_ON_A_PAGE)
        where = tr("The therapist’s comment is on the last page.")
        if pages > 1:
            where = tr("The therapist’s comment is on the last {count} pages.").format(count=pages)
        parts.append(paragraph(where, 8.5, MEDIUM))
    elif comment:
        parts.append(column(paragraph(tr("Therapist’s comment"), 10.0, SEMIBOLD), comment_text(comment), gap=2.0))
    return column(*parts, *_foot(report), gap=7.0)


def _motion_pages(report: SessionReport) -> list[QVBoxLayout]:
    origin = [
        pattern.format(digest=digest)
        for pattern, digest in (
            (tr("revision {digest}"), report.revision[:7]),
            (tr("settings {digest}"), report.settings_digest[:4]),
            (tr("data {digest}"), f"{report.digest[:4]}…{report.digest[-4:]}" if report.digest else ""),
            (
                tr("recording {digest}"),
                f"{report.recording_digest[:4]}…{report.recording_digest[-4:]}" if report.recording_digest else "",
            ),
        )
        if digest
    ]
    assert report.motion is not None  # its section has no content without
    return [motion_page(report.results, report.previous, report.curves, report.motion, " · ".join(origin))]


def _comment_pages(report: SessionReport) -> list[QVBoxLayout]:
    lines, pages = comment_lines(report.comment), []
    for start in range(0, len(lines), LINES_ON_A_PAGE) if len(lines) > MAX_COMMENT_LINES else ():
        heading = paragraph(tr("Therapist’s comment"), 11.5, SEMIBOLD)
        words = comment_text(lines[start : start + LINES_ON_A_PAGE])
        pages.append(column(heading, words, STRETCH, legal_line(), gap=9.0))
    return pages


@lru_cache(maxsize=4)  # of each comment two sections ask, and a letter again
def comment_lines(comment: str) -> tuple[str, ...]:
    """Return the comment broken into lines."""
    return tuple(break_lines(comment, COMMENT_PT, BODY_WIDTH_PT)) if comment.strip() else ()


def comment_text(lines: Sequence[str]) -> PlainText:
    """Return lines that are broken already as a part."""
    return PlainText(PAPER, "\n".join(lines), COMMENT_PT)


def _facts(report: SessionReport) -> list[Part]:
    results = report.results
    session = tr("active")
    if results.has_passive:
        session = tr("active and passive") if results.repetition_count else tr("passive")
    if report.session_number:
        session = f"{numbers.format_ordinal(report.session_number)}, {session}"
    hand = to_mid_sentence(terms.side_name(results.side))
    pairs = [
        (tr("Date"), numbers.format_date_time(results.when)),
        (tr("Session"), session),
        (tr("Hand"), ", ".join(filter(None, (hand, terms.hand_dominance(report.dominance))))),
        (tr("Duration"), numbers.format_clock(results.duration_s + 0.5)),
        (tr("Therapist"), report.therapist or numbers.UNKNOWN),
    ]
    lines = [
        (_diagnosis_words(report), MEDIUM, "text"),
        *((words, SEMIBOLD, "warn") for words in warning_lines(results)),
    ]
    if corrected := correction_words(results):
        is_kept = tr("Marker labels were corrected manually. The original result is kept.")
        lines.append((f"{corrected} {is_kept}", MEDIUM, "text"))
    shown = [paragraph(words, 8.5, weight, token) for words, weight, token in lines if words]
    return [column(fact_row(pairs), *shown, gap=3.0), rule()]


def _diagnosis_words(report: SessionReport) -> str:
    """Return ``Wrist fracture, plate, operated on 21 Aug 2026, 13 weeks before``."""
    day = report.onset_day
    if not report.form.includes("diagnosis"):
        return ""
    parts = [report.diagnosis, to_mid_sentence(terms.onset_words(report.onset, day))]
    if day is not None and (weeks := numbers.format_weeks_since(day, report.results.when.date())):
        parts.append(tr("{weeks} before this session").format(weeks=weeks))
    return ", ".join(part for part in parts if part)


def _range_table(report: SessionReport) -> list[Part]:
    results = report.results
    person = to_person(report.printed_patient, results.when.date())
    found = range_table(results, report.previous, report.other_hand, on_paper=True, person=person)
    if not found.rows and results.has_passive:
        return []  # the table of what was passive says all there is
    shown = table(*found)
    source = reference_words(results, person)
    below = [paragraph(source, 7.5, REGULAR, "text2")] if source else []
    return [column(section_title(tr("Range of motion"), repetition_words(results)), shown, *below, gap=2.0)]


def _active_passive(report: SessionReport) -> list[Part]:
    found = build_active_passive(report.results, report.manual_values if report.form.includes("by_hand") else ())
    if found is None:
        return []
    aside = "" if report.results.wrist_ranges or report.joints is not None else repetition_words(report.results)
    shown = table(*found.table)
    above = [paragraph(found.sentence, 9.0, MEDIUM)] if found.sentence else []
    below = [paragraph(found.note, 7.5, REGULAR, "text2")] if found.note else []
    return [column(section_title(tr("Active and passive"), aside), *above, shown, *below, gap=2.0)]


def _curves(report: SessionReport) -> list[Part]:
    results = report.results
    aside = tr("grey: repetitions; band: ± 1 SD of the angle")
    if any(math.isfinite(target) for target in results.targets_deg):
        aside += "; " + tr("dashed: goal")
    plot = SessionPlot(report.curves, results.exercise, results.repetitions, -1, *results.targets_deg)
    return [section_title(tr("Angles over time"), aside), chart_part(partial(SessionChart, plot=plot), 190.0, 400.0)]


def _boxes(report: SessionReport) -> list[Part]:
    results, boxes = report.results, []
    lines = quality_lines(results)
    is_sure = all(fine for _, _, fine in lines)
    if report.form.includes("quality") or not is_sure:  # doubts are never left out
        sign = Icon(PAPER, "good" if is_sure else "warn", 12, (12, 12))
        heading = line(label(tr("How reliable are these values?"), 10.0, SEMIBOLD), STRETCH, sign)
        values = value_rows([(name, value, "text" if fine else "warn") for name, value, fine in lines])
        boxes.append(RoundedBox(heading, 3.0, values, STRETCH))
    if report.form.includes("speed"):
        words = "  ".join(f"“{text}”" for _, text in results.notes[:3])
        notes: list[Part | float] = [3.0, paragraph(words, 8.5)] if words else []
        values = value_rows([(name, value, "text") for name, value in pain_lines(results)])
        boxes.append(RoundedBox(paragraph(tr("Pain, note"), 10.0, SEMIBOLD), 3.0, values, *notes, STRETCH))
    return [line(*((box, 1) for box in boxes), gap=12.0)] if boxes else []


def _has_verdict(report: SessionReport) -> bool:
    """Return whether any change on the page is compared with the measurement error."""
    results, rows = report.results, find_main_ranges(report.results)
    before = [item for item in (report.previous, report.first) if item is not None]
    return any(item.verdict != "not_judged" for earlier in before for item in compare_ranges(earlier, results, rows))


def _foot(report: SessionReport) -> list[Part]:
    results = report.results
    by_hand = report.manual_values if report.form.includes("by_hand") else ()
    how = method_words(results, report.markers, compared=_has_verdict(report), manual_values=by_hand)
    residual = results.quality.residual_mm
    parts = [tr("Session {id}").format(id=results.session_id[:8]), f"Carpus {results.software_version}"]
    if math.isfinite(residual):
        parts.append(tr("marker positions within {size} mm").format(size=numbers.format_fixed(residual, 1)))
    parts.append(tr("smoothed") if results.is_smoothed else tr("live values, not smoothed"))
    origin = paragraph(" · ".join(parts), 8.0, REGULAR, "text2")
    return [rule(), column(paragraph(how, 8.0, REGULAR, "text2"), legal_line(), origin, gap=3.0)]


def _finger_section(
    results: SessionResults, previous: SessionResults | None, other_hand: SessionResults | None
) -> list[Part]:
    """Return the table of the fingers and what occlusion limited."""
    columns, heads, rows = finger_table(results, previous, other_hand)
    shown = table(columns, [cell_text(head) for head in heads], rows, pitch=2.0)
    words = limitation_words(results)
    below = [paragraph(words, 8.0)] if words else []
    return [
        column(section_title(tr("Range of motion of the fingers"), repetition_words(results)), shown, *below, gap=2.0)
    ]


def _wrist_section(results: SessionResults) -> list[Part]:
    """Return the wrist's three arcs in one line."""
    arcs = [
        (
            line(
                paragraph(terms.arc_name(row.wrist_angle), 8.5, REGULAR, "text2"),
                6.0,
                (paragraph(mean_words(row), 9.0, SEMIBOLD), 1),
            ),
            1,
        )
        for row in results.wrist_ranges
        if row.quantity == "arc"
    ]
    shown = line(*arcs) if arcs else paragraph(tr("not visible"), 8.5, REGULAR, "text2")
    return [column(section_title(tr("Wrist"), tr("total arcs in the same period")), shown, rule(), gap=2.0)]


def _finger_curve_section(curves: WristCurves, joints: JointCurves, results: SessionResults) -> list[Part]:
    """Return the flexion curves of every finger."""
    key: list[QWidget | float] = []
    for row in FLEXION_KINDS:
        swatch = ColorFill(PAPER, KIND_TOKENS[row])
        swatch.setFixedSize(*to_layout_units(10.0, 1.6))
        name = tr("PIP (thumb: palmar abduction)") if row == "middle" else kind_name(row)
        key += [swatch, 4.0, label(name, 8.5, REGULAR, "text2"), 8.0]
    key.append(label(tr("dashed: occluded; hatched: lost"), 8.5, REGULAR, "text2"))
    plot = HandPlot(curves, results.exercise, results.repetitions, -1, joints=joints)
    return [
        section_title(tr("Finger flexion over time"), *key),
        chart_part(partial(SessionChart, plot=plot), 140.0, 220.0),
    ]


SECTIONS = (
    ReportSection("", make_pages=lambda report: [_first_page(report)]),
    ReportSection(
        "diagnosis", phrase("Diagnosis or operation"), lambda report: bool(report.diagnosis or report.onset_day)
    ),
    ReportSection("table", phrase("Table")),
    ReportSection("curves", phrase("Curves and repetitions")),
    ReportSection("quality", phrase("Reliability of the values")),
    ReportSection("speed", phrase("Pain, note")),
    ReportSection("by_hand", phrase("Manual measurements"), lambda report: bool(report.manual_values)),
    ReportSection("motion", phrase("Motion page"), lambda report: report.motion is not None, _motion_pages),
    ReportSection("comment", make_pages=_comment_pages, is_last=True),
)
"""All sections by their name in the clinic's form.

Identity, sentences, warnings, method, legal sentence and origin always stay, and ``quality`` if something is not as it
should be.
"""

"""What the report of a session, or over several, says: gathered from them, and written."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from carpus.core.measures.by_hand import HandValue, of_session
from carpus.core.provenance import said_in, version_with_revision
from carpus.core.results.figures import SessionFigures, data_digest, session_figures
from carpus.core.results.motion_curves import motion_curves
from carpus.core.results.progress import limits_of, newest_results, other_hand_of, previous_of, progress
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.report_form import ReportForm
from carpus.core.results.seen import joint_curves, session_curves
from carpus.core.session.values import Session
from carpus.ui.report.pdf import write_report
from carpus.ui.report.progress_page import ProgressReport
from carpus.ui.report.session_page import SessionReport
from carpus.ui.words.fingers import followed_keys, followed_kinds


def session_report(
    session: Session,
    *,
    choices: RepetitionChoices | None = None,
    history: Sequence[SessionFigures] = (),
    pseudonym: str = "",
    dominance: str = "unknown",
    therapist: str = "",
    by_hand: Sequence[HandValue] = (),
    comment: str = "",
    form: ReportForm | None = None,
    language: str = "",
) -> SessionReport:
    """What the page of a session says; ``history`` figures of the patient's other sessions, in any order, ``by_hand``
    all that was ever measured by hand: what counts of the session's day and hand is told; ``language`` of the page,
    empty for the window's."""
    figures = session_figures(session, choices, limits_of(history))
    known = next((other for other in history if other.session_id == figures.session_id), figures)
    older = all(one is not figures for one in newest_results((*history, figures)))
    figures = replace(figures, earlier_results=known.earlier_results, older=older)
    earlier = [other for other in history if other.when < figures.when]
    alike = [other for other in earlier if (other.exercise.id, other.side) == (figures.exercise.id, figures.side)]
    fair = [point.figures for point in progress(alike).points if point.fair]
    made_by, source = said_in(session.header.parameters, "provenance"), said_in(session.header.parameters, "source")
    return SessionReport(
        figures=figures,
        curves=session_curves(session),
        joints=joint_curves(session),
        motion=motion_curves(session),
        markers=len(session.header.protocol.markers),
        pseudonym=pseudonym or session.header.subject_id or "–",
        session_number=sum(one.side == figures.side for one in newest_results(earlier)) + 1 if history else 0,
        dominance=dominance,
        therapist=therapist,
        previous=previous_of(history, figures),
        first=fair[0] if fair else None,
        other_hand=other_hand_of(history, figures),
        digest=data_digest(session),
        settings_digest=hashlib.sha256(session.header.parameters.encode()).hexdigest(),
        revision=str(made_by.get("revision") or ""),
        recording_digest=str(source.get("sha256") or ""),
        by_hand=of_session(by_hand, figures.side, figures.when.date()),
        comment=comment,
        form=form or ReportForm(),
        language=language,
    )


def write_session_report(report: Session | SessionReport, output_path: Path, **context: object) -> Path:
    """Write the report of a session, two pages; ``context`` as of :func:`session_report` when a session is given.
    Faults as :func:`write_report`.
    """
    page = session_report(report, **context) if isinstance(report, Session) else report  # type: ignore[arg-type]
    return write_report(page, output_path)


def write_progress_report(
    report: Sequence[SessionFigures] | ProgressReport, output_path: Path, **context: object
) -> Path:
    """Write the one-page report over sessions; faults as :func:`write_report`."""
    page = report if isinstance(report, ProgressReport) else progress_report(report, **context)  # type: ignore[arg-type]
    return write_report(page, output_path)


def progress_report(
    sessions: Sequence[SessionFigures],
    *,
    pseudonym: str = "",
    therapist: str = "",
    what: str | None = None,
    by_hand: Sequence[HandValue] = (),
    form: ReportForm | None = None,
    language: str = "",
    other_hand: SessionFigures | None = None,
) -> ProgressReport:
    """The course of the newest session's exercise and hand; the other hand's last session beside it, which is
    ``other_hand`` where that is none of the ``sessions``.

    ``what`` of the whole hand is followed, as of :func:`followed_kinds`; the first of them by itself.
    ``by_hand`` is what counts of what was measured by hand of this hand and person.
    """
    newest = max(sessions, key=lambda figures: figures.when)
    alike = [f for f in sessions if (f.exercise.id, f.side) == (newest.exercise.id, newest.side)]
    kinds = followed_kinds(newest)
    followed = followed_keys(what if what is not None else kinds[0][0]) if kinds else ()
    course = progress(alike, other_hand or other_hand_of(sessions, newest), followed)
    course = replace(course, by_hand=tuple(by_hand))
    name = pseudonym or newest.subject_id or "–"
    return ProgressReport(course, name, therapist, version_with_revision(), form or ReportForm(), language)

"""Session and progress reports, built from results."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import replace

from carpus.core.measures.manual_measurements import ManualValue, session_values
from carpus.core.platform.provenance import parameter_section, version_with_revision
from carpus.core.results.motion_curves import compute_motion_curves
from carpus.core.results.progress import (
    compute_progress,
    error_limits,
    find_other_hand,
    find_previous,
    select_latest_versions,
)
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.report_form import ReportForm
from carpus.core.results.session_results import SessionResults, compute_data_digest, compute_session_results
from carpus.core.results.valid_data import joint_curves, wrist_curves
from carpus.core.session.values import Session
from carpus.ui.report.progress_page import ProgressReport
from carpus.ui.report.session_page import SessionReport
from carpus.ui.words.fingers import progress_choices, progress_keys


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

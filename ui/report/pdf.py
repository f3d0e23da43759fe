"""Pages to PDF: vector curves and embedded fonts by Qt's own writer. Works without a window."""

from __future__ import annotations

import errno
import hashlib
from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF
from PySide6.QtGui import QGuiApplication, QPageLayout, QPageSize, QPainter, QPdfWriter

from core.errors import DiskFull, OutputExists, OutputNotWritable
from core.output.joint_content import joint_curves
from core.output.report_content import (
    RepetitionChoices,
    SessionFigures,
    data_digest,
    other_hand_of,
    previous_of,
    progress,
    session_curves,
    session_figures,
)
from core.session.values import Session
from ui.fonts import load_fonts
from ui.report.hand_rows import followed_keys, followed_kinds
from ui.report.page import Page
from ui.report.progress_page import ProgressReport, paint_progress_page
from ui.report.session_page import SessionReport, paint_session_page

RESOLUTION_DPI = 1200
POINTS_PER_INCH = 72.0


def ensure_application() -> QGuiApplication:
    """The running Qt application, or one without a screen: fonts need one. Keep the result while writing."""
    running = QGuiApplication.instance()
    if isinstance(running, QGuiApplication):
        application = running
    else:
        application = QGuiApplication(["carpus", "-platform", "offscreen"])
    load_fonts()
    return application


def session_report(
    session: Session,
    *,
    choices: RepetitionChoices | None = None,
    history: Sequence[SessionFigures] = (),
    pseudonym: str = "",
    dominance: str = "unknown",
    therapist: str = "",
) -> SessionReport:
    """What the page of a session says; ``history`` figures of the patient's other sessions, in any order."""
    figures = session_figures(session, choices)
    earlier = [other for other in history if other.when < figures.when]
    alike = [other for other in earlier if (other.exercise.id, other.side) == (figures.exercise.id, figures.side)]
    fair = [point.figures for point in progress(alike).points if point.fair]
    return SessionReport(
        figures=figures,
        curves=session_curves(session),
        joints=joint_curves(session),
        markers=len(session.header.protocol.markers),
        pseudonym=pseudonym or session.header.subject_id or "–",
        session_number=len(earlier) + 1 if history else 0,
        dominance=dominance,
        therapist=therapist,
        previous=previous_of(history, figures),
        first=fair[0] if fair else None,
        other_hand=other_hand_of(history, figures),
        digest=data_digest(session),
        settings_digest=hashlib.sha256(session.header.parameters.encode()).hexdigest(),
    )


def write_session_report(report: Session | SessionReport, output_path: Path, **context: object) -> Path:
    """Write the one-page report of a session; ``context`` as of :func:`session_report` when a session is given.

    Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`; nothing half-written stays.
    """
    page = session_report(report, **context) if isinstance(report, Session) else report  # type: ignore[arg-type]
    return _write(output_path, lambda paper: paint_session_page(paper, page), page.pseudonym)


def write_progress_report(
    report: Sequence[SessionFigures] | ProgressReport, output_path: Path, **context: object
) -> Path:
    """Write the one-page report over sessions; faults as :func:`write_session_report`."""
    page = report if isinstance(report, ProgressReport) else progress_report(report, **context)  # type: ignore[arg-type]
    return _write(output_path, lambda paper: paint_progress_page(paper, page), page.pseudonym)


def progress_report(
    sessions: Sequence[SessionFigures], *, pseudonym: str = "", therapist: str = "", what: str | None = None
) -> ProgressReport:
    """The course of the newest session's exercise and hand; the other hand's last session beside it.

    ``what`` of the whole hand is followed, as of :func:`followed_kinds`; the first of them by itself.
    """
    newest = max(sessions, key=lambda figures: figures.when)
    alike = [f for f in sessions if (f.exercise.id, f.side) == (newest.exercise.id, newest.side)]
    kinds = followed_kinds(newest)
    followed = followed_keys(what if what is not None else kinds[0][0]) if kinds else ()
    course = progress(alike, other_hand_of(sessions, newest), followed)
    return ProgressReport(course, pseudonym or newest.subject_id or "–", therapist)


def _write(output_path: Path, paint: Callable[[Page], None], title: str) -> Path:
    application = ensure_application()
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    writer.setResolution(RESOLUTION_DPI)
    layout = QPageLayout(QPageSize(QPageSize.PageSizeId.A4), QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0))
    writer.setPageLayout(layout)
    writer.setTitle(title)
    writer.setCreator("Carpus")
    painter = QPainter(writer)
    try:
        paint(Page(painter, RESOLUTION_DPI / POINTS_PER_INCH))
    finally:
        painter.end()  # a writer that goes while it is painted on ends the program
    buffer.close()
    del application
    _store(output_path, bytes(store.data()))
    return output_path


def _store(path: Path, content: bytes) -> None:
    try:
        with path.open("xb") as file:
            file.write(content)
    except FileExistsError:
        raise OutputExists(path) from None
    except OSError as cause:
        if cause.errno == errno.ENOSPC:
            path.unlink(missing_ok=True)
            raise DiskFull(path, str(cause.strerror)) from cause
        raise OutputNotWritable(path, str(cause.strerror)) from cause

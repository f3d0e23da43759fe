"""Pages to PDF: vector curves and embedded fonts by Qt's own writer. Works without a window."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QGuiApplication, QPageLayout, QPageSize, QPainter, QPdfWriter, QPen

from carpus.core.calibration.camera.sheet import Disc, PrintedSheet, SheetBox, SheetLine, SheetText
from carpus.core.formats.new_output import look_for_folder, new_bytes
from carpus.core.measures.by_hand import HandValue, of_session
from carpus.core.provenance import said_in, with_revision
from carpus.core.results.figures import SessionFigures, data_digest, session_figures
from carpus.core.results.motion_curves import motion_curves
from carpus.core.results.progress import limits_of, newest_results, other_hand_of, previous_of, progress
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.report_form import PAPER_PT, ReportForm
from carpus.core.results.seen import joint_curves, session_curves
from carpus.core.session.values import Session
from carpus.ui.fonts import REGULAR, SEMIBOLD, load_fonts
from carpus.ui.report.hand_rows import followed_keys, followed_kinds
from carpus.ui.report.page import Page
from carpus.ui.report.pages import Report, pages_of
from carpus.ui.report.progress_page import ProgressReport
from carpus.ui.report.session_page import SessionReport
from carpus.ui.translate import say

TITLE = "Carpus report"
"""What a viewer writes above its window and a mail program into its list: nobody's name."""
RESOLUTION_DPI = 1200
POINTS_PER_INCH = 72.0
MM_PER_PT = 25.4 / POINTS_PER_INCH


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
        session_number=len(earlier) + 1 if history else 0,
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

    Raises :class:`OutputExists`, :class:`OutputNotWritable` or :class:`DiskFull`; nothing half-written stays.
    """
    page = session_report(report, **context) if isinstance(report, Session) else report  # type: ignore[arg-type]
    return write_report(page, output_path)


def write_progress_report(
    report: Sequence[SessionFigures] | ProgressReport, output_path: Path, **context: object
) -> Path:
    """Write the one-page report over sessions; faults as :func:`write_session_report`."""
    page = report if isinstance(report, ProgressReport) else progress_report(report, **context)  # type: ignore[arg-type]
    return write_report(page, output_path)


def progress_report(
    sessions: Sequence[SessionFigures],
    *,
    pseudonym: str = "",
    therapist: str = "",
    what: str | None = None,
    software_version: str = "",
    by_hand: Sequence[HandValue] = (),
    form: ReportForm | None = None,
    language: str = "",
) -> ProgressReport:
    """The course of the newest session's exercise and hand; the other hand's last session beside it.

    ``what`` of the whole hand is followed, as of :func:`followed_kinds`; the first of them by itself.
    ``software_version`` is of the program that makes it, the newest session's where it is not given; ``by_hand`` what
    counts of what was measured by hand of this hand and person.
    """
    newest = max(sessions, key=lambda figures: figures.when)
    alike = [f for f in sessions if (f.exercise.id, f.side) == (newest.exercise.id, newest.side)]
    kinds = followed_kinds(newest)
    followed = followed_keys(what if what is not None else kinds[0][0]) if kinds else ()
    course = progress(alike, other_hand_of(sessions, newest), followed)
    made_by = with_revision(software_version) if software_version else newest.software_version
    course = replace(course, by_hand=tuple(by_hand))
    name = pseudonym or newest.subject_id or "–"
    return ProgressReport(course, name, therapist, made_by, form or ReportForm(), language)


def write_page(output_path: Path, paint: Callable[[Page], None], title: str) -> Path:
    """Write one A4 page; faults as :func:`write_session_report`."""
    return _write_pages(output_path, [(None, paint)], title)


def write_sheets(output_path: Path, sheets: Sequence[PrintedSheet], title: str) -> Path:
    """Write sheets to print, each in its own size, in millimetres as drawn; faults as above."""
    pages = [(QSizeF(sheet.width_mm, sheet.height_mm), _painting(sheet)) for sheet in sheets]
    return _write_pages(output_path, pages, title)


def _painting(sheet: PrintedSheet) -> Callable[[Page], None]:
    return lambda page: paint_sheet(page, sheet)


def write_report(report: Report, output_path: Path) -> Path:
    """Write a report of any kind; faults as :func:`write_session_report`."""
    width_pt, height_pt = PAPER_PT[report.form.paper]
    paper = None if report.form.paper == "a4" else QSizeF(width_pt * MM_PER_PT, height_pt * MM_PER_PT)
    return _write_pages(output_path, [(paper, paint) for paint in pages_of(report)], TITLE)


def _write_pages(output_path: Path, pages: Sequence[tuple[QSizeF | None, Callable[[Page], None]]], title: str) -> Path:
    application = ensure_application()
    store = QByteArray()
    buffer = QBuffer(store)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(buffer)
    writer.setResolution(RESOLUTION_DPI)
    writer.setPageLayout(_layout(pages[0][0]))
    writer.setTitle(title)
    writer.setCreator("Carpus")
    painter = QPainter(writer)
    try:
        for number, (size, paint) in enumerate(pages):
            if number:
                writer.setPageLayout(_layout(size))
                writer.newPage()
            paint(Page(painter, RESOLUTION_DPI / POINTS_PER_INCH))
    finally:
        painter.end()  # a writer that goes while it is painted on ends the program
    buffer.close()
    del application
    look_for_folder(output_path)
    with new_bytes(output_path) as file:
        file.write(bytes(store.data()))
    return output_path


def _layout(size_mm: QSizeF | None) -> QPageLayout:
    """A page without margins; A4 where no size is named."""
    size = (
        QPageSize(QPageSize.PageSizeId.A4)
        if size_mm is None
        else QPageSize(size_mm, QPageSize.Unit.Millimeter, "", QPageSize.SizeMatchPolicy.ExactMatch)
    )
    return QPageLayout(size, QPageLayout.Orientation.Portrait, QMarginsF(0, 0, 0, 0))


POINTS_PER_MM = 72.0 / 25.4
_LINE_PT = 0.5


def paint_sheet(page: Page, sheet: PrintedSheet) -> None:
    """All marks of a sheet, edges as sharp as the printer has them."""
    painter, mm = page.painter, page.point * POINTS_PER_MM
    # Half-covered edge pixels would make two squares that meet at a corner leak into each other.
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    for mark in sheet.marks:
        if isinstance(mark, SheetBox):
            box = QRectF(mark.left_mm * mm, mark.top_mm * mm, mark.width_mm * mm, mark.height_mm * mm)
            painter.fillRect(box, QColor(mark.color))
        elif isinstance(mark, Disc):
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(mark.color))
            radius = mark.radius_mm * mm
            painter.drawEllipse(QPointF(mark.x_mm * mm, mark.y_mm * mm), radius, radius)
            painter.setBrush(Qt.BrushStyle.NoBrush)
        elif isinstance(mark, SheetLine):
            style = Qt.PenStyle.DashLine if mark.dashed else Qt.PenStyle.SolidLine
            painter.setPen(QPen(QColor("#000000"), _LINE_PT * page.point, style))
            ends = [QPointF(x * mm, y * mm) for x, y in (mark.from_mm, mark.to_mm)]
            painter.drawLine(*ends)
        elif isinstance(mark, SheetText):
            place = mark.x_mm * POINTS_PER_MM, mark.y_mm * POINTS_PER_MM
            weight, words = SEMIBOLD if mark.bold else REGULAR, say(mark.text)
            room = (sheet.width_mm - mark.x_mm) * POINTS_PER_MM - 12.0
            size = mark.size_pt * min(1.0, room / max(page.width_of(words, mark.size_pt, weight), 1.0))
            page.text(words, *place, size, weight)

"""Reports, exports and tables: gathered beside the window's thread, shown or written."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog

from core.errors import OutputNotWritable
from core.output.report_content import Progress, SessionFigures
from ui.report.pdf import progress_report, session_report
from ui.report.session_page import SessionReport

if TYPE_CHECKING:
    from app.desktop.journey import Journey


class Printing(QObject):
    """What leaves Carpus from the review and the progress screen."""

    def __init__(self, journey: Journey) -> None:
        super().__init__(journey)
        self._journey = journey

    def session(self, session_id: str) -> None:
        """Make the report of a session and show it."""
        journey = self._journey
        row, library = journey.patient, journey.library
        assert row is not None

        def gather() -> SessionReport:
            return session_report(
                library.session(session_id),
                choices=library.choices(session_id),
                history=library.history(row.patient_id),
                pseudonym=row.pseudonym,
                dominance=row.dominance,
                therapist=journey.settings.report.therapist,
            )

        def show(report: SessionReport) -> None:
            journey.report.begin(report, journey.places.folder("reports"))
            journey.show_report()

        journey.background.run(gather, show, journey.teller.fault)

    def course(self, sessions: Sequence[SessionFigures]) -> None:
        """Make the report over sessions and show it."""
        journey = self._journey
        if sessions and journey.patient is not None:
            therapist = journey.settings.report.therapist
            what = journey.progress.followed.currentData()  # what of the whole hand is on the screen
            report = progress_report(
                sessions,
                pseudonym=journey.patient.pseudonym,
                therapist=therapist,
                what=what if isinstance(what, str) else None,
            )
            journey.report.begin(report, journey.places.folder("reports"))
            journey.show_report()

    def export(self, session_id: str) -> None:
        """Ask for a folder and write the open formats into it."""
        journey = self._journey
        start = journey.places.folder("exports")
        folder = QFileDialog.getExistingDirectory(journey.shell, self.tr("Export into a folder"), start)
        if folder:
            journey.places.keep("exports", folder)
            journey.background.run(
                lambda: journey.library.export(session_id, folder), lambda _: None, journey.teller.fault
            )

    def table(self, progress: Progress) -> None:
        """Ask for a name and write the sessions of the progress screen as CSV."""
        journey = self._journey
        start = str(Path(journey.places.folder("exports")) / "progress.csv")
        path, _ = QFileDialog.getSaveFileName(journey.shell, self.tr("Save table"), start, "CSV (*.csv)")
        if path:
            journey.places.keep("exports", str(Path(path).parent))
            journey.background.run(lambda: write_table(Path(path), progress), lambda _: None, journey.teller.fault)


def write_table(path: Path, progress: Progress) -> None:
    """One line for each session and movement, degrees with one decimal; a session left out says why."""
    head = [
        "session", "created", "hand", "exercise", "movement", "mean_deg", "sd_deg", "best_deg", "n", "not_compared",
        "joint", "at_least",
    ]  # fmt: skip
    try:
        with path.open("w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerow(head)
            for point in progress.points:
                figures = point.figures
                facts = [figures.session_id, figures.when.isoformat(), figures.side, figures.exercise.id]
                for row in (*figures.rows, *figures.joint_rows):
                    values = [_decimal(value) for value in (row.mean_deg, row.sd_deg, row.best_deg)]
                    reasons, limited = " ".join(point.reasons), "yes" if row.limited else ""
                    table.writerow([*facts, row.movement, *values, row.count, reasons, row.joint, limited])
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause


def _decimal(value: float) -> str:
    return f"{value:.1f}" if value == value else ""

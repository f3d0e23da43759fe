"""Flow of the progress screen: its report and its tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from carpus.core.measures.manual_measurements import COLUMNS, to_rows
from carpus.core.model.rounding import format_rounded
from carpus.core.results.progress import Progress
from carpus.core.results.session_results import SessionResults
from carpus.ui.kit.table_file import companion_path, save_table
from carpus.ui.report.progress_page import build_progress_report
from carpus.ui.screens.progress.screen import ProgressScreen
from carpus.ui.shell.flow import Flow, ScreenContext


class ProgressFlow(Flow):
    """Flow of a patient's progress."""

    screen_name, guide_page = "progress", "figures"
    screen: ProgressScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, ProgressScreen(context.theme, context.background, context.library))
        screen, way = self.screen, context.navigator
        screen.fault_raised.connect(context.messages.show_fault)
        screen.session_chosen.connect(lambda session_id: way.open_screen("review", session_id))
        screen.report_requested.connect(self._show_report)
        screen.table_requested.connect(self._save_tables)
        screen.manual_values_requested.connect(lambda: way.open_screen("by_hand"))
        screen.chart.menu.saved.connect(lambda path: self.register_exports([path], self._session_ids()))

    def open(self, patient_id: str) -> None:
        """Show a patient's progress, in the exercise of the open session."""
        self.open_patient(patient_id)
        self.screen.chart.menu.start_folder = self.context.recent_locations.folder("exports")
        self.screen.load_patient(patient_id, self.context.current.session_id)
        self.context.navigator.switch_screen("progress")

    def navigate_back(self) -> None:
        if self.context.navigator.previous_screen("progress") == "patients":
            self.return_to_patients()
        else:
            self.return_to_session()

    def _show_report(self, sessions: Sequence[SessionResults]) -> None:
        """Show the report of the sessions and of what is followed on the screen."""
        if not sessions or self.context.current.patient is None:
            return
        followed = self.screen.measure_choice.currentData()
        report = build_progress_report(
            sessions,
            pseudonym=self.context.current.patient_name,
            choice=followed if isinstance(followed, str) else None,
            manual_values=self.screen.progress.manual_measurements,
            other_hand=self.screen.progress.other_hand,
        )
        self.context.navigator.open_screen("report", report, [one.session_id for one in sessions])

    def _save_tables(self, progress: Progress) -> None:
        path = self.choose_save_path("exports", self.tr("progress.csv"), self.tr("Save table"), "CSV (*.csv)")
        if path is not None:
            sessions = [point.results.session_id for point in progress.points]
            self.run(lambda: write_tables(path, progress), lambda paths: self.announce_exports(paths, sessions))

    def _session_ids(self) -> list[str]:
        patient = self.context.current.patient
        entries = self.context.library.sessions(patient.patient_id) if patient is not None else ()
        return [entry.session_id for entry in entries]


HEAD = (
    "session", "created", "hand", "exercise", "movement", "mean_deg", "sd_deg", "best_deg", "n", "not_compared",
    "joint", "at_least",
)  # fmt: skip


def write_tables(path: Path, progress: Progress) -> list[Path]:
    """Write the table of the sessions, and one of manual values if there are any; return the files."""
    beside = companion_path(path, "-by-hand", can_replace=path.exists())
    save_table(path, HEAD, _rows(progress))
    if not progress.manual_measurements:
        return [path]
    save_table(beside, list(COLUMNS), to_rows(progress.manual_measurements))
    return [path, beside]


def _rows(progress: Progress) -> Iterator[Sequence[object]]:
    """Return one row for each session and movement in degrees, with the reason of an exclusion."""
    for point in progress.points:
        results = point.results
        patient = (results.session_id, results.when.isoformat(), results.side, results.exercise.id)
        for row in results.measures_in_group("range"):
            values = [
                format_rounded(value, 1) if math.isfinite(value) else "" for value in (row.mean, row.sd, row.best)
            ]
            reasons, limited = " ".join(point.reasons), "yes" if row.is_lower_bound else ""
            joint = row.subject if row.wrist_angle < 0 else ""
            yield *patient, row.quantity, *values, row.count, reasons, joint, limited

"""The flow of the progress: over which weeks, its report, its tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from carpus.core.measures.by_hand import COLUMNS, rows_of
from carpus.core.results.figures import SessionFigures
from carpus.core.results.progress import Progress
from carpus.core.rounding import written
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.progress.screen import ProgressScreen
from carpus.ui.report.gather import progress_report
from carpus.ui.saved_table import named_beside, save_table


class ProgressFlow(Flow):
    """How it went over the weeks."""

    place, guide = "progress", "figures"
    screen: ProgressScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, ProgressScreen(context.theme, context.background, context.library))
        screen, way = self.screen, context.way
        screen.told.connect(context.messages.fault)
        screen.session.connect(lambda session_id: way.show("review", session_id))
        screen.report.connect(self._report)
        screen.table_wanted.connect(self._save_tables)
        screen.by_hand_wanted.connect(lambda: way.show("by_hand"))
        screen.chart.menu.saved.connect(lambda path: self.note_made([path], self._sessions()))

    def show(self, patient_id: str) -> None:
        """Of a patient; the kind of the session that is open comes first."""
        self.open_patient(patient_id)
        self.screen.chart.menu.start_folder = self.context.places.folder("exports")
        self.screen.begin(patient_id, self.context.now.session_id)
        self.context.way.go("progress")

    def up(self) -> None:
        if self.context.way.came_from("progress") == "patients":
            self.to_patient()
        else:
            self.to_session()

    def _report(self, sessions: Sequence[SessionFigures]) -> None:
        """Of the sessions shown, and what of the whole hand is on the screen."""
        if not sessions or self.context.now.patient is None:
            return
        followed = self.screen.followed.currentData()
        report = progress_report(
            sessions,
            pseudonym=self.context.now.name,
            therapist=self.context.report.therapist,
            what=followed if isinstance(followed, str) else None,
            by_hand=self.screen.progress.by_hand,
            other_hand=self.screen.progress.other_hand,
        )
        self.context.way.show("report", report, [one.session_id for one in sessions])

    def _save_tables(self, progress: Progress) -> None:
        path = self.ask_where_to_save("exports", self.tr("progress.csv"), self.tr("Save table"), "CSV (*.csv)")
        if path is not None:
            sessions = [point.figures.session_id for point in progress.points]
            self.run(lambda: write_tables(path, progress), lambda paths: self.tell_made(paths, sessions))

    def _sessions(self) -> list[str]:
        patient = self.context.now.patient
        entries = self.context.library.sessions(patient.patient_id) if patient is not None else ()
        return [entry.session_id for entry in entries]


HEAD = (
    "session", "created", "hand", "exercise", "movement", "mean_deg", "sd_deg", "best_deg", "n", "not_compared",
    "joint", "at_least",
)  # fmt: skip


def write_tables(path: Path, progress: Progress) -> list[Path]:
    """The table of the sessions, and one beside it of what was measured by hand, if anything was; the files."""
    beside = named_beside(path, "-by-hand", replaces=path.exists())
    write_table(path, progress)
    if not progress.by_hand:
        return [path]
    save_table(beside, list(COLUMNS), rows_of(progress.by_hand))
    return [path, beside]


def write_table(path: Path, progress: Progress) -> None:
    """One line for each session and movement, degrees with one decimal; a session left out says why."""
    save_table(path, HEAD, _rows(progress))


def _rows(progress: Progress) -> Iterator[Sequence[object]]:
    for point in progress.points:
        figures = point.figures
        who = (figures.session_id, figures.when.isoformat(), figures.side, figures.exercise.id)
        for row in figures.group("range"):
            values = [written(value, 1) if math.isfinite(value) else "" for value in (row.mean, row.sd, row.best)]
            reasons, limited = " ".join(point.reasons), "yes" if row.at_least else ""
            joint = row.of if row.angle < 0 else ""
            yield *who, row.what, *values, row.count, reasons, joint, limited

"""Reports, exports and tables: gathered beside the window's thread, shown or written."""

from __future__ import annotations

import csv
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import date
from itertools import chain, count
from pathlib import Path
from typing import Protocol, TypeVar

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from carpus import __version__
from carpus.core.durable import private
from carpus.core.errors import CarpusFault, OutputNotWritable
from carpus.core.formats.new_output import plain_cell
from carpus.core.measures.by_hand import COLUMNS, HandValue, rows_of
from carpus.core.records.values import HomePlan
from carpus.core.results.camera_said import CameraSaid
from carpus.core.results.figures import SessionFigures
from carpus.core.results.goals import Goals
from carpus.core.results.progress import Progress
from carpus.core.results.repetition_rows import RepetitionChoices
from carpus.core.results.report_form import ReportForm
from carpus.core.session.values import Session
from carpus.ui.background import Background
from carpus.ui.export.sheet import ExportSheet
from carpus.ui.flow import Navigator
from carpus.ui.last_places import LastPlaces
from carpus.ui.messages.files_written import tell_written
from carpus.ui.messages.messages import Messages
from carpus.ui.now_open import NowOpen
from carpus.ui.report.beside_page import BesideReport
from carpus.ui.report.home_page import HomeReport, own_way
from carpus.ui.report.home_sheet import HomeSheet
from carpus.ui.report.letter_page import LetterReport
from carpus.ui.report.letter_sheet import LetterSheet
from carpus.ui.report.pdf import progress_report, session_report
from carpus.ui.report.screen import ReportScreen
from carpus.ui.report.session_page import SessionReport
from carpus.ui.theme import Theme

T = TypeVar("T")


class PatientPapers(Protocol):
    """What is stored of a patient, for paper and for other programs."""

    def session(self, session_id: str) -> Session: ...

    def camera(self, session: Session) -> CameraSaid: ...

    def choices(self, session_id: str) -> RepetitionChoices: ...

    def history(self, patient_id: str) -> Sequence[SessionFigures]: ...

    def by_hand(self, patient_id: str) -> Sequence[HandValue]: ...

    def goals(self, patient_id: str) -> Goals: ...

    def home_plan(self, patient_id: str) -> HomePlan | None: ...

    def keep_home_plan(self, patient_id: str, plan: HomePlan) -> None: ...

    def recipients(self) -> Sequence[str]: ...

    def remember_recipient(self, address: str) -> None: ...

    def comment(self, session_id: str) -> str: ...

    def keep_comment(self, session_id: str, text: str) -> None: ...

    def export(
        self,
        session_id: str,
        folder: str,
        formats: Sequence[str],
        progress: Callable[[int, int], None] | None,
        cancelled: Callable[[], bool],
        deidentified: bool,
        software_version: str,
    ) -> Sequence[str]: ...


class Forms(Protocol):
    """The clinic's form of reports."""

    @property
    def form(self) -> ReportForm: ...

    def keep(self, form: ReportForm) -> None: ...


class Printing(QObject):
    """What leaves Carpus from the review and the progress screen. ``reported`` and ``tabled`` carry a path and the
    sessions that went into it."""

    reported = Signal(str, object)
    tabled = Signal(str, object)
    _stepped = Signal(int, int)

    def __init__(
        self,
        window: QWidget,
        screen: ReportScreen,
        way: Navigator,
        tell: Messages,
        now: NowOpen,
        stored: PatientPapers,
        places: LastPlaces,
        background: Background,
        *,
        theme: Theme,
        therapist: Callable[[], str],
        forms: Forms,
        today: Callable[[], date] = date.today,
    ) -> None:
        super().__init__(window)
        self._window, self._screen, self._way, self._tell, self._now = window, screen, way, tell, now
        self._stored, self._places, self._background, self._therapist = stored, places, background, therapist
        self._forms, self._today = forms, today
        self._shown: Sequence[str] = ()
        self._letter_of: SessionReport | None = None
        self.letter = LetterSheet(window, theme)
        self.letter.wanted.connect(self._write_letter)
        screen.letter_wanted.connect(self._ask_letter)
        self.home = HomeSheet(window, theme)
        self.home.wanted.connect(self._write_home)
        screen.home_wanted.connect(self._ask_home)
        self._stop = threading.Event()
        self._exported = ""
        self.formats = ExportSheet(window, theme)
        self._research = True
        self.formats.wanted.connect(self._export)
        self.formats.stop.connect(self._stop.set)
        self._stepped.connect(self.formats.progress, Qt.ConnectionType.QueuedConnection)
        screen.told.connect(tell.fault)
        screen.panel.form_kept.connect(forms.keep)
        screen.panel.comment_kept.connect(self._keep_comment)
        screen.saved.connect(lambda path: self.reported.emit(path, self._shown))
        screen.saved.connect(lambda path: places.keep("reports", str(Path(path).parent)))

    def show_research(self, *, on: bool) -> None:
        """Whether reports have the page of movement, and an export all formats."""
        self._research = on
        self.formats.show_research(on=on)

    def session(self, session_id: str) -> None:
        """Make the report of a session and show it."""
        row, stored, name = self._now.patient, self._stored, self._now.name
        assert row is not None

        def gather() -> SessionReport:
            session = stored.session(session_id)
            report = session_report(
                session,
                choices=stored.choices(session_id),
                history=stored.history(row.patient_id),
                pseudonym=name,
                dominance=row.dominance,
                therapist=self._therapist(),
                by_hand=stored.by_hand(row.patient_id),
                camera=stored.camera(session),
                comment=stored.comment(session_id),
                form=self._forms.form,
            )
            report = replace(report, diagnosis=row.diagnosis, onset=row.onset, onset_day=row.onset_day)
            return report if self._research else replace(report, motion=None)

        def show(report: SessionReport) -> None:
            self._shown = [session_id]
            self._screen.begin(report, self._places.folder("reports"))
            self._way.go("report")

        self._background.run(gather, show, self._tell.fault)

    def _keep_comment(self, session_id: str, text: str) -> None:
        try:
            self._stored.keep_comment(session_id, text)
        except CarpusFault as fault:
            self._tell.fault(fault)

    def _ask_letter(self, report: SessionReport) -> None:
        row = self._now.patient
        if row is not None:
            self._letter_of = report
            known = self._listed(self._stored.recipients) or []
            self.letter.begin(known, has_name=bool(row.name))

    def _write_letter(self, recipient: str, language: str, named: bool) -> None:
        """Show the letter; the real name goes no further than its page."""
        row, report = self._now.patient, self._letter_of
        if row is None or report is None:
            return
        if recipient:
            self._listed(lambda: self._stored.remember_recipient(recipient))
        name = row.name if named else ""
        letter = LetterReport(report, recipient, self._today(), name, language)
        self._screen.begin(letter, self._places.folder("reports"))

    def _ask_home(self, report: SessionReport) -> None:
        row = self._now.patient
        if row is not None:
            last = self._listed(lambda: self._stored.home_plan(row.patient_id)) if row.patient_id else None
            self.home.begin(report, self._today(), last)

    def _write_home(self, home: HomeReport) -> None:
        """Show the sheet to take home, with the patient's own way where there is something good to say; what is on it
        is remembered with the patient."""
        row, stored = self._now.patient, self._stored
        if row is None:
            return
        if row.patient_id:
            self._listed(lambda: stored.keep_home_plan(row.patient_id, home.plan))

        def gather() -> HomeReport:
            history, goals = stored.history(row.patient_id), stored.goals(row.patient_id)
            return replace(home, way=own_way(home.report.figures, history, goals))

        self._background.run(
            gather, lambda made: self._screen.begin(made, self._places.folder("reports")), self._tell.fault, self
        )

    def _listed(self, ask: Callable[[], T]) -> T | None:
        """What the list of addresses says; a fault of it is told."""
        try:
            return ask()
        except CarpusFault as fault:
            self._tell.fault(fault)
            return None

    def course(self, sessions: Sequence[SessionFigures], followed: object, by_hand: Sequence[HandValue] = ()) -> None:
        """Make the report over sessions and show it; ``followed`` is what of the whole hand is on the screen,
        ``by_hand`` what counts of what was measured by hand."""
        row = self._now.patient
        if sessions and row is not None:
            self._shown = [one.session_id for one in sessions]
            report = progress_report(
                sessions,
                pseudonym=self._now.name,
                therapist=self._therapist(),
                what=followed if isinstance(followed, str) else None,
                software_version=__version__,
                by_hand=by_hand,
                form=self._forms.form,
            )
            self._screen.begin(report, self._places.folder("reports"))
            self._way.go("report")

    def pair(self, report: BesideReport) -> None:
        """Show the page of two sessions side by side."""
        self._shown = [figures.session_id for figures in report.sessions]
        self._screen.begin(replace(report, form=self._forms.form), self._places.folder("reports"))
        self._way.go("report")

    def export(self, session_id: str) -> None:
        """Ask for the formats and a folder, and write them."""
        self._exported = session_id
        self.formats.begin()

    def _export(self, formats: Sequence[str], deidentified: bool) -> None:
        """Beside the window; the sheet shows how far it is and stops it."""
        start = self._places.folder("exports")
        folder = QFileDialog.getExistingDirectory(self._window, self.tr("Export into a folder"), start)
        if not folder:
            return
        self._places.keep("exports", folder)
        self._stop.clear()
        self.formats.running()
        session_id = self._exported

        def write() -> Sequence[str]:
            return self._stored.export(
                session_id, folder, formats, self._stepped.emit, self._stop.is_set, deidentified, __version__
            )

        def written(names: Sequence[str]) -> None:
            self.formats.close_sheet()
            if names:
                tell_written(self._tell, folder, names)

        def refused(fault: Exception) -> None:
            self.formats.close_sheet()
            self._tell.fault(fault)

        self._background.run(write, written, refused)

    def table(self, progress: Progress) -> None:
        """Ask for a name and write the sessions of the progress screen as CSV."""
        title, kinds = self.tr("Save table"), "CSV (*.csv)"
        path = self._places.ask_where_to_save(self._window, "exports", "progress.csv", title, kinds)
        if path is not None:
            self._background.run(
                lambda: write_tables(path, progress),
                lambda paths: self._tables_written(paths, [point.figures.session_id for point in progress.points]),
                self._tell.fault,
            )

    def _tables_written(self, paths: Sequence[Path], sessions: Sequence[str]) -> None:
        for path in paths:
            self.tabled.emit(str(path), sessions)
        tell_written(self._tell, str(paths[0].parent), [path.name for path in paths])


def write_table(path: Path, progress: Progress) -> None:
    """One line for each session and movement, degrees with one decimal; a session left out says why."""
    head = [
        "session", "created", "hand", "exercise", "movement", "mean_deg", "sd_deg", "best_deg", "n", "not_compared",
        "joint", "at_least",
    ]  # fmt: skip
    try:
        with open(path, "w", newline="", encoding="utf-8", opener=private) as file:
            table = csv.writer(file)
            table.writerow(head)
            for point in progress.points:
                figures = point.figures
                who = (figures.session_id, figures.when.isoformat(), figures.side, figures.exercise.id)
                facts = [plain_cell(text) for text in who]
                for row in (*figures.rows, *figures.joint_rows):
                    values = [_decimal(value) for value in (row.mean_deg, row.sd_deg, row.best_deg)]
                    reasons, limited = " ".join(point.reasons), "yes" if row.limited else ""
                    table.writerow([*facts, row.movement, *values, row.count, reasons, row.joint, limited])
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause


def write_tables(path: Path, progress: Progress) -> list[Path]:
    """The table of the sessions, and one beside it of what was measured by hand, if anything was; the files."""
    replaces = path.exists()  # a person was asked for this one only
    write_table(path, progress)
    if not progress.by_hand:
        return [path]
    names = chain([f"{path.stem}-by-hand"], (f"{path.stem}-by-hand-{number}" for number in count(2)))
    others = (path.with_name(f"{name}{path.suffix}") for name in names)
    beside = next(one for one in others if replaces or not one.exists())
    write_by_hand(beside, progress.by_hand)
    return [path, beside]


def write_by_hand(path: Path, values: Sequence[HandValue]) -> None:
    """One line for each value that counts, as it was entered by hand: every try, and their mean in the unit named."""
    try:
        with open(path, "w", newline="", encoding="utf-8", opener=private) as file:
            table = csv.writer(file)
            table.writerow(COLUMNS)
            table.writerows([plain_cell(text) for text in row] for row in rows_of(values))
    except OSError as cause:
        raise OutputNotWritable(path, cause.strerror or "") from cause


def _decimal(value: float) -> str:
    return f"{value:.1f}" if value == value else ""

"""The flow of comparing a session with another measurement: choosing it, the work beside the window, what is saved."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFileDialog

from carpus.core.agreement.clocks import Stopped, WorkWatch
from carpus.core.agreement.compared_files import Result, compare_files, write_files
from carpus.core.agreement.reference import (
    ANGLE_FILES,
    POINT_FILES,
    SESSION_FILES,
    TABLE_FILES,
    ReferenceOutline,
    outline_of,
)
from carpus.core.hand.exercises import exercise_named
from carpus.core.hand.protocols import PALM_MARKERS, WRIST_ANGLES
from carpus.core.records.values import SessionEntry
from carpus.ui import numbers, terms
from carpus.ui.agreement.reference_sheet import ColumnsSheet, ReferenceSheet, missing
from carpus.ui.agreement.screen import AgreementScreen
from carpus.ui.background import Background
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.ports import ReferenceChoice
from carpus.ui.report.agreement_plot import write_plots


class AgreementFlow(Flow):
    """The sheets that choose the other one, and the screen with the difference."""

    place, guide, tab = "agreement", "checking", "review"
    while_aside = True
    screen: AgreementScreen

    _stepped = Signal(int, int)

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, AgreementScreen(context.theme, context.keys))
        screen = self.screen
        self._background = Background()  # its own: a long comparison holds up nothing else
        self._stop = threading.Event()
        self._session_id = ""
        self._number = 0
        self._choice = ReferenceChoice("")
        self._outline: ReferenceOutline | None = None
        self._result: Result | None = None
        self.reference = ReferenceSheet(context.shell, context.theme)
        self.columns = ColumnsSheet(context.shell, context.theme)
        self.reference.file_wanted.connect(self._ask_file)
        self.reference.session_wanted.connect(self._take_session)
        self.columns.wanted.connect(self._start)
        screen.other.connect(self._ask)
        screen.columns.connect(self._ask_columns)
        screen.stop.connect(self._stop.set)
        screen.save.connect(self._save)
        screen.told.connect(context.messages.fault)
        screen.chart.menu.saved.connect(lambda path: self.note_made([path], [context.now.session_id]))
        self._stepped.connect(screen.bar.show_progress, Qt.ConnectionType.QueuedConnection)

    @property
    def is_at_work(self) -> bool:
        return self._background.busy

    def show(self, session_id: str) -> None:
        """Compare a session; what it was compared with before is shown again."""
        if session_id != self._session_id or self._result is None:
            self._session_id, self._result = session_id, None
            self.screen.begin()
        self.screen.chart.menu.start_folder = self.context.places.folder("exports")
        self.context.way.go("agreement")
        if self._result is None:
            self._ask()

    def up(self) -> None:
        self.to_session()

    def leave(self) -> None:
        self._stop.set()

    def close(self) -> None:
        self._stop.set()
        self._background.wait()

    # --- choosing -----------------------------------------------------------------------------------------
    def _ask(self) -> None:
        self.reference.begin(self._others())

    def _others(self) -> list[tuple[str, str]]:
        """The patient's other results, those of the same recording first."""
        patient = self.context.now.patient
        if patient is None or not patient.patient_id:
            return []
        library = self.context.library
        own, results = library.entry(self._session_id), library.index.of_patient(patient.patient_id)
        others = [one for one in results if one.session_id != self._session_id and one.hand == own.hand]
        others.sort(key=lambda one: one.recording_id != own.recording_id)
        return [(one.session_id, self._words_of(one, own, results)) for one in others]

    def _words_of(self, entry: SessionEntry, own: SessionEntry, results: Sequence[SessionEntry]) -> str:
        when = numbers.report_date(entry.recorded, *(one.recorded for one in results))
        words = [when, terms.exercise_name(entry.exercise)]
        if entry.recording_id == own.recording_id:
            words.append(self.tr("same recording"))
        made = [one.created for one in results if one.recording_id == entry.recording_id]
        if len(made) > 1:
            words.append(self.tr("result of {when}").format(when=numbers.report_date(entry.created, *made)))
        return " · ".join(words)

    def _take_session(self, session_id: str) -> None:
        entry = self.context.library.entry(session_id)
        name = self.tr("the session of {when}").format(when=numbers.report_date(entry.recorded))
        self._outline = None
        self._start(ReferenceChoice(name, str(entry.path), session_id))

    def _ask_file(self) -> None:
        endings = " ".join(f"*{end}" for end in (*POINT_FILES, *ANGLE_FILES, *TABLE_FILES, *SESSION_FILES[:1]))
        words = self.tr("Other measurements ({endings})").format(endings=endings)
        start = self.context.places.folder("exports")
        path, _ = QFileDialog.getOpenFileName(self.context.shell, self.tr("Another measurement"), start, words)
        if path:
            self._take_file(Path(path))

    def _take_file(self, path: Path) -> None:
        choice = ReferenceChoice(path.name, str(path))

        def known(outline: ReferenceOutline) -> None:
            self._outline, self._choice = outline, choice
            if missing(outline, dict(outline.found)):
                self._ask_columns()
            else:
                self._start(choice)

        self._background.run(lambda: outline_of(path), known, self.context.messages.fault, self)

    def _ask_columns(self) -> None:
        if self._outline is not None:
            self.columns.begin(self._outline, self._ours(self._outline), self._choice)

    def _ours(self, outline: ReferenceOutline) -> Sequence[str]:
        if outline.kind == "points":
            return PALM_MARKERS
        protocol = exercise_named(self.context.library.entry(self._session_id).exercise).protocol
        return ("time", *WRIST_ANGLES, *protocol.joint_names(True))

    # --- the work -----------------------------------------------------------------------------------------
    def _start(self, choice: ReferenceChoice) -> None:
        """Beside the window; the limit is that of now, before anything is compared."""
        self._stop.set()  # of what may still run
        self._choice, self._result = choice, None
        self._number += 1
        number, limit_deg, stop = self._number, self.context.report.agreement_limit_deg, threading.Event()
        self._stop = stop
        session_id = self._session_id
        self.screen.running(choice.name)
        self.screen.first().setFocus(Qt.FocusReason.OtherFocusReason)

        def work() -> Result:
            return compare_files(
                self.context.library.entry(session_id).path, Path(choice.path), columns=choice.columns,
                markers=choice.markers, radians=choice.radians, choices=self.context.library.choices(session_id),
                watch=WorkWatch(self._stepped.emit, stop.is_set),
            )  # fmt: skip

        def done(result: Result) -> None:
            if number == self._number:
                self._result = result
                self.screen.show_compared(result.compared, choice.name, limit_deg, may_map=self._may_map())
                if self.context.way.place == "agreement":
                    self.screen.first().setFocus(Qt.FocusReason.OtherFocusReason)

        def failed(fault: Exception) -> None:
            if number != self._number:
                return
            self.screen.begin(may_map=self._may_map())
            self.screen.first().setFocus(Qt.FocusReason.OtherFocusReason)
            if not isinstance(fault, Stopped):
                self.context.messages.fault(fault)

        self._background.run(work, done, failed, self)

    def _may_map(self) -> bool:
        return self._outline is not None and self._outline.kind in ("points", "angles")

    # --- saving -------------------------------------------------------------------------------------------
    def _save(self) -> None:
        """Ask for a folder and write what ``carpus compare --output`` writes."""
        result = self._result
        if result is None:
            return
        start = self.context.places.folder("exports")
        folder = QFileDialog.getExistingDirectory(
            self.context.shell, self.tr("Save tables and plots into a folder"), start
        )
        if not folder:
            return
        self.context.places.keep("exports", folder)
        sessions = [one for one in (self._session_id, self._choice.session_id) if one]
        limit_deg = self.screen.limit_deg

        def write() -> list[Path]:
            files = write_files(result, Path(folder), self.context.version)
            return [*files, *write_plots(result.compared, Path(folder), result.stem, limit_deg)]

        self._background.run(write, lambda paths: self.tell_made(paths, sessions), self.context.messages.fault, self)

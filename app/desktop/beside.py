"""The flow of two sessions side by side: which two, from where, what is printed and written of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from carpus import __version__
from carpus.app.desktop.files_written import tell_written
from carpus.app.desktop.last_places import LastPlaces
from carpus.app.desktop.now_open import NowOpen
from carpus.app.desktop.places import Place
from carpus.app.desktop.viewing import KeptSessions
from carpus.app.desktop.ways import Tell, Way
from carpus.core.provenance import with_revision
from carpus.core.records.values import SessionEntry
from carpus.ui import numbers, terms
from carpus.ui.background import Background
from carpus.ui.beside.screen import BesideScreen
from carpus.ui.beside.shown import Shown
from carpus.ui.beside.tables import write_tables
from carpus.ui.report.beside_page import BesideReport
from carpus.ui.sessions.sheets import ChooseSheet
from carpus.ui.theme import Theme


class Beside(QObject):
    """``report_wanted`` carries a page to be shown; ``tabled`` the paths written and the sessions that went into them.
    ``back_to`` is where one came from."""

    report_wanted = Signal(object)
    tabled = Signal(object, object)

    def __init__(
        self,
        window: QWidget,
        screen: BesideScreen,
        way: Way,
        tell: Tell,
        now: NowOpen,
        stored: KeptSessions,
        places: LastPlaces,
        background: Background,
        *,
        theme: Theme,
        therapist: Callable[[], str],
    ) -> None:
        super().__init__(window)
        self._window, self._screen, self._way = window, screen, way
        self._tell, self._now, self._stored, self._places = tell, now, stored, places
        self._background, self._therapist = background, therapist
        self.back_to: Place = "sessions"
        self.sheet = ChooseSheet(window, theme)
        self.sheet.chosen.connect(self._take_other)
        screen.told.connect(tell.fault)
        screen.report.connect(self._print)
        screen.export.connect(self._export)
        screen.other.connect(self._ask_other)

    def show(self, one: str, other: str) -> None:
        """Show two sessions; Back leads to where one is now."""
        if self._way.place != "beside":
            self.back_to = self._way.place
        patient = self._now.patient
        self._screen.begin((one, other), patient.side if patient is not None else "")
        self._way.go("beside")

    def _print(self, now: Shown) -> None:
        pseudonym = self._now.name or now.both.first.subject_id
        made_by = with_revision(__version__)
        self.report_wanted.emit(BesideReport(now, self._screen.quantity, pseudonym, self._therapist(), made_by))

    # --- another session in place of the second ------------------------------------------------------------
    def _ask_other(self) -> None:
        patient = self._now.patient
        entries = self._stored.sessions(patient.patient_id) if patient is not None and patient.patient_id else ()
        first, second = self._screen.ids
        others = [entry for entry in entries if entry.session_id not in (first, second)]
        what = {entry.session_id: _entry_words(entry) for entry in entries}
        self.sheet.begin(
            self.tr("With which session?"),
            self.tr("{session} stays.").format(session=what.get(first, self.tr("The first one"))),
            self.tr("Compare"),
            [(entry.session_id, what[entry.session_id]) for entry in others],
        )

    def _take_other(self, session_id: str) -> None:
        if session_id and session_id != "None":
            self.show(self._screen.ids[0], session_id)

    # --- tables -------------------------------------------------------------------------------------------
    def _export(self, now: Shown) -> None:
        """Ask for a name and write the differences and the curves as CSV."""
        title, kinds = self.tr("Save tables"), "CSV (*.csv)"
        path = self._places.ask_where_to_save(self._window, "exports", "side-by-side.csv", title, kinds)
        if path is not None:
            target = path if path.suffix else path.with_suffix(".csv")
            replaces = target.exists()
            sessions = [now.both.first.session_id, now.both.second.session_id]
            self._background.run(
                lambda: write_tables(target, now, replaces=replaces),
                lambda paths: self._written(paths, sessions),
                self._tell.fault,
                self,
            )

    def _written(self, paths: Sequence[Path], sessions: Sequence[str]) -> None:
        self.tabled.emit(paths, sessions)
        tell_written(self._tell, str(paths[0].parent), [path.name for path in paths])


def _entry_words(entry: SessionEntry) -> str:
    """``20 Nov 2026, 11:37 · Wrist flexion–extension · Right hand``."""
    return " · ".join(
        (numbers.report_date(entry.recorded), terms.exercise_name(entry.exercise), terms.hand_name(entry.hand))
    )

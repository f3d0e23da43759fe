"""The flow of the clinic's page: a week is read beside the window, a patient opened, the page saved."""

from __future__ import annotations

from collections.abc import Callable
from datetime import date

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from carpus.app.desktop.files_written import tell_written
from carpus.app.desktop.last_places import LastPlaces
from carpus.app.desktop.ways import Tell, Way
from carpus.core.durable import replace_file
from carpus.core.library.library import Library
from carpus.core.records.clinic_week import clinic_week
from carpus.core.records.values import ClinicWeek
from carpus.ui.background import Background
from carpus.ui.clinic.screen import ClinicScreen
from carpus.ui.clinic.words import write_clinic_page


class Clinic(QObject):
    """Counts of the store, week by week."""

    opened = Signal(str)
    """A patient to be shown."""

    def __init__(
        self,
        window: QWidget,
        screen: ClinicScreen,
        way: Way,
        tell: Tell,
        library: Library,
        places: LastPlaces,
        background: Background,
        *,
        after_days: Callable[[], int],
        today: Callable[[], date] = date.today,
    ) -> None:
        super().__init__(window)
        self._window, self._screen, self._way, self._tell, self._library = window, screen, way, tell, library
        self._places, self._background, self._after_days, self._today = places, background, after_days, today
        screen.week.connect(lambda day: self._read(day, screen.show_week))
        screen.patient.connect(self.opened)
        screen.page.connect(self._save)

    def show(self) -> None:
        """This week; who went elsewhere while it was read stays there."""
        place = self._way.place

        def shown(week: ClinicWeek) -> None:
            self._screen.show_week(week)
            if self._way.place == place:
                self._way.go("clinic")

        self._read(self._today(), shown)

    def _read(self, day: date, shown: Callable[[ClinicWeek], None]) -> None:
        store, today, after_days = self._library.store, self._today(), self._after_days()
        self._background.run(lambda: clinic_week(store, day, today, after_days), shown, self._tell.fault, self)

    def _save(self) -> None:
        week = self._screen.shown
        if week is None:
            return
        name = f"carpus-clinic-{week.monday:%Y-%m-%d}.pdf"
        title, kinds = self.tr("Save page"), "PDF (*.pdf)"
        path = self._places.ask_where_to_save(self._window, "reports", name, title, kinds)
        if path is not None:
            self._background.run(
                lambda: replace_file(path, lambda part: write_clinic_page(part, week)),
                lambda _: tell_written(self._tell, str(path.parent), [path.name]), self._tell.fault, self,
            )  # fmt: skip

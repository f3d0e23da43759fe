"""The flow of the clinic's page: a week is read beside the window, a patient opened, the page saved."""

from __future__ import annotations

from collections.abc import Callable
from datetime import date

from carpus.core.durable import replace_file
from carpus.core.records.of_clinic import clinic_week
from carpus.core.records.values import ClinicWeek
from carpus.ui.clinic.screen import ClinicScreen, write_clinic_page
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.messages.messages import tell_written


class ClinicFlow(Flow):
    """Counts of the store, week by week."""

    place, guide = "clinic", "data"
    screen: ClinicScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, ClinicScreen(context.theme, context.keys))
        screen = self.screen
        screen.week.connect(lambda day: self._read(day, screen.show_week))
        screen.patient.connect(lambda patient_id: context.way.show("patients", patient_id))
        screen.save.clicked.connect(self._save)

    def title(self) -> str:
        return self.tr("Clinic")

    def show(self) -> None:
        """This week; who went elsewhere while it was read stays there."""
        place = self.context.way.place

        def shown(week: ClinicWeek) -> None:
            self.screen.show_week(week)
            if self.context.way.place == place:
                self.context.way.go("clinic")

        self._read(self.context.today(), shown)

    def _read(self, day: date, shown: Callable[[ClinicWeek], None]) -> None:
        store, today, after_days = self.context.library.store, self.context.today(), self.context.report.retest_days
        self.run(lambda: clinic_week(store, day, today, after_days), shown)

    def _save(self) -> None:
        week = self.screen.shown
        if week is None:
            return
        name = f"carpus-clinic-{week.monday:%Y-%m-%d}.pdf"
        title, kinds = self.tr("Save page"), "PDF (*.pdf)"
        path = self.ask_where_to_save("reports", name, title, kinds)
        if path is not None:
            self.run(
                lambda: replace_file(path, lambda part: write_clinic_page(part, week)),
                lambda _: tell_written(self.context.messages, str(path.parent), [path.name])
            )  # fmt: skip

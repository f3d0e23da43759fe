"""The flow of the clinic's test and retest: who takes part, who is next, and the limits put into force."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QWidget

from carpus.core.agreement.retest import Restated, RetestPlan, StudyFigures, write_study
from carpus.core.durable import replace_file
from carpus.core.records.retest_people import RetestPeople
from carpus.core.words import Words
from carpus.ui import terms
from carpus.ui.controls.button import Button, Tick
from carpus.ui.controls.layouts import RING_PX, STRETCH, ScrollArea, host_of, in_column, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, Text
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.messages.messages import Answer
from carpus.ui.retest.screen import RetestScreen
from carpus.ui.theme import Theme


class RetestFlow(Flow):
    """Whoever was open is closed. ``in_force``: the clinic's limits are others now."""

    place, guide = "retest", "checking"
    screen: RetestScreen

    in_force = Signal()

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, RetestScreen(context.theme, context.keys))
        screen = self.screen
        self._people = RetestPeople(context.library)
        self._exercise = ""
        self._asked = 0
        self.sheet = PeopleSheet(context.shell, context.theme)
        self.sheet.chosen.connect(self._choose)
        screen.people.connect(self._ask_people)
        screen.exercise_chosen.connect(self._take_exercise)
        screen.measure.connect(lambda patient_id: context.way.show("camera", patient_id))
        screen.use.connect(self._ask_use)
        screen.save.connect(self._save)

    def title(self) -> str:
        return self.tr("Test and retest")

    def show(self) -> None:
        self.close_patient()
        self.context.way.go("retest")
        self._read()

    def _read(self) -> None:
        wanted, people, today = self._exercise, self._people, self.context.today()
        self._asked += 1
        self.screen.reading()

        def read() -> tuple[Sequence[str], RetestPlan]:
            exercises = people.exercises()
            exercise = wanted if wanted in exercises else next(iter(exercises), "WRIST_FE")
            return exercises, people.plan(exercise, today)

        self.run(read, self._shown)

    def _shown(self, found: tuple[Sequence[str], RetestPlan]) -> None:
        exercises, plan = found
        self._exercise = plan.exercise
        self.screen.show_exercises(exercises, plan.exercise)
        self.screen.show_plan(plan, self.context.library.error_limits)
        if self.context.way.place == "retest":
            self.screen.first().setFocus(Qt.FocusReason.OtherFocusReason)
        study, asked = plan.study, self._asked
        if study is not None and study.found and not study.simulated:
            self.run(
                lambda: self._people.patients(study), lambda found: self._restate(study, asked, list(found), 0, ())
            )

    def _restate(
        self,
        study: StudyFigures,
        asked: int,
        patients: Sequence[tuple[str, str]],
        done: int,
        found: Sequence[Restated],
    ) -> None:
        """What the limits would change, patient by patient: between two of them other work has its turn."""
        if asked != self._asked:
            return  # another study is shown by now
        self.screen.show_restated(found, done, len(patients))
        if done < len(patients) and self.context.way.place == "retest":
            patient_id, pseudonym = patients[done]
            self.run(
                lambda: self._people.restated(patient_id, pseudonym, study),
                lambda more: self._restate(study, asked, patients, done + 1, (*found, *more)),
            )

    def _take_exercise(self, exercise: str) -> None:
        self._exercise = exercise
        self._read()

    def _ask_people(self) -> None:
        self.sheet.begin(self._people.candidates(), self._people.chosen())

    def _choose(self, patient_ids: Sequence[str]) -> None:
        self.run(lambda: self._people.choose(patient_ids), lambda _: self._read())

    def _ask_use(self) -> None:
        study = self.screen.plan.study
        if study is None or self.screen.plan.blocked:
            return
        what = self.tr("Use these limits for {exercise}, from {count} people?").format(
            exercise=terms.exercise_name(study.exercise), count=study.people
        )
        self.context.messages.ask(
            Words(
                what,
                self.tr("Sessions stay as they are; reports already made keep their limits."),
                self.tr("From now on progress and reports judge by them, and name date and number of people."),
            ),
            (
                Answer(self.tr("Use these limits"), self._use, "U", risky=True),
                Answer(self.tr("Leave it as it is"), lambda: None),
            ),
            icon="check",
        )

    def _use(self) -> None:
        study, today = self.screen.plan.study, self.context.today()
        if study is not None:
            self.run(lambda: self._people.store(study, today), lambda _: self._stored())

    def _stored(self) -> None:
        self.in_force.emit()
        self._read()

    def _save(self) -> None:
        study = self.screen.plan.study
        if study is None:
            return
        title, kinds = self.tr("Save table"), "CSV (*.csv)"
        path = self.ask_where_to_save("exports", "retest.csv", title, kinds)
        if path is not None:
            self.run(
                lambda: replace_file(path, lambda part: write_study([study], part)),
                lambda _: None
            )  # fmt: skip


class PeopleSheet(Sheet):
    """``chosen`` carries the identities of all who take part."""

    chosen = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 560)
        words = self.tr(
            "Volunteers or staff whose hands do not change, never patients. Add them under Patients, by a pseudonym "
            "such as P01. Each is measured twice or more within 14 days, all discs taken off and put on anew."
        )
        self.head(self.tr("Who takes part?"), words, gap=8)
        self._scroll = ScrollArea(QWidget())
        self.card.body.addWidget(self._scroll)
        self.ticks: dict[str, Tick] = {}
        self.take = Button(theme, self.tr("These take part"), "primary", height_px=44)
        self.answer_row(self.take)
        self.take.clicked.connect(self._take)

    def begin(self, people: Sequence[tuple[str, str, int]], chosen: Sequence[str]) -> None:
        """Identity, pseudonym and number of sessions of everybody, and who takes part already."""
        rows = QWidget()
        column = in_column(gap=2, margins=(RING_PX, RING_PX, RING_PX + 8, RING_PX), within=rows)
        self.ticks = {}
        for identity, name, sessions in people:
            count = self.tr("1 session") if sessions == 1 else self.tr("{count} sessions").format(count=sessions)
            tick = Tick(self._theme, f"{name.replace('&', '&&')} · {count}")
            tick.setChecked(identity in chosen)
            column.addLayout(in_line(tick, STRETCH))
            self.ticks[identity] = tick
        if not people:
            column.addWidget(Text(self._theme, self.tr("Nobody is in the list yet."), 14, REGULAR, "text2"))
        column.addStretch(1)
        self._scroll.setWidget(rows)
        self._take_room()
        self.open(next(iter(self.ticks.values()), self.take))

    def _take_room(self) -> None:
        super()._take_room()
        rows = self._scroll.widget() if hasattr(self, "_scroll") else None  # while the sheet is being made
        if rows is not None:
            room = host_of(self).height() - self._theme.px(320)
            self._scroll.setFixedHeight(max(min(rows.sizeHint().height(), room), self._theme.px(80)))

    def _take(self) -> None:
        self.close_sheet()
        self.chosen.emit([identity for identity, tick in self.ticks.items() if tick.isChecked()])

"""Archive or erase: what would go is worked out, shown, and done only when it was confirmed; what was done is said."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from datetime import date, datetime

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QVBoxLayout, QWidget

from carpus.core.records.erasure import ErasurePlan
from carpus.core.records.keeping import Records, kept_until
from carpus.core.rounding import written
from carpus.core.words import Words
from carpus.ui import numbers, terms
from carpus.ui.controls.button import Button
from carpus.ui.controls.card import Card, Line
from carpus.ui.controls.layouts import STRETCH, ScrollArea, ScrolledColumn, fill, in_column, in_line
from carpus.ui.controls.sheet import Sheet
from carpus.ui.controls.text import REGULAR, SEMIBOLD, Sign, Text
from carpus.ui.flow import ScreenContext
from carpus.ui.patients.screen import PatientsScreen
from carpus.ui.sessions.screen import SessionsScreen
from carpus.ui.theme import Theme
from carpus.ui.translate import inside


class Erasing(QObject):
    """One sheet for sessions and patients. ``years`` of retention and the ``last_backup`` are asked for each time."""

    def __init__(
        self,
        context: ScreenContext,
        records: Records,
        sessions: Callable[[], SessionsScreen],
        patients: PatientsScreen,
        years: Callable[[], int] = lambda: 0,
        last_backup: Callable[[], datetime | None] = lambda: None,
    ) -> None:
        super().__init__(context.shell)
        self._context, self._records, self._sessions, self._patients = context, records, sessions, patients
        self._years, self._last_backup = years, last_backup
        self.sheet = EraseSheet(context.shell.stage, context.theme)
        self._plan: ErasurePlan | None = None
        patients.erase_wanted.connect(self.ask_patient)
        context.way.when_made("sessions", self._connect_sessions)
        self.sheet.erase.connect(self._erase)
        self.sheet.archive.connect(self._archive)

    def _connect_sessions(self) -> None:
        self._sessions().erase_wanted.connect(self.ask_session)
        self._sessions().moved.connect(self._moved)

    def ask_session(self, session_id: str) -> None:
        self._ask(lambda: self._records.plan_session(session_id))

    def ask_patient(self, patient_id: str) -> None:
        self._ask(lambda: self._records.plan_patient(patient_id))

    def _ask(self, work: Callable[[], ErasurePlan]) -> None:
        self._context.background.run(work, self._show, self._context.messages.fault, self)

    def _show(self, plan: ErasurePlan) -> None:
        self._plan, patient = plan, self._context.now.patient
        if patient is not None and not plan.patient_id:  # a recording of nobody is listed under a name of its own
            plan = replace(plan, pseudonym=patient.pseudonym)
        self.sheet.begin(plan, self._years(), self._last_backup(), self._context.today())

    def _erase(self) -> None:
        plan, self._plan = self._plan, None
        if plan is not None:
            self._context.background.run(
                lambda: self._records.erase(plan),
                lambda files: self._erased(plan, files),
                lambda fault: self._refused(plan, fault),
                self,
            )

    def _erased(self, plan: ErasurePlan, files: int) -> None:
        single = plan.kind == "session"
        self._gone(plan)
        what = self.tr("The session is erased.") if single else self.tr("The patient is erased.")
        count = self.tr("Files deleted: {count}.").format(count=files)
        place = self._sessions().notice_place if single else self._patients.notice_place
        self._say(place, Words(what, count, ""), "trash-2")

    def _moved(self, name: str) -> None:
        words = Words(self.tr("The session is now one of {name}.").format(name=name), "", "")
        self._say(self._sessions().notice_place, words, "arrow-right")

    def _say(self, place: QVBoxLayout, words: Words, icon: str) -> None:
        """What was done, until it is closed or left."""
        strip = self._context.messages.strip(place, words, "", lambda: None, icon=icon, later=self.tr("Close"))
        self._context.way.leaving.connect(strip.later)

    def _archive(self) -> None:
        plan, self._plan = self._plan, None
        if plan is not None:
            single = plan.kind == "session"
            act = self._records.archive_session if single else self._records.archive_patient

            def done(_: object) -> None:
                self._gone(plan)
                self._offer_undo(plan, plan.identity)

            self._context.background.run(lambda: act(plan.identity), done, self._context.messages.fault, self)

    def _offer_undo(self, plan: ErasurePlan, archived: str) -> None:
        """What was archived is said where it was, and comes back by one press."""
        if plan.kind == "session":
            what = self.tr("The session of {day} is in the archive.").format(
                day=numbers.report_date(plan.results[0].recorded)
            )
            place = self._sessions().notice_place
        else:
            what = self.tr("{name} is in the archive.").format(name=plan.pseudonym)
            place = self._patients.notice_place
        words = Words(what, self.tr("Nothing is lost. It counts nowhere until it is brought back."), "")
        strip = self._context.messages.strip(
            place, words, self.tr("&Undo"), lambda: self._bring_back(archived), icon="archive", later=self.tr("Close")
        )
        self._context.way.leaving.connect(strip.later)  # elsewhere it is said no more; the archive has it

    def _bring_back(self, identity: str) -> None:
        self._context.background.run(
            lambda: self._records.bring_back(identity),
            lambda _: self.show_again(identity),
            self._context.messages.fault,
            self,
        )

    def show_again(self, chosen: str = "") -> None:
        """The list that is shown, with what is in it now; ``chosen`` the patient or session that is to be chosen."""
        now, way = self._context.now, self._context.way
        self._sessions().changed.emit()
        if way.place == "sessions" and now.patient is not None:
            now.session_id = chosen or now.session_id
            way.show("sessions", now.patient.patient_id)
        elif way.place == "patients":
            self._patients.refresh(chosen)

    def _refused(self, plan: ErasurePlan, fault: Exception) -> None:
        self._gone(plan)
        self._context.messages.fault(fault)

    def _gone(self, plan: ErasurePlan) -> None:
        """The list without it; who measures by now, or has another patient open, is not taken away from there."""
        self._sessions().changed.emit()
        patient, way, single = self._context.now.patient, self._context.way, plan.kind == "session"
        measures = way.behind == "live" and (single or way.is_recording())
        if measures or (patient is not None and patient.patient_id != plan.patient_id):
            return
        if single and patient is not None:
            way.show("sessions", patient.patient_id)
        else:
            way.show("patients")


ICON_PX, COLUMN_PX = 26, 72
MOST_PATHS = 3


class EraseSheet(Sheet):
    """``erase`` only after the pseudonym was typed, and never by Enter; ``archive`` is the primary, which Enter takes,
    also from the line to type in: what is typed presses nothing."""

    erase = Signal()
    archive = Signal()

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 760)
        self.card.set_colors("surface", "bad", 2.0)
        self._pseudonym = ""
        self.title = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.about = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.goes, self.stays, self.ends = (Text(theme, "", 14, REGULAR, "text2", wrap=True) for _ in range(3))
        self.label = Text(theme, "", 14, wrap=True)
        self.line = QLineEdit()
        self.line.setMinimumWidth(theme.px(200))
        self.line.textChanged.connect(self._check)
        self.for_good = Button(theme, self.tr("Erase for good"), "plain", height_px=52)
        self.for_good.on_enter = "nothing"  # what cannot be undone takes the mouse or the space bar
        self.cancel = Button(theme, self.tr("Cancel"), "plain", hint=self.tr("Esc"), height_px=52)
        self.instead = Button(theme, self.tr("Archive instead"), "primary")
        self.for_good.clicked.connect(self._erase)
        self.cancel.clicked.connect(self.close_sheet)
        self.instead.clicked.connect(self._archive)
        self.set_default(self.instead)
        self._lay_out(theme)

    def _lay_out(self, theme: Theme) -> None:
        body = self.card.body
        body.setSpacing(10)
        self._parts = ScrolledColumn()
        column = in_column(
            _section(_sign(theme, "trash-2", "bad"), self.title, self.about),
            gap=10,
            margins=(0, 0, 0, 0),
            within=self._parts,
        )
        for sign, title, words in (
            (_sign(theme, "bad"), self.tr("This goes"), self.goes),
            (_sign(theme, "good"), self.tr("This stays"), self.stays),
            (_sign(theme, "warn"), self.tr("This cannot be undone"), self.ends),
        ):
            fill(column, Line(theme), _section(sign, Text(theme, title, 20, SEMIBOLD), words))
        column.addWidget(Line(theme))
        milder = Card(theme, 0, "soft", "soft")
        offered = Text(
            theme, self.tr("Leaves all lists and counts nowhere; everything can be brought back."), wrap=True
        )
        milder.body.setContentsMargins(0, 12, 12, 12)
        milder.body.addLayout(
            _section(
                _sign(theme, "archive"),
                Text(theme, self.tr("Archive instead"), 16, SEMIBOLD),
                offered,
            )
        )
        column.addWidget(milder)
        self._scroll = ScrollArea(self._parts)  # large text on a small screen: the answer stays to be seen
        fill(body, self._scroll, in_line((self.label, 1), (self.line, 1), gap=16), 8)
        body.addLayout(in_line(self.for_good, STRETCH, self.cancel, self.instead))

    def begin(self, plan: ErasurePlan, years: int, last_backup: datetime | None, today: date) -> None:
        """Say what a plan would do, with the ``years`` of retention (0: none are set) and the ``last_backup``."""
        self._pseudonym = plan.pseudonym
        single = plan.kind == "session"
        self.title.setText(
            self.tr("Erase this session for good?") if single else self.tr("Erase this patient for good?")
        )
        self.about.setText(_name_what_goes(plan))
        self.goes.setText(self._goes(plan))
        self.stays.setText(self._stays(plan, last_backup))
        self.ends.setText(self._ends(plan, years, last_backup, today))
        self.label.setText(self.tr("To erase, type “{name}” here").format(name=plan.pseudonym))
        self.line.clear()
        self.line.setAccessibleName(self.label.text())
        self._check()
        self.open(self.line)
        self._fit()

    def _fit(self) -> None:
        column = self._parts.layout()
        assert column is not None
        column.activate()
        wanted = column.totalHeightForWidth(self.card.width() - 48 - 12)
        room = self.height() - self._theme.px(52 + 40 + 18) - 120
        self._scroll.setFixedHeight(max(min(wanted, room), self._theme.px(160)))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self.isVisible():
            self._fit()

    def _goes(self, plan: ErasurePlan) -> str:
        words = self.tr("Angles, pictures, notes and pain scores of this session ({size} MB; files: {files}).")
        if plan.kind == "patient":
            words = self.tr(
                "The patient’s entry with real name, notes and values measured by hand, and all sessions ({count}) "
                "with their angles, pictures and notes ({size} MB; files: {files})."
            )
        size_mb = plan.size_bytes / 1e6
        size = written(size_mb) if size_mb >= 10 else numbers.fixed(size_mb, 1)
        return words.format(count=plan.sessions, files=len(plan.files), size=size)

    def _stays(self, plan: ErasurePlan, last_backup: datetime | None) -> str:
        parts = [self.tr("The patient’s other sessions.")] if plan.kind == "session" else []
        if last_backup is not None:
            day = numbers.day_of_year(last_backup)
            parts.append(
                self.tr("Back-ups up to {day} and files copied elsewhere: Carpus cannot reach them.").format(day=day)
            )
        else:
            parts.append(self.tr("Files copied elsewhere: Carpus cannot reach them."))
        for words, found in (
            (self.tr("Reports and exports saved elsewhere, delete them yourself ({n}): {path}."), plan.made),
            (self.tr("Files outside the patient’s folder, look at them yourself ({n}): {path}."), plan.outside),
        ):
            if found:
                paths = ", ".join(map(str, found[:MOST_PATHS])) + (", …" if len(found) > MOST_PATHS else "")
                parts.append(words.format(n=len(found), path=paths))
        parts.append(self.tr("The log keeps that it was erased, no name."))
        return " ".join(parts)

    def _ends(self, plan: ErasurePlan, years: int, last_backup: datetime | None, today: date) -> str:
        words = self.tr("Nobody can bring it back.")
        if last_backup is not None:
            words = self.tr("Carpus cannot bring it back: a restored back-up leaves it out.")
        until = kept_until(max(one.recorded for one in plan.results), years) if plan.results else None
        if until is None or until < today:
            return words
        early = self.tr(
            "Your records must be kept until {day} ({years} years, as set in Settings): erasing comes before that day."
        )
        return f"{words} {early.format(day=numbers.day_of_year(until), years=years)}"

    def _check(self) -> None:
        typed = " ".join(self.line.text().split())
        self.for_good.setEnabled(bool(typed) and typed.casefold() == self._pseudonym.casefold())

    def _erase(self) -> None:
        self.close_sheet()
        self.erase.emit()

    def _archive(self) -> None:
        self.close_sheet()
        self.archive.emit()


def _name_what_goes(plan: ErasurePlan) -> str:
    if plan.kind == "patient":
        return plan.pseudonym
    one = plan.results[0]
    what = f"{terms.exercise_name(one.exercise)}, {inside(terms.hand_name(one.hand))}"
    return " · ".join((plan.pseudonym, numbers.report_date(one.recorded), what))


def _sign(theme: Theme, name: str, token: str = "accent") -> Sign:
    """A state, or a line icon, in a column of its own."""
    return Sign(theme, name, ICON_PX, (COLUMN_PX, ICON_PX + 4), token, lean=0.33)


def _section(sign: QWidget, title: QWidget, words: QWidget) -> QHBoxLayout:
    texts = in_column(title, words, gap=4)
    return in_line((sign, 0, Qt.AlignmentFlag.AlignTop), (texts, 1), gap=0)

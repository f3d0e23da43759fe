"""Archiving and deletion: what would be deleted is shown and done only after confirmation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from datetime import date, datetime

from PySide6.QtCore import QObject, Qt, Signal, SignalInstance
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QVBoxLayout, QWidget

from carpus.core.model.fault_text import MessageText
from carpus.core.model.rounding import format_rounded
from carpus.core.records.erasure import ErasurePlan
from carpus.core.records.retention import RecordRetention, retention_end
from carpus.ui.kit import numbers
from carpus.ui.kit.button import Button
from carpus.ui.kit.card import Card, Separator
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.layouts import STRETCH, ScrollArea, ScrolledColumn, column_layout, fill, row_layout
from carpus.ui.kit.text import REGULAR, SEMIBOLD, Icon, Text
from carpus.ui.kit.theme import Theme
from carpus.ui.kit.translate import to_mid_sentence
from carpus.ui.screens.patients.screen import PatientsScreen
from carpus.ui.screens.sessions.screen import SessionsScreen
from carpus.ui.shell.flow import ScreenContext
from carpus.ui.words import terms


class DeletionController(QObject):
    """Controller of deletion for sessions and patients."""

    def __init__(
        self,
        context: ScreenContext,
        records: RecordRetention,
        sessions: Callable[[], SessionsScreen],
        patients: PatientsScreen,
        retention_years: Callable[[], int] = lambda: 0,
        last_backup: Callable[[], datetime | None] = lambda: None,
    ) -> None:
        super().__init__(context.window)
        self._context, self._records, self._sessions, self._patients = context, records, sessions, patients
        self._retention_years, self._last_backup = retention_years, last_backup
        self.dialog = DeleteDialog(context.window.screen_stack, context.theme)
        patients.delete_requested.connect(self.plan_patient_deletion)
        context.navigator.run_when_created("sessions", self._connect_sessions)
        self.dialog.delete_confirmed.connect(self._delete)
        self.dialog.archive_confirmed.connect(self._archive)

    def _connect_sessions(self) -> None:
        self._sessions().delete_requested.connect(self.plan_session_deletion)
        self._sessions().session_moved.connect(self._on_moved)

    def plan_session_deletion(self, session_id: str) -> None:
        self._context.run(self, lambda: self._records.plan_session(session_id), self._show_plan)

    def plan_patient_deletion(self, patient_id: str) -> None:
        self._context.run(self, lambda: self._records.plan_patient(patient_id), self._show_plan)

    def _show_plan(self, plan: ErasurePlan) -> None:
        patient = self._context.current.patient
        if patient is not None and not plan.patient_id:  # a recording without a patient is listed under its own name
            plan = replace(plan, pseudonym=patient.pseudonym)
        self.dialog.show_plan(plan, self._retention_years(), self._last_backup(), self._context.today())

    def _delete(self, plan: ErasurePlan) -> None:
        self._context.run(
            self,
            lambda: self._records.erase(plan),
            lambda files: self._on_deleted(plan, files),
            lambda fault: self._on_delete_failed(plan, fault),
        )

    def _on_deleted(self, plan: ErasurePlan, files: int) -> None:
        single = plan.kind == "session"
        self._refresh_after_removal(plan)
        what = self.tr("The session was deleted.") if single else self.tr("The patient was deleted.")
        count = self.tr("Files deleted: {count}.").format(count=files)
        place = self._sessions().notice_layout if single else self._patients.notice_layout
        self._show_notice(place, MessageText(what, count, ""), "trash-2")

    def _on_moved(self, name: str) -> None:
        words = MessageText(self.tr("The session now belongs to {name}.").format(name=name), "", "")
        self._show_notice(self._sessions().notice_layout, words, "arrow-right")

    def _show_notice(self, layout: QVBoxLayout, words: MessageText, icon: str) -> None:
        """Show what was done until the notice is closed or the screen left."""
        strip = self._context.messages.show_notice(
            layout, words, "", lambda: None, icon=icon, later_text=self.tr("Close")
        )
        self._context.navigator.screen_changing.connect(strip.postponed)

    def _archive(self, plan: ErasurePlan) -> None:
        act = self._records.archive_session if plan.kind == "session" else self._records.archive_patient

        def on_archived(_: object) -> None:
            self._refresh_after_removal(plan)
            self._offer_undo(plan)

        self._context.run(self, lambda: act(plan.subject_id), on_archived)

    def _offer_undo(self, plan: ErasurePlan) -> None:
        """Show what was archived, with an undo button."""
        if plan.kind == "session":
            what = self.tr("The session of {day} is in the archive.").format(
                day=numbers.format_date_time(plan.results[0].recorded)
            )
            place = self._sessions().notice_layout
        else:
            what = self.tr("{name} is in the archive.").format(name=plan.pseudonym)
            place = self._patients.notice_layout
        words = MessageText(what, self.tr("Nothing was deleted. Archived items are excluded until restored."), "")
        strip = self._context.messages.show_notice(
            place, words, self.tr("&Undo"), lambda: self._restore(plan.subject_id), icon="archive",
            later_text=self.tr("Close"),
        )  # fmt: skip
        self._context.navigator.screen_changing.connect(strip.postponed)  # on other screens the archive shows it

    def _restore(self, identity: str) -> None:
        self._context.run(self, lambda: self._records.unarchive(identity), lambda _: self.refresh_lists(identity))

    def refresh_lists(self, selected_id: str = "") -> None:
        """Reload the visible list and select a patient or session."""
        now, way = self._context.current, self._context.navigator
        self._sessions().sessions_changed.emit()
        if way.screen_name == "sessions" and now.patient is not None:
            now.session_id = selected_id or now.session_id
            way.open_screen("sessions", now.patient.patient_id)
        elif way.screen_name == "patients":
            self._patients.refresh(selected_id)

    def _on_delete_failed(self, plan: ErasurePlan, fault: Exception) -> None:
        self._refresh_after_removal(plan)
        self._context.messages.show_fault(fault)

    def _refresh_after_removal(self, plan: ErasurePlan) -> None:
        """Reload the list, unless the user is measuring or has another patient open."""
        self._sessions().sessions_changed.emit()
        patient, way, single = self._context.current.patient, self._context.navigator, plan.kind == "session"
        measures = way.underlying_screen == "live" and (single or way.is_recording())
        if measures or (patient is not None and patient.patient_id != plan.patient_id):
            return
        if single and patient is not None:
            way.open_screen("sessions", patient.patient_id)
        else:
            way.open_screen("patients")


ICON_PX, COLUMN_PX = 26, 72
MAX_PATHS_SHOWN = 3


class DeleteDialog(Dialog):
    """Confirmation of a deletion.

    Signals carry the plan: ``delete_confirmed`` only after the pseudonym was typed, never by Enter;
    ``archive_confirmed`` by the default button.
    """

    delete_confirmed = Signal(object)
    archive_confirmed = Signal(object)

    def __init__(self, host: QWidget, theme: Theme) -> None:
        super().__init__(host, theme, 760)
        self.card.set_colors("surface", "bad", 2.0)
        self._plan: ErasurePlan | None = None
        self.title = Text(theme, "", 28, SEMIBOLD, wrap=True)
        self.subject_text = Text(theme, "", 14, REGULAR, "text2", wrap=True)
        self.deleted_text, self.kept_text, self.consequence_text = (
            Text(theme, "", 14, REGULAR, "text2", wrap=True) for _ in range(3)
        )
        self.confirm_label = Text(theme, "", 14, wrap=True)
        self.confirm_field = QLineEdit()
        self.confirm_field.setMinimumWidth(theme.px(200))
        self.confirm_field.textChanged.connect(self._check)
        self.delete_button = Button(theme, self.tr("Delete permanently"), "plain", height_px=52)
        self.delete_button.on_enter = "nothing"  # what cannot be undone takes the mouse or the space bar
        self.cancel_button = Button(theme, self.tr("Cancel"), "plain", hint=self.tr("Esc"), height_px=52)
        self.archive_button = Button(theme, self.tr("Archive instead"), "primary")
        self.delete_button.clicked.connect(lambda: self._answer(self.delete_confirmed))
        self.cancel_button.clicked.connect(self.close_dialog)
        self.archive_button.clicked.connect(lambda: self._answer(self.archive_confirmed))
        self.set_default(self.archive_button)
        self._build_layout(theme)

    def _build_layout(self, theme: Theme) -> None:
        body = self.card.body
        body.setSpacing(10)
        self._sections = ScrolledColumn()
        column = column_layout(
            _make_section(_make_sign(theme, "trash-2", "bad"), self.title, self.subject_text),
            gap=10,
            margins=(0, 0, 0, 0),
            parent=self._sections,
        )
        for sign, title, words in (
            (_make_sign(theme, "bad"), self.tr("Deleted"), self.deleted_text),
            (_make_sign(theme, "good"), self.tr("Not deleted"), self.kept_text),
            (_make_sign(theme, "warn"), self.tr("Cannot be undone"), self.consequence_text),
        ):
            fill(column, Separator(theme), _make_section(sign, Text(theme, title, 20, SEMIBOLD), words))
        column.addWidget(Separator(theme))
        milder = Card(theme, 0, "soft", "soft")
        offered = Text(
            theme, self.tr("Archiving removes it from all lists and results. Everything can be restored."), wrap=True
        )
        milder.body.setContentsMargins(0, 12, 12, 12)
        milder.body.addLayout(
            _make_section(_make_sign(theme, "archive"), Text(theme, self.tr("Archive instead"), 16, SEMIBOLD), offered)
        )
        column.addWidget(milder)
        self._scroll = ScrollArea(self._sections)  # large text on a small screen: the answer stays to be seen
        fill(body, self._scroll, row_layout((self.confirm_label, 1), (self.confirm_field, 1), gap=16), 8)
        body.addLayout(row_layout(self.delete_button, STRETCH, self.cancel_button, self.archive_button))

    def show_plan(self, plan: ErasurePlan, retention_years: int, last_backup: datetime | None, today: date) -> None:
        """Show what would be deleted.

        ``retention_years`` is 0 if not set.
        """
        self._plan = plan
        single = plan.kind == "session"
        self.title.setText(
            self.tr("Delete this session permanently?") if single else self.tr("Delete this patient permanently?")
        )
        self.subject_text.setText(_describe_target(plan))
        self.deleted_text.setText(self._describe_deleted(plan))
        self.kept_text.setText(self._describe_kept(plan, last_backup))
        self.consequence_text.setText(self._describe_consequences(plan, retention_years, last_backup, today))
        self.confirm_label.setText(self.tr("To delete, type “{name}” here").format(name=plan.pseudonym))
        self.confirm_field.clear()
        self.confirm_field.setAccessibleName(self.confirm_label.text())
        self._check()
        self.open(self.confirm_field)
        self._fit()

    def _fit(self) -> None:
        column = self._sections.layout()
        assert column is not None
        column.activate()
        wanted = column.totalHeightForWidth(self.card.width() - 48 - 12)
        room = self.height() - self._theme.px(52 + 40 + 18) - 120
        self._scroll.setFixedHeight(max(min(wanted, room), self._theme.px(160)))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        if self.isVisible():
            self._fit()

    def _describe_deleted(self, plan: ErasurePlan) -> str:
        words = self.tr("Angles, images, notes and pain scores of this session ({size} MB, files: {files}).")
        if plan.kind == "patient":
            words = self.tr(
                "The patient’s entry: real name, notes, manual measurements. All sessions ({count}): "
                "angles, images, notes ({size} MB, files: {files})."
            )
        size_mb = plan.size_bytes / 1e6
        size = format_rounded(size_mb) if size_mb >= 10 else numbers.format_fixed(size_mb, 1)
        return words.format(count=plan.recording_count, files=len(plan.files), size=size)

    def _describe_kept(self, plan: ErasurePlan, last_backup: datetime | None) -> str:
        parts = [self.tr("The patient’s other sessions.")] if plan.kind == "session" else []
        if last_backup is not None:
            day = numbers.format_date(last_backup)
            parts.append(self.tr("Backups up to {day} and copies elsewhere.").format(day=day))
        else:
            parts.append(self.tr("Copies elsewhere."))
        for words, found in (
            (self.tr("Delete reports and exports saved elsewhere yourself ({n}): {path}."), plan.output_files),
            (self.tr("Check these files outside the patient’s folder yourself ({n}): {path}."), plan.unassigned_files),
        ):
            if found:
                paths = ", ".join(map(str, found[:MAX_PATHS_SHOWN])) + (", …" if len(found) > MAX_PATHS_SHOWN else "")
                parts.append(words.format(n=len(found), path=paths))
        parts.append(self.tr("The log records the deletion, without a name."))
        return " ".join(parts)

    def _describe_consequences(self, plan: ErasurePlan, years: int, last_backup: datetime | None, today: date) -> str:
        words = self.tr("Deleted data cannot be restored.")
        if last_backup is not None:
            words = self.tr("Deleted data cannot be restored, not even from a backup.")
        until = retention_end(max(one.recorded for one in plan.results), years) if plan.results else None
        if until is None or until < today:
            return words
        early = self.tr(
            "The retention period set in Settings ({years} years) ends on {day}. You would delete before that date."
        )
        return f"{words} {early.format(day=numbers.format_date(until), years=years)}"

    def _check(self) -> None:
        typed = " ".join(self.confirm_field.text().split())
        wanted = self._plan.pseudonym if self._plan is not None else ""
        self.delete_button.setEnabled(bool(typed) and typed.casefold() == wanted.casefold())

    def _answer(self, confirmed: SignalInstance) -> None:
        self.close_dialog()
        confirmed.emit(self._plan)


def _describe_target(plan: ErasurePlan) -> str:
    if plan.kind == "patient":
        return plan.pseudonym
    one = plan.results[0]
    what = f"{terms.exercise_name(one.exercise)}, {to_mid_sentence(terms.hand_name(one.hand))}"
    return " · ".join((plan.pseudonym, numbers.format_date_time(one.recorded), what))


def _make_sign(theme: Theme, name: str, token: str = "accent") -> Icon:
    """Return an icon in a column of its own."""
    return Icon(theme, name, ICON_PX, (COLUMN_PX, ICON_PX + 4), token, alignment=0.33)


def _make_section(sign: QWidget, title: QWidget, words: QWidget) -> QHBoxLayout:
    texts = column_layout(title, words, gap=4)
    return row_layout((sign, 0, Qt.AlignmentFlag.AlignTop), (texts, 1), gap=0)

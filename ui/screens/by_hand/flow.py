"""Controller of values measured by hand."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace

from PySide6.QtCore import Qt

from carpus.core.measures.manual_measurements import ManualValue, find_latest_entries
from carpus.core.model.fault_text import MessageText
from carpus.core.model.types import Side
from carpus.ui.screens.by_hand.screen import ManualMeasurementsScreen, ManualRecord
from carpus.ui.shell.flow import Flow, ScreenContext
from carpus.ui.shell.messages import Answer


class ManualMeasurementsFlow(Flow):
    """Controller of the form; keeps unsaved values per patient."""

    screen_name, guide_page, parent_tab = "by_hand", "figures", "progress"
    screen: ManualMeasurementsScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, ManualMeasurementsScreen(context.theme, context.today))
        self._unsaved_values: dict[str, Sequence[ManualValue]] = {}
        self._is_saving = False
        self.screen.save_requested.connect(self._confirm_save)
        self.screen.close_button.clicked.connect(self.navigate_back)

    def open(self) -> None:
        """Show the open patient's form for today, with unsaved values of before."""
        patient, screen = self.context.current.patient, self.screen
        if patient is not None and screen.record.patient_id == patient.patient_id and screen.has_unsaved:
            self.context.navigator.switch_screen("by_hand")
            return
        self._load(is_refresh=False)

    def navigate_back(self) -> None:
        """Go back to the progress; ask first if values are not saved."""
        if not self.screen.has_unsaved:
            self._return_to_progress()
            return
        self._confirm_leave(self._discard)

    def prompt_before_close(self) -> bool:
        """Ask before unsaved values are lost with the window."""
        if self.context.navigator.underlying_screen != self.screen_name or not self.screen.has_unsaved:
            return False
        self._confirm_leave(self.context.window.close_without_prompt)
        return True

    def _confirm_leave(self, on_discard: Callable[[], None]) -> None:
        self.context.messages.show_question(
            MessageText(
                self.tr("Leave without saving?"),
                self.tr("Some values have not been saved."),
                self.tr("Save or discard the values."),
            ),
            (
                Answer(self.tr("Discard"), on_discard, "D", is_risky=True),
                Answer(self.tr("Back to the form"), lambda: None),
            ),
            icon="file-text",
        )

    def _return_to_progress(self) -> None:
        patient = self.context.current.patient
        if patient is not None:
            self.context.navigator.open_screen("progress", patient.patient_id)
        else:
            self.return_to_patients()

    def _discard(self) -> None:
        self.screen.show_record(self.screen.record)
        self._return_to_progress()

    def _load(self, *, is_refresh: bool) -> None:
        patient, library = self.context.current.patient, self.context.library
        if patient is None:
            return
        patient_id, initials = patient.patient_id, self.context.report_settings.therapist
        side: Side = "left" if patient.side == "left" else "right"

        def read() -> ManualRecord:
            figures = sorted(library.history(patient_id), key=lambda one: one.when)
            return ManualRecord(
                patient_id, side, tuple(library.manual_measurements(patient_id)), tuple(figures), initials, patient
            )

        def on_loaded(record: ManualRecord) -> None:
            self._is_saving = False
            if self.context.current.patient is None or self.context.current.patient.patient_id != patient_id:
                return
            self._stash_unsaved(patient_id)
            typed_since = self._list_typed_since(record) if is_refresh else []
            self.screen.show_record(record, is_refresh=is_refresh)
            if typed_since:
                self.screen.restore_unsaved(typed_since)
            if not is_refresh:
                self.screen.restore_unsaved(self._unsaved_values.pop(patient_id, ()))
                self.context.navigator.switch_screen("by_hand")
                self.screen.initial_focus().setFocus(Qt.FocusReason.OtherFocusReason)

        self.run(read, on_loaded, self._show_failure)

    def _show_failure(self, fault: Exception) -> None:
        self._is_saving = False
        self.context.messages.show_fault(fault)

    def _list_typed_since(self, record: ManualRecord) -> list[ManualValue]:
        """Return what was typed while the values of before were being saved."""
        with suppress(ValueError):  # what cannot be kept is marked red
            kept = find_latest_entries(record.values)
            typed = [(one, kept.get((one.key, one.day))) for one in self.screen.list_unsaved()]
            return [
                one for one, last in typed if last is None or (last.trials, last.location) != (one.trials, one.location)
            ]
        return []

    def _stash_unsaved(self, patient_id: str) -> None:
        """Keep another patient's unsaved values until that form is opened again."""
        before = self.screen.record.patient_id
        with suppress(ValueError):  # what cannot be kept was marked red all the time
            if before != patient_id and (values := self.screen.list_unsaved()):
                self._unsaved_values[before] = values

    def _confirm_save(self, values: Sequence[ManualValue], doubts: Sequence[str]) -> None:
        if not values or self._is_saving:
            return
        if not doubts:
            self._save(values)
            return
        self.context.messages.show_question(
            MessageText(
                self.tr("Check the unusual values, or save them as entered"),
                "; ".join(doubts),
                self.tr("Check the values before you save them."),
            ),
            (
                Answer(self.tr("Save as entered"), lambda: self._save(values), "S", is_risky=True),
                Answer(self.tr("Back to the form"), lambda: None),
            ),
            icon="file-text",
        )

    def _save(self, values: Sequence[ManualValue]) -> None:
        patient = self.context.current.patient
        if patient is None:
            return
        patient_id, by = patient.patient_id, self.context.report_settings.therapist
        signed = [replace(one, rater=by) for one in values]
        self._is_saving = True  # the same values are not entered twice
        self.run(
            lambda: self.context.library.add_manual_measurements(patient_id, signed),
            lambda _: self._load(is_refresh=True),
            self._show_failure,
        )

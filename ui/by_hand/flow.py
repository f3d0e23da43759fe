"""The flow of values measured by hand: asked for from the progress, kept in the register."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace

from PySide6.QtCore import Qt

from carpus.core.measures.by_hand import HandValue
from carpus.core.types import Side
from carpus.core.words import Words
from carpus.ui.by_hand.screen import ByHandScreen, HandRecord
from carpus.ui.flow import Flow, ScreenContext
from carpus.ui.messages.messages import Answer


class ByHandFlow(Flow):
    """The form for today, and what of it is not kept yet."""

    place, guide, tab = "by_hand", "figures", "progress"
    screen: ByHandScreen

    def __init__(self, context: ScreenContext) -> None:
        super().__init__(context, ByHandScreen(context.theme, context.today))
        self._aside: dict[str, Sequence[HandValue]] = {}
        self.screen.save.connect(self._ask_to_save)
        self.screen.cancel.clicked.connect(self.up)

    def show(self) -> None:
        """The form of the patient who is open, for today; with what was written and not kept, if it was left so."""
        patient, screen = self.context.now.patient, self.screen
        if patient is not None and screen.record.patient_id == patient.patient_id and screen.has_unsaved:
            self.context.way.go("by_hand")
            return
        self._read(again=False)

    def up(self) -> None:
        """Back to the progress; what is written and not saved is asked about first."""
        if not self.screen.has_unsaved:
            self._back()
            return
        self._ask_to_leave(self._let_go)

    def asks_before_closing(self) -> bool:
        """The form is open, and what is written in it would be lost with the window."""
        if self.context.way.behind != self.place or not self.screen.has_unsaved:
            return False
        self._ask_to_leave(self.context.shell.close_surely)
        return True

    def _ask_to_leave(self, let_go: Callable[[], None]) -> None:
        self.context.messages.ask(
            Words(
                self.tr("Leave without saving?"),
                self.tr("Values are written that are not kept yet."),
                self.tr("Save them, or let them go."),
            ),
            (
                Answer(self.tr("Let them go"), let_go, "L", risky=True),
                Answer(self.tr("Back to the form"), lambda: None),
            ),
            icon="file-text",
        )

    def _back(self) -> None:
        patient = self.context.now.patient
        if patient is not None:
            self.context.way.show("progress", patient.patient_id)
        else:
            self.to_patient()

    def _let_go(self) -> None:
        self.screen.show_record(self.screen.record)
        self._back()

    def _read(self, *, again: bool) -> None:
        patient, library = self.context.now.patient, self.context.library
        if patient is None:
            return
        patient_id, initials = patient.patient_id, self.context.report.therapist
        side: Side = "left" if patient.side == "left" else "right"

        def read() -> HandRecord:
            figures = sorted(library.history(patient_id), key=lambda one: one.when)
            return HandRecord(patient_id, side, tuple(library.by_hand(patient_id)), tuple(figures), initials)

        def shown(record: HandRecord) -> None:
            if self.context.now.patient is None or self.context.now.patient.patient_id != patient_id:
                return
            self._lay_aside(patient_id)
            self.screen.show_record(record, again=again)
            if not again:
                self.screen.write_again(self._aside.pop(patient_id, ()))
                self.context.way.go("by_hand")
                self.screen.first().setFocus(Qt.FocusReason.OtherFocusReason)

        self.run(read, shown)

    def _lay_aside(self, patient_id: str) -> None:
        """What is written of another patient and not kept waits until that patient's form is opened again."""
        before = self.screen.record.patient_id
        with suppress(ValueError):  # what cannot be kept was marked red all the time
            if before != patient_id and (values := self.screen.unsaved()):
                self._aside[before] = values

    def _ask_to_save(self, values: Sequence[HandValue], doubts: Sequence[str]) -> None:
        if not values:
            return
        if not doubts:
            self._save(values)
            return
        self.context.messages.ask(
            Words(
                self.tr("Unusual: check, or keep it"),
                "; ".join(doubts),
                self.tr("Look at the numbers once more before they are kept."),
            ),
            (
                Answer(self.tr("Keep as written"), lambda: self._save(values), "K", risky=True),
                Answer(self.tr("Back to the form"), lambda: None),
            ),
            icon="file-text",
        )

    def _save(self, values: Sequence[HandValue]) -> None:
        patient = self.context.now.patient
        if patient is None:
            return
        patient_id, by = patient.patient_id, self.context.report.therapist
        signed = [replace(one, by=by) for one in values]
        self.run(lambda: self.context.library.enter_by_hand(patient_id, signed), lambda _: self._read(again=True))

"""The flow of values measured by hand: asked for from the progress, kept in the register."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace

from PySide6.QtCore import QObject, Qt

from carpus.app.desktop.now_open import NowOpen
from carpus.app.desktop.ways import Tell, Way
from carpus.core.by_hand.values import HandValue
from carpus.core.library.library import Library
from carpus.core.types import Side
from carpus.core.words import Words
from carpus.ui.background import Background
from carpus.ui.by_hand.screen import ByHandScreen, HandRecord
from carpus.ui.messages.stop_card import Answer


class ByHand(QObject):
    """``back`` leads to where the form was asked for."""

    def __init__(
        self,
        parent: QObject,
        screen: ByHandScreen,
        way: Way,
        tell: Tell,
        now: NowOpen,
        library: Library,
        background: Background,
        *,
        initials: Callable[[], str],
        back: Callable[[], None],
    ) -> None:
        super().__init__(parent)
        self._screen, self._way, self._tell, self._now, self._library = screen, way, tell, now, library
        self._background, self._initials, self._back = background, initials, back
        self._aside: dict[str, Sequence[HandValue]] = {}
        screen.save.connect(self._ask_to_save)
        screen.done.connect(self.leave)

    def show(self) -> None:
        """The form of the patient who is open, for today; with what was written and not kept, if it was left so."""
        patient, screen = self._now.patient, self._screen
        if patient is not None and screen.record.patient_id == patient.patient_id and screen.has_unsaved:
            self._way.go("by_hand")
            return
        self._read(again=False)

    def leave(self) -> None:
        """Back to the progress; what is written and not saved is asked about first."""
        if not self._screen.has_unsaved:
            self._back()
            return
        self._tell.ask(
            Words(
                self.tr("Leave without saving?"),
                self.tr("Values are written that are not kept yet."),
                self.tr("Save them, or let them go."),
            ),
            (
                Answer(self.tr("Let them go"), self._let_go, "L", risky=True),
                Answer(self.tr("Back to the form"), lambda: None),
            ),
            icon="file-text",
        )

    def _let_go(self) -> None:
        self._screen.show_record(self._screen.record)
        self._back()

    def _read(self, *, again: bool) -> None:
        patient, library = self._now.patient, self._library
        if patient is None:
            return
        patient_id, initials = patient.patient_id, self._initials()
        side: Side = "left" if patient.side == "left" else "right"

        def read() -> HandRecord:
            figures = sorted(library.history(patient_id), key=lambda one: one.when)
            return HandRecord(patient_id, side, tuple(library.by_hand(patient_id)), tuple(figures), initials)

        def shown(record: HandRecord) -> None:
            if self._now.patient is None or self._now.patient.patient_id != patient_id:
                return
            self._lay_aside(patient_id)
            self._screen.show_record(record, again=again)
            if not again:
                self._screen.write_again(self._aside.pop(patient_id, ()))
                self._way.go("by_hand")
                self._screen.first().setFocus(Qt.FocusReason.OtherFocusReason)

        self._background.run(read, shown, self._tell.fault, self)

    def _lay_aside(self, patient_id: str) -> None:
        """What is written of another patient and not kept waits until that patient's form is opened again."""
        before = self._screen.record.patient_id
        with suppress(ValueError):  # what cannot be kept was marked red all the time
            if before != patient_id and (values := self._screen.unsaved()):
                self._aside[before] = values

    def _ask_to_save(self, values: Sequence[HandValue], doubts: Sequence[str]) -> None:
        if not values:
            return
        if not doubts:
            self._save(values)
            return
        self._tell.ask(
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
        patient = self._now.patient
        if patient is None:
            return
        patient_id, by = patient.patient_id, self._initials()
        signed = [replace(one, by=by) for one in values]
        self._background.run(
            lambda: self._library.enter_by_hand(patient_id, signed),
            lambda _: self._read(again=True),
            self._tell.fault,
            self,
        )

"""What a flow may ask of the window around it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from carpus.app.desktop.places import Place
from carpus.core.words import Words
from carpus.ui.messages.stop_card import Answer
from carpus.ui.ports import PatientRow


class Way(Protocol):
    """Where the person is, and the way to another place."""

    @property
    def place(self) -> Place: ...

    def go(self, place: Place) -> None:
        """Show a place."""
        ...

    def back(self) -> None:
        """One step back."""
        ...


class Tell(Protocol):
    """Messages and questions over the window."""

    @property
    def busy(self) -> bool: ...

    def fault(
        self, fault: Exception, answers: Sequence[Answer] = (), *, detail: str = "", safe_detail: str = ""
    ) -> None: ...

    def ask(self, question: Words, answers: Sequence[Answer], *, icon: str = "", detail: str = "") -> None: ...

    def withdraw(self, question: Words) -> None: ...


class TellOfCamera(Tell, Protocol):
    """And the card that waits for the camera."""

    def camera_lost(self, fault: Exception, answers: Sequence[Answer], detail: str, safe_detail: str) -> None: ...

    def camera_back(self) -> None: ...


class FindPatient(Protocol):
    """One row of the list of patients."""

    def __call__(self, patient_id: str) -> PatientRow: ...

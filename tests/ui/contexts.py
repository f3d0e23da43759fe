"""What a flow is tried with: a context without a window around it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

from PySide6.QtWidgets import QWidget

from carpus.core.results.report_form import ReportSettings
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.shell.current_selection import CurrentSelection, SourceChoice
from carpus.ui.shell.flow import ScreenContext
from tests.ui.fakes import NOW


class Told:
    """Messages, and a way, that take down what a person would see; ``answer`` is the number of the one given."""

    busy = False

    def __init__(self, place: str = "patients", answer: int | None = None, behind: str = "") -> None:
        self.place, self._answer, self._behind = place, answer, behind
        self.asked: list[str] = []
        self.faults: list[Exception] = []
        self.shown: list[tuple[object, ...]] = []

    @property
    def behind(self) -> str:
        return self._behind or self.place

    def put(self, flow: object) -> None:
        """Nobody looks it up."""

    def go(self, place: str) -> None:
        self.place = place

    def back(self) -> None:
        """Nobody goes anywhere."""

    def show(self, place: str, *given: object) -> None:
        self.shown.append((place, *given))

    show_behind = show

    def ask(self, question: Any, answers: Any, **_: object) -> None:
        self.asked.append(question.happened)
        if self._answer is not None:
            answers[self._answer].action()

    def fault(self, fault: Exception) -> None:
        self.faults.append(fault)


def a_context(theme: Theme, window: QWidget, told: Told, background: Background, **given: object) -> ScreenContext:
    """A context of ``told`` for way and messages; what else a flow needs is ``given`` by its name there."""
    usual = {
        "shell": window,
        "theme": theme,
        "background": background,
        "messages": told,
        "way": told,
        "now": CurrentSelection(source_choice=SourceChoice("camera")),
        "report": ReportSettings("MK"),
        "today": NOW.date,
        "version": "1.2.3",
        "is_demo": False,
        "opener": SimpleNamespace(close_source=lambda: None),
    }
    return cast("ScreenContext", SimpleNamespace(**(usual | given)))

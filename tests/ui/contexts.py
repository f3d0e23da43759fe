"""What a flow is tried with: a context without a window around it."""

from __future__ import annotations

from functools import partial
from types import SimpleNamespace
from typing import Any, cast

from PySide6.QtWidgets import QWidget

from carpus.core.results.report_form import ReportSettings
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.shell.current_selection import CurrentSelection, SourceChoice
from carpus.ui.shell.flow import ScreenContext
from tests.ui.fakes import NOW


class RecordingMessages:
    """Messages, and a way, that take down what a person would see; ``answer`` is the number of the one given."""

    is_busy = False

    def __init__(self, place: str = "patients", answer: int | None = None, behind: str = "") -> None:
        self.screen_name, self._answer, self._behind = place, answer, behind
        self.asked: list[str] = []
        self.faults: list[Exception] = []
        self.shown: list[tuple[object, ...]] = []

    @property
    def underlying_screen(self) -> str:
        return self._behind or self.screen_name

    def register(self, flow: object) -> None:
        """Nobody looks it up."""

    def switch_screen(self, screen_name: str) -> None:
        self.screen_name = screen_name

    def navigate_back(self) -> None:
        """Nobody goes anywhere."""

    def open_screen(self, screen_name: str, *given: object) -> None:
        self.shown.append((screen_name, *given))

    open_under_overlay = open_screen

    def show_question(self, question: Any, answers: Any, **_: object) -> None:
        self.asked.append(question.summary)
        if self._answer is not None:
            answers[self._answer].action()

    def show_fault(self, fault: Exception) -> None:
        self.faults.append(fault)


def make_context(
    theme: Theme, window: QWidget, messages: RecordingMessages, background: Background, **given: object
) -> ScreenContext:
    """A context of ``messages`` for way and messages; what else a flow needs is ``given`` by its name there."""
    usual = {
        "window": window,
        "theme": theme,
        "background": background,
        "messages": messages,
        "navigator": messages,
        "current": CurrentSelection(source_choice=SourceChoice("camera")),
        "report_settings": ReportSettings("MK"),
        "today": NOW.date,
        "is_demo": False,
        "opener": SimpleNamespace(close_source=lambda: None),
    }
    context = cast("ScreenContext", SimpleNamespace(**(usual | given)))
    context.run = partial(ScreenContext.run, context)  # type: ignore[method-assign]
    return context

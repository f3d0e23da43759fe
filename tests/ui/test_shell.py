"""Top bar, settings, messages, report screen, background work: what holds the journey together."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from carpus.core.model.fault_text import MessageText
from carpus.ui.kit.background import Background
from carpus.ui.kit.theme import Theme
from carpus.ui.screens.report.screen import ReportScreen
from carpus.ui.screens.settings.screen import Preferences, SettingsScreen
from carpus.ui.shell.flow import Navigator
from carpus.ui.shell.main_window import MainWindow
from carpus.ui.shell.messages import Answer, MessageDialog
from tests.ui.conftest import Show
from tests.ui.fakes import home_report

Settings = Callable[..., tuple[SettingsScreen, list[Preferences]]]
WORDS = MessageText("The camera was unplugged.", "Your data are safe.", "Plug the camera in again.")


@pytest.fixture
def shell(theme: Theme, show: Show[MainWindow]) -> MainWindow:
    return show(MainWindow(theme), active=True)


@pytest.fixture
def settings(theme: Theme, show: Show[SettingsScreen]) -> Settings:
    """The settings with some preferences, and what they tell."""

    def one(**chosen: object) -> tuple[SettingsScreen, list[Preferences]]:
        screen, told = show(SettingsScreen(theme, Preferences(**chosen))), []
        screen.changed.connect(told.append)
        return screen, told

    return one


def test_settings_that_are_not_offered_stay_when_another_is_chosen(settings: Settings) -> None:
    by_hand = {"text_scale": 1.2, "language": "fr", "data_folder": "/elsewhere"}
    screen, told = settings(**by_hand)
    screen.form["research"].click()
    assert told == [Preferences(research=True, **by_hand)]
    screen.revert_language("fr", "not now")
    screen.form["text_scale"].buttons()[2].click()
    assert told[-1] == Preferences(research=True, **by_hand | {"text_scale": 1.5})


def test_shell_new_screen_waits_behind_settings(shell: MainWindow) -> None:
    way, shown = Navigator(shell, lambda: False, lambda: False), list[str]()

    def put(place: str) -> None:
        screen = QWidget()
        flow = SimpleNamespace(
            screen=screen, initial_focus=lambda: screen, runs_behind_overlay=False, on_leave=lambda: None
        )
        flow.open = lambda given: (shown.append(given), way.switch_screen(place))
        way.flows[place] = flow

    for place in ("review", "correct", "settings"):
        put(place)
    way.open_screen("correct", "old")
    way.open_overlay("settings")
    way.open_under_overlay("review", "new")
    assert (way.screen_name, way.underlying_screen, shown) == ("settings", "review", ["old", "new"])
    way.navigate_back()
    assert way.screen_name == "review"
    way.open_under_overlay("correct", "once more")
    assert way.screen_name == "correct"


def test_message_gives_three_answers_and_its_buttons_act_by_key(qtbot: QtBot, theme: Theme, shell: MainWindow) -> None:
    done: list[str] = []
    card = MessageDialog(shell.screen_stack, theme)
    card.show_words(
        WORDS,
        [Answer("Check", lambda: done.append("check"), "C"), Answer("Stop", lambda: done.append("stop"), "Space")],
    )
    for part in (WORDS.data_safety, WORDS.remedy):
        assert part in card.accessibleName()
    assert card.card.property("edge") == "bad"
    assert card.answers[-1][0].hasFocus()
    qtbot.keyClick(card, Qt.Key.Key_Escape)
    assert card.isVisible()
    qtbot.keyClick(card.answers[-1][0], Qt.Key.Key_C)
    assert done == ["check"]
    assert not card.isVisible()
    card.show_words(WORDS, [Answer("Stop", lambda: done.append("stop"), "Space")])
    qtbot.keyClick(card.answers[-1][0], Qt.Key.Key_Space)
    assert done == ["check", "stop"]
    card.show_words(WORDS, [Answer("Continue", lambda: None)], is_alarm=False)
    assert card.card.property("edge") == "line"  # good news and questions look like no alarm
    card.close_dialog()
    answers = [
        Answer("End it", lambda: done.append("end"), is_risky=True),
        Answer("Continue", lambda: done.append("on")),
    ]
    card.show_words(WORDS, answers)
    qtbot.keyClick(card.answers[-1][0], Qt.Key.Key_Escape)
    assert done[-1] == "on", "Esc gives the answer that loses nothing"
    assert not card.isVisible()


def test_shell_research_options_are_hidden_by_default(settings: Settings) -> None:
    screen, told = settings(stream=True, angle_order="isb")
    screen.show_page("research")
    folded = (screen.form["angle_order"], screen.form["stream"])
    assert not any(widget.isVisible() for widget in folded)
    screen.form["research"].click()
    assert all(widget.isVisible() for widget in folded)
    assert (told[-1].research, told[-1].stream, told[-1].angle_order) == (True, True, "isb"), "no value changes by it"


def test_report_is_saved_in_background_and_replaces_only_when_asked(
    qtbot: QtBot, theme: Theme, show: Show[ReportScreen], tmp_path: Path
) -> None:
    screen = show(ReportScreen(theme, Background()))
    screen.show_report(home_report(), str(tmp_path))
    assert not screen.preview.grab().isNull()
    with qtbot.waitSignal(screen.saved) as saved:
        screen.save(str(tmp_path / "one"))
    path = Path(saved.args[0])
    assert path.name == "one.pdf"
    assert screen.focusWidget() is screen.save_button, "Enter after saving does not print"
    assert path.read_bytes().startswith(b"%PDF")
    with qtbot.waitSignal(screen.fault_raised):
        screen.save(str(path))
    with qtbot.waitSignal(screen.saved):
        screen.save(str(path), may_replace=True)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["one.pdf"]

"""Top bar, settings, messages, report screen, background work: what holds the journey together."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest
from PySide6.QtCore import QPoint, QRect, Qt, QThread
from PySide6.QtGui import QFontInfo, QFontMetricsF, QKeySequence
from PySide6.QtWidgets import QApplication, QPushButton, QScrollArea, QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from carpus.core.model.fault_text import MessageText
from carpus.core.platform.version import __version__
from carpus.ui.kit.background import Background
from carpus.ui.kit.button import Button
from carpus.ui.kit.field import ChoiceRow
from carpus.ui.kit.fonts import DISPLAY_FAMILY, TEXT_FAMILY, font, load_fonts
from carpus.ui.kit.keys import KEYS, action_words
from carpus.ui.kit.layouts import column_layout
from carpus.ui.kit.text import Text, heading
from carpus.ui.kit.theme import Theme
from carpus.ui.report.builders import build_session_report
from carpus.ui.screens.report.screen import ReportScreen
from carpus.ui.screens.settings.screen import SettingsScreen
from carpus.ui.shell.flow import Navigator
from carpus.ui.shell.main_window import FocusRing, MainWindow
from carpus.ui.shell.messages import Answer, MessageDialog
from carpus.ui.shell.view_models import Preferences
from tests.ui.conftest import Show
from tests.ui.fakes import FakeSessions

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
    by_hand = {"text_scale": 1.2, "language": "fr", "therapist": "Initials of many"}
    screen, told = settings(**by_hand)
    screen.form["research"].click()
    assert told == [Preferences(research=True, **by_hand)]
    screen.revert_language("fr", "not now")
    screen.form["text_scale"].buttons()[2].click()
    assert told[-1] == Preferences(research=True, **by_hand | {"text_scale": 1.5})


def test_language_that_was_refused_when_chosen_again_is_told_again(settings: Settings) -> None:
    screen, told = settings(language="de")
    italian = screen.form["language"].buttons()[2]
    italian.click()
    screen.revert_language("de", "a session is recorded")
    italian.click()
    assert [one.language for one in told] == ["it", "it"]


def test_bundled_face_is_used_and_its_values_are_tabular(qapp: QApplication) -> None:
    assert {TEXT_FAMILY, DISPLAY_FAMILY} <= set(load_fonts())
    assert QFontInfo(font(14)).family().startswith("Carpus Inter")
    for size in (14, 44, 128):
        metrics = QFontMetricsF(font(size, 600))
        widths = [metrics.horizontalAdvance(digit) for digit in "0123456789"]
        assert max(widths) - min(widths) < 0.003 * size
        assert metrics.horizontalAdvance("1111") == pytest.approx(metrics.horizontalAdvance("0408"), abs=0.01 * size)


def test_way_through_session_recording_and_keys_of_all_screens(qtbot: QtBot, shell: MainWindow) -> None:
    bar = shell.top_bar
    bar.show_steps(["Exercise", "Camera", "Markers", "Measure"], 2)
    assert [button.isEnabled() for button in bar.navigation_buttons()] == [True, True, False, False], (
        "only what is done"
    )
    with qtbot.waitSignal(bar.step_selected) as step:
        bar.navigation_buttons()[1].click()
    assert step.args == [1]
    bar.show_tabs(["Session", "Review", "Progress", "Report"], 1)
    assert bar.navigation_buttons()[1].accessibleName() == "Review, you are here"
    with qtbot.waitSignal(bar.tab_selected) as tab:
        bar.navigation_buttons()[3].click()
    assert tab.args == [3]
    for state, said in (("recording", "Recording 01:24"), ("paused", "Paused at 01:24"), ("off", "")):
        bar.recording_pill.show_state(state, 84.2)
        assert (bar.recording_pill.accessibleName(), bar.recording_pill.isVisible()) == (said, state != "off")
    shell.bind_keys(["help"])
    with qtbot.waitSignal(shell.key_pressed) as told:
        qtbot.keyClick(shell, Qt.Key.Key_F1)
    assert told.args == ["help"]


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


def test_focus_ring_follows_keyboard(qtbot: QtBot, shell: MainWindow) -> None:
    host = QWidget()
    button = QPushButton("x", host)
    button.setGeometry(100, 50, 80, 40)
    shell.show_screen(host, button)
    qtbot.waitUntil(shell.focus_ring.isVisible)
    assert shell.focus_ring.geometry().contains(button.geometry().translated(host.mapTo(shell, host.rect().topLeft())))
    place = shell.focus_ring.geometry()
    button.hide()
    assert not shell.focus_ring.isVisible() or shell.focus_ring.geometry() != place


def test_change_of_theme_and_scale_reaches_everything(
    qapp: QApplication, qtbot: QtBot, theme: Theme, shell: MainWindow
) -> None:
    label = Text(theme, "x", 14, token="text2")
    qtbot.addWidget(label)
    light, size = label.palette().windowText().color(), label.font().pixelSize()
    theme.choose("dark", 1.5)
    assert label.palette().windowText().color() == theme.color("text2") != light
    assert label.font().pixelSize() == round(1.5 * size)
    assert theme.tokens.canvas in qapp.styleSheet(), "nor are surfaces left behind"


def test_title_has_room_for_dots_of_its_capitals(qtbot: QtBot, theme: Theme) -> None:
    label = heading(theme, "Which exercise?")
    qtbot.addWidget(label)
    plain_px = label.sizeHint().height()
    label.setText("Welche Übung?")
    metrics = QFontMetricsF(label.font())
    above_px = label.contentsMargins().top() + metrics.ascent()
    assert above_px >= -metrics.tightBoundingRect(label.text()).top()
    assert label.sizeHint().height() - label.contentsMargins().top() == plain_px
    label.setText("Which exercise?")
    assert label.sizeHint().height() == plain_px


def test_message_gives_three_answers_and_its_buttons_act_by_key(qtbot: QtBot, theme: Theme, shell: MainWindow) -> None:
    done: list[str] = []
    card = MessageDialog(shell.screen_stack, theme)
    card.show_words(
        WORDS,
        [Answer("Check", lambda: done.append("check"), "C"), Answer("Stop", lambda: done.append("stop"), "Space")],
    )
    for part in (WORDS.data_safety, WORDS.remedy):
        assert part in card.accessibleName()
    assert card.card.edge == "bad"
    assert card.answer_buttons[-1].hasFocus()
    qtbot.keyClick(card, Qt.Key.Key_Escape)
    assert card.isVisible()
    qtbot.keyClick(card.answer_buttons[-1], Qt.Key.Key_C)
    assert done == ["check"]
    assert not card.isVisible()
    card.show_words(WORDS, [Answer("Stop", lambda: done.append("stop"), "Space")])
    qtbot.keyClick(card.answer_buttons[-1], Qt.Key.Key_Space)
    assert done == ["check", "stop"]
    card.show_words(WORDS, [Answer("Continue", lambda: None)], is_alarm=False)
    assert card.card.edge == "line"  # good news and questions look like no alarm
    card.close_dialog()
    answers = [
        Answer("End it", lambda: done.append("end"), is_risky=True),
        Answer("Continue", lambda: done.append("on")),
    ]
    card.show_words(WORDS, answers)
    qtbot.keyClick(card.answer_buttons[-1], Qt.Key.Key_Escape)
    assert done[-1] == "on", "Esc gives the answer that loses nothing"
    assert not card.isVisible()


def test_tab_leads_to_what_is_chosen_and_arrows_choose_another(qtbot: QtBot, theme: Theme, shell: MainWindow) -> None:
    host = QWidget(shell.screen_stack)
    before, choices = Button(theme, "Before"), ChoiceRow(theme, [(one, one) for one in "abc"], "c")
    column_layout(before, choices, parent=host)
    host.show()
    told: list[object] = []
    choices.chosen.connect(told.append)
    before.setFocus()
    qtbot.keyClick(before, Qt.Key.Key_Tab)
    assert choices.buttons()[2].hasFocus()
    qtbot.keyClick(choices.buttons()[2], Qt.Key.Key_Left)
    assert (choices.value(), told) == ("b", ["b"])
    choices.choose(None)
    before.setFocus()
    qtbot.keyClick(before, Qt.Key.Key_Tab)
    assert choices.buttons()[0].hasFocus()
    assert choices.value() is None


def test_settings_act_at_once_and_tell_what_was_chosen(settings: Settings) -> None:
    screen, told = settings(theme="light", data_folder="/data")
    screen.form["theme"].buttons()[1].click()
    screen.form["text_scale"].buttons()[2].click()
    screen.form["therapist"].setText("M. R.")
    screen.form["therapist"].editingFinished.emit()
    now = told[-1]
    assert (now.theme, now.text_scale, now.therapist, now.data_folder) == ("dark", 1.5, "M. R.", "/data")


def test_shell_research_options_are_hidden_by_default(settings: Settings) -> None:
    screen, told = settings(stream=True, angle_order="isb")
    screen.show_page("research")
    folded = (screen.form["angle_order"], screen.form["stream"])
    assert not any(widget.isVisible() for widget in folded)
    screen.form["research"].click()
    assert all(widget.isVisible() for widget in folded)
    assert (told[-1].research, told[-1].stream, told[-1].angle_order) == (True, True, "isb"), "no value changes by it"


def test_about_tells_what_lies_in_the_clinics_folder(settings: Settings) -> None:
    screen, _ = settings()
    assert "never checks" in screen.update_text.text()
    told = []
    for newest in ("99.10.0", __version__, "", None):
        screen.show_available_version("/srv/apt", newest)
        told.append(screen.update_text.text())
    assert "99.10.0 is available" in told[0]
    assert told[1] == told[2]
    assert "no newer version" in told[1]
    assert "cannot be read" in told[3]


def test_shell_keys_have_texts() -> None:
    for name, key in KEYS.items():
        assert action_words(name)
        assert QKeySequence(key).count() == 1


def test_report_is_saved_in_background_and_replaces_only_when_asked(
    qtbot: QtBot, theme: Theme, show: Show[ReportScreen], tmp_path: Path
) -> None:
    screen = show(ReportScreen(theme, Background()))
    screen.show_report(build_session_report(FakeSessions().session("session-7")), str(tmp_path))
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


def test_background_work_answers_in_the_window_s_thread(qtbot: QtBot) -> None:
    background = Background()
    window, seen = QThread.currentThread(), []
    worker: list[int] = []

    def work() -> int:
        worker.append(threading.get_ident())
        return 7

    background.run(work, lambda value: seen.append((value, QThread.currentThread() is window)), seen.append)
    background.run(lambda: 1 / 0, seen.append, lambda fault: seen.append(type(fault)))
    qtbot.waitUntil(lambda: len(seen) == 2)
    assert seen == [(7, True), ZeroDivisionError]
    assert worker[0] != threading.get_ident()
    assert not background.is_busy


# --- the mark of the keyboard, also when what holds its control moves ------------------------------------
@pytest.fixture
def parts(qtbot: QtBot, theme: Theme) -> tuple[QWidget, QScrollArea, list[QPushButton], FocusRing]:
    window = QWidget()
    qtbot.addWidget(window)
    window.resize(300, 200)
    inside = QWidget()
    column = QVBoxLayout(inside)
    buttons = [QPushButton(str(number)) for number in range(20)]
    for button in buttons:
        column.addWidget(button)
    area = QScrollArea()
    area.setWidgetResizable(True)
    area.setWidget(inside)
    QVBoxLayout(window).addWidget(area)
    ring = FocusRing(window)
    with qtbot.waitExposed(window):
        window.show()
    ring._follow_focus(None, buttons[2])  # without a window manager nothing has the keyboard
    return window, area, buttons, ring


def test_ring_follows_what_is_scrolled_goes_with_it_and_comes_back(
    parts: tuple[QWidget, QScrollArea, list[QPushButton], FocusRing],
) -> None:
    window, area, buttons, ring = parts
    bar, before = area.verticalScrollBar(), ring.geometry()

    def around() -> QRect:
        return QRect(buttons[2].mapTo(window, QPoint(0, 0)), buttons[2].size())

    assert before.contains(around())
    bar.setValue(15)
    assert ring.geometry() == before.translated(0, -15)
    assert ring.geometry().contains(around())
    bar.setValue(bar.maximum())
    assert not ring.isVisible()
    bar.setValue(0)
    assert ring.isVisible()
    assert ring.mask().isEmpty()

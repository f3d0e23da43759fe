"""How the window starts when its data folder is in use or cannot be used at all."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication, QFileDialog
from pytestqt.qtbot import QtBot

from carpus.app import compose
from carpus.app.commands import desktop
from carpus.app.desktop import folder_window, log, window
from carpus.app.desktop.folder_window import FolderWindow
from carpus.app.desktop.single_instance import SingleInstance
from carpus.app.settings import load_settings, settings_folder
from carpus.core.model.errors import CarpusFault, DataFolderChanged
from carpus.core.model.fault_text import MessageText
from carpus.ui.kit import language
from carpus.ui.kit.text import Text
from carpus.ui.kit.theme import Theme

ROOT = Path(__file__).parents[2]
CALL = """
import sys
from pathlib import Path
from carpus.app.desktop.single_instance import SingleInstance

instance = SingleInstance(Path(sys.argv[1]))
print(instance.acquire(), instance.notify_running_instance(Path(sys.argv[2]) if sys.argv[2:] else None))
"""


@pytest.mark.parametrize("handed", [(), ("/tmp/Grüße in einem/langen Ordner/сессия.h5",)], ids=["alone", "a file"])
def test_second_carpus_does_not_get_folder_and_calls_first(
    qtbot: QtBot, tmp_path: Path, handed: tuple[str, ...]
) -> None:
    first = SingleInstance(tmp_path)
    assert first.acquire()
    called: list[Path | None] = []
    first.listen(called.append)
    command = (sys.executable, "-c", CALL, str(tmp_path), *handed)
    second = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True)
    qtbot.waitUntil(lambda: bool(called), timeout=30_000)
    assert called == [Path(*handed) if handed else None]
    assert second.communicate(timeout=30)[0].split() == ["False", "True"]
    first.release()
    third = SingleInstance(tmp_path)
    assert third.acquire()
    third.release()


def test_second_data_folder_starts_second_instance(tmp_path: Path) -> None:
    folders = [tmp_path / name for name in "ab"]
    for folder in folders:
        folder.mkdir()
    both = [SingleInstance(folder) for folder in folders]
    assert all(one.acquire() for one in both)
    assert not both[0].notify_running_instance(), "nobody listens"
    for one in both:
        one.release()


@pytest.mark.parametrize("answer", ["close", "choose", "think again"])
def test_folder_that_cannot_be_used_is_reported_in_window(
    qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, answer: str
) -> None:
    asking = FolderWindow(Theme(), MessageText("It cannot be written.", "All is safe.", "Choose another."), tmp_path)
    named = ["", str(tmp_path)] if answer == "think again" else [str(tmp_path)]
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: named.pop(0))
    presses = {"close": [0], "choose": [1], "think again": [1, 1]}[answer]
    timer = QTimer(asking.shell)

    def press() -> None:
        if presses and asking.card.isVisible():
            asking.card.answer_buttons[presses.pop(0)].click()

    timer.timeout.connect(press)
    timer.start(20)
    assert asking.run() == (None if answer == "close" else tmp_path)
    assert "cannot be written" in asking.card.happened.text()


@pytest.fixture
def quiet(qapp: QApplication, monkeypatch: pytest.MonkeyPatch) -> None:
    """A window with a display, which takes no signals and changes no language of this process."""
    monkeypatch.setattr(desktop, "has_display", lambda: True)
    monkeypatch.setattr(log, "start_log", lambda: None)
    monkeypatch.setattr(log, "show_uncaught_errors", lambda *_: None)
    monkeypatch.setattr(window, "close_on_signals", lambda *_: None)


@pytest.mark.usefixtures("quiet")
def test_window_opens_on_folder_that_was_chosen_instead(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    blocked, good = tmp_path / "blocked", tmp_path / "good"
    blocked.write_text("a file where the folder should be")
    monkeypatch.setenv("CARPUS_DATA", str(blocked))
    monkeypatch.setattr(QApplication, "exec", lambda *_: 0)
    asked: list[str] = []
    monkeypatch.setattr(
        folder_window, "choose_data_folder", lambda *given: asked.append(type(given[-1]).__name__) or good
    )
    assert desktop.open_window(None, is_demo=False) == 0
    assert asked == ["OutputNotWritable"]
    assert "blocked" in capsys.readouterr().err
    assert (good / "records.sqlite3").exists()
    assert load_settings().data_folder == good, "also from the next start on"


@pytest.mark.usefixtures("quiet")
@pytest.mark.parametrize("is_demo", [False, True])
def test_folder_named_for_one_start_is_reported_on_first_screen(
    is_demo: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(QApplication, "exec", lambda *_: 0)
    told: list[CarpusFault] = []
    composed = compose.compose
    monkeypatch.setattr(
        compose, "compose", lambda *given, **named: told.extend(named["startup_faults"]) or composed(*given, **named)
    )
    assert desktop.open_window(tmp_path / "named", is_demo=is_demo) == 0
    assert not told, "there was no folder before"
    load_settings().data_folder.mkdir(parents=True)
    assert desktop.open_window(tmp_path / "named", is_demo=is_demo) == 0
    assert [(type(one), one.subject) for one in told] == [(DataFolderChanged, str(tmp_path / "named"))]
    assert not settings_folder().exists(), "nothing of it is stored"


@pytest.mark.usefixtures("quiet")
def test_start_without_choice_ends_with_message(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "blocked").write_text("")
    monkeypatch.setattr(folder_window, "choose_data_folder", lambda *_: None)
    assert desktop.open_window(tmp_path / "blocked", is_demo=False) == 1
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.usefixtures("quiet")
def test_window_that_is_closed_while_it_comes_up_ends_in_peace(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(QApplication, "exec", lambda *_: pytest.fail("a closed window waits for nobody"))
    close_early = window.Desktop.close

    def closes_at_once(self: window.Desktop, **_: bool) -> None:
        close_early(self)
        self.controller.patients.open()  # what it was about to do, on what is closed now

    monkeypatch.setattr(window.Desktop, "show", closes_at_once)
    assert desktop.open_window(tmp_path / "early", is_demo=True) == 0
    assert capsys.readouterr().err == ""


@pytest.mark.usefixtures("quiet")
def test_language_change_reopens_window_at_settings(
    qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On the same data folder, which nobody else gets meanwhile, and in the place that the person came from."""
    shown: list[tuple[str, str, bool]] = []

    def stay(_: QApplication) -> int:
        desktop = opened[-1]
        said = {text.text() for text in desktop.preferences.screen.findChildren(Text)} if shown else set[str]()
        shown.append((desktop.controller.place, desktop.preferences.settings.screen.language, "Einstellungen" in said))
        if len(shown) == 1:
            desktop.controller.navigator.open_screen("settings")
            qtbot.waitUntil(lambda: not desktop.find_language_obstacle())
            desktop.preferences.screen.form["language"].buttons()[list(language.LANGUAGES).index("de")].click()
            qtbot.waitUntil(lambda: desktop.is_closed)
        return 0

    opened: list[window.Desktop] = []
    composed = compose.compose

    def compose_one(*given: Any, **named: Any) -> window.Desktop:
        opened.append(composed(*given, **named))
        return opened[-1]

    monkeypatch.setattr(compose, "compose", compose_one)
    monkeypatch.setattr(QApplication, "exec", stay)
    monkeypatch.setenv("CARPUS_DATA", str(tmp_path / "data"))
    try:
        assert desktop.open_window(None, is_demo=False) == 0
    finally:
        language.set_window_language("en")
    assert shown == [("patients", "system", False), ("settings", "de", True)]
    assert load_settings().screen.language == "de"
    assert all(one.is_closed for one in opened)

"""How the window starts when its data folder is in use or cannot be used at all."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication, QFileDialog
from pytestqt.qtbot import QtBot

from app import compose
from app.commands import desktop
from app.desktop.alone import Alone
from app.desktop.no_folder import NoFolder
from app.settings import load_settings
from tests.journeys.conftest import let_go
from ui.ports import Words
from ui.theme import Theme

ROOT = Path(__file__).parents[2]
CALL = "import sys; from pathlib import Path; from app.desktop.alone import Alone; a = Alone(Path(sys.argv[1]));"
CALL += "print(a.take(), a.call_first())"


def test_a_second_carpus_does_not_get_the_folder_and_calls_the_first(qtbot: QtBot, tmp_path: Path) -> None:
    first = Alone(tmp_path)
    assert first.take()
    called: list[bool] = []
    first.listen(lambda: called.append(True))
    second = subprocess.Popen((sys.executable, "-c", CALL, str(tmp_path)), cwd=ROOT, stdout=subprocess.PIPE, text=True)
    qtbot.waitUntil(lambda: bool(called), timeout=30_000)
    assert second.communicate(timeout=30)[0].split() == ["False", "True"]
    first.let_go()
    third = Alone(tmp_path)
    assert third.take()
    third.let_go()


def test_another_folder_is_another_carpus(tmp_path: Path) -> None:
    folders = [tmp_path / name for name in "ab"]
    for folder in folders:
        folder.mkdir()
    both = [Alone(folder) for folder in folders]
    assert all(one.take() for one in both)
    assert not both[0].call_first(), "nobody listens"
    for one in both:
        one.let_go()


@pytest.mark.parametrize("answer", ["close", "choose", "think again"])
def test_a_folder_that_cannot_be_used_is_told_in_a_window(
    qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, answer: str
) -> None:
    window = NoFolder(Theme(), Words("It cannot be written.", "All is safe.", "Choose another."), tmp_path)
    named = ["", str(tmp_path)] if answer == "think again" else [str(tmp_path)]
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: named.pop(0))
    presses = {"close": [0], "choose": [1], "think again": [1, 1]}[answer]
    timer = QTimer(window.shell)

    def press() -> None:
        if presses and window.card.isVisible():
            window.card.answers[presses.pop(0)].click()

    timer.timeout.connect(press)
    timer.start(20)
    assert window.ask() == (None if answer == "close" else tmp_path)
    assert "cannot be written" in window.card.what.text()


def test_the_window_opens_on_the_folder_that_was_chosen_instead(
    qapp: QApplication, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    blocked, good = tmp_path / "blocked", tmp_path / "good"
    blocked.write_text("a file where the folder should be")
    monkeypatch.setenv("CARPUS_DATA", str(blocked))
    monkeypatch.setattr(desktop, "has_display", lambda: True)
    monkeypatch.setattr(compose, "write_log", lambda: None)
    monkeypatch.setattr(compose, "end_on_signals", lambda _: None)
    monkeypatch.setattr(compose, "speak_in_the_window", lambda _: None)
    monkeypatch.setattr(QApplication, "exec", lambda *_: 0)
    asked: list[str] = []

    def choose(*arguments: object) -> Path:
        asked.append(type(arguments[-1]).__name__)
        return good

    monkeypatch.setattr(compose, "ask_for_folder", choose)
    assert desktop.open_window(None, is_demo=False) == 0
    assert asked == ["OutputNotWritable"]
    assert "blocked" in capsys.readouterr().err
    assert (good / "patients.sqlite3").exists()
    assert load_settings().data_folder == good, "also from the next start on"
    let_go(qapp)


def test_nobody_chooses_and_it_ends_with_a_sentence(
    qapp: QApplication, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "blocked").write_text("")
    monkeypatch.setattr(desktop, "has_display", lambda: True)
    monkeypatch.setattr(compose, "write_log", lambda: None)
    monkeypatch.setattr(compose, "ask_for_folder", lambda *_: None)
    assert desktop.open_window(tmp_path / "blocked", is_demo=False) == 1
    assert capsys.readouterr().err.count("\n") == 1

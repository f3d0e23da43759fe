"""How the window starts, also where its folder is in use or cannot be used, or with a file handed over by the system;
what goes for all its screens."""

from __future__ import annotations

import lzma
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from carpus.app import __main__ as command_line
from carpus.app import compose
from carpus.app.commands import desktop
from carpus.app.desktop import folder_window, log, window
from carpus.app.desktop.single_instance import SingleInstance
from carpus.app.settings import load_settings
from carpus.core.model.errors import DiskFull
from carpus.core.model.phrase import LANGUAGES
from carpus.ui.kit import language
from carpus.ui.kit.dialog import Dialog
from carpus.ui.kit.text import Text
from carpus.ui.shell.messages import MessageDialog
from tests.journeys.conftest import Open

ROOT = Path(__file__).parents[2]
CALL = """
import sys
from pathlib import Path
from carpus.app.desktop.single_instance import SingleInstance

instance = SingleInstance(Path(sys.argv[1]))
print(instance.acquire(), instance.notify_running_instance(Path(sys.argv[2]) if sys.argv[2:] else None))
"""


@pytest.mark.parametrize("handed", [(), ("/tmp/Grüße in einem/langen Ordner/сессия.h5",)], ids=["alone", "a file"])
def test_second_instance_raises_the_first(qtbot: QtBot, tmp_path: Path, handed: tuple[str, ...]) -> None:
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
def test_window_closed_while_starting_ends_cleanly(
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
    """On the same data folder, which nobody else gets meanwhile, in the same place, with names hidden as before."""
    shown: list[tuple[str, str, bool, bool]] = []

    def stay(_: QApplication) -> int:
        desktop = opened[-1]
        said = {text.text() for text in desktop.preferences.screen.findChildren(Text)} if shown else set[str]()
        code, names = desktop.preferences.settings.screen.language, desktop.controller.context.names
        shown.append((desktop.controller.place, code, "Einstellungen" in said, names.is_hidden))
        if len(shown) == 1:
            names.set_hidden(True)
            desktop.controller.navigator.open_screen("settings")
            qtbot.waitUntil(lambda: not desktop.find_language_obstacle())
            german = desktop.preferences.screen.form["language"].buttons()[list(LANGUAGES).index("de")]
            with monkeypatch.context() as measuring:
                measuring.setattr(type(desktop.controller), "is_at_work", True)
                german.click()
                assert desktop.preferences.screen.form["language"].value() == "system", "it would close the window"
            german.click()
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
    assert shown == [("patients", "system", False, False), ("settings", "de", True, True)]
    assert load_settings().screen.language == "de"
    assert all(one.is_closed for one in opened)


GOLDEN = Path(__file__).parents[1] / "session" / "golden" / "v2-wrist6.h5.xz"


@pytest.fixture
def session(tmp_path: Path) -> Path:
    path = tmp_path / "Stick der Klinik" / "сессия 1.h5"
    path.parent.mkdir()
    path.write_bytes(lzma.decompress(GOLDEN.read_bytes()))
    return path


def test_opened_file_of_an_unknown_patient_is_shown_after_the_pin(
    qtbot: QtBot, open_desktop: Open, session: Path, data: Path, tmp_path: Path
) -> None:
    before = session.read_bytes()
    journey = (opened := open_desktop()).controller
    other = tmp_path / "other.h5"
    other.write_bytes(b"\x89HDF\r\n\x1a\nnothing")
    opened.on_second_instance(other)
    assert journey.place == "patients"
    assert journey.messages.is_busy, "what is no session is told"
    journey.messages.dialog.answers[-1][0].click()
    locking = opened.data_protection.locking
    locking.pin.set("4711")
    locking.lock_or_set_pin()
    assert locking.is_locked
    opened.on_second_instance(session)
    assert (journey.place, journey.current.patient) == ("patients", None)
    locking.lock_screen.pin_entered.emit("4711")
    qtbot.waitUntil(lambda: journey.review.screen.is_loaded, timeout=30_000)
    assert journey.place == "review"
    assert journey.current.patient.pseudonym == "Linden 42"
    assert journey.review.screen.card.repeat_button.isHidden(), "there is nobody to measure"
    for tab in range(4):  # every tab of the bar leads somewhere
        journey.open_tab(tab)
        assert journey.place == ("sessions", "review", "progress", "report")[tab] or tab == 3
    journey.patients.open()
    assert not list((data / "sessions").rglob("*.h5"))
    assert session.read_bytes() == before
    assert [path.name for path in session.parent.iterdir()] == [session.name]


def test_double_clicked_file_opens_like_the_command(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command_line.main(["not there.h5"]) == 1
    assert "not there.h5" in capsys.readouterr().err
    opened: list[Path] = []
    monkeypatch.setattr(desktop, "run_review", lambda arguments: opened.append(arguments.session) or 0)
    assert command_line.main(["a.h5"]) == command_line.main(["review", "a.h5"]) == 0
    assert opened == [Path("a.h5")] * 2


def test_esc_closes_any_sheet_leaves_its_screen_and_answers_no_message(qtbot: QtBot, open_desktop: Open) -> None:
    shell, journey = (opened := open_desktop()).shell, opened.controller
    shell.activateWindow()
    seen: list[str] = []

    def press_escape() -> None:
        qtbot.keyClick(shell.focusWidget() or shell, Qt.Key.Key_Escape)

    for place, screen in (
        ("patients", journey.patients.screen), ("markers", journey.markers.screen), ("live", journey.live.screen),
        ("review", journey.review.screen),
    ):  # fmt: skip
        journey.navigator.switch_screen(place)  # type: ignore[arg-type]
        for sheet in screen.findChildren(Dialog):
            if isinstance(sheet, MessageDialog):
                continue
            sheet.open()
            assert sheet.isVisible()
            press_escape()
            assert not sheet.isVisible(), type(sheet).__name__
            assert journey.place == place
            seen.append(type(sheet).__name__)
    assert set(seen) >= {"PatientForm", "StartAngleDialog", "NoteDialog", "PainDialog", "ExclusionDialog"}
    journey.navigator.switch_screen("patients")
    journey.messages.show_fault(DiskFull("x"))
    press_escape()
    assert journey.messages.dialog.isVisible()
    journey.messages.dialog.answers[-1][0].click()
    assert not journey.messages.is_busy

"""A session file handed over by the system: opened in the review, whoever's it is and wherever it lies."""

from __future__ import annotations

import lzma
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from carpus.app import __main__ as command_line
from carpus.app.commands import desktop
from tests.journeys.conftest import Open

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
    journey = (desktop := open_desktop()).controller
    other = tmp_path / "other.h5"
    other.write_bytes(b"\x89HDF\r\n\x1a\nnothing")
    desktop.on_second_instance(other)
    assert journey.place == "patients"
    assert journey.messages.is_busy, "what is no session is told"
    journey.messages.dialog.answer_buttons[-1].click()
    locking = desktop.data_protection.locking
    locking.pin.set("4711")
    locking.lock_or_set_pin()
    assert locking.is_locked
    desktop.on_second_instance(session)
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

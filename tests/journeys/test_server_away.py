"""The clinic's server stops while the window is open, and is not there when another is opened: nothing old is shown, a
patient is measured all the same, and is in the list when it is back."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from carpus.app.compose import Desktop
from carpus.app.desktop import main_controller
from carpus.app.settings import RecordingSettings, RecordsSettings, ScreenSettings, Settings
from carpus.core.records.values import Patient
from tests.journeys.conftest import Open
from tests.journeys.test_journey import click, click_discs, get_reviewed_file, wait_for_place, wait_until
from tests.records.postgres import Cluster


@pytest.fixture
def cluster() -> Iterator[Cluster]:
    made = Cluster()
    yield made
    made.end()


def measured(qtbot: QtBot, desktop: Desktop, take: Path) -> Path:
    """From the exercise to the review, of a stored recording."""
    journey = desktop.controller
    wait_for_place(qtbot, journey, "exercise")
    click(qtbot, journey.exercise.screen.primary_button)
    wait_for_place(qtbot, journey, "camera")
    journey.camera.screen.set_path(str(take))
    click(qtbot, journey.camera.screen.primary_button)
    wait_for_place(qtbot, journey, "markers")
    click_discs(qtbot, desktop, take)
    click(qtbot, journey.markers.screen.primary_button)
    wait_for_place(qtbot, journey, "live")
    click(qtbot, journey.live.screen.controls.main_button)
    return get_reviewed_file(qtbot, desktop)


def is_away(desktop: Desktop) -> bool:
    screen = desktop.controller.patients.screen
    shown = (screen.list, screen.card, screen.new_button)
    return screen._offline_view.isVisible() and not any(one.isVisible() and one.isEnabled() for one in shown)


def test_server_that_stops_hides_list_and_measuring_continues(
    qtbot: QtBot, open_desktop: Open, take: Path, cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(main_controller, "CHECK_EVERY_MS", 200)
    settings = Settings(
        screen=ScreenSettings("light"), recording=RecordingSettings(keep_pictures=False),
        records=RecordsSettings(url=cluster.url()),
    )  # fmt: skip
    desktop = open_desktop(settings)
    journey, screen = desktop.controller, desktop.controller.patients.screen
    linden = desktop.library.patients.add(Patient("Linden 42", "right"))
    desktop.library.patients.add(Patient("Heron 17", "right"))
    screen.refresh(linden)
    assert not desktop.shell.banner.isVisible()

    cluster.stop()
    wait_until(qtbot, lambda: is_away(desktop))
    assert "server" in desktop.shell.banner.text
    assert screen.search.text() == "Linden 42", "who was chosen can be measured at one press"
    click(qtbot, screen._offline_view.button)
    first = measured(qtbot, desktop, take)
    assert linden in str(first), "known by identity"
    assert not journey.messages.is_busy, journey.messages.dialog.happened.text()
    click(qtbot, desktop.shell.top_bar.back_button)
    wait_for_place(qtbot, journey, "patients")
    assert is_away(desktop)
    desktop.close()

    desktop = open_desktop(settings)  # started while it is away
    journey, screen = desktop.controller, desktop.controller.patients.screen
    assert is_away(desktop)
    assert "server" in desktop.shell.banner.text
    qtbot.keyClicks(screen.search, "heron 17")
    qtbot.keyClick(screen.search, Qt.Key.Key_Return)
    wait_for_place(qtbot, journey, "exercise")
    cluster.start()
    wait_until(qtbot, lambda: not desktop.shell.banner.text.startswith("The clinic"))
    assert journey.current.patient is not None
    heron = desktop.library.patients.id_of_pseudonym("Heron 17")
    assert journey.current.patient.patient_id == heron, "who was typed is who the list says"
    click(qtbot, desktop.shell.top_bar.back_button)
    wait_for_place(qtbot, journey, "patients")
    wait_until(qtbot, lambda: screen.list.isVisible())
    assert [row.pseudonym for row in screen._rows[:-1]] == ["Heron 17", "Linden 42"]
    assert len(desktop.library.sessions(linden)) == 1
    assert screen.new_button.isEnabled()
    assert screen.search.text() == ""

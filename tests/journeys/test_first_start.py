"""The very first start in the real window: looked at, offered, led through a session, and remembered."""

from __future__ import annotations

from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from carpus.app.settings import load_settings
from carpus.core.capture.devices import openni2_camera
from carpus.core.capture.doctor import examine_at_start
from carpus.core.records.values import Patient
from tests.journeys.conftest import Open
from tests.journeys.test_journey import click, click_discs, wait_for_place, wait_for_still_hand


def test_first_session_is_guided_by_the_tour(qtbot: QtBot, open_desktop: Open, take: Path, tmp_path: Path) -> None:
    desktop = open_desktop()
    journey, tour, panel = desktop.controller, desktop.tour, desktop.welcome.panel
    qtbot.waitUntil(panel.isVisible)
    assert desktop.shell.focusWidget() in (journey.patients.screen.search, None), "the search keeps the keyboard"
    qtbot.waitUntil(lambda: len(panel.check_rows) >= 5)
    assert {"Camera driver", "Data folder", "Disk", "Fonts", "Screen"} <= {row.check.name for row in panel.check_rows}
    click(qtbot, panel.tour_button)
    assert desktop.welcome.panel is None
    order = []

    def go_on(bubble: str) -> None:
        qtbot.waitUntil(lambda: desktop.tour.bubble == bubble)
        order.append(journey.place)
        view = next(view for view in tour._views.values() if view.bubble is not None)
        assert view.isVisible()
        click(qtbot, view.next_button)

    go_on("patient")
    wait_for_place(qtbot, desktop.controller, "markers")
    wait_for_still_hand(qtbot, desktop)
    go_on("aim")
    qtbot.waitUntil(lambda: desktop.tour.bubble == "click")
    click_discs(qtbot, desktop, take)
    go_on("check")
    qtbot.waitUntil(lambda: desktop.tour.bubble == "record")
    assert journey.live.screen.bubble.isVisible()
    journey.navigator.switch_screen("report")
    qtbot.waitUntil(lambda: desktop.tour.bubble == "save")
    journey.report.screen.saved.emit(str(tmp_path / "report.pdf"))
    assert not load_settings(tmp_path / "settings").first_start.answered, "it is not finished yet"
    go_on("end")
    assert order == ["patients", "markers", "markers", "report"]
    assert not tour.is_on
    assert load_settings(tmp_path / "settings").first_start.answered


def test_tour_escape_ends_the_tour_only(qtbot: QtBot, open_desktop: Open) -> None:
    desktop = open_desktop()
    journey, tour = desktop.controller, desktop.tour
    desktop.shell.key_pressed.emit("help")
    wait_for_place(qtbot, desktop.controller, "help")
    click(qtbot, journey.help.screen.tour_button)
    wait_for_place(qtbot, desktop.controller, "patients")
    qtbot.waitUntil(lambda: desktop.tour.bubble == "patient")
    desktop.shell.key_pressed.emit("settings")
    qtbot.waitUntil(lambda: tour.bubble is None)
    desktop.shell.key_pressed.emit("back")
    wait_for_place(qtbot, desktop.controller, "patients")
    qtbot.waitUntil(lambda: desktop.tour.bubble == "patient")
    journey.patients.screen.new_patient()
    qtbot.waitUntil(lambda: tour.bubble is None)
    journey.patients.screen.form.dismiss()
    qtbot.waitUntil(lambda: desktop.tour.bubble == "patient")
    desktop.shell.key_pressed.emit("back")
    assert not tour.is_on
    assert journey.place == "patients"
    journey.current.patient = desktop.library.patients.get(desktop.library.patients.add(_somebody()))
    for asked_for in (False, True):
        tour.start(is_requested=asked_for)
        journey.navigator.switch_screen("camera")
        tour.refresh()
        assert tour.bubble == ("camera" if asked_for else None)


def test_first_start_is_skipped_with_patients(open_desktop: Open) -> None:
    first = open_desktop()
    first.library.patients.add(_somebody())
    first.close()
    again = open_desktop()
    assert again.welcome.panel is None


def _somebody() -> Patient:
    return Patient("Heron 17", "right", "right")


def test_start_makes_no_folder_and_loads_no_driver(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """OpenNI2 ends the process of a second thread that calls it."""

    class Library:
        def __getattr__(self, name: str) -> object:
            raise AssertionError(f"{name} was called")

    monkeypatch.setattr(openni2_camera, "load_library", Library)
    folder = tmp_path / "not" / "there"
    findings = {finding.name: finding for finding in examine_at_start(folder)}
    assert not folder.exists()
    assert all(finding.remedy for finding in findings.values() if finding.state != "good")
    assert "Frames" not in findings
    assert findings["Data folder"].state == findings["Driver"].state == "good"

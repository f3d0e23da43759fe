"""In a demo the simulated camera is the camera, whatever is plugged in, and nothing on any screen says otherwise."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtWidgets import QAbstractButton, QLabel
from pytestqt.qtbot import QtBot

from carpus.app.desktop.maintenance_cameras import MaintenanceCameras
from carpus.app.desktop.window import Desktop
from carpus.ui.screens.settings.screen import CameraCard
from tests.records.samples import HERON, LINDEN


@pytest.fixture
def demo(open_desktop: Callable[..., Desktop], monkeypatch: pytest.MonkeyPatch) -> Callable[[], Desktop]:
    monkeypatch.setattr(MaintenanceCameras, "name", lambda _: None)
    return lambda: open_desktop(is_demo=True)


def _said(desktop: Desktop) -> str:
    """Everything that stands in the window now."""
    widgets = [*desktop.shell.findChildren(QLabel), *desktop.shell.findChildren(QAbstractButton)]
    words = [f"{one.text()} {one.accessibleDescription()}" for one in widgets if one.isVisible()]
    return " ".join([*words, desktop.shell.top_bar.camera.text()]).lower()


def test_demo_screens_have_a_camera_and_no_setting_is_stored(
    qtbot: QtBot, demo: Callable[[], Desktop], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    desktop = demo()
    journey, panel = desktop.controller, desktop.welcome.panel
    qtbot.waitUntil(lambda: bool(panel.check_rows), timeout=60_000)
    assert not [row.check.name for row in panel.check_rows if "camera" in row.check.name.lower()]

    def looks_well() -> None:
        said = _said(desktop)
        assert "no camera" not in said
        assert "plugged in" not in said
        assert "plug the camera" not in said

    looks_well()
    linden = desktop.library.patients.add(LINDEN)
    desktop.library.patients.add(HERON)
    journey.patients.open(linden)
    looks_well()
    assert "file" not in journey.patients.screen.card.start_button.text()
    journey.exercise.open(linden)
    looks_well()
    monkeypatch.setattr(journey.camera.context.opener, "open", lambda _: None)
    journey.exercise.screen.primary_button.click()
    assert journey.place == "camera"
    assert journey.camera.screen.sources.value() == "practice"
    assert journey.camera.screen.primary_button.isEnabled()
    looks_well()
    journey.navigator.open_screen("settings")
    card = desktop.shell.findChild(CameraCard)
    assert not card.check_button.isVisible()
    assert not card.calibrate_button.isVisible()
    looks_well()
    desktop.preferences.screen.form["patient_sound"].buttons()[1].click()
    assert not (tmp_path / "settings").exists()

"""What version 0.1 wrote and read as settings is kept as files: the program of today takes them as they are."""

from __future__ import annotations

import shutil
import tomllib
from pathlib import Path
from typing import Any

from carpus.app.settings import (
    PREFERENCES_FILE,
    SETTINGS_FILE,
    TRACKING,
    keep_preferences,
    load_settings,
    load_sound_settings,
)

GOLDEN = Path(__file__).parent / "golden"


def of_version_01(folder: Path) -> Path:
    folder.mkdir()
    for name in (SETTINGS_FILE, PREFERENCES_FILE):
        shutil.copy(GOLDEN / f"v0.1-{name}", folder / name)
    return folder


def test_settings_of_version_01_are_understood_name_by_name(tmp_path: Path) -> None:
    folder = of_version_01(tmp_path / "settings")
    found, faults = load_sound_settings(folder)
    assert faults == []
    assert found == load_settings(folder)
    table = tomllib.loads((GOLDEN / f"v0.1-{SETTINGS_FILE}").read_text(encoding="utf-8"))
    chosen = tomllib.loads((GOLDEN / f"v0.1-{PREFERENCES_FILE}").read_text(encoding="utf-8"))

    def check(values: dict[str, Any], settings: Any, over: dict[str, Any]) -> None:
        for name, value in values.items():
            if isinstance(value, dict):
                check(value, getattr(settings, name), over.get(name, {}))
            elif name not in over:
                kept = getattr(settings, name)
                assert (list(kept) if isinstance(kept, tuple) else kept) == value, name

    check({name: table.pop(name) for name in TRACKING}, found.track, chosen)
    check(table, found, chosen)
    assert found.track.tracker.profile == "slow", "the file says something else than the defaults"
    assert found.screen.theme == "dark"
    assert found.screen.text_scale == 1.25
    assert found.screen.keys == {"play": "P"}
    assert found.recording.folder == "/home/clinic/Carpus"
    assert found.report.therapist == "AB"


def test_preferences_of_version_01_survive_being_written_again(tmp_path: Path) -> None:
    folder = of_version_01(tmp_path / "settings")
    before = load_settings(folder)
    keep_preferences(before, folder)
    assert load_settings(folder) == before

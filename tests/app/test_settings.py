"""Settings: defaults agree with the code, what a person writes goes over them, and a wrong key is named."""

from __future__ import annotations

import dataclasses
import functools
import json
import operator
import shutil
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any, get_type_hints

import pytest

from carpus.app.desktop.window import Desktop
from carpus.app.settings import (
    OBSOLETE,
    PREFERENCES_FILE,
    SETTINGS_FILE,
    TRACKING,
    LockSettings,
    RecordingSettings,
    ScreenSettings,
    Settings,
    load_settings,
    load_valid_settings,
    save_preferences,
    settings_folder,
    with_data_folder,
)
from carpus.core.detection.appearance import DetectionSettings
from carpus.core.model.errors import SettingsInvalid
from carpus.core.model.fault_text import format_fault_line
from carpus.core.model.setting_values import FORMER_NAMES, settable_names
from carpus.core.pipeline.stored_settings import settings_from_json
from carpus.core.pipeline.track import TrackSettings
from carpus.core.results.report_form import ReportSettings

DEFAULTS = Path(__file__).parents[2] / "resources" / "defaults.toml"


def write_settings(folder: Path, text: str) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / SETTINGS_FILE).write_text(text, encoding="utf-8")
    return folder


def leaves(table: dict[str, Any], where: tuple[str, ...] = ()) -> list[tuple[tuple[str, ...], Any]]:
    out: list[tuple[tuple[str, ...], Any]] = []
    for name, value in table.items():
        out += leaves(value, (*where, name)) if isinstance(value, dict) else [((*where, name), value)]
    return out


def test_shipped_file_says_what_code_does_without_it() -> None:
    for place, value in leaves(tomllib.loads(DEFAULTS.read_text(encoding="utf-8"))):
        found: Any = Settings().track if place[0] in TRACKING else Settings()
        for name in place:
            found = getattr(found, name)
        assert (list(found) if isinstance(found, tuple) else found) == value, place


def settable_places(kind: type, where: str = "") -> set[str]:
    hints = get_type_hints(kind)
    found: set[str] = set()
    for name in settable_names(kind):
        inner = dataclasses.is_dataclass(hints[name])
        found |= settable_places(hints[name], f"{where}{name}.") if inner else {f"{where}{name}"}
    return found


def test_shipped_file_has_each_setting_with_a_sentence() -> None:
    section, explained = "", set()
    for line in DEFAULTS.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            section = line.strip("[]")
        elif "  # " in line:
            explained.add(f"{section}.{line.partition(' = ')[0]}")
    tracking = {place for place in settable_places(TrackSettings) if place.partition(".")[0] in TRACKING}
    own = {place for place in settable_places(TrackSettings) if "." in place}
    assert tracking == own, "a section of tracking that no file can have"
    assert explained == settable_places(Settings) | tracking


def test_persons_file_goes_over_defaults_and_leaves_rest(tmp_path: Path) -> None:
    text = '[tracker]\nprofile = "slow"\nlost_after_s = 2\n[live]\nrows_waiting = 800\n'
    settings = load_settings(write_settings(tmp_path, text))
    assert settings.track.tracker.profile == "slow"
    assert settings.track.tracker.lost_after_s == 2.0
    assert isinstance(settings.track.tracker.lost_after_s, float)
    assert settings.live.max_waiting_rows == 800
    usual = Settings().track.tracker
    back: dict[str, Any] = {"profile": usual.profile, "lost_after_s": usual.lost_after_s}
    assert dataclasses.replace(settings.track.tracker, **back) == usual
    assert settings.track.calibration == Settings().track.calibration


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("[trackr]\n", "trackr"),
        ('[tracker]\nprofle = "slow"\n', "tracker.profle"),
        ('[tracker]\nprofile = "fast"\n', "tracker.profile"),
        ("[calibration]\nhand_length_mm = [1.0]\n", "calibration.hand_length_mm"),
        ('[recording]\nkeep_pictures = "yes"\n', "recording.keep_pictures"),
        ("[live]\nrows_waiting = 1.5\n", "live.max_waiting_rows"),
        ("[screen]\ntext_scale = true\n", "screen.text_scale"),
        ("screen = 3\n", "screen"),
    ],
)
def test_invalid_setting_is_reported_with_its_file(tmp_path: Path, text: str, named: str) -> None:
    with pytest.raises(SettingsInvalid) as fault:
        load_settings(write_settings(tmp_path, text))
    assert fault.value.subject == named
    assert SETTINGS_FILE in fault.value.detail
    assert named in format_fault_line(fault.value)
    with pytest.raises(SettingsInvalid) as fault:
        load_settings(write_settings(tmp_path, "theme = light"))
    assert SETTINGS_FILE in fault.value.subject, "no TOML at all"


def test_window_preferences_override_settings_file(tmp_path: Path) -> None:
    write_settings(tmp_path, '[screen]\ntheme = "light"\n[tracker]\nprofile = "brisk"\n')
    chosen = dataclasses.replace(
        Settings(),
        screen=ScreenSettings("dark", 1.25),
        recording=RecordingSettings(folder="/data of the clinic/é"),
        report=ReportSettings("M. R."),
    )
    save_preferences(Settings(), chosen, tmp_path)
    settings = load_settings(tmp_path)
    assert (settings.screen, settings.recording, settings.report) == (chosen.screen, chosen.recording, chosen.report)
    assert settings.track.tracker.profile == "brisk"
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([SETTINGS_FILE, PREFERENCES_FILE])


def test_settings_of_earlier_versions_that_are_gone_are_ignored_with_a_line_in_the_log(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level("INFO")
    for place in OBSOLETE:
        section, _, name = place.rpartition(".")
        caplog.clear()
        text = f"[{section}]\n{name} = 3\n" if section else f"[{name}]\n"
        assert load_settings(write_settings(tmp_path, text)) == load_settings(tmp_path / "none")
        assert place in caplog.text


def test_data_folder_is_users_own_unless_named(own_folders: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert load_settings().data_folder.is_relative_to(own_folders)
    write_settings(settings_folder(), '[recording]\nfolder = "/clinic"\n')
    assert load_settings().data_folder == Path("/clinic")
    monkeypatch.setenv("CARPUS_DATA", "/elsewhere")
    assert load_settings().data_folder == Path("/elsewhere")


@pytest.mark.parametrize("url", ["http://h/d", "postgresql:h", "postgresql://h:abc/d", "postgresql://[::1/d", "carpus"])
def test_url_that_is_none_is_reported(tmp_path: Path, url: str) -> None:
    write_settings(tmp_path, f'[records]\nurl = "{url}"\n')
    with pytest.raises(SettingsInvalid, match="not one of a PostgreSQL server"):
        load_settings(tmp_path)


def test_data_folder_named_for_one_run_is_never_stored(open_desktop: Callable[..., Desktop], tmp_path: Path) -> None:
    write_settings(tmp_path / "settings", '[recording]\nfolder = "/clinic"\n[records]\nurl = "postgresql://a@b/c"\n')
    settings = with_data_folder(load_settings(tmp_path / "settings"), tmp_path / "of one run")
    assert (settings.data_folder, settings.records.url, settings.backup.hour) == (tmp_path / "of one run", "", -1)
    desktop = open_desktop(settings)
    desktop.preferences.screen.form["patient_sound"].buttons()[1].click()
    desktop.preferences.save(lock=LockSettings(5))
    stored = load_settings(tmp_path / "settings")
    assert (stored.data_folder, stored.backup.hour) == (Path("/clinic"), 18)
    assert (stored.patient.sound, stored.lock.after_min) == (True, 5), "what was changed is stored"
    assert "folder" not in (tmp_path / "settings" / PREFERENCES_FILE).read_text(encoding="utf-8")


GOLDEN = Path(__file__).parent / "golden"


def test_settings_of_version_01_are_understood_name_by_name_and_survive_being_written_again(tmp_path: Path) -> None:
    """What version 0.1 wrote and read is kept as files: the program of today takes them as they are."""
    for name in (SETTINGS_FILE, PREFERENCES_FILE):
        shutil.copy(GOLDEN / f"v0.1-{name}", tmp_path / name)
    found, faults = load_valid_settings(tmp_path)
    assert faults == []
    assert found == load_settings(tmp_path)
    table = tomllib.loads((GOLDEN / f"v0.1-{SETTINGS_FILE}").read_text(encoding="utf-8"))
    chosen = dict(leaves(tomllib.loads((GOLDEN / f"v0.1-{PREFERENCES_FILE}").read_text(encoding="utf-8"))))
    for place, value in leaves(table):
        kept: Any = found.track if place[0] in TRACKING else found
        for depth, name in enumerate(place):
            kept = getattr(kept, FORMER_NAMES.get(".".join(place[: depth + 1]), name))
        if place not in chosen:
            assert (list(kept) if isinstance(kept, tuple) else kept) == value, place
    assert found.track.tracker.profile == "slow", "the file says something else than the defaults"
    assert (found.screen.theme, found.screen.text_scale) == ("dark", 1.25)
    assert (found.recording.folder, found.report.therapist) == ("/home/clinic/Carpus", "AB")
    save_preferences(found, dataclasses.replace(found, lock=LockSettings(5)), tmp_path)
    assert load_settings(tmp_path) == dataclasses.replace(found, lock=LockSettings(5))


def test_settings_present_name_counts_beside_former_one_and_byte_order_mark_is_skipped(tmp_path: Path) -> None:
    write_settings(tmp_path, "\ufeff[live]\nmax_waiting_rows = 70\nrows_waiting = 60\n")
    assert load_settings(tmp_path).live.max_waiting_rows == 70


def test_settings_from_json_former_names_give_the_same_settings() -> None:
    """A session of 0.2.0 is tracked again with what it was tracked with."""
    stored = dataclasses.asdict(TrackSettings(detection=DetectionSettings(max_blobs=7)))
    for former, name in FORMER_NAMES.items():
        *sections, old_name = former.split(".")
        if sections[0] in TRACKING:
            section = functools.reduce(operator.getitem, sections, stored)
            section[old_name] = section.pop(name)
    found = settings_from_json(json.dumps({"settings": stored}))
    assert found == (TrackSettings(detection=DetectionSettings(max_blobs=7)), ())

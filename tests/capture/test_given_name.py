"""A camera that does not tell its number goes by the name that a person gave to its kind."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from carpus.core.capture.calibrated_source import save_camera_name, with_given_name
from carpus.core.capture.source import SERIAL, SourceInfo
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.errors import OutputNotWritable


def source(name: str, **settings: str) -> Any:
    return SimpleNamespace(info=SourceInfo(name, DEFAULT_CAMERA, True, None, 30.0, settings))


def test_given_name_applies_only_without_serial(tmp_path: Path) -> None:
    plain, numbered = source("Xtion"), source("Xtion", serial="77")
    assert with_given_name(plain, tmp_path) is plain
    save_camera_name(tmp_path, "Xtion", "  room\n3 ")
    named = with_given_name(plain, tmp_path).info
    assert (named.serial, named.is_nameless) == ("room 3", True)
    assert with_given_name(numbered, tmp_path) is numbered
    assert not numbered.info.is_nameless
    assert SERIAL not in with_given_name(source("Carmine"), tmp_path).info.settings
    assert save_camera_name(tmp_path, "Carmine", "room\t 3") == "room 3 (Carmine)"
    of_both = [with_given_name(source(kind), tmp_path).info.serial for kind in ("Xtion", "Carmine")]
    assert of_both == ["room 3", "room 3 (Carmine)"], "one would be seen through the other's calibration"


def test_given_name_unwritable_folder_raises(tmp_path: Path) -> None:
    (tmp_path / "cameras").write_text("a file")
    with pytest.raises(OutputNotWritable):
        save_camera_name(tmp_path, "Xtion", "room 3")

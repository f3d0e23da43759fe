"""A camera that does not tell its number goes by the name that a person gave to its kind."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from carpus.core.capture.calibrated_source import save_camera_name, with_given_name
from carpus.core.capture.source import SERIAL, SourceInfo
from carpus.core.model.camera import DEFAULT_CAMERA
from carpus.core.model.errors import OutputNotWritable
from carpus.core.model.types import Frame


class Camera:
    """A source without pictures."""

    def __init__(self, name: str, **settings: str) -> None:
        self.info = SourceInfo(name, DEFAULT_CAMERA, True, None, 30.0, settings)

    def frames(self) -> Iterator[Frame]:
        return iter(())

    def close(self) -> None:
        pass


def test_given_name_applies_only_without_serial(tmp_path: Path) -> None:
    plain, numbered = Camera("Xtion"), Camera("Xtion", serial="77")
    assert with_given_name(plain, tmp_path) is plain
    save_camera_name(tmp_path, "Xtion", "  room\n3 ")
    named = with_given_name(plain, tmp_path).info
    assert (named.serial, named.is_nameless) == ("room 3", True)
    assert with_given_name(numbered, tmp_path) is numbered
    assert not numbered.info.is_nameless
    assert SERIAL not in with_given_name(Camera("Carmine"), tmp_path).info.settings
    assert save_camera_name(tmp_path, "Carmine", "room\t 3") == "room 3 (Carmine)"
    of_both = [with_given_name(Camera(kind), tmp_path).info.serial for kind in ("Xtion", "Carmine")]
    assert of_both == ["room 3", "room 3 (Carmine)"], "one would be seen through the other's calibration"


def test_given_name_unwritable_folder_raises(tmp_path: Path) -> None:
    (tmp_path / "cameras").write_text("a file")
    with pytest.raises(OutputNotWritable):
        save_camera_name(tmp_path, "Xtion", "room 3")

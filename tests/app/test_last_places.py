"""File dialogs begin where the person was last, never in the folder that Carpus was started from."""

from __future__ import annotations

from pathlib import Path

import pytest

from carpus.ui.shell.recent_locations import RecentLocations


@pytest.fixture
def data(tmp_path: Path) -> Path:
    folder = tmp_path / "data"
    folder.mkdir()
    return folder


def test_recent_locations_are_kept_per_kind_until_missing(tmp_path: Path, data: Path) -> None:
    places = RecentLocations(data)
    for kind in ("reports", "recordings"):
        (tmp_path / kind).mkdir()
        places.save(kind, str(tmp_path / kind))  # type: ignore[arg-type]
    again = RecentLocations(data)
    assert again.folder("reports") == str(tmp_path / "reports")
    assert again.folder("recordings") == str(tmp_path / "recordings")
    (tmp_path / "reports").rmdir()
    assert again.folder("reports") != str(tmp_path / "reports")

"""File dialogs begin where the person was last, never in the folder that Carpus was started from."""

from __future__ import annotations

from pathlib import Path

from carpus.ui.shell.recent_locations import RecentLocations


def test_recent_locations_are_kept_per_kind_until_missing(tmp_path: Path) -> None:
    places = RecentLocations(tmp_path)
    for kind in ("reports", "recordings"):
        (tmp_path / kind).mkdir()
        places.save(kind, str(tmp_path / kind))  # type: ignore[arg-type]
    again = RecentLocations(tmp_path)
    assert again.folder("reports") == str(tmp_path / "reports")
    assert again.folder("recordings") == str(tmp_path / "recordings")
    (tmp_path / "reports").rmdir()
    assert again.folder("reports") != str(tmp_path / "reports")

"""File dialogs begin where the person was last, never in the folder that Carpus was started from."""

from __future__ import annotations

from pathlib import Path

import pytest

from carpus.app.desktop import last_places
from carpus.app.desktop.last_places import FILE, LastPlaces


def test_the_first_time_it_is_documents_or_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    papers = tmp_path / "papers"
    monkeypatch.setattr(last_places, "documents", lambda: str(papers))
    assert LastPlaces(tmp_path).folder("reports") == str(Path.home()), "the folder for papers is not there"
    papers.mkdir()
    assert LastPlaces(tmp_path).folder("reports") == str(papers)


def test_each_kind_has_its_own_place_until_it_is_gone(tmp_path: Path) -> None:
    places = LastPlaces(tmp_path)
    for kind in ("reports", "recordings"):
        (tmp_path / kind).mkdir()
        places.keep(kind, str(tmp_path / kind))  # type: ignore[arg-type]
    again = LastPlaces(tmp_path)
    assert again.folder("reports") == str(tmp_path / "reports")
    assert again.folder("recordings") == str(tmp_path / "recordings")
    (tmp_path / "reports").rmdir()
    assert again.folder("reports") != str(tmp_path / "reports")


@pytest.mark.parametrize("content", ["", "[1]", '{"reports": 7}', "not json"])
def test_a_damaged_file_is_no_fault(tmp_path: Path, content: str) -> None:
    (tmp_path / FILE).write_text(content)
    places = LastPlaces(tmp_path)
    assert Path(places.folder("reports")).is_dir()
    places.keep("reports", str(tmp_path))
    assert places.folder("reports") == str(tmp_path)


def test_a_folder_that_cannot_be_written_is_no_fault(tmp_path: Path) -> None:
    LastPlaces(tmp_path / "nowhere").keep("reports", str(tmp_path))

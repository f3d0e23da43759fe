"""File dialogs begin where the person was last, never in the folder that Carpus was started from."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from carpus.core.errors import DiskFull
from carpus.core.records.store import Store
from carpus.ui import last_places
from carpus.ui.last_places import LastPlaces


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    with Store(tmp_path / "data") as found:
        yield found


def test_the_first_time_it_is_documents_or_home(tmp_path: Path, store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    papers = tmp_path / "papers"
    monkeypatch.setattr(last_places, "documents", lambda: str(papers))
    assert LastPlaces(store).folder("reports") == str(Path.home()), "the folder for papers is not there"
    papers.mkdir()
    assert LastPlaces(store).folder("reports") == str(papers)


def test_each_kind_has_its_own_place_until_it_is_gone(tmp_path: Path, store: Store) -> None:
    places = LastPlaces(store)
    for kind in ("reports", "recordings"):
        (tmp_path / kind).mkdir()
        places.keep(kind, str(tmp_path / kind))  # type: ignore[arg-type]
    again = LastPlaces(store)
    assert again.folder("reports") == str(tmp_path / "reports")
    assert again.folder("recordings") == str(tmp_path / "recordings")
    (tmp_path / "reports").rmdir()
    assert again.folder("reports") != str(tmp_path / "reports")


def test_a_store_that_cannot_be_written_is_no_fault(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise DiskFull("disk")

    monkeypatch.setattr(store, "own", full)
    LastPlaces(store).keep("reports", str(store.folder))
    assert Path(LastPlaces(store).folder("reports")).is_dir()

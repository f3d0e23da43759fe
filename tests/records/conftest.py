"""One PostgreSQL for the tests of a process, made when the first of them asks for it."""

from __future__ import annotations

import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest

from carpus.core.records.database import STORE_FILE
from tests.records.postgres import Cluster
from tests.records.samples import opened, settled, shared


@pytest.fixture(scope="session")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    """``model`` is a database with the tables of a store and nothing in them, to be copied."""
    made = Cluster()
    with opened(tmp_path_factory.mktemp("model"), made.new_database("model")) as house:
        settled(house)
    yield made
    made.end()


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[str]:
    """Of a store in ``tmp_path``: empty for SQLite alone, or of a new database of a real server. When the test is done
    that server has what the store has, and another computer gets all of it."""
    if request.param == "sqlite":
        yield ""
        return
    there: str = request.getfixturevalue("cluster").new_database(f"c{uuid.uuid4().hex[:12]}", "model")
    yield there
    assert (tmp_path / STORE_FILE).is_file()
    with opened(tmp_path, there) as house:
        settled(house)
        wanted = shared(house)
    with opened(tmp_path / "another computer", there) as house:
        settled(house)
        assert shared(house) == wanted

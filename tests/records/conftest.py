"""One PostgreSQL for the tests of a process, made when the first of them asks for it."""

from __future__ import annotations

import uuid
from collections.abc import Iterator

import pytest

from tests.records.postgres import Cluster
from tests.records.samples import open_store


@pytest.fixture(scope="session")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    """``model`` is a database with the tables of a store and nothing in them, to be copied."""
    made = Cluster()
    with open_store(tmp_path_factory.mktemp("model"), made.new_database("model")) as house:
        assert house.names() == []
    yield made
    made.end()


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request: pytest.FixtureRequest) -> str:
    """Of a store: empty for SQLite in its folder, or of a new database of a real server."""
    if request.param == "sqlite":
        return ""
    there: str = request.getfixturevalue("cluster").new_database(f"c{uuid.uuid4().hex[:12]}", "model")
    return there

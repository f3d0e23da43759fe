"""One PostgreSQL for the tests of a process, made when the first of them asks for it."""

from __future__ import annotations

import uuid
from collections.abc import Iterator

import pytest

from tests.records.postgres import Cluster


@pytest.fixture(scope="session")
def cluster() -> Iterator[Cluster]:
    made = Cluster()
    yield made
    made.end()


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request: pytest.FixtureRequest) -> str:
    """Of a store: empty for SQLite alone, or of a new database of a real server."""
    if request.param == "sqlite":
        return ""
    cluster: Cluster = request.getfixturevalue("cluster")
    return cluster.new_database(f"c{uuid.uuid4().hex[:12]}")

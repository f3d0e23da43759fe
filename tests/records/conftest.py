"""One PostgreSQL for the tests of a process, made when the first of them asks for it."""

from __future__ import annotations

import uuid
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import select

from carpus.core.records.changes import PRACTICE
from carpus.core.records.database import STORE_FILE
from carpus.core.records.schema import COPIED, DEED
from tests.records.postgres import Cluster
from tests.records.samples import House, opened, settled


@pytest.fixture(scope="session")
def cluster() -> Iterator[Cluster]:
    made = Cluster()
    yield made
    made.end()


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[str]:
    """Of a store in ``tmp_path``: empty for SQLite alone, or of a new database of a real server. When the test is done
    that server has what the store has, and another computer gets all of it."""
    if request.param == "sqlite":
        yield ""
        return
    there: str = request.getfixturevalue("cluster").new_database(f"c{uuid.uuid4().hex[:12]}")
    yield there
    assert (tmp_path / STORE_FILE).is_file()
    with opened(tmp_path, there) as house:
        settled(house)
        wanted = _shared(house)
    with opened(tmp_path / "another computer", there) as house:
        settled(house)
        assert _shared(house) == wanted


def _shared(house: House) -> dict[str, list[dict[str, Any]]]:
    """All rows that are of every computer."""
    found = {}
    for table in (*COPIED, DEED):
        columns = [column for column in table.c if column.name != "step"]
        rows = house.store.rows_there(select(*columns).order_by(table.c.id))
        found[table.name] = [
            dict(row._mapping) for row in rows if PRACTICE not in (row.id, row._mapping.get("patient_id"))
        ]
    return found

"""The format page tells what the schema says."""

from __future__ import annotations

from importlib import resources

from carpus.core.session.format_page import format_page
from carpus.core.session.schema import ALL_FIELDS, SMOOTHED_FIELDS


def test_the_page_in_the_repository_is_the_schema_s() -> None:
    stored = resources.files("carpus.resources").joinpath("session-format.md").read_text(encoding="utf-8")
    assert stored == format_page(), "write format_page() to resources/session-format.md"


def test_every_dataset_is_explained() -> None:
    page = format_page()
    for field in ALL_FIELDS:
        if field not in SMOOTHED_FIELDS:
            assert f"`{field.path}`" in page

"""The format page tells what the schema says."""

from __future__ import annotations

import dataclasses
from importlib import resources

from carpus.core.session import schema
from carpus.core.session.schema import ALL_FIELDS, SMOOTHED_FIELDS
from carpus.core.types import Moment, TrackedFrame
from tests.session.format_page import format_page


def test_the_page_in_the_repository_is_the_schema_s() -> None:
    stored = resources.files("carpus.resources").joinpath("session-format.md").read_text(encoding="utf-8")
    assert stored == format_page(), "write format_page() to resources/session-format.md"


def test_every_dataset_is_explained() -> None:
    page = format_page()
    for field in ALL_FIELDS:
        if field not in SMOOTHED_FIELDS:
            assert f"`{field.path}`" in page


def test_a_moment_has_the_columns_of_the_schema_and_no_others() -> None:
    assert [field.attribute for field in schema.MOTION_FIELDS] == [field.name for field in dataclasses.fields(Moment)]
    own = {field.attribute for field in schema.FRAME_FIELDS if field not in schema.MOTION_FIELDS}
    assert own <= {field.name for field in dataclasses.fields(TrackedFrame)}

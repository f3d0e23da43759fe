"""The schema of the session file is the page that explains it, and what a frame has."""

from __future__ import annotations

import dataclasses
from importlib import resources

from carpus.core.model.types import KinematicState, TrackedFrame
from carpus.core.session import schema
from tests.session.format_page import format_page


def test_format_page_matches_schema() -> None:
    stored = resources.files("carpus.resources").joinpath("session-format.md").read_text(encoding="utf-8")
    assert stored == format_page(), "write format_page() to resources/session-format.md"
    assert all(one.description for one in (*schema.ALL_FIELDS, *schema.REPETITION_COLUMNS))


def test_kinematic_state_fields_match_schema() -> None:
    assert [field.attribute for field in schema.MOTION_FIELDS] == [
        field.name for field in dataclasses.fields(KinematicState)
    ]
    own = {field.attribute for field in schema.FRAME_FIELDS if field not in schema.MOTION_FIELDS}
    assert own <= {field.name for field in dataclasses.fields(TrackedFrame)}

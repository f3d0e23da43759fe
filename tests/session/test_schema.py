"""The schema of the session file is in the page that explains it, and is what a frame has."""

from __future__ import annotations

import dataclasses
from importlib import resources

from carpus.core.model.types import KinematicState, TrackedFrame
from carpus.core.session import schema
from carpus.core.session.schema import Field


def test_format_page_matches_schema() -> None:
    page = resources.files("carpus.resources").joinpath("session-format.md").read_text(encoding="utf-8")
    attributes = (schema.ROOT_ATTRIBUTES, schema.CAMERA_ATTRIBUTES, schema.VERDICT_ATTRIBUTES)
    rows = [f"| `{name}` | {meaning} |" for table in attributes for name, meaning in table.items()]
    rows += [format_row(field) for field in schema.ALL_FIELDS if field not in schema.SMOOTHED_FIELDS]
    rows += [f"| `{one.name}` | {one.dtype} | {one.unit} | {one.description} |" for one in schema.REPETITION_COLUMNS]
    assert [line for line in page.splitlines() if line.startswith("| `")] == rows
    letters = schema.GROWING_AXES | {"P": "repetitions"} | schema.NAMED_AXES
    assert f"below: {', '.join(f'{letter} {what}' for letter, what in letters.items())}.\n" in page
    assert f"version {schema.FORMAT_VERSION})" in page


def format_row(field: Field) -> str:
    shape = ", ".join(map(str, field.shape)) + ("," if len(field.shape) == 1 else "")
    remarks = [field.description, *(["`hand21` only"] * field.fingers_only), *(["optional"] * field.optional)]
    remarks += [f"since version {field.since}"] * (field.since > 1)
    return f"| `{field.path}` | ({shape}) | {field.dtype} | {field.unit} | {'; '.join(remarks)} |"


def test_kinematic_state_fields_match_schema() -> None:
    assert [field.attribute for field in schema.MOTION_FIELDS] == [
        field.name for field in dataclasses.fields(KinematicState)
    ]
    own = {field.attribute for field in schema.FRAME_FIELDS if field not in schema.MOTION_FIELDS}
    assert own <= {field.name for field in dataclasses.fields(TrackedFrame)}

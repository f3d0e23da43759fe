"""The page that explains the session file, made from the schema."""

from __future__ import annotations

from carpus.core.session import schema
from carpus.core.session.checksum import CHECKSUM_ATTRIBUTE
from carpus.core.session.schema import Field

_HEAD = f"""\
# Session file

HDF5, format `{schema.FORMAT}` version {schema.FORMAT_VERSION}. Metres, radians, seconds, pixels; a value that is not \
known is NaN, never 0. Every dataset has the attributes `unit` and `description`; one with an axis of markers, joints \
or angles has `names` for it. This page is made from `core/session/schema.py`.

Axes: {{axes}}.

While a session runs, what is measured goes to a recording journal on the computer's own disk \
(`core/session/journal.py`), synchronised twice a second. The file is made from it at the end, under a hidden name \
(`.NAME.h5.xxxxxxxx.tmp`), read back, sealed and renamed. `carpus recover FOLDER` does the same for what was cut \
short; the attribute `{schema.RECOVERED}` then says when. It also finishes the part files \
(`NAME.h5.xxxxxxxx.part`) of Carpus 0.2.0.

Datasets that have a row for each frame, blob or event are packed (gzip and shuffle, which any HDF5 library unpacks). \
Every chunk has a Fletcher32 check sum, which any HDF5 library checks when it reads. A finished session has the \
attribute `{CHECKSUM_ATTRIBUTE}`: SHA-256 over all datasets, attributes and names but itself; \
`carpus verify FILE` compares it. It has no key: it shows changes by accident, not who made them. Only \
hard links and plain chunked or contiguous storage inside the file \
are read, packed by nothing else.
"""


def format_page() -> str:
    """Markdown text; kept in ``resources/session-format.md``."""
    letters = schema.GROWING_AXES | {"P": "repetitions"} | schema.NAMED_AXES
    axes = ", ".join(f"{letter} {what}" for letter, what in letters.items())
    parts = [_HEAD.format(axes=axes)]
    for title, attributes in (
        ("Attributes of `/`", schema.ROOT_ATTRIBUTES),
        ("Attributes of `/camera`", schema.CAMERA_ATTRIBUTES),
        ("Attributes of `/calibration`", schema.VERDICT_ATTRIBUTES),
    ):
        parts.append(f"## {title}\n\n| name | meaning |\n|---|---|\n" + _lines(attributes))
    rows = "".join(map(_row, (field for field in schema.ALL_FIELDS if field not in schema.SMOOTHED_FIELDS)))
    parts.append("## Datasets\n\n| path | shape | type | unit | meaning |\n|---|---|---|---|---|\n" + rows)
    parts.append(
        "## Columns of `/repetitions`\n\n| column | type | unit | meaning |\n|---|---|---|---|\n"
        + "".join(f"| `{c.name}` | {c.dtype} | {c.unit} | {c.description} |\n" for c in schema.REPETITION_COLUMNS)
    )
    parts.append(
        f"`/repetitions` has the attributes `{schema.REPETITION_ANGLE}`, the angle that was trained (empty: none), "
        "`column_units` and `column_descriptions`. A session that Carpus 0.2.0 recovered is without. "
        "What a person leaves out or moves "
        "later is not in the file.\n"
        "A longer text than fits goes on in the next rows of `/events`, which have the same time and kind. Texts are "
        'UTF-8 without HDF5\'s mark of it, so that Octave loads the file: h5py reads them with `asstr("utf-8")`.\n'
        "`/smoothed/wrist` and `/smoothed/joints` hold what `/wrist` and `/joints` hold, by the smoother; "
        "whole or not there.\n"
        "The event `not_looked_back` says why a live session is without.\n"
        "`/raw` has the attribute `depth_unit_m`: metres per count of the depth pictures.\n"
    )
    return "\n".join(parts)


def _lines(attributes: dict[str, str]) -> str:
    return "".join(f"| `{name}` | {meaning} |\n" for name, meaning in attributes.items())


def _row(field: Field) -> str:
    shape = ", ".join(map(str, field.shape)) + ("," if len(field.shape) == 1 else "")
    remarks = [field.description]
    if field.fingers_only:
        remarks.append("`hand21` only")
    if field.optional:
        remarks.append("optional")
    if field.since > 1:
        remarks.append(f"since version {field.since}")
    return f"| `{field.path}` | ({shape}) | {field.dtype} | {field.unit} | {'; '.join(remarks)} |\n"

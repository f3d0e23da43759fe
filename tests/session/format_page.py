"""The page that explains the session file, made from the schema."""

from __future__ import annotations

from carpus.core.session import schema
from carpus.core.session.checks import CHECKSUM_ATTRIBUTE
from carpus.core.session.schema import Field

_HEAD = f"""\
# Session file

A session is one HDF5 file (format `{schema.FORMAT}`, version {schema.FORMAT_VERSION}). This page lists everything in \
it, and is made from `core/session/schema.py`.

## How to read it

In Python `carpus.open_session` gives arrays and tables ([Python](api.md)). Any other program with HDF5 reads it too:

```python
import h5py

with h5py.File("session.h5") as file:
    names = list(file["/wrist/angles"].attrs["names"])  # deviation, flexion, pronosupination
    flexion_rad = file["/wrist/angles"][:, names.index("flexion")]
    time_s = file["/frames/timestamp"][:]
    notes = file["/events/text"].asstr("utf-8")[:]
```

```matlab
angles = h5read('session.h5', '/wrist/angles');        % MATLAB, dimensions reversed; Octave: load('session.h5')
```

- **Units** are metres, radians, seconds and pixels. Every dataset has the attributes `unit` and `description`. One \
with an axis of markers, joints or angles has their `names`.
- **An unknown value is NaN**, never 0.
- **W0** is the frame of the hand in the neutral pose, **W2** that of the moving hand. Origin: WRIST marker; \
x: to the MCP3 marker; z: out of the back of the hand; y = z × x.
- **Texts** are UTF-8. They lack HDF5's mark for it, because HDF5 converts no texts between marks and Octave could \
then not load the file. In h5py, read them with `asstr("utf-8")`.
- **Axes** in the tables below: {{axes}}.
"""
_SAFETY = f"""\
## How it is written and checked

While a session runs, the measurements go to a journal on the computer's own disk, which is synchronised twice a \
second. At the end Carpus makes the file from it under a hidden name (`.NAME.h5.xxxxxxxx.tmp`), reads it back, adds \
the checksum and renames it. `carpus recover FOLDER` does the same for an interrupted session; its attribute \
`{schema.RECOVERED}` then says when. It also finishes the unfinished files (`NAME.h5.xxxxxxxx.part`) of Carpus 0.2.0.

Datasets with a row for each frame, blob or event are compressed (gzip and shuffle, which every HDF5 library reads). \
Every chunk has a Fletcher32 checksum, which every HDF5 library checks. The attribute `{CHECKSUM_ATTRIBUTE}` is the \
SHA-256 of all datasets, attributes and names except itself, and `carpus verify FILE` compares it. It has no key: it \
shows accidental changes, not who made them.

Carpus reads only plain files: hard links, chunked or contiguous storage inside the file, and no other compression.
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
        f"`/repetitions` has the attributes `{schema.REPETITION_ANGLE}` (the trained angle, empty if none), "
        "`column_units` and `column_descriptions`. A session that Carpus 0.2.0 recovered has no `/repetitions`. "
        "Repetitions that a person excludes or moves later are not stored in this file.\n\n"
        "## Further remarks\n\n"
        "- `/smoothed/wrist` and `/smoothed/joints` have the same datasets as `/wrist` and `/joints`, estimated by the "
        "smoother, which also uses later frames. They are there completely or not at all. If the smoother failed in a "
        "live session, the event `not_looked_back` says why.\n"
        "- A text that is too long for one row of `/events` continues in the next rows, which have the same time and "
        "kind.\n"
        "- `/raw` has the attribute `depth_unit_m`: metres per count of the depth images.\n"
    )
    parts.append(_SAFETY)
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

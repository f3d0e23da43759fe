"""Only plain session files are read: hard links, storage inside the file, declared types and sizes.

HDF5 follows links into other files, reads the bytes of any file as external storage and allocates whatever a shape
claims. All of that is refused here before a value is read, so that a session holds what is in its own file.
"""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import h5py

from carpus.core.errors import SessionUnreadable
from carpus.core.phrase import phrase
from carpus.core.session import schema
from carpus.core.session.schema import Field

MOST_OBJECTS = 400
"""Groups and datasets of one file; the schema has fewer than 100."""
DEEPEST = 6
_PLAIN_LAYOUTS = (h5py.h5d.COMPACT, h5py.h5d.CONTIGUOUS, h5py.h5d.CHUNKED)
_PLAIN_FILTERS = (h5py.h5z.FILTER_FLETCHER32,)
_KINDS = {"f": "f", "u": "iu", "i": "iu", "t": "SO", "r": "V"}
_FIELDS = {field.path: field for field in schema.ALL_FIELDS}
_ENDS_OF_RAW = {field.path for field in schema.RAW_STREAMS}


def check_plain(path: Path, file: h5py.File) -> None:
    """Raise :class:`SessionUnreadable` for a file with anything in it that is not plainly its own."""
    size = path.stat().st_size
    whole = bool(file.attrs.get("complete", False))
    seen: set[tuple[int, int]] = set()
    waiting: list[tuple[str, h5py.h5g.GroupID, int]] = [("", h5py.h5g.open(file.id, b"/"), 0)]
    declared = 0
    while waiting:
        place, group, depth = waiting.pop()
        if depth > DEEPEST:
            raise SessionUnreadable(path, phrase("groups within groups without end at {place}", place=place))
        for name in _names(path, group, place):
            inside = f"{place}/{name.decode('utf-8', 'replace')}"
            if group.links.get_info(name).type != h5py.h5l.TYPE_HARD:
                raise SessionUnreadable(path, phrase("{inside} points out of its place", inside=inside))
            info = h5py.h5o.get_info(group, name)
            key = (info.fileno, info.addr)
            if key in seen:
                raise SessionUnreadable(path, phrase("{inside} has two names", inside=inside))
            seen.add(key)
            if len(seen) > MOST_OBJECTS:
                raise SessionUnreadable(path, phrase("more than {most_objects} parts", most_objects=MOST_OBJECTS))
            if info.type == h5py.h5o.TYPE_GROUP:
                if inside in _FIELDS:
                    raise SessionUnreadable(path, phrase("{inside} is a group, values expected", inside=inside))
                waiting.append((inside, h5py.h5g.open(group, name), depth + 1))
            elif info.type == h5py.h5o.TYPE_DATASET:
                dataset = h5py.Dataset(h5py.h5d.open(group, name))
                _check_storage(path, inside, dataset)
                field = _FIELDS.get(inside)
                if field is not None:
                    declared += _checked_size(path, field, dataset, size, whole=whole)
            elif inside in _FIELDS:
                raise SessionUnreadable(path, phrase("{inside} is a type, values expected", inside=inside))
    if declared > 2 * size + 65536:
        raise SessionUnreadable(path, phrase("it claims more values than the file can hold"))


def chunk_rows_there(dataset: h5py.Dataset) -> int:
    """Rows for which a growing dataset has chunks; its shape may claim more."""
    step, *row = dataset.chunks
    chunk_bytes = step * math.prod(row) * dataset.dtype.itemsize + (4 if dataset.fletcher32 else 0)
    return int(dataset.id.get_storage_size()) // chunk_bytes * int(step) if chunk_bytes else int(dataset.shape[0])


def _names(path: Path, group: h5py.h5g.GroupID, place: str) -> list[bytes]:
    names = list(itertools.islice(group, MOST_OBJECTS + 1))
    if len(names) > MOST_OBJECTS:
        raise SessionUnreadable(
            path, phrase("more than {most_objects} parts in {value}", most_objects=MOST_OBJECTS, value=place or "/")
        )
    return names


def _check_storage(path: Path, place: str, dataset: h5py.Dataset) -> None:
    plan = dataset.id.get_create_plist()
    if plan.get_layout() not in _PLAIN_LAYOUTS or plan.get_external_count() > 0:
        raise SessionUnreadable(path, phrase("{place} keeps its values in another file", place=place))
    if any(plan.get_filter(number)[0] not in _PLAIN_FILTERS for number in range(plan.get_nfilters())):
        raise SessionUnreadable(path, phrase("{place} is packed, which a session is not", place=place))


def _checked_size(path: Path, field: Field, dataset: h5py.Dataset, file_bytes: int, *, whole: bool) -> int:
    """Bytes that reading a dataset takes; raises where type, axes or size are not as declared."""
    kind = dataset.dtype.kind
    if kind not in _KINDS[field.dtype[0]] or (kind == "O" and h5py.check_string_dtype(dataset.dtype) is None):
        raise SessionUnreadable(
            path,
            phrase(
                "{path} is of the type {dtype}, {dtype2} expected",
                path=field.path,
                dtype=dataset.dtype,
                dtype2=field.dtype,
            ),
        )
    shape = dataset.shape
    if shape is None or len(shape) != len(field.shape):
        raise SessionUnreadable(
            path,
            phrase(
                "{path} has the shape {shape}, {count} axes expected",
                path=field.path,
                shape=shape,
                count=len(field.shape),
            ),
        )
    claimed = math.prod(int(length) for length in shape) * dataset.dtype.itemsize
    stored = int(dataset.id.get_storage_size())
    if dataset.chunks is not None and field.shape[0] in schema.GROWING_AXES and not whole:
        # A flush that was cut short leaves rows announced whose chunk is not there; they are not read.
        claimed = min(claimed, chunk_rows_there(dataset) * math.prod(map(int, shape[1:])) * dataset.dtype.itemsize)
        if math.prod(dataset.chunks) * dataset.dtype.itemsize > 1 << 27:
            raise SessionUnreadable(path, phrase("{path} is stored in pieces that are too large", path=field.path))
    if stored > file_bytes or claimed > max(stored, 0) + 4096:
        raise SessionUnreadable(
            path,
            phrase(
                "{path} claims {claimed} bytes, and {stored} are there", path=field.path, claimed=claimed, stored=stored
            ),
        )
    return 0 if field.path in _ENDS_OF_RAW else claimed
